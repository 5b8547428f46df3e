//! The version of what scripts can use, and whether a name is part of it.

use burgeon_kit::Registry;
use burgeon_language::names;
use burgeon_packages::Version;

/// The version of the script API: of the names that scripts have, and of what they mean.
///
/// What a script can do then and could not before raises the second number; what may break a script raises the first.
pub const API_VERSION: &str = "1.0.0";

/// [`API_VERSION`] as a version.
pub fn api_version() -> Version {
    Version::parse(API_VERSION).unwrap_or(Version::new(1, 0, 0))
}

/// Whether scripts have what `name` means: a name, or one and a field or a method of it, such as `extruder.bend`.
pub(crate) fn has_name(name: &str, registry: &Registry) -> bool {
    let (owner, member) = match name.split_once(['.', ':']) {
        Some((owner, member)) => (owner, Some(member)),
        None => (name, None),
    };
    if let Some(kind) = registry.get(owner) {
        let has = |member: &str| {
            kind.method(member).is_some() || kind.fields.iter().any(|field| field.name == member)
        };
        return member.is_none_or(has);
    }
    let Some(known) = names().iter().find(|known| known.name == owner) else { return false };
    member.is_none_or(|member| known.part_names().contains(&member))
}
