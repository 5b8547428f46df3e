//! Statements as people write them, made into statements that use the index and give rows in one order.
//!
//! Comes in: a statement and the tables that there are. Goes out: the statement that the database is asked. What is added
//! follows from what is there already, or settles what was left open, so that the rows stay the same.

mod chosen;
#[cfg(feature = "postgis")]
mod guard;
mod joins;
mod nearest;
mod operators;
mod order;
mod parse;
mod scope;
mod statement;
mod walk;

pub(crate) use chosen::ChosenRows;
#[cfg(feature = "postgis")]
pub(crate) use guard::check;
#[cfg(feature = "postgis")]
pub(crate) use parse::placeholder_ranges;
pub(crate) use parse::{find_word, second_statement};
pub(crate) use statement::{Catalogue, Dialect, RewrittenQuery, TableInfo, rewrite};
