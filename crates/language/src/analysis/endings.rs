//! Ends of the functions of rules: paths that end without a return, while others return modules.

use full_moon::ast::{Ast, Block, Expression, FunctionArgs, FunctionBody, LastStmt, MethodCall, Stmt};
use full_moon::node::Node;
use full_moon::visitors::Visitor;

use super::syntax::{columns_between, string_of, text_of};
use burgeon_base::error::SourcePlace;
use burgeon_base::warning::{Warning, WarningKind};

/// End of the paths through a block.
#[derive(Default)]
struct BlockEnds {
    /// Set if a return in it has values.
    returns_values: bool,
    /// Set if it has any return.
    returns: bool,
    /// Set if a path reaches the end of the block.
    falls: bool,
    /// Position of the statement that such a path executes last, if it is more than a test.
    last: Option<(SourceLine, Option<std::ops::Range<usize>>)>,
}

type SourceLine = usize;

/// Returns warnings about the functions of the rules of a file that forget to return.
pub(super) fn forgotten_returns(file: &str, text: &str, ast: &Ast) -> Vec<Warning> {
    if !text.contains("rule") && !text.contains("decompose") {
        return Vec::new();
    }
    let mut walk = RuleWalk { file, warnings: Vec::new() };
    walk.visit_ast(ast);
    walk.warnings
}

/// Walk through the rules of a file.
struct RuleWalk<'a> {
    file: &'a str,
    warnings: Vec<Warning>,
}

impl Visitor for RuleWalk<'_> {
    fn visit_method_call(&mut self, call: &MethodCall) {
        let FunctionArgs::Parentheses { arguments, .. } = call.args() else { return };
        let arguments: Vec<&Expression> = arguments.iter().collect();
        if let ("rule" | "decompose", [Expression::String(pattern), .., Expression::Function(function)]) =
            (&*text_of(call.name()), &*arguments)
        {
            let warning = forgotten_return(self.file, function.body());
            self.warnings
                .extend(warning.map(|warning| string_of(pattern).into_iter().fold(warning, Warning::rule)));
        }
    }
}

/// Returns the warning about a rule's function that never returns, or that on one path does something and then ends without a
/// return, although it returns modules on another.
///
/// A path that only tests conditions is a usual way to leave a module unchanged.
fn forgotten_return(file: &str, body: &FunctionBody) -> Option<Warning> {
    let ends = block_ends(body.block());
    let (line, columns) = ends.last.filter(|_| ends.falls)?;
    let (message, help) = match (ends.returns, ends.returns_values) {
        (false, _) => (
            "the function of the rule never returns, so the rule leaves its module unchanged",
            "return the modules: return A(1), { B(2) }; to draw, use interpret in place of rule",
        ),
        (_, true) => (
            "the function of the rule ends here without return, so it leaves its module unchanged",
            "return modules here too, return nil to erase the module, or write return to leave it unchanged",
        ),
        (true, false) => return None,
    };
    let warning = Warning::new(WarningKind::Doubtful, message).help(help);
    let warning = warning.at(Some(SourcePlace::new(file, line)));
    Some(columns.into_iter().fold(warning, Warning::in_columns))
}

fn block_ends(block: &Block) -> BlockEnds {
    let mut ends = BlockEnds { falls: true, ..BlockEnds::default() };
    for statement in block.stmts() {
        statement_ends(statement, &mut ends);
        if !ends.falls {
            break;
        }
    }
    match block.last_stmt() {
        Some(LastStmt::Return(last)) => {
            ends.returns = true;
            ends.returns_values |= !last.returns().is_empty();
            ends.falls = false;
        }
        // A loop ends or begins again, and what follows it counts.
        Some(_) => {}
        None => {}
    }
    ends
}

/// Adds a statement, which a path reaches, to the ends of its block.
fn statement_ends(statement: &Stmt, ends: &mut BlockEnds) {
    let mut nested: Vec<BlockEnds> = Vec::new();
    // Set if a path can pass the statement without entering one of its blocks.
    let mut passes = true;
    match statement {
        Stmt::Do(inner) => {
            nested.push(block_ends(inner.block()));
            passes = false;
        }
        Stmt::If(branches) => {
            nested.push(block_ends(branches.block()));
            nested.extend(branches.else_if().into_iter().flatten().map(|branch| block_ends(branch.block())));
            nested.extend(branches.else_block().map(block_ends));
            passes = branches.else_block().is_none();
        }
        Stmt::NumericFor(inner) => nested.push(block_ends(inner.block())),
        Stmt::GenericFor(inner) => nested.push(block_ends(inner.block())),
        Stmt::While(inner) => nested.push(block_ends(inner.block())),
        Stmt::Repeat(inner) => {
            nested.push(block_ends(inner.block()));
            passes = false;
        }
        // A declaration alone does nothing.
        Stmt::LocalAssignment(_)
        | Stmt::LocalFunction(_)
        | Stmt::ConstAssignment(_)
        | Stmt::ConstFunction(_) => {}
        Stmt::FunctionCall(call) if is_error(&call.to_string()) => ends.falls = false,
        other => {
            if let Some(begin) = other.start_position() {
                let columns = other.end_position().and_then(|end| columns_between(begin, end));
                ends.last = Some((begin.line(), columns));
            }
        }
    }
    if nested.is_empty() {
        return;
    }
    ends.falls = passes || nested.iter().any(|inner| inner.falls);
    let mut last = None;
    for inner in nested {
        ends.returns |= inner.returns;
        ends.returns_values |= inner.returns_values;
        if inner.falls {
            last = last.or(inner.last);
        }
    }
    // A path that passes keeps the statement before.
    ends.last = last.or(ends.last.take());
}

/// Returns true if a call raises an error.
fn is_error(call: &str) -> bool {
    let call = call.trim_start();
    call.starts_with("error(") || call.starts_with("error \"") || call.starts_with("stop(")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns line and message of the warning about the function in `text`.
    fn told(text: &str) -> Option<(usize, String)> {
        let script = format!("local f = {text}");
        let ast = full_moon::parse(&script).unwrap_or_else(|errors| panic!("{text}: {errors:?}"));
        let Some(Stmt::LocalAssignment(local)) = ast.nodes().stmts().next() else { panic!("{text}") };
        let Some(Expression::Function(function)) = local.expressions().iter().next() else {
            panic!("{text}")
        };
        let warning = forgotten_return("s.lua", function.body())?;
        Some((warning.place()?.line, warning.message().to_owned()))
    }

    #[test]
    fn a_path_that_forgets_its_return_is_told_with_its_line() {
        for (text, line, part) in [
            ("function(this, n)\n  A(n)\nend", 2, "never returns"),
            ("function(this, n)\n  if n > 1 then return A(n) end\n  B(n)\nend", 3, "without return"),
            (
                "function(this, n)\n  if n > 1 then\n    B(n)\n  else\n    return A(n)\n  end\nend",
                3,
                "without return",
            ),
            ("function(this, n)\n  for i = 1, n do\n    out[i] = A(i)\n  end\nend", 3, "never returns"),
            (
                "function(this, n)\n  do if n then x = 1 elseif m then return A() end end\nend",
                2,
                "without return",
            ),
        ] {
            let (found, message) = told(text).unwrap_or_else(|| panic!("{text}: no warning"));
            assert!(found == line && message.contains(part), "{text}: {found} {message}");
        }
    }

    #[test]
    fn a_function_that_leaves_its_module_on_purpose_is_not_told() {
        for text in [
            "function() end",
            "function(this, n) return A(n) end",
            "function(this, n) if n > 1 then return A(n) end end",
            "function(this, n) local m = n * 2 if m > 1 then return A(n) elseif m < 0 then return nil end end",
            "function(this, n) if n > 1 then return A(n) end B(n) return end",
            "function(this, n) if n > 1 then B(n) end return A(n) end",
            "function(this, n) if n > 1 then return A(n) else error(\"no\") end end",
            "function(this, n) print(n) return end",
            "function(this, n) local function g() x = 1 end if n then return A(n) end end",
        ] {
            assert_eq!(told(text), None, "{text}");
        }
    }
}
