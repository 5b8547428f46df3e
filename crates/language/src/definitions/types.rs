//! Luau types of arguments, options and results.

use std::borrow::Cow;
use std::fmt::Write as _;

use burgeon_kit::{Argument, Construct, Field, Kind, is_keyword};

use super::writer::Writer;
use crate::form::{is_name, may_be_left_out};
use crate::luau_type::LuauType;
use crate::notation::{is_plain, key, optional};

impl Writer {
    /// Returns the arguments of a type's constructor; `None` if scripts cannot construct the type.
    pub(super) fn constructor(&mut self, kind: &Kind) -> Option<String> {
        let options = format!("{}Options", self.class_name(kind));
        let arguments = match (&kind.construct, &kind.first) {
            (Construct::Given, _) => return None,
            (Construct::File(loader), _) => {
                let file = if loader.several.is_empty() { "string" } else { "string | { string }" };
                match kind.fields.is_empty() {
                    true => format!("file: {file}"),
                    false => format!("file: {file}, options: {options}?"),
                }
            }
            // The first argument is either the options table or the value of the field. Luau infers neither from a
            // union.
            (Construct::Fields(_), Some(first)) => format!("{first}: any, options: {options}?"),
            (Construct::Fields(_), None) if kind.fields.is_empty() => String::new(),
            (Construct::Fields(_), None) => format!("options: {options}?"),
        };
        if !kind.fields.is_empty() {
            let table = self.table(&kind.fields);
            self.aliases.insert(options, Cow::Owned(table));
        }
        Some(arguments)
    }

    /// Returns a table type whose fields are all optional.
    fn table(&mut self, fields: &[Field]) -> String {
        let mut table = String::from("{\n");
        for field in fields {
            let luau = self.argument_type(field.luau.trim_end_matches('?'), &field.fields);
            let doc = field.doc.split_whitespace().collect::<Vec<_>>().join(" ");
            let _ = writeln!(table, "  --- {doc}\n  read {}: {},", key(&field.name), optional(&luau));
            for former in &field.former {
                let doc = format!("Deprecated since {}: use {}.", former.since, former.instead);
                let _ = writeln!(table, "  --- {doc}\n  read {}: {},", key(&former.name), optional(&luau));
            }
        }
        table + "}"
    }

    pub(super) fn arguments(&mut self, arguments: &[Argument], of_object: bool) -> String {
        let mut list: Vec<Cow<str>> = Vec::new();
        list.extend(of_object.then_some(Cow::Borrowed("self")));
        for argument in arguments {
            let luau = self.argument_type(&argument.luau, &argument.fields);
            let left_out = may_be_left_out(&argument.luau) && !may_be_left_out(&luau);
            // Keywords of Luau cannot be names.
            let more = if is_keyword(&argument.name) { "_" } else { "" };
            let optional = if left_out { "?" } else { "" };
            list.push(Cow::Owned(format!("{}{more}: {luau}{optional}", argument.name)));
        }
        list.join(", ")
    }

    /// Returns the Luau type of a value that a script receives.
    pub(super) fn got<'a>(&mut self, luau: &'a str) -> Cow<'a, str> {
        let found = LuauType::read(luau);
        if found == LuauType::Any {
            return Cow::Borrowed(if luau.contains('<') { luau } else { "any" });
        }
        self.type_text(found, false)
    }

    /// Returns the Luau type of a value that a script passes. `fields` are the fields of a table of named fields.
    fn argument_type<'a>(&mut self, luau: &'a str, fields: &[Field]) -> Cow<'a, str> {
        let name = luau.trim_end_matches('?');
        if !fields.is_empty() && is_name(name) {
            if !self.aliases.contains_key(name) {
                // The placeholder stops the recursion for types that contain themselves.
                self.aliases.insert(name.to_owned(), Cow::Borrowed(""));
                let table = self.table(fields);
                if let Some(alias) = self.aliases.get_mut(name) {
                    *alias = Cow::Owned(table);
                }
            }
            // Luau rejects a table in a variable that omits a field of the type.
            return Cow::Borrowed("any");
        }
        if !fields.is_empty() && matches!(name, "{ [string]: any }" | "{ ... }") {
            let mark = if luau.ends_with('?') { "?" } else { "" };
            let (table, options) = (self.table(fields), &self.options);
            let luau = format!("{options}{mark}");
            self.aliases.insert(options.clone(), Cow::Owned(table));
            return Cow::Owned(luau);
        }
        self.type_text(LuauType::read(luau), true)
    }

    fn type_text<'a>(&mut self, of: LuauType<'a>, taken: bool) -> Cow<'a, str> {
        Cow::Owned(match of {
            LuauType::Any | LuauType::Map => return Cow::Borrowed("any"),
            LuauType::Nil => return Cow::Borrowed("nil"),
            LuauType::Text(text) => format!("\"{text}\""),
            LuauType::Function(text) => return Cow::Borrowed(text),
            LuauType::Named(name) => {
                let like = format!("{name}Like");
                if matches!(&*name, "number" | "string" | "boolean" | "never" | "buffer") {
                    return name;
                }
                if taken && self.aliases.contains_key(&like) {
                    return Cow::Owned(like);
                }
                self.unknown.insert(name.to_string());
                return name;
            }
            LuauType::Union(mut of) => {
                let all = of.len();
                of.retain(|of| *of != LuauType::Nil);
                let is_optional = of.len() < all;
                let some: Vec<_> = of.into_iter().map(|of| self.type_text(of, taken)).collect();
                match (&some[..], is_optional) {
                    ([one], true) if !one.contains("->") => format!("{one}?"),
                    (_, true) => format!("({})?", some.join(" | ")),
                    (_, false) => some.join(" | "),
                }
            }
            // Luau gives a list of tables its own type and accepts it as no other type.
            LuauType::List(item) if taken && !is_plain(&item) => return Cow::Borrowed("any"),
            LuauType::List(item) => format!("{{ {} }}", self.type_text(*item, taken)),
            LuauType::Table(fields) => {
                let read = if taken { "read " } else { "" };
                let fields: Vec<String> = fields
                    .into_iter()
                    .map(|(name, of)| format!("{read}{name}: {}", self.type_text(of, taken)))
                    .collect();
                format!("{{ {} }}", fields.join(", "))
            }
        })
    }
}
