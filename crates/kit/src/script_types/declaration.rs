//! The part of a script's object type that Rust knows; its functions stay in the virtual machine.

use std::any::Any;
use std::collections::BTreeSet;
use std::sync::{Arc, Weak};

use crate::capability;
use crate::declare::refuse_unknown;
use crate::{
    Argument, Call, Construct, Field, Kind, KindDeclaration, Method, Object, ScriptField, ScriptObject,
    Table, Value,
};
use crate::{Draw, LevelOfDetail, Report, Warn};
use burgeon_base::error::{Error, Limit, Result, SourcePlace};

/// Declaration of an object type by a script.
#[derive(Clone, Default)]
pub struct ScriptType {
    /// Built-in base type, direct or inherited through other types, if any.
    pub base: Option<Arc<Kind>>,
    /// Names of the base types, the nearest first.
    pub above: Vec<Arc<str>>,
    /// Fields of the constructor in addition to the base type's fields.
    pub fields: Vec<ScriptField>,
    /// Names and initial values of the state variables.
    pub state: Arc<Table>,
    /// Child objects of the state, by name.
    pub held: Vec<(Arc<str>, Arc<dyn Object>)>,
    /// Set if the script defines a function for the start of a branch, and for its end.
    pub branches: [bool; 2],
    /// Source location of the declaration.
    pub place: Option<SourcePlace>,
}

/// Maximum nesting depth of child objects.
const DEEPEST_HELD: usize = 8;

/// Maximum number of child objects of an object, counted recursively.
const MOST_HELD: usize = 64;

impl KindDeclaration for ScriptType {
    fn base_names(&self) -> &[Arc<str>] {
        &self.above
    }

    fn member_names(&self) -> Vec<&str> {
        self.parts().collect()
    }

    fn place(&self) -> Option<&SourcePlace> {
        self.place.as_ref()
    }
}

impl ScriptType {
    /// Returns the declaration of a type, if a script declared it.
    pub fn of(kind: &Kind) -> Option<&Self> {
        let declaration: &dyn Any = kind.script.as_deref()?;
        declaration.downcast_ref()
    }

    /// Returns the number of child objects, counted recursively.
    pub fn held_count(&self) -> usize {
        self.held.iter().map(|(_, object)| 1 + inner(object).map_or(0, Self::held_count)).sum()
    }

    /// Returns the names of the fields, state variables and child objects.
    pub fn parts(&self) -> impl Iterator<Item = &str> {
        let fields = self.fields.iter().map(|field| &*field.name);
        let state = self.state.entries.iter().filter_map(|(key, _)| match key {
            crate::TableKey::Name(name) => Some(&**name),
            crate::TableKey::Index(_) => None,
        });
        fields.chain(state).chain(self.held.iter().map(|(name, _)| &**name))
    }

    fn held_depth(&self) -> usize {
        self.held.iter().map(|(_, object)| 1 + inner(object).map_or(0, Self::held_depth)).max().unwrap_or(0)
    }

    /// Returns the index of the direct child object that `slot` refers to. If the slot belongs to a descendant, also
    /// returns the slot within that child. Slots number the child objects recursively: the children of a child object
    /// follow it.
    pub(crate) fn held_at(&self, slot: usize) -> Option<(usize, Option<usize>)> {
        let mut left = slot;
        for (index, (_, object)) in self.held.iter().enumerate() {
            if left == 0 {
                return Some((index, None));
            }
            left -= 1;
            let count = inner(object).map_or(0, Self::held_count);
            if left < count {
                return Some((index, Some(left)));
            }
            left -= count;
        }
        None
    }

    /// Fails if a child object cannot draw, or if there are too many child objects or nesting levels.
    fn check_held(&self, name: &str) -> Result<()> {
        for (held, object) in &self.held {
            let kind = object.kind();
            if !kind.has_capability::<dyn Draw>() {
                return Err(Error::argument(format!(
                    "{name}: {held} of its state is a {}, which cannot be a child object",
                    kind.name
                ))
                .help("use an object that draws with its own methods, such as an extruder or a turtle"));
            }
        }
        let help = "place derived models with modules: this:place(derived)";
        if self.held_depth() > DEEPEST_HELD {
            let message = format!("{name} has child objects nested more than {DEEPEST_HELD} deep");
            return Err(Error::limit(Limit::Size, message).help(help));
        }
        let count = self.held_count();
        if count > MOST_HELD {
            let message =
                format!("{name} has {count} child objects, counted recursively; the limit is {MOST_HELD}");
            return Err(Error::limit(Limit::Size, message).help(help));
        }
        Ok(())
    }

    /// Creates the kind for the engine: the base type, extended by the script's `methods`. Fails if the base type has
    /// no constructor with fields, or if names or child objects are not allowed.
    pub fn kind(self, name: &str, doc: String, methods: Vec<Method>) -> Result<Arc<Kind>> {
        let base = self.base.as_deref();
        if let Some(base) = base
            && !matches!(base.construct, Construct::Fields(_))
        {
            return Err(Error::argument(format!(
                "{} is not made of fields, so {name} cannot extend it",
                base.name
            )));
        }
        self.check_held(name)?;
        if let (Some(base), false) = (base, self.held.is_empty())
            && !base.has_capability::<dyn Draw>()
        {
            return Err(Error::argument(format!(
                "a {} does not draw, so {name} cannot have child objects that draw",
                base.name
            )));
        }
        let own: BTreeSet<String> = self.fields.iter().map(|field| field.name.to_string()).collect();
        let inherited = base.iter().flat_map(|base| &base.fields);
        let is_own = |field: &Field| own.iter().any(|name| field.is_called(name));
        let inherited: Vec<_> = inherited.filter(|field| !is_own(field)).cloned().collect();
        let mut fields: Vec<_> = self.fields.iter().map(ScriptField::describe).collect();
        fields.extend(inherited);
        let mut all: Vec<Method> = base.iter().flat_map(|base| base.methods.iter().cloned()).collect();
        for method in ScriptObject::methods() {
            if !all.iter().any(|known| known.name == method.name) {
                all.push(method);
            }
        }
        if !all.iter().any(|known| known.name == AS) {
            all.push(seen_as());
        }
        for method in methods {
            match all.iter_mut().find(|known| known.name == method.name) {
                Some(known) if matches!(known.call, Call::Script { .. }) && known.name != AS => {
                    *known = method
                }
                Some(known) => {
                    let of = base.map_or("every object", |base| &*base.name);
                    return Err(Error::argument(format!("{of} already has a method `{}`", known.name))
                        .help(format!("rename the method of {name}")));
                }
                None => all.push(method),
            }
        }
        if let Some(clash) = fields
            .iter()
            .find(|field| own.contains(&*field.name) && all.iter().any(|method| method.name == field.name))
        {
            return Err(Error::argument(format!("{name} has a field and a method named `{}`", clash.name))
                .help("rename one of them"));
        }
        if let Some((held, _)) = self.held.iter().find(|(held, _)| all.iter().any(|it| it.name == **held)) {
            return Err(Error::argument(format!("{name} has a method and a child object named `{held}`"))
                .help("rename one of them"));
        }
        let of = Arc::new(self);
        Ok(Arc::new_cyclic(|kind: &Weak<Kind>| {
            let (kind, made) = (Weak::clone(kind), Arc::clone(&of));
            let make = move |table: &Table| {
                let kind = kind.upgrade().ok_or_else(|| Error::internal("the type is gone"))?;
                made.make(kind, table)
            };
            let own = Kind::new(name.to_owned(), doc).made_of(fields, make).methods(all);
            let mut within = of.base.iter().chain(of.held.iter().map(|(_, object)| object.kind()));
            let warns = within.any(|kind| kind.has_capability::<dyn Warn>());
            let own = match &of.base {
                None => own.begins_empty().draws::<ScriptObject>(),
                Some(base) => Kind {
                    first: base.first.clone(),
                    begins_empty: base.begins_empty,
                    deprecated: base.deprecated.clone(),
                    capabilities: base.capabilities.clone(),
                    gather: base.gather,
                    prefetch: base.prefetch,
                    ..own
                },
            };
            let own = Kind { script: Some(of), ..own };
            let own =
                own.can(capability!(ScriptObject: LevelOfDetail)).can(capability!(ScriptObject: Report));
            if warns { own.can(capability!(ScriptObject: Warn)) } else { own }
        }))
    }

    /// Makes an object from the constructor's table.
    fn make(self: &Arc<Self>, kind: Arc<Kind>, table: &Table) -> Result<ScriptObject> {
        let names: Vec<&str> = kind.fields.iter().map(|field| &*field.name).collect();
        refuse_unknown(&kind.name, &names, table)?;
        let mut given = Table { class: None, entries: table.entries.clone() };
        let mut fields = Table::default();
        for field in &self.fields {
            let key = crate::TableKey::Name(Arc::clone(&field.name));
            let value = match table.get(&field.name).cloned() {
                Some(value) => field.read(&kind.name, value)?,
                None => field.default.clone().ok_or_else(|| {
                    let (kind, name) = (&kind.name, &field.name);
                    Error::argument(format!("{kind}: missing field `{name}`"))
                        .help(format!("write {kind} {{ {name} = ... }}"))
                        .of_data()
                })?,
            };
            given.entries.retain(|(known, _)| *known != key);
            let is_inherited =
                |base: &Arc<Kind>| base.fields.iter().any(|known| known.is_called(&field.name));
            if self.base.as_ref().is_some_and(is_inherited) && value != Value::Nil {
                given.entries.push((key.clone(), value.clone()));
            }
            fields.entries.push((key, value));
        }
        fields.entries.sort_by(|a, b| a.0.cmp(&b.0));
        given.entries.sort_by(|a, b| a.0.cmp(&b.0));
        let base = self.base.as_ref().map(|base| base.make(&given)).transpose()?;
        Ok(ScriptObject::new(kind, Arc::clone(self), base, Arc::new(fields)))
    }
}

/// Returns the declaration of an object's type, if a script declared the type.
fn inner(object: &Arc<dyn Object>) -> Option<&ScriptType> {
    ScriptType::of(object.kind())
}

/// Name of the method that all types of scripts have in addition to their own.
const AS: &str = "as";

fn seen_as() -> Method {
    let doc = "Returns the object as its base type with this `constructor`: a method that overrides a method of the base type can call the original with it, such as self:as(lantern):lamp(1).";
    let (name, arguments, returns) = (AS.into(), vec![Argument::new("constructor")], "any".to_owned());
    Method { name, doc: doc.into(), arguments, returns, call: Call::Script { changes: false } }
}
