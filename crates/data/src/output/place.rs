//! From the metres of a run to where the earth has its places.

use glam::DVec3;

use crate::frame::{Crs, Passage, ReferenceFrame};
use burgeon_base::error::Result;

/// The way of a run's places into a coordinate system that other programs know.
pub struct OutputPlacement<'a> {
    /// Its EPSG code; none where the run's places are nowhere on the earth.
    pub code: Option<u16>,
    passage: Option<Passage<'a>>,
}

/// Longitude and latitude of WGS 84.
const DEGREES: u32 = 4326;

impl<'a> OutputPlacement<'a> {
    /// Into the projection of the run's data, or into degrees if it has one of its own; metres stay as they are without a
    /// frame.
    pub fn native(frame: Option<&'a ReferenceFrame>) -> Result<Self> {
        Self::of(frame, |_| DEGREES)
    }

    /// Into the projection of the run's data, or into the UTM zone of the run's middle if it has one of its own: lengths
    /// are those of the ground but for a thousandth.
    pub fn metric(frame: Option<&'a ReferenceFrame>) -> Result<Self> {
        Self::of(frame, |frame| frame.middle.map_or(DEGREES, zone))
    }

    /// Into longitude and latitude (degrees).
    pub fn degrees(frame: &'a ReferenceFrame) -> Result<Self> {
        let crs = Crs::epsg(DEGREES)?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    fn of(frame: Option<&'a ReferenceFrame>, other: impl Fn(&ReferenceFrame) -> u32) -> Result<Self> {
        let Some(frame) = frame else { return Ok(Self { code: None, passage: None }) };
        let crs = Crs::epsg(frame.epsg.map_or_else(|| other(frame), u32::from))?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    /// Where a place (m) of the run is; none if it has no place there.
    pub fn place(&self, at: DVec3) -> Option<DVec3> {
        let Some(passage) = &self.passage else { return Some(at) };
        let [x, y] = passage.leave([at.x, at.y]);
        (x.is_finite() && y.is_finite()).then_some(DVec3::new(x, y, at.z))
    }
}

/// The EPSG code of the UTM zone around a longitude and a latitude (degrees).
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
