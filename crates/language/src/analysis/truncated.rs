//! Calls in lists that lose values: Lua keeps all values of a call only at the end of a list.

use std::collections::BTreeMap;

use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{
    Ast, Block, Call, Expression, Field, FunctionArgs, FunctionBody, FunctionCall, Index, LastStmt,
    LocalAssignment, LocalFunction, Parameter, Prefix, Return, Stmt, Suffix, TableConstructor,
};
use full_moon::node::Node;
use full_moon::visitors::Visitor;

use super::syntax::{columns_between, text_of};
use burgeon_base::error::SourcePlace;
use burgeon_base::warning::{Warning, WarningKind};

/// Methods of a system whose functions return modules.
const RETURNS_MODULES: [&str; 4] = ["rule", "interpret", "decompose", "axiom"];

/// Returns warnings about calls with several values that are not last in a list, so that only their first value is used.
///
/// These are calls of `table.unpack`, `...`, and, among modules, calls of functions of the file that return several modules.
/// Brackets around a call state that only its first value is meant.
pub(super) fn truncated_calls(file: &str, text: &str, ast: &Ast) -> Vec<Warning> {
    let mut functions = FunctionNames::default();
    functions.visit_ast(ast);
    functions.known.retain(|name, known| known.several && functions.declared.get(name) == Some(&1));
    if functions.known.is_empty() && !text.contains("unpack") && !text.contains("...") {
        return Vec::new();
    }
    let mut walk = TruncationWalk { file, functions: functions.known, of_rules: 0, warnings: Vec::new() };
    walk.visit_ast(ast);
    walk.warnings
}

/// A local function of the file.
struct LocalResult {
    /// Set if a return has several values that are modules.
    several: bool,
}

/// Walk that finds local functions that return several modules.
#[derive(Default)]
struct FunctionNames {
    known: BTreeMap<String, LocalResult>,
    /// Numbers of local declarations and parameters by name.
    declared: BTreeMap<String, usize>,
}

impl FunctionNames {
    fn declare(&mut self, name: String) {
        *self.declared.entry(name).or_default() += 1;
    }
}

impl Visitor for FunctionNames {
    fn visit_local_function(&mut self, function: &LocalFunction) {
        let name = text_of(function.name());
        self.declare(name.clone());
        self.known.insert(name, LocalResult { several: returns_modules(function.body().block()) });
    }

    fn visit_local_assignment(&mut self, local: &LocalAssignment) {
        for (name, value) in local.names().iter().zip(local.expressions()) {
            if let Expression::Function(function) = value {
                let several = returns_modules(function.body().block());
                self.known.insert(text_of(name), LocalResult { several });
            }
        }
        local.names().iter().for_each(|name| self.declare(text_of(name)));
    }

    fn visit_function_body(&mut self, body: &FunctionBody) {
        for parameter in body.parameters() {
            if let Parameter::Name(name) = parameter {
                self.declare(text_of(name));
            }
        }
    }
}

/// Returns true if a return of the block, outside of inner functions, has several modules.
fn returns_modules(block: &Block) -> bool {
    let returns = match block.last_stmt() {
        Some(LastStmt::Return(last)) => {
            let is_list = last.returns().len() > 1 && last.returns().iter().any(is_module);
            is_list || last.returns().iter().last().is_some_and(is_unpacked)
        }
        _ => false,
    };
    returns || block.stmts().any(|statement| nested_blocks(statement).into_iter().any(returns_modules))
}

/// Returns the blocks of a statement, without those of functions.
fn nested_blocks(statement: &Stmt) -> Vec<&Block> {
    match statement {
        Stmt::Do(inner) => vec![inner.block()],
        Stmt::NumericFor(inner) => vec![inner.block()],
        Stmt::GenericFor(inner) => vec![inner.block()],
        Stmt::While(inner) => vec![inner.block()],
        Stmt::Repeat(inner) => vec![inner.block()],
        Stmt::If(branches) => {
            let more = branches.else_if().into_iter().flatten().map(|branch| branch.block());
            std::iter::once(branches.block()).chain(more).chain(branches.else_block()).collect()
        }
        _ => Vec::new(),
    }
}

/// Returns true if an expression is a call of a capitalised function, or a branch with one.
fn is_module(expression: &Expression) -> bool {
    match expression {
        Expression::FunctionCall(call) => {
            matches!(call.prefix(), Prefix::Name(name) if text_of(name).starts_with(|letter: char| letter.is_ascii_uppercase()))
        }
        Expression::TableConstructor(table) => {
            items_of(table).is_some_and(|items| items.into_iter().any(is_module))
        }
        _ => false,
    }
}

/// Returns true if an expression is a call of `table.unpack` with any number of values.
fn is_unpacked(expression: &Expression) -> bool {
    let text = expression.to_string();
    matches!(expression, Expression::FunctionCall(_)) && text.trim_start().starts_with("table.unpack(")
}

/// Returns the items of a list; `None` if the table has other fields too.
fn items_of(table: &TableConstructor) -> Option<Vec<&Expression>> {
    let items = table.fields().iter().map(|field| match field {
        Field::NoKey(value) => Some(value),
        _ => None,
    });
    items.collect()
}

struct TruncationWalk<'a> {
    file: &'a str,
    functions: BTreeMap<String, LocalResult>,
    /// Number of open calls whose functions return modules.
    of_rules: usize,
    warnings: Vec<Warning>,
}

impl Visitor for TruncationWalk<'_> {
    fn visit_function_call(&mut self, call: &FunctionCall) {
        self.of_rules += usize::from(is_of_rules(call));
        for suffix in call.suffixes() {
            if let Suffix::Call(Call::MethodCall(method)) = suffix
                && text_of(method.name()) == "axiom"
                && let FunctionArgs::Parentheses { arguments, .. } = method.args()
            {
                self.list(&items(arguments), true);
            }
        }
    }

    fn visit_function_call_end(&mut self, call: &FunctionCall) {
        self.of_rules -= usize::from(is_of_rules(call));
    }

    fn visit_return(&mut self, last: &Return) {
        let values = items(last.returns());
        let is_modules = self.of_rules > 0 || values.iter().any(|value| is_module(value));
        self.list(&values, is_modules);
    }

    fn visit_table_constructor(&mut self, table: &TableConstructor) {
        let Some(values) = items_of(table) else { return };
        let is_modules = values.iter().any(|value| is_module(value));
        self.list(&values, is_modules);
    }
}

impl TruncationWalk<'_> {
    /// Warns about the items of a list, except for the last, that lose values. `is_modules` is true for a list of modules.
    fn list(&mut self, values: &[&Expression], is_modules: bool) {
        let Some((_, values)) = values.split_last() else { return };
        for value in values {
            let Some((call, list)) = self.values_of(value, is_modules) else { continue };
            let message = format!(
                "only the first value of {call} is used here, because Lua keeps the others only at the end of a list"
            );
            let first = format!("write ({call}) if only the first is meant");
            let help = match is_modules {
                true => format!("write sequence({list}), or put it last; {first}"),
                false => format!("put it last, or add its values with table.insert; {first}"),
            };
            let (Some(begin), end) = (value.start_position(), value.end_position()) else { continue };
            let warning = Warning::new(WarningKind::Doubtful, message).help(help);
            let warning = warning.at(Some(SourcePlace::new(self.file, begin.line())));
            self.warnings.push(match end.and_then(|end| columns_between(begin, end)) {
                Some(columns) => warning.in_columns(columns),
                None => warning,
            });
        }
    }

    /// Returns the text of an expression with several values, and of a list with these.
    fn values_of(&self, value: &Expression, is_modules: bool) -> Option<(String, String)> {
        match value {
            Expression::Symbol(symbol) if text_of(symbol) == "..." => Some(("...".into(), "{ ... }".into())),
            Expression::FunctionCall(call) => {
                let suffixes: Vec<&Suffix> = call.suffixes().collect();
                let Prefix::Name(name) = call.prefix() else { return None };
                let name = text_of(name);
                let shown = value.to_string().trim().to_owned();
                match suffixes[..] {
                    [
                        Suffix::Index(Index::Dot { name: function, .. }),
                        Suffix::Call(Call::AnonymousCall(args)),
                    ] if name == "table" && text_of(function) == "unpack" => unpacked(&shown, args),
                    [Suffix::Call(Call::AnonymousCall(args))] if name == "unpack" => unpacked(&shown, args),
                    [Suffix::Call(Call::AnonymousCall(_))]
                        if is_modules && self.functions.contains_key(&name) =>
                    {
                        Some((shown.clone(), format!("{{ {shown} }}")))
                    }
                    _ => None,
                }
            }
            _ => None,
        }
    }
}

/// Returns the text of a call of `table.unpack`, and of the list that it unpacks. `None` if the call has one value.
fn unpacked(shown: &str, args: &FunctionArgs) -> Option<(String, String)> {
    let FunctionArgs::Parentheses { arguments, .. } = args else { return None };
    let given: Vec<String> = arguments.iter().map(|value| value.to_string().trim().to_owned()).collect();
    match &given[..] {
        [list] => Some((shown.to_owned(), list.clone())),
        [_, from, to] if from == to => None,
        _ => Some((shown.to_owned(), format!("{{ {shown} }}"))),
    }
}

fn items(values: &Punctuated<Expression>) -> Vec<&Expression> {
    values.iter().collect()
}

/// Returns true if functions in a call return modules.
fn is_of_rules(call: &FunctionCall) -> bool {
    call.suffixes().any(|suffix| match suffix {
        Suffix::Call(Call::MethodCall(method)) => RETURNS_MODULES.contains(&&*text_of(method.name())),
        _ => false,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn told(script: &str) -> Vec<String> {
        let ast = full_moon::parse(script).unwrap_or_else(|errors| panic!("{script}: {errors:?}"));
        truncated_calls("s.lua", script, &ast).iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_call_that_loses_values_is_told_with_a_remedy() {
        for (script, remedy) in [
            ("s:rule(\"A\", function() return table.unpack(parts), B() end)", "write sequence(parts)"),
            (
                "s:rule(\"A\", function() return { table.unpack(parts, 2), B() } end)",
                "write sequence({ table.unpack(parts, 2) })",
            ),
            ("s:rule(\"A\", function() return unpack(parts), parts end)", "write sequence(parts)"),
            ("local function all(...) return ..., B() end", "write sequence({ ... })"),
            ("s:axiom(table.unpack(parts), B())", "write sequence(parts)"),
            ("local t = { table.unpack(a), 3 }", "table.insert"),
            (
                "local function twig() if x then return A(), B() end end\ns:rule(\"C\", function() return twig(), D() end)",
                "write sequence({ twig() })",
            ),
        ] {
            let told = told(script);
            assert!(told.len() == 1 && told[0].contains(remedy), "{script}: {told:?}");
        }
    }

    #[test]
    fn a_call_that_keeps_its_values_is_not_told() {
        for script in [
            "s:rule(\"A\", function() return B(), table.unpack(parts) end)",
            "s:rule(\"A\", function() return (table.unpack(parts)), B() end)",
            "s:rule(\"A\", function() return sequence(parts), B() end)",
            "local t = { table.unpack(a, 2, 2), 3 }",
            "local t = { n = select(\"#\", ...), ... }",
            "local function twig() return A() end s:rule(\"C\", function() return twig(), D() end)",
            "local function size() return 1, 2 end s:rule(\"C\", function() return Box(size()), D() end)",
            "local function size() return 1, 2 end local function area() return size(), 3 end",
            "local function twig() return A(), B() end local function other(twig) return twig(), D() end",
            "local function ends() return table.unpack(a) end local x = { ends(), 3 }",
            "print(table.unpack(a), 3)",
        ] {
            assert!(told(script).is_empty(), "{script}: {:?}", told(script));
        }
    }
}
