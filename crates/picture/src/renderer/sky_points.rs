//! Points that stand for the small triangles of a large scene in the maps of the sky.
//!
//! A map of the sky is coarse, so most triangles of a large scene cover none of its texels. Points on their surfaces, as
//! many as texels that they would cover, cast the same light and shade on average, in a fraction of the time.

use super::coverage::noise;
use super::light_map::LightProjection;
use super::stage::{ProjectedTriangle, Stage};
use glam::{Affine3A, Vec3A};
use rayon::prelude::*;

/// Number of triangles from which on points are faster.
const MANY: usize = 50_000;
/// Maximum area of a small triangle, relative to a texel. Points leave holes in larger ones.
const SMALL: f32 = 0.5;

/// Points and large triangles of a scene.
pub(super) struct SkyPoints {
    points: Vec<SurfaceSample>,
    /// Triangles that are drawn as they are.
    pub(super) triangles: Vec<ProjectedTriangle>,
    /// Side of the texels that the points are made for.
    texel: f32,
}

/// Point on a surface.
struct SurfaceSample {
    place: Vec3A,
    /// Unit normal.
    normal: Vec3A,
}

impl SkyPoints {
    /// Creates the points of a scene for maps with these projections; `None` if it has few triangles.
    pub(super) fn new(stage: &Stage, maps: &[LightProjection]) -> Option<Self> {
        let texel = maps.iter().map(|map| map.texel).fold(f32::INFINITY, f32::min);
        if stage.triangles() < MANY || !texel.is_finite() {
            return None;
        }
        let batches = stage.batches().into_par_iter().map(|numbers| {
            let (mut points, mut triangles) = (Vec::new(), Vec::new());
            stage.each_triangle(
                numbers,
                &Affine3A::IDENTITY,
                |point| point,
                None,
                |draw, triangle| {
                    let [a, b, c] = triangle.corners;
                    let cross = (b - a).cross(c - a);
                    let share = cross.length() * 0.5 / (texel * texel);
                    if share > SMALL || draw.opacity < 1.0 || draw.cutout.is_some() {
                        triangles.push(triangle);
                        return;
                    }
                    let Some(normal) = cross.try_normalize() else { return };
                    let count = (share + noise(triangle.number, 0, 11)) as u32;
                    points.extend((0..count).map(|i| {
                        let (u, v) = (noise(triangle.number, i, 12), noise(triangle.number, i, 13));
                        let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
                        SurfaceSample { place: a + (b - a) * u + (c - a) * v, normal }
                    }));
                },
            );
            (points, triangles)
        });
        let batches: Vec<(Vec<SurfaceSample>, Vec<ProjectedTriangle>)> = batches.collect();
        let (mut points, mut triangles) = (Vec::new(), Vec::new());
        for (some, others) in batches {
            points.extend(some);
            triangles.extend(others);
        }
        Some(Self { points, triangles, texel })
    }

    /// Calls `see` with the texel and the depth of the points that a map with this `frame` sees in the light of map
    /// `number` from `direction`. A point counts as often as its surface would cover a texel.
    pub(super) fn each(
        &self,
        frame: &LightProjection,
        number: usize,
        direction: Vec3A,
        mut see: impl FnMut(usize, f32),
    ) {
        let share = (self.texel / frame.texel).powi(2);
        for (index, SurfaceSample { place, normal }) in self.points.iter().enumerate() {
            if normal.dot(direction).abs() * share < noise(index as u32, number as u32, 14) {
                continue;
            }
            let at = frame.to_texels.transform_point3a(*place);
            let (x, y) = (at.x as usize, at.y as usize);
            if at.x >= 0.0 && at.y >= 0.0 && x < frame.width && y < frame.height {
                see(y * frame.width + x, at.z);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use burgeon_scene::{Material, Part};
    use glam::Vec3;

    #[test]
    fn points_cover_as_many_texels_as_their_surface() {
        // A square of 240 by 240 small squares of two triangles each, seen at an angle.
        let mut part = Part::default();
        for i in 0..240 * 240_u32 {
            let at = Vec3::new((i % 240) as f32, (i / 240) as f32, 0.0);
            samples::quad(&mut part, [at, at + Vec3::X, at + Vec3::X + Vec3::Y, at + Vec3::Y]);
        }
        let scene = samples::scene_of(part, Material::default());
        let stage = Stage::new(&scene).unwrap();
        for direction in [Vec3A::Z, Vec3A::new(0.6, 0.0, 0.8)] {
            let frame = LightProjection::fit(&stage.hull, direction, 60.0);
            let points = SkyPoints::new(&stage, std::slice::from_ref(&frame)).unwrap();
            assert!(points.triangles.is_empty());
            let mut count = 0;
            points.each(&frame, 3, direction, |_, _| count += 1);
            // The side of the square is the square root of 2 in units of the stage.
            let covered = 2.0 * direction.z / (frame.texel * frame.texel);
            assert!((count as f32 / covered - 1.0).abs() < 0.1, "{count} points for {covered} texels");
        }
        assert!(SkyPoints::new(&Stage::new(&samples::twisted_tower(3)).unwrap(), &[]).is_none());
    }
}
