//! A statement that is rewritten, and what is known of the tables that it is about.

use std::collections::BTreeMap;

use super::chosen::{self, ChosenRows};
use super::parse::{SyntaxTree, parse};
use super::walk::{StatementPartMut, walk_mut};
use super::{joins, nearest, operators, order, scope};
use sqlparser::ast::{Query, SelectItem, SetExpr};

/// How much stack (bytes) the parser and what works on its trees have: as deep as a statement of so many words can be.
const STACK: usize = 256 << 20;

/// What is known of a table.
#[derive(Debug, Clone, Default)]
pub(crate) struct TableInfo {
    /// Its name.
    pub name: String,
    /// The column of whole numbers that tells its rows apart.
    pub key: Option<String>,
    /// The columns with geometries.
    pub geometries: Vec<String>,
    /// All columns.
    pub columns: Vec<String>,
    /// How many rows it has.
    pub rows: usize,
}

impl TableInfo {
    /// Whether it has a column called `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|known| known.eq_ignore_ascii_case(name))
    }

    /// Its column of geometries called `name`.
    pub(super) fn geometry(&self, name: &str) -> Option<&str> {
        self.geometries.iter().find(|known| known.eq_ignore_ascii_case(name)).map(String::as_str)
    }
}

/// Tables by their names in small letters.
pub(crate) type Catalogue = BTreeMap<String, TableInfo>;

/// Who is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dialect {
    /// The database within the program.
    Sqlite,
    /// A PostGIS server.
    #[cfg(feature = "postgis")]
    Postgis,
}

/// A statement that is ready to be asked.
#[derive(Debug, Clone, Default)]
pub(crate) struct RewrittenQuery {
    /// What is asked.
    pub sql: String,
    /// Whether an index is used that the statement as it was written would not use.
    pub indexed: bool,
    /// These indexes, by table and column, and whether each is asked for the nearest.
    pub indexes: Vec<(String, bool)>,
    /// Whether the rows come in an order that the statement decides.
    pub ordered: bool,
    /// Which columns are true or false; empty if that is not known.
    pub booleans: Vec<bool>,
}

/// Rewrites a statement for who is asked; `None` if it cannot be read here, which does not mean that it is wrong.
///
/// Of tables among `chosen`, no more is seen than these statements give.
pub(crate) fn rewrite(
    sql: &str,
    catalogue: &Catalogue,
    chosen: &ChosenRows,
    dialect: Dialect,
) -> Option<RewrittenQuery> {
    with_stack(|| {
        let mut tree = parse(sql).ok()?;
        Some(rewritten(&mut tree, catalogue, chosen, dialect))
    })
    .flatten()
}

/// Runs `work` with as much stack as a statement may need.
pub(super) fn with_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().name("sql".into()).stack_size(STACK);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

/// Rewrites what was parsed.
fn rewritten(
    parsed: &mut SyntaxTree,
    catalogue: &Catalogue,
    chosen: &ChosenRows,
    dialect: Dialect,
) -> RewrittenQuery {
    let booleans = booleans(&parsed.query);
    if dialect == Dialect::Sqlite {
        operators::translate(&mut parsed.query);
    }
    let tables = scope::visible(&parsed.query, catalogue);
    let ordered = parsed.query.order_by.is_some() || parsed.query.limit_clause.is_some();
    let mut indexes = Vec::new();
    walk_mut(&mut parsed.query, |part| match part {
        StatementPartMut::Select(select) if dialect == Dialect::Sqlite => {
            indexes.extend(joins::index(select, &tables).into_iter().map(|name| (name, false)));
        }
        StatementPartMut::Query(query) => {
            let nearest = if dialect == Dialect::Sqlite { nearest::index(query, &tables) } else { None };
            match nearest {
                Some(name) => indexes.push((name, true)),
                None => order::settle(query, &tables, dialect),
            }
        }
        _ => {}
    });
    chosen::put_in(&mut parsed.query, &tables, chosen);
    RewrittenQuery { indexed: !indexes.is_empty(), indexes, ordered, booleans, sql: parsed.query.to_string() }
}

/// Which columns of the result are true or false; empty where a star hides how many there are.
fn booleans(query: &Query) -> Vec<bool> {
    let SetExpr::Select(select) = &*query.body else { return Vec::new() };
    let column = |item: &SelectItem| match item {
        SelectItem::UnnamedExpr(expression) | SelectItem::ExprWithAlias { expr: expression, .. } => {
            Some(operators::is_boolean(expression))
        }
        _ => None,
    };
    select.projection.iter().map(column).collect::<Option<_>>().unwrap_or_default()
}
