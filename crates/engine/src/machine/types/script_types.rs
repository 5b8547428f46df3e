//! `object` and `extend`: object types that a script declares, and methods that it adds to other types.

use std::borrow::Cow;
use std::sync::Arc;

use mlua::{Function, Table, Value as LuaValue};

use super::extensions::{NameConflicts, inherit, is_full_name};
use super::handles::ObjectHandle;
use super::kinds::{constructor, install_methods};
use super::mentions::drawing_kind;
use crate::declare::{Session, contested_method};
use crate::machine::Machine;
use crate::machine::convert::{to_lua, to_value, type_of};
use burgeon_base::error::{Error, Result};
use burgeon_kit::{
    Argument, Call, Kind, Method, ScriptField, ScriptType, Table as ValueTable, TableKey, Value,
};
use burgeon_language::{CallForm, OBJECT};

/// Script names of the functions that run around the interpretation of chains and branches.
const HOOKS: [&str; 4] = ["begin", "finish", "push", "pop"];

/// Script-declared type in one machine.
pub(crate) struct ScriptTypeEntry {
    pub kind: Arc<Kind>,
    /// Type in the form of the prelude.
    pub table: Table,
    pub functions: Vec<ScriptFunction>,
    pub contested: NameConflicts,
}

/// Function of a type.
#[derive(Clone)]
pub(crate) struct ScriptFunction {
    pub name: String,
    pub doc: String,
    pub function: Function,
    pub role: Role,
}

/// Purpose of a type's function.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    Read,
    Change,
    Hook,
}

impl ScriptTypeEntry {
    /// Creates the type that `object(name, declared)` declares.
    fn declare(machine: &Machine, name: &str, declared: &Table) -> Result<Self> {
        refuse_unknown(&format!("object {name}"), declared, &OBJECT.part_names())?;
        let mut entry = match declared.raw_get::<LuaValue>("extends").map_err(internal)? {
            LuaValue::Nil => ScriptTypeParts::default(),
            LuaValue::Function(function) => {
                ScriptTypeParts::of(machine, &function).ok_or_else(|| not_a_type(machine, name))?
            }
            _ => return Err(not_a_type(machine, name)),
        };
        let what = |part: &str| format!("{part} of object {name}");
        let inherited = entry.declaration.fields.len();
        for (field, value) in named(declared, "fields", &what("fields"))? {
            let field = ScriptField::declare(name, &field, &to_value(&value, false)?)?;
            replace(&mut entry.declaration.fields, inherited, field, |a, b| a.name == b.name);
        }
        let mut state = ValueTable::clone(&entry.declaration.state);
        for (key, value) in named(declared, "state", &what("state"))? {
            state.entries.retain(|(known, _)| !matches!(known, TableKey::Name(known) if **known == *key));
            entry.declaration.held.retain(|(known, _)| **known != *key);
            if let Some(object) = ObjectHandle::object_of(&value) {
                entry.declaration.held.push((key.as_str().into(), object));
                continue;
            }
            let value = to_value(&value, true).map_err(|error| named_part(error, name, &key))?;
            state.entries.push((TableKey::Name(key.as_str().into()), value));
        }
        state.entries.sort_by(|a, b| a.0.cmp(&b.0));
        for field in &entry.declaration.fields {
            let held = entry.declaration.held.iter().any(|(held, _)| *held == field.name);
            if held || state.get(&field.name).is_some() {
                let text = format!("`{}` is both a field and a state variable of {name}", field.name);
                return Err(Error::argument(text).help("rename one of them"));
            }
        }
        entry.declaration.state = Arc::new(state);
        let functions = entry.functions.len();
        entry.add(declared, &what)?;
        for hook in HOOKS {
            match declared.raw_get::<LuaValue>(hook).map_err(internal)? {
                LuaValue::Nil => {}
                LuaValue::Function(function) => {
                    let function = ScriptFunction {
                        name: hook.to_owned(),
                        doc: String::new(),
                        function,
                        role: Role::Hook,
                    };
                    replace(&mut entry.functions, functions, function, ScriptFunction::is_same);
                }
                other => return Err(not_a_function(&what(hook), &other)),
            }
        }
        let has = |hook: &str| entry.functions.iter().any(|it| it.role == Role::Hook && it.name == hook);
        let mut branches = [has("push"), has("pop")];
        // Hooks of child objects run too.
        for script in entry.declaration.held.iter().filter_map(|(_, object)| ScriptType::of(object.kind())) {
            branches = [branches[0] | script.branches[0], branches[1] | script.branches[1]];
        }
        entry.declaration.branches = branches;
        entry.declaration.place = Machine::place(machine.lua());
        let doc = match declared.raw_get::<LuaValue>("doc").map_err(internal)? {
            LuaValue::Nil => String::new(),
            LuaValue::String(text) => text.to_string_lossy(),
            other => {
                return Err(Error::argument(format!(
                    "doc of object {name} must be a string, not a {}",
                    type_of(&other)
                )));
            }
        };
        let own = entry.functions.iter().filter(|it| it.role != Role::Hook && !is_full_name(&it.name));
        let mut methods: Vec<Method> = own.map(|it| it.method(&machine.session)).collect();
        methods.extend(entry.contested.iter().map(|(name, owners)| contested_method(name, owners.keys())));
        let kind = std::mem::take(&mut entry.declaration).kind(name, doc, methods)?;
        let table = entry.table(machine, &kind).map_err(|error| machine.translate(error))?;
        Ok(Self { kind, table, functions: entry.functions, contested: entry.contested })
    }
}

/// Parts of a type.
#[derive(Default)]
pub(super) struct ScriptTypeParts {
    declaration: ScriptType,
    pub(super) functions: Vec<ScriptFunction>,
    contested: NameConflicts,
}

impl ScriptTypeParts {
    /// Returns the parts of a type that inherits from the type of `constructor`; `None` if it is not a
    /// constructor.
    fn of(machine: &Machine, constructor: &Function) -> Option<Self> {
        let kind = machine.library.kind_of(constructor)?;
        let types = machine.library.script_types.borrow();
        let known = types.iter().find(|known| known.kind.name == kind.name);
        let declaration = ScriptType::of(&kind).cloned();
        let mut parts = Self {
            declaration: declaration
                .unwrap_or_else(|| ScriptType { base: Some(Arc::clone(&kind)), ..ScriptType::default() }),
            functions: known.map_or_else(Vec::new, |known| known.functions.clone()),
            contested: known.map_or_else(NameConflicts::new, |known| known.contested.clone()),
        };
        parts.declaration.above.insert(0, (*kind.name).into());
        // Methods added to a type also apply to types that inherit from it.
        inherit(&machine.library.extensions.borrow(), &kind.name, &mut parts.functions, &mut parts.contested);
        Some(parts)
    }

    /// Adds the functions that a table declares as `reads` and `changes`.
    pub(super) fn add(&mut self, declared: &Table, what: &dyn Fn(&str) -> String) -> Result<()> {
        let inherited = self.functions.len();
        for (part, role) in [("reads", Role::Read), ("changes", Role::Change)] {
            for (name, value) in named(declared, part, &what(part))? {
                let (function, doc) = match value {
                    LuaValue::Function(function) => (function, String::new()),
                    LuaValue::Table(table) => described(&format!("{name} of {}", what(part)), &table)?,
                    other => return Err(not_a_function(&format!("{name} of {}", what(part)), &other)),
                };
                if self
                    .functions
                    .iter()
                    .any(|known| known.name == name && known.role != role && known.role != Role::Hook)
                {
                    return Err(Error::argument(format!(
                        "{name} is in both reads and changes of {}",
                        what("").trim_start_matches(" of ")
                    ))
                    .help("a method is either a read method or a write method"));
                }
                self.contested.remove(&name);
                let function = ScriptFunction { name, doc, function, role };
                replace(&mut self.functions, inherited, function, ScriptFunction::is_same);
            }
        }
        Ok(())
    }

    /// Returns the type `kind`, which the parts have made, in the form of the prelude.
    fn table(&self, machine: &Machine, kind: &Arc<Kind>) -> mlua::Result<Table> {
        let lua = machine.lua();
        let declaration = ScriptType::of(kind)
            .ok_or_else(|| mlua::Error::external(Error::internal("the type has no declaration")))?;
        let of = lua.create_table()?;
        of.raw_set("name", &*kind.name)?;
        let fields = lua.create_table()?;
        declaration.fields.iter().try_for_each(|field| fields.raw_set(&*field.name, true))?;
        of.raw_set("fields", fields)?;
        of.raw_set("start", to_lua(lua, &Value::Table(Arc::clone(&declaration.state)), false)?)?;
        let holds = lua.create_table()?;
        let above = lua.create_table()?;
        declaration.above.iter().try_for_each(|name| above.push(&**name))?;
        of.raw_set("above", above)?;
        let types = machine.library.script_types.borrow();
        for (name, object) in &declaration.held {
            let held = lua.create_table()?;
            if let Some(known) = types.iter().find(|known| known.kind.name == object.kind().name) {
                held.raw_set("of", &known.table)?;
            }
            held.raw_set("name", &**name)?;
            held.raw_set("kind", &*object.kind().name)?;
            let methods = lua.create_table()?;
            for (index, method) in object.kind().methods.iter().enumerate() {
                if matches!(method.call, Call::Script { .. }) {
                    continue;
                }
                let entry = lua.create_table()?;
                entry.raw_set("index", index)?;
                entry.raw_set("name", &*method.name)?;
                entry.raw_set("changes", method.call.changes())?;
                methods.push(entry)?;
            }
            held.raw_set("methods", methods)?;
            holds.push(held)?;
        }
        of.raw_set("holds", holds)?;
        of.raw_set("methods", install_methods(machine, kind)?)?;
        let (reads, changes) = (lua.create_table()?, lua.create_table()?);
        for known in &self.functions {
            match known.role {
                Role::Read => reads.raw_set(known.name.as_str(), &known.function)?,
                Role::Change => changes.raw_set(known.name.as_str(), &known.function)?,
                Role::Hook => of.raw_set(known.name.as_str(), &known.function)?,
            }
        }
        of.raw_set("reads", reads)?;
        of.raw_set("changes", changes)?;
        of.raw_set("contested", self.contested.clone())?;
        machine.prelude().script_type.call(of)
    }
}

impl ScriptFunction {
    /// Returns true if both functions declare the same method or the same hook.
    fn is_same(&self, other: &Self) -> bool {
        self.name == other.name && (self.role == Role::Hook) == (other.role == Role::Hook)
    }

    /// Returns the method for the documentation.
    pub(super) fn method(&self, session: &Session) -> Method {
        let info = self.function.info();
        let file = info.source.as_deref().and_then(|source| source.strip_prefix('@'));
        let form = file.zip(info.line_defined).and_then(|(file, line)| session.signature(file, line));
        let form = form.filter(|form| !form.arguments.is_empty()).unwrap_or_else(|| {
            // If several functions begin at one line, the right signature is unknown.
            let names = (0..info.num_params).map(|index| Cow::Owned(format!("a{index}")));
            let names = names.chain(info.is_vararg.then_some(Cow::Borrowed("...")));
            CallForm::new(names.map(Argument::new).collect(), "any")
        });
        Method {
            name: self.name.clone().into(),
            doc: self.doc.clone().into(),
            arguments: form.arguments.into_iter().skip(1).collect(),
            returns: if self.role == Role::Read { form.returns } else { String::new() },
            call: Call::Script { changes: self.role == Role::Change },
        }
    }
}

/// Implements `object(name, declared)`: declares a type and returns its constructor.
pub(in crate::machine) fn declare_type(
    machine: &Machine,
    name: &LuaValue,
    declared: &LuaValue,
) -> Result<Function> {
    machine.library.at_top_level("object")?;
    let usage = "write object(\"lantern\", { changes = { lamp = function(self) ... end } })";
    let LuaValue::String(name) = name else {
        return Err(Error::argument("the first argument of object must be the type name").help(usage));
    };
    let LuaValue::Table(declared) = declared else {
        return Err(Error::argument("the second argument of object must be a table").help(usage));
    };
    let name = name.to_string_lossy();
    check_name(&name)?;
    // A type of a package gets the name of the package as prefix.
    let full = match Machine::asker(machine.lua(), &machine.session) {
        Some(package) => format!("{}.{name}", package.manifest.name),
        None => name,
    };
    machine.library.registry.borrow().refuse_taken(&full)?;
    let entry = ScriptTypeEntry::declare(machine, &full, declared)?;
    let constructor = constructor(machine, &entry.kind).map_err(|error| machine.translate(error))?;
    let constructor = constructor.ok_or_else(|| Error::internal("the type has no constructor"))?;
    machine.library.stateless.borrow_mut().insert(constructor.to_pointer() as usize);
    machine.library.registry.borrow_mut().add(Arc::clone(&entry.kind))?;
    machine.session.note_type(&entry.kind);
    machine.library.script_types.borrow_mut().push(entry);
    Ok(constructor)
}

/// Checks the name of a type.
fn check_name(name: &str) -> Result<()> {
    let is_name = name.starts_with(|c: char| c.is_ascii_lowercase())
        && name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !is_name {
        return Err(Error::argument(format!("{name:?} is not a valid name of an object type"))
            .help("use lowercase letters, digits and _, such as \"street_lamp\""));
    }
    Ok(())
}

/// Refuses keys of `table` that are not in `known`.
pub(super) fn refuse_unknown(what: &str, table: &Table, known: &[&'static str]) -> Result<()> {
    for pair in table.pairs::<LuaValue, LuaValue>() {
        let key = pair.map_err(internal)?.0.to_string().unwrap_or_default();
        if !known.contains(&key.as_str()) {
            let message = format!("unknown part `{key}` of {what}");
            return Err(Error::not_found("part", &key, known.iter().copied(), message)
                .help(format!("the allowed parts are {}", known.join(", "))));
        }
    }
    Ok(())
}

/// Returns the entries of the table `part`, sorted by name.
fn named(declared: &Table, part: &str, what: &str) -> Result<Vec<(String, LuaValue)>> {
    let table = match declared.raw_get::<LuaValue>(part).map_err(internal)? {
        LuaValue::Nil => return Ok(Vec::new()),
        LuaValue::Table(table) => table,
        other => {
            return Err(Error::argument(format!(
                "{what} must be a table of names, not a {}",
                type_of(&other)
            )));
        }
    };
    let mut entries = Vec::new();
    for pair in table.pairs::<LuaValue, LuaValue>() {
        match pair.map_err(internal)? {
            (LuaValue::String(name), value) => entries.push((name.to_string_lossy(), value)),
            (key, _) => {
                return Err(Error::argument(format!(
                    "{what} must be a table of names, but has {} as a key",
                    key.to_string().unwrap_or_default()
                ))
                .help(format!("write {part} = {{ name = ... }}")));
            }
        }
    }
    entries.sort_by(|a, b| a.0.cmp(&b.0));
    Ok(entries)
}

/// Returns function and documentation from `{ doc = "...", function(self) ... end }`.
fn described(what: &str, table: &Table) -> Result<(Function, String)> {
    let doc = match table.raw_get::<LuaValue>("doc").map_err(internal)? {
        LuaValue::String(doc) => doc.to_string_lossy(),
        _ => String::new(),
    };
    match table.raw_get::<LuaValue>(1).map_err(internal)? {
        LuaValue::Function(function) => Ok((function, doc)),
        other => Err(not_a_function(what, &other)),
    }
}

/// Replaces the equal item among the first `inherited` items by `item`, or appends `item`.
fn replace<T>(list: &mut Vec<T>, inherited: usize, item: T, same: impl Fn(&T, &T) -> bool) {
    match list[..inherited].iter_mut().find(|known| same(known, &item)) {
        Some(known) => *known = item,
        None => list.push(item),
    }
}

fn named_part(error: Error, name: &str, part: &str) -> Error {
    Error::argument(format!("{part} of the state of {name}: {}", error.message()))
        .help("a state variable is a number, a boolean, a string, a table of these, or an object")
}

fn not_a_type(machine: &Machine, name: &str) -> Error {
    let error = Error::argument(format!("object {name}: extends must be the constructor of a type"));
    match drawing_kind(&machine.library.registry.borrow()) {
        Some(kind) => error.help(format!("write extends = {kind}, without a table after it")),
        None => error,
    }
}

fn not_a_function(what: &str, found: &LuaValue) -> Error {
    let found = type_of(found);
    Error::argument(format!("{what} must be a function, not a {found}")).help(
        "write name = function(self, ...) ... end, or name = { doc = \"...\", function(self, ...) ... end }",
    )
}

#[allow(clippy::needless_pass_by_value, reason = "it is for map_err")]
fn internal(error: mlua::Error) -> Error {
    Error::internal(error.to_string())
}
