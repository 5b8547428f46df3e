//! Names of variants in fields, such as `kind = "linear"`, and coordinates in lists.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use glam::DVec3;

/// Returns the variant called `name` among those that are `known`, for the field `owner.field`. Fails with the nearest
/// name.
pub(crate) fn variant<T: Copy>(
    owner: &str,
    field: &'static str,
    name: &str,
    known: &[(&'static str, T)],
) -> Result<T> {
    let found = known.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names = || known.iter().map(|(name, _)| *name);
        let message = format!("{owner}: unknown {field} {name:?}");
        Error::not_found(field, name, names(), message).help(format!("use one of {}", listed(names())))
    })
}

/// Returns the name of `variant` among those that are `known`.
pub(crate) fn name_of<T: Copy + PartialEq>(variant: T, known: &[(&'static str, T)]) -> &'static str {
    known.iter().find(|(_, value)| *value == variant).map_or("", |(name, _)| name)
}

/// Returns the position with the coordinates of `row`; omitted ones are 0.
pub(crate) fn position(row: &[f64]) -> DVec3 {
    let coordinate = |axis: usize| row.get(axis).copied().unwrap_or(0.0);
    DVec3::new(coordinate(0), coordinate(1), coordinate(2))
}
