//! Declarations of types, functions and values.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;

use burgeon_kit::{Construct, Expand, Kind, Method, Registry, Show, luau_name};

use crate::CallForm;
use crate::names::{Name, Operator};
use crate::notation::{capital, key, merge, module_form, with_parameters};
use crate::script_types::{members, plain_name};

/// Returns the Luau type of the values that a name describes: `Vector` for vector.
pub(super) fn type_name(name: &Name) -> String {
    luau_name(&name.name)
}

/// Writer of declarations.
#[derive(Default)]
pub(super) struct Writer {
    /// Names of declared types.
    pub(super) types: BTreeSet<String>,
    /// Names of used types.
    pub(super) unknown: BTreeSet<String>,
    /// Named tables of fields, and types that are accepted instead of another type.
    pub(super) aliases: BTreeMap<String, Cow<'static, str>>,
    pub(super) docs: BTreeMap<String, String>,
    /// Name of the next table of named fields.
    pub(super) options: String,
    /// Class names of the types that scripts declare, by type name.
    pub(super) classes: BTreeMap<String, String>,
}

impl Writer {
    fn doc(&mut self, out: &mut String, symbol: &str, doc: &str, indent: &str) {
        let doc = doc.split_whitespace().collect::<Vec<_>>().join(" ");
        let _ = writeln!(out, "{indent}--- {doc}");
        self.docs.insert(format!("@burgeon/{symbol}"), doc);
    }

    /// Declares the type of a returned value: a class if it has methods, otherwise a table or an alias.
    pub(super) fn declare_returned(&mut self, out: &mut String, name: &Name) {
        let own = type_name(name);
        if !name.instead.is_empty() {
            // A list with items of a type that Luau cannot infer is a list of `any`.
            let instead = match &*name.instead {
                "{ number }" => Cow::Owned(format!("{own} | {{ number }} | {{ any }}")),
                _ => Cow::Borrowed("any"),
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

    pub(super) fn class(&mut self, out: &mut String, own: &str, name: &Name, extends: &str) {
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
            // A type that is a function or a table hides the types of the function's parameters from the checker, so the
            // form with options is not declared.
            let takes_function =
                |form: &CallForm| form.arguments.iter().any(|it| it.luau.starts_with("(this:"));
            let is_hidden = function.forms.first().is_some_and(takes_function);
            let form = merge(if is_hidden { &function.forms[..1] } else { &function.forms });
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

    pub(super) fn kind(&mut self, out: &mut String, kind: &Kind) {
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
                Cow::Borrowed(&*own)
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

    pub(super) fn module(&mut self, out: &mut String, name: &Name, method: Option<&Method>) {
        let doc = method.map_or(String::new(), |method| format!("{} ", method.doc)) + &name.doc;
        self.doc(out, &format!("global/{}", name.name), &doc, "");
        let form = module_form(name, method);
        let arguments = self.arguments(&form.arguments, false);
        let _ = writeln!(out, "declare function {}({arguments}): Module\n", name.name);
    }

    /// Declares a function whose generic result depends on the type of the object, which is passed as an object or as
    /// its constructor.
    pub(super) fn object_function(
        &mut self,
        out: &mut String,
        name: &Name,
        generic: &str,
        registry: &Registry,
    ) {
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
    pub(super) fn class_name(&self, kind: &Kind) -> String {
        self.classes.get(&*kind.name).cloned().unwrap_or_else(|| kind.luau())
    }

    /// Declares the function that declares object types, with an overload for each known type name.
    pub(super) fn declaring(&mut self, out: &mut String, name: &Name, registry: &Registry) {
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

    pub(super) fn global(&mut self, out: &mut String, name: &Name) {
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
                "(fields: { ... }?) -> any" => Cow::Borrowed("(fields: any?) -> ScriptObject"),
                returns => self.got(returns),
            };
            let returns = if returns.contains("->") { Cow::Owned(format!("({returns})")) } else { returns };
            let generic = if returns == "T" { "<T>" } else { "" };
            let _ = writeln!(out, "declare function {}{generic}({arguments}): {returns}\n", name.name);
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
}
