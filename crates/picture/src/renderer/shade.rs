//! Shading of a point on a surface in the light of sun, sky and ground.

use super::camera::Camera;
use super::floor::Floor;
use super::reflection::{MirroredPoint, Tracer};
use super::sky::{Sky, SkySample, smooth};
use super::stage::Stage;
use super::sun::Sun;
use super::surface::SurfacePoint;
use super::texture::MaterialImages;
use glam::{Vec2, Vec3, Vec3A};
use std::f32::consts::PI;

/// Fraction of light that passes through leaves.
const THROUGH: f32 = 0.32;

/// Roughness up to which a surface mirrors the model sharply, and from which on it mirrors only its surroundings.
const MIRROR: [f32; 2] = [0.12, 0.4];
/// Minimum fraction of light that a surface reflects if the model is mirrored in it.
const MIRRORED: f32 = 0.1;
/// Number of the sky's maps that light a mirrored point.
const MIRROR_MAPS: usize = 12;
/// Fraction of light that the model reflects on average.
const ALBEDO: f32 = 0.4;

/// Inputs of shading.
pub(super) struct Light<'a> {
    /// Model on its stage.
    pub stage: &'a Stage<'a>,
    /// Images of the materials.
    pub images: &'a [MaterialImages],
    /// Camera of the render.
    pub camera: &'a Camera,
    /// Sun with its depth map.
    pub sun: &'a Sun,
    /// Sky with its depth maps.
    pub sky: &'a Sky,
    /// Ground, if there is one.
    pub floor: Option<&'a Floor>,
    /// Model as mirrors see it, if they mirror it.
    pub tracer: Option<&'a Tracer<'a>>,
}

/// Surface that a part of a pixel sees, with the light that it has gathered.
#[derive(Debug)]
pub(super) struct Fragment {
    /// Visible point of the surface.
    pub surface: SurfacePoint,
    /// Index and number of the fragments that share the sky maps.
    pub share: (usize, usize),
    /// Index and number of the fragments of the same pixel that share the lookups in the sun's map.
    pub crowd: (usize, usize),
    /// Unit vector that rotates patterns of lookups. It varies from pixel to pixel.
    pub spin: Vec2,
    /// Index of the light that the fragment gathers, alone or with others.
    pub pool: usize,
}

/// Light that fragments have gathered.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct GatheredLight {
    /// Irradiance by the sky, and the same without occluders.
    sky: [Vec3A; 2],
    /// Visible part of the reflected surroundings, and the same without occluders.
    mirrored: [f32; 2],
}

impl Fragment {
    /// Creates a fragment that gathers the light `pool`.
    pub(super) fn new(surface: SurfacePoint, spin: Vec2, pool: usize) -> Self {
        Self { surface, share: (0, 1), crowd: (0, 1), spin, pool }
    }

    /// Returns true if another `surface` in the same pixel would look the same.
    pub(super) fn joins(&self, surface: &SurfacePoint) -> bool {
        let own = &self.surface;
        own.material == surface.material
            && own.smooth.dot(surface.smooth) > 0.94
            && own.plane.dot(surface.plane) > 0.85
            && (own.position - surface.position).length_squared() < 1e-5
    }
}

impl GatheredLight {
    /// Adds the light that another fragment has gathered from other maps.
    pub(super) fn add(&mut self, other: &Self) {
        for i in 0..2 {
            self.sky[i] += other.sky[i];
            self.mirrored[i] += other.mirrored[i];
        }
    }

    /// Returns the fraction of the sky's light that arrives, for each colour.
    fn openness(&self) -> Vec3 {
        let [seen, all] = self.sky;
        Vec3::from(seen / all.max(Vec3A::splat(1e-6)))
    }
}

/// Data of a fragment for sky lookups, compact in memory.
struct Probe {
    point: Vec3A,
    plane: Vec3A,
    normal: Vec3A,
    mirror: Vec3A,
    spin: Vec2,
    share: (usize, usize),
    pool: usize,
}

impl Probe {
    fn new(fragment: &Fragment, lift: f32) -> Self {
        let surface = &fragment.surface;
        Self {
            point: surface.rounded + surface.plane * lift,
            plane: surface.plane,
            normal: surface.normal,
            mirror: surface.mirror(),
            spin: fragment.spin,
            share: fragment.share,
            pool: fragment.pool,
        }
    }
}

impl Light<'_> {
    /// Returns the light of all directions of the sky for `fragments`, which are close together and gather into this
    /// number of `pools`.
    pub(super) fn gather(&self, fragments: &[Fragment], pools: usize) -> Vec<GatheredLight> {
        let mut gathered = vec![GatheredLight::default(); pools];
        let count = self.sky.maps.len();
        // Probes of the same maps are close together, so that each map stays in the cache.
        let mut order: Vec<&Fragment> = fragments.iter().collect();
        order.sort_by_key(|fragment| fragment.share);
        let probes: Vec<Probe> =
            order.into_iter().map(|fragment| Probe::new(fragment, self.sky.lift)).collect();
        for probes in probes.chunk_by(|a, b| a.share == b.share) {
            let (turn, of) = probes[0].share;
            // The maps whose number times `of`, divided by `count`, is `turn`.
            let maps = (turn * count).div_ceil(of)..((turn + 1) * count).div_ceil(of);
            for map in &self.sky.maps[maps] {
                for probe in probes {
                    self.add_light(probe, map, &mut gathered[probe.pool]);
                }
            }
        }
        gathered
    }

    /// Adds the light of one direction of the sky at `probe`.
    #[inline]
    fn add_light(&self, probe: &Probe, map: &SkySample, gathered: &mut GatheredLight) {
        let facing = probe.normal.dot(map.direction).max(0.0);
        let is_above = probe.plane.dot(map.direction) > 0.0;
        // A lobe of this width contains enough directions to be smooth, for any roughness.
        let lobe = probe.mirror.dot(map.direction).max(0.0).powi(4);
        if facing <= 0.0 && lobe < 0.01 {
            return;
        }
        let light = map.light * facing;
        gathered.sky[1] += light;
        // A surface mirrors nothing of what is behind it.
        let lobe = if is_above { lobe } else { 0.0 };
        gathered.mirrored[1] += lobe;
        if is_above && map.reaches(probe.point, probe.spin) {
            let strength = self.strength(probe.point, map.direction);
            gathered.sky[0] += light * strength;
            gathered.mirrored[0] += lobe * strength;
        }
    }

    /// Returns the brightness in an unoccluded `direction` from `point`, relative to the open sky or the open ground in
    /// that direction.
    fn strength(&self, point: Vec3A, direction: Vec3A) -> f32 {
        match self.floor {
            Some(floor) if direction.z < 0.0 => floor.light(point, direction),
            _ => 1.0,
        }
    }

    /// Returns the light that `fragment` sends to the camera, if it has `gathered` this light.
    pub(super) fn color(&self, fragment: &Fragment, gathered: &GatheredLight) -> Vec3 {
        let surface = &fragment.surface;
        let diffuse = surface.base * (1.0 - surface.metallic);
        let glossy = Vec3::splat(0.04).lerp(surface.base, surface.metallic);
        let facing = surface.normal.dot(surface.view).max(0.03);

        let open = gathered.openness();
        let mut sky = self.sky.open(surface.normal) * bounce_light(open, diffuse);
        let mut color = surface.emissive;
        let toward = surface.normal.dot(self.sun.direction);
        if toward > 0.0 {
            let seen = self.sun_seen(fragment, surface.rounded, surface.normal);
            let kept = if surface.thin { 1.0 - 0.5 * THROUGH } else { 1.0 };
            let light = self.sun.light * (toward * seen);
            color += light * (diffuse * (kept / PI) + self.gloss(surface, glossy, facing, toward));
        } else if surface.thin {
            // Light that shines through a leaf is more saturated than light that the leaf reflects.
            let seen = self.sun_seen(fragment, surface.behind, -surface.normal);
            color += self.sun.light * diffuse * diffuse.powf(0.35) * (-toward * seen * 1.6 * THROUGH / PI);
        }
        if surface.thin {
            sky += self.sky.open(-surface.normal) * open * THROUGH;
        }
        color += diffuse * sky / PI;

        let part = mirror_part(glossy, surface.roughness, facing);
        color + self.reflected(fragment, gathered, part.max_element()) * part
    }

    /// Returns the light that arrives at `fragment` from where it mirrors, if it reflects at most this `part` of it.
    fn reflected(&self, fragment: &Fragment, gathered: &GatheredLight, part: f32) -> Vec3 {
        let surface = &fragment.surface;
        let open = gathered.openness();
        let [seen, all] = gathered.mirrored;
        let unblocked = if all > 1e-3 { seen / all } else { open.element_sum() / 3.0 };
        // The occluder of a reflection is a part of the model that faces the surface, half of it in the shade.
        let direction = surface.mirror();
        let sunlight = self.sun.light * (-direction.dot(self.sun.direction)).max(0.0);
        let blocker = (self.sky.open(-direction) + sunlight) * (0.5 * ALBEDO / PI);
        let estimate = blocker.lerp(self.sky.reflection(direction, surface.roughness), unblocked);
        let sharp = 1.0 - smooth(MIRROR[0], MIRROR[1], surface.roughness);
        match self.tracer {
            Some(tracer) if sharp > 0.0 && part > MIRRORED => {
                estimate.lerp(self.trace(tracer, surface, fragment.spin), sharp)
            }
            _ => estimate,
        }
    }

    /// Returns the light of the model or of its surroundings that `surface` mirrors.
    fn trace(&self, tracer: &Tracer, surface: &SurfacePoint, spin: Vec2) -> Vec3 {
        let direction = surface.mirror();
        // A mirror on a smooth surface may point below the triangle.
        let below = (0.02 - direction.dot(surface.plane)).max(0.0);
        let direction = (direction + surface.plane * below).normalize_or(surface.plane);
        let footprint = self.camera.footprint(surface.position).max(0.0);
        let origin = surface.rounded + surface.plane * (2e-5 + 0.25 * footprint);
        match tracer.meet(origin, direction) {
            Some(point) => self.light_of_point(&point, direction, footprint * (1.0 + point.distance), spin),
            None => {
                self.sky.reflection(direction, surface.roughness) * self.strength(surface.position, direction)
            }
        }
    }

    /// Returns the light that a mirrored `point` sends back along `direction`. A pixel covers this `footprint` of it (stage
    /// units).
    fn light_of_point(&self, point: &MirroredPoint, direction: Vec3A, footprint: f32, spin: Vec2) -> Vec3 {
        let number = point.draw.part.material;
        let material = &self.stage.materials[number];
        let [red, green, blue, _] = material.base_color;
        let mut base = Vec3::new(red, green, blue);
        if let Some(images) = self.images.get(number) {
            let size = footprint / self.stage.shrink.matrix3.x_axis.length() as f32;
            for (image, uv) in [(&images.texture, point.uv), (&images.dirt, point.second_uv)] {
                if let Some(image) = image {
                    base *= image.color(uv, Vec2::X * size, Vec2::Y * size);
                }
            }
        }
        let lifted = point.position + point.normal * self.sky.lift;
        let step = self.sky.maps.len().div_ceil(MIRROR_MAPS).max(1);
        let (mut seen, mut all) = (0.0, 1e-6);
        for map in self.sky.maps.iter().step_by(step) {
            let light = map.light.element_sum() * point.normal.dot(map.direction).max(0.0);
            all += light;
            if light > 0.0 && map.reaches(lifted, Vec2::X) {
                seen += light * self.strength(lifted, map.direction);
            }
        }
        let open = seen / all;
        let metallic = material.metallic.clamp(0.0, 1.0);
        let diffuse = base * (1.0 - metallic);
        let mut light = self.sky.open(point.normal) * bounce_light(Vec3::splat(open), diffuse);
        let toward = point.normal.dot(self.sun.direction);
        if toward > 0.0 {
            let sun = self.sun.visibility(point.position, point.normal, spin, (0, 3));
            light += self.sun.light * (toward * sun);
        }
        let facing = -direction.dot(point.normal);
        let glossy = Vec3::splat(0.04).lerp(base, metallic);
        let roughness = material.roughness.clamp(0.06, 1.0);
        let mirror = direction + point.normal * (2.0 * facing);
        let around = self.sky.reflection(mirror, roughness) * open;
        Vec3::from_array(material.emissive)
            + diffuse * light / PI
            + around * mirror_part(glossy, roughness, facing.max(0.03))
    }

    /// Returns the ground's brightness at `fragment`, relative to its brightness without the model.
    pub(super) fn ground(&self, fragment: &Fragment, gathered: &GatheredLight) -> Vec3 {
        let sky = self.sky.open(Vec3A::Z);
        let sun = self.sun.light * self.sun.direction.z;
        // The edges of shadows on the ground are visible, so pixels that share the sky's light do not share the sun's.
        let seen = self.sun.visibility(fragment.surface.rounded, Vec3A::Z, fragment.spin, (0, 1));
        let part = (sky * bounce_light(gathered.openness(), Vec3::splat(0.5)) + sun * seen) / (sky + sun);
        // Halve the blue tint, because the eye perceives the sky's light as white.
        part.lerp(Vec3::splat(part.element_sum() / 3.0), 0.5)
    }

    fn sun_seen(&self, fragment: &Fragment, point: Vec3A, normal: Vec3A) -> f32 {
        self.sun.visibility(point, normal, fragment.spin, fragment.crowd)
    }

    /// Returns the sun's highlight for unit irradiance: GGX with the height-correlated Smith term and Schlick's Fresnel
    /// approximation.
    fn gloss(&self, surface: &SurfacePoint, glossy: Vec3, facing: f32, toward: f32) -> Vec3 {
        let half = (surface.view + self.sun.direction).normalize_or(surface.normal);
        let (across, along) = (surface.normal.dot(half).max(0.0), surface.view.dot(half).max(0.0));
        // The sun is a disc, and a sharper highlight than this would sparkle.
        let alpha = (surface.roughness * surface.roughness).max(0.02);
        let squared = alpha * alpha;
        let spread = across * across * (squared - 1.0) + 1.0;
        let density = squared / (PI * spread * spread);
        let seen = toward * (facing * facing * (1.0 - squared) + squared).sqrt();
        let lit = facing * (toward * toward * (1.0 - squared) + squared).sqrt();
        let fresnel = glossy + (Vec3::ONE - glossy) * (1.0 - along).powi(5);
        (fresnel * (density * 0.5 / (seen + lit).max(1e-4))).min(Vec3::splat(12.0))
    }
}

/// Returns true if the model has surfaces in which it is mirrored.
pub(super) fn has_mirrors(stage: &Stage) -> bool {
    stage.draws.iter().any(|draw| {
        let material = &stage.materials[draw.part.material];
        material.roughness < MIRROR[1]
    })
}

/// Returns the fraction of the surroundings' light that a surface reflects specularly.
///
/// Method: Karis, "Physically based shading on mobile", 2014.
fn mirror_part(glossy: Vec3, roughness: f32, facing: f32) -> Vec3 {
    let r =
        [1.0 - roughness, 0.0425 - 0.0275 * roughness, 1.04 - 0.572 * roughness, 0.022 * roughness - 0.04];
    let a = (r[0] * r[0]).min((-9.28 * facing).exp2()) * r[0] + r[1];
    glossy * (-1.04 * a + r[2]) + Vec3::splat((1.04 * a + r[3]).max(0.0))
}

/// Returns the fraction of light that reaches a crease after multiple bounces, if the fraction `open` is unoccluded and
/// the surface has this `albedo`.
///
/// Method: Jimenez et al., "Practical realtime strategies for accurate indirect occlusion", 2016.
fn bounce_light(open: Vec3, albedo: Vec3) -> Vec3 {
    let a = albedo * 2.0404 - 0.3324;
    let b = albedo * -4.7951 + 0.6417;
    let c = albedo * 2.7552 + 0.6903;
    open.max(((open * a + b) * open + c) * open)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_crease_between_white_walls_is_lighter_than_between_black_ones() {
        let open = Vec3::splat(0.4);
        assert!((bounce_light(open, Vec3::ZERO).x - 0.4).abs() < 1e-3);
        assert!(bounce_light(open, Vec3::splat(0.8)).x > 0.55);
        assert!((bounce_light(Vec3::ONE, Vec3::splat(0.8)).x - 1.0).abs() < 0.05);
    }

    #[test]
    fn a_surface_mirrors_no_more_than_there_is() {
        for i in 0..100 {
            let (roughness, facing) = ((i % 10) as f32 / 9.0, (i / 10) as f32 / 9.0);
            let part = mirror_part(Vec3::ONE, roughness, facing);
            assert!(part.x > 0.3 && part.x < 1.01, "{part} at roughness {roughness}, facing {facing}");
        }
    }
}
