//! Gives a statement the meaning that it has in PostgreSQL: determines the types of its expressions, refuses
//! comparisons and computations of wrong types, and rewrites operators, casts and functions so that SQLite does the
//! same.
//!
//! If a type is unknown, such as that of a parameter, the inserted functions check the values.

use sqlparser::ast::{
    Expr, Fetch, GroupByExpr, Ident, LimitClause, ObjectName, OrderBy, OrderByExpr, OrderByKind, Query,
    Select, SelectItem, SelectItemQualifiedWildcardKind, SetExpr, Spanned, TableFactor, Value,
};

use super::Catalogue;
use super::expressions::Expressions;
use super::scope::{condition_mut, table};
use super::types::{ColumnTypes, SqlType};
use burgeon_base::error::{Error, Result};

/// A relation after FROM with its columns.
pub(super) struct TypedRelation {
    alias: Option<String>,
    columns: ColumnTypes,
}

/// The relations that an expression can refer to.
pub(super) struct TypeScope<'a> {
    relations: Vec<TypedRelation>,
    outer: Option<&'a TypeScope<'a>>,
}

impl TypeScope<'_> {
    /// Returns the type of the column `name`, of the relation `owner` if given.
    pub(super) fn column(&self, owner: Option<&str>, name: &str) -> SqlType {
        let mut open = Some(self);
        while let Some(scope) = open {
            for relation in &scope.relations {
                let meant = match (owner, &relation.alias) {
                    (Some(owner), Some(alias)) => alias.eq_ignore_ascii_case(owner),
                    (Some(_), None) => false,
                    (None, _) => true,
                };
                match &relation.columns {
                    Some(columns) if meant => {
                        let found = columns.iter().find(|(known, _)| known.eq_ignore_ascii_case(name));
                        match found {
                            Some((_, kind)) => return *kind,
                            None if owner.is_some() => return SqlType::Unknown,
                            None => {}
                        }
                    }
                    // The column may belong to this relation.
                    None if meant => return SqlType::Unknown,
                    _ => {}
                }
            }
            open = scope.outer;
        }
        SqlType::Unknown
    }
}

/// The typing of a statement, which rewrites expressions by their types.
pub(super) struct Typing<'a> {
    tables: &'a Catalogue,
    /// Tables that the statement declares, in order.
    declared: Vec<(String, ColumnTypes)>,
}

/// Types a statement, and returns the columns of its rows.
pub(super) fn type_query(query: &mut Query, tables: &Catalogue) -> Result<ColumnTypes> {
    let nothing = TypeScope { relations: Vec::new(), outer: None };
    Typing { tables, declared: Vec::new() }.query(query, &nothing)
}

impl Typing<'_> {
    pub(super) fn query(&mut self, query: &mut Query, outer: &TypeScope<'_>) -> Result<ColumnTypes> {
        let known = self.declared.len();
        if let Some(with) = &mut query.with {
            for table in &mut with.cte_tables {
                let name = table.alias.name.value.to_ascii_lowercase();
                let renamed: Vec<String> =
                    table.alias.columns.iter().map(|column| column.name.value.clone()).collect();
                if with.recursive {
                    self.declared.push((name.clone(), None));
                }
                let columns = rename(self.query(&mut table.query, outer)?, &renamed);
                if with.recursive {
                    self.declared.pop();
                }
                self.declared.push((name, columns));
            }
        }
        limit(query);
        let columns = self.body(&mut query.body, query.order_by.as_mut(), outer)?;
        if let Some(LimitClause::LimitOffset { limit, offset, .. }) = &mut query.limit_clause {
            for count in limit.iter_mut().chain(offset.as_mut().map(|offset| &mut offset.value)) {
                Expressions::new(self).expression(count, outer)?;
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
                        let kind = Expressions::new(self).expression(value, outer)?;
                        match kinds.get_mut(index) {
                            Some(known) => *known = known.or(kind),
                            None => kinds.push(kind),
                        }
                    }
                }
                let column =
                    |(index, kind): (usize, SqlType)| (format!("column{}", index + 1), settled(kind));
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
                    Expressions::new(self).condition(on, &scope, "JOIN/ON")?;
                }
            }
        }
        if let Some(selection) = &mut select.selection {
            Expressions::new(self).condition(selection, &scope, "WHERE")?;
        }
        let mut columns = Some(Vec::new());
        for item in &mut select.projection {
            self.projected(item, &scope, &mut columns)?;
        }
        if let GroupByExpr::Expressions(keys, _) = &mut select.group_by {
            for key in keys {
                Expressions::new(self).expression(key, &scope)?;
            }
        }
        if let Some(having) = &mut select.having {
            Expressions::new(self).condition(having, &scope, "HAVING")?;
        }
        for window in &mut select.named_window {
            if let sqlparser::ast::NamedWindowExpr::WindowSpec(spec) = &mut window.1 {
                Expressions::new(self).window(spec, &scope)?;
            }
        }
        if let Some(sqlparser::ast::Distinct::On(keys)) = &mut select.distinct {
            for key in keys {
                Expressions::new(self).expression(key, &scope)?;
            }
        }
        if let Some(OrderBy { kind: OrderByKind::Expressions(keys), .. }) = order {
            for OrderByExpr { expr, .. } in keys {
                Expressions::new(self).expression(expr, &scope)?;
            }
        }
        Ok(columns)
    }

    /// Types an item of a projection, and adds its columns.
    fn projected(
        &mut self,
        item: &mut SelectItem,
        scope: &TypeScope<'_>,
        columns: &mut ColumnTypes,
    ) -> Result<()> {
        let added = match item {
            SelectItem::UnnamedExpr(expression) => {
                let name = column_name(expression);
                let kind = Expressions::new(self).expression(expression, scope)?;
                Some(vec![(name, settled(kind))])
            }
            SelectItem::ExprWithAlias { expr, alias } => {
                let kind = Expressions::new(self).expression(expr, scope)?;
                Some(vec![(alias.value.clone(), settled(kind))])
            }
            SelectItem::Wildcard(_) => all(&scope.relations, |_| true),
            SelectItem::QualifiedWildcard(SelectItemQualifiedWildcardKind::ObjectName(name), _) => {
                let owner = name.0.last().and_then(|part| part.as_ident()).map(|name| name.value.clone());
                all(&scope.relations, |relation| match (&relation.alias, &owner) {
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
        Ok(match factor {
            TableFactor::Table { name, alias, args: None, .. } => {
                let own = name.0.last().and_then(|part| part.as_ident()).map(|name| name.value.clone());
                let columns = self.columns_of(name);
                let renamed = alias.iter().flat_map(|alias| &alias.columns);
                let renamed: Vec<String> = renamed.map(|column| column.name.value.clone()).collect();
                let alias = alias.as_ref().map(|alias| alias.name.value.clone()).or(own);
                vec![TypedRelation { alias, columns: rename(columns, &renamed) }]
            }
            TableFactor::Table { alias, args: Some(args), .. } => {
                for argument in &mut args.args {
                    Expressions::new(self).argument(argument, scope)?;
                }
                let alias = alias.as_ref().map(|alias| alias.name.value.clone());
                vec![TypedRelation { alias, columns: None }]
            }
            TableFactor::Derived { subquery, alias, .. } => {
                let nothing = TypeScope { relations: Vec::new(), outer: None };
                let outer = scope.outer.unwrap_or(&nothing);
                let columns = self.query(subquery, outer)?;
                let renamed = alias.iter().flat_map(|alias| &alias.columns);
                let renamed: Vec<String> = renamed.map(|column| column.name.value.clone()).collect();
                let alias = alias.as_ref().map(|alias| alias.name.value.clone());
                vec![TypedRelation { alias, columns: rename(columns, &renamed) }]
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

    fn columns_of(&self, name: &ObjectName) -> ColumnTypes {
        if let [part] = name.0.as_slice() {
            let own = part.as_ident()?.value.to_ascii_lowercase();
            if let Some((_, columns)) = self.declared.iter().rev().find(|(known, _)| *known == own) {
                return columns.clone();
            }
        }
        let known = table(name, self.tables)?;
        let kinds = known.kinds.iter().copied().chain(std::iter::repeat(SqlType::Unknown));
        Some(
            known
                .columns
                .iter()
                .zip(kinds)
                .map(|(name, kind)| {
                    let kind = if known.geometry(name).is_some() { SqlType::Geometry } else { kind };
                    (name.clone(), kind)
                })
                .collect(),
        )
    }
}

/// Returns the type of a column; a quoted string becomes a string.
fn settled(kind: SqlType) -> SqlType {
    if kind == SqlType::Literal { SqlType::Text } else { kind }
}

fn rename(columns: ColumnTypes, names: &[String]) -> ColumnTypes {
    let mut columns = columns?;
    columns.iter_mut().zip(names).for_each(|(column, name)| column.0.clone_from(name));
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
    if let Some(Fetch { with_ties: false, percent: false, quantity }) = &query.fetch {
        let wanted = quantity.clone().unwrap_or_else(|| number("1"));
        match &mut query.limit_clause {
            Some(LimitClause::LimitOffset { limit: limit @ None, .. }) => *limit = Some(wanted),
            None => {
                query.limit_clause = Some(LimitClause::LimitOffset {
                    limit: Some(wanted),
                    offset: None,
                    limit_by: Vec::new(),
                });
            }
            Some(_) => return,
        }
        query.fetch = None;
    }
    if let Some(LimitClause::LimitOffset { limit: limit @ None, offset: Some(_), .. }) =
        &mut query.limit_clause
    {
        *limit = Some(number("-1"));
    }
}

/// Returns the name that PostgreSQL gives to a column without an alias.
pub(super) fn column_name(expression: &Expr) -> String {
    let last = |name: &ObjectName| {
        let part = name.0.last().and_then(|part| part.as_ident());
        part.map_or_else(String::new, shown_name)
    };
    match expression {
        Expr::Identifier(name) => shown_name(name),
        Expr::CompoundIdentifier(names) => names.last().map_or_else(String::new, shown_name),
        Expr::CompoundFieldAccess { access_chain, .. } => access_chain
            .iter()
            .rev()
            .find_map(|access| match access {
                sqlparser::ast::AccessExpr::Dot(Expr::Identifier(name)) => Some(shown_name(name)),
                _ => None,
            })
            .unwrap_or_else(|| "?column?".into()),
        Expr::Nested(inner) | Expr::Collate { expr: inner, .. } => column_name(inner),
        Expr::Function(function) => last(&function.name),
        Expr::Cast { expr, data_type, .. } => match column_name(expr).as_str() {
            "?column?" => match SqlType::named(&data_type.to_string()) {
                Some(SqlType::Integer) => "int4".into(),
                Some(SqlType::Double) => "float8".into(),
                Some(SqlType::Boolean) => "bool".into(),
                _ => data_type.to_string().to_ascii_lowercase(),
            },
            name => name.to_owned(),
        },
        Expr::Case { else_result, .. } => match else_result.as_deref().map(column_name) {
            Some(name) if name != "?column?" => name,
            _ => "case".into(),
        },
        Expr::Exists { .. } => "exists".into(),
        Expr::Substring { .. } => "substring".into(),
        Expr::Position { .. } => "position".into(),
        Expr::Trim { trim_where, .. } => match trim_where {
            Some(sqlparser::ast::TrimWhereField::Leading) => "ltrim".into(),
            Some(sqlparser::ast::TrimWhereField::Trailing) => "rtrim".into(),
            _ => "btrim".into(),
        },
        Expr::Ceil { .. } => "ceil".into(),
        Expr::Floor { .. } => "floor".into(),
        Expr::Value(value) if matches!(value.value, Value::Boolean(_)) => "bool".into(),
        Expr::Array(_) => "array".into(),
        Expr::Subquery(query) => match &*query.body {
            SetExpr::Select(select) => match select.projection.first() {
                Some(SelectItem::UnnamedExpr(expression)) => column_name(expression),
                Some(SelectItem::ExprWithAlias { alias, .. }) => shown_name(alias),
                _ => "?column?".into(),
            },
            _ => "?column?".into(),
        },
        _ => "?column?".into(),
    }
}

fn shown_name(name: &Ident) -> String {
    if name.quote_style.is_some() { name.value.clone() } else { name.value.to_ascii_lowercase() }
}

/// Creates an error about an expression, with its position in the statement.
pub(super) fn error_at(expression: &Expr, message: &str) -> Error {
    let start = expression.span().start;
    let place = match start.line {
        0 => String::new(),
        line => format!(", line {line}, column {}", start.column),
    };
    Error::argument(format!("SQL{place}: {message}"))
}
