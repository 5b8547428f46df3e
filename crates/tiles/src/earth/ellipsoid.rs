//! WGS 84 ellipsoid.

use glam::{DAffine3, DMat3, DVec3};

/// Semi-major axis (m).
const MAJOR: f64 = 6_378_137.0;

/// Flattening.
const FLATTENING: f64 = 1.0 / 298.257_223_563;

/// Square of the eccentricity.
const ECCENTRICITY: f64 = FLATTENING * (2.0 - FLATTENING);

/// Returns the geocentric position (m) of a longitude and a latitude (degrees) at a height above the ellipsoid (m).
///
/// ```
/// let place = burgeon_tiles::earth::from_degrees([0.0, 0.0], 10.0);
/// assert_eq!(place.to_array(), [6_378_147.0, 0.0, 0.0]);
/// ```
pub fn from_degrees([longitude, latitude]: [f64; 2], height: f64) -> DVec3 {
    let (east, north) = (longitude.to_radians().sin_cos(), latitude.to_radians().sin_cos());
    let radius = MAJOR / (1.0 - ECCENTRICITY * north.0 * north.0).sqrt();
    let across = (radius + height) * north.1;
    DVec3::new(across * east.1, across * east.0, (radius * (1.0 - ECCENTRICITY) + height) * north.0)
}

/// Returns the transform from the axes east, north and up at a position, given as in [`from_degrees`], to geocentric
/// coordinates (m).
pub fn east_north_up(degrees: [f64; 2], height: f64) -> DAffine3 {
    let (east, north) = (degrees[0].to_radians().sin_cos(), degrees[1].to_radians().sin_cos());
    let axes = DMat3::from_cols(
        DVec3::new(-east.0, east.1, 0.0),
        DVec3::new(-north.0 * east.1, -north.0 * east.0, north.1),
        DVec3::new(north.1 * east.1, north.1 * east.0, north.0),
    );
    DAffine3 { matrix3: axes, translation: from_degrees(degrees, height) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_places_have_their_geocentric_coordinates() {
        // The pole is at the semi-minor axis.
        assert!((from_degrees([0.0, 90.0], 0.0) - DVec3::new(0.0, 0.0, 6_356_752.314_245)).length() < 1e-6);
        // Paris, by an independent computation with PROJ's formulas.
        let radius = MAJOR / (1.0 - ECCENTRICITY * 48.85_f64.to_radians().sin().powi(2)).sqrt();
        let place = from_degrees([2.35, 48.85], 100.0);
        assert!(
            (place.z - (radius * (1.0 - ECCENTRICITY) + 100.0) * 48.85_f64.to_radians().sin()).abs() < 1e-6
        );
        assert!((place.truncate().length() - (radius + 100.0) * 48.85_f64.to_radians().cos()).abs() < 1e-6);
    }

    #[test]
    fn the_local_axes_are_right_handed_and_up_is_away_from_the_ellipsoid() {
        for degrees in [[2.35, 48.85], [-70.0, -33.0], [179.9, 0.1]] {
            let axes = east_north_up(degrees, 30.0);
            assert!((axes.matrix3.determinant() - 1.0).abs() < 1e-12);
            let above = axes.transform_point3(DVec3::new(0.0, 0.0, 12.0));
            assert!((above - from_degrees(degrees, 42.0)).length() < 1e-8);
            let east = from_degrees([degrees[0] + 1e-6, degrees[1]], 30.0) - axes.translation;
            assert!(east.normalize().dot(axes.matrix3.x_axis) > 1.0 - 1e-9);
        }
    }
}
