//! Version of the scripting API, and a test for its names.

use burgeon_kit::Registry;
use burgeon_language::names;
use burgeon_packages::Version;

/// Version of the scripting API: of the names that scripts have, and of their meaning.
///
/// Additions raise the second number. Changes that can break a script raise the first.
pub const API_VERSION: &str = "1.1.0";

/// Returns [`API_VERSION`] as a version.
pub fn api_version() -> Version {
    Version::parse(API_VERSION).unwrap_or(Version::new(1, 0, 0))
}

/// Returns true if scripts have `name`: a global name, or a field or method such as `extruder.bend`.
pub(crate) fn has_name(name: &str, registry: &Registry) -> bool {
    let (owner, member) = match name.split_once(['.', ':']) {
        Some((owner, member)) => (owner, Some(member)),
        None => (name, None),
    };
    if let Some(kind) = registry.get(owner) {
        let has = |member: &str| {
            kind.method(member).is_some() || kind.fields.iter().any(|field| field.is_called(member))
        };
        return member.is_none_or(has);
    }
    let Some(known) = names().iter().find(|known| known.name == owner) else { return false };
    member.is_none_or(|member| known.part_names().contains(&member))
}
