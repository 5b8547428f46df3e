//! A name that scripts have, what it is and how it is called, and the list of all of them.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::sync::LazyLock;

use burgeon_kit::{Argument, Deprecation, Field, Registry};

use crate::form::CallForm;

/// A text that stands in the program or is made from what does.
type Text = Cow<'static, str>;

/// A name that every script has, or what something of that kind gives.
#[derive(Debug, Clone)]
pub struct Name {
    /// The name, or what people call it.
    pub name: Text,
    /// What it is.
    pub sort: NameKind,
    /// How it is called; empty of what is no function.
    pub forms: Vec<CallForm>,
    /// Its type in Luau where it is no function.
    pub luau: Text,
    /// What may be given in its place where one is taken, as a type in Luau; empty if nothing else may.
    pub instead: Text,
    /// What Luau calls the type as which it may be used, too; empty if there is none.
    pub extends: Text,
    /// What it does.
    pub doc: Text,
    /// What it has, if it is a table of named fields.
    pub fields: Vec<Field>,
    /// Its methods; of a library, its functions.
    pub functions: Vec<Name>,
    /// What stands between it and others.
    pub operators: Vec<Operator>,
    /// The type of what it has by numbers, as a list does; empty if it has none.
    pub items: Text,
    /// What is left behind by a call.
    pub effect: Effect,
    /// That it will go, and what is used instead.
    pub deprecated: Option<Deprecation>,
}

/// An operator of what a name gives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Operator {
    /// What Luau calls it, without the underscores: `add`.
    pub name: &'static str,
    /// The type of what stands behind it; empty where nothing does.
    pub other: &'static str,
    /// The type of what it gives.
    pub returns: &'static str,
}

/// What a name is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NameKind {
    /// A function or a value that a script names.
    Global,
    /// A function or a library of Luau itself.
    Luau,
    /// The constructor of modules that the standard library interprets by a method.
    Module {
        /// The type of object.
        kind: &'static str,
        /// Its method.
        method: &'static str,
    },
    /// What others give: scripts have it, but not by this name.
    Given,
    /// A method, or a function of a library.
    Function,
}

/// What a call leaves behind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effect {
    /// Nothing but which random numbers are drawn; no function that it is given is called.
    Pure,
    /// A change of the table that comes first, and nothing else.
    ChangesFirst,
    /// That depends.
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

    /// A function or a value that a script names.
    pub(super) fn global(name: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Global, doc)
    }

    /// What others give, with this type in Luau.
    pub(super) fn given(name: &'static str, luau: &'static str, doc: &'static str) -> Self {
        Self::new(name, NameKind::Given, doc).luau(luau)
    }

    /// A method, or a function of a library.
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

    /// May be called with these arguments, and then gives a value of type `returns`.
    pub(super) fn form(self, arguments: impl Into<Vec<Argument>>, returns: &str) -> Self {
        self.called(CallForm::new(arguments.into(), returns))
    }

    /// May be called as this type says.
    pub(super) fn read(self, luau: &str) -> Self {
        match CallForm::read(luau) {
            Some(form) => self.called(form),
            None => self,
        }
    }

    /// May be called so, with the units and the defaults that its doc tells.
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

    /// Whether its type in Luau has a parameter, as `System<T>` has.
    pub fn is_generic(&self) -> bool {
        self.luau.ends_with("<T>")
    }

    /// The fields of the table that it takes.
    pub fn options(&self) -> impl Iterator<Item = &Field> {
        self.forms.last().into_iter().flat_map(|form| &form.arguments).flat_map(|argument| &argument.fields)
    }

    /// The names of the fields that it takes or has, and of its functions.
    pub fn part_names(&self) -> Vec<&str> {
        let fields = self.options().chain(&self.fields).map(|field| &*field.name);
        fields.chain(self.functions.iter().map(|function| &*function.name)).collect()
    }

    /// Its method or its function called `name`.
    pub fn find(&self, name: &str) -> Option<&Self> {
        self.functions.iter().find(|function| function.name == name)
    }
}

/// A field that may be left out, and is `default` then.
pub(super) fn field(name: &'static str, luau: &str, default: &str, doc: &'static str) -> Field {
    Field { default: default.to_owned(), ..Field::new(name, luau, doc) }
}

/// All names that every script has but those of types of objects, and what they give.
pub fn names() -> &'static [Name] {
    static NAMES: LazyLock<Vec<Name>> = LazyLock::new(|| {
        let own = super::burgeon::names().into_iter().chain(super::luau::names());
        own.chain(super::standard::names()).collect()
    });
    &NAMES
}

/// Which names, and constructors of the types in `registry`, will go.
pub fn deprecated_names(registry: &Registry) -> BTreeMap<String, Deprecation> {
    let own = names().iter().filter_map(|name| Some((name.name.to_string(), name.deprecated.clone()?)));
    let kinds = registry.kinds();
    own.chain(kinds.filter_map(|kind| Some((kind.name.to_string(), kind.deprecation("")?.clone())))).collect()
}

/// Whether a function that every script has is pure.
pub fn is_pure_function(name: &str) -> bool {
    names().iter().any(|known| known.name == name && known.effect == Effect::Pure && !known.forms.is_empty())
}

/// What a function of a library leaves behind.
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
