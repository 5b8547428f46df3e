//! Object types for examples in error messages, chosen from the registry.

use burgeon_kit::{Construct, Draw, Kind, Registry};
use burgeon_language::{NameKind, names};

/// Returns the types that draw and that scripts can make, in the order of the registry.
fn drawing(registry: &Registry) -> impl Iterator<Item = &Kind> {
    let kinds = registry.kinds().map(|kind| &**kind);
    kinds.filter(|kind| kind.has_capability::<dyn Draw>() && !matches!(kind.construct, Construct::Given))
}

/// Returns a constructor that a script can inherit from, if there is one.
pub(in crate::machine) fn drawing_kind(registry: &Registry) -> Option<&str> {
    drawing(registry).next().map(|kind| &*kind.name)
}

/// Returns the constructor of a type to which a script can add functions, preferably a type made from a
/// measurable value.
pub(in crate::machine) fn extended_kind(registry: &Registry) -> Option<&str> {
    let measured = drawing(registry).find(|kind| kind.first.is_some());
    measured.map(|kind| &*kind.name).or_else(|| drawing_kind(registry))
}

/// Returns an example of the option `object` of a system, with the type that draws most modules of the standard library.
pub(in crate::machine) fn object_of_system(registry: &Registry) -> Option<String> {
    let drawn_modules = |kind: &Kind| {
        let sorts = names().iter().map(|name| name.sort);
        sorts
            .filter(|sort| matches!(sort, NameKind::Module { kind: known, .. } if kind.name == *known))
            .count()
    };
    // The first of equal ones.
    let kinds = drawing(registry).map(|kind| (drawn_modules(kind), &*kind.name));
    let (_, name) = kinds.reduce(|best, next| if next.0 > best.0 { next } else { best })?;
    Some(format!("object = {name}()"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_types_that_there_are_are_named() {
        let all = burgeon_objects::registry();
        assert_eq!(object_of_system(&all).as_deref(), Some("object = turtle()"));
        assert_eq!((extended_kind(&all), drawing_kind(&all)), (Some("footprint"), Some("extruder")));
        let without = |names: &[&str]| -> Registry {
            all.kinds().filter(|kind| !names.contains(&&*kind.name)).cloned().collect()
        };
        let some = without(&["turtle", "footprint"]);
        assert_eq!(object_of_system(&some).as_deref(), Some("object = extruder()"));
        assert_eq!((extended_kind(&some), drawing_kind(&some)), (Some("extruder"), Some("extruder")));
        let none = without(&["turtle", "footprint", "extruder"]);
        assert_eq!((object_of_system(&none), extended_kind(&none), drawing_kind(&none)), (None, None, None));
    }
}
