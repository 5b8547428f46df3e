//! Integer arrays (`KHR_mesh_quantization`): positions of 16 bits, normals of 8 bits, and texture coordinates of 16 bits.
//!
//! The positions of a mesh are multiples of a step from a corner of its bounding box on. The transforms of its instances
//! include the step and the corner, so no node is added. The step is the same for all axes, which keeps normals.
//! Texture coordinates are fractions of the range that a material uses; `KHR_texture_transform` restores the range.

use super::super::check::{PartExtent, SceneCheck, triangles};
use super::coordinates::{TexCoordMap, TexCoordRange, tex_coord, y_up};
use burgeon_scene::Part;
use glam::{DAffine3, DVec3, Vec2, Vec3};
use rayon::prelude::*;

/// Extension that moves and scales texture coordinates.
pub(super) const TEXTURE_TRANSFORM: &str = "KHR_texture_transform";

/// Largest integer of a position and of a texture coordinate.
const MOST: f64 = 65_535.0;

/// Largest range of texture coordinates that are integers (repetitions of the image). A step is at most 1/1,024 of the image.
const REPETITIONS: f64 = 63.0;

/// Grid of the positions of a mesh, in glTF's coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PositionGrid {
    /// Corner of the bounding box (m) with the smallest coordinates.
    origin: DVec3,
    /// Distance (m) between neighbours.
    step: f64,
}

/// Type of integers that replace an array of single-precision numbers.
#[derive(Debug, Clone, Copy)]
pub(super) enum IntegerArray {
    /// Positions as four u16; the last is padding.
    Positions(PositionGrid),
    /// Unit vectors as four i8, multiples of 1/127; the last is padding.
    Normals,
    /// Texture coordinates from 0 to 1 as two u16, multiples of 1/65535.
    TexCoords,
}

impl PositionGrid {
    /// Returns the grid of a mesh, whose parts have these extents, z up.
    pub(super) fn of(parts: &[PartExtent]) -> Self {
        let shown = parts.iter().filter(|part| part.triangles > 0);
        let corners = shown.flat_map(|part| [y_up(part.low), y_up(part.high)]);
        let bounds = corners.fold(None, |bounds: Option<(Vec3, Vec3)>, at| {
            Some(bounds.map_or((at, at), |(low, high)| (low.min(at), high.max(at))))
        });
        let (low, high) = bounds.unwrap_or_default();
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let size = (high - low).max_element();
        Self { origin: low, step: if size > 0.0 { size / MOST } else { 1.0 } }
    }

    /// Returns the integers of a point (m).
    pub(super) fn place(&self, at: Vec3) -> [u16; 3] {
        #[allow(clippy::cast_sign_loss, reason = "bounded before")]
        let whole = |number: f64| number.round().clamp(0.0, MOST) as u16;
        ((at.as_dvec3() - self.origin) / self.step).to_array().map(whole)
    }

    /// Returns the transform from integers to metres.
    pub(super) fn transform(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(DVec3::splat(self.step), glam::DQuat::IDENTITY, self.origin)
    }

    /// Returns the largest distance of integers from zero, in steps.
    pub(super) fn reach() -> f64 {
        MOST * 3.0_f64.sqrt()
    }
}

/// Returns the largest error (m) along an axis of positions to which `transform` maps integers.
pub(super) fn rounding(transform: &DAffine3) -> f64 {
    let columns = transform.matrix3;
    0.5 * columns.x_axis.length().max(columns.y_axis.length()).max(columns.z_axis.length())
}

impl IntegerArray {
    /// Returns the size of an item (bytes).
    pub(super) fn stride(self) -> usize {
        match self {
            Self::Positions(_) => 8,
            Self::Normals | Self::TexCoords => 4,
        }
    }

    /// Appends the integers of single-precision numbers in `bytes`.
    pub(super) fn put(self, bytes: &[u8], out: &mut Vec<u8>) {
        let floats: Vec<f32> = bytes.as_chunks().0.iter().map(|number| f32::from_le_bytes(*number)).collect();
        out.reserve(floats.len() / 2 * self.stride());
        match self {
            Self::Positions(grid) => floats.as_chunks::<3>().0.iter().for_each(|at| {
                let [x, y, z] = grid.place(Vec3::from(*at));
                out.extend_from_slice(bytemuck::bytes_of(&[x, y, z, 0]));
            }),
            #[allow(clippy::cast_possible_truncation, reason = "bounded before")]
            Self::Normals => floats.as_chunks::<3>().0.iter().for_each(|normal| {
                let [x, y, z] = normal.map(|it| (it * 127.0).round() as i8);
                out.extend_from_slice(bytemuck::bytes_of(&[x, y, z, 0]));
            }),
            Self::TexCoords => floats.as_chunks::<2>().0.iter().for_each(|uv| {
                out.extend_from_slice(bytemuck::bytes_of(&uv.map(integer)));
            }),
        }
    }
}

/// Converts a texture coordinate from 0 to 1 to a multiple of 1/65535.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "bounded before")]
fn integer(coordinate: f32) -> u16 {
    (f64::from(coordinate) * MOST).round().clamp(0.0, MOST) as u16
}

/// Returns the nearest multiple of 1/65535 to a texture coordinate from 0 to 1.
pub(super) fn round_to_step(coordinate: f32) -> f32 {
    (f64::from(integer(coordinate)) / MOST) as f32
}

/// Ranges of the texture coordinates of the materials of a scene, of the first and of the second set. A range is `None` without
/// an image, and if it is too large for integers.
#[derive(Debug, Default)]
pub(super) struct TexCoordRanges {
    first: Vec<Option<TexCoordRange>>,
    /// Empty if no material has a dirt map.
    second: Vec<Option<TexCoordRange>>,
}

impl TexCoordRanges {
    /// Measures the ranges of a scene.
    pub(super) fn measure(checked: &SceneCheck<'_>) -> Self {
        let materials = &checked.scene.materials;
        let size = |part: &Part| materials[part.material].image_size();
        let first = ranges(checked, size, |part, vertex| part.uvs[vertex]);
        let size = |part: &Part| materials[part.material].dirt_map.as_ref().map(|dirt| dirt.image.size);
        let has_second = materials.iter().any(|material| material.dirt_map.is_some());
        let second = if has_second { ranges(checked, size, Part::second_uv) } else { Vec::new() };
        Self { first, second }
    }

    /// Returns the ranges of both sets of a material.
    pub(super) fn of(&self, material: usize) -> [Option<TexCoordRange>; 2] {
        [&self.first, &self.second].map(|ranges| ranges.get(material).copied().flatten())
    }
}

/// Returns the range of the coordinates `uv` of each material, whose image has this `size` (m).
fn ranges(
    checked: &SceneCheck<'_>,
    size: impl Fn(&Part) -> Option<[f64; 2]> + Sync,
    uv: impl Fn(&Part, usize) -> Vec2 + Sync,
) -> Vec<Option<TexCoordRange>> {
    let scene = checked.scene;
    let parts = scene.meshes.par_iter().zip(&checked.parts).flat_map_iter(|(mesh, extents)| {
        mesh.parts.iter().zip(extents).filter(|(_, extent)| extent.triangles > 0).map(|(part, _)| part)
    });
    let measured: Vec<(usize, [[f32; 2]; 2])> = parts
        .filter_map(|part| {
            let size = size(part)?;
            let used = triangles(part).flatten().map(|corner| tex_coord(uv(part, corner as usize), size));
            let bounds = used.fold([[f32::INFINITY; 2], [f32::NEG_INFINITY; 2]], |[low, high], uv| {
                [[low[0].min(uv[0]), low[1].min(uv[1])], [high[0].max(uv[0]), high[1].max(uv[1])]]
            });
            Some((part.material, bounds))
        })
        .collect();
    let mut bounds: Vec<Option<[[f32; 2]; 2]>> = vec![None; scene.materials.len()];
    for (material, [low, high]) in measured {
        let [least, most] = bounds[material].unwrap_or([low, high]);
        let lower = [low[0].min(least[0]), low[1].min(least[1])];
        bounds[material] = Some([lower, [high[0].max(most[0]), high[1].max(most[1])]]);
    }
    bounds.into_iter().map(|bounds| TexCoordRange::of(bounds?, REPETITIONS)).collect()
}

/// Uses integers for the texture coordinates of a mesh if all of its materials allow them.
pub(super) fn round_together<'a>(maps: impl Iterator<Item = &'a mut TexCoordMap>) {
    let mut maps: Vec<&mut TexCoordMap> = maps.collect();
    let is_whole = maps.iter().all(|map| map.range.is_some());
    maps.iter_mut().for_each(|map| map.is_rounded = is_whole);
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn extent(low: Vec3, high: Vec3) -> PartExtent {
        PartExtent { triangles: 1, low, high }
    }

    proptest! {
        #[test]
        fn a_quantised_point_is_off_by_half_a_step_at_most(
            low in prop::array::uniform3(-4000.0_f32..4000.0), size in prop::array::uniform3(0.0_f32..500.0),
            part in prop::array::uniform3(0.0_f32..1.0),
        ) {
            let (low, size) = (Vec3::from(low), Vec3::from(size));
            let point = (low + Vec3::from(part) * size).min(low + size);
            let grid = PositionGrid::of(&[extent(low, low + size)]);
            let read = grid.transform().transform_point3(DVec3::from(grid.place(y_up(point)).map(f64::from)));
            let step = (low + size - low).as_dvec3().max_element() / 65_535.0;
            let off = (read - y_up(point).as_dvec3()).abs().max_element();
            prop_assert!(off <= 0.5 * step * 1.0001 + 1e-9, "{off} of {step}");
            prop_assert!((rounding(&grid.transform()) - 0.5 * grid.step).abs() < 1e-12);
        }

        #[test]
        fn a_quantised_texture_coordinate_is_off_by_half_a_step_at_most(
            low in -100.0_f32..100.0, size in 0.01_f32..63.0, part in 0.0_f32..1.0,
        ) {
            let high = low + size;
            let range = TexCoordRange::of([[low; 2], [high; 2]], 64.0).unwrap();
            let meant = (low + size * part).min(high);
            let stored = round_to_step(range.fraction([meant; 2])[0]);
            let read = f64::from(range.offset[0]) + f64::from(range.scale[0]) * f64::from(stored);
            let step = f64::from(range.scale[0]) / 65_535.0;
            prop_assert!((read - f64::from(meant)).abs() <= 0.5 * step + 2e-5, "{read} {meant}");
        }
    }

    #[test]
    fn coordinates_within_the_image_need_no_transform_and_large_ranges_stay_exact() {
        let range = TexCoordRange::of([[0.25, 0.0], [1.0, 0.5]], 64.0).unwrap();
        assert!(range.is_identity());
        assert!(!TexCoordRange::of([[0.25, 0.0], [1.5, 0.5]], 64.0).unwrap().is_identity());
        assert_eq!(TexCoordRange::of([[0.0, 0.0], [65.0, 0.5]], 64.0), None);
    }

    #[test]
    fn a_mesh_without_extent_has_a_grid() {
        let grid = PositionGrid::of(&[extent(Vec3::ONE, Vec3::ONE)]);
        assert_eq!(grid.place(y_up(Vec3::ONE)), [0, 0, 0]);
        assert_eq!(PositionGrid::of(&[]).step, 1.0);
    }
}
