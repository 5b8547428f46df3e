//! Analysis of object types that scripts declare: the `self` of their functions, and its members.

use std::collections::BTreeMap;
use std::sync::Arc;

use full_moon::ast::{
    Assignment, BinOp, Expression, Field, FunctionArgs, Index, Prefix, Suffix, TableConstructor, Var,
};
use full_moon::node::Node;
use full_moon::tokenizer::TokenReference;

use super::calls::{CallCheck, expressions_of};
use super::inference::Inference;
use super::syntax::{end_of, string_of, text_of};
use super::walk::{FunctionRole, Walk};
use crate::Literal;
use burgeon_base::error::Error;
use burgeon_kit::{Kind, ScriptType, Value};

/// Returns the names of the functions that a declaration adds to a type.
fn added_names(table: &TableConstructor) -> Vec<String> {
    let mut names = Vec::new();
    for part in table.fields() {
        let Field::NameKey { value, .. } = part else { continue };
        let Expression::TableConstructor(functions) = &**value else { continue };
        names.extend(functions.fields().iter().filter_map(|function| match function {
            Field::NameKey { key, .. } => Some(text_of(key)),
            _ => None,
        }));
    }
    names
}

impl Walk<'_> {
    /// Wraps the value of an assignment to a field of `self` in a check at run time, so that a value that the state of
    /// an object cannot store is reported in this line.
    pub(super) fn check_state(&mut self, assignment: &Assignment) {
        let (mut variables, mut values) = (assignment.variables().iter(), assignment.expressions().iter());
        let (Some(Var::Expression(variable)), None) = (variables.next(), variables.next()) else { return };
        let (Some(value), None) = (values.next(), values.next()) else { return };
        let is_self = matches!(variable.prefix(), Prefix::Name(name) if text_of(name) == "self");
        let suffixes: Vec<&Suffix> = variable.suffixes().collect();
        let Some(Suffix::Index(Index::Dot { name, .. })) = suffixes.first().filter(|_| is_self) else {
            return;
        };
        if self.find("self").is_none() || is_plain(value) {
            return;
        }
        let (Some(begin), Some(end)) = (value.start_position(), end_of(value)) else { return };
        let direct = suffixes.len() == 1;
        self.edit(begin.bytes(), begin.bytes(), format!("__kept(self, \"{}\", {direct}, ", text_of(name)));
        self.edit(end.bytes(), end.bytes(), ")");
    }
}

/// Returns true if the syntax shows that a value is a number, a string, a boolean or nil.
fn is_plain(value: &Expression) -> bool {
    match value {
        Expression::Number(_) | Expression::String(_) | Expression::InterpolatedString(_) => true,
        Expression::Symbol(symbol) => text_of(symbol) != "...",
        Expression::UnaryOperator { .. } => true,
        Expression::BinaryOperator { binop, .. } => !matches!(binop, BinOp::And(_) | BinOp::Or(_)),
        Expression::Parentheses { expression, .. } => is_plain(expression),
        _ => false,
    }
}

impl<'a> CallCheck<'a, '_> {
    /// Walks the functions of `object(name, { ... })` or `extend(constructor, { ... })`, whose objects have that type.
    /// Returns the constructor, if the type is known.
    pub(super) fn declares(&mut self, word: &str, args: &FunctionArgs) -> Inference<'a> {
        let written = expressions_of(args);
        let first = written.first().map(|first| (self.expression(first), *first));
        let kind = match first {
            Some((_, Expression::String(text))) if word == "object" => {
                let name = string_of(text);
                let full = name.map(|name| match self.package {
                    Some(package) => format!("{package}.{name}"),
                    None => name,
                });
                full.and_then(|name| self.registry.get(&name)).map(Arc::as_ref)
            }
            Some((Inference::Constructor(kind), _)) if word == "extend" => Some(kind),
            _ => None,
        };
        match written.get(1) {
            Some(Expression::TableConstructor(table)) => {
                self.declaration(table, kind);
                if word == "extend" {
                    // If the script stops before this call, the registry does not contain these functions.
                    let of = kind.map(|kind| &*kind.name);
                    self.added.extend(added_names(table).into_iter().map(|name| (of, name)));
                }
            }
            Some(other) => drop(self.expression(other)),
            None => {}
        }
        kind.filter(|_| word == "object").map_or(Inference::Unknown, Inference::Constructor)
    }

    fn declaration(&mut self, table: &TableConstructor, kind: Option<&'a Kind>) {
        for field in table.fields() {
            let Field::NameKey { key, value, .. } = field else { continue };
            let role = match text_of(key).as_str() {
                "reads" => FunctionRole::Reading,
                "changes" | "begin" | "finish" | "push" | "pop" => FunctionRole::Changing,
                _ => {
                    self.expression(value);
                    continue;
                }
            };
            let outer = std::mem::replace(&mut self.role, role);
            match &**value {
                Expression::TableConstructor(functions) => {
                    for one in functions.fields() {
                        if let Field::NameKey { value, .. } = one {
                            self.declared_function(value, kind);
                        }
                    }
                }
                value => self.declared_function(value, kind),
            }
            self.role = outer;
        }
    }

    /// Walks a function of a type: alone, or in a table with its doc.
    fn declared_function(&mut self, value: &Expression, kind: Option<&'a Kind>) {
        match value {
            Expression::Function(function) => self.function(function.body(), kind),
            Expression::TableConstructor(described) => {
                for field in described.fields() {
                    match field {
                        Field::NoKey(value) => self.declared_function(value, kind),
                        Field::NameKey { value, .. } => drop(self.expression(value)),
                        _ => {}
                    }
                }
            }
            other => drop(self.expression(other)),
        }
    }

    /// Infers the value of a field or state variable of an object.
    pub(super) fn member(&mut self, kind: &'a Kind, name: &TokenReference) -> Inference<'a> {
        let (text, Some(script)) = (text_of(name), ScriptType::of(kind)) else { return Inference::Unknown };
        if let Some((_, held)) = script.held.iter().find(|(held, _)| **held == *text) {
            return Inference::Object(self.registry.get(&held.kind().name).unwrap_or(held.kind()));
        }
        if let Some(field) = script.fields.iter().find(|field| *field.name == *text) {
            return match (&field.describe().luau[..], &field.default) {
                ("number", Some(Value::Number(_))) => Inference::Value(Literal::Number),
                _ => Inference::Unknown,
            };
        }
        // A derived type may have members that this type lacks.
        let extends = |other: &Arc<Kind>| {
            let script =
                ScriptType::of(other).filter(|it| it.above.iter().any(|above| **above == *kind.name));
            script.is_some_and(|it| {
                it.fields.iter().any(|field| *field.name == *text) || it.state.get(&text).is_some()
            }) || script.is_some() && other.method(&text).is_some()
        };
        let known = kind.method(&text).is_some() || script.state.get(&text).is_some();
        if !known && !self.registry.kinds().any(extends) {
            self.problem(name, kind.unknown_method(&text));
        }
        Inference::Unknown
    }

    /// Returns true if an object of type `kind` may have the method `name` although the type is not known to have it.
    /// The file may add the method to the type or to an unknown type, or the object may be of a derived type.
    pub(super) fn may_be_above(&self, kind: &Kind, name: &str) -> bool {
        let above = |other: &Kind| {
            ScriptType::of(other).is_some_and(|script| script.above.iter().any(|above| **above == *kind.name))
        };
        let added_to = |of: Option<&str>| of.is_none_or(|of| *of == kind.name);
        self.added.iter().any(|(of, added)| added == name && added_to(*of))
            || matches!(self.role, FunctionRole::Reading | FunctionRole::Changing)
                && self.registry.kinds().any(|other| above(other) && other.method(name).is_some())
    }

    /// Checks an assignment to a variable or to a field.
    pub(super) fn assigned_to(&mut self, variable: &Var, value: &Inference) {
        let Var::Expression(inner) = variable else { return };
        let suffixes: Vec<&Suffix> = inner.suffixes().collect();
        let Some((Suffix::Index(Index::Dot { name, .. }), before)) = suffixes.split_last() else {
            return drop(self.suffixes(inner.prefix(), &suffixes));
        };
        let owner = self.suffixes(inner.prefix(), before);
        let (Inference::Object(kind), text) = (&owner, text_of(name)) else { return };
        let Some(script) = ScriptType::of(kind) else { return };
        let kind_name = &kind.name;
        let error = if self.role == FunctionRole::Reading {
            Error::scope(format!("{kind_name}: a read method assigns {text}"))
                .help("move it to the changes of the type, which interpretations can call")
        } else if self.role != FunctionRole::Changing || script.state.get(&text).is_some() {
            return;
        } else if script.fields.iter().any(|field| *field.name == *text) {
            Error::scope(format!("{text} is a field of {kind_name}, which only the constructor sets"))
                .help("keep changing values in the state")
        } else if self.registry.kinds().any(|other| {
            ScriptType::of(other).is_some_and(|it| {
                it.above.iter().any(|above| **above == **kind_name) && it.state.get(&text).is_some()
            })
        }) {
            return;
        } else {
            let error = Error::scope(format!("{kind_name}: unknown state variable `{text}`"));
            match value {
                Inference::Object(kind) => error.help(format!(
                    "declare the child object: state = {{ {text} = {}() }}, and call its methods: self.{text}:...",
                    kind.name
                )),
                _ => error.help(format!("declare it: state = {{ {text} = ... }}")),
            }
        };
        self.problem(name, error);
    }

    /// Records a value that is stored in a table in a variable, such as `M.lantern = object(...)`.
    pub(super) fn remember(&mut self, variable: &Var, value: Inference<'a>) {
        let Var::Expression(inner) = variable else { return };
        let suffixes: Vec<&Suffix> = inner.suffixes().collect();
        let (Prefix::Name(owner), [Suffix::Index(Index::Dot { name, .. })]) = (inner.prefix(), &suffixes[..])
        else {
            return;
        };
        let owner = text_of(owner);
        let Some((_, known)) = self.scope.iter_mut().rev().find(|(name, _)| *name == owner) else { return };
        let mut entries = match known {
            Inference::Table(entries) => BTreeMap::clone(entries),
            Inference::Value(Literal::Table) => BTreeMap::new(),
            _ => return,
        };
        let is_first = !entries.contains_key(&text_of(name));
        entries.insert(text_of(name), if is_first { value } else { Inference::Unknown });
        *known = Inference::Table(Arc::new(entries));
    }

    /// Infers the result of `self:as(lantern)`, the object as another type.
    pub(super) fn seen_as(&self, given: &[Inference<'a>]) -> Inference<'a> {
        match given.first() {
            Some(Inference::Constructor(kind)) => Inference::Object(kind),
            _ => Inference::Unknown,
        }
    }
}
