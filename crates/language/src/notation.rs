//! Notation of signatures and types for Luau's type checker.

use std::borrow::Cow;

use burgeon_kit::{Argument, Method, is_keyword, luau_name};

use crate::form::{CallForm, argument, is_name};
use crate::luau_type::LuauType;
use crate::names::Name;

/// Returns true if Luau infers the type of a list of such items, regardless of the code that creates it.
pub(crate) fn is_plain(item: &LuauType) -> bool {
    match item {
        LuauType::Named(name) => matches!(&**name, "number" | "string" | "boolean"),
        _ => false,
    }
}

/// Formats the name of a field in a table type.
pub(crate) fn key(name: &str) -> Cow<'_, str> {
    if is_keyword(name) { Cow::Owned(format!("[\"{name}\"]")) } else { Cow::Borrowed(name) }
}

/// Formats a type as optional.
pub(crate) fn optional(luau: &str) -> Cow<'_, str> {
    let is_one = is_name(luau) || luau.starts_with('{') && luau.find('}') == Some(luau.len() - 1);
    match luau {
        "any" => Cow::Borrowed(luau),
        _ if is_one => Cow::Owned(format!("{luau}?")),
        _ => Cow::Owned(format!("({luau})?")),
    }
}

/// Formats a name as a part of a type name.
pub(crate) fn capital(name: &str) -> String {
    luau_name(name)
}

/// Returns the signature of a module's constructor, completed by the arguments of the method that it calls.
pub fn module_form(name: &Name, method: Option<&Method>) -> CallForm {
    let mut form = name.forms.first().cloned().unwrap_or_default();
    for (index, argument) in form.arguments.iter_mut().enumerate() {
        if let Some(known) = method.and_then(|method| method.arguments.get(index)) {
            let optional = if argument.luau.ends_with('?') && !known.luau.ends_with('?') { "?" } else { "" };
            argument.luau = format!("{}{optional}", known.luau);
            argument.unit.clone_from(&known.unit);
            match known.default.as_str() {
                "" => {}
                default => default.clone_into(&mut argument.default),
            }
            argument.fields.clone_from(&known.fields);
        }
    }
    form
}

/// Replaces variadic arguments in a function type by named parameters. Luau infers the parameters of a function
/// expression in a call only from named parameters.
pub(crate) fn with_parameters(luau: &str) -> String {
    let parameters: String = ('a'..='l').map(|name| format!("{name}: any, ")).collect();
    luau.replace("this: T, ...any", &format!("this: T, {parameters}...any"))
}

/// Merges several signatures into one. Arguments that not all of them have are optional.
///
/// Luau infers the parameters of a function expression only if there is one signature and the argument's type is not a
/// union. The alternative type `string` is therefore removed from arguments that only some signatures have.
pub(crate) fn merge(forms: &[CallForm]) -> CallForm {
    let Some((first, others)) = forms.split_first() else { return CallForm::default() };
    let mut form = first.clone();
    for other in others {
        let variadic = |form: &CallForm| form.arguments.last().is_some_and(|last| last.name == "...");
        if variadic(&form) || variadic(other) {
            form.arguments = vec![argument("...", "any")];
            continue;
        }
        for (index, argument) in other.arguments.iter().enumerate() {
            match form.arguments.get_mut(index) {
                Some(known) if known.luau == argument.luau => {}
                Some(known) => {
                    // In a union, the parameters of a function type must accept every possible argument, so they are
                    // `never`.
                    let known_luau = known.luau.replace("...any)", "...never)");
                    let luau = format!("{known_luau} | {}", in_place(argument));
                    *known = Argument { luau, ..argument.clone() };
                }
                None => {
                    let luau = argument.luau.trim_end_matches(" | string");
                    form.arguments.push(Argument { luau: format!("({luau})?"), ..argument.clone() });
                }
            }
        }
    }
    form
}

/// Returns the type of an argument. If it is a table with fields, the table type is written out.
fn in_place(argument: &Argument) -> Cow<'_, str> {
    if argument.fields.is_empty() {
        return Cow::Borrowed(&argument.luau);
    }
    let fields = argument.fields.iter().map(|field| {
        let luau = with_parameters(field.luau.trim_end_matches('?'));
        format!("read {}: {}", key(&field.name), optional(luau.trim()))
    });
    Cow::Owned(format!("{{ {} }}", fields.collect::<Vec<_>>().join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_form_takes_what_any_of_several_takes() {
        let forms = ["(a: string, b: (...any) -> any) -> T", "(a: string, b: number, c: boolean) -> T"];
        let forms: Vec<CallForm> = forms.iter().filter_map(|form| CallForm::read(form)).collect();
        let form = merge(&forms);
        assert_eq!(form.to_string(), "(a: string, b: (...never) -> any | number, c: (boolean)?) -> T");
        let forms = ["(...Module) -> T", "(source: Layer, chain: any) -> T"];
        let forms: Vec<CallForm> = forms.iter().filter_map(|form| CallForm::read(form)).collect();
        assert_eq!(merge(&forms).to_string(), "(...any) -> T");
    }
}
