//! Transformation of a run's coordinates to georeferenced coordinates.

use glam::DVec3;

use crate::frame::{Crs, Passage, ReferenceFrame};
use burgeon_base::error::Result;

/// Transformation of a run's coordinates to a coordinate system that other programs support.
pub struct OutputPlacement<'a> {
    /// EPSG code; `None` if the run has no position on Earth.
    pub code: Option<u16>,
    passage: Option<Passage<'a>>,
}

/// EPSG code of longitude and latitude of WGS 84.
const DEGREES: u32 = 4326;

impl<'a> OutputPlacement<'a> {
    /// Returns the transformation to the projection of the run's data, or to degrees if that projection is specific to
    /// the run; without a frame, metres are unchanged.
    pub fn native(frame: Option<&'a ReferenceFrame>) -> Result<Self> {
        Self::of(frame, |_| DEGREES)
    }

    /// Returns the transformation to the projection of the run's data, or to the UTM zone of the run's centre if that
    /// projection is specific to the run. Lengths are true to within a thousandth.
    pub fn metric(frame: Option<&'a ReferenceFrame>) -> Result<Self> {
        Self::of(frame, |frame| frame.middle.map_or(DEGREES, zone))
    }

    /// Returns the transformation to longitude and latitude (degrees).
    pub fn degrees(frame: &'a ReferenceFrame) -> Result<Self> {
        let crs = Crs::epsg(DEGREES)?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    fn of(frame: Option<&'a ReferenceFrame>, other: impl Fn(&ReferenceFrame) -> u32) -> Result<Self> {
        let Some(frame) = frame else { return Ok(Self { code: None, passage: None }) };
        let crs = Crs::epsg(frame.epsg.map_or_else(|| other(frame), u32::from))?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    /// Returns the transformed position of a point (m) of the run; `None` if it cannot be projected.
    pub fn place(&self, at: DVec3) -> Option<DVec3> {
        let Some(passage) = &self.passage else { return Some(at) };
        let [x, y] = passage.leave([at.x, at.y]);
        (x.is_finite() && y.is_finite()).then_some(DVec3::new(x, y, at.z))
    }
}

/// Returns the EPSG code of the UTM zone at a longitude and a latitude (degrees).
fn zone([longitude, latitude]: [f64; 2]) -> u32 {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded before")]
    let number = (((longitude + 180.0) / 6.0).floor().rem_euclid(60.0)) as u32 + 1;
    number + if latitude < 0.0 { 32_700 } else { 32_600 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_has_the_zone_that_maps_give_it() {
        assert_eq!(
            [zone([7.4, 43.7]), zone([-43.2, -22.9]), zone([180.0, 1.0]), zone([-180.0, -1.0])],
            [32_632, 32_723, 32_601, 32_701]
        );
    }
}
