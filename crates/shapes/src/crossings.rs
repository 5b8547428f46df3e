//! Refusal of outlines that cross themselves.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::overlay::{Fill, fill};
use burgeon_geometry::{Polygon, Rings};

/// Fails if rings cross or touch themselves or each other, so that they enclose another area.
pub(crate) fn check_crossings(polygon: &Polygon) -> Result<()> {
    let valid = fill(&[Rings::from(polygon)], Fill::NonZero)?;
    let holes = valid.first().map_or(0, |rings| rings.len() - 1);
    let area: f64 =
        valid.into_iter().filter_map(|rings| Polygon::turned(rings).ok()).map(|part| part.area()).sum();
    if holes == polygon.holes().len() && (area - polygon.area()).abs() <= 1e-6 * area {
        return Ok(());
    }
    Err(Error::geometry("the outline crosses itself, or a hole is not inside of it")
        .help("use geometry(...):make_valid(), or order the points along the outline"))
}
