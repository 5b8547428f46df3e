//! Measures the extent of a scene.

use super::extent::Extent;
use super::points::{SceneOutlines, StageFrame, hull, spread};
use super::stage::check;
use burgeon_base::error::Result;
use burgeon_scene::Scene;
use glam::{DMat3, DVec3, Vec3A};

/// Number of directions for which the farthest point is stored. The camera's margin exceeds the error in between.
const DIRECTIONS: usize = 512;

/// Length, relative to the radius of an extent, by which a scene inside it may exceed it. The camera's margin is larger.
const SLACK: f64 = 1e-3;

/// Maximum number of points of an extent that was joined from many.
const MOST: usize = 16 * DIRECTIONS;

impl Extent {
    /// Computes the extent of `scene`; empty if the scene shows nothing. Fails as [`render`](super::render) does.
    pub fn of(scene: &Scene) -> Result<Self> {
        check(scene)?;
        let outlines = SceneOutlines::new(scene);
        let StageFrame { shrink, bounds } = outlines.frame(None);
        let hull = hull(outlines.stage_points(shrink), bounds);
        let back = shrink.inverse();
        let farthest = farthest_corners(&hull).into_iter();
        Ok(Self::new(farthest.map(|i| back.transform_point3(hull[i].as_dvec3())).collect()))
    }

    /// Returns true if `other` does not reach farther than this extent in any direction, to within a thousandth of the
    /// radius.
    ///
    /// ```
    /// use burgeon_picture::Extent;
    ///
    /// assert!(Extent::default().contains(&Extent::default()));
    /// ```
    pub fn contains(&self, other: &Self) -> bool {
        if self.is_empty() || other.is_empty() {
            return other.is_empty();
        }
        let slack = SLACK * self.sphere(DMat3::IDENTITY).1;
        let reach = |points: &[DVec3], direction: DVec3| {
            points.iter().map(|point| point.dot(direction)).fold(f64::NEG_INFINITY, f64::max)
        };
        (0..DIRECTIONS)
            .map(|i| spread(i, DIRECTIONS))
            .all(|direction| reach(other.all(), direction) <= reach(self.all(), direction) + slack)
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

/// Returns the indices of the farthest of `corners` in each direction, in order. The corners are those of boxes along the
/// axes, eight for each in the order of [`hull`](super::points::hull), so that the direction tells which corner of a box is
/// the farthest.
fn farthest_corners(corners: &[Vec3A]) -> Vec<usize> {
    let boxes: Vec<[Vec3A; 2]> = corners.chunks_exact(8).map(|corners| [corners[0], corners[7]]).collect();
    let mut farthest: Vec<usize> = (0..DIRECTIONS)
        .filter_map(|i| {
            let direction = spread(i, DIRECTIONS).as_vec3a();
            let is_low = direction.cmplt(Vec3A::ZERO);
            let corner = !is_low.bitmask() as usize & 7;
            let mut best = None;
            for (number, [low, high]) in boxes.iter().enumerate() {
                let reach = Vec3A::select(is_low, *low, *high).dot(direction);
                if best.is_none_or(|(most, _)| reach > most) {
                    best = Some((reach, number));
                }
            }
            best.map(|(_, number)| number * 8 + corner)
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
    fn an_extent_contains_what_does_not_reach_farther() {
        let extent = |floors| Extent::of(&samples::twisted_tower(floors)).unwrap();
        let (small, large) = (extent(6), extent(12));
        assert!(large.contains(&small) && large.contains(&large) && !small.contains(&large));
        assert!(small.contains(&Extent::default()) && !Extent::default().contains(&small));
        let mut both = small.clone();
        both.join_outline(&large);
        assert!(both.contains(&small) && both.contains(&large));
    }

    #[test]
    fn the_extent_holds_all_points_of_the_scene() {
        let scene = samples::twisted_tower(9);
        let extent = Extent::of(&scene).unwrap();
        let reach = |points: &mut dyn Iterator<Item = DVec3>, toward: DVec3| {
            points.map(|point| point.dot(toward)).fold(f64::NEG_INFINITY, f64::max)
        };
        for i in 0..100 {
            let toward = spread(i, 100);
            let corners = scene.instances.iter().flat_map(|instance| {
                let parts = scene.meshes[instance.mesh].parts.iter();
                let points = parts.flat_map(|part| &part.positions);
                points.map(|point| instance.transform.transform_point3(point.as_dvec3()))
            });
            let (all, kept) =
                (reach(&mut corners.into_iter(), toward), reach(&mut extent.all().iter().copied(), toward));
            let radius = extent.sphere(DMat3::IDENTITY).1;
            assert!((all - kept).abs() < 0.02 * radius, "{all} {kept} towards {toward}");
        }
    }

    #[test]
    fn an_empty_scene_has_a_picture_within_any_extent() {
        let empty = Scene::default();
        for extent in [Extent::default(), Extent::of(&samples::twisted_tower(2)).unwrap()] {
            render_within(&empty, Some(&extent), &picture(), &Stop::new()).unwrap();
        }
    }
}
