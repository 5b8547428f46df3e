//! Extent of scenes, so that several renders can share a camera.

use super::points::spread;
use super::stage::{Stage, sphere};
use burgeon_base::error::Result;
use burgeon_scene::Scene;
use glam::{DAffine3, DMat3, DVec3, Vec3A};

/// Number of directions for which the farthest point is stored. The camera's margin exceeds the error in between.
const DIRECTIONS: usize = 512;

/// Extent of one or more scenes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extent {
    /// Points of the scenes (m): the farthest in each of many directions.
    points: Vec<DVec3>,
}

impl Extent {
    /// Computes the extent of `scene`; empty if the scene shows nothing. Fails as [`render`](super::render) does.
    pub fn of(scene: &Scene) -> Result<Self> {
        let stage = Stage::new(scene)?;
        let back = stage.shrink.inverse();
        let hull: Vec<DVec3> = stage.hull.iter().map(|point| point.as_dvec3()).collect();
        let mut farthest: Vec<usize> = (0..DIRECTIONS)
            .filter_map(|i| {
                let direction = spread(i, DIRECTIONS);
                (0..hull.len()).max_by(|a, b| hull[*a].dot(direction).total_cmp(&hull[*b].dot(direction)))
            })
            .collect();
        farthest.sort_unstable();
        farthest.dedup();
        Ok(Self { points: farthest.into_iter().map(|i| back.transform_point3(hull[i])).collect() })
    }

    /// Extends the extent by `other`.
    pub fn join(&mut self, other: &Self) {
        self.points.extend_from_slice(&other.points);
    }

    /// Returns the centre and the radius (m) of a bounding sphere after the rotation `turn`.
    pub(super) fn sphere(&self, turn: DMat3) -> (DVec3, f64) {
        let (low, high) = super::points::bounds(self.points.iter().map(|point| turn * *point));
        sphere(low, high)
    }

    /// Returns the points of the extent, transformed by `shrink`.
    pub(super) fn points(&self, shrink: &DAffine3) -> Vec<Vec3A> {
        self.points.iter().map(|point| shrink.transform_point3(*point).as_vec3a()).collect()
    }
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
    fn seen(image: &burgeon_scene::image::Image) -> usize {
        let empty = render(&Scene::default(), &picture()).unwrap();
        image.pixels().iter().zip(empty.pixels()).filter(|(a, b)| a != b).count()
    }

    #[test]
    fn a_scene_within_its_own_extent_looks_as_it_does_alone() {
        let scene = samples::twisted_tower(12);
        let alone = seen(&render(&scene, &picture()).unwrap());
        let within = seen(
            &render_within(&scene, Some(&Extent::of(&scene).unwrap()), &picture(), &Stop::new()).unwrap(),
        );
        assert!(alone.abs_diff(within) * 50 < alone, "{alone} {within}");
    }

    #[test]
    fn what_is_larger_looks_larger_within_one_extent() {
        let (small, large) = (samples::twisted_tower(6), samples::twisted_tower(12));
        let mut extent = Extent::of(&small).unwrap();
        extent.join(&Extent::of(&large).unwrap());
        let [few, many] = [small, large]
            .map(|scene| seen(&render_within(&scene, Some(&extent), &picture(), &Stop::new()).unwrap()));
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
