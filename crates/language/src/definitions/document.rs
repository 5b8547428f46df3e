//! Assembles the definition file.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use burgeon_kit::Registry;

use super::writer::{Writer, type_name};
use crate::names::{Name, NameKind, OBJECT, names};

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

/// Returns the generic type that a function returns, without its type parameter: `System`.
fn generic_returns(name: &Name) -> Option<&str> {
    let mut returns = name.forms.iter().map(|form| form.returns.as_str());
    let generic = returns.find(|returns| names().iter().any(|it| it.is_generic() && it.luau == *returns))?;
    generic.strip_suffix("<T>")
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

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
