//! Light from all directions: the sky above, the sunlit ground below, and the part of both that reaches a point.
//!
//! Depth maps are drawn from directions distributed over the sphere. A point receives the light of a direction if it is
//! not behind the surface in the map. The sum over the maps is the light with its soft shadows.

use super::coverage::Coverage;
use super::detail::RenderDetail;
use super::light_map::LightProjection;
use super::raster::RasterGrid;
use super::sky_points::SkyPoints;
use super::stage::{DrawCall, ProjectedTriangle, Stage};
use super::sun::Sun;
use crate::settings::Background;
use glam::{Vec2, Vec3, Vec3A};
use rayon::prelude::*;
use std::sync::LazyLock;

/// Irradiance of a plane that faces the sun.
pub(super) const SUN: Vec3 = Vec3::new(2.90, 2.74, 2.48);
/// Radiance of the sky at the zenith.
const ZENITH: Vec3 = Vec3::new(0.31, 0.36, 0.45);
/// Radiance of the sky just above the horizon.
const HORIZON: Vec3 = Vec3::new(0.45, 0.47, 0.49);
/// Fraction of light that the ground reflects.
const GROUND: Vec3 = Vec3::new(0.46, 0.44, 0.41);
/// Slope below the horizon at which haze hides a third of the ground.
const GROUND_HAZE: f32 = 0.025;
/// Colour of the floor of a light studio.
const STUDIO: Vec3 = Vec3::new(0.775, 0.765, 0.740);
/// Largest distance in a map, whose texels are integers.
const FARTHEST: f32 = 65_000.0;
/// Approximate half angle (rad) between neighbouring directions.
const SPREAD: f32 = 0.165;
/// Fraction of directions that point below the horizon.
const BELOW: f32 = 0.26;

/// Sky with its maps.
pub(super) struct Sky {
    /// Maps, one for each direction.
    pub maps: Vec<SkySample>,
    /// Distance to lift a point off its surface before a lookup, in the stage's units.
    pub lift: f32,
    /// Unshadowed irradiance of planes that face along +x, -x, +y, -y, +z, -z.
    open: [Vec3; 6],
    sun: Vec3A,
    /// Irradiance of a plane that faces the sun.
    sunlight: Vec3,
    dusk: f32,
    /// Set if the sky is the background, so that smooth surfaces mirror it.
    is_shown: bool,
    /// Set if the background is a light studio, whose floor smooth surfaces mirror.
    is_studio: bool,
}

/// Light and depth map of one direction.
pub(super) struct SkySample {
    /// Unit vector towards the light.
    pub direction: Vec3A,
    /// Radiance times the solid angle that the direction represents.
    pub light: Vec3A,
    /// Offset of lookups in the unit disc, rotated from pixel to pixel.
    jitter: Vec2,
    /// Tolerance against self-shadowing, in units of depth.
    bias: f32,
    /// Horizontal distance of lookups (texels) per unit of depth.
    spread: f32,
    frame: LightProjection,
    /// Width and height (texels).
    size: Vec2,
    depths: Vec<u16>,
}

impl Sky {
    /// Draws the maps.
    pub(super) fn new(stage: &Stage, sun: &Sun, detail: &RenderDetail, ground: bool) -> Self {
        let count = detail.sky_maps;
        // Without a ground, the light from below is weak and uniform, as in a white studio.
        let below = if ground {
            GROUND * (sun.light * sun.direction.z + Vec3::splat(1.1 * sun.dusk)) / std::f32::consts::PI
        } else {
            HORIZON * sun.dusk
        };
        let light = |direction: Vec3A| {
            if direction.z > 0.0 { sky_light(direction, sun.direction) * sun.dusk } else { below }
        };
        let fit = |i: usize| LightProjection::fit(&stage.hull, direction(i, count).0, detail.sky_side);
        let frames: Vec<LightProjection> = (0..count).into_par_iter().map(fit).collect();
        let points = detail.sky_points.then(|| SkyPoints::new(stage, &frames)).flatten();
        stage.stop.progress().begin("light of the sky", "maps", count);
        let maps: Vec<SkySample> = frames
            .into_par_iter()
            .enumerate()
            .map(|(i, frame)| {
                let (direction, angle) = direction(i, count);
                let jitter =
                    Vec2::from_angle(i as f32 * 2.399_963) * (i as f32 * 0.754_877_7 + 0.5).fract().sqrt();
                let light = (light(direction) * angle).into();
                let mut map = SkySample::new(frame, direction, jitter, light);
                match &points {
                    Some(points) => map.draw_points(stage, points, i),
                    None => map.draw(stage),
                }
                stage.stop.progress().add(1);
                map
            })
            .collect();
        let lift = maps.iter().map(|map| map.frame.texel).fold(0.0, f32::max) * 1.6;
        let open = [Vec3A::X, Vec3A::NEG_X, Vec3A::Y, Vec3A::NEG_Y, Vec3A::Z, Vec3A::NEG_Z].map(|normal| {
            (0..4096)
                .map(|i| direction(i, 4096))
                .map(|(toward, angle)| light(toward) * angle * toward.dot(normal).max(0.0))
                .sum()
        });
        let (sunlight, dusk) = (sun.light, sun.dusk);
        Self { maps, lift, open, sun: sun.direction, sunlight, dusk, is_shown: false, is_studio: false }
    }

    /// Lets smooth surfaces mirror this background.
    pub(super) fn surround(&mut self, background: Background) {
        self.is_shown = background == Background::Sky;
        self.is_studio = background == Background::Light;
    }

    /// Returns the unshadowed irradiance of a plane with unit `normal`, interpolated from the six axis directions.
    ///
    /// Method: McTaggart, "Half-Life 2 / Valve source shading", 2004 (the ambient cube).
    pub(super) fn open(&self, normal: Vec3A) -> Vec3 {
        let side =
            |axis: usize| self.open[2 * axis + usize::from(normal[axis] < 0.0)] * normal[axis] * normal[axis];
        side(0) + side(1) + side(2)
    }

    /// Returns the fraction of the sky's light, 0 to 1, that reaches level ground at `point`.
    pub(super) fn openness(&self, point: Vec3A) -> f32 {
        let above = self.maps.iter().filter(|map| map.direction.z > 0.0);
        let (seen, all) = above.fold((0.0, 0.0), |(seen, all), map| {
            let light = map.light.element_sum() * map.direction.z;
            (if map.reaches(point, Vec2::X) { seen + light } else { seen }, all + light)
        });
        seen / f32::max(all, 1e-6)
    }

    /// Returns the radiance of the open ground.
    fn ground(&self) -> Vec3 {
        GROUND * (self.sunlight * self.sun.z + Vec3::splat(1.1 * self.dusk)) / std::f32::consts::PI
    }

    /// Returns the colour of the visible sky, and of the ground below the horizon, in a unit `direction`. Air lightens both
    /// near the horizon, and redder if the sun is low.
    pub(super) fn visible(&self, direction: Vec3A) -> Vec3 {
        let warm = self.sunlight / SUN;
        let warm = warm / warm.max_element().max(1e-3);
        let horizon = Vec3::new(0.64, 0.72, 0.80) * Vec3::ONE.lerp(warm, 0.8);
        let toward = direction.dot(self.sun).max(0.0);
        let glow = (toward.powi(8) * 0.12 + toward.powi(200) * 0.5) * warm;
        let disc = self.sunlight * smooth(0.999_75, 0.999_9, toward);
        let air = if direction.z >= 0.0 {
            horizon.lerp(Vec3::new(0.13, 0.28, 0.58), direction.z.powf(0.55).min(1.0)) + glow + disc
        } else {
            let haze = (direction.z / GROUND_HAZE).exp();
            Vec3::new(0.36, 0.35, 0.32).lerp(horizon + glow, haze)
        };
        air * (0.25 + 0.75 * self.dusk)
    }

    /// Returns the light that a surface of this `roughness` reflects from `direction` without occluders.
    pub(super) fn reflection(&self, direction: Vec3A, roughness: f32) -> Vec3 {
        let blur = 0.04 + 0.8 * roughness;
        let above = smooth(-blur, blur, direction.z);
        let sky = sky_light(direction.with_z(direction.z.max(0.0)), self.sun) * self.dusk;
        let floor = if self.is_studio { self.ground().lerp(STUDIO, 0.5) } else { self.ground() };
        // A bright strip high on the side opposite to the sun, as photographers place behind shiny objects.
        let across = Vec3A::new(-self.sun.x, -self.sun.y, 0.35).normalize().dot(direction);
        let strip = 0.55 * smooth(0.88 - 0.5 * blur, 0.94 + 0.3 * blur, across) / (1.0 + 2.0 * roughness);
        let studio = floor.lerp(sky + strip, above);
        if self.is_shown { self.visible(direction).lerp(studio, smooth(0.1, 0.5, roughness)) } else { studio }
    }
}

impl SkySample {
    /// Creates an empty map.
    fn new(mut frame: LightProjection, direction: Vec3A, jitter: Vec2, light: Vec3A) -> Self {
        let scale = FARTHEST / frame.depth;
        let stretch = Vec3::new(1.0, 1.0, scale);
        frame.to_texels = glam::Affine3A::from_scale(stretch) * frame.to_texels;
        let depths = vec![u16::MAX; frame.texels()];
        let size = Vec2::new(frame.width as f32, frame.height as f32);
        let bias = 0.5 * frame.texel * scale + 1.0;
        let spread = SPREAD / (scale * frame.texel);
        Self { direction, light, jitter, bias, spread, frame, size, depths }
    }

    /// Draws all triangles.
    fn draw(&mut self, stage: &Stage) {
        let to_texels = self.frame.to_texels;
        stage.each_caster(0..stage.triangles() as u32, &to_texels, |draw, triangle| {
            self.cover(draw, &triangle)
        });
    }

    /// Draws the points that stand for small triangles, and the other triangles. The map has this `number`.
    fn draw_points(&mut self, stage: &Stage, points: &SkyPoints, number: usize) {
        for ProjectedTriangle { number, corners, .. } in &points.triangles {
            let corners = corners.map(|corner| self.frame.to_texels.transform_point3a(corner));
            let triangle = ProjectedTriangle { number: *number, corners, weights: None };
            self.cover(stage.find(*number).0, &triangle);
        }
        let depths = &mut self.depths;
        points.each(&self.frame, number, self.direction, |texel, depth| {
            depths[texel] = (depth as i32 as u16).min(depths[texel]);
        });
    }

    fn cover(&mut self, draw: &DrawCall<'_>, triangle: &ProjectedTriangle) {
        let width = self.frame.width;
        let grid = RasterGrid { width, rows: 0..self.frame.height, shifts: &[128.0] };
        let depths = &mut self.depths;
        let coverage = Coverage::of(draw, triangle, [4, 4], false);
        grid.cover(triangle.corners, |y, xs, z, growth| {
            let texels = &mut depths[y * width + xs.start..y * width + xs.end];
            let depth = |i: usize| (z + growth * (i as i32 as f32)) as i32 as u16;
            if coverage.is_full() {
                texels.iter_mut().enumerate().for_each(|(i, texel)| *texel = depth(i).min(*texel));
            } else {
                for (i, texel) in texels.iter_mut().enumerate() {
                    if coverage.covers(xs.start + i, y, 128.0) {
                        *texel = depth(i).min(*texel);
                    }
                }
            }
        });
    }

    /// Returns true if the direction's light reaches `point`, which is lifted off its surface.
    ///
    /// `spin` is a unit vector that rotates the jitter. A direction represents the part of the sky around it, so a
    /// point far behind its occluder is looked up again at a small distance, which softens the shadow's edge.
    #[inline]
    pub(super) fn reaches(&self, point: Vec3A, spin: Vec2) -> bool {
        let at = self.frame.to_texels.transform_point3a(point);
        let aside = spin.rotate(self.jitter);
        let gap = at.z - self.bias - self.depth(at.truncate() + aside * 0.7);
        gap <= 0.0 || at.z - self.bias <= self.depth(at.truncate() + aside * (gap * self.spread))
    }

    /// Returns the depth of the lit surface at `texel`; infinite if there is none.
    #[inline]
    fn depth(&self, texel: Vec2) -> f32 {
        if !(texel.cmpge(Vec2::ZERO) & texel.cmplt(self.size)).all() {
            return f32::INFINITY;
        }
        // Whether a texel is empty cannot be predicted, so a sum is faster than a branch.
        let (x, y) = (texel.x as i32 as usize, texel.y as i32 as usize);
        let depth = self.depths[y * self.frame.width + x];
        f32::from(depth) + [0.0, f32::INFINITY][usize::from(depth == u16::MAX)]
    }
}

/// Returns the radiance of the sky in `direction`: bluish overhead, whiter at the horizon, brighter towards the sun.
fn sky_light(direction: Vec3A, sun: Vec3A) -> Vec3 {
    let height = direction.z.clamp(0.0, 1.0);
    let glow = direction.dot(sun).max(0.0).powi(3) * 0.35;
    HORIZON.lerp(ZENITH, zenith_part(height)) * (1.0 + glow) + Vec3::new(0.10, 0.07, 0.03) * glow
}

/// Returns the part of the zenith's colour in that of the sky at this `height`, 0 to 1: its power of 0.6, interpolated in a table.
fn zenith_part(height: f32) -> f32 {
    const STEPS: usize = 256;
    static TABLE: LazyLock<[f32; STEPS + 2]> =
        LazyLock::new(|| std::array::from_fn(|i| (i as f32 / STEPS as f32).powf(1.2)));
    // The table has equal steps of the root, because the curve is steep at the horizon.
    let along = height.sqrt() * STEPS as f32;
    let step = along as i32 as usize;
    let [low, high] = [TABLE[step], TABLE[step + 1]];
    low + (high - low) * (along - step as f32)
}

/// Returns direction `i` of `count` and the solid angle that it represents. Any sequence of successive directions is
/// distributed over the sphere. Above the horizon they are denser towards the zenith, which lights most surfaces.
///
/// Method: Roberts, "The unreasonable effectiveness of quasirandom sequences", 2018.
fn direction(i: usize, count: usize) -> (Vec3A, f32) {
    let fraction = |factor: f64| (0.5 + factor * (i + 1) as f64).fract() as f32;
    let (u, turn) = (fraction(0.754_877_666_246_692_7), fraction(0.569_840_290_998_053_2));
    let tau = std::f32::consts::TAU;
    let (z, angle) = if u < BELOW {
        (-(u / BELOW).clamp(0.02, 1.0), tau / BELOW)
    } else {
        // z = v^0.75 has the density z^(1/3) * 4/3.
        let z = ((u - BELOW) / (1.0 - BELOW)).max(1e-4).powf(0.75);
        (z, tau / (1.0 - BELOW) / (z.cbrt() * 4.0 / 3.0))
    };
    let r = (1.0 - z * z).sqrt();
    let (sin, cos) = (turn * tau).sin_cos();
    (Vec3A::new(r * cos, r * sin, z), angle / count as f32)
}

/// Interpolates smoothly from 0 at or below `low` to 1 at or above `high`.
pub(super) fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_of_the_sky_is_near_its_power() {
        for i in 0..=10_000 {
            let height = i as f32 / 10_000.0;
            let off = (zenith_part(height) - height.powf(0.6)).abs();
            assert!(off < 3e-4, "{off} at {height}");
        }
    }

    #[test]
    fn the_directions_stand_for_the_whole_sphere() {
        for count in [16, 40, 144] {
            let total: f32 = (0..count).map(|i| direction(i, count).1).sum();
            assert!(
                (total / (2.0 * std::f32::consts::TAU) - 1.0).abs() < 0.15,
                "{count} directions: {total}"
            );
        }
        let up: f32 = (0..4096).map(|i| direction(i, 4096)).map(|(d, angle)| d.z.max(0.0) * angle).sum();
        assert!((up - std::f32::consts::PI).abs() < 0.02);
    }
}
