//! Up direction of the default camera.

use glam::{DMat3, DVec3};

/// Orientation of the default camera if z is not up, as on a planet. It does not move the scene.
///
/// ```
/// use burgeon_scene::Upright;
/// use glam::DVec3;
///
/// // On the equator of a planet, at longitude 0.
/// let upright = Upright::new(DVec3::X, DVec3::Z).expect("the direction is not zero");
/// assert!((upright.rotation() * DVec3::X).abs_diff_eq(DVec3::Z, 1e-12));
/// assert!((upright.rotation() * DVec3::Z).abs_diff_eq(DVec3::Y, 1e-12));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Upright {
    up: DVec3,
    north: DVec3,
}

impl Upright {
    /// Creates the orientation at a point of a sphere: `up` points away from its centre, north towards the pole in the
    /// direction `axis`. At the pole itself, north is the y axis. Returns `None` if `up` is zero.
    pub fn new(up: DVec3, axis: DVec3) -> Option<Self> {
        let up = up.try_normalize()?;
        let along = |direction: DVec3| {
            let flat = direction.reject_from_normalized(up);
            (flat.length() > 1e-6 * direction.length()).then(|| flat.normalize_or_zero())
        };
        let north = [axis, DVec3::Y, DVec3::X].into_iter().find_map(along)?;
        Some(Self { up, north })
    }

    /// Returns the unit vector that points up.
    pub fn up(&self) -> DVec3 {
        self.up
    }

    /// Returns the rotation from up to z and from north to y.
    pub fn rotation(&self) -> DMat3 {
        DMat3::from_cols(self.north.cross(self.up), self.north, self.up).transpose()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn up_becomes_z_and_north_y_for_every_direction() {
        for up in [DVec3::Z, DVec3::NEG_Z, DVec3::Y, DVec3::new(-3.0, 0.2, 1.0), DVec3::new(1e-9, 0.0, -5.0)]
        {
            for axis in [DVec3::Z, DVec3::new(-0.6, -0.4, 0.65), DVec3::Y] {
                let upright = Upright::new(up, axis).unwrap();
                let turn = upright.rotation();
                assert!((turn.determinant() - 1.0).abs() < 1e-12);
                assert!((turn * up.normalize()).distance(DVec3::Z) < 1e-12);
                let pole = turn * axis;
                assert!(pole.y > -1e-6 && pole.x.abs() < 1e-6, "{up} {axis}: the pole is at {pole}");
            }
        }
        assert_eq!(Upright::new(DVec3::Z, DVec3::Z).unwrap().rotation(), DMat3::IDENTITY);
        assert_eq!(Upright::new(DVec3::ZERO, DVec3::Z), None);
    }
}
