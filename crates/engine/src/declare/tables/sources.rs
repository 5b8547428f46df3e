//! Sources that the scripts of a run have loaded.

use std::path::PathBuf;
use std::sync::Arc;
#[cfg(feature = "postgis")]
use std::time::Duration;

#[cfg(feature = "data")]
use super::database::SourceDatabase;
use burgeon_data::output::{Record, RecordTable};
use burgeon_data::{Feature, Layer};
#[cfg(feature = "postgis")]
use burgeon_query::postgis::{Server, ServerAddress};

/// Source as a table.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(in crate::declare) struct SourceTable {
    /// Name in SQL statements.
    pub name: String,
    pub content: TableContent,
}

/// Content of a table.
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(in crate::declare) enum TableContent {
    /// Features as they were read.
    Layer(Arc<Layer>),
    /// Layer of a GeoPackage, read from the file.
    GeoPackage { path: PathBuf, shown: String, layer: String },
    /// List of the script, in metres around the origin of the run.
    List(ListTable),
    /// Table on a database server.
    #[cfg(feature = "postgis")]
    Server(Arc<Server>),
}

/// List of features that the script made.
#[derive(Debug, Default)]
#[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nobody can ask"))]
pub(crate) struct ListTable {
    /// Attribute names.
    pub names: Vec<String>,
    pub features: Vec<Feature>,
}

impl ListTable {
    /// Returns the features as records.
    pub(super) fn records(&self, name: &str) -> RecordTable {
        let record = |feature: &Feature| Record {
            id: feature.id.as_str().to_owned(),
            geometry: Some(feature.geometry.clone()),
            values: feature.attributes.to_vec(),
        };
        let records = self.features.iter().map(record).collect();
        RecordTable { name: name.to_owned(), columns: self.names.clone(), records }
    }
}

/// Tables of a run, in loading order.
#[derive(Default)]
pub(in crate::declare) struct SourceTables {
    pub(super) loaded: Vec<SourceTable>,
    #[cfg(feature = "data")]
    pub(super) database: Option<SourceDatabase>,
    /// Servers that have been queried.
    #[cfg(feature = "postgis")]
    servers: Vec<Arc<Server>>,
}

impl SourceTables {
    /// Adds a source.
    pub(in crate::declare) fn add(&mut self, table: SourceTable) {
        self.loaded.push(table);
    }

    /// Returns the lists of the script.
    pub(in crate::declare) fn lists(&self) -> Vec<RecordTable> {
        let list = |table: &SourceTable| match &table.content {
            TableContent::List(list) => Some(list.records(&table.name)),
            _ => None,
        };
        self.loaded.iter().filter_map(list).collect()
    }

    /// Returns the server at an address, with the time limit `most` for each query.
    #[cfg(feature = "postgis")]
    pub(in crate::declare) fn server(&mut self, address: &ServerAddress, most: Duration) -> Arc<Server> {
        if let Some(known) = self.servers.iter().find(|known| known.address() == address) {
            return Arc::clone(known);
        }
        let server = Arc::new(Server::new(address, Some(most)));
        self.servers.push(Arc::clone(&server));
        server
    }

    /// Returns the server of a table that a statement names.
    #[cfg(feature = "postgis")]
    pub(super) fn asked_server(&self, sql: &str) -> Option<Arc<Server>> {
        self.loaded.iter().find_map(|table| match &table.content {
            TableContent::Server(server) if burgeon_query::names_table(sql, &table.name) => {
                Some(Arc::clone(server))
            }
            _ => None,
        })
    }
}
