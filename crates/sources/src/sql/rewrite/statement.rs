//! The rewriting of a statement, and the description of its tables.

use super::catalogue::{Catalogue, Dialect};
use super::chosen::{self, ChosenRows};
use super::made::{self, MadeTable};
use super::parse::{self, SyntaxTree, parse, with_stack};
use super::types::ColumnTypes;
use super::walk::{StatementPartMut, walk_mut};
use super::{distinct, joins, lateral, least, nearest, order, rows, scope, typing, windows};
use burgeon_base::error::Result;
use sqlparser::ast::{Expr, Query, SelectItem, SetExpr};

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
        rewrite_parsed(&mut tree, catalogue, chosen, dialect).map(Some)
    });
    done.unwrap_or(Ok(None))
}

/// Rewrites a parsed statement.
fn rewrite_parsed(
    parsed: &mut SyntaxTree,
    catalogue: &Catalogue,
    chosen: &ChosenRows,
    dialect: Dialect,
) -> Result<RewrittenQuery> {
    let query = &mut parsed.query;
    let names = names(query);
    let mut tables = scope::visible_tables(query, catalogue);
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
