//! Replacement for coordinate systems in well-known text in programs built without the feature `projections`.

use super::system::Crs;
use burgeon_base::error::{Error, Result};

/// End of the name of a projection whose unit was changed to metres.
pub(crate) const IN_METRES: &str = " in metres";

/// Fails, because coordinate systems need the feature `projections`.
pub fn crs_of_text(_text: &str, label: &str, _remedy: &str) -> Result<Crs> {
    Err(Error::left_out("data formats", "data").about(label))
}

/// Returns no unit, because a text without a known coordinate system is refused.
pub fn height_unit(_text: &str, _label: &str, _remedy: &str) -> Result<Option<f64>> {
    Ok(None)
}
