//! The levels of a facade that separate its storeys.

use super::lay::FacadeLayout;

/// Tolerance (m) within which a face starts or ends at a level.
const NEAR: f64 = 1e-6;

impl FacadeLayout<'_> {
    /// Returns the lowest level (m) from `height` upwards that no face crosses. This is at most the top of the facade;
    /// `None` if there are no faces.
    pub fn level_above(&self, height: f64) -> Option<f64> {
        let mut spans: Vec<[f64; 2]> =
            self.faces.iter().map(|face| [face.at.y, face.at.y + face.up.y]).collect();
        spans.sort_by(|a, b| a[0].total_cmp(&b[0]));
        let mut top = spans.first()?[0];
        for [low, high] in spans {
            if low >= top - NEAR && top >= height - NEAR {
                return Some(top);
            }
            top = top.max(high);
        }
        Some(top)
    }

    /// Removes all faces and models below a level (m) that none of them crosses.
    pub fn keep_above(&mut self, level: f64) {
        self.faces.retain(|face| {
            // An upward face at the level is the top of an object below the level.
            let is_lid =
                face.up.y.abs() < NEAR && face.right.cross(face.up).y > 0.0 && face.at.y < level + NEAR;
            face.at.y >= level - NEAR && !is_lid
        });
        self.fixtures.retain(|(_, at, _)| at.y >= level - NEAR);
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::super::FacadeFace;
    use super::*;

    fn layout(spans: &[[f64; 2]]) -> FacadeLayout<'static> {
        let mut laid = FacadeLayout::default();
        laid.faces.extend(spans.iter().map(|[low, high]| {
            FacadeFace::new(DVec3::new(0.0, *low, 0.0), DVec3::X, DVec3::new(0.0, high - low, 0.0))
        }));
        laid
    }

    #[test]
    fn storeys_begin_at_levels_that_nothing_crosses() {
        let storeys = layout(&[[0.0, 4.0], [4.0, 4.5], [4.5, 5.5], [5.5, 7.0], [4.5, 5.2], [7.0, 10.0]]);
        let level = |height: f64| storeys.level_above(height);
        assert_eq!([0.0, 3.0, 4.2, 5.0, 6.0, 8.0].map(level), [0.0, 4.0, 4.5, 5.5, 7.0, 10.0].map(Some));
        let pilaster = layout(&[[0.0, 4.0], [4.0, 10.0], [0.0, 10.0]]);
        assert_eq!(pilaster.level_above(3.0), Some(10.0));
        assert_eq!(layout(&[]).level_above(3.0), None);
    }

    #[test]
    fn what_is_below_a_level_goes_with_its_upper_side() {
        let mut laid = layout(&[[0.0, 4.0], [4.0, 8.0]]);
        // The faces are the top of a ledge below the level, and the bottom of one above it.
        let (out, across) = (DVec3::new(0.0, 0.0, 0.1), DVec3::new(2.0, 0.0, 0.0));
        let at = DVec3::new(0.0, 4.0, 0.0);
        laid.faces.push(FacadeFace::new(at + out, across, -out));
        laid.faces.push(FacadeFace::new(at, across, out));
        laid.keep_above(4.0);
        assert_eq!(laid.faces.len(), 2);
        assert!(laid.faces.iter().all(|face| face.right.cross(face.up).y <= 0.0));
    }
}
