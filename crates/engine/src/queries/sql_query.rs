//! Query, result, and source of rows.

use std::borrow::Cow;
use std::fmt;
use std::hash::{BuildHasher as _, Hash, Hasher};
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_kit::{QueryRows, Table, TableKey, Value};
use burgeon_rewriting::NameScope;
use rustc_hash::FxBuildHasher;

use burgeon_language::analysis::sql_parameters;

/// SQL text with the values of its parameters. Two queries are equal if text, values and scope are equal.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SqlQuery {
    /// Cached hash of text and values: values can be large, and lookups need the hash repeatedly.
    hash: u64,
    sql: Arc<str>,
    values: Option<Arc<Table>>,
    /// Package or script that runs the query, if packages can have modules of the same name.
    scope: Option<Arc<NameScope>>,
}

impl Hash for SqlQuery {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}

impl SqlQuery {
    /// Creates a query with the text `sql` and parameter `values` by name. Missing values are NULL.
    pub fn new(sql: Arc<str>, values: Option<Arc<Table>>) -> Self {
        let values = values.filter(|values| !values.entries.is_empty());
        Self { hash: FxBuildHasher.hash_one((&sql, &values)), sql, values, scope: None }
    }

    /// Returns the query with the scope in which its names of modules are resolved.
    pub(crate) fn asked_in(mut self, scope: Option<Arc<NameScope>>) -> Self {
        self.scope = scope;
        self
    }

    /// Returns the scope in which names of modules are resolved.
    pub(crate) fn scope(&self) -> Option<&NameScope> {
        self.scope.as_deref()
    }

    /// Returns the text as a statement: the name of a table alone selects all rows.
    pub fn statement(&self) -> Cow<'_, str> {
        let name = self.sql.trim();
        let is_name = |part: &str| {
            part.starts_with(|letter: char| letter.is_alphabetic() || letter == '_')
                && part.chars().all(|letter| letter.is_alphanumeric() || letter == '_')
        };
        // Names of packages can have hyphens.
        let is_table = match name.split_once('.') {
            Some((schema, table)) => is_name(&schema.replace('-', "_")) && is_name(table),
            None => is_name(name),
        };
        match is_table {
            true => format!("SELECT * FROM \"{}\"", name.replacen('.', "\".\"", 1)).into(),
            false => (&*self.sql).into(),
        }
    }

    /// Returns the text.
    pub fn sql(&self) -> &str {
        &self.sql
    }

    /// Returns the values of all parameters that the text names; [`Value::Nil`] for NULL.
    pub fn values(&self) -> Result<Vec<(&str, Value)>> {
        let of = |name: &str| self.values.as_deref().and_then(|values| values.get(name)).cloned();
        Ok(sql_parameters(&self.sql)?
            .into_iter()
            .map(|name| (name, of(name).unwrap_or(Value::Nil)))
            .collect())
    }
}

impl fmt::Display for SqlQuery {
    /// Writes the text, followed by the parameter values.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.sql)?;
        let entries = self.values.iter().flat_map(|values| &values.entries);
        for (index, (key, value)) in entries.enumerate() {
            if let TableKey::Name(name) = key {
                write!(f, "{}${name} = {value}", if index == 0 { " with " } else { ", " })?;
            }
        }
        Ok(())
    }
}

/// Source of query results, such as a database.
pub trait RowSource: Send + Sync {
    /// Returns the rows of `question`, at most `most`, always in the same order.
    fn rows(&self, question: &SqlQuery, most: usize) -> Result<QueryRows>;
}

impl fmt::Debug for dyn RowSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("RowSource")
    }
}
