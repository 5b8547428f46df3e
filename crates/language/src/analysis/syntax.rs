//! Helpers for syntax nodes.

use std::ops::Range;

use full_moon::ast::{Block, Call, Expression, FunctionArgs, Prefix, Suffix};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;

use burgeon_rewriting::Signature;
use full_moon::tokenizer::{Position, TokenType};

/// Returns the advice for a name of Lua that scripts do not have.
pub(super) fn instead_of(name: &str) -> Option<&'static str> {
    Some(match name {
        "io" | "os" | "package" | "dofile" | "loadfile" => {
            "scripts cannot use files, the clock or programs; load other scripts of the folder with require"
        }
        "loadstring" | "load" => "scripts cannot compile text; a successor can be a string",
        "_G" | "getfenv" | "setfenv" | "shared" => {
            "globals cannot be changed; pass values as parameters or with require"
        }
        "debug" | "newproxy" | "collectgarbage" | "gcinfo" => "remove it",
        "math.random" => "write random() or random(low, high), which depend on the seed and the module",
        "math.randomseed" => "set the seed with --seed, or for one system: lsystem { seed = 7 }",
        "math.noise" => "write noise(x, y, z)",
        _ => return None,
    })
}

/// Returns true if an expression can have any number of values.
pub(super) fn is_open(expression: &Expression) -> bool {
    match expression {
        Expression::FunctionCall(_) => true,
        Expression::Symbol(symbol) => text_of(symbol) == "...",
        _ => false,
    }
}

/// Returns true if the option of a rule with this name can be a function.
pub(super) fn is_function_option(name: &str) -> bool {
    matches!(name, "when" | "propensity")
}

pub(super) fn text_of(token: &TokenReference) -> String {
    token.token().to_string()
}

/// Returns the end of a node. The parser's own function returns the position before a closing bracket, and is only fast
/// from the end of long lists.
pub(super) fn end_of(piece: &impl Node) -> Option<Position> {
    piece.tokens().rev().filter_map(|token| token.end_position()).max_by_key(|position| position.bytes())
}

pub(super) fn first_position(block: &Block, end: &TokenReference) -> Option<usize> {
    let first =
        block.stmts().next().and_then(Node::start_position).or_else(|| block.last_stmt()?.start_position());
    first.or_else(|| end.start_position()).map(|position| position.bytes())
}

/// Returns the signature if `value` is `module("Name", "parameter", ...)`.
pub(super) fn declared_module(value: &Expression) -> Option<Signature> {
    let Expression::FunctionCall(call) = value else { return None };
    let suffixes: Vec<&Suffix> = call.suffixes().collect();
    let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
        (call.prefix(), suffixes.as_slice())
    else {
        return None;
    };
    if text_of(name) != "module" {
        return None;
    }
    let texts: Vec<String> = match &**arguments {
        FunctionArgs::String(text) => vec![string_of(text)?],
        FunctionArgs::Parentheses { arguments, .. } => arguments
            .iter()
            .map(|argument| match argument {
                Expression::String(text) => string_of(text),
                _ => None,
            })
            .collect::<Option<_>>()?,
        _ => return None,
    };
    let (name, parameters) = texts.split_first()?;
    // The name of a package's module includes the package.
    let name = name.rsplit('.').next().unwrap_or(name);
    Signature::new(name, parameters).ok()
}

pub(super) fn string_of(token: &TokenReference) -> Option<String> {
    match token.token_type() {
        TokenType::StringLiteral { literal, .. } => Some(literal.to_string()),
        _ => None,
    }
}

/// Returns the first position of a random stream among the arguments of a distribution.
pub(super) fn stream_argument(name: &str) -> Option<usize> {
    match name {
        "poisson" | "choose" => Some(1),
        "normal" | "binomial" | "beta" => Some(2),
        _ => None,
    }
}

/// Returns the columns (characters, from 0) between two positions of a line; `None` if they are on different lines.
pub(super) fn columns_between(begin: Position, end: Position) -> Option<Range<usize>> {
    let columns = begin.character().saturating_sub(1)..end.character().saturating_sub(1);
    (begin.line() == end.line() && !columns.is_empty()).then_some(columns)
}

/// Returns the columns of a token, if it is on one line.
pub(super) fn columns_of(token: &TokenReference) -> Option<Range<usize>> {
    columns_between(token.start_position()?, token.end_position()?)
}
