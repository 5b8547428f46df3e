//! Surface point that a pixel sees.

use super::camera::Camera;
use super::stage::Stage;
use super::texture::SampledTexture;
use glam::{Vec2, Vec3, Vec3A};

/// Point on the model or the ground, with the data for shading.
#[derive(Debug, Clone)]
pub(super) struct SurfacePoint {
    /// Position on the stage.
    pub position: Vec3A,
    /// Position on the smooth surface that the normals describe, for shadows without facets.
    pub rounded: Vec3A,
    /// Unit normal of the triangle, towards the camera.
    pub plane: Vec3A,
    /// Unit normal for shading, towards the camera.
    pub normal: Vec3A,
    /// Unit vector towards the camera.
    pub view: Vec3A,
    /// Index of the material; `None` for the ground.
    pub material: Option<usize>,
    /// Linear colour.
    pub base: Vec3,
    /// Metallic fraction, 0 to 1.
    pub metallic: f32,
    /// Perceptual roughness.
    pub roughness: f32,
    /// Emitted light.
    pub emissive: Vec3,
    /// Set if light from behind shines through, as with leaves.
    pub thin: bool,
}

/// Triangle on the stage.
struct StageTriangle {
    a: Vec3A,
    ab: Vec3A,
    ac: Vec3A,
    cross: Vec3A,
}

impl StageTriangle {
    /// Returns the weights of the second and third corner at the intersection of `ray` from `eye` with the triangle's
    /// plane; the weights of the centroid if the triangle is seen edge-on.
    fn weights(&self, eye: Vec3A, ray: Vec3A) -> Vec2 {
        let steep = self.cross.dot(ray);
        let size = self.cross.length_squared();
        if size <= 0.0 || steep.abs() < 1e-6 * size.sqrt() {
            return Vec2::splat(1.0 / 3.0);
        }
        let from = eye + ray * ((self.a - eye).dot(self.cross) / steep) - self.a;
        Vec2::new(from.cross(self.ac).dot(self.cross), self.ab.cross(from).dot(self.cross)) / size
    }
}

impl SurfacePoint {
    /// Returns the point of triangle `number` at pixel coordinates `place`.
    pub(super) fn at_pixel(
        stage: &Stage,
        textures: &[Option<SampledTexture>],
        camera: &Camera,
        number: u32,
        place: [f32; 2],
    ) -> Self {
        let (draw, index) = stage.find(number);
        let part = draw.part;
        let triangle = part.triangles.get(index).unwrap_or_default().map(|i| i as usize);
        let [a, b, c] = triangle.map(|i| draw.place.transform_point3a(Vec3A::from(part.positions[i])));
        let corners = StageTriangle { a, ab: b - a, ac: c - a, cross: (b - a).cross(c - a) };
        let exact = corners.weights(camera.eye, camera.ray(place[0], place[1]));
        // The centre of the samples may be slightly outside the triangle.
        let inside = exact.max(Vec2::ZERO);
        let inside = inside / (inside.x + inside.y).max(1.0);
        let position = a + corners.ab * inside.x + corners.ac * inside.y;
        let view = (camera.eye - position).normalize();

        let outward = if draw.mirrored { -corners.cross } else { corners.cross };
        let plane = outward.normalize_or(view);
        let side = if plane.dot(view) < 0.0 { -1.0 } else { 1.0 };
        let weights = [1.0 - inside.x - inside.y, inside.x, inside.y];
        let normals = triangle.map(|i| {
            let local = part.normals.get(i).map_or(Vec3::ZERO, |normal| normal.vector());
            (draw.turn * Vec3A::from(local)).normalize_or(plane) * side
        });
        let blended = normals[0] * weights[0] + normals[1] * weights[1] + normals[2] * weights[2];
        let normal = blended.normalize_or(plane * side);

        let material = &stage.materials[part.material];
        let [red, green, blue, _] = material.base_color;
        let mut base = Vec3::new(red, green, blue);
        if let Some(texture) = &textures[part.material] {
            let [ua, ub, uc] = triangle.map(|i| part.uvs.get(i).copied().unwrap_or_default());
            let uv = |weights: Vec2| ua + (ub - ua) * weights.x + (uc - ua) * weights.y;
            let beside = |x: f32, y: f32| corners.weights(camera.eye, camera.ray(place[0] + x, place[1] + y));
            let here = uv(exact);
            base *= texture.color(uv(inside), uv(beside(1.0, 0.0)) - here, uv(beside(0.0, 1.0)) - here);
        }
        Self {
            position,
            rounded: round_position(position, [a, b, c], normals, weights),
            plane: plane * side,
            normal: bend(normal, view),
            view,
            material: Some(part.material),
            base,
            metallic: material.metallic.clamp(0.0, 1.0),
            roughness: material.roughness.clamp(0.06, 1.0),
            emissive: Vec3::from_array(material.emissive),
            thin: material.double_sided && material.metallic < 0.5,
        }
    }

    /// Returns the direction of reflection of the view vector.
    pub(super) fn mirror(&self) -> Vec3A {
        self.normal * (2.0 * self.normal.dot(self.view)) - self.view
    }

    /// Returns the point of the ground at `position`.
    pub(super) fn ground(position: Vec3A, camera: &Camera) -> Self {
        Self {
            position,
            rounded: position,
            plane: Vec3A::Z,
            normal: Vec3A::Z,
            view: (camera.eye - position).normalize(),
            material: None,
            base: Vec3::splat(0.5),
            metallic: 0.0,
            roughness: 1.0,
            emissive: Vec3::ZERO,
            thin: false,
        }
    }
}

/// Moves `position` outwards to the planes through the triangle's corners that `normals` describe.
///
/// Method: Hanika, "Hacking the shadow terminator", Ray Tracing Gems II, 2021.
fn round_position(position: Vec3A, corners: [Vec3A; 3], normals: [Vec3A; 3], weights: [f32; 3]) -> Vec3A {
    let outward: Vec3A =
        (0..3).map(|i| normals[i] * (weights[i] * (position - corners[i]).dot(normals[i]).min(0.0))).sum();
    position - outward
}

/// Rotates `normal` towards `view` just enough that it does not face away from it.
fn bend(normal: Vec3A, view: Vec3A) -> Vec3A {
    let facing = normal.dot(view);
    if facing >= 0.03 { normal } else { (normal + view * (0.03 - facing)).normalize_or(view) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_normal_that_faces_away_is_bent_to_the_rim_and_keeps_its_side() {
        let bent = bend(Vec3A::new(0.8, 0.0, -0.6), Vec3A::Z);
        assert!(bent.z > 0.0 && bent.z < 0.1 && bent.x > 0.9);
        assert_eq!(bend(Vec3A::new(0.6, 0.0, 0.8), Vec3A::Z), Vec3A::new(0.6, 0.0, 0.8));
    }
}
