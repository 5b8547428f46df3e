//! Names of variants in fields, such as `kind = "linear"`.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;

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
