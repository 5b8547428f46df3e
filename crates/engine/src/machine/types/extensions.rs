//! Functions that scripts and packages add to object types with `extend`.
//!
//! Two packages may add methods of the same name to a type. Each is available by its qualified name, such as
//! `castle_turret`. The plain name refers to the method of the calling package, or of a package that the
//! caller has required.

use std::collections::BTreeMap;

use mlua::{Lua, Table, Value as LuaValue};

use super::handles::methods_key;
use super::mentions::extended_kind;
use super::script_types::{Role, ScriptFunction, ScriptTypeParts, refuse_unknown};
use crate::declare::qualified_name;
use crate::machine::Machine;
use crate::machine::library::Library;
use burgeon_base::error::{Error, Result};
use burgeon_language::EXTEND;

/// Function that was added to a type.
pub(crate) struct Extension {
    /// Name of the type.
    pub kind: String,
    /// Package that adds the function; empty for the script.
    pub owner: String,
    pub function: ScriptFunction,
}

/// Methods that several packages have added, by name: the full names by package.
pub(super) type NameConflicts = BTreeMap<String, BTreeMap<String, String>>;

/// Returns the internal name of the function that `owner` has added as `name`. Scripts cannot use such names.
fn full_name(owner: &str, name: &str) -> String {
    format!("{owner}.{name}")
}

/// Returns true if a name is an internal name.
pub(super) fn is_full_name(name: &str) -> bool {
    name.contains('.')
}

/// Adds the extensions of `kind` to the `functions` of a type that inherits from it.
pub(super) fn inherit(
    extensions: &[Extension],
    kind: &str,
    functions: &mut Vec<ScriptFunction>,
    contested: &mut NameConflicts,
) {
    let of_kind = || extensions.iter().filter(|known| known.kind == kind);
    for Extension { owner, function, .. } in of_kind() {
        let named = |name: String| ScriptFunction { name, ..function.clone() };
        let same = of_kind().filter(|other| other.function.name == function.name);
        let owners: BTreeMap<String, String> =
            same.map(|other| (other.owner.clone(), full_name(&other.owner, &function.name))).collect();
        functions.push(named(full_name(owner, &function.name)));
        let qualified = qualified_name(owner, &function.name);
        if !owner.is_empty() && !functions.iter().any(|known| known.name == qualified) {
            functions.push(named(qualified));
        }
        match owners.len() {
            1 => functions.push(function.clone()),
            _ => {
                contested.insert(function.name.clone(), owners);
            }
        }
    }
}

/// Returns which of `owners` the running file refers to with the method `name` of the type `kind`. All of
/// `owners` have added such a method.
pub(in crate::machine) fn claim(
    library: &Library,
    lua: &Lua,
    kind: &str,
    name: &str,
    mut owners: Vec<String>,
) -> Result<String> {
    let scope = library.scope_at(lua);
    let own = scope.package.as_deref().unwrap_or("");
    let is_required = |index: &usize| scope.required.contains(owners[*index].as_str());
    let required: Vec<usize> = (0..owners.len()).filter(is_required).collect();
    let meant = match (owners.iter().position(|owner| owner == own), required.as_slice()) {
        (Some(index), _) | (None, &[index]) => Some(index),
        _ => None,
    };
    if let Some(index) = meant {
        return Ok(owners.swap_remove(index));
    }
    let shown = owners.iter().map(|owner| if owner.is_empty() { "the script" } else { owner.as_str() });
    let mut all: Vec<&str> = shown.collect();
    all.sort();
    let named = owners.iter().filter(|owner| !owner.is_empty());
    let mut named: Vec<String> =
        named.map(|owner| format!("this:{}(...)", qualified_name(owner, name))).collect();
    named.sort();
    Err(Error::argument(format!("{name} is a method of {kind} added by {}", all.join(" and ")))
        .help(format!("specify one: {}", named.join(" or "))))
}

/// Implements `extend(constructor, declared)`, which adds functions to a type.
pub(in crate::machine) fn extend_type(
    machine: &Machine,
    constructor: &LuaValue,
    declared: &LuaValue,
) -> Result<()> {
    machine.library.at_top_level("extend")?;
    let usage = {
        let registry = machine.library.registry.borrow();
        let named = extended_kind(&registry).unwrap_or("constructor");
        format!("write extend({named}, {{ reads = {{ ... }}, changes = {{ ... }} }})")
    };
    let kind = match constructor {
        LuaValue::Function(function) => machine.library.kind_of(function),
        _ => None,
    };
    let kind = kind.ok_or_else(|| {
        Error::argument(format!(
            "the first argument of extend must be an object type, not a {}",
            constructor.type_name()
        ))
        .help(&usage)
    })?;
    let LuaValue::Table(declared) = declared else {
        return Err(Error::argument("the second argument of extend must be a table").help(usage));
    };
    refuse_unknown("extend", declared, &EXTEND.part_names())?;
    let mut parts = ScriptTypeParts::default();
    parts.add(declared, &|part| format!("{part} of extend({})", kind.name))?;
    let lua = machine.lua();
    let owner = Machine::asker(lua, &machine.session).map_or("", |package| package.manifest.name.as_str());
    let types = machine.library.script_types.borrow();
    let of = types.iter().find(|known| known.kind.name == kind.name).map(|known| known.table.clone());
    let add = || -> mlua::Result<()> {
        let methods: Table = lua.named_registry_value(&methods_key(&kind.name))?;
        let (reads, changes) = (lua.create_table()?, lua.create_table()?);
        for known in &parts.functions {
            let is_there = methods.raw_get::<LuaValue>(known.name.as_str())? != LuaValue::Nil;
            if is_there && !is_added_by_others(machine, &kind.name, owner, &known.name) {
                let text = format!("{} already has a method `{}`", kind.name, known.name);
                return Err(mlua::Error::external(Error::argument(text).help("rename this one")));
            }
            let into = if known.role == Role::Read { &reads } else { &changes };
            into.raw_set(known.name.as_str(), &known.function)?;
        }
        let names = lua.create_table()?;
        names.raw_set("owner", owner)?;
        names.raw_set("full", full_name(owner, ""))?;
        if !owner.is_empty() {
            names.raw_set("qualified", qualified_name(owner, ""))?;
        }
        machine.prelude().extension.call((&*kind.name, methods, of, reads, changes, names))
    };
    add().map_err(|error| machine.translate(error))?;
    for function in parts.functions {
        machine.session.note_method(&kind.name, owner, function.method(&machine.session));
        let (kind, owner) = (kind.name.to_string(), owner.to_owned());
        machine.library.extensions.borrow_mut().push(Extension { kind, owner, function });
    }
    Ok(())
}

/// Returns true if only others than `owner` have added the method `name` of `kind`.
fn is_added_by_others(machine: &Machine, kind: &str, owner: &str, name: &str) -> bool {
    let extensions = machine.library.extensions.borrow();
    let mut same =
        extensions.iter().filter(|known| known.kind == kind && known.function.name == name).peekable();
    same.peek().is_some() && same.all(|known| known.owner != owner)
}
