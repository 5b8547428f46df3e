//! Measures the extent of a scene.

use super::extent::Extent;
use super::points::spread;
use super::stage::Stage;
use burgeon_base::error::Result;
use burgeon_scene::Scene;
use glam::DVec3;

/// Number of directions for which the farthest point is stored. The camera's margin exceeds the error in between.
const DIRECTIONS: usize = 512;

/// Maximum number of points of an extent that was joined from many.
const MOST: usize = 16 * DIRECTIONS;

impl Extent {
    /// Computes the extent of `scene`; empty if the scene shows nothing. Fails as [`render`](super::render) does.
    pub fn of(scene: &Scene) -> Result<Self> {
        let stage = Stage::new(scene)?;
        let back = stage.shrink.inverse();
        let hull: Vec<DVec3> = stage.hull.iter().map(|point| point.as_dvec3()).collect();
        let farthest = farthest(&hull).into_iter();
        Ok(Self::new(farthest.map(|i| back.transform_point3(hull[i])).collect()))
    }

    /// Extends the extent by `other`, and keeps only the points that determine it, so that many extents take no more
    /// memory than a few.
    pub fn join_outline(&mut self, other: &Self) {
        self.join(other);
        if self.all().len() > MOST {
            let kept = farthest(self.all());
            *self = Self::new(kept.into_iter().map(|i| self.all()[i]).collect());
        }
    }
}

/// Returns the indices of the farthest of `points` in each direction, in order.
fn farthest(points: &[DVec3]) -> Vec<usize> {
    let mut farthest: Vec<usize> = (0..DIRECTIONS)
        .filter_map(|i| {
            let direction = spread(i, DIRECTIONS);
            (0..points.len()).max_by(|a, b| points[*a].dot(direction).total_cmp(&points[*b].dot(direction)))
        })
        .collect();
    farthest.sort_unstable();
    farthest.dedup();
    farthest
}

#[cfg(test)]
mod tests {
    use super::super::{render, render_within, samples};
    use super::*;
    use crate::{Picture, Quality};
    use burgeon_base::stop::Stop;

    fn picture() -> Picture {
        let (azimuth, elevation) = (Some(150.0), Some(15.0));
        let quality = Quality::Draft;
        Picture { width: 96, height: 96, azimuth, elevation, ground: false, quality, ..Picture::default() }
    }

    /// Counts the pixels that differ from an empty render.
    fn count_seen(image: &burgeon_scene::image::Image) -> usize {
        let empty = render(&Scene::default(), &picture()).unwrap();
        image.pixels().iter().zip(empty.pixels()).filter(|(a, b)| a != b).count()
    }

    #[test]
    fn a_scene_within_its_own_extent_looks_as_it_does_alone() {
        let scene = samples::twisted_tower(12);
        let alone = count_seen(&render(&scene, &picture()).unwrap());
        let within = count_seen(
            &render_within(&scene, Some(&Extent::of(&scene).unwrap()), &picture(), &Stop::new()).unwrap(),
        );
        assert!(alone.abs_diff(within) * 50 < alone, "{alone} {within}");
    }

    #[test]
    fn what_is_larger_looks_larger_within_one_extent() {
        let (small, large) = (samples::twisted_tower(6), samples::twisted_tower(12));
        let mut extent = Extent::of(&small).unwrap();
        extent.join(&Extent::of(&large).unwrap());
        let [few, many] = [small, large].map(|scene| {
            count_seen(&render_within(&scene, Some(&extent), &picture(), &Stop::new()).unwrap())
        });
        assert!(few * 3 < many * 2 && few * 5 > many * 2, "{few} {many}");
    }

    #[test]
    fn an_empty_scene_has_a_picture_within_any_extent() {
        let empty = Scene::default();
        for extent in [Extent::default(), Extent::of(&samples::twisted_tower(2)).unwrap()] {
            render_within(&empty, Some(&extent), &picture(), &Stop::new()).unwrap();
        }
    }
}
