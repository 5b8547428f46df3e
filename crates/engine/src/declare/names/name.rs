//! What stands in the list: a name, its type, what it takes and what it gives.

use std::borrow::Cow;
use std::collections::BTreeMap;

use burgeon_kit::{Deprecation, Registry};

use super::{burgeon, luau, standard};

/// A text that stands in the program or is made from what does.
type Text = Cow<'static, str>;

/// A name that every script has, or what something of that kind gives.
#[derive(Debug, Clone)]
pub struct Name {
    /// The name, or what people call it.
    pub name: Text,
    /// What it is.
    pub sort: NameKind,
    /// Its type in Luau; of a function, its parameters and its result.
    pub luau: Text,
    /// What it does.
    pub doc: Text,
    /// What the table that it takes may have, or what it has.
    pub parts: &'static [NameMember],
    /// Whether calling it leaves nothing behind but which random numbers are drawn, and calls no function that it is given;
    /// of a library, whether all its functions are such.
    pub(crate) pure: bool,
    /// That it will go, and what is used instead.
    pub deprecated: Option<Deprecation>,
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
}

/// A field of a table, or a method.
#[derive(Debug, Clone, Copy)]
pub struct NameMember {
    /// Its name.
    pub name: &'static str,
    /// Its type in Luau; of a method, its parameters and its result.
    pub luau: &'static str,
    /// What it is where it is left out; empty where it must be given or is only read.
    pub default: &'static str,
    /// Its unit, if it has one.
    pub unit: Option<&'static str>,
    /// What it means.
    pub doc: &'static str,
    /// Whether it is a method.
    pub is_method: bool,
}

impl Name {
    pub(super) const fn new(
        name: &'static str,
        sort: NameKind,
        luau: &'static str,
        doc: &'static str,
    ) -> Self {
        let (name, luau, doc) = (Cow::Borrowed(name), Cow::Borrowed(luau), Cow::Borrowed(doc));
        Self { name, sort, luau, doc, parts: &[], pure: false, deprecated: None }
    }

    pub(super) const fn pure(mut self) -> Self {
        self.pure = true;
        self
    }

    pub(super) const fn parts(mut self, parts: &'static [NameMember]) -> Self {
        self.parts = parts;
        self
    }

    /// The names of its parts.
    pub(crate) fn part_names(&self) -> Vec<&'static str> {
        self.parts.iter().map(|part| part.name).collect()
    }
}

impl NameMember {
    pub(super) const fn new(name: &'static str, luau: &'static str, doc: &'static str) -> Self {
        Self { name, luau, default: "", unit: None, doc, is_method: false }
    }

    pub(super) const fn method(name: &'static str, luau: &'static str, doc: &'static str) -> Self {
        Self { is_method: true, ..Self::new(name, luau, doc) }
    }

    pub(super) const fn or(mut self, default: &'static str) -> Self {
        self.default = default;
        self
    }

    pub(super) const fn unit(mut self, unit: &'static str) -> Self {
        self.unit = Some(unit);
        self
    }
}

/// All names that every script has but those of types of objects, and what they give.
pub fn names() -> Vec<Name> {
    let own = burgeon::NAMES.iter().chain(luau::NAMES).map(|name| (*name).clone());
    own.chain(standard::names()).collect()
}

/// Which names, and constructors of the types in `registry`, will go.
pub(crate) fn deprecated_names(registry: &Registry) -> BTreeMap<String, Deprecation> {
    let own = burgeon::NAMES.iter().chain(luau::NAMES);
    let own = own.filter_map(|name| Some((name.name.to_string(), name.deprecated.clone()?)));
    let kinds = registry.kinds();
    own.chain(kinds.filter_map(|kind| Some((kind.name.to_string(), kind.deprecation("")?.clone())))).collect()
}

/// Whether a function that every script has is pure.
pub(crate) fn is_pure_function(name: &str) -> bool {
    is_pure(name, |luau| luau.starts_with('('))
}

/// Whether every function of a library is pure.
pub(crate) fn is_pure_library(name: &str) -> bool {
    is_pure(name, |luau| luau.starts_with('{'))
}

fn is_pure(name: &str, of_type: impl Fn(&str) -> bool) -> bool {
    static PURE: std::sync::LazyLock<Vec<Name>> =
        std::sync::LazyLock::new(|| names().into_iter().filter(|name| name.pure).collect());
    PURE.iter().any(|known| known.name == name && of_type(&known.luau))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_declared_once_and_has_a_doc() {
        let names = names();
        for (index, name) in names.iter().enumerate() {
            assert!(name.doc.len() > 12 && name.doc.ends_with('.'), "{}: {}", name.name, name.doc);
            assert!(!name.luau.is_empty(), "{}", name.name);
            assert!(!names[..index].iter().any(|earlier| earlier.name == name.name), "{}", name.name);
            for part in name.parts {
                assert!(part.doc.len() > 8 && part.doc.ends_with('.'), "{}.{}", name.name, part.name);
                assert!(!part.luau.is_empty(), "{}.{}", name.name, part.name);
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
        for (name, pure) in [("math", true), ("ease", true), ("table", false), ("coroutine", false)] {
            assert_eq!(is_pure_library(name), pure, "{name}");
        }
    }
}
