//! A question, its answer, and who answers.

use std::borrow::Cow;
use std::fmt;
use std::hash::{BuildHasher as _, Hash, Hasher};
use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_kit::{Table, TableKey, Value};
use burgeon_rewriting::NameScope;
use rustc_hash::FxBuildHasher;

use burgeon_analysis::sql_parameters;

/// A text of SQL with the values of its parameters. Two are equal if they ask the same.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Question {
    /// What it adds to a hash: its values may be large, and lists of many questions ask for it again and again.
    hash: u64,
    sql: Arc<str>,
    values: Option<Arc<Table>>,
    /// Package or script that asks, where packages may have modules of one name.
    scope: Option<Arc<NameScope>>,
}

impl Hash for Question {
    fn hash<H: Hasher>(&self, state: &mut H) {
        state.write_u64(self.hash);
    }
}

impl Question {
    /// Asks `sql`, whose parameters have these `values`, by name; those that are not there are NULL.
    pub fn new(sql: Arc<str>, values: Option<Arc<Table>>) -> Self {
        let values = values.filter(|values| !values.entries.is_empty());
        Self { hash: FxBuildHasher.hash_one((&sql, &values)), sql, values, scope: None }
    }

    /// Returns the question as a package or the script asks it, whose modules its names mean.
    pub(crate) fn asked_in(mut self, scope: Option<Arc<NameScope>>) -> Self {
        self.scope = scope;
        self
    }

    /// Returns who asks, where packages may have modules of one name.
    #[cfg(feature = "data")]
    pub(crate) fn scope(&self) -> Option<&NameScope> {
        self.scope.as_deref()
    }

    /// Returns the text as a statement: the name of a table alone asks for all of its rows.
    pub fn statement(&self) -> Cow<'_, str> {
        let name = self.sql.trim();
        let is_name = |part: &str| {
            part.starts_with(|letter: char| letter.is_alphabetic() || letter == '_')
                && part.chars().all(|letter| letter.is_alphanumeric() || letter == '_')
        };
        // Names of packages may have hyphens.
        let is_table = match name.split_once('.') {
            Some((schema, table)) => is_name(&schema.replace('-', "_")) && is_name(table),
            None => is_name(name),
        };
        match is_table {
            true => format!("SELECT * FROM \"{}\"", name.replacen('.', "\".\"", 1)).into(),
            false => (&*self.sql).into(),
        }
    }

    /// The text.
    pub fn sql(&self) -> &str {
        &self.sql
    }

    /// The values of all parameters that the text names; [`Value::Nil`] for NULL.
    pub fn values(&self) -> Result<Vec<(&str, Value)>> {
        let of = |name: &str| self.values.as_deref().and_then(|values| values.get(name)).cloned();
        Ok(sql_parameters(&self.sql)?
            .into_iter()
            .map(|name| (name, of(name).unwrap_or(Value::Nil)))
            .collect())
    }
}

impl fmt::Display for Question {
    /// The text, and behind it the values that its parameters have.
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

/// What a question is answered with: rows in their order, each with a value for every name.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rows {
    /// The names of the columns.
    pub names: Vec<Arc<str>>,
    /// The values, row by row; [`Value::Nil`] for NULL.
    pub values: Vec<Value>,
}

impl Rows {
    /// How many there are.
    pub fn len(&self) -> usize {
        self.values.len() / self.names.len().max(1)
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.values.is_empty()
    }

    /// Each row.
    pub fn iter(&self) -> impl Iterator<Item = &[Value]> {
        self.values.chunks_exact(self.names.len().max(1))
    }

    /// The column that tells rows apart, if there is one.
    pub fn id(&self) -> Option<usize> {
        const IDS: [&str; 3] = ["fid", "id", "ogc_fid"];
        IDS.iter().find_map(|id| self.names.iter().position(|name| name.eq_ignore_ascii_case(id)))
    }

    /// By column: whether it holds geometries.
    pub fn geometries(&self) -> Vec<bool> {
        let of = |column: usize| self.iter().map(move |row| &row[column]);
        let is_of_geometries = |column| {
            of(column)
                .find(|value| !matches!(value, Value::Nil))
                .is_some_and(|value| matches!(value, Value::Object(_)))
        };
        (0..self.names.len()).map(is_of_geometries).collect()
    }
}

/// Answers questions: a database, or something in the place of one.
pub trait RowSource: Send + Sync {
    /// The rows that answer `question`, at most `most` of them, always in the same order.
    fn rows(&self, question: &Question, most: usize) -> Result<Rows>;
}

impl fmt::Debug for dyn RowSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("RowSource")
    }
}
