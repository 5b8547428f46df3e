//! Calls of functions: the types of their arguments, and their names in SQLite.

use sqlparser::ast::{
    Expr, Function, FunctionArg, FunctionArgExpr, FunctionArgumentClause, FunctionArguments, Ident,
    ObjectName, Spanned, WindowType,
};

use super::conversions::{error_at, make_text, parse_generated};
use super::scope::{TypeScope, Typing};
use super::signatures::{self, FunctionSignature};
use crate::sql::functions::BOOLEAN_LIST;
use crate::sql::rewrite::types::SqlType;
use burgeon_base::error::Result;

impl Typing<'_> {
    /// Types a call of a function, and rewrites it for SQLite.
    pub(super) fn function(&mut self, expression: &mut Expr, scope: &TypeScope<'_>) -> Result<SqlType> {
        let start = expression.span().start;
        let Expr::Function(function) = expression else { return Ok(SqlType::Unknown) };
        let name = function.name.to_string().trim_matches('"').to_ascii_lowercase();
        if let Some(filter) = &mut function.filter {
            self.condition(filter, scope, "FILTER")?;
        }
        if let Some(WindowType::WindowSpec(spec)) = &mut function.over {
            self.window(spec, scope)?;
        }
        let mut kinds = Vec::new();
        match &mut function.args {
            FunctionArguments::List(list) => {
                for argument in &mut list.args {
                    kinds.push(self.argument(argument, scope)?);
                }
                for clause in &mut list.clauses {
                    if let FunctionArgumentClause::OrderBy(keys) = clause {
                        for key in keys {
                            self.expression(&mut key.expr, scope)?;
                        }
                    }
                }
            }
            FunctionArguments::Subquery(query) => {
                let columns = self.query(query, scope)?;
                kinds.extend(columns.and_then(|columns| columns.first().map(|(_, kind)| *kind)));
            }
            FunctionArguments::None => {}
        }
        let FunctionSignature { takes, gives } = signatures::find(&name);
        let wrong = kinds.iter().find(|kind| match takes {
            signatures::Takes::Numbers => {
                matches!(kind, SqlType::Text | SqlType::Boolean | SqlType::Geometry)
            }
            signatures::Takes::Texts => {
                kind.is_number() || matches!(kind, SqlType::Boolean | SqlType::Geometry)
            }
            signatures::Takes::Anything => false,
        });
        // For functions of strings, only the type of the first argument matters.
        let wrong = wrong.filter(|_| takes != signatures::Takes::Texts || kinds.first() == wrong);
        if wrong.is_some() {
            let kinds: Vec<&str> = kinds.iter().map(|kind| kind.name()).collect();
            let what = format!("function {name}({}) does not exist", kinds.join(", "));
            return Err(error_at(&start, &what).help(match takes {
                signatures::Takes::Texts => "a cast makes a text of a number: height::text",
                _ => "a cast makes a number of a text: name::integer",
            }));
        }
        let given = gives(&kinds);
        // A list of booleans must differ from a list of numbers.
        if name == "array_agg"
            && kinds.first() == Some(&SqlType::Boolean)
            && let Expr::Function(function) = expression
        {
            function.name = ObjectName::from(vec![Ident::new(BOOLEAN_LIST)]);
        }
        rewrite_call(expression, &name, &kinds)?;
        Ok(given)
    }
}

/// Rewrites a call of a function that is different in SQLite.
fn rewrite_call(expression: &mut Expr, name: &str, kinds: &[SqlType]) -> Result<()> {
    let Expr::Function(Function { args: FunctionArguments::List(list), over: None, filter: None, .. }) =
        &mut *expression
    else {
        return Ok(());
    };
    let arguments: Option<Vec<&mut Expr>> = list
        .args
        .iter_mut()
        .map(|argument| match argument {
            FunctionArg::Unnamed(FunctionArgExpr::Expr(expression)) => Some(expression),
            _ => None,
        })
        .collect();
    let Some(mut arguments) = arguments else { return Ok(()) };
    let numeric = kinds.first().is_some_and(|kind| matches!(kind, SqlType::Numeric | SqlType::Literal));
    let written = match (name, arguments.as_mut_slice()) {
        ("round", [number]) if numeric => format!("burgeon_round_decimal({number}, 0)"),
        ("round", [number]) => format!("burgeon_round({number})"),
        ("round", [number, decimals]) => format!("burgeon_round_decimal({number}, {decimals})"),
        ("concat", values) => {
            for (value, kind) in values.iter_mut().zip(kinds) {
                // PostgreSQL converts a boolean to a letter here, unlike in `||`.
                if *kind == SqlType::Boolean {
                    **value = parse_generated(&format!("substr(burgeon_truth({value}), 1, 1)"), &**value)?;
                }
            }
            return Ok(());
        }
        ("char_length" | "character_length", [text]) => format!("length({text})"),
        ("every", [truth]) => format!("bool_and({truth})"),
        ("string_agg", [value, _]) => {
            if let Some(kind) = kinds.first() {
                make_text(value, *kind)?;
            }
            return Ok(());
        }
        _ => return Ok(()),
    };
    *expression = parse_generated(&written, expression)?;
    Ok(())
}
