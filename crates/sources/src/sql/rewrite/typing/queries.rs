//! The types of queries: of the columns that they return, and of the expressions in their clauses.

use sqlparser::ast::{
    Expr, GroupByExpr, LimitClause, OrderBy, OrderByExpr, OrderByKind, Query, Select, SelectItem,
    SelectItemQualifiedWildcardKind, SetExpr, TableAliasColumnDef, TableFactor, Value,
};

use super::column_name::column_name;
use super::scope::{TypeScope, TypedRelation, Typing};
use crate::sql::rewrite::Catalogue;
use crate::sql::rewrite::scope::{alias_of, condition_mut};
use crate::sql::rewrite::types::{ColumnTypes, SqlType};
use burgeon_base::error::Result;

/// Types a statement, and returns the columns of its rows.
pub(in crate::sql::rewrite) fn type_query(query: &mut Query, tables: &Catalogue) -> Result<ColumnTypes> {
    let nothing = TypeScope { relations: Vec::new(), outer: None };
    Typing { tables, declared: Vec::new() }.query(query, &nothing)
}

impl Typing<'_> {
    pub(super) fn query(&mut self, query: &mut Query, outer: &TypeScope<'_>) -> Result<ColumnTypes> {
        let known = self.declared.len();
        if let Some(with) = &mut query.with {
            for table in &mut with.cte_tables {
                let name = table.alias.name.value.to_ascii_lowercase();
                if with.recursive {
                    self.declared.push((name, None));
                    let columns = rename(self.query(&mut table.query, outer)?, &table.alias.columns);
                    if let Some(own) = self.declared.last_mut() {
                        own.1 = columns;
                    }
                } else {
                    let columns = rename(self.query(&mut table.query, outer)?, &table.alias.columns);
                    self.declared.push((name, columns));
                }
            }
        }
        limit(query);
        let columns = self.body(&mut query.body, query.order_by.as_mut(), outer)?;
        if let Some(LimitClause::LimitOffset { limit, offset, .. }) = &mut query.limit_clause {
            for count in limit.iter_mut().chain(offset.as_mut().map(|offset| &mut offset.value)) {
                self.expression(count, outer)?;
            }
        }
        self.declared.truncate(known);
        Ok(columns)
    }

    fn body(
        &mut self,
        body: &mut SetExpr,
        order: Option<&mut OrderBy>,
        outer: &TypeScope<'_>,
    ) -> Result<ColumnTypes> {
        match body {
            SetExpr::Select(select) => self.select(select, order, outer),
            SetExpr::Query(query) => self.query(query, outer),
            SetExpr::SetOperation { left, right, .. } => {
                let (left, right) = (self.body(left, None, outer)?, self.body(right, None, outer)?);
                Ok(left.zip(right).map(|(left, right)| {
                    let both = left.into_iter().zip(right);
                    both.map(|((name, a), (_, b))| (name, a.or(b))).collect()
                }))
            }
            SetExpr::Values(values) => {
                let mut kinds: Vec<SqlType> = Vec::new();
                for row in &mut values.rows {
                    for (index, value) in row.content.iter_mut().enumerate() {
                        let kind = self.expression(value, outer)?;
                        match kinds.get_mut(index) {
                            Some(known) => *known = known.or(kind),
                            None => kinds.push(kind),
                        }
                    }
                }
                let column =
                    |(index, kind): (usize, SqlType)| (format!("column{}", index + 1), column_type(kind));
                Ok(Some(kinds.into_iter().enumerate().map(column).collect()))
            }
            _ => Ok(None),
        }
    }

    fn select(
        &mut self,
        select: &mut Select,
        order: Option<&mut OrderBy>,
        outer: &TypeScope<'_>,
    ) -> Result<ColumnTypes> {
        let mut scope = TypeScope { relations: Vec::new(), outer: Some(outer) };
        for item in &mut select.from {
            let relation = self.relation(&mut item.relation, &scope)?;
            scope.relations.extend(relation);
            for join in &mut item.joins {
                let relation = self.relation(&mut join.relation, &scope)?;
                scope.relations.extend(relation);
            }
        }
        for item in &mut select.from {
            for join in &mut item.joins {
                if let Some(on) = condition_mut(&mut join.join_operator) {
                    self.condition(on, &scope, "JOIN/ON")?;
                }
            }
        }
        if let Some(selection) = &mut select.selection {
            self.condition(selection, &scope, "WHERE")?;
        }
        let mut columns = Some(Vec::new());
        for item in &mut select.projection {
            self.project(item, &scope, &mut columns)?;
        }
        if let GroupByExpr::Expressions(keys, _) = &mut select.group_by {
            for key in keys {
                self.expression(key, &scope)?;
            }
        }
        if let Some(having) = &mut select.having {
            self.condition(having, &scope, "HAVING")?;
        }
        for window in &mut select.named_window {
            if let sqlparser::ast::NamedWindowExpr::WindowSpec(spec) = &mut window.1 {
                self.window(spec, &scope)?;
            }
        }
        if let Some(sqlparser::ast::Distinct::On(keys)) = &mut select.distinct {
            for key in keys {
                self.expression(key, &scope)?;
            }
        }
        if let Some(OrderBy { kind: OrderByKind::Expressions(keys), .. }) = order {
            for OrderByExpr { expr, .. } in keys {
                self.expression(expr, &scope)?;
            }
        }
        Ok(columns)
    }

    /// Types an item of a projection, and adds its columns.
    fn project(
        &mut self,
        item: &mut SelectItem,
        scope: &TypeScope<'_>,
        columns: &mut ColumnTypes,
    ) -> Result<()> {
        let added = match item {
            SelectItem::UnnamedExpr(expression) => {
                let name = column_name(expression);
                let kind = self.expression(expression, scope)?;
                Some(vec![(name, column_type(kind))])
            }
            SelectItem::ExprWithAlias { expr, alias } => {
                let kind = self.expression(expr, scope)?;
                Some(vec![(alias.value.clone(), column_type(kind))])
            }
            SelectItem::Wildcard(_) => all(&scope.relations, |_| true),
            SelectItem::QualifiedWildcard(SelectItemQualifiedWildcardKind::ObjectName(name), _) => {
                let owner = name.0.last().and_then(|part| part.as_ident()).map(|name| &name.value);
                all(&scope.relations, |relation| match (&relation.alias, owner) {
                    (Some(alias), Some(owner)) => alias.eq_ignore_ascii_case(owner),
                    _ => false,
                })
            }
            _ => None,
        };
        match (columns.as_mut(), added) {
            (Some(known), Some(added)) => known.extend(added),
            _ => *columns = None,
        }
        Ok(())
    }

    fn relation(&mut self, factor: &mut TableFactor, scope: &TypeScope<'_>) -> Result<Vec<TypedRelation>> {
        let known = alias_of(factor).map(|alias| alias.value.clone());
        Ok(match factor {
            TableFactor::Table { name, alias, args: None, .. } => {
                let own = || name.0.last().and_then(|part| part.as_ident()).map(|name| name.value.clone());
                let columns = self.columns_of(name);
                let columns = rename(columns, alias.iter().flat_map(|alias| &alias.columns));
                vec![TypedRelation { alias: known.or_else(own), columns }]
            }
            TableFactor::Table { args: Some(args), .. } => {
                for argument in &mut args.args {
                    self.argument(argument, scope)?;
                }
                vec![TypedRelation { alias: known, columns: None }]
            }
            TableFactor::Derived { subquery, alias, .. } => {
                let nothing = TypeScope { relations: Vec::new(), outer: None };
                let outer = scope.outer.unwrap_or(&nothing);
                let columns = self.query(subquery, outer)?;
                let columns = rename(columns, alias.iter().flat_map(|alias| &alias.columns));
                vec![TypedRelation { alias: known, columns }]
            }
            TableFactor::NestedJoin { table_with_joins, .. } => {
                let mut relations = self.relation(&mut table_with_joins.relation, scope)?;
                for join in &mut table_with_joins.joins {
                    relations.extend(self.relation(&mut join.relation, scope)?);
                }
                relations
            }
            _ => vec![TypedRelation { alias: None, columns: None }],
        })
    }
}

/// Returns the type of a column; a quoted string becomes a string.
fn column_type(kind: SqlType) -> SqlType {
    if kind == SqlType::Literal { SqlType::Text } else { kind }
}

fn rename<'a>(columns: ColumnTypes, names: impl IntoIterator<Item = &'a TableAliasColumnDef>) -> ColumnTypes {
    let mut columns = columns?;
    columns.iter_mut().zip(names).for_each(|(column, name)| column.0.clone_from(&name.name.value));
    Some(columns)
}

fn all(relations: &[TypedRelation], meant: impl Fn(&TypedRelation) -> bool) -> ColumnTypes {
    let mut columns = Vec::new();
    for relation in relations.iter().filter(|relation| meant(relation)) {
        columns.extend(relation.columns.clone()?);
    }
    Some(columns)
}

/// Rewrites FETCH, and OFFSET without LIMIT, for SQLite.
fn limit(query: &mut Query) {
    let number = |text: &str| Expr::Value(Value::Number(text.into(), false).into());
    let is_free = matches!(query.limit_clause, None | Some(LimitClause::LimitOffset { limit: None, .. }));
    if let Some(fetch) = query.fetch.take_if(|fetch| is_free && !fetch.with_ties && !fetch.percent) {
        let wanted = Some(fetch.quantity.unwrap_or_else(|| number("1")));
        match &mut query.limit_clause {
            Some(LimitClause::LimitOffset { limit, .. }) => *limit = wanted,
            clause => {
                *clause =
                    Some(LimitClause::LimitOffset { limit: wanted, offset: None, limit_by: Vec::new() });
            }
        }
    }
    if let Some(LimitClause::LimitOffset { limit: limit @ None, offset: Some(_), .. }) =
        &mut query.limit_clause
    {
        *limit = Some(number("-1"));
    }
}
