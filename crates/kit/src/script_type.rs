//! A type of object that a script declares, as far as Rust knows it; its functions stay in the virtual machine.

use std::collections::BTreeSet;
use std::sync::{Arc, Weak};

use super::declare::refuse_unknown;
use super::{Call, Construct, Kind, Method, Object, ScriptField, ScriptObject, Table, Value};
use burgeon_base::error::{Error, Result};

/// What a script declares of a type.
#[derive(Clone, Default)]
pub struct ScriptType {
    /// The type that it extends, if any.
    pub base: Option<Arc<Kind>>,
    /// What its constructor takes besides what the base's takes.
    pub fields: Vec<ScriptField>,
    /// The names and first values of its state.
    pub state: Arc<Table>,
    /// Objects in its state that it draws with, by name.
    pub held: Vec<(Arc<str>, Arc<dyn Object>)>,
    /// Whether a function of its own runs where a branch opens, and where it closes.
    pub branches: [bool; 2],
}

impl ScriptType {
    /// The type as the engine knows it: what it extends, and besides `methods` of the script.
    pub fn kind(self, name: &str, doc: &str, methods: Vec<Method>) -> Result<Arc<Kind>> {
        let base = self.base.clone();
        if let Some(base) = &base
            && !matches!(base.construct, Construct::Fields(_))
        {
            return Err(Error::argument(format!(
                "{} is not made of fields, so {name} cannot extend it",
                base.name
            )));
        }
        for (held, object) in &self.held {
            let kind = object.kind();
            if kind.script.is_some() || kind.draw.is_none() {
                return Err(Error::argument(format!("{name}: {held} of its state is a {}, which cannot be held", kind.name))
                    .help("hold an object that comes with Burgeon and draws where it is told to, such as an extruder or a turtle"));
            }
        }
        if let (Some(base), false) = (&base, self.held.is_empty())
            && base.draw.is_none()
        {
            return Err(Error::argument(format!(
                "a {} does not draw, so {name} can hold nothing that does",
                base.name
            )));
        }
        let own: BTreeSet<String> = self.fields.iter().map(|field| field.name.to_string()).collect();
        let inherited = base.iter().flat_map(|base| &base.fields);
        let inherited: Vec<_> = inherited.filter(|field| !own.contains(&*field.name)).cloned().collect();
        let mut fields: Vec<_> = self.fields.iter().map(ScriptField::describe).collect();
        fields.extend(inherited);
        let mut all: Vec<Method> = base.iter().flat_map(|base| base.methods.iter().cloned()).collect();
        for method in ScriptObject::methods() {
            if !all.iter().any(|known| known.name == method.name) {
                all.push(method);
            }
        }
        for method in methods {
            match all.iter_mut().find(|known| known.name == method.name) {
                Some(known) if matches!(known.call, Call::Script { .. }) => *known = method,
                Some(known) => {
                    let of = base.as_ref().map_or("every object", |base| &*base.name);
                    return Err(Error::argument(format!("{of} has a method called {} already", known.name))
                        .help(format!("give that of {name} another name")));
                }
                None => all.push(method),
            }
        }
        if let Some(clash) = fields
            .iter()
            .find(|field| own.contains(&*field.name) && all.iter().any(|method| method.name == field.name))
        {
            return Err(Error::argument(format!("{name} has a field and a method called {}", clash.name))
                .help("give one of them another name"));
        }
        let doc = doc.to_owned();
        let of = Arc::new(self);
        Ok(Arc::new_cyclic(|kind: &Weak<Kind>| {
            let (kind, made) = (Weak::clone(kind), Arc::clone(&of));
            let make = move |table: &Table| {
                let kind = kind.upgrade().ok_or_else(|| Error::internal("the type is gone"))?;
                made.make(kind, table)
            };
            let own = Kind::new(name.to_owned(), doc).made_of(fields, make).methods(all);
            let own = own.has_detail::<ScriptObject>().reports::<ScriptObject>();
            match base {
                None => Kind { script: Some(of), ..own.begins_empty().draws::<ScriptObject>() },
                Some(base) => Kind {
                    first: base.first.clone(),
                    begins_empty: base.begins_empty,
                    show: base.show,
                    draw: base.draw,
                    expand: base.expand,
                    gather: base.gather,
                    prefetch: base.prefetch,
                    script: Some(of),
                    ..own
                },
            }
        }))
    }

    /// Makes one of the table that a constructor was given.
    fn make(self: &Arc<Self>, kind: Arc<Kind>, table: &Table) -> Result<ScriptObject> {
        let names: Vec<&str> = kind.fields.iter().map(|field| &*field.name).collect();
        refuse_unknown(&kind.name, &names, table)?;
        let mut given = Table { class: None, entries: table.entries.clone() };
        let mut fields = Table::default();
        for field in &self.fields {
            let key = super::TableKey::Name(Arc::clone(&field.name));
            let value = match table.get(&field.name).cloned() {
                Some(value) => field.read(&kind.name, value)?,
                None => field.default.clone().ok_or_else(|| {
                    let (kind, name) = (&kind.name, &field.name);
                    Error::argument(format!("{kind}: {name} must be given"))
                        .help(format!("write {kind} {{ {name} = ... }}"))
                        .of_data()
                })?,
            };
            given.entries.retain(|(known, _)| *known != key);
            let is_inherited = |base: &Arc<Kind>| base.fields.iter().any(|known| known.name == *field.name);
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
