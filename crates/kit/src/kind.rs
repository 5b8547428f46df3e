//! A type of object as data: what scripts can do with it, and what it can do for the engine.

use std::borrow::Cow;
use std::sync::Arc;

use super::capability::{Capabilities, Capability, Draw, Gather, Show};
use super::{Argument, BeginPrefetch, Constructor, Loader, Object, ScriptType, Table, Value};
use crate::capability;
use burgeon_base::error::{Error, Result};

/// Text that a built-in type has in the program, and another brings.
pub(crate) type SharedText = Cow<'static, str>;

/// A type of object: what its constructor takes, its methods and its capabilities.
///
/// It may come from Burgeon, from a host program or from a script: whoever adds it to a
/// [`Registry`](super::Registry), it has the same rights.
#[derive(Clone)]
pub struct Kind {
    /// Its name in scripts, which is also its constructor's.
    pub name: SharedText,
    /// What it is; the first line is a summary.
    pub doc: SharedText,
    /// How a script uses it; empty where nothing is to be said.
    pub example: SharedText,
    /// What its constructor takes; of what something else gives, what scripts read of it.
    pub fields: Vec<Field>,
    /// The field that may be given before the table, as `geometry` in `footprint(geometry, { ... })`.
    pub first: Option<SharedText>,
    /// What scripts may call.
    pub methods: Vec<Method>,
    /// What Luau calls all types of which one may stand where another does, such as `Wall`.
    pub family: Option<SharedText>,
    /// How one is made.
    pub construct: Construct,
    /// Functions besides the constructor that create values of it.
    pub functions: Vec<Constructor>,
    /// Whether [`Object::begin`] forgets all that earlier passes did.
    pub begins_empty: bool,
    /// Traits that its objects implement, for the engine.
    pub capabilities: Capabilities,
    /// What lets all objects of a system know of one another.
    pub gather: Option<Gather>,
    /// What a thread may prepare of a layer's features before they are asked for.
    pub prefetch: Option<BeginPrefetch>,
    /// What a script declared of it, if it comes from one.
    pub script: Option<Arc<ScriptType>>,
    /// Which of its names will go, and what is used instead.
    pub deprecated: Vec<Deprecation>,
}

/// A name that still does what it did, but will go.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Deprecation {
    /// A field or a method; empty for the type itself.
    pub name: SharedText,
    /// The version of the script API from which on something else is to be used.
    pub since: SharedText,
    /// What is to be used.
    pub instead: SharedText,
}

impl Deprecation {
    /// What people are told of `name`, as they write it.
    pub fn message(&self, name: &str) -> String {
        format!("{name} is deprecated since version {} of the script API", self.since)
    }
}

/// Makes an object of the constructor's table.
pub type Make = Arc<dyn Fn(&Table) -> Result<Box<dyn Object>> + Send + Sync>;

/// How an object comes to be.
#[derive(Clone)]
pub enum Construct {
    /// A script calls its constructor, with a table of fields.
    Fields(Make),
    /// A script names a file, at its top level.
    File(Loader),
    /// It is what something else gives.
    Given,
}

/// A field of a constructor's table.
#[derive(Debug, Clone)]
pub struct Field {
    /// Its name.
    pub name: SharedText,
    /// What it means, with the unit.
    pub doc: SharedText,
    /// Its type in Luau.
    pub luau: String,
    /// Its unit, if it has one, such as "m".
    pub unit: Option<SharedText>,
    /// What it may have itself, where it is a table of named fields.
    pub fields: Vec<Field>,
    /// The value where it is left out, as one would write it.
    pub default: String,
}

/// A method that scripts may call.
#[derive(Clone)]
pub struct Method {
    /// Its name.
    pub name: SharedText,
    /// What it does; the first sentence is its help.
    pub doc: SharedText,
    /// Its arguments, `self` not counted.
    pub arguments: Vec<Argument>,
    /// The type of its result in Luau; empty where it returns the object itself.
    pub returns: String,
    /// The function.
    pub call: Call,
}

impl Field {
    /// A field of type `luau`, which may be left out if that ends with `?`.
    pub fn new(name: impl Into<SharedText>, luau: &str, doc: impl Into<SharedText>) -> Self {
        let (luau, default) = (luau.to_owned(), String::new());
        Self { name: name.into(), doc: doc.into(), luau, unit: None, fields: Vec::new(), default }
    }
}

/// Calls a method by itself.
pub type ReadCall = Arc<dyn Fn(&dyn Object, &[Value]) -> Result<Value> + Send + Sync>;
/// Calls a method that changes the object.
pub type Write = Arc<dyn Fn(&mut dyn Object, &[Value]) -> Result<Value> + Send + Sync>;
/// Calls a method that changes the object and takes only numbers.
pub type WriteNumbers = Arc<dyn Fn(&mut dyn Object, &[f64]) -> Result<()> + Send + Sync>;

/// How a method is called.
#[derive(Clone)]
pub enum Call {
    /// It only reads, so rules may call it.
    Read(ReadCall),
    /// It changes the object, so only interpretation rules may call it.
    Write {
        /// With any values.
        values: Write,
        /// With numbers only, where all its arguments are numbers: the fast way.
        numbers: Option<WriteNumbers>,
    },
    /// It is a function of the script, which the virtual machine runs.
    Script {
        /// Whether it changes the object, so that only interpretation rules may call it.
        changes: bool,
    },
}

impl Call {
    /// Whether it changes the object, so that only interpretation rules may call it.
    pub fn changes(&self) -> bool {
        match self {
            Self::Read(_) => false,
            Self::Write { .. } => true,
            Self::Script { changes } => *changes,
        }
    }
}

impl std::fmt::Debug for Kind {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Kind").field(&self.name).finish()
    }
}

impl Kind {
    /// Its name for a message: "an extruder", "a panel".
    pub fn with_article(&self) -> String {
        let name = &self.name;
        format!("{} {name}", if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" })
    }

    /// A type that scripts can neither make nor ask, which something else gives.
    pub fn new(name: impl Into<SharedText>, doc: impl Into<SharedText>) -> Self {
        Self {
            name: name.into(),
            doc: doc.into(),
            example: SharedText::default(),
            fields: Vec::new(),
            first: None,
            methods: Vec::new(),
            family: None,
            construct: Construct::Given,
            functions: Vec::new(),
            begins_empty: false,
            capabilities: Capabilities::default(),
            gather: None,
            prefetch: None,
            script: None,
            deprecated: Vec::new(),
        }
    }

    /// Is used as this script shows.
    #[must_use]
    pub fn example(self, example: impl Into<SharedText>) -> Self {
        Self { example: example.into(), ..self }
    }

    /// Has a constructor that takes `fields`, of which `make` makes one.
    #[must_use]
    pub fn made_of<T: Object>(
        self,
        fields: Vec<Field>,
        make: impl Fn(&Table) -> Result<T> + Send + Sync + 'static,
    ) -> Self {
        let make = move |table: &Table| make(table).map(|made| Box::new(made) as Box<dyn Object>);
        Self { fields, construct: Construct::Fields(Arc::new(make)), ..self }
    }

    /// Is given by something else, and has these fields, which scripts read.
    #[must_use]
    pub fn has(self, fields: Vec<Field>) -> Self {
        Self { fields, ..self }
    }

    /// Will do without `name`, a field or a method, or empty for the type itself: scripts that use it are told that
    /// since this version of the script API they should use `instead`.
    #[must_use]
    pub fn deprecates(
        mut self,
        name: impl Into<SharedText>,
        since: impl Into<SharedText>,
        instead: impl Into<SharedText>,
    ) -> Self {
        self.deprecated.push(Deprecation { name: name.into(), since: since.into(), instead: instead.into() });
        self
    }

    /// That the field or the method `name` is deprecated, if it is.
    pub fn deprecation(&self, name: &str) -> Option<&Deprecation> {
        self.deprecated.iter().find(|known| known.name == name)
    }

    /// The field `first` may be given before the table.
    #[must_use]
    pub fn first(self, first: impl Into<SharedText>) -> Self {
        Self { first: Some(first.into()), ..self }
    }

    /// Is made of a file, by `loader`, which takes these `fields` besides.
    #[must_use]
    pub fn loaded(self, fields: Vec<Field>, loader: Loader) -> Self {
        Self {
            fields,
            example: loader.example_with_fields.into(),
            construct: Construct::File(loader),
            ..self
        }
    }

    /// Adds functions to scripts that create values of it.
    #[must_use]
    pub fn functions(self, functions: impl Into<Vec<Constructor>>) -> Self {
        Self { functions: functions.into(), ..self }
    }

    /// Has these methods.
    #[must_use]
    pub fn methods(self, methods: Vec<Method>) -> Self {
        Self { methods, ..self }
    }

    /// May stand where any type of this family may, which Luau calls `family`.
    #[must_use]
    pub fn of_family(self, family: impl Into<SharedText>) -> Self {
        Self { family: Some(family.into()), ..self }
    }

    /// Begins each pass as if there had been none before.
    #[must_use]
    pub fn begins_empty(self) -> Self {
        Self { begins_empty: true, ..self }
    }

    /// Declares a capability: `kind.can(capability!(Extruder: Warn))`.
    #[must_use]
    pub fn can<C: ?Sized + 'static>(mut self, capability: Capability<C>) -> Self {
        self.capabilities.insert(capability);
        self
    }

    /// Declares that its objects draw with a [`Drawing`](super::Drawing).
    #[must_use]
    pub fn draws<T: Object + Draw>(self) -> Self {
        self.can(capability!(T: Draw)).can(capability!(T: Show))
    }

    /// Returns the capability of the trait `C`, if its objects have it.
    pub fn capability<C: ?Sized + 'static>(&self) -> Option<Capability<C>> {
        self.capabilities.get()
    }

    /// Returns true if its objects have the capability of the trait `C`.
    pub fn has_capability<C: ?Sized + 'static>(&self) -> bool {
        self.capability::<C>().is_some()
    }

    /// All objects of a system get to know of one another by `gather`.
    #[must_use]
    pub fn gathers(self, gather: Gather) -> Self {
        Self { gather: Some(gather), ..self }
    }

    /// What `prefetch` begins may be made of a layer's features before they are asked for.
    #[must_use]
    pub fn prefetches(self, prefetch: BeginPrefetch) -> Self {
        Self { prefetch: Some(prefetch), ..self }
    }

    /// Makes one of the fields of a constructor. Fails where nothing is made so.
    pub fn make(&self, table: &Table) -> Result<Box<dyn Object>> {
        match &self.construct {
            Construct::Fields(make) => make(table),
            Construct::File(_) | Construct::Given => {
                Err(Error::argument(format!("{} is not made of fields", self.name)))
            }
        }
    }

    /// What Luau calls the type: `Extruder` of `extruder`, `StreetLamp` of `street_lamp`.
    pub fn luau(&self) -> String {
        let capital = |word: &str| {
            let mut letters = word.chars();
            letters
                .next()
                .map(|first| first.to_ascii_uppercase())
                .into_iter()
                .chain(letters)
                .collect::<String>()
        };
        self.name.split(['_', '-', '.']).map(capital).collect()
    }

    /// Whether it is called `name`, or extends a type that is.
    pub fn is_a(&self, name: &str) -> bool {
        self.name == name
            || self.script.as_ref().is_some_and(|script| script.above.iter().any(|it| **it == *name))
    }

    /// The method called `name`.
    pub fn method(&self, name: &str) -> Option<&Method> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// The error for a name that is no method, with the nearest one that is.
    pub fn unknown_method(&self, name: &str) -> Error {
        let is_own = |method: &&Method| matches!(method.call, Call::Script { .. });
        let (own, others): (Vec<_>, Vec<_>) = self.methods.iter().partition(is_own);
        let mut names: Vec<&str> = own.iter().map(|method| &*method.name).collect();
        names.extend(self.script.iter().flat_map(|script| script.parts()));
        names.extend(others.iter().map(|method| &*method.name));
        names.dedup();
        let message = format!("{} has no method or field called {name}", self.name);
        Error::not_found("method", name, names.iter().copied(), message)
            .help(format!("it has {}", names.join(", ")))
    }
}
