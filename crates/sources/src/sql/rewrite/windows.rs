//! Other differences of SQLite: clusters over windows, and names for the columns of subqueries.

use sqlparser::ast::{
    Expr, Function, FunctionArguments, Ident, Query, SelectItem, SetExpr, TableAliasColumnDef, TableFactor,
    WindowSpec, WindowType,
};

use super::Catalogue;
use super::parse;
use super::scope::relations;
use super::substitute::{each_query, factors, select_of, set_alias};
use super::typing::{column_name, error_at};
use super::walk::walk_expressions;
use crate::sql::statement_text::quote_name;
use burgeon_base::error::Result;

/// Rewrites `ST_ClusterDBSCAN(...) OVER (...)` as the cluster of a row among those of its partition.
pub(super) fn cluster(query: &mut Query, tables: &Catalogue) -> Result<()> {
    each_query(query, |query| {
        let Some(select) = select_of(query) else { return Ok(()) };
        let keys: Vec<String> = relations(select, tables)
            .iter()
            .map(|relation| {
                let (alias, key) = (relation.alias.as_ref()?, relation.table?.key.as_ref()?);
                Some(format!("{}.{}", quote_name(&alias.value), quote_name(key)))
            })
            .collect::<Option<_>>()
            .unwrap_or_default();
        let mut wrong = None;
        for item in &mut select.projection {
            let (SelectItem::UnnamedExpr(expression) | SelectItem::ExprWithAlias { expr: expression, .. }) =
                item
            else {
                continue;
            };
            let written = column_name(expression);
            let mut changed = false;
            walk_expressions(expression, &mut |part: &mut Expr| {
                let Expr::Function(Function { name, args: FunctionArguments::List(list), over, .. }) = &*part
                else {
                    return;
                };
                if !name.to_string().eq_ignore_ascii_case("st_clusterdbscan") {
                    return;
                }
                let Some(WindowType::WindowSpec(WindowSpec { partition_by, order_by, .. })) = over else {
                    wrong.get_or_insert_with(|| {
                        error_at(part, "ST_ClusterDBSCAN needs a window")
                            .help("write ST_ClusterDBSCAN(geom, distance, points) OVER ()")
                    });
                    return;
                };
                let parts: Vec<String> = partition_by.iter().map(ToString::to_string).collect();
                let parts = match parts.is_empty() {
                    true => String::new(),
                    false => format!("PARTITION BY {} ", parts.join(", ")),
                };
                let own: Vec<String> = order_by.iter().map(ToString::to_string).collect();
                let first = list.args.first().map(ToString::to_string);
                let mut order: Vec<&str> = own.iter().chain(&keys).map(String::as_str).collect();
                if order.is_empty() {
                    order.extend(first.as_deref());
                }
                let window = format!("{parts}ORDER BY {}", order.join(", "));
                changed = true;
                if let Some(made) = parse::expression(&format!(
                    "burgeon_cluster(burgeon_clusters({list}) OVER ({window} ROWS BETWEEN UNBOUNDED PRECEDING AND \
                     UNBOUNDED FOLLOWING), row_number() OVER ({window}))"
                )) {
                    *part = made;
                }
            });
            if let (SelectItem::UnnamedExpr(_), true) = (&*item, changed) {
                set_alias(item, Ident::with_quote('"', written));
            }
        }
        wrong.map_or(Ok(()), Err)
    })
}

/// Gives the columns of subqueries after FROM the names that follow their aliases.
pub(super) fn rename(query: &mut Query) -> Result<()> {
    each_query(query, |query| {
        let Some(select) = select_of(query) else { return Ok(()) };
        for factor in factors(select) {
            let TableFactor::Derived { subquery, alias: Some(alias), .. } = factor else { continue };
            if alias.columns.is_empty() {
                continue;
            }
            if name_columns(subquery, &alias.columns) {
                alias.columns.clear();
            }
        }
        Ok(())
    })
}

fn name_columns(subquery: &mut Query, names: &[TableAliasColumnDef]) -> bool {
    match &mut *subquery.body {
        SetExpr::Select(select) => {
            let plain = select
                .projection
                .iter()
                .all(|item| matches!(item, SelectItem::UnnamedExpr(_) | SelectItem::ExprWithAlias { .. }));
            if !plain || names.len() > select.projection.len() {
                return false;
            }
            for (item, name) in select.projection.iter_mut().zip(names) {
                set_alias(item, name.name.clone());
            }
            true
        }
        SetExpr::Values(values) => {
            let count = values.rows.first().map_or(0, |row| row.content.len());
            let column = |index: usize| {
                let name = names.get(index).map(|column| column.name.to_string());
                format!("column{} AS {}", index + 1, name.unwrap_or_else(|| format!("column{}", index + 1)))
            };
            let columns: Vec<String> = (0..count).map(column).collect();
            match parse::parse(&format!("SELECT {} FROM ({subquery})", columns.join(", "))) {
                Ok(made) => {
                    *subquery = *made.query;
                    true
                }
                Err(_) => false,
            }
        }
        _ => false,
    }
}
