//! Projections, and the coordinate systems of the EPSG registry.

use proj4rs::Proj;
use proj4rs::transform::transform;

use super::corrections;
use super::epsg::entry;
use burgeon_base::error::{Error, Result};

/// Projection, or longitude and latitude.
#[derive(Clone)]
pub(crate) struct Projection(Proj);

impl Projection {
    /// Creates a projection from a PROJ definition. If it is unusable, fails with the error that `cannot` makes of the
    /// reason.
    pub(crate) fn new(definition: &str, cannot: impl Fn(String) -> Error) -> Result<Self> {
        Proj::from_proj_string(definition).map(Self).map_err(|error| cannot(error.to_string()))
    }

    /// Transforms a point (m, or radians) into another projection. Fails with the reason.
    pub(crate) fn bring(&self, into: &Self, point: &mut (f64, f64, f64)) -> Result<(), String> {
        transform(&self.0, &into.0, point).map_err(|error| error.to_string())
    }
}

/// Returns the code and the PROJ definition of a coordinate system, if the registry contains it. Fails if the code was
/// withdrawn because it was wrong.
pub(crate) fn find_system(code: u32) -> Result<Option<(u16, String)>> {
    let Some(found) = entry(code)? else { return Ok(None) };
    corrections::refuse_withdrawn(found.code)?;
    Ok(Some((found.code, corrections::correct_definition(found.code, found.proj, &found.text))))
}

/// Returns the name of the datum of a coordinate system with a code and a PROJ definition, if no shift from it to WGS 84
/// is known.
pub(crate) fn unshifted_datum(code: Option<u16>, proj: &str) -> Option<String> {
    if !corrections::lacks_shift(proj) {
        return None;
    }
    let text = code.and_then(|code| definition(code).ok().flatten()).unwrap_or_default();
    let name = corrections::datum_name(&text).unwrap_or("its datum");
    Some(name.replace('_', " "))
}

/// Returns the definition of a coordinate system in well-known text, if the registry contains it.
pub fn definition(code: u16) -> Result<Option<String>> {
    Ok(entry(u32::from(code))?.map(|found| found.text))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn projections_are_within_a_millimetre_of_another_programs() {
        let projection = |code: u32| {
            let (_, definition) = find_system(code).unwrap().unwrap();
            Projection::new(&definition, Error::data).unwrap()
        };
        let degrees = projection(4326);
        let mut counts = std::collections::BTreeMap::new();
        for line in include_str!("../fixtures/projections.csv").lines().filter(|line| !line.starts_with('#'))
        {
            let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
            let [code, longitude, latitude, x, y] = numbers[..] else { panic!("{line}") };
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a code")]
            let plane = projection(code as u32);
            let mut place = (longitude.to_radians(), latitude.to_radians(), 0.0);
            degrees.bring(&plane, &mut place).unwrap();
            let off = (place.0 - x).hypot(place.1 - y);
            assert!(off < 1e-3, "{line}: {off} m");
            plane.bring(&degrees, &mut place).unwrap();
            let back = (place.0.to_degrees() - longitude).hypot(place.1.to_degrees() - latitude) * 111_320.0;
            assert!(back < 1e-3, "{line}: {back} m on the way back");
            *counts.entry(code.to_string()).or_insert(0) += 1;
        }
        assert_eq!((counts.len(), counts.values().min()), (5, Some(&120)));
    }
}
