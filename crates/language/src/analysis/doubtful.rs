//! Calls that are valid but probably not intended: angles in radians for degrees, and the reverse.

use full_moon::ast::{Ast, Call, Expression, FunctionArgs, FunctionCall, Index, Prefix, Suffix, UnOp};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;
use full_moon::visitors::Visitor;

use super::syntax::{columns_between, text_of};
use burgeon_base::error::SourcePlace;
use burgeon_base::warning::{Warning, WarningKind};

/// Functions of `math` that take radians.
const OF_RADIANS: [&str; 3] = ["sin", "cos", "tan"];

/// Modules and methods that take degrees.
const OF_DEGREES: [&str; 20] = [
    "Turn",
    "Left",
    "Right",
    "Pitch",
    "Down",
    "Up",
    "Roll",
    "RollLeft",
    "RollRight",
    "turn",
    "turn_right",
    "pitch",
    "pitch_up",
    "roll",
    "roll_back",
    "bend",
    "twist",
    "rotate",
    "yaw",
    "lean",
];

/// Returns warnings about the calls of a file whose angles have probably the wrong unit.
pub(super) fn doubtful_calls(file: &str, text: &str, ast: &Ast) -> Vec<Warning> {
    // Few scripts use these functions, and a text is searched faster than a tree.
    if !text.contains("math.") {
        return Vec::new();
    }
    let mut walk = AngleWalk { file, warnings: Vec::new() };
    walk.visit_ast(ast);
    walk.warnings
}

struct AngleWalk<'a> {
    file: &'a str,
    warnings: Vec<Warning>,
}

impl Visitor for AngleWalk<'_> {
    fn visit_function_call(&mut self, call: &FunctionCall) {
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        if let Some((function, argument)) = math_call(call) {
            let number = if OF_RADIANS.contains(&&*function) { literal(argument) } else { None };
            if let Some(degrees) = number.filter(|number| number.abs() > std::f64::consts::TAU) {
                self.warn(
                    argument,
                    format!("math.{function} takes radians, and {degrees} is more than a full turn of them"),
                    format!(
                        "angles of scripts are degrees, and math.{function} takes radians: write math.{function}(math.rad({degrees}))"
                    ),
                );
            }
        }
        let called = match (call.prefix(), suffixes.as_slice()) {
            (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(args)), ..]) => Some((name, args)),
            _ => None,
        };
        called.into_iter().for_each(|(name, args)| self.angles_of(name, args));
        for suffix in &suffixes {
            if let Suffix::Call(Call::MethodCall(method)) = suffix {
                self.angles_of(method.name(), method.args());
            }
        }
    }
}

impl AngleWalk<'_> {
    /// Warns if the first argument of a function of degrees is in radians.
    fn angles_of(&mut self, name: &TokenReference, args: &FunctionArgs) {
        let name = text_of(name);
        let FunctionArgs::Parentheses { arguments, .. } = args else { return };
        let Some(first) = arguments.iter().next().filter(|_| OF_DEGREES.contains(&&*name)) else { return };
        let Expression::FunctionCall(call) = first else { return };
        let Some((function, inner)) = math_call(call) else { return };
        if matches!(&*function, "rad" | "asin" | "acos" | "atan" | "atan2") {
            let shown = first.to_string().trim().to_owned();
            let remedy = match &*function {
                "rad" => format!("{name}({})", inner.to_string().trim()),
                _ => format!("{name}(math.deg({shown}))"),
            };
            self.warn(
                first,
                format!("{name} takes degrees, and math.{function} returns radians"),
                format!("angles of scripts are degrees: write {remedy}"),
            );
        }
    }

    fn warn(&mut self, at: &Expression, message: String, help: String) {
        let (Some(begin), end) = (at.start_position(), at.end_position()) else { return };
        let warning = Warning::new(WarningKind::Doubtful, message).help(help);
        let warning = warning.at(Some(SourcePlace::new(self.file, begin.line())));
        self.warnings.push(match end.and_then(|end| columns_between(begin, end)) {
            Some(columns) => warning.in_columns(columns),
            None => warning,
        });
    }
}

/// Returns the name and the first argument of a call of a function of `math`.
fn math_call(call: &FunctionCall) -> Option<(String, &Expression)> {
    let suffixes: Vec<&Suffix> = call.suffixes().collect();
    let [Suffix::Index(Index::Dot { name, .. }), Suffix::Call(Call::AnonymousCall(args))] = suffixes[..]
    else {
        return None;
    };
    let (Prefix::Name(library), FunctionArgs::Parentheses { arguments, .. }) = (call.prefix(), &**args)
    else {
        return None;
    };
    let first = arguments.iter().next().filter(|_| text_of(library) == "math")?;
    Some((text_of(name), first))
}

/// Returns the value of a number in a script.
fn literal(expression: &Expression) -> Option<f64> {
    match expression {
        Expression::Number(token) => text_of(token).replace('_', "").parse().ok(),
        Expression::UnaryOperator { unop: UnOp::Minus(_), expression } => {
            literal(expression).map(|number| -number)
        }
        Expression::Parentheses { expression, .. } => literal(expression),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(script: &str) -> Vec<String> {
        let ast = full_moon::parse(script).unwrap_or_else(|errors| panic!("{script}: {errors:?}"));
        doubtful_calls("s.lua", script, &ast).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn angles_of_the_wrong_unit_are_told_with_a_remedy() {
        for (script, remedy) in [
            ("local x = math.sin(90)", "write math.sin(math.rad(90))"),
            ("print(1 + math.cos(-45))", "write math.cos(math.rad(-45))"),
            ("return Turn(math.rad(a + 90))", "write Turn(a + 90)"),
            ("this:forward(1):turn(math.atan2(y, x))", "write turn(math.deg(math.atan2(y, x)))"),
            ("f(function() this:bend(math.rad(3)) end)", "write bend(3)"),
        ] {
            let told = told(script);
            assert!(told.len() == 1 && told[0].contains(remedy), "{script}: {told:?}");
        }
    }

    #[test]
    fn angles_of_the_right_unit_are_not_told() {
        for script in [
            "local x = math.sin(1.5) + math.cos(math.rad(90)) + math.tan(x)",
            "return Turn(90), Turn(math.deg(math.atan(1))), Turn(math.sin(2))",
            "local x = mine.sin(90) + math.floor(90)",
            "this:forward(math.rad(90))",
        ] {
            assert!(told(script).is_empty(), "{script}: {:?}", told(script));
        }
    }
}
