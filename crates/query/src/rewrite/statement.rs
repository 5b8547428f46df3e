//! A statement that is rewritten, and what is known of the tables that it is about.

use std::collections::BTreeMap;

use super::chosen::{self, ChosenRows};
use super::made::{self, MadeTable};
use super::parse::{self, SyntaxTree, parse};
use super::types::{ColumnTypes, SqlType};
use super::walk::{StatementPartMut, walk_mut};
use super::{distinct, joins, lateral, least, nearest, order, rows, scope, typing, windows};
use burgeon_base::error::Result;
use sqlparser::ast::{Expr, Query, SelectItem, SetExpr};

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
    /// The types of the columns, as far as they are known.
    pub kinds: Vec<SqlType>,
    /// How many rows it has.
    pub rows: usize,
    /// Its schema and its name there, on a server.
    pub place: Option<(String, String)>,
    /// Whether it is the same table as another one, whose name is shorter.
    pub is_alias: bool,
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
    /// The tables that are made of subqueries first.
    pub made: Vec<MadeTable>,
    /// Whether the rows come in an order that the statement decides.
    pub ordered: bool,
    /// The columns of the rows, if they are known.
    pub columns: ColumnTypes,
    /// Their names where a statement gives none, as PostgreSQL has them.
    pub names: Vec<Option<String>>,
}

/// Rewrites a statement for who is asked; `None` if it cannot be read here, which does not mean that it is wrong. Fails if
/// it compares or computes with what it cannot, or asks for what there is only on a server.
///
/// Of tables among `chosen`, no more is seen than these statements give.
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

/// The names of columns that are no columns of tables and have none of their own; empty where a star hides how many there
/// are.
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

/// Has a server give boxes as geometries: it has no binary form of them.
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
