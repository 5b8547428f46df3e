//! The water of a river: a ribbon along its path.

use glam::{DVec3, Vec2};

use burgeon_scene::{Normal, Part};

/// A river.
#[derive(Clone)]
pub(super) struct River {
    /// Path (m) along the unchanged ground.
    pub way: Vec<DVec3>,
    /// Width (m).
    pub width: f64,
}

/// Depth of the water surface below the unchanged ground, as a multiple of the width.
const BELOW: f64 = 0.05;

impl River {
    /// Draws the water, which widens from the source.
    pub(super) fn draw(&self, part: &mut Part) {
        let Ok(first) = u32::try_from(part.positions.len()) else { return };
        let last = self.way.len().saturating_sub(1);
        let mut run = 0.0;
        for (index, at) in self.way.iter().enumerate() {
            let (before, after) = (self.way[index.saturating_sub(1)], self.way[(index + 1).min(last)]);
            let along = (after - before).truncate().normalize_or_zero();
            run += (*at - before).truncate().length();
            let half = self.width / 2.0 * (run / (12.0 * self.width)).clamp(0.15, 1.0);
            let side = along.perp() * half;
            for (side, u) in [(side, 0.0), (-side, 2.0 * half)] {
                let place = (at.truncate() + side).extend(at.z - self.width * BELOW);
                part.positions.push(place.as_vec3());
                part.normals.push(Normal::Z);
                #[allow(clippy::cast_possible_truncation, reason = "texture coordinates are f32")]
                part.uvs.push(Vec2::new(u as f32, run as f32));
            }
        }
        for index in (0..).take(last) {
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| first + 2 * index + corner);
            part.triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
}
