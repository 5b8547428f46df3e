//! Luau types of arguments, options and results.

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
        if !kind.fields.is_empty() && !matches!(kind.construct, Construct::Given) {
            let table = self.table(&kind.fields);
            self.aliases.insert(options.clone(), table);
        }
        Some(match (&kind.construct, &kind.first) {
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
        })
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
        let mut list: Vec<String> = if of_object { vec!["self".to_owned()] } else { Vec::new() };
        for argument in arguments {
            let luau = self.argument_type(&argument.luau, &argument.fields);
            let left_out = may_be_left_out(&argument.luau) && !may_be_left_out(&luau);
            // Keywords of Luau cannot be names.
            let more = if is_keyword(&argument.name) { "_" } else { "" };
            let optional = if left_out { "?" } else { "" };
            list.push(format!("{}{more}: {luau}{optional}", argument.name));
        }
        list.join(", ")
    }

    /// Returns the Luau type of a value that a script receives.
    pub(super) fn got(&mut self, luau: &str) -> String {
        let found = LuauType::read(luau);
        if found == LuauType::Any {
            return if luau.contains('<') { luau.to_owned() } else { "any".to_owned() };
        }
        self.type_text(&found, false)
    }

    /// Returns the Luau type of a value that a script passes. `fields` are the fields of a table of named fields.
    fn argument_type(&mut self, luau: &str, fields: &[Field]) -> String {
        let name = luau.trim_end_matches('?');
        if !fields.is_empty() && is_name(name) {
            if !self.aliases.contains_key(name) {
                // The placeholder stops the recursion for types that contain themselves.
                self.aliases.insert(name.to_owned(), String::new());
                let table = self.table(fields);
                self.aliases.insert(name.to_owned(), table);
            }
            // Luau rejects a table in a variable that omits a field of the type.
            return "any".to_owned();
        }
        if !fields.is_empty() && matches!(name, "{ [string]: any }" | "{ ... }") {
            let mark = if luau.ends_with('?') { "?" } else { "" };
            let (options, table) = (self.options.clone(), self.table(fields));
            self.aliases.insert(options.clone(), table);
            return options + mark;
        }
        self.type_text(&LuauType::read(luau), true)
    }

    fn type_text(&mut self, of: &LuauType, taken: bool) -> String {
        match of {
            LuauType::Any => "any".to_owned(),
            LuauType::Nil => "nil".to_owned(),
            LuauType::Text(text) => format!("\"{text}\""),
            LuauType::Function(text) => text.clone(),
            LuauType::Named(name)
                if matches!(&**name, "number" | "string" | "boolean" | "never" | "buffer") =>
            {
                name.clone()
            }
            LuauType::Named(name) => {
                let like = format!("{name}Like");
                if taken && self.aliases.contains_key(&like) {
                    return like;
                }
                self.unknown.insert(name.clone());
                name.clone()
            }
            LuauType::Union(of) => {
                let is_optional = of.contains(&LuauType::Nil);
                let some = of.iter().filter(|of| **of != LuauType::Nil);
                let some: Vec<String> = some.map(|of| self.type_text(of, taken)).collect();
                match (&some[..], is_optional) {
                    ([one], true) if !one.contains("->") => format!("{one}?"),
                    (_, true) => format!("({})?", some.join(" | ")),
                    (_, false) => some.join(" | "),
                }
            }
            // Luau gives a list of tables its own type and accepts it as no other type.
            LuauType::List(item) if taken && !is_plain(item) => "any".to_owned(),
            LuauType::List(item) => format!("{{ {} }}", self.type_text(item, taken)),
            LuauType::Map => "any".to_owned(),
            LuauType::Table(fields) => {
                let read = if taken { "read " } else { "" };
                let fields: Vec<String> = fields
                    .iter()
                    .map(|(name, of)| format!("{read}{name}: {}", self.type_text(of, taken)))
                    .collect();
                format!("{{ {} }}", fields.join(", "))
            }
        }
    }
}
