//! The rewriting of statements, so that they use indexes and return rows in a fixed order.
//!
//! Input: a statement and the available tables. Output: the statement that the database runs. Added conditions are
//! implied by existing ones, or fix an unspecified order, so the rows stay the same.

mod catalogue;
mod chosen;
mod distinct;
#[cfg(feature = "postgis")]
mod guard;
mod joins;
mod lateral;
mod least;
mod made;
mod nearest;
mod operators;
mod order;
mod parse;
mod rename;
mod rows;
mod scope;
mod statement;
mod substitute;
mod types;
mod typing;
mod walk;
mod windows;

pub(crate) use catalogue::{Catalogue, Dialect, TableInfo};
pub(crate) use chosen::ChosenRows;
#[cfg(feature = "postgis")]
pub(crate) use guard::check;
pub(crate) use made::MadeTable;
#[cfg(feature = "postgis")]
pub(crate) use parse::placeholder_ranges;
pub(crate) use parse::{find_word, second_statement, table_words};
pub(crate) use rename::rename_tables;
pub(crate) use statement::{RewrittenQuery, rewrite};
pub(crate) use types::SqlType;
