//! Surface point that a pixel sees.

use super::camera::Camera;
use super::stage::{DrawCall, Stage};
use super::texture::MaterialImages;
use glam::{Vec2, Vec3, Vec3A};

/// Point on the model or the ground, with the data for shading.
#[derive(Debug, Clone)]
pub(super) struct SurfacePoint {
    /// Position on the stage.
    pub position: Vec3A,
    /// Position on the smooth surface that the normals describe, for shadows without facets.
    pub rounded: Vec3A,
    /// The same for the other side of a thin surface, whose light shines through.
    pub behind: Vec3A,
    /// Unit normal of the triangle, towards the camera.
    pub plane: Vec3A,
    /// Unit normal for shading, towards the camera.
    pub normal: Vec3A,
    /// The same without the normal map.
    pub smooth: Vec3A,
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
#[derive(Debug, Clone, Copy)]
struct StageTriangle {
    a: Vec3A,
    ab: Vec3A,
    ac: Vec3A,
    cross: Vec3A,
}

impl StageTriangle {
    /// Returns the weights of the second and third corner at the intersection of `ray` from `eye` with the triangle's
    /// plane; the weights of the centroid if the triangle is seen edge-on.
    fn weights(&self, (eye, ray): (Vec3A, Vec3A)) -> Vec2 {
        let steep = self.cross.dot(ray);
        let size = self.cross.length_squared();
        if size <= 0.0 || steep.abs() < 1e-6 * size.sqrt() {
            return Vec2::splat(1.0 / 3.0);
        }
        let from = eye + ray * ((self.a - eye).dot(self.cross) / steep) - self.a;
        Vec2::new(from.cross(self.ac).dot(self.cross), self.ab.cross(from).dot(self.cross)) / size
    }
}

/// Triangle that a pixel sees.
pub(super) struct SeenTriangle<'a> {
    draw: &'a DrawCall<'a>,
    corners: [usize; 3],
    /// Positions and normals of the corners in the mesh's coordinates.
    positions: [Vec3; 3],
    normals: [Vec3; 3],
}

impl<'a> SeenTriangle<'a> {
    /// Finds triangle `number`. The `hint` is the index of the draw that was found last, where the search begins.
    pub(super) fn find(stage: &'a Stage<'a>, hint: &mut usize, number: u32) -> Self {
        let (draw, index) = stage.find_near(number, hint);
        let corners = draw.triangles.get(index).unwrap_or_default().map(|i| i as usize);
        Self { draw, corners, positions: [Vec3::ZERO; 3], normals: [Vec3::ZERO; 3] }
    }

    /// Reads the corners. Triangles are read one directly after the other, so that the waits for memory overlap.
    pub(super) fn read(&mut self) {
        let part = self.draw.part;
        self.positions = self.corners.map(|i| part.positions.get(i).copied().unwrap_or_default());
        self.normals = self.corners.map(|i| part.normals.get(i).map_or(Vec3::ZERO, |normal| normal.vector()));
    }
}

/// Point of a triangle that a pixel sees, before its texture is read.
pub(super) struct SeenPoint<'a> {
    /// Point with the colour of its material.
    pub surface: SurfacePoint,
    images: &'a MaterialImages,
    seen: &'a SeenTriangle<'a>,
    triangle: StageTriangle,
    /// Weights of the second and third corner, and the same within the triangle.
    exact: Vec2,
    inside: Vec2,
    place: [f32; 2],
}

impl<'a> SeenPoint<'a> {
    /// Returns the point of a triangle at pixel coordinates `place`.
    pub(super) fn at_pixel(
        stage: &Stage<'_>,
        images: &'a [MaterialImages],
        camera: &Camera,
        seen: &'a SeenTriangle<'a>,
        place: [f32; 2],
    ) -> Self {
        let (draw, part) = (seen.draw, seen.draw.part);
        let [a, b, c] = seen.positions.map(|at| draw.place.transform_point3a(Vec3A::from(at)));
        let corners = StageTriangle { a, ab: b - a, ac: c - a, cross: (b - a).cross(c - a) };
        let exact = corners.weights(camera.ray(place[0], place[1]));
        // The centre of the samples may be slightly outside the triangle.
        let inside = exact.max(Vec2::ZERO);
        let inside = inside / (inside.x + inside.y).max(1.0);
        let position = a + corners.ab * inside.x + corners.ac * inside.y;
        let view = camera.toward(position);

        let outward = if draw.mirrored { -corners.cross } else { corners.cross };
        let plane = outward.normalize_or(view);
        let side = if plane.dot(view) < 0.0 { -1.0 } else { 1.0 };
        let weights = [1.0 - inside.x - inside.y, inside.x, inside.y];
        let blended: Vec3 =
            seen.normals.into_iter().zip(weights).map(|(normal, weight)| normal * weight).sum();
        let normal = (draw.turn * Vec3A::from(blended)).normalize_or(plane) * side;

        let material = &stage.materials[part.material];
        let [red, green, blue, _] = material.base_color;
        let surface = SurfacePoint {
            position,
            rounded: position,
            behind: position,
            plane: plane * side,
            normal: bend(normal, view),
            smooth: bend(normal, view),
            view,
            material: Some(part.material),
            base: Vec3::new(red, green, blue),
            metallic: material.metallic.clamp(0.0, 1.0),
            roughness: material.roughness.clamp(0.06, 1.0),
            emissive: Vec3::from_array(material.emissive),
            thin: material.double_sided && material.metallic < 0.5,
        };
        let images = &images[part.material];
        Self { surface, images, seen, triangle: corners, exact, inside, place }
    }

    /// Returns the point with the colour of its texture and the slope of its normal map, on the smooth surface.
    pub(super) fn finish(self, camera: &Camera) -> SurfacePoint {
        let mut surface = self.surface.clone();
        let (part, StageTriangle { a, ab, ac, .. }) = (self.seen.draw.part, self.triangle);
        let side = if surface.plane.dot(self.triangle.cross) < 0.0 { -1.0 } else { 1.0 };
        let side = if self.seen.draw.mirrored { -side } else { side };
        let normals = self.seen.normals.map(|local| {
            (self.seen.draw.turn * Vec3A::from(local)).normalize_or(surface.plane * side) * side
        });
        let weights = [1.0 - self.inside.x - self.inside.y, self.inside.x, self.inside.y];
        let corners = [a, a + ab, a + ac];
        surface.rounded = round_position(surface.position, corners, normals, weights);
        if surface.thin {
            surface.behind =
                round_position(surface.position, corners, normals.map(|normal| -normal), weights);
        }
        if let Some(dirt) = &self.images.dirt {
            let ([at, across, along], _) = self.footprint(camera, |i| part.second_uv(i));
            surface.base *= dirt.color(at, across, along);
        }
        if self.images.texture.is_none() && self.images.normals.is_none() {
            return surface;
        }
        let ([at, across, along], [u, v]) =
            self.footprint(camera, |i| part.uvs.get(i).copied().unwrap_or_default());
        if let Some(texture) = &self.images.texture {
            surface.base *= texture.color(at, across, along);
        }
        if let Some((normals, scale)) = &self.images.normals {
            let slope = normals.color(at, across, along) * Vec3::new(*scale, *scale, 1.0);
            // Seen from the back, the relief is the other way round.
            let slope = Vec3A::new(slope.x * side, slope.y * side, slope.z);
            surface.normal = bend(lean(surface.normal, slope, [ab, ac], [u, v]), surface.view);
        }
        surface
    }

    /// Returns the texture coordinates (m) of the point and the sides of the pixel in them, and the increase of the coordinates
    /// along two edges of the triangle. `uv` returns those of a vertex.
    fn footprint(&self, camera: &Camera, uv: impl Fn(usize) -> Vec2) -> ([Vec2; 3], [Vec2; 2]) {
        let [origin, u, v] = {
            let [a, b, c] = self.seen.corners.map(uv);
            [a, b - a, c - a]
        };
        let uv = |weights: Vec2| origin + u * weights.x + v * weights.y;
        let [x, y] = self.place;
        let beside = |right: f32, down: f32| uv(self.triangle.weights(camera.ray(x + right, y + down)));
        let here = uv(self.exact);
        ([uv(self.inside), beside(1.0, 0.0) - here, beside(0.0, 1.0) - here], [u, v])
    }
}

impl SurfacePoint {
    /// Returns the direction of reflection of the view vector.
    pub(super) fn mirror(&self) -> Vec3A {
        self.normal * (2.0 * self.normal.dot(self.view)) - self.view
    }

    /// Returns the point of the ground at `position`.
    pub(super) fn ground(position: Vec3A, camera: &Camera) -> Self {
        Self {
            position,
            rounded: position,
            behind: position,
            plane: Vec3A::Z,
            normal: Vec3A::Z,
            smooth: Vec3A::Z,
            view: camera.toward(position),
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

/// Returns the unit normal that has the parts of `slope` along the increase of u, of v, and of `normal`.
///
/// `edges` are two edges of the triangle, and `uvs` the increase of the texture coordinates along them. Returns `normal` if
/// they have no area.
///
/// Method: Mikkelsen, "Simulation of wrinkled surfaces revisited", 2008.
fn lean(normal: Vec3A, slope: Vec3A, edges: [Vec3A; 2], uvs: [Vec2; 2]) -> Vec3A {
    let area = uvs[0].perp_dot(uvs[1]);
    let turn = if area < 0.0 { -1.0 } else { 1.0 };
    let right = (edges[0] * uvs[1].y - edges[1] * uvs[0].y) * turn;
    let up = (edges[1] * uvs[0].x - edges[0] * uvs[1].x) * turn;
    let flat = |along: Vec3A| (along - normal * normal.dot(along)).try_normalize();
    match (flat(right), flat(up)) {
        (Some(right), Some(up)) if area != 0.0 => {
            (right * slope.x + up * slope.y + normal * slope.z).normalize_or(normal)
        }
        _ => normal,
    }
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

    #[test]
    fn a_normal_leans_along_the_texture_coordinates_also_where_they_are_mirrored() {
        let (slope, edges) = (Vec3A::new(0.6, 0.0, 0.8), [Vec3A::X * 2.0, Vec3A::Y]);
        let plain = lean(Vec3A::Z, slope, edges, [Vec2::X, Vec2::Y]);
        assert!(plain.distance(Vec3A::new(0.6, 0.0, 0.8)) < 1e-6, "{plain}");
        let mirrored = lean(Vec3A::Z, slope, edges, [Vec2::NEG_X, Vec2::Y]);
        assert!(mirrored.distance(Vec3A::new(-0.6, 0.0, 0.8)) < 1e-6, "{mirrored}");
        let turned = lean(Vec3A::Z, slope, edges, [Vec2::Y, Vec2::NEG_X]);
        assert!(turned.distance(Vec3A::new(0.0, -0.6, 0.8)) < 1e-6, "{turned}");
        assert_eq!(lean(Vec3A::Z, slope, edges, [Vec2::X, Vec2::X]), Vec3A::Z);
    }
}
