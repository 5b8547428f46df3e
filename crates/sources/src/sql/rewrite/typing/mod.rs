//! Gives a statement the meaning that it has in PostgreSQL: determines the types of its expressions, refuses
//! comparisons and computations of wrong types, and rewrites operators, casts and functions so that SQLite does the
//! same.
//!
//! If a type is unknown, such as that of a parameter, the inserted functions check the values.

mod calls;
mod casts;
mod column_name;
mod conversions;
mod expressions;
mod operators;
mod queries;
mod scope;
mod signatures;

pub(super) use column_name::column_name;
pub(super) use conversions::error_at;
pub(super) use queries::type_query;
