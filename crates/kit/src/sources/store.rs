//! Sources that the scripts of one run have loaded.

use std::any::Any;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use super::{FeatureSource, QueryRows};
use crate::contract::{LoadServices, Resources, Table, Value};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// Loaded sources of a run. All virtual machines of a run call it in the same order; equal calls return the same source.
pub trait SourceStore: Send + Sync {
    /// Loads the features of `source(text, options)`.
    fn load(
        &self,
        request: &SourceRequest<'_>,
        text: &str,
        options: Option<&Table>,
    ) -> Result<Arc<dyn FeatureSource>>;

    /// Checks the options of `source(features, options)`, in which `features` is a list of the script. If `keeps` is set, adds
    /// the list as a table for queries.
    fn list(&self, features: &Value, options: &Table, keeps: bool) -> Result<()>;

    /// Returns the lists that were added, by the names of their tables.
    fn lists(&self) -> Vec<(String, Arc<dyn FeatureSource>)>;

    /// Returns the rows of a query, at most `query.most`, always in the same order.
    fn rows(&self, request: &SourceRequest<'_>, query: &SourceQuery<'_>) -> Result<QueryRows>;

    /// Calls `act` with the values that loaders of objects share with sources, such as the projection of the run.
    fn with_services(&self, act: &mut dyn FnMut(&mut dyn LoadServices));

    /// Returns copies of the values that exports need, such as the projection of the run.
    fn results(&self) -> Vec<Box<dyn Any + Send + Sync>>;

    /// Returns the paths of the companion files that are read with the file at `path`, also of missing ones.
    fn companions(&self, path: &Path) -> Vec<PathBuf>;
}

/// Resources of a run for loading and querying sources.
pub struct SourceRequest<'a> {
    /// Files and messages of the run.
    pub resources: &'a dyn Resources,
    /// Name of the package whose file makes the request; `None` for the script.
    pub package: Option<&'a str>,
    /// Memory and time budget for reading.
    pub budget: &'a Arc<Budget>,
    /// Addresses of the databases that the script may query.
    pub databases: &'a [String],
    /// Time limit of a request to a server.
    pub time: Duration,
    /// Set to fail if a feature cannot be read.
    pub is_strict: bool,
}

/// SQL query with its values.
pub struct SourceQuery<'a> {
    /// Statement.
    pub statement: &'a str,
    /// Values of the parameters in the statement, by name.
    pub values: &'a [(&'a str, Value)],
    /// Modules of the chains that the statement names.
    pub modules: &'a [&'a dyn ModuleTable],
    /// Maximum number of rows.
    pub most: usize,
}

/// Modules of one symbol in the chains of a run, as a table for queries.
pub trait ModuleTable {
    /// Returns the word by which the query names the modules.
    fn word(&self) -> &str;

    /// Returns the name of the table, unique in the run.
    fn name(&self) -> &str;

    /// Returns the names of the parameters.
    fn columns(&self) -> &[String];

    /// Returns the number of the chains' state. Tables of equal states are equal.
    fn state(&self) -> u64;

    /// Calls `visit` with the parameters of each module, or with `true` for each module without parameters.
    fn values(&self, visit: &mut dyn FnMut(Value));
}
