//! Object types as data: their scripting API and their capabilities for the engine.

use std::any::Any;
use std::borrow::Cow;
use std::sync::Arc;

use super::capability::{Capabilities, Capability, Draw, Gather, Show};
use crate::capability;
use crate::{Argument, BeginPrefetch, Constructor, Deprecation, Loader, Object, Table, Value};
use burgeon_base::error::{Error, Result, SourcePlace};

/// Text that is static in a built-in type and owned in any other.
pub(crate) type SharedText = Cow<'static, str>;

/// An object type: the fields of its constructor, its methods and its capabilities.
///
/// Burgeon, a host program or a script can define it. All types in a [`Registry`](crate::Registry) have the same
/// rights, regardless of their origin.
///
/// ```
/// use burgeon_kit::{Field, Kind};
///
/// let lamp = Kind::new("street_lamp", "A street lamp.").has(vec![Field::new("height", "number", "Height (m).")]);
/// assert_eq!((lamp.luau(), lamp.with_article()), ("StreetLamp".into(), "a street_lamp".into()));
/// assert!(lamp.method("turn_on").is_none());
/// ```
#[derive(Clone)]
pub struct Kind {
    /// Name of the type and of its constructor in scripts.
    pub name: SharedText,
    /// Description; the first line is a summary.
    pub doc: SharedText,
    /// Usage example in Lua; empty if none is needed.
    pub example: SharedText,
    /// Fields of the constructor. If scripts cannot construct the type, the fields that scripts can read.
    pub fields: Vec<Field>,
    /// Field that can precede the table, such as `geometry` in `footprint(geometry, { ... })`.
    pub first: Option<SharedText>,
    /// Methods that scripts can call.
    pub methods: Vec<Method>,
    /// Luau name of the family of interchangeable types that this type belongs to, such as `Wall`.
    pub family: Option<SharedText>,
    /// Construction of an object of the type.
    pub construct: Construct,
    /// Functions besides the constructor that create values of it.
    pub functions: Vec<Constructor>,
    /// Set if [`Object::begin`] discards the results of earlier passes.
    pub begins_empty: bool,
    /// Traits that its objects implement, for the engine.
    pub capabilities: Capabilities,
    /// Function that shares data between all objects of a system.
    pub gather: Option<Gather>,
    /// Function that starts preparing a layer's features in another thread before they are used.
    pub prefetch: Option<BeginPrefetch>,
    /// Declaration by a script, if a script defined the type.
    pub script: Option<Arc<dyn KindDeclaration>>,
    /// Deprecated names with their replacements.
    pub deprecated: Vec<Deprecation>,
}

/// Declaration of a type by a script.
pub trait KindDeclaration: Any + Send + Sync {
    /// Returns the names of the types that it extends, the nearest first.
    fn base_names(&self) -> &[Arc<str>];

    /// Returns the names of its fields and of its state.
    fn member_names(&self) -> Vec<&str>;

    /// Returns the location of the declaration.
    fn place(&self) -> Option<&SourcePlace>;
}

/// Function that makes an object from the constructor's table.
pub type Make = Arc<dyn Fn(&Table) -> Result<Box<dyn Object>> + Send + Sync>;

/// Construction of objects of a type.
#[derive(Clone)]
pub enum Construct {
    /// By its constructor, which a script calls with a table of fields.
    Fields(Make),
    /// From a file, which a script names at its top level.
    File(Loader),
    /// By another object or function; scripts cannot construct it.
    Given,
}

/// A field of a constructor's table.
#[derive(Debug, Clone)]
pub struct Field {
    /// Name of the field.
    pub name: SharedText,
    /// Description with the unit.
    pub doc: SharedText,
    /// Luau type.
    pub luau: String,
    /// Unit, such as "m", if the field has one.
    pub unit: Option<SharedText>,
    /// Nested fields, if the field is a table of named fields.
    pub fields: Vec<Field>,
    /// Value of an omitted field, as written in a script.
    pub default: String,
    /// Former names, which scripts can still use.
    pub former: Vec<Deprecation>,
}

/// A method that scripts can call.
#[derive(Clone)]
pub struct Method {
    /// Name of the method.
    pub name: SharedText,
    /// Description; the first sentence is its help.
    pub doc: SharedText,
    /// Arguments without `self`.
    pub arguments: Vec<Argument>,
    /// Luau type of the result; empty if the method returns the object itself.
    pub returns: String,
    /// Implementation.
    pub call: Call,
}

impl Field {
    /// Creates a field of type `luau`; a type that ends with `?` makes the field optional.
    pub fn new(name: impl Into<SharedText>, luau: &str, doc: impl Into<SharedText>) -> Self {
        let (luau, default) = (luau.to_owned(), String::new());
        Self {
            name: name.into(),
            doc: doc.into(),
            luau,
            unit: None,
            fields: Vec::new(),
            default,
            former: Vec::new(),
        }
    }

    /// Returns the remedy for a wrong value: the values that the field takes.
    ///
    /// ```
    /// use burgeon_kit::Field;
    ///
    /// let field = Field { default: "0.1".to_owned(), ..Field::new("width", "number?", "Width of lines (m). Rounded.") };
    /// assert_eq!(field.usage(), "width takes a number, 0.1 unless given: Width of lines (m)");
    /// ```
    pub fn usage(&self) -> String {
        let name = &self.name;
        let taken = match self.luau.trim_end_matches('?') {
            "Color" => {
                return format!("write {name} = \"red\", {name} = \"#ff8000\" or {name} = {{ 1, 0.5, 0 }}");
            }
            "number" => "a number",
            "string" => "a string",
            "boolean" => "true or false",
            "Vector" => "a vector: vec(1, 0, 0) or { 1, 0, 0 }",
            luau => luau,
        };
        let default = match &*self.default {
            "" | "nil" => String::new(),
            default => format!(", {default} unless given"),
        };
        let doc = self.doc.lines().next().unwrap_or_default();
        let doc = doc.split_once(". ").map_or(doc.trim_end_matches('.'), |(first, _)| first);
        format!("{name} takes {taken}{default}: {doc}")
    }
}

/// Returns the Luau name of the type called `name`: `StreetLamp` for `street_lamp`.
pub fn luau_name(name: &str) -> String {
    let capital = |word: &str| {
        let mut letters = word.chars();
        letters.next().map(|first| first.to_ascii_uppercase()).into_iter().chain(letters).collect::<String>()
    };
    name.split(['_', '-', '.']).map(capital).collect()
}

/// Function that calls a read method.
pub type ReadCall = Arc<dyn Fn(&dyn Object, &[Value]) -> Result<Value> + Send + Sync>;
/// Function that calls a write method.
pub type Write = Arc<dyn Fn(&mut dyn Object, &[Value]) -> Result<Value> + Send + Sync>;
/// Function that calls a write method that takes only numbers.
pub type WriteNumbers = Arc<dyn Fn(&mut dyn Object, &[f64]) -> Result<()> + Send + Sync>;

/// Implementation of a method.
#[derive(Clone)]
pub enum Call {
    /// A read method, which rules can call.
    Read(ReadCall),
    /// A write method, which changes the object, so only interpretation rules can call it.
    Write {
        /// Call with any values.
        values: Write,
        /// Faster call with numbers, if all arguments are numbers.
        numbers: Option<WriteNumbers>,
    },
    /// A function of the script, which the virtual machine runs.
    Script {
        /// Set if the function changes the object, so only interpretation rules can call it.
        changes: bool,
    },
}

impl Call {
    /// Returns true if the method changes the object, so only interpretation rules can call it.
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
    /// Returns the name with its article for a message: "an extruder", "a panel".
    pub fn with_article(&self) -> String {
        let name = &self.name;
        format!("{} {name}", if name.starts_with(['a', 'e', 'i', 'o', 'u']) { "an" } else { "a" })
    }

    /// Creates a type without fields, methods or capabilities that scripts cannot construct.
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

    /// Sets the usage example.
    #[must_use]
    pub fn example(self, example: impl Into<SharedText>) -> Self {
        Self { example: example.into(), ..self }
    }

    /// Adds a constructor that takes a table of `fields`, from which `make` makes an object.
    #[must_use]
    pub fn made_of<T: Object>(
        self,
        fields: Vec<Field>,
        make: impl Fn(&Table) -> Result<T> + Send + Sync + 'static,
    ) -> Self {
        let make = move |table: &Table| make(table).map(|made| Box::new(made) as Box<dyn Object>);
        Self { fields, construct: Construct::Fields(Arc::new(make)), ..self }
    }

    /// Sets the fields that scripts can read of an object that they cannot construct.
    #[must_use]
    pub fn has(self, fields: Vec<Field>) -> Self {
        Self { fields, ..self }
    }

    /// Allows the field `first` before the table.
    #[must_use]
    pub fn first(self, first: impl Into<SharedText>) -> Self {
        Self { first: Some(first.into()), ..self }
    }

    /// Sets that objects are loaded from a file by `loader`, which also takes these `fields`.
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

    /// Sets the methods.
    #[must_use]
    pub fn methods(self, methods: Vec<Method>) -> Self {
        Self { methods, ..self }
    }

    /// Adds the type to the family of interchangeable types that Luau calls `family`.
    #[must_use]
    pub fn of_family(self, family: impl Into<SharedText>) -> Self {
        Self { family: Some(family.into()), ..self }
    }

    /// Marks the type as discarding the results of earlier passes when a pass begins.
    #[must_use]
    pub fn begins_empty(self) -> Self {
        Self { begins_empty: true, ..self }
    }

    /// Adds the capability [`Show`].
    #[must_use]
    pub fn can<C: ?Sized + 'static>(mut self, capability: Capability<C>) -> Self {
        self.capabilities.insert(capability);
        self
    }

    /// Adds the capabilities [`Draw`] and [`Show`].
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

    /// Sets `gather` as the function that shares data between all objects of a system.
    #[must_use]
    pub fn gathers(self, gather: Gather) -> Self {
        Self { gather: Some(gather), ..self }
    }

    /// Sets `prefetch` as the function that starts preparing a layer's features before they are used.
    #[must_use]
    pub fn prefetches(self, prefetch: BeginPrefetch) -> Self {
        Self { prefetch: Some(prefetch), ..self }
    }

    /// Makes an object from the fields of the constructor. Fails if the type has no constructor with fields.
    pub fn make(&self, table: &Table) -> Result<Box<dyn Object>> {
        match &self.construct {
            Construct::Fields(make) => make(&*Field::replace_former_names(&self.name, &self.fields, table)?),
            Construct::File(_) | Construct::Given => {
                Err(Error::argument(format!("{} is not made of fields", self.name)))
            }
        }
    }

    /// Returns the Luau name of the type: `Extruder` for `extruder`, `StreetLamp` for `street_lamp`.
    pub fn luau(&self) -> String {
        luau_name(&self.name)
    }

    /// Returns true if `name` is the name of the type or of one of its base types.
    pub fn is_a(&self, name: &str) -> bool {
        self.name == name
            || self.script.as_ref().is_some_and(|script| script.base_names().iter().any(|it| **it == *name))
    }

    /// Returns the method called `name`.
    pub fn method(&self, name: &str) -> Option<&Method> {
        self.methods.iter().find(|method| method.name == name)
    }

    /// Returns the error for a method name that does not exist, with the nearest existing name.
    pub fn unknown_method(&self, name: &str) -> Error {
        let is_own = |method: &&Method| matches!(method.call, Call::Script { .. });
        let current = self.methods.iter().filter(|method| self.deprecation(&method.name).is_none());
        let (own, others): (Vec<_>, Vec<_>) = current.partition(is_own);
        let mut names: Vec<&str> = own.iter().map(|method| &*method.name).collect();
        names.extend(self.script.iter().flat_map(|script| script.member_names()));
        names.extend(others.iter().map(|method| &*method.name));
        names.dedup();
        let message = format!("unknown method or field `{name}` of {}", self.name);
        let error = Error::not_found("method", name, names.iter().copied(), message);
        if matches!(name, "axiom" | "rule" | "interpret" | "decompose" | "derive") {
            let system = format!("local s = lsystem({{ object = {}() }})", self.name);
            return error.rather_help(format!(
                "write {system}, and s:{name}(...): systems have rules, and objects draw"
            ));
        }
        let alike: Vec<&str> = synonyms(name).iter().filter(|known| names.contains(known)).copied().collect();
        if alike.is_empty() {
            error.help(format!("it has {}", names.join(", ")))
        } else {
            error.rather_help(format!("did you mean {}?", alike.join(" or ")))
        }
    }
}

/// Returns the names of methods that do what other programs call `name`.
fn synonyms(name: &str) -> &'static [&'static str] {
    match name {
        "rotate" | "yaw" => &["turn", "roll", "pitch", "rotate"],
        "translate" | "move" | "go" | "move_to" => &["jump", "shift", "translate"],
        "colour" | "paint" | "fill" => &["color"],
        "box" | "cube" | "cuboid" | "cylinder" | "sphere" | "ball" | "cone" => &["shape"],
        "line" | "draw" | "walk" | "up" => &["forward", "extrude"],
        "left" | "right" => &["turn"],
        "resize" | "size" => &["scale", "resize"],
        "lathe" | "revolve" => &["revolve", "shape"],
        "flip" => &["mirror"],
        "difference" | "minus" => &["subtract"],
        "intersection" => &["intersect"],
        "add" | "plus" | "join" => &["union"],
        _ => &[],
    }
}
