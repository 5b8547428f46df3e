//! Names of variants in fields, such as `kind = "linear"`.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;

/// Returns the variant called `name` among those that are `known`. Fails with the nearest name.
pub(super) fn variant<T: Copy>(owner: &str, name: &str, known: &[(&'static str, T)]) -> Result<T> {
    let found = known.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value).ok_or_else(|| {
        let names = || known.iter().map(|(name, _)| *name);
        let message = format!("{owner}: unknown kind {name:?}");
        Error::not_found("kind", name, names(), message).help(format!("use one of {}", listed(names())))
    })
}
