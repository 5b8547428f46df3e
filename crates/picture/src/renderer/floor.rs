//! Brightness of the ground around the model, which lights the model's underside.

use super::sky::Sky;
use super::stage::Stage;
use super::sun::Sun;
use glam::{Vec2, Vec3A};
use rayon::prelude::*;

/// Number of cells along each side of the grid.
const CELLS: usize = 72;

/// Grid of brightness on the ground.
pub(super) struct Floor {
    /// Height of the ground on the stage, in units of the model's radius.
    pub height: f32,
    corner: Vec2,
    /// Number of cells per radius of the model.
    scale: Vec2,
    /// Light of sun and sky relative to the light far from the model, row by row.
    light: Vec<f32>,
}

impl Floor {
    /// Computes the ground at `height` below the model, lit by `sun` and `sky`.
    pub(super) fn new(stage: &Stage, sun: &Sun, sky: &Sky, height: f32) -> Self {
        let (low, high) = (stage.bounds.0.truncate() - 1.0, stage.bounds.1.truncate() + 1.0);
        let scale = Vec2::splat(CELLS as f32) / (high - low);
        let (sunlight, skylight) =
            (sun.light.element_sum() * sun.direction.z, sky.open(Vec3A::Z).element_sum());
        let total = sunlight + skylight;
        let sharp: Vec<f32> = (0..CELLS * CELLS)
            .into_par_iter()
            .map(|cell| {
                let corner = Vec2::new((cell % CELLS) as f32, (cell / CELLS) as f32);
                let point = |i: usize| {
                    let inside = Vec2::new((i % 4) as f32 + 0.5, (i / 4) as f32 + 0.5) / 4.0;
                    Vec3A::from((low + (corner + inside) / scale).extend(height))
                };
                let lit = (0..16).filter(|i| sun.reaches(point(*i))).count() as f32 / 16.0;
                (sunlight * lit + skylight * sky.openness(point(5))) / total
            })
            .collect();
        let light = blur(&blur(&sharp));
        Self { height, corner: low, scale, light }
    }

    /// Returns the light on the ground at the point where the ray from `point` in `direction`, which points down, meets
    /// it. The value 1 is the light far from the model.
    pub(super) fn light(&self, point: Vec3A, direction: Vec3A) -> f32 {
        let hit = point + direction * ((self.height - point.z).min(0.0) / direction.z);
        let at = (hit.truncate() - self.corner) * self.scale - 0.5;
        let last = CELLS as f32 - 1.0;
        if at.min_element() < 0.0 || at.max_element() >= last {
            return 1.0;
        }
        let (x, y) = (at.x as usize, at.y as usize);
        let part = at.fract();
        let row =
            |y: usize| self.light[y * CELLS + x] * (1.0 - part.x) + self.light[y * CELLS + x + 1] * part.x;
        row(y) * (1.0 - part.y) + row(y + 1) * part.y
    }
}

/// Averages each cell with its neighbours.
fn blur(cells: &[f32]) -> Vec<f32> {
    let near = |i: usize| [i.saturating_sub(1), i, (i + 1).min(CELLS - 1)];
    (0..CELLS * CELLS)
        .map(|cell| {
            let (xs, ys) = (near(cell % CELLS), near(cell / CELLS));
            ys.iter().flat_map(|y| xs.iter().map(move |x| cells[y * CELLS + x])).sum::<f32>() / 9.0
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::detail::RenderDetail;
    use super::super::{samples, view::Viewpoint};
    use super::*;
    use crate::Quality;
    use glam::DVec3;

    #[test]
    fn the_ground_is_darker_under_the_model_than_far_from_it() {
        let scene = samples::boxes(&[DVec3::ZERO]);
        let stage = Stage::new(&scene).unwrap();
        let detail = RenderDetail::of(Quality::Draft, 12);
        let sun = Sun::new(&stage, Viewpoint { azimuth: 0.0, elevation: 0.3 }, None, &detail);
        let sky = Sky::new(&stage, &sun, &detail, true);
        let height = stage.bounds.0.z - 0.001;
        let floor = Floor::new(&stage, &sun, &sky, height);
        let light = |x: f32, y: f32| floor.light(Vec3A::new(x, y, height + 0.01), Vec3A::NEG_Z);
        assert!(light(0.0, 0.0) < 0.1, "{}", light(0.0, 0.0));
        assert!(light(1.5, 1.5) > 0.8);
        assert!((light(9.0, 0.0) - 1.0).abs() < 1e-6);
    }
}
