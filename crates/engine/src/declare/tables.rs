//! The tables that scripts ask: the sources that they have loaded, in a database that is made once somebody asks.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon_data::{Feature, Layer};

/// A source as a table.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(super) struct SourceTable {
    /// What statements call it.
    pub name: String,
    pub content: TableContent,
}

/// What a table holds.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(super) enum TableContent {
    /// The features as they were read.
    Layer(Arc<Layer>),
    /// A layer of a GeoPackage, as it is in the file.
    GeoPackage { path: PathBuf, shown: String, layer: String },
    /// What the script made, in metres around the origin of the run.
    List(ListTable),
}

/// A list of features that the script made.
#[derive(Debug, Default)]
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(crate) struct ListTable {
    /// The names of attributes.
    pub names: Vec<String>,
    pub features: Vec<Feature>,
}

/// The tables of a run, in the order in which they were loaded.
#[derive(Default)]
pub(super) struct SourceTables {
    loaded: Vec<SourceTable>,
    #[cfg(feature = "data")]
    database: Option<database::SourceDatabase>,
}

impl SourceTables {
    /// Adds what a source is.
    pub(super) fn add(&mut self, table: SourceTable) {
        self.loaded.push(table);
    }
}

#[cfg(feature = "data")]
mod database;
