//! Rays from mirrors to the model.

use super::super::stage::{DrawCall, Stage};
use super::ray_tree::{RayBox, RayTree};
use burgeon_scene::Part;
use glam::{Affine3A, Vec2, Vec3A};
use rayon::prelude::*;
use std::collections::HashMap;

/// Maximum number of different triangles. Trees of more take longer than the picture.
const MOST: usize = 500_000;
/// Minimum opacity of a surface, or of a pixel of its texture, that is mirrored.
const OPAQUE: f32 = 0.5;

/// Model as rays meet it.
pub(in super::super) struct Tracer<'a> {
    stage: &'a Stage<'a>,
    /// Triangles of each part, in its coordinates.
    parts: Vec<RayTree>,
    /// Index of the part of each draw, and the transform to its coordinates.
    draws: Vec<(usize, Affine3A)>,
    /// Boxes of the draws.
    tree: RayTree,
}

/// Point of the model that a ray meets.
pub(in super::super) struct MirroredPoint<'a> {
    /// Draw of the triangle.
    pub draw: &'a DrawCall<'a>,
    /// Position on the stage.
    pub position: Vec3A,
    /// Unit normal for shading, towards the mirror.
    pub normal: Vec3A,
    /// Texture coordinates (m).
    pub uv: Vec2,
    /// Second texture coordinates (m).
    pub second_uv: Vec2,
    /// Distance from the mirror, in the stage's units.
    pub distance: f32,
}

impl<'a> Tracer<'a> {
    /// Prepares `stage`; `None` if it has too many triangles, or if the work is cancelled.
    pub(in super::super) fn new(stage: &'a Stage<'a>) -> Option<Self> {
        let mut known: HashMap<*const Part, usize> = HashMap::new();
        let mut parts: Vec<&Part> = Vec::new();
        let number = |draw: &DrawCall<'a>| {
            *known.entry(std::ptr::from_ref(draw.part)).or_insert_with(|| {
                parts.push(draw.part);
                parts.len() - 1
            })
        };
        let numbers: Vec<usize> = stage.draws.iter().map(number).collect();
        if parts.iter().map(|part| part.triangles.len()).sum::<usize>() > MOST {
            return None;
        }
        let tree = |part: &&Part| {
            let boxes = part.triangles.iter().map(|corners| {
                let [a, b, c] = corners.map(|corner| Vec3A::from(part.positions[corner as usize]));
                if (a + b + c).is_finite() { [a.min(b).min(c), a.max(b).max(c)] } else { [Vec3A::NAN; 2] }
            });
            match stage.stop.is_stopped() {
                true => RayTree::new(&[]),
                false => RayTree::new(&boxes.collect::<Vec<_>>()),
            }
        };
        let parts: Vec<RayTree> = parts.par_iter().map(tree).collect();
        let boxes: Vec<RayBox> = stage
            .draws
            .iter()
            .zip(&numbers)
            .map(|(draw, number)| placed(parts[*number].corners(), &draw.place))
            .collect();
        let back = |(draw, number): (&DrawCall<'a>, usize)| (number, draw.place.inverse());
        let draws = stage.draws.iter().zip(numbers).map(back).collect();
        (!stage.stop.is_stopped()).then(|| Self { stage, parts, draws, tree: RayTree::new(&boxes) })
    }

    /// Returns the nearest point that a ray from `origin` in the unit `direction` meets. Backs of one-sided faces, and what is
    /// more transparent than opaque, let it through.
    pub(in super::super) fn meet(&self, origin: Vec3A, direction: Vec3A) -> Option<MirroredPoint<'_>> {
        let mut nearest = f32::INFINITY;
        let mut best: Option<(usize, u32, Vec2)> = None;
        self.tree.each(origin, direction, &mut nearest, |item, nearest| {
            let number = item as usize;
            let (part, back) = self.draws[number];
            let draw = &self.stage.draws[number];
            if draw.opacity < OPAQUE {
                return;
            }
            let (from, along) = (back.transform_point3a(origin), back.transform_vector3a(direction));
            self.parts[part].each(from, along, nearest, |index, nearest| {
                if let Some((distance, weights)) = meet_triangle(draw, index as usize, from, along)
                    && distance < *nearest
                {
                    *nearest = distance;
                    best = Some((number, index, weights));
                }
            });
        });
        let (number, index, weights) = best?;
        let draw = &self.stage.draws[number];
        let corners = draw.part.triangles.get(index as usize)?.map(|corner| corner as usize);
        let mix = [1.0 - weights.x - weights.y, weights.x, weights.y];
        let normals = corners.map(|i| draw.part.normals.get(i).map_or(Vec3A::ZERO, |it| it.vector().into()));
        let local: Vec3A = normals.iter().zip(mix).map(|(normal, part)| *normal * part).sum();
        let normal = (draw.turn * local).normalize_or(-direction);
        Some(MirroredPoint {
            draw,
            position: origin + direction * nearest,
            normal: if normal.dot(direction) > 0.0 { -normal } else { normal },
            uv: uv(draw, corners, weights),
            second_uv: mix_uvs(corners.map(|corner| draw.part.second_uv(corner)), weights),
            distance: nearest,
        })
    }
}

/// Returns the distance at which a ray meets triangle `index` of `draw`, and the weights of its second and third corner.
///
/// Method: Moller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
fn meet_triangle(draw: &DrawCall<'_>, index: usize, from: Vec3A, along: Vec3A) -> Option<(f32, Vec2)> {
    let numbers = draw.part.triangles.get(index)?.map(|corner| corner as usize);
    let [a, b, c] = numbers.map(|corner| Vec3A::from(draw.part.positions[corner]));
    let (ab, ac) = (b - a, c - a);
    let across = along.cross(ac);
    let size = ab.dot(across);
    // Positive in front of the face, in the coordinates of the part.
    if size == 0.0 || (size < 0.0 && !draw.double_sided) {
        return None;
    }
    let offset = from - a;
    let u = offset.dot(across) / size;
    let other = offset.cross(ab);
    let v = along.dot(other) / size;
    let distance = ac.dot(other) / size;
    if !(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0) {
        return None;
    }
    let weights = Vec2::new(u, v);
    let is_hole = draw.cutout.is_some_and(|texture| texture.alpha(uv(draw, numbers, weights), 0) < OPAQUE);
    (!is_hole).then_some((distance, weights))
}

/// Returns the texture coordinates (m) at these weights of the second and third of the triangle's `corners`.
fn uv(draw: &DrawCall<'_>, corners: [usize; 3], weights: Vec2) -> Vec2 {
    mix_uvs(corners.map(|corner| draw.part.uvs.get(corner).copied().unwrap_or_default()), weights)
}

/// Returns the texture coordinates at these weights of the second and third corner of a triangle.
fn mix_uvs([a, b, c]: [Vec2; 3], weights: Vec2) -> Vec2 {
    a + (b - a) * weights.x + (c - a) * weights.y
}

/// Returns the box around a box after the transform `place`.
fn placed([low, high]: RayBox, place: &Affine3A) -> RayBox {
    let (center, half) = ((low + high) * 0.5, (high - low) * 0.5);
    let center = place.transform_point3a(center);
    let matrix = place.matrix3;
    let half = matrix.x_axis.abs() * half.x + matrix.y_axis.abs() * half.y + matrix.z_axis.abs() * half.z;
    // Rounding may not make a box smaller than its content.
    let half = half * 1.0001 + 1e-6;
    [center - half, center + half]
}

#[cfg(test)]
mod tests {
    use super::super::super::samples;
    use super::*;
    use glam::{DAffine3, DVec3};

    #[test]
    fn a_ray_meets_the_nearest_front_face_of_any_instance_also_a_mirrored_one() {
        let mut scene = samples::boxes(&[DVec3::ZERO, DVec3::new(8.0, 0.0, 0.0)]);
        scene.instances[1].transform = DAffine3::from_translation(DVec3::new(8.0, 0.0, 0.0))
            * DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let stage = Stage::new(&scene).unwrap();
        let tracer = Tracer::new(&stage).unwrap();
        let at = |x: f64| stage.shrink.transform_point3(DVec3::new(x, 0.1, 0.2)).as_vec3a();
        for (from, direction, x) in [(-9.0, 1.0, -1.0), (4.0, 1.0, 7.0), (4.0, -1.0, 1.0), (19.0, -1.0, 9.0)]
        {
            let met = tracer.meet(at(from), Vec3A::X * direction).unwrap();
            assert!(met.position.distance(at(x)) < 1e-4, "from {from}: {}", met.position);
            assert!((met.normal.x + direction).abs() < 1e-3 && met.distance > 0.0);
        }
        assert!(
            tracer.meet(at(0.0), Vec3A::X).unwrap().position.distance(at(7.0)) < 1e-4,
            "backs let it through"
        );
        assert!(tracer.meet(at(4.0), Vec3A::Z).is_none());
    }
}
