//! Object types that scripts declare, in the form for editors.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::Arc;

use burgeon_kit::{Kind, Registry, ScriptType, Value};

/// Adds the types that scripts declare to `registry`, and the methods that they add to other types.
///
/// Several scripts of a folder may declare a type of the same name. If the declarations differ, the type is omitted.
pub fn with_types(registry: &Registry, declared: impl IntoIterator<Item = Arc<Kind>>) -> Registry {
    let mut kinds: Vec<Arc<Kind>> = registry.kinds().cloned().collect();
    let own = kinds.len();
    let mut differing: Vec<String> = Vec::new();
    for mut kind in declared {
        match kinds.iter().position(|known| known.name == kind.name) {
            None => kinds.push(kind),
            Some(place) if place < own => {
                let known = Arc::make_mut(&mut kinds[place]);
                let mut more = std::mem::take(&mut Arc::make_mut(&mut kind).methods);
                more.retain(|method| !known.methods.iter().any(|it| it.name == method.name));
                known.methods.append(&mut more);
            }
            Some(place) if is_same(&kinds[place], &kind) => {}
            Some(_) => differing.push(kind.name.to_string()),
        }
    }
    kinds.into_iter().filter(|kind| !differing.iter().any(|name| kind.name == *name)).collect()
}

/// Returns true if two types have the same members.
fn is_same(one: &Kind, other: &Kind) -> bool {
    let names = |kind: &Kind| -> Vec<String> {
        let fields = kind.fields.iter().map(|field| format!("{}: {}", field.name, field.luau));
        let methods = kind.methods.iter().map(|method| format!("{}/{}", method.name, method.arguments.len()));
        let state = members(kind).into_iter().map(|(name, luau)| format!("{name}: {luau}"));
        fields.chain(methods).chain(state).collect()
    };
    names(one) == names(other)
}

/// Returns the name of a type as its script writes it, without the package.
pub(crate) fn plain_name(kind: &Kind) -> &str {
    kind.name.rsplit('.').next().unwrap_or(&kind.name)
}

/// Returns the fields and state variables of a type that a script declares, with their types.
pub(crate) fn members(kind: &Kind) -> BTreeMap<String, Cow<'static, str>> {
    let Some(script) = ScriptType::of(kind) else { return BTreeMap::new() };
    let mut members = BTreeMap::new();
    for field in &script.fields {
        let mut luau = field.describe().luau;
        luau.truncate(luau.trim_end_matches('?').len());
        members.insert(field.name.to_string(), Cow::Owned(luau));
    }
    for (key, value) in &script.state.entries {
        let luau = match value {
            Value::Number(_) => "number",
            Value::Boolean(_) => "boolean",
            Value::Text(_) => "string",
            _ => "any",
        };
        if let burgeon_kit::TableKey::Name(name) = key {
            members.insert(name.to_string(), Cow::Borrowed(luau));
        }
    }
    for (name, object) in &script.held {
        members.insert(name.to_string(), Cow::Owned(object.kind().luau()));
    }
    // A name that is also a method can mean either, depending on the syntax of the access.
    members.retain(|name, _| kind.method(name).is_none());
    members
}
