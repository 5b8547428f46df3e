//! Preparation of rules: rewrites their returns so that the resulting modules need no parsing at run time.

use full_moon::ast::luau::TypeSpecifier;
use full_moon::ast::punctuated::Punctuated;
use full_moon::ast::{Call, Expression, Field, FunctionArgs, FunctionBody, Parameter, Prefix, Suffix, Var};
use full_moon::node::Node;
use full_moon::tokenizer::{StringLiteralQuoteType, TokenReference, TokenType};
use std::borrow::Cow;
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::atomic::Ordering;

use super::blocks::ScopeWalk;
use super::division::only_divides;
use super::formulas::{FormulaText, condition_of, production_of};
use super::syntax::{end_of, first_position, is_function_option, is_open, string_of, text_of};
use super::walk::{Fact, Function, FunctionRole, Variable, Walk};
use crate::CallForm;
use burgeon_base::error::Error;
use burgeon_kit::Argument;
use burgeon_rewriting::Successors;

/// Maximum number of parameters of a prepared return.
const MOST_EMITTED: usize = 64;

/// Marker bit of shape numbers.
const SHAPE: usize = Successors::SHAPE as usize;

/// Result of a return as far as the text shows it: symbols and brackets, and the locations of the parameters.
#[derive(Default)]
struct ReturnPattern {
    items: Vec<Cow<'static, str>>,
    arguments: Vec<ReturnArgument>,
}

enum ReturnArgument {
    /// Byte range of an argument. The flag is set if the expression can have any number of values, of which the first
    /// is used.
    At(usize, usize, bool),
    /// Omitted argument, before this byte position.
    Missing(usize),
}

impl Walk<'_> {
    /// Walks the arguments of `:rule` or `:interpret`; the functions among them get a role.
    pub(super) fn rule(&mut self, arguments: &FunctionArgs, role: FunctionRole) {
        let FunctionArgs::Parentheses { arguments, .. } = arguments else { return self.arguments(arguments) };
        let last = arguments.len().saturating_sub(1);
        let outer = self.rule.take();
        if let Some(Expression::String(text)) = arguments.iter().next() {
            let pattern = string_of(text).filter(|pattern| !pattern.is_empty());
            self.rule = pattern.map(|pattern| match role {
                FunctionRole::Interpretation => format!("{pattern} (interpretation)"),
                _ => pattern,
            });
        }
        let pattern = match arguments.iter().next() {
            Some(Expression::String(pattern)) => string_of(pattern).unwrap_or_default(),
            _ => String::new(),
        };
        for (index, argument) in arguments.iter().enumerate() {
            match argument {
                Expression::Function(function) if index == last && index > 0 => {
                    self.check_receiver(&pattern, function.body());
                    if role == FunctionRole::Rule {
                        self.prepare_function(argument, function.body(), role);
                    } else {
                        self.function(function.body(), role, false);
                    }
                }
                Expression::String(text) if role == FunctionRole::Rule && index == last && index > 0 => {
                    self.mark_line(text);
                }
                Expression::TableConstructor(table) if role == FunctionRole::Rule => {
                    for field in table.fields() {
                        match field {
                            Field::NameKey { key, value, .. } => match &**value {
                                Expression::Function(function) if is_function_option(&text_of(key)) => {
                                    self.check_receiver(&pattern, function.body());
                                    self.prepare_function(value, function.body(), FunctionRole::Guard);
                                }
                                value => self.expression(value),
                            },
                            Field::NoKey(value) => self.expression(value),
                            _ => {}
                        }
                    }
                }
                other => self.expression(other),
            }
        }
        self.rule = outer;
    }

    /// Reports a function of a rule whose first parameter has the name of a parameter of the pattern.
    fn check_receiver(&mut self, pattern: &str, body: &FunctionBody) {
        let Some(Parameter::Name(first)) = body.parameters().iter().next() else { return };
        let name = text_of(first);
        let is_part = |letter: char| letter.is_alphanumeric() || letter == '_';
        // Names in brackets are those of parameters.
        let mut names = pattern.split('(').skip(1).filter_map(|part| part.split(')').next());
        // A name that begins with an underscore is not used.
        if name != "this"
            && !name.starts_with('_')
            && names.any(|names| names.split(|letter| !is_part(letter)).any(|known| known == name))
        {
            let message = format!("the first parameter is the object, not {name} of the module");
            let parameters = body.parameters().to_string();
            let help = format!("write function(this, {})", parameters.trim());
            self.problem(first, Error::argument(message).help(help));
        }
    }

    /// Inserts the number of the line on which a string successor begins before the string.
    fn mark_line(&mut self, text: &TokenReference) {
        let Some(begin) = text.start_position() else { return };
        // Luau ignores a line break directly after the opening bracket.
        let left_out = match text.token_type() {
            TokenType::StringLiteral { literal, quote_type: StringLiteralQuoteType::Brackets, .. } => {
                literal.starts_with(['\n', '\r'])
            }
            _ => false,
        };
        let line = begin.line() + usize::from(left_out);
        self.edit(begin.bytes(), begin.bytes(), format!("\"{}\"..", super::script::line_prefix(line)));
    }

    /// Walks a function of a rule, and marks it in the text as prepared. A function that only calculates with numbers comes
    /// with its formulas, and a function that returns the variables in them.
    fn prepare_function(&mut self, value: &Expression, body: &FunctionBody, role: FunctionRole) {
        if let (Some(begin), Some(end)) = (value.start_position(), end_of(value)) {
            self.edit(begin.bytes(), begin.bytes(), "__prepared(");
            let shapes = self.function(body, role, false);
            let shapes: String = shapes.iter().map(|shape| format!(", {shape}")).collect();
            let formulas = match role {
                FunctionRole::Guard => condition_of(body),
                _ => production_of(body),
            };
            let formulas = formulas.map_or_else(String::new, |FormulaText { code, outer }| {
                format!(", \"{code}\", function() return {} end", outer.join(", "))
            });
            self.edit(end.bytes(), end.bytes(), format!("{shapes}{formulas})"));
        }
    }

    /// Walks a function, with a `self` if it `is_method`. Returns the shapes of its returns.
    pub(super) fn function(
        &mut self,
        body: &FunctionBody,
        role: FunctionRole,
        is_method: bool,
    ) -> Vec<Cow<'static, str>> {
        self.walk_function(body, role, is_method).shapes
    }

    /// Walks a function, with a `self` if it `is_method`. Returns the facts about it.
    pub(super) fn walk_function(
        &mut self,
        body: &FunctionBody,
        role: FunctionRole,
        is_method: bool,
    ) -> Function {
        let is_axiom = std::mem::take(&mut self.axiom);
        let outside = self.variables.len();
        let start = first_position(body.block(), body.end_token());
        let mut parameters = body.parameters().iter();
        let rule = if role == FunctionRole::Other { None } else { self.rule.clone() };
        self.functions.push(Function::new(role, rule));
        if is_method {
            let id = self.facts.variables.len();
            self.facts.variables.push(Fact::default());
            self.variables.push(Variable {
                name: Cow::Borrowed("self"),
                id,
                function: self.functions.len() - 1,
                module: None,
                fresh: false,
                stream: false,
                feature: false,
                receiver: true,
                parameter: Some(0),
            });
        }
        for (index, parameter) in parameters.by_ref().enumerate() {
            let is_first = index == 0 && !is_method;
            if let Parameter::Name(name) = parameter {
                let id = self.declare(name, start);
                if let Some(variable) = self.variables.last_mut().filter(|variable| variable.id == id) {
                    variable.feature = is_axiom;
                    variable.receiver = is_first;
                    variable.parameter = Some(index + usize::from(is_method));
                }
            } else if let Some(function) = self.functions.last_mut() {
                function.is_variadic = true;
                if is_first {
                    // A variadic function can read any of its arguments.
                    (function.asks, function.asks_more) = (true, true);
                }
            }
        }
        self.block(body.block());
        self.variables.truncate(outside);
        let nothing = Function { pure: false, asks: true, asks_more: true, ..Function::new(role, None) };
        let mut function = self.functions.pop().unwrap_or(nothing);
        if let Some(begin) = body.parameters_parentheses().tokens().0.start_position() {
            *self.pure.entry(begin.line()).or_insert(true) &= function.pure;
            *self.blind.entry(begin.line()).or_insert(true) &= !function.asks;
            *self.asks_place.entry(begin.line()).or_insert(true) &= !function.asks_more;
            let divides = !function.asks && only_divides(body).is_some_and(|name| self.find(name).is_none());
            *self.divides.entry(begin.line()).or_insert(true) &= divides;
            let reads = self.reads.entry(begin.line()).or_insert_with(|| Some(BTreeSet::new()));
            match (function.is_variadic, reads.as_mut()) {
                (false, Some(reads)) => reads.extend(&function.reads),
                _ => *reads = None,
            }
            if role == FunctionRole::Guard {
                // The id distinguishes an outer variable from an earlier variable of the same name.
                let word = |token: String| match self.find(&token) {
                    Some(variable) => format!("{token}#{}", variable.id),
                    None => token,
                };
                let words: Vec<String> = body.tokens().map(|token| word(token.token().to_string())).collect();
                let text = Some(words.join(" "));
                keep_common(&mut self.guards, begin.line(), text, |one, other| one == other);
            }
            if let Some(line) = function.filled {
                self.filled.insert(begin.line(), line);
            }
            let form = (!is_method).then(|| signature(body));
            keep_common(&mut self.signatures, begin.line(), form, |one, other| {
                one.to_string() == other.to_string()
            });
            self.begins.push(begin.bytes());
            match self.functions.last_mut() {
                Some(outer) if role == FunctionRole::Other && outer.role != FunctionRole::Script => {
                    outer.queries.append(&mut function.queries);
                }
                _ if role == FunctionRole::Other => {}
                _ => self.queries.entry(begin.line()).or_default().append(&mut function.queries),
            }
        }
        function
    }

    pub(super) fn returns(&mut self, token: &TokenReference, values: &Punctuated<Expression>) {
        let role = self.functions.last().map_or(FunctionRole::Script, |function| function.role);
        if role != FunctionRole::Rule {
            return self.expressions(values);
        }
        self.expressions(values);
        if let Some(Expression::Var(Var::Name(name))) = values.iter().next().filter(|_| values.len() == 1)
            && self.find(&text_of(name)).is_some_and(|it| it.fresh && it.function + 1 == self.functions.len())
            && let Some(function) = self.functions.last_mut()
        {
            function.filled = function.filled.or(token.start_position().map(|position| position.line()));
        }
        let (Some(begin), Some(end)) = (token.end_position(), values.iter().last().and_then(end_of)) else {
            return;
        };
        let mut shape = ReturnPattern::default();
        if values.iter().all(|value| self.shape(value, &mut shape)) && shape.arguments.len() <= MOST_EMITTED {
            self.emit(begin.bytes(), end.bytes(), values, &shape);
        } else if values.len() == 1
            && matches!(values.iter().next(), Some(Expression::Symbol(symbol)) if text_of(symbol) == "nil")
        {
            self.edit(begin.bytes(), end.bytes(), " __erased");
        } else {
            self.edit(begin.bytes(), begin.bytes(), " __list(");
            self.edit(end.bytes(), end.bytes(), ")");
            let list = Cow::Borrowed("__list");
            if let Some(function) = self.functions.last_mut().filter(|it| !it.shapes.contains(&list)) {
                function.shapes.push(list);
            }
        }
    }

    /// Rewrites `return A(x), { B(y) }` as one call with the shape's number and the parameters in order.
    fn emit(&mut self, begin: usize, end: usize, values: &Punctuated<Expression>, shape: &ReturnPattern) {
        let number = self.globals.shapes.fetch_add(1, Ordering::Relaxed);
        self.edit(begin, begin, format!(" __emit{}({}", shape.arguments.len(), SHAPE + number));
        self.blank_items(values);
        for argument in &shape.arguments {
            match argument {
                ReturnArgument::At(from, to, open) => {
                    self.edit(*from, *from, if *open { ", (" } else { ", " });
                    self.edit(*to, *to, if *open { ")" } else { "" });
                }
                ReturnArgument::Missing(at) => self.edit(*at, *at, ", __omitted"),
            }
        }
        self.edit(end, end, ")");
        if let Some(function) = self.functions.last_mut() {
            let items = format!("{{ {}, {} }}", SHAPE + number, shape.items.join(", "));
            function.shapes.push(Cow::Owned(items));
        }
    }

    /// Adds the items of `value` to `shape`; `false` if the text does not show them.
    fn shape(&self, value: &Expression, shape: &mut ReturnPattern) -> bool {
        match value {
            Expression::FunctionCall(call) => {
                let suffixes: Vec<&Suffix> = call.suffixes().collect();
                let (Prefix::Name(name), [Suffix::Call(Call::AnonymousCall(arguments))]) =
                    (call.prefix(), suffixes.as_slice())
                else {
                    return false;
                };
                let FunctionArgs::Parentheses { parentheses, arguments } = &**arguments else { return false };
                let (Some(signature), Some(close)) =
                    (self.module(name), parentheses.tokens().1.start_position())
                else {
                    return false;
                };
                // The shape is created outside of the rule's function, so the module name must have the same meaning
                // there.
                let inside =
                    self.find(&text_of(name)).is_some_and(|known| known.function + 1 >= self.functions.len());
                let given = arguments.len();
                if inside || given < signature.required || given > signature.arity() {
                    return false;
                }
                shape.items.push(Cow::Owned(text_of(name)));
                for (index, argument) in arguments.iter().enumerate() {
                    let open = is_open(argument) && index + 1 == given;
                    if open && given < signature.arity() {
                        return false;
                    }
                    let (Some(from), Some(to)) = (argument.start_position(), end_of(argument)) else {
                        return false;
                    };
                    shape.arguments.push(ReturnArgument::At(from.bytes(), to.bytes(), open));
                }
                shape
                    .arguments
                    .extend((given..signature.arity()).map(|_| ReturnArgument::Missing(close.bytes())));
                true
            }
            Expression::TableConstructor(table) => {
                shape.items.push(Cow::Borrowed("0"));
                let known = table.fields().iter().all(|field| match field {
                    Field::NoKey(value) => self.shape(value, shape),
                    _ => false,
                });
                shape.items.push(Cow::Borrowed("1"));
                known
            }
            _ => false,
        }
    }

    /// Removes everything from a list of items except for the arguments.
    fn blank_items(&mut self, values: &Punctuated<Expression>) {
        for pair in values.pairs() {
            self.blank_item(pair.value());
            if let Some(comma) = pair.punctuation() {
                self.blank(comma);
            }
        }
    }

    fn blank_item(&mut self, value: &Expression) {
        match value {
            Expression::FunctionCall(call) => {
                if let Prefix::Name(name) = call.prefix() {
                    self.blank(name);
                }
                for suffix in call.suffixes() {
                    if let Suffix::Call(Call::AnonymousCall(arguments)) = suffix
                        && let FunctionArgs::Parentheses { parentheses, arguments } = &**arguments
                    {
                        let (open, close) = parentheses.tokens();
                        self.blank(open);
                        for comma in arguments.pairs().filter_map(|pair| pair.punctuation()) {
                            self.blank(comma);
                        }
                        self.blank(close);
                    }
                }
            }
            Expression::TableConstructor(table) => {
                let (open, close) = table.braces().tokens();
                self.blank(open);
                for pair in table.fields().pairs() {
                    if let Field::NoKey(value) = pair.value() {
                        self.blank_item(value);
                    }
                    if let Some(separator) = pair.punctuation() {
                        self.blank(separator);
                    }
                }
                self.blank(close);
            }
            _ => {}
        }
    }

    /// Removes a token.
    fn blank(&mut self, token: &TokenReference) {
        if let (Some(begin), Some(end)) = (token.start_position(), token.end_position()) {
            self.edit(begin.bytes(), end.bytes(), "");
        }
    }
}

/// Stores the value of a line; `None` if the values of the line differ.
fn keep_common<T>(
    values: &mut BTreeMap<usize, Option<T>>,
    line: usize,
    value: Option<T>,
    is_same: impl Fn(&T, &T) -> bool,
) {
    match values.entry(line) {
        Entry::Vacant(entry) => {
            entry.insert(value);
        }
        Entry::Occupied(mut entry) => {
            if !matches!((entry.get(), &value), (Some(known), Some(value)) if is_same(known, value)) {
                entry.insert(None);
            }
        }
    }
}

/// Returns the declared signature of a function.
pub(super) fn signature(body: &FunctionBody) -> CallForm {
    let luau = |of: Option<&TypeSpecifier>| {
        let text = of.map(|of| of.type_info().to_string());
        text.as_deref().unwrap_or("any").split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let arguments = body.parameters().iter().zip(body.type_specifiers()).map(|(parameter, of)| {
        let name = match parameter {
            Parameter::Name(name) => Cow::Owned(text_of(name)),
            _ => Cow::Borrowed("..."),
        };
        Argument::typed(name, luau(of))
    });
    CallForm { arguments: arguments.collect(), returns: luau(body.return_type()) }
}
