//! Results of names, fields, calls and methods in a script.

use full_moon::ast::{Expression, FunctionArgs};
use full_moon::tokenizer::TokenReference;

use super::calls::{CallCheck, expressions_of, field_named};
use super::inference::Inference;
use super::syntax::text_of;
use super::walk::FunctionRole;
use crate::slips::remedy_of_system_method;
use crate::{ArgumentList, Literal, Name, NameKind, SYSTEM, names};
use burgeon_base::error::Error;
use burgeon_kit::Construct;

impl<'a> CallCheck<'a, '_> {
    pub(super) fn infer_name(&self, name: &TokenReference) -> Inference<'a> {
        let text = text_of(name);
        if let Some((_, known)) = self.scope.iter().rev().find(|(name, _)| *name == text) {
            return known.clone();
        }
        if let Some(kind) = self.registry.get(&text) {
            return match kind.construct {
                Construct::Given => Inference::Unknown,
                _ => Inference::Constructor(kind),
            };
        }
        let given = |name: &&Name| name.name == text && name.sort != NameKind::Given;
        names().iter().find(given).map_or(Inference::Unknown, Inference::Name)
    }

    /// Infers the value of a field.
    pub(super) fn field(&mut self, of: &Inference<'a>, name: &TokenReference) -> Inference<'a> {
        let text = text_of(name);
        match of {
            Inference::Name(library) if !library.functions.is_empty() => {
                library.find(&text).map_or(Inference::Unknown, Inference::Name)
            }
            Inference::Given(given) => {
                let field = given.fields.iter().find(|field| field.name == text);
                field.map_or(Inference::Unknown, |field| self.of_type(&field.luau))
            }
            Inference::Table(entries) => entries.get(&text).cloned().unwrap_or(Inference::Unknown),
            Inference::Object(kind) => self.member(kind, name),
            _ => Inference::Unknown,
        }
    }

    /// Infers a value from its Luau type.
    fn of_type(&self, luau: &str) -> Inference<'a> {
        match luau {
            "number" => Inference::Value(Literal::Number),
            "boolean" => Inference::Value(Literal::Boolean),
            "" | "any" | "()" => Inference::Unknown,
            "System<T>" => Inference::System(None),
            _ => {
                let given = |name: &&Name| name.sort == NameKind::Given && name.luau == luau;
                if let Some(name) = names().iter().find(given) {
                    return Inference::Given(name);
                }
                let kind = self.registry.kinds().find(|kind| kind.luau() == luau);
                kind.map_or(Inference::Unknown, |kind| Inference::Object(kind))
            }
        }
    }

    /// Checks a function call and infers its result; `path` is the function as written in the script.
    pub(super) fn infer_call(
        &mut self,
        what: &Inference<'a>,
        word: Option<&TokenReference>,
        path: &str,
        args: &FunctionArgs,
    ) -> Inference<'a> {
        let Some(word) = word else {
            self.arguments(args);
            return Inference::Unknown;
        };
        match what {
            Inference::Constructor(kind) => {
                let given = self.arguments(args);
                self.hold_constructor(kind, word, args, &given);
                Inference::Object(kind)
            }
            Inference::Name(name) if matches!(&*name.name, "object" | "extend") => {
                self.declares(&name.name, args)
            }
            Inference::Name(name) if name.name == "require" => {
                let given = self.arguments(args);
                match (&given[..], self.required) {
                    ([Inference::Value(Literal::Text(name))], Some(required)) => required(name),
                    _ => Inference::Unknown,
                }
            }
            Inference::Name(name) if !name.forms.is_empty() => {
                let given = self.arguments(args);
                let is_module = matches!(name.sort, NameKind::Module { .. });
                if !is_module {
                    let is_luau = matches!(name.sort, NameKind::Luau | NameKind::Function);
                    self.hold_call(word, path, &ArgumentList::of_all(&name.forms), args, &given, is_luau);
                }
                self.result(name, args)
            }
            Inference::Local(form) => {
                let given = self.arguments(args);
                self.hold_local(path, form, args, &given);
                Inference::Unknown
            }
            _ => {
                self.arguments(args);
                Inference::Unknown
            }
        }
    }

    /// Infers the result of a function of the language.
    fn result(&mut self, name: &'static Name, args: &FunctionArgs) -> Inference<'a> {
        let [form] = &name.forms[..] else { return Inference::Unknown };
        if form.returns == "System<T>" {
            let object = expressions_of(args).first().and_then(|first| match first {
                Expression::TableConstructor(table) => field_named(table, "object"),
                _ => None,
            });
            let outer = std::mem::take(&mut self.problems);
            let known = object.map(|object| self.expression(object));
            self.problems = outer;
            return Inference::System(match known {
                Some(Inference::Object(kind) | Inference::Constructor(kind)) => Some(kind),
                _ => None,
            });
        }
        self.of_type(&form.returns)
    }

    /// Checks a method call and infers its result.
    pub(super) fn method(
        &mut self,
        of: &Inference<'a>,
        name: &TokenReference,
        args: &FunctionArgs,
    ) -> Inference<'a> {
        let text = text_of(name);
        match of {
            Inference::Object(kind) => {
                let given = self.arguments(args);
                let Some(method) = kind.method(&text) else {
                    if !self.may_be_above(kind, &text) {
                        self.problem(name, kind.unknown_method(&text));
                    }
                    return Inference::Unknown;
                };
                let full = format!("{}:{text}", kind.name);
                if method.call.changes() && matches!(self.role, FunctionRole::Rule | FunctionRole::Guard) {
                    let message = format!("{full} is a write method, so a rule cannot call it");
                    let help =
                        "use an interpretation rule: system:interpret(pattern, function(this, ...) ... end)";
                    self.problem(name, Error::scope(message).help(help));
                } else if method.call.changes() && self.role == FunctionRole::Reading {
                    let message = format!("{full} is a write method, so a read method cannot call it");
                    let help = "move it to the changes of the type";
                    self.problem(name, Error::scope(message).help(help));
                }
                if text == "as" {
                    return self.seen_as(&given);
                }
                self.hold_call(name, &full, &[ArgumentList(&method.arguments)], args, &given, false);
                match &*method.returns {
                    "" => Inference::Object(kind),
                    returns => self.of_type(returns),
                }
            }
            Inference::System(kind) => {
                let given = self.rule(&text, &expressions_of(args), *kind);
                let Some(method) = SYSTEM.find(&text) else {
                    let known = SYSTEM.part_names();
                    let message = format!("unknown method `{text}` of a system");
                    let error = Error::not_found("method", &text, known.iter().copied(), message);
                    self.problem(name, error.help(remedy_of_system_method(&text, &known)));
                    return Inference::Unknown;
                };
                let forms = ArgumentList::of_all(&method.forms);
                self.hold_call(name, &format!("system:{text}"), &forms, args, &given, false);
                match method.forms.first() {
                    Some(form) if form.returns == "System<T>" => Inference::System(*kind),
                    Some(form) => self.of_type(&form.returns),
                    None => Inference::Unknown,
                }
            }
            Inference::Given(known) => {
                let given = self.arguments(args);
                let Some(method) = known.find(&text) else { return Inference::Unknown };
                let full = format!("{}:{text}", known.name);
                self.hold_call(name, &full, &ArgumentList::of_all(&method.forms), args, &given, false);
                method.forms.first().map_or(Inference::Unknown, |form| self.of_type(&form.returns))
            }
            _ => {
                self.arguments(args);
                Inference::Unknown
            }
        }
    }
}
