//! Description of a name in scripts, and the list of all names.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use burgeon_kit::{Argument, Deprecation, Field, Registry};

use crate::form::CallForm;

/// Text that is static or derived from static text.
type Text = Cow<'static, str>;

/// A name that every script has, or a type that such a name returns.
#[derive(Debug, Clone)]
pub struct Name {
    /// The name, or the display name of a type.
    pub name: Text,
    /// Kind of the name.
    pub sort: NameKind,
    /// Signatures; empty if the name is not a function.
    pub forms: Vec<CallForm>,
    /// Luau type, if the name is not a function.
    pub luau: Text,
    /// Luau type that is accepted instead of this type; empty if none is.
    pub instead: Text,
    /// Luau name of the base type; empty if there is none.
    pub extends: Text,
    /// Description.
    pub doc: Text,
    /// Fields, if values are tables of named fields.
    pub fields: Vec<Field>,
    /// Methods, or functions of a library.
    pub functions: Vec<Name>,
    /// Operators.
    pub operators: Vec<Operator>,
    /// Type of the items if the value is indexed by numbers, as a list is; otherwise empty.
    pub items: Text,
    /// Effect of a call.
    pub effect: Effect,
    /// Deprecation with the replacement, if the name is deprecated.
    pub deprecated: Option<Deprecation>,
}

/// An operator of a type.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Operator {
    /// Luau name without the underscores: `add`.
    pub name: &'static str,
    /// Type of the second operand; empty for unary operators.
    pub other: &'static str,
    /// Type of the result.
    pub returns: &'static str,
}

/// Kind of a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameKind {
    /// A global function or value.
    Global,
    /// A function or a library of Luau.
    Luau,
    /// A constructor of modules that the standard library interprets by a method.
    Module {
        /// Object type of the method.
        kind: &'static str,
        /// Name of the method.
        method: &'static str,
    },
    /// A type of values that other names return. Scripts cannot use this name.
    Given,
    /// A method, or a function of a library.
    Function,
}

/// Effect of a call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// No effect except for the use of random numbers. The function calls none of its arguments.
    Pure,
    /// A change of the table that is the first argument, and nothing else.
    ChangesFirst,
    /// Other or unknown effects.
    Other,
}

impl Name {
    pub(super) fn new(name: &'static str, sort: NameKind, doc: &'static str) -> Self {
        let (name, doc) = (Cow::Borrowed(name), Cow::Borrowed(doc));
        let (luau, instead, extends) = (Text::default(), Text::default(), Text::default());
        let (forms, fields, functions) = (Vec::new(), Vec::new(), Vec::new());
        Self {
            name,
            sort,
            forms,
            luau,
            instead,
            extends,
            doc,
            fields,
            functions,
            operators: Vec::new(),
            items: Text::default(),
            effect: Effect::Other,
            deprecated: None,
        }
    }

    /// Creates a global function or value.
    pub(super) fn global(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Global, doc)
    }

    /// Creates a type of returned values, with its Luau type.
    pub(super) fn given(name: &'static str, luau: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Given, doc).luau(luau)
    }

    /// Creates a method, or a function of a library.
    pub(super) fn function(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Function, doc)
    }

    pub(super) fn luau(self, luau: &'static str) -> Self {
        Self { luau: luau.into(), ..self }
    }

    pub(super) fn instead(self, instead: &'static str) -> Self {
        Self { instead: instead.into(), ..self }
    }

    pub(super) fn extends(self, extends: &'static str) -> Self {
        Self { extends: extends.into(), ..self }
    }

    /// Adds a signature with these arguments and a result of type `returns`.
    pub(super) fn form(self, arguments: impl Into<Vec<Argument>>, returns: &str) -> Self {
        self.called(CallForm::new(arguments.into(), returns))
    }

    /// Adds a signature in Luau syntax. Text that is not a function type is ignored.
    pub(super) fn read(self, luau: &str) -> Self {
        match CallForm::read(luau) {
            Some(form) => self.called(form),
            None => self,
        }
    }

    /// Adds a signature, with the units and defaults from the description.
    fn called(mut self, form: CallForm) -> Self {
        let arguments = form.arguments.into_iter().map(|argument| argument.described(&self.doc)).collect();
        self.forms.push(CallForm { arguments, ..form });
        self
    }

    pub(super) fn pure(self) -> Self {
        Self { effect: Effect::Pure, ..self }
    }

    pub(super) fn fields(self, fields: impl Into<Vec<Field>>) -> Self {
        Self { fields: fields.into(), ..self }
    }

    pub(super) fn functions(self, functions: impl Into<Vec<Name>>) -> Self {
        Self { functions: functions.into(), ..self }
    }

    pub(super) fn operators(self, operators: impl Into<Vec<Operator>>) -> Self {
        Self { operators: operators.into(), ..self }
    }

    pub(super) fn items(self, items: &'static str) -> Self {
        Self { items: items.into(), ..self }
    }

    /// Returns true if the Luau type has a parameter, like `System<T>`.
    pub fn is_generic(&self) -> bool {
        self.luau.ends_with("<T>")
    }

    /// Returns the fields of the options table of the last signature.
    pub fn options(&self) -> impl Iterator<Item = &Field> {
        self.forms.last().into_iter().flat_map(|form| &form.arguments).flat_map(|argument| &argument.fields)
    }

    /// Returns the names of the options, fields and functions.
    pub fn part_names(&self) -> Vec<&str> {
        let fields = self.options().chain(&self.fields).map(|field| &*field.name);
        fields.chain(self.functions.iter().map(|function| &*function.name)).collect()
    }

    /// Returns the method or function called `name`.
    pub fn find(&self, name: &str) -> Option<&Self> {
        self.functions.iter().find(|function| function.name == name)
    }
}

/// Creates an optional field with a default.
pub(super) fn field(name: &'static str, luau: &str, default: &str, doc: &'static str) -> Field {
    Field { default: default.to_owned(), ..Field::new(name, luau, doc) }
}

/// Returns all names that every script has except for object types, and the types of their results.
pub fn names() -> &'static [Name] {
    static NAMES: LazyLock<Vec<Name>> = LazyLock::new(|| {
        let own = super::burgeon::names().into_iter().chain(super::luau::names());
        own.chain(super::standard::names()).collect()
    });
    &NAMES
}

/// Returns the deprecated names, including constructors of the types in `registry`.
pub fn deprecated_names(registry: &Registry) -> BTreeMap<String, Deprecation> {
    let own = names().iter().filter_map(|name| Some((name.name.to_string(), name.deprecated.clone()?)));
    let kinds = registry.kinds();
    own.chain(kinds.filter_map(|kind| Some((kind.name.to_string(), kind.deprecation("")?.clone())))).collect()
}

/// Returns true if a global function is pure.
pub fn is_pure_function(name: &str) -> bool {
    names().iter().any(|known| known.name == name && known.effect == Effect::Pure && !known.forms.is_empty())
}

/// Returns the effect of a library function.
pub fn library_effect(library: &str, function: &str) -> Effect {
    let library = names().iter().find(|known| known.name == library && known.sort != NameKind::Given);
    library.and_then(|library| library.find(function)).map_or(Effect::Other, |function| function.effect)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_declared_once_and_has_a_doc() {
        let names = names();
        for (index, name) in names.iter().enumerate() {
            assert!(name.doc.len() > 12 && name.doc.ends_with('.'), "{}: {}", name.name, name.doc);
            let is_typed = name.forms.is_empty() != name.luau.is_empty();
            assert!(is_typed || !name.functions.is_empty(), "{}", name.name);
            assert!(!names[..index].iter().any(|earlier| earlier.name == name.name), "{}", name.name);
            for field in name.options().chain(&name.fields) {
                assert!(field.doc.len() > 8 && field.doc.ends_with('.'), "{}.{}", name.name, field.name);
                assert!(!field.luau.is_empty(), "{}.{}", name.name, field.name);
            }
            for function in &name.functions {
                let full = format!("{}.{}", name.name, function.name);
                assert!(function.doc.len() > 8 && function.doc.ends_with('.'), "{full}: {}", function.doc);
                assert!(!function.forms.is_empty() || !function.luau.is_empty(), "{full}");
            }
        }
        assert!(names.len() > 70, "{}", names.len());
    }

    #[test]
    fn what_remembers_or_calls_something_is_not_pure() {
        for name in ["pcall", "setmetatable", "param", "lsystem", "source", "require", "rawset", "F", "math"]
        {
            assert!(!is_pure_function(name), "{name}");
        }
        for name in ["random", "lerp", "vec", "noise", "pairs", "assert", "tostring"] {
            assert!(is_pure_function(name), "{name}");
        }
        for (library, function, effect) in [
            ("math", "max", Effect::Pure),
            ("ease", "out", Effect::Pure),
            ("table", "concat", Effect::Pure),
            ("table", "insert", Effect::ChangesFirst),
            ("table", "sort", Effect::Other),
            ("string", "gsub", Effect::Other),
            ("coroutine", "wrap", Effect::Other),
            ("nothing", "at_all", Effect::Other),
        ] {
            assert_eq!(library_effect(library, function), effect, "{library}.{function}");
        }
    }
}
