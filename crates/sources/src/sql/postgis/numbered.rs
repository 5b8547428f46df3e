//! The conversion of named parameters to numbered ones.

use crate::sql::cell::Cell;
use crate::sql::rewrite::placeholder_ranges;

/// A statement with numbered parameters, and the name of each number.
pub(super) struct NumberedStatement {
    /// SQL with `$1` instead of names.
    pub sql: String,
    /// Names, in the order of their numbers.
    pub names: Vec<String>,
}

/// The source of parameter types.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum ParameterTypes {
    /// Types inferred by the server from the context.
    Inferred,
    /// Types of the values.
    Told,
}

/// Numbers the parameters of a statement. Geometries get the reference system `srid`.
pub(super) fn number_parameters(
    sql: &str,
    types: ParameterTypes,
    srid: u32,
    value: impl Fn(&str) -> Option<Cell>,
) -> NumberedStatement {
    let mut made = NumberedStatement { sql: String::with_capacity(sql.len() + 40), names: Vec::new() };
    let mut from = 0;
    for (begin, end) in placeholder_ranges(sql) {
        let name = &sql[begin + 1..end];
        let index = made.names.iter().position(|known| known == name).unwrap_or_else(|| {
            made.names.push(name.to_owned());
            made.names.len() - 1
        });
        let number = index + 1;
        made.sql += &sql[from..begin];
        made.sql += &match (value(name), types) {
            (Some(Cell::Geometry(_)), _) => format!("ST_GeomFromWKB(${number}::bytea, {srid})"),
            (Some(Cell::Null), _) => format!("${number}::text"),
            (Some(Cell::List(_)), _) | (_, ParameterTypes::Inferred) | (None, _) => format!("${number}"),
            (Some(Cell::Number(_)), ParameterTypes::Told) => format!("${number}::float8"),
            (Some(Cell::Text(_)), ParameterTypes::Told) => format!("${number}::text"),
            (Some(Cell::Boolean(_)), ParameterTypes::Told) => format!("${number}::bool"),
        };
        from = end;
    }
    made.sql += &sql[from..];
    made
}
