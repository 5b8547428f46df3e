//! The description of the tables that a statement can name, and of the database that runs it.

use std::collections::BTreeMap;

use super::types::SqlType;

/// The description of a table.
#[derive(Debug, Clone, Default)]
pub(crate) struct TableInfo {
    /// Name.
    pub name: String,
    /// Integer column that identifies the rows.
    pub key: Option<String>,
    /// Geometry columns.
    pub geometries: Vec<String>,
    /// All columns.
    pub columns: Vec<String>,
    /// Types of the columns, as far as known.
    pub kinds: Vec<SqlType>,
    /// Number of rows.
    pub rows: usize,
    /// Schema and name on a server.
    pub place: Option<(String, String)>,
    /// Set if the table is an alias of another one with a shorter name.
    pub is_alias: bool,
}

impl TableInfo {
    /// Returns true if the table has a column named `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|known| known.eq_ignore_ascii_case(name))
    }

    /// Returns the geometry column named `name`.
    pub(super) fn geometry(&self, name: &str) -> Option<&str> {
        self.geometries.iter().find(|known| known.eq_ignore_ascii_case(name)).map(String::as_str)
    }
}

/// Tables by lower-case name.
pub(crate) type Catalogue = BTreeMap<String, TableInfo>;

/// The database that runs a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// Internal database.
    Sqlite,
    /// PostGIS server.
    #[cfg(feature = "postgis")]
    Postgis,
}
