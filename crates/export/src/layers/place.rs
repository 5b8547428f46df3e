//! Transformation of a run's coordinates to georeferenced coordinates.

use glam::DVec3;

use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Crs, Passage, ReferenceFrame};

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
        let Some(frame) = frame else { return Ok(Self { code: None, passage: None }) };
        let crs = Crs::epsg(frame.epsg.map_or(DEGREES, u32::from))?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    /// Returns the transformation to the projection of the run's data, or to the UTM zone of the run's centre if that
    /// projection has no EPSG code in metres: it is specific to the run, or its unit was changed. Lengths are true to
    /// within a thousandth.
    ///
    /// Fails if the run's centre has no longitude and latitude.
    ///
    /// ```
    /// use burgeon_export::layers::OutputPlacement;
    /// use burgeon_spatial::{Crs, ReferenceFrame};
    ///
    /// let frame = ReferenceFrame::around(&Crs::epsg(4326)?, [27.0, 60.0], "the town")?;
    /// assert_eq!(OutputPlacement::metric(Some(&frame))?.code, Some(32_635));
    /// assert_eq!(OutputPlacement::metric(None)?.code, None);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn metric(frame: Option<&'a ReferenceFrame>) -> Result<Self> {
        let Some(frame) = frame.filter(|frame| frame.epsg.is_none()) else { return Self::native(frame) };
        let middle = frame.middle.or(frame.world_place().degrees).ok_or_else(|| {
            Error::data(format!("{} has no longitude and latitude at the origin of the run", frame.name))
                .help("convert the data to a coordinate system in metres, such as a UTM zone")
        })?;
        let crs = Crs::epsg(zone(middle))?;
        Ok(Self { code: crs.code, passage: Some(frame.passage(&crs)?) })
    }

    /// Returns the transformation to longitude and latitude (degrees).
    pub fn degrees(frame: &'a ReferenceFrame) -> Result<Self> {
        let crs = Crs::epsg(DEGREES)?;
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

    #[test]
    fn feet_and_degrees_are_written_in_metres_of_the_utm_zone() {
        // Charlotte in feet (EPSG:2264), in feet of 0.3048 m (EPSG:2222), and a place in degrees.
        let places = [(2264, [1_450_000.0, 540_000.0], 32_617), (2222, [700_000.0, 900_000.0], 32_612)];
        for (code, at, zone) in places.into_iter().chain([(4326, [7.4, 43.7], 32_632)]) {
            let frame = ReferenceFrame::around(&Crs::epsg(code).unwrap(), at, "a place").unwrap();
            let outward = OutputPlacement::metric(Some(&frame)).unwrap();
            assert_eq!((frame.epsg, outward.code), (None, Some(zone)), "{code}");
            let [a, b] = [0.0, 10.0].map(|x| outward.place(DVec3::new(x, 0.0, 1.0)).unwrap());
            assert!((a.distance(b) - 10.0).abs() < 0.01, "{code}: {a} {b}");
        }
        let frame = ReferenceFrame::around(&Crs::epsg(3067).unwrap(), [385_400.0, 6_671_500.0], "a place");
        assert_eq!(OutputPlacement::metric(Some(&frame.unwrap())).unwrap().code, Some(3067));
        assert_eq!(OutputPlacement::metric(None).unwrap().code, None);
    }
}
