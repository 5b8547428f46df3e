//! Tables for queries: the loaded sources of a run.

use std::path::PathBuf;
use std::sync::Arc;
#[cfg(feature = "postgis")]
use std::time::Duration;

#[cfg(feature = "data")]
use super::database::SourceDatabase;
use super::lists::ScriptList;
#[cfg(feature = "postgis")]
use crate::sql::postgis::{Server, ServerAddress};
use burgeon_data::Layer;
use burgeon_kit::FeatureSource;

/// Source as a table.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "queries need the feature data"))]
pub(super) struct SourceTable {
    /// Name in SQL statements.
    pub name: String,
    pub content: TableContent,
}

/// Content of a table.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "queries need the feature data"))]
pub(super) enum TableContent {
    /// Features as they were read.
    Layer(Arc<Layer>),
    /// Layer of a GeoPackage, read from the file.
    GeoPackage { path: PathBuf, shown: String, layer: String },
    /// List of the script.
    List(ScriptList),
    /// Table on a database server.
    #[cfg(feature = "postgis")]
    Server(Arc<Server>),
}

/// Tables of a run, in loading order.
#[derive(Default)]
pub(super) struct SourceTables {
    pub(super) loaded: Vec<SourceTable>,
    #[cfg(feature = "data")]
    pub(super) database: Option<SourceDatabase>,
    /// Servers that have been queried.
    #[cfg(feature = "postgis")]
    servers: Vec<Arc<Server>>,
}

impl SourceTables {
    /// Adds a source.
    pub(super) fn add(&mut self, table: SourceTable) {
        self.loaded.push(table);
    }

    /// Returns the lists of the script, by the names of their tables.
    pub(super) fn lists(&self) -> Vec<(String, Arc<dyn FeatureSource>)> {
        let list = |table: &SourceTable| match &table.content {
            TableContent::List(list) => {
                let layer = list.to_layer(&table.name, table.name.clone(), [0.0; 2]);
                Some((layer.name.clone(), Arc::new(layer) as Arc<dyn FeatureSource>))
            }
            _ => None,
        };
        self.loaded.iter().filter_map(list).collect()
    }

    /// Returns the server at an address, with the time limit `most` for each query.
    #[cfg(feature = "postgis")]
    pub(super) fn server(&mut self, address: &ServerAddress, most: Duration) -> Arc<Server> {
        let known = self.servers.iter().position(|known| known.address() == address);
        let index = known.unwrap_or_else(|| {
            self.servers.push(Arc::new(Server::new(address, Some(most))));
            self.servers.len() - 1
        });
        Arc::clone(&self.servers[index])
    }

    /// Returns the server of a table that a statement names.
    #[cfg(feature = "postgis")]
    pub(super) fn named_server(&self, statement: &str) -> Option<Arc<Server>> {
        self.loaded.iter().find_map(|table| match &table.content {
            TableContent::Server(server) if crate::sql::names_table(statement, &table.name) => {
                Some(Arc::clone(server))
            }
            _ => None,
        })
    }
}
