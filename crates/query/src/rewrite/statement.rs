//! The rewriting of a statement, and the description of its tables.

use std::collections::BTreeMap;

use super::chosen::{self, ChosenRows};
use super::made::{self, MadeTable};
use super::parse::{self, SyntaxTree, parse};
use super::types::{ColumnTypes, SqlType};
use super::walk::{StatementPartMut, walk_mut};
use super::{distinct, joins, lateral, least, nearest, order, rows, scope, typing, windows};
use burgeon_base::error::Result;
use sqlparser::ast::{Expr, Query, SelectItem, SetExpr};

/// Stack size (bytes) for the parser and for work on its trees: enough for the deepest statement of the maximum length.
const STACK: usize = 256 << 20;

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

/// A statement that is ready to run.
#[derive(Debug, Clone, Default)]
pub(crate) struct RewrittenQuery {
    /// SQL to run.
    pub sql: String,
    /// Set if the statement uses an index that the original would not use.
    pub indexed: bool,
    /// Indexes, by table and column, each with a flag for nearest-neighbour searches.
    pub indexes: Vec<(String, bool)>,
    /// Subqueries to materialize first.
    pub made: Vec<MadeTable>,
    /// Set if the statement determines the order of the rows.
    pub ordered: bool,
    /// Columns of the rows, if known.
    pub columns: ColumnTypes,
    /// Names of columns without a name in the statement, as PostgreSQL names them.
    pub names: Vec<Option<String>>,
}

/// Rewrites a statement for a database. Returns `None` if it cannot be parsed here, although it may be valid. Fails if
/// it compares or computes with values of wrong types, or uses features that only servers support.
///
/// Limits the tables among `chosen` to the rows of their statements.
pub(crate) fn rewrite(
    sql: &str,
    catalogue: &Catalogue,
    chosen: &ChosenRows,
    dialect: Dialect,
) -> Result<Option<RewrittenQuery>> {
    let done = with_stack(|| {
        let Ok(mut tree) = parse(sql) else { return Ok(None) };
        rewritten(&mut tree, catalogue, chosen, dialect).map(Some)
    });
    done.unwrap_or(Ok(None))
}

/// Runs `work` with the stack that a statement may need.
pub(super) fn with_stack<T: Send>(work: impl FnOnce() -> T + Send) -> Option<T> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().name("sql".into()).stack_size(STACK);
        thread.spawn_scoped(scope, work).ok()?.join().ok()
    })
}

/// Rewrites a parsed statement.
fn rewritten(
    parsed: &mut SyntaxTree,
    catalogue: &Catalogue,
    chosen: &ChosenRows,
    dialect: Dialect,
) -> Result<RewrittenQuery> {
    let query = &mut parsed.query;
    let names = names(query);
    let mut tables = scope::visible(query, catalogue);
    let mut columns = None;
    let mut made = Vec::new();
    if dialect == Dialect::Sqlite {
        rows::expand(query, &tables)?;
        lateral::flatten(query, &tables)?;
        windows::cluster(query, &tables)?;
        windows::rename(query)?;
        columns = typing::type_query(query, &tables)?;
        distinct::rewrite(query, &tables)?;
        walk_mut(query, |part| {
            if let StatementPartMut::Query(query) = part {
                least::rewrite(query, &tables);
            }
        });
    } else {
        extent(query);
    }
    let ordered = query.order_by.is_some() || query.limit_clause.is_some();
    let mut indexes = Vec::new();
    if dialect == Dialect::Sqlite {
        walk_mut(query, |part| {
            if let StatementPartMut::Query(query) = part {
                made::inline(query, &tables);
            }
        });
    }
    walk_mut(query, |part| match part {
        StatementPartMut::Select(select) if dialect == Dialect::Sqlite => {
            made.extend(made::make(select, &mut tables));
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
    chosen::put_in(query, &tables, chosen);
    Ok(RewrittenQuery {
        indexed: !indexes.is_empty(),
        indexes: indexes
            .into_iter()
            .filter(|(name, _): &(String, bool)| !name.starts_with("burgeon_made_"))
            .collect(),
        made,
        ordered,
        columns,
        names,
        sql: query.to_string(),
    })
}

/// Returns the names of columns that are neither table columns nor have an alias. Empty if a star hides the number of
/// columns.
fn names(query: &Query) -> Vec<Option<String>> {
    let SetExpr::Select(select) = &*query.body else { return Vec::new() };
    let name = |item: &SelectItem| match item {
        SelectItem::UnnamedExpr(Expr::Identifier(_) | Expr::CompoundIdentifier(_)) => Some(None),
        SelectItem::UnnamedExpr(expression) => Some(Some(typing::column_name(expression))),
        SelectItem::ExprWithAlias { .. } => Some(None),
        _ => None,
    };
    select.projection.iter().map(name).collect::<Option<_>>().unwrap_or_default()
}

/// Casts boxes to geometries on a server, because boxes have no binary format.
fn extent(query: &mut Query) {
    let change = |part: StatementPartMut<'_>| {
        if let StatementPartMut::Select(select) = part {
            for item in &mut select.projection {
                let (SelectItem::UnnamedExpr(expr) | SelectItem::ExprWithAlias { expr, .. }) = item else {
                    continue;
                };
                let is_box = matches!(expr, Expr::Function(function)
                    if function.name.to_string().eq_ignore_ascii_case("st_extent"));
                if is_box && let Some(made) = parse::expression(&format!("{expr}::geometry")) {
                    let alias = sqlparser::ast::Ident::new(typing::column_name(expr));
                    match item {
                        SelectItem::UnnamedExpr(_) => *item = SelectItem::ExprWithAlias { expr: made, alias },
                        SelectItem::ExprWithAlias { expr, .. } => *expr = made,
                        _ => {}
                    }
                }
            }
        }
    };
    walk_mut(query, change);
}
