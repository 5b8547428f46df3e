//! Perspective camera, fitted to the model.

use super::view::Viewpoint;
use glam::{Affine3A, Mat3A, Vec3A};

/// Margin on each side, as a fraction of the image size.
const MARGIN: f32 = 0.06;

/// Focal length in units of the image's longer side: a field of view of 32 degrees, as is common for buildings.
const FOCAL: f32 = 1.75;

/// Camera around the origin of the stage.
#[derive(Debug, Clone)]
pub(super) struct Camera {
    /// Position of the camera.
    pub eye: Vec3A,
    /// Transform from the stage to the camera's axes: right, down, forward.
    pub view: Affine3A,
    /// Distance of the model's nearest point along the view direction, for the depth.
    near: f32,
    right: Vec3A,
    down: Vec3A,
    forward: Vec3A,
    focal: f32,
    center: [f32; 2],
}

impl Camera {
    /// Fits a camera in direction `eye`, as near as possible with all of `points` in an image of `size` (pixels).
    pub(super) fn fit(points: impl Iterator<Item = Vec3A>, eye: Viewpoint, size: [u32; 2]) -> Self {
        let forward = -eye.direction();
        let (sin, cos) = eye.azimuth.sin_cos();
        let right = glam::DVec3::new(-cos, sin, 0.0);
        let down = forward.cross(right).as_vec3a();
        let (right, forward) = (right.as_vec3a(), forward.as_vec3a());
        let (width, height) = (size[0] as f32, size[1] as f32);
        let focal = FOCAL * width.max(height);
        let slope = [width, height].map(|side| side * (0.5 - MARGIN) / focal);

        // A point is inside if |x - eye.x| <= slope * (z - eye.z); both sides together bound eye.z, and their
        // difference gives the eye.x that leaves the same margin on both.
        let mut most = [f32::NEG_INFINITY; 4];
        let mut nearest = f32::INFINITY;
        for point in points {
            let (x, y, z) = (point.dot(right), point.dot(down), point.dot(forward));
            let reach = [x - slope[0] * z, -x - slope[0] * z, y - slope[1] * z, -y - slope[1] * z];
            most = std::array::from_fn(|i| most[i].max(reach[i]));
            nearest = nearest.min(z);
        }
        if !nearest.is_finite() {
            (most, nearest) = ([1.0; 4], -1.0);
        }
        let back = |i: usize| -(most[2 * i] + most[2 * i + 1]) / (2.0 * slope[i]);
        // The nearest point stays half a unit away, even if the model is a single point.
        let z = back(0).min(back(1)).min(nearest - 0.5);
        let (x, y) = ((most[0] - most[1]) / 2.0, (most[2] - most[3]) / 2.0);
        let eye = right * x + down * y + forward * z;
        let turn = Mat3A::from_cols(right, down, forward).transpose();
        Self {
            eye,
            view: Affine3A { matrix3: turn, translation: -(turn * eye) },
            near: (nearest - z) * 0.99,
            right,
            down,
            forward,
            focal,
            center: [width / 2.0, height / 2.0],
        }
    }

    /// Returns the same camera for a model that extends nearer to it than the points that it was fitted to.
    pub(super) fn with_nearer_plane(self) -> Self {
        Self { near: self.near * 0.02, ..self }
    }

    /// Returns the distance of the near plane; points beyond it are visible.
    pub(super) fn near_plane(&self) -> f32 {
        self.near * 0.5
    }

    /// Returns the pixel coordinates of a point in the camera's axes, and its depth: below 0 in front of the nearest
    /// point, 1 at infinity. The depth of a plane is linear over the image. Returns NaN for a point behind the near
    /// plane.
    pub(super) fn project(&self, point: Vec3A) -> Vec3A {
        if point.z < self.near_plane() {
            return Vec3A::NAN;
        }
        let scale = 1.0 / point.z;
        let x = self.center[0] + point.x * self.focal * scale;
        let y = self.center[1] + point.y * self.focal * scale;
        Vec3A::new(x, y, 1.0 - self.near * scale)
    }

    /// Returns the size of a pixel at the distance of `position`, in the stage's units.
    pub(super) fn footprint(&self, position: Vec3A) -> f32 {
        (position - self.eye).dot(self.forward) / self.focal
    }

    /// Returns the direction, not of unit length, from the eye through pixel coordinates `x`, `y`.
    pub(super) fn ray(&self, x: f32, y: f32) -> Vec3A {
        let (x, y) = ((x - self.center[0]) / self.focal, (y - self.center[1]) / self.focal);
        self.forward + self.right * x + self.down * y
    }
}

#[cfg(test)]
mod tests {
    use super::super::stage::Stage;
    use super::super::{samples, view};
    use super::*;
    use crate::settings::Picture;

    #[test]
    fn all_corners_are_inside_and_the_model_touches_the_margin() {
        let scene = samples::twisted_tower(20);
        let stage = Stage::new(&scene).unwrap();
        for (size, azimuth, elevation) in
            [([640, 480], 150.0, 20.0), ([200, 800], 10.0, -30.0), ([900, 300], 280.0, 89.9)]
        {
            let picture =
                Picture { azimuth: Some(azimuth), elevation: Some(elevation), ..Picture::default() };
            let camera = Camera::fit(stage.points(), view::viewpoint(&stage.hull, &picture), size);
            let (mut low, mut high) = ([f32::MAX; 2], [f32::MIN; 2]);
            stage.each_triangle(
                0..stage.triangles() as u32,
                &camera.view,
                |p| camera.project(p),
                None,
                |_, triangle| {
                    for corner in triangle.corners {
                        for axis in 0..2 {
                            low[axis] = low[axis].min(corner[axis] / size[axis] as f32);
                            high[axis] = high[axis].max(corner[axis] / size[axis] as f32);
                        }
                    }
                },
            );
            assert!(low.iter().all(|x| *x > 0.055) && high.iter().all(|x| *x < 0.945), "{low:?} {high:?}");
            let filled = (high[0] - low[0]).max(high[1] - low[1]);
            assert!((filled - 0.88).abs() < 0.005, "the model fills {filled} of the picture");
        }
    }

    #[test]
    fn the_ray_through_a_projected_point_leads_to_it() {
        let scene = samples::twisted_tower(4);
        let stage = Stage::new(&scene).unwrap();
        let camera = Camera::fit(stage.points(), Viewpoint { azimuth: 1.0, elevation: 0.3 }, [300, 200]);
        let point = Vec3A::new(0.1, -0.2, 0.3);
        let pixel = camera.project(camera.view.transform_point3a(point));
        let ray = camera.ray(pixel.x, pixel.y).normalize();
        assert!(ray.dot((point - camera.eye).normalize()) > 0.999_999);
    }
}
