//! Rules that only divide a shape.

use full_moon::ast::{BinOp, Call, Expression, Field, FunctionArgs, FunctionBody, FunctionCall, Index};
use full_moon::ast::{LastStmt, Parameter, Prefix, Stmt, Suffix, UnOp, Var};

use super::syntax::text_of;

/// Functions of the standard library that divide a shape into modules.
const DIVISIONS: [&str; 2] = ["split", "components"];

/// Returns the name of the function with which a function does nothing but divide a value into modules: after declarations of
/// local variables it returns `split(...)` or `components(...)`, and no value depends on a condition or on a call, except that
/// methods can be called on the divided value.
pub(super) fn only_divides(body: &FunctionBody) -> Option<&'static str> {
    let mut names: Vec<String> = Vec::new();
    for parameter in body.parameters() {
        let Parameter::Name(name) = parameter else { return None };
        names.push(text_of(name));
    }
    let declares_only = body.block().stmts().all(|statement| {
        let (own, values) = match statement {
            Stmt::LocalAssignment(local) => (local.names(), local.expressions()),
            Stmt::ConstAssignment(local) => (local.names(), local.expressions()),
            _ => return false,
        };
        names.extend(own.iter().map(text_of));
        values.iter().all(is_plain)
    });
    let Some(LastStmt::Return(last)) = body.block().last_stmt().filter(|_| declares_only) else {
        return None;
    };
    let mut returned = last.returns().iter();
    let (Some(Expression::FunctionCall(call)), None) = (returned.next(), returned.next()) else {
        return None;
    };
    let Prefix::Name(name) = call.prefix() else { return None };
    let mut suffixes = call.suffixes();
    let (Some(Suffix::Call(Call::AnonymousCall(arguments))), None) = (suffixes.next(), suffixes.next())
    else {
        return None;
    };
    let FunctionArgs::Parentheses { arguments, .. } = &**arguments else { return None };
    let mut arguments = arguments.iter();
    let name = text_of(name);
    let divides = !names.contains(&name)
        && arguments.next().is_some_and(|value| is_plain(value) || is_method_call(value))
        && arguments.all(is_plain);
    DIVISIONS.into_iter().find(|known| divides && *known == name)
}

/// Returns true for calls of methods with plain arguments, one after the other, on a variable.
fn is_method_call(expression: &Expression) -> bool {
    let Expression::FunctionCall(call) = expression else { return false };
    let with_plain_arguments = |call: &FunctionCall| {
        call.suffixes().all(|suffix| match suffix {
            Suffix::Call(Call::MethodCall(method)) => match method.args() {
                FunctionArgs::Parentheses { arguments, .. } => arguments.iter().all(is_plain),
                _ => false,
            },
            _ => false,
        })
    };
    matches!(call.prefix(), Prefix::Name(_)) && with_plain_arguments(call)
}

/// Returns true for an expression of numbers, texts, tables, variables and fields, without calls, comparisons and conditions.
fn is_plain(expression: &Expression) -> bool {
    match expression {
        Expression::Number(_) | Expression::String(_) => true,
        Expression::Symbol(symbol) => text_of(symbol) != "...",
        Expression::Parentheses { expression, .. } => is_plain(expression),
        Expression::UnaryOperator { unop, expression } => {
            matches!(unop, UnOp::Minus(_)) && is_plain(expression)
        }
        Expression::BinaryOperator { lhs, binop, rhs } => {
            is_arithmetic(binop) && is_plain(lhs) && is_plain(rhs)
        }
        Expression::InterpolatedString(text) => text.expressions().all(is_plain),
        Expression::TypeAssertion { expression, .. } => is_plain(expression),
        Expression::TableConstructor(table) => table.fields().iter().all(|field| match field {
            Field::NoKey(value) => is_plain(value),
            Field::NameKey { value, .. } => is_plain(value),
            _ => false,
        }),
        Expression::Var(Var::Name(_)) => true,
        Expression::Var(Var::Expression(field)) => {
            matches!(field.prefix(), Prefix::Name(_))
                && field.suffixes().all(|suffix| match suffix {
                    Suffix::Index(Index::Dot { .. }) => true,
                    // A parameter as a key would find nothing before the rule is applied.
                    Suffix::Index(Index::Brackets { expression, .. }) => {
                        matches!(&**expression, Expression::Number(_) | Expression::String(_))
                    }
                    _ => false,
                })
        }
        _ => false,
    }
}

/// Returns true for operators of numbers and texts.
fn is_arithmetic(operator: &BinOp) -> bool {
    matches!(
        operator,
        BinOp::Plus(_)
            | BinOp::Minus(_)
            | BinOp::Star(_)
            | BinOp::Slash(_)
            | BinOp::DoubleSlash(_)
            | BinOp::Percent(_)
            | BinOp::Caret(_)
            | BinOp::TwoDots(_)
    )
}

#[cfg(test)]
mod tests {
    use crate::analysis::{Globals, analyse};

    /// Returns true if a rule with this function only divides.
    fn divides(function: &str) -> bool {
        let names = ["split", "components", "random"].map(str::to_owned).to_vec();
        let globals = Globals { names, ..Globals::default() };
        let script =
            format!("local a, b, split_at, f, town = 1, 2, 3, 4, 5\ntown:rule(\"A(s)\", {function})");
        let found = analyse("s.lua", &script, |_| Some(Vec::new()), &globals);
        assert!(found.problems.is_empty(), "{function}: {:?}", found.problems);
        found.divides.contains(&2)
    }

    #[test]
    fn a_rule_that_returns_a_division_without_conditions_only_divides() {
        for function in [
            "function(this, s) return split(s, \"x\", { { 1, a }, { \"~2*\", b } }) end",
            "function(this, s, c) return split(s, \"x\", { { 1, a, c } }) end",
            "function(this, s) local h = a / 2 return split(s, \"x\", { { h, f.a }, { `~{h}`, f[1] } }) end",
            "function(this, s) return components(s:recess(0.18):turn(-a), \"faces\", { { \"top\", false } }) end",
        ] {
            assert!(divides(function), "{function}");
        }
    }

    #[test]
    fn a_rule_that_does_anything_else_does_not_only_divide() {
        for function in [
            "function(this, s) return this end",
            "function(this, s) return split(s, \"x\", { { random(), a } }) end",
            "function(this, s) return split(s, \"x\", { { if s then 1 else 2, a } }) end",
            "function(this, s) return split(s, \"x\", { { s == a and 1 or 2, a } }) end",
            "function(this, s) return split(s, \"x\", { { s:size().x / 2, a } }) end",
            "function(this, s) return split(s, this:x(), { { 1, a } }) end",
            "function(this, s) return split(s, \"x\", { { 1, function() return a end } }) end",
            "function(this, s) return split(s, \"x\", {}), split(s, \"x\", {}) end",
            "function(this, s) if s then return nil end return split(s, \"x\", { { 1, a } }) end",
            "function(this, s) local split = f return split(s, \"x\", { { 1, a } }) end",
            "function(this, ...) return split(..., \"x\", { { 1, a } }) end",
            "function(this, s, c) return split(s, \"x\", { { 1, a, f[c] } }) end",
            "function(this, s, c) local t = { [c] = 1 } return split(s, \"x\", { { 1, a, t.b } }) end",
        ] {
            assert!(!divides(function), "{function}");
        }
        // Two functions on a line.
        assert!(!divides(
            "function(this, s) return split(s, \"x\", {}) end) town:rule(\"B(s)\", function(this, s) return s:x() end"
        ));
    }
}
