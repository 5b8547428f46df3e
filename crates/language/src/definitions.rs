//! Definition file for editors: the scripting API in the syntax of Luau's type checker.
//!
//! If Luau's types cannot express a type, the file declares `any`, so valid scripts have no type errors. The types of
//! arguments are wider than the types of results, because Luau compares the types of lists and tables exactly.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use burgeon_kit::{Argument, Construct, Expand, Field, Kind, Method, Registry, Show, is_keyword};

use crate::form::{is_name, may_be_left_out};
use crate::luau_type::LuauType;
use crate::names::{Name, NameKind, OBJECT, Operator, names};
use crate::notation::{capital, is_plain, key, merge, module_form, optional, with_parameters};
use crate::script_types::{members, plain_name};

/// Definitions for editors.
#[derive(Debug, Clone)]
pub struct Definitions {
    /// Content of the definition file.
    pub luau: String,
    /// Documentation by the symbol that an editor looks up, such as `@burgeon/global/lerp`.
    pub docs: BTreeMap<String, String>,
}

/// Creates the definitions of the types in `registry` and of the language.
pub fn definitions(registry: &Registry) -> Definitions {
    let mut writer = Writer::default();
    for kind in registry.kinds().filter(|kind| kind.script.is_none()) {
        writer.types.insert(kind.luau());
        writer.types.extend(kind.family.as_ref().map(ToString::to_string));
    }
    writer.types.extend(names().iter().filter(|name| name.sort == NameKind::Given).map(type_name));
    writer.types.extend(["Module", "Object", "ScriptObject"].map(str::to_owned));
    for kind in registry.kinds().filter(|kind| kind.script.is_some()) {
        let mut own = kind.luau();
        // A script may declare a type whose Luau name is already used by Burgeon.
        while !writer.types.insert(own.clone()) {
            own.push_str("Type");
        }
        writer.classes.insert(kind.name.to_string(), own);
    }
    let mut body = String::new();
    for name in names().iter().filter(|name| name.sort == NameKind::Given) {
        writer.declare_returned(&mut body, name);
    }
    let mut families: Vec<&str> = registry.kinds().filter_map(|kind| kind.family.as_deref()).collect();
    families.sort_unstable();
    families.dedup();
    for family in families {
        let _ = writeln!(body, "declare class {family} extends Object end\n");
    }
    for kind in registry.kinds() {
        writer.kind(&mut body, kind);
    }
    // A derived system extends the model class, which must be declared first.
    let late: Vec<&Name> = names().iter().filter(|name| !name.extends.is_empty()).collect();
    late.into_iter().for_each(|name| writer.class(&mut body, &name.luau, name, &name.extends));
    for name in names() {
        match name.sort {
            NameKind::Given | NameKind::Function | NameKind::Luau => {}
            NameKind::Module { kind, method } => {
                let method = registry.get(kind).and_then(|kind| kind.method(method));
                writer.module(&mut body, name, method);
            }
            NameKind::Global if name.name == OBJECT.name => writer.declaring(&mut body, name, registry),
            NameKind::Global => match generic_returns(name) {
                Some(generic) => writer.object_function(&mut body, name, generic, registry),
                None => writer.global(&mut body, name),
            },
        }
    }
    let mut luau = String::from(
        "-- What Burgeon's scripts can use, for luau-lsp with Luau's new type solver. Written by: burgeon api --luau\n\n\
         -- A module, as the functions that module gives make it.\nexport type Module = any\n\n\
         declare class Object end\n\n\
         -- An object of a type that a script declares: what it has is known to that script alone.\n\
         declare class ScriptObject extends Object\n  [string]: any\nend\n\n",
    );
    for (alias, stands_for) in &writer.aliases {
        let _ = writeln!(luau, "export type {alias} = {stands_for}\n");
    }
    for unknown in writer.unknown.difference(&writer.types) {
        if !writer.aliases.contains_key(unknown) {
            let _ = writeln!(luau, "export type {unknown} = any\n");
        }
    }
    Definitions { luau: luau + body.trim_end() + "\n", docs: writer.docs }
}

/// Returns the Luau type of the values that a name describes: `Vector` for vector.
fn type_name(name: &Name) -> String {
    Kind::new(name.name.clone(), "").luau()
}

/// Returns the generic type that a function returns, without its type parameter: `System`.
fn generic_returns(name: &Name) -> Option<&str> {
    let mut returns = name.forms.iter().map(|form| form.returns.as_str());
    let generic = returns.find(|returns| names().iter().any(|it| it.is_generic() && it.luau == *returns))?;
    generic.strip_suffix("<T>")
}

#[derive(Default)]
struct Writer {
    /// Names of declared types.
    types: BTreeSet<String>,
    /// Names of used types.
    unknown: BTreeSet<String>,
    /// Named tables of fields, and types that are accepted instead of another type.
    aliases: BTreeMap<String, String>,
    docs: BTreeMap<String, String>,
    /// Name of the next table of named fields.
    options: String,
    /// Class names of the types that scripts declare, by type name.
    classes: BTreeMap<String, String>,
}

impl Writer {
    fn doc(&mut self, out: &mut String, symbol: &str, doc: &str, indent: &str) {
        let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
        let _ = writeln!(out, "{indent}--- {doc}");
        self.docs.insert(format!("@burgeon/{symbol}"), doc);
    }

    /// Declares the type of a returned value: a class if it has methods, otherwise a table or an alias.
    fn declare_returned(&mut self, out: &mut String, name: &Name) {
        let own = type_name(name);
        if !name.instead.is_empty() {
            // A list with items of a type that Luau cannot infer is a list of `any`.
            let instead = match &*name.instead {
                "{ number }" => format!("{own} | {{ number }} | {{ any }}"),
                _ => "any".to_owned(),
            };
            self.aliases.insert(format!("{own}Like"), instead);
        }
        if !name.extends.is_empty() {
            return;
        }
        if name.is_generic() {
            return self.generic(out, &own, name);
        }
        if !name.functions.is_empty() {
            return self.class(out, &own, name, "Object");
        }
        self.doc(out, &format!("globaltype/{own}"), &name.doc, "");
        if name.fields.is_empty() {
            let _ = writeln!(out, "export type {own} = {}\n", name.luau);
            return;
        }
        let _ = writeln!(out, "export type {own} = {{");
        // Items of a list and attributes of a feature are declared by their index type in brackets.
        if !name.items.is_empty() {
            let _ = writeln!(out, "  [number]: {},", name.items);
        }
        for field in &name.fields {
            let luau = self.got(field.luau.trim_end_matches('?'));
            if field.name.starts_with('[') {
                let _ = writeln!(out, "  {}: {luau},", field.name);
                continue;
            }
            self.doc(out, &format!("globaltype/{own}.{}", field.name), &field.doc, "  ");
            // Scripts can omit a field with the default nil.
            let optional = if field.default == "nil" { "?" } else { "" };
            let _ = writeln!(out, "  read {}: {luau}{optional},", field.name);
        }
        out.push_str("}\n\n");
    }

    fn class(&mut self, out: &mut String, own: &str, name: &Name, extends: &str) {
        self.doc(out, &format!("globaltype/{own}"), &name.doc, "");
        let _ = writeln!(out, "declare class {own} extends {extends}");
        for field in &name.fields {
            self.doc(out, &format!("globaltype/{own}.{}", field.name), &field.doc, "  ");
            let luau = self.got(&field.luau);
            let _ = writeln!(out, "  {}: {luau}", field.name);
        }
        for function in &name.functions {
            self.doc(out, &format!("globaltype/{own}.{}", function.name), &function.doc, "  ");
            let form = merge(&function.forms);
            let arguments = self.arguments(&form.arguments, true);
            let returns = self.got(&form.returns);
            let _ = writeln!(out, "  function {}({arguments}): {returns}", function.name);
        }
        for Operator { name, other, returns } in &name.operators {
            let other = if other.is_empty() { String::new() } else { format!(", other: {other}") };
            let _ = writeln!(out, "  function __{name}(self{other}): {returns}");
        }
        if !name.items.is_empty() {
            let _ = writeln!(out, "  [number]: {}", name.items);
        }
        out.push_str("end\n\n");
    }

    /// Declares a generic type, such as a system with the type of its object. A Luau class cannot have type parameters.
    fn generic(&mut self, out: &mut String, own: &str, name: &Name) {
        self.doc(out, &format!("globaltype/{own}"), &name.doc, "");
        let _ = writeln!(out, "export type {} = {{", name.luau);
        for function in &name.functions {
            self.doc(out, &format!("globaltype/{own}.{}", function.name), &function.doc, "  ");
            let form = merge(&function.forms);
            let mut arguments = vec![format!("self: {}", name.luau)];
            arguments.extend(form.arguments.iter().map(|argument| match &*argument.name {
                "..." => format!("...{}", argument.luau),
                name => format!("{name}: {}", with_parameters(&argument.luau)),
            }));
            let returns = &form.returns;
            let _ = writeln!(out, "  read {}: ({}) -> {returns},", function.name, arguments.join(", "));
        }
        out.push_str("}\n\n");
    }

    fn kind(&mut self, out: &mut String, kind: &Kind) {
        let own = self.class_name(kind);
        self.doc(out, &format!("globaltype/{own}"), &kind.doc, "");
        let _ = writeln!(out, "declare class {own} extends {}", kind.family.as_deref().unwrap_or("Object"));
        let read = if matches!(kind.construct, Construct::Given) { &kind.fields[..] } else { &[] };
        for field in read {
            self.doc(out, &format!("globaltype/{own}.{}", field.name), &field.doc, "  ");
            let luau = self.got(field.luau.trim_end_matches('?'));
            let _ = writeln!(out, "  {}: {luau}", field.name);
        }
        for (name, luau) in members(kind) {
            let luau = self.got(&luau);
            let _ = writeln!(out, "  {name}: {luau}");
        }
        for method in &kind.methods {
            let doubled = kind
                .script
                .as_ref()
                .is_some_and(|it| it.member_names().iter().any(|part| *part == method.name));
            if doubled {
                // A class cannot have a state variable and a method of the same name.
                let _ = writeln!(out, "  {}: any", method.name);
                continue;
            }
            self.doc(out, &format!("globaltype/{own}.{}", method.name), &method.doc, "  ");
            self.options = format!("{own}{}Options", capital(&method.name));
            let arguments = self.arguments(&method.arguments, true);
            // A method without a result returns the object itself, so that calls can be chained.
            let returns = if method.returns.is_empty() {
                own.clone()
            } else {
                self.got(method.returns.trim_end_matches('?'))
            };
            let _ = writeln!(out, "  function {}({arguments}): {returns}", method.name);
        }
        out.push_str("end\n\n");
        if let Some(arguments) = self.constructor(kind).filter(|_| kind.script.is_none()) {
            self.doc(out, &format!("global/{}", kind.name), &kind.doc, "");
            let _ = writeln!(out, "declare function {}({arguments}): {own}\n", kind.name);
        }
    }

    /// Returns the arguments of a type's constructor; `None` if scripts cannot construct the type.
    fn constructor(&mut self, kind: &Kind) -> Option<String> {
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

    fn arguments(&mut self, arguments: &[Argument], of_object: bool) -> String {
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

    fn module(&mut self, out: &mut String, name: &Name, method: Option<&Method>) {
        let doc = method.map_or(String::new(), |method| format!("{} ", method.doc)) + &name.doc;
        self.doc(out, &format!("global/{}", name.name), &doc, "");
        let form = module_form(name, method);
        let arguments = self.arguments(&form.arguments, false);
        let _ = writeln!(out, "declare function {}({arguments}): Module\n", name.name);
    }

    /// Declares a function whose generic result depends on the type of the object, which is passed as an object or as
    /// its constructor.
    fn object_function(&mut self, out: &mut String, name: &Name, generic: &str, registry: &Registry) {
        let given = |of: &str| format!("{generic}<{of}>");
        self.doc(out, &format!("global/{}", name.name), &name.doc, "");
        let _ = writeln!(out, "declare {}:", name.name);
        let _ = writeln!(out, "  (<T>(options: {{ read object: T & Object }}) -> {})", given("T"));
        let _ = writeln!(
            out,
            "  & ((options: {{ read object: (fields: any?) -> ScriptObject }}) -> {})",
            given("ScriptObject")
        );
        // Those that neither draw nor divide anything are of no use to a system.
        let of_use = |kind: &&std::sync::Arc<Kind>| {
            kind.has_capability::<dyn Show>() || kind.has_capability::<dyn Expand>()
        };
        for kind in registry.kinds().filter(of_use) {
            if let (Construct::Fields(_), Some(arguments)) = (&kind.construct, self.constructor(kind)) {
                let own = self.class_name(kind);
                let _ = writeln!(
                    out,
                    "  & ((options: {{ read object: ({arguments}) -> {own} }}) -> {})",
                    given(&own)
                );
            }
        }
        // Without an object, the seed is the only useful option. Luau cannot resolve more overloads.
        for field in name.options().filter(|field| field.name == "seed") {
            let luau = field.luau.trim_end_matches('?');
            let _ = writeln!(out, "  & ((options: {{ read seed: {luau} }}) -> {})", given("any"));
        }
        let _ = writeln!(out, "  & (() -> {})\n", given("any"));
    }

    /// Returns the Luau class name of a type.
    fn class_name(&self, kind: &Kind) -> String {
        self.classes.get(&*kind.name).cloned().unwrap_or_else(|| kind.luau())
    }

    /// Declares the function that declares object types, with an overload for each known type name.
    fn declaring(&mut self, out: &mut String, name: &Name, registry: &Registry) {
        let scripts: Vec<_> = registry.kinds().filter(|kind| kind.script.is_some()).collect();
        let is_alone =
            |kind: &Kind| scripts.iter().filter(|other| plain_name(other) == plain_name(kind)).count() == 1;
        let own: Vec<String> = scripts
            .iter()
            .filter(|kind| is_alone(kind))
            .filter_map(|kind| {
                let (arguments, class) = (self.constructor(kind)?, self.class_name(kind));
                Some(format!(
                    "(name: \"{}\", declaration: any) -> (({arguments}) -> {class})",
                    plain_name(kind)
                ))
            })
            .collect();
        if own.is_empty() {
            return self.global(out, name);
        }
        self.doc(out, &format!("global/{}", name.name), &name.doc, "");
        let _ = writeln!(out, "declare {}:", name.name);
        for (index, form) in own.iter().enumerate() {
            let and = if index == 0 { "" } else { "& " };
            let _ = writeln!(out, "  {and}({form})");
        }
        let _ = writeln!(out, "  & ((name: string, declaration: any) -> ((fields: any?) -> ScriptObject))\n");
    }

    fn global(&mut self, out: &mut String, name: &Name) {
        self.doc(out, &format!("global/{}", name.name), &name.doc, "");
        let default = name.options().find(|field| field.name == "default");
        if let (Some(_), [form]) = (default, &name.forms[..]) {
            // The result has the type of the default.
            let (first, returns) = (&form.arguments[0], "T");
            let _ = writeln!(
                out,
                "declare function {}<T>({}: {}, options: {{ read default: T }}): {returns}\n",
                name.name, first.name, first.luau
            );
        } else if !name.functions.is_empty() {
            let _ = writeln!(out, "declare {}: {{", name.name);
            for field in &name.fields {
                let luau = self.got(&field.luau);
                self.doc(out, &format!("global/{}.{}", name.name, field.name), &field.doc, "  ");
                let _ = writeln!(out, "  read {}: {luau},", field.name);
            }
            for function in &name.functions {
                self.doc(out, &format!("global/{}.{}", name.name, function.name), &function.doc, "  ");
                let form = merge(&function.forms);
                let arguments = self.arguments(&form.arguments, false);
                let returns = self.got(&form.returns);
                let field = key(&function.name);
                let _ = writeln!(out, "  read {field}: ({arguments}) -> {returns},");
            }
            out.push_str("}\n\n");
        } else if let [form] = &name.forms[..] {
            self.options = format!("{}Options", capital(&name.name));
            let arguments = self.arguments(&form.arguments, false);
            // The function returns a constructor of a type that a script declares.
            let returns = match &*form.returns {
                "(fields: { ... }?) -> any" => "(fields: any?) -> ScriptObject".to_owned(),
                returns => self.got(returns),
            };
            let returns = if returns.contains("->") { format!("({returns})") } else { returns };
            let _ = writeln!(out, "declare function {}({arguments}): {returns}\n", name.name);
        } else if name.forms.is_empty() {
            let luau = self.got(&name.luau);
            let _ = writeln!(out, "declare {}: {luau}\n", name.name);
        } else {
            // For overloads with arguments of different types, Luau often finds no match, so the arguments are declared
            // as `any`.
            let forms = name.forms.iter().map(|form| form.arguments.iter().map(|it| it.name.to_string()));
            let names: Vec<String> = forms.max_by_key(ExactSizeIterator::len).into_iter().flatten().collect();
            let arguments: Vec<String> = names.iter().map(|name| format!("{name}: any")).collect();
            let _ = writeln!(out, "declare function {}({}): any\n", name.name, arguments.join(", "));
        }
    }

    /// Returns the Luau type of a value that a script receives.
    fn got(&mut self, luau: &str) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn everything_is_declared_once_and_keeps_to_the_names_of_luau() {
        let definitions = definitions(&burgeon_objects::registry());
        let mut declared = BTreeSet::new();
        for line in definitions.luau.lines() {
            assert!(!line.contains(" end:"), "{line}");
            let words: Vec<&str> = line.split([' ', '(', '<', ':']).collect();
            if let [_, what @ ("class" | "function" | "type"), name, ..] = &words[..]
                && !line.starts_with(' ')
            {
                assert!(declared.insert((*what == "function", *name)), "{name}");
            }
        }
        assert!(declared.len() > 80, "{}", declared.len());
    }
}
