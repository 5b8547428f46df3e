//! Small set of points that determine the extent of a model.

use super::extent::Extent;
use burgeon_scene::{Mesh, Scene};
use glam::{Affine3A, DAffine3, DMat3, DVec3, Mat3A, Vec3, Vec3A};
use rayon::prelude::*;
use std::borrow::Cow;

/// Number of cells along each side of the grid that reduces the number of points.
const CELLS: usize = 32;

/// Points that determine the extent of a scene.
pub(super) struct SceneOutlines<'a> {
    scene: &'a Scene,
    /// Points of each mesh: all of them if the mesh has few instances, otherwise the farthest in each of many directions.
    meshes: Vec<Vec<Cow<'a, [Vec3]>>>,
}

/// Position and size of a scene on its stage.
pub(super) struct StageFrame {
    /// Transform from the world to the stage.
    pub shrink: DAffine3,
    /// Minimum and maximum corner of the scene's bounding box on the stage.
    pub bounds: (Vec3A, Vec3A),
}

impl<'a> SceneOutlines<'a> {
    /// Finds the points of `scene`. Meshes that are not shown have none.
    pub(super) fn new(scene: &'a Scene) -> Self {
        let mut uses = vec![0_usize; scene.meshes.len()];
        for instance in &scene.instances {
            uses[instance.mesh] += 1;
        }
        let meshes = scene.meshes.par_iter().zip(uses).map(|(mesh, uses)| outline(mesh, uses)).collect();
        Self { scene, meshes }
    }

    /// Creates the outlines of `scene` without points.
    pub(super) fn empty(scene: &'a Scene) -> Self {
        Self { scene, meshes: vec![Vec::new(); scene.meshes.len()] }
    }

    /// Returns the frame of the scene's stage, relative to the centre and the radius of `extent`, if there is one, or to those
    /// of the points.
    pub(super) fn frame(&self, extent: Option<&Extent>) -> StageFrame {
        let turn = self.scene.upright.map_or(DMat3::IDENTITY, |upright| upright.rotation());
        let (low, high) = bounds(self.scene.instances.iter().flat_map(|instance| {
            let transform = DAffine3::from_mat3(turn) * instance.transform;
            self.points(instance.mesh).map(move |point| transform.transform_point3(point.as_dvec3()))
        }));
        let (center, radius) = extent.map_or_else(|| sphere(low, high), |extent| extent.sphere(turn));
        let shrink = DAffine3::from_mat3_translation(turn * (1.0 / radius), -center / radius);
        let place = |corner: DVec3| ((corner - center) / radius).as_vec3a();
        StageFrame { shrink, bounds: (place(low), place(high)) }
    }

    /// Returns the points of all instances, transformed by `shrink`. Points that are not finite are skipped.
    pub(super) fn stage_points(&self, shrink: DAffine3) -> impl Iterator<Item = Vec3A> {
        self.scene
            .instances
            .iter()
            .flat_map(move |instance| {
                let place = to_single(&(shrink * instance.transform));
                self.points(instance.mesh).map(move |point| place.transform_point3a(Vec3A::from(*point)))
            })
            .filter(|point| point.is_finite())
    }

    fn points(&self, mesh: usize) -> impl Iterator<Item = &Vec3> {
        self.meshes[mesh].iter().flat_map(|points| points.iter())
    }
}

/// Converts `place` to single precision.
pub(super) fn to_single(place: &DAffine3) -> Affine3A {
    let matrix = place.matrix3.as_mat3();
    Affine3A { matrix3: Mat3A::from(matrix), translation: place.translation.as_vec3a() }
}

fn outline(mesh: &Mesh, uses: usize) -> Vec<Cow<'_, [Vec3]>> {
    if uses == 0 {
        return Vec::new();
    }
    let seen = mesh.parts.iter().filter(|part| !part.triangles.is_empty());
    let parts: Vec<&[Vec3]> = seen.map(|part| part.positions.as_slice()).collect();
    if uses <= 8 || parts.iter().map(|part| part.len()).sum::<usize>() <= 32 {
        return parts.into_iter().map(Cow::Borrowed).collect();
    }
    let points: Vec<Vec3> = parts.into_iter().flatten().copied().filter(|point| point.is_finite()).collect();
    let mut farthest: Vec<usize> = (0..96)
        .filter_map(|i| {
            let direction = spread(i, 96).as_vec3();
            let reach = |point: &Vec3| point.dot(direction);
            (0..points.len()).max_by(|a, b| reach(&points[*a]).total_cmp(&reach(&points[*b])))
        })
        .collect();
    farthest.sort_unstable();
    farthest.dedup();
    vec![Cow::Owned(farthest.into_iter().map(|i| points[i]).collect())]
}

/// Returns direction `i` of `count` directions, evenly distributed over the sphere along a spiral.
pub(super) fn spread(i: usize, count: usize) -> DVec3 {
    let z = 1.0 - (2.0 * i as f64 + 1.0) / count as f64;
    let (sin, cos) = (i as f64 * 2.399_963_229_728_653).sin_cos();
    let r = (1.0 - z * z).sqrt();
    DVec3::new(r * cos, r * sin, z)
}

/// Returns the minimum and maximum corner of the bounding box of `points`; zero if there are no points.
pub(super) fn bounds(points: impl Iterator<Item = DVec3>) -> (DVec3, DVec3) {
    points
        .filter(|point| point.is_finite())
        .fold(None, |bounds: Option<(DVec3, DVec3)>, point| {
            Some(bounds.map_or((point, point), |(low, high)| (low.min(point), high.max(point))))
        })
        .unwrap_or_default()
}

/// Returns the centre and the radius of the sphere around the box from `low` to `high`.
pub(super) fn sphere(low: DVec3, high: DVec3) -> (DVec3, f64) {
    let half = (high - low).length() / 2.0;
    // A model without size, such as a point, is shown as if it had a radius of 1 m.
    ((low + high) / 2.0, if half > 1e-9 { half } else { 1.0 })
}

/// Returns a few thousand points whose convex hull contains `points`: the eight corners of the bounding boxes of the
/// points in each cell of a coarse grid over `bounds`. The bits of a corner's number tell on which axes it is high.
pub(super) fn hull(points: impl Iterator<Item = Vec3A>, bounds: (Vec3A, Vec3A)) -> Vec<Vec3A> {
    let none = (Vec3A::INFINITY, Vec3A::NEG_INFINITY);
    let mut cells = vec![none; CELLS * CELLS * CELLS];
    let last = CELLS as f32 - 1.0;
    let scale = CELLS as f32 / (bounds.1 - bounds.0).max(Vec3A::splat(1e-6));
    // Successive points are mostly in one cell. Iterating inside of the iterator is several times as fast, because it consists of
    // nested ones.
    let (mut current, mut cell) = (0, none);
    points.for_each(|point| {
        let at = ((point - bounds.0) * scale).clamp(Vec3A::ZERO, Vec3A::splat(last));
        let index = (at.z as usize * CELLS + at.y as usize) * CELLS + at.x as usize;
        if index != current {
            cells[current] = cell;
            (current, cell) = (index, cells[index]);
        }
        cell = (cell.0.min(point), cell.1.max(point));
    });
    cells[current] = cell;
    let boxes = cells.into_iter().filter(|cell| *cell != none);
    boxes.flat_map(|(low, high)| (0..8).map(move |corner| pick(corner, low, high))).collect()
}

/// Returns corner 0 to 7 of the box from `low` to `high`.
fn pick(corner: usize, low: Vec3A, high: Vec3A) -> Vec3A {
    let choose = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
    Vec3A::new(choose(0), choose(1), choose(2))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_reaches_as_far_as_the_points_in_every_direction() {
        let points: Vec<Vec3A> = (0..5000).map(|i| spread(i, 5000).as_vec3a()).collect();
        let hull = hull(points.iter().copied(), (Vec3A::NEG_ONE, Vec3A::ONE));
        for i in 0..50 {
            let direction = spread(i, 50).as_vec3a();
            let reach = |points: &[Vec3A]| points.iter().map(|p| p.dot(direction)).fold(f32::MIN, f32::max);
            assert!(reach(&hull) >= reach(&points));
            assert!(reach(&hull) < reach(&points) + 0.05);
        }
    }
}
