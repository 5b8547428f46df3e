//! Calls of functions in a statement.

use sqlparser::ast::{Expr, Function, FunctionArg, FunctionArgExpr, FunctionArguments};

/// Returns the lower-case name and the arguments of a plain call of a function.
pub(super) fn call(expression: &Expr) -> Option<(String, Vec<&Expr>)> {
    let Expr::Function(Function {
        name, args: FunctionArguments::List(list), filter: None, over: None, ..
    }) = expression
    else {
        return None;
    };
    let [part] = name.0.as_slice() else { return None };
    let plain = |argument| match argument {
        &FunctionArg::Unnamed(FunctionArgExpr::Expr(ref expression)) => Some(expression),
        _ => None,
    };
    let arguments: Option<Vec<&Expr>> = list.args.iter().map(plain).collect();
    Some((part.as_ident()?.value.to_ascii_lowercase(), arguments?))
}
