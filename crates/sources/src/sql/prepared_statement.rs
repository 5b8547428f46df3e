//! Statements that are prepared for running.

use std::sync::{Arc, OnceLock};

use crate::sql::rewrite::RewrittenQuery;

/// A statement that is prepared for running.
pub(crate) struct PreparedStatement {
    /// Statement as written.
    pub original: Arc<str>,
    /// Generation of the tables for which it was prepared.
    pub generation: usize,
    /// Rewritten statement, if the original could be parsed.
    pub rewritten: Option<RewrittenQuery>,
    /// Columns and parameters, computed when the statement first runs.
    pub shape: OnceLock<StatementShape>,
}

/// The type of a column that SQLite stores differently.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum AnswerColumn {
    /// Value as SQLite stores it.
    Plain,
    /// Boolean, stored as 1 or 0.
    Boolean,
    /// List, stored as JSON.
    List,
}

/// The columns and parameters of a statement.
pub(crate) struct StatementShape {
    /// Names of the columns.
    pub names: Arc<[Arc<str>]>,
    /// Types of the columns.
    pub kinds: Vec<AnswerColumn>,
    /// Names of the parameters, by number.
    pub parameters: Vec<Option<String>>,
}
