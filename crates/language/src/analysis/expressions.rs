//! Walks the expressions of a script for the names that they read and the functions and modules that they call.

use full_moon::ast::luau::{ElseIfExpression, IfExpression};
use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{
    Call, Expression, Field, FunctionArgs, FunctionCall, Index, Prefix, Suffix, TableConstructor, Var,
};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;

use super::syntax::{end_of, instead_of, is_open, string_of, text_of};
use super::walk::{FunctionRole, Walk};
use burgeon_base::error::Error;
use burgeon_rewriting::Signature;

impl Walk<'_> {
    pub(super) fn expressions(&mut self, expressions: &Punctuated<Expression>) {
        for expression in expressions {
            self.expression(expression);
        }
    }

    pub(super) fn expression(&mut self, expression: &Expression) {
        match expression {
            Expression::BinaryOperator { lhs, rhs, .. } => {
                self.expression(lhs);
                self.expression(rhs);
            }
            Expression::Parentheses { expression, .. }
            | Expression::UnaryOperator { expression, .. }
            | Expression::TypeAssertion { expression, .. } => self.expression(expression),
            Expression::Function(function) => {
                self.function(function.body(), FunctionRole::Other, false);
            }
            Expression::FunctionCall(call) => self.call(call),
            Expression::IfExpression(branches) => self.if_expression(branches),
            Expression::InterpolatedString(string) => {
                for inner in string.expressions() {
                    self.expression(inner);
                }
            }
            Expression::String(token) => {
                if let Some(text) = string_of(token) {
                    self.refuse_weak(token, &text);
                }
            }
            Expression::TableConstructor(table) => self.table(table),
            Expression::Var(variable) => match variable {
                Var::Name(name) => {
                    self.read(name);
                }
                Var::Expression(expression) => {
                    self.library_field(expression.prefix(), expression.suffixes().next());
                    self.prefix(expression.prefix(), expression.suffixes().next());
                    for suffix in expression.suffixes() {
                        self.suffix(suffix);
                    }
                }
                _ => {}
            },
            _ => {}
        }
    }

    /// Wraps the table of a loop in a check at run time, because the order of some keys is not deterministic. `pairs`
    /// includes the check.
    pub(super) fn check_keys(&mut self, expressions: &Punctuated<Expression>) {
        let (Some(first), Some(last)) = (expressions.first(), expressions.last()) else { return };
        let certain = match first.value() {
            Expression::FunctionCall(call) => match (call.prefix(), call.suffixes().count()) {
                (Prefix::Name(name), 1) => {
                    matches!(text_of(name).as_str(), "pairs" | "ipairs")
                        && self.find(&text_of(name)).is_none()
                }
                _ => false,
            },
            Expression::TableConstructor(table) => {
                table.fields().iter().all(|field| !matches!(field, Field::ExpressionKey { .. }))
            }
            _ => false,
        };
        if let (false, Some(begin), Some(end)) = (certain, first.start_position(), end_of(last.value())) {
            self.edit(begin.bytes(), begin.bytes(), "__each(");
            self.edit(end.bytes(), end.bytes(), ")");
        }
    }

    pub(super) fn if_expression(&mut self, branches: &IfExpression) {
        self.expression(branches.condition());
        self.expression(branches.if_expression());
        for branch in branches.else_if_expressions().into_iter().flatten() {
            let branch: &ElseIfExpression = branch;
            self.expression(branch.condition());
            self.expression(branch.expression());
        }
        self.expression(branches.else_expression());
    }

    pub(super) fn table(&mut self, table: &TableConstructor) {
        for field in table.fields() {
            match field {
                Field::ExpressionKey { key, value, .. } => {
                    self.expression(key);
                    self.expression(value);
                }
                Field::NameKey { key, value, .. } => {
                    self.refuse_weak(key, &text_of(key));
                    self.expression(value);
                }
                Field::NoKey(value) => self.expression(value),
                _ => {}
            }
        }
    }

    /// Walks a prefix, which the suffix `first` follows.
    pub(super) fn prefix(&mut self, prefix: &Prefix, first: Option<&Suffix>) {
        match prefix {
            Prefix::Expression(expression) => self.expression(expression),
            Prefix::Name(name) => self.read_receiver(name, first),
            _ => {}
        }
    }

    pub(super) fn suffix(&mut self, suffix: &Suffix) {
        match suffix {
            Suffix::Call(Call::AnonymousCall(arguments)) => self.arguments(arguments),
            Suffix::Call(Call::MethodCall(method)) => self.arguments(method.args()),
            Suffix::Index(Index::Brackets { expression, .. }) => self.expression(expression),
            Suffix::Index(Index::Dot { name, .. }) => self.refuse_weak(name, &text_of(name)),
            _ => {}
        }
    }

    pub(super) fn arguments(&mut self, arguments: &FunctionArgs) {
        match arguments {
            FunctionArgs::Parentheses { arguments, .. } => self.expressions(arguments),
            FunctionArgs::TableConstructor(table) => self.table(table),
            _ => {}
        }
    }

    /// Refuses weak tables, because their content depends on the time of garbage collection.
    fn refuse_weak(&mut self, token: &TokenReference, name: &str) {
        if name == "__mode" {
            let error = Error::script("the content of a weak table is not deterministic");
            self.problem(token, error.help("remove __mode: memory is freed when the run ends"));
        }
    }

    /// Refuses library functions of Luau that scripts do not have.
    pub(super) fn library_field(&mut self, prefix: &Prefix, suffix: Option<&Suffix>) {
        if let (Prefix::Name(table), Some(Suffix::Index(Index::Dot { name, .. }))) = (prefix, suffix)
            && self.find(&text_of(table)).is_none()
        {
            let name = format!("{}.{}", text_of(table), text_of(name));
            if let Some(instead) = instead_of(&name) {
                let error = Error::not_found("name", &name, [], format!("unknown name {name}"));
                self.problem(table, error.help(instead));
            }
        }
    }

    pub(super) fn call(&mut self, call: &FunctionCall) {
        self.record_call(call);
        self.query_called(call);
        let suffixes: Vec<&Suffix> = call.suffixes().collect();
        self.library_field(call.prefix(), suffixes.first().copied());
        if let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
            (call.prefix(), suffixes.as_slice())
            && let Some(error) = self.module(name).and_then(|signature| arity_error(signature, arguments))
        {
            self.problem(name, error);
        }
        self.prefix(call.prefix(), suffixes.first().copied());
        for suffix in suffixes {
            match suffix {
                Suffix::Call(Call::MethodCall(method)) => match text_of(method.name()).as_str() {
                    "rule" | "decompose" => self.rule(method.args(), FunctionRole::Rule),
                    "interpret" => self.rule(method.args(), FunctionRole::Interpretation),
                    "at_start" | "before_step" | "after_step" | "at_end" => {
                        // A hook runs in its step in any case, so its `stop` requires no passes.
                        let stops = self.stops;
                        self.rule(method.args(), FunctionRole::Hook);
                        self.stops = stops;
                    }
                    "axiom" => {
                        self.axiom = true;
                        self.suffix(suffix);
                        self.axiom = false;
                    }
                    _ => self.suffix(suffix),
                },
                _ => self.suffix(suffix),
            }
        }
    }
}

/// Returns an error if a module is called with too few or too many arguments.
fn arity_error(signature: &Signature, arguments: &FunctionArgs) -> Option<Error> {
    let FunctionArgs::Parentheses { arguments, .. } = arguments else { return None };
    let open = arguments.iter().last().is_some_and(is_open);
    let given = arguments.len();
    let few = given < signature.required && !open;
    let many = given > signature.arity() + usize::from(open);
    (few || many).then(|| {
        Error::argument(format!("{} has {}, not {given}", signature.name, signature.count()))
            .help(format!("it was declared as {}", signature.usage()))
    })
}
