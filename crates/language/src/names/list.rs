//! The list of all names, and lookups in it.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use burgeon_kit::{Deprecation, Registry};

use super::name::{Effect, Name, NameKind};
use super::{burgeon, luau, standard};

/// Returns all names that every script has except for object types, and the types of their results.
///
/// ```
/// use burgeon_language::{NameKind, names};
///
/// let lerp = names().iter().find(|name| name.name == "lerp").expect("a function of the language");
/// assert_eq!((lerp.sort == NameKind::Global, lerp.forms[0].least()), (true, 3));
/// ```
pub fn names() -> &'static [Name] {
    static NAMES: LazyLock<Vec<Name>> = LazyLock::new(|| {
        let own = burgeon::names().into_iter().chain(luau::names());
        own.chain(standard::names()).collect()
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
///
/// ```
/// use burgeon_language::{Effect, library_effect};
///
/// assert_eq!(library_effect("math", "max"), Effect::Pure);
/// assert_eq!(library_effect("table", "insert"), Effect::ChangesFirst);
/// ```
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
        for name in [
            "random", "stream", "normal", "choose", "step", "lerp", "vec", "noise", "pairs", "assert",
            "tostring",
        ] {
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
