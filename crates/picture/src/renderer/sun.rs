//! The sun: its direction, and the fraction of it that is visible from a point.

use super::coverage::Coverage;
use super::detail::RenderDetail;
use super::light_map::LightProjection;
use super::raster::RasterGrid;
use super::sky::SUN;
use super::stage::Stage;
use super::view::Viewpoint;
use crate::settings::SunPosition;
use glam::{Vec2, Vec3, Vec3A};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering};

/// Azimuth of the sun to the left of the viewer (degrees).
const ASIDE: f64 = 58.0;
/// Elevation of the sun above the horizon (degrees).
const HEIGHT: f64 = 43.0;
/// The same in radians.
const SUN_HEIGHT: f32 = 0.750_491_6;
/// Growth of the penumbra's radius per distance from the occluder. The real sun's is 0.005; a larger value looks like
/// thin haze.
const SOFTNESS: f32 = 0.018;
/// Maximum radius of the penumbra, in the stage's units.
const WIDEST: f32 = 0.02;

/// Radius of the penumbra (texels) at surfaces that share a pixel with many others.
const CROWDED: f32 = 2.0;

/// Sun with its depth map.
pub(super) struct Sun {
    /// Unit vector towards the sun.
    pub direction: Vec3A,
    /// Irradiance of a plane that faces the sun.
    pub light: Vec3,
    /// Brightness of the sky, relative to that under the sun of a studio.
    pub dusk: f32,
    frame: LightProjection,
    texels: TexelBlocks,
    depths: Vec<f32>,
    /// Offsets of the lookups for a full pixel, within the unit disc. Any consecutive part of them is distributed over
    /// the disc.
    disc: Vec<Vec2>,
    /// Set if points that share a pixel with two others need no search for the radius of the penumbra.
    pools_light: bool,
}

/// Order of the texels in memory: in squares, so that lookups around a point read few lines of the cache.
#[derive(Debug, Clone, Copy)]
struct TexelBlocks {
    /// Number of squares in a row, and of rows of squares.
    count: [usize; 2],
}

impl TexelBlocks {
    /// Side of a square (texels): 16 depths fill a line of the cache.
    const SIDE: usize = 4;

    fn new(frame: &LightProjection) -> Self {
        Self { count: [frame.width, frame.height].map(|side| side.div_ceil(Self::SIDE)) }
    }

    /// Returns the number of texels of all squares.
    fn texels(&self) -> usize {
        self.count[0] * self.count[1] * Self::SIDE * Self::SIDE
    }

    /// Returns the index of texel `x`, `y`.
    #[inline]
    fn place(&self, x: usize, y: usize) -> usize {
        let block = y / Self::SIDE * self.count[0] + x / Self::SIDE;
        (block * Self::SIDE + y % Self::SIDE) * Self::SIDE + x % Self::SIDE
    }
}

impl Sun {
    /// Places the sun at `position`, or behind the left shoulder of a viewer at `eye`, so that every render has a light and
    /// a dark side.
    pub(super) fn new(
        stage: &Stage,
        eye: Viewpoint,
        position: Option<SunPosition>,
        detail: &RenderDetail,
    ) -> Self {
        let place = match position {
            Some(SunPosition { azimuth, elevation }) => {
                Viewpoint { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() }
            }
            None => Viewpoint { azimuth: eye.azimuth + ASIDE.to_radians(), elevation: HEIGHT.to_radians() },
        };
        let direction = place.direction().as_vec3a();
        let frame = LightProjection::fit(&stage.hull, direction, detail.sun_side);
        let mut texels = Vec::new();
        let blocks = TexelBlocks::new(&frame);
        texels.resize_with(blocks.texels(), || AtomicU32::new(f32::INFINITY.to_bits()));
        let grid = RasterGrid { width: frame.width, rows: 0..frame.height, shifts: &[128.0] };
        stage.batches().into_par_iter().for_each(|numbers| {
            stage.each_caster(numbers, &frame.to_texels, |draw, triangle| {
                let coverage = Coverage::of(draw, &triangle, [4, 4], false);
                grid.cover(triangle.corners, |y, xs, z, growth| {
                    for (i, x) in xs.enumerate() {
                        // The bit patterns of non-negative floats have the same order as the floats.
                        let depth = (z + growth * i as f32).max(0.0).to_bits();
                        let texel = &texels[blocks.place(x, y)];
                        if depth < texel.load(Ordering::Relaxed) && coverage.covers(x, y, 128.0) {
                            texel.fetch_min(depth, Ordering::Relaxed);
                        }
                    }
                });
            });
        });
        let depths = texels.into_iter().map(|texel| f32::from_bits(texel.into_inner())).collect();
        let pools_light = detail.pools_light;
        let height = place.elevation as f32;
        let (light, dusk) = (sunlight(height), (height.sin() / SUN_HEIGHT.sin()).clamp(0.0, 1.0).powf(0.35));
        Self {
            direction,
            light,
            dusk,
            frame,
            texels: blocks,
            depths,
            disc: disc(detail.sun_taps),
            pools_light,
        }
    }

    /// Returns the depth of the lit surface at texel `x`, `y`; infinite if there is none.
    fn depth(&self, x: f32, y: f32) -> f32 {
        let inside = x >= 0.0 && y >= 0.0 && x < self.frame.width as f32 && y < self.frame.height as f32;
        if inside { self.depths[self.texels.place(x as usize, y as usize)] } else { f32::INFINITY }
    }

    /// Returns true if the sun reaches `point`, which is not on a surface, according to a single lookup.
    pub(super) fn reaches(&self, point: Vec3A) -> bool {
        let at = self.frame.to_texels.transform_point3a(point);
        self.depth(at.x, at.y) > at.z - 2.0 * self.frame.texel
    }

    /// Returns the fraction of the sun, 0 to 1, visible from `point` on a surface with the unit normal `normal` towards
    /// the sun.
    ///
    /// `spin` is a unit vector that rotates the pattern of lookups; vary it from pixel to pixel. `share` is the index of the point
    /// among those that share a pixel, and their number; each point then gets fewer lookups. Method: percentage-closer
    /// soft shadows (Fernando, 2005). Each lookup is compared with the surface's own plane, so that a wide pattern does
    /// not shade the surface.
    pub(super) fn visibility(&self, point: Vec3A, normal: Vec3A, spin: Vec2, share: (usize, usize)) -> f32 {
        let (place, share) = share;
        let texel = self.frame.texel;
        let lifted = point + normal * (1.5 * texel);
        let at = self.frame.to_texels.transform_point3a(lifted);
        let tilt = self.frame.to_texels.matrix3 * normal;
        let facing = (tilt.z).min(-0.08);
        // Rows of the matrix are scaled by 1 / texel, so the slope per texel is multiplied by texel twice.
        let slope = [-tilt.x * texel * texel / facing, -tilt.y * texel * texel / facing];
        let steepest = 6.0 * texel;
        let slope = slope.map(|s| s.clamp(-steepest, steepest));
        let widest = WIDEST / texel;
        let compare = |offset: Vec2| {
            let expected = at.z + slope[0] * offset.x + slope[1] * offset.y - 0.6 * texel;
            let found = self.depth(at.x + offset.x, at.y + offset.y);
            (found < expected).then_some(expected - found)
        };

        if self.pools_light && share > 2 {
            // The mean of the pixel's points is as smooth as a wide penumbra, and the width is not visible among them.
            let taps = (self.disc.len() / share).max(4);
            let offsets = self.disc.iter().cycle().skip(taps * place).take(taps);
            let lit = offsets.filter(|offset| compare(spin.rotate(**offset) * CROWDED).is_none()).count();
            return lit as f32 / taps as f32;
        }
        let searches = (self.disc.len() / 2 / share).max(4);
        let (mut blocked, mut distance) = (0.0_f32, 0.0_f32);
        for offset in self.disc.iter().cycle().skip(7 * place).take(searches) {
            if let Some(gap) = compare(spin.rotate(*offset) * widest) {
                blocked += 1.0;
                distance += gap;
            }
        }
        if blocked < 0.5 {
            return 1.0;
        }
        let radius = (SOFTNESS * distance / blocked / texel).clamp(1.3, widest);
        let taps = (self.disc.len() / share).max(6);
        let offsets = self.disc.iter().cycle().skip(taps * place).take(taps);
        let lit = offsets.filter(|offset| compare(spin.rotate(**offset) * radius).is_none()).count();
        lit as f32 / taps as f32
    }
}

/// Returns the irradiance of a plane that faces the sun at this elevation (rad): less and redder near the horizon, where its
/// light passes through more air.
fn sunlight(elevation: f32) -> Vec3 {
    let air = |elevation: f32| 1.0 / elevation.sin().max(0.03);
    let more = (air(elevation) - air(SUN_HEIGHT)).clamp(-0.5, 12.0);
    SUN * Vec3::new(-0.06, -0.11, -0.21).map(|absorbed| (absorbed * more).exp())
}

/// Returns points distributed evenly over the unit disc; so is any consecutive part of them.
fn disc(count: usize) -> Vec<Vec2> {
    let fraction = |i: usize, factor: f64| (0.5 + factor * i as f64).fract() as f32;
    (0..count)
        .map(|i| {
            let turn = fraction(i, 0.569_840_290_998_053_2) * std::f32::consts::TAU;
            Vec2::from_angle(turn) * fraction(i, 0.754_877_666_246_692_7).sqrt()
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;
    use crate::Quality;
    use glam::DVec3;

    #[test]
    fn a_point_behind_a_box_is_in_its_shadow_and_the_lit_face_is_not() {
        let scene = samples::boxes(&[DVec3::ZERO]);
        let stage = Stage::new(&scene).unwrap();
        let sun = Sun::new(
            &stage,
            Viewpoint { azimuth: 0.0, elevation: 0.3 },
            None,
            &RenderDetail::of(Quality::Draft, 12),
        );
        let behind = stage.bounds.0.with_x(0.0).with_y(0.0) - sun.direction.with_z(0.0) * 0.7;
        assert!(sun.visibility(behind, Vec3A::Z, Vec2::X, (0, 1)) < 0.01);
        let top = stage.bounds.1.z;
        for i in 0..100 {
            let point = Vec3A::new((i % 10) as f32 * 0.1 - 0.45, (i / 10) as f32 * 0.1 - 0.45, top);
            assert!(
                sun.visibility(point, Vec3A::Z, Vec2::from_angle(i as f32), (0, 1)) > 0.99,
                "acne at {point}"
            );
        }
    }

    #[test]
    fn each_texel_of_the_map_has_its_own_place() {
        let hull = [Vec3A::ZERO, Vec3A::new(1.0, 0.3, 0.1)];
        let frame = LightProjection { width: 9, height: 6, ..LightProjection::fit(&hull, Vec3A::Z, 8.0) };
        let blocks = TexelBlocks::new(&frame);
        let mut places: Vec<usize> =
            (0..54).map(|i| blocks.place(i % frame.width, i / frame.width)).collect();
        places.sort_unstable();
        places.dedup();
        assert!(places.len() == 54 && places.iter().all(|place| *place < blocks.texels()), "{places:?}");
    }

    #[test]
    fn a_low_sun_is_redder_and_the_light_of_the_studio_is_unchanged() {
        let (high, low) = (sunlight(HEIGHT.to_radians() as f32), sunlight(0.1));
        assert!((high - SUN).length() < 1e-4, "{high}");
        assert!(low.x < high.x && low.z / low.x < 0.5 * high.z / high.x, "{low}");
    }
}
