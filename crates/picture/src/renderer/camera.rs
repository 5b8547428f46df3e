//! Camera: fitted to the model or placed, in perspective or in parallel projection.

use super::view::Viewpoint;
use glam::{Affine3A, DVec3, Mat3A, Vec3A};

/// Margin on each side, as a fraction of the image size.
const MARGIN: f32 = 0.04;

/// Focal length in units of the image's longer side: a field of view of 32 degrees, as is common for buildings.
const FOCAL: f32 = 1.75;

/// Distance from a placed camera (stage units) up to which nothing is seen, at most.
const CLOSEST: f32 = 2e-4;

/// Height of the eyes of a standing person above the ground (m).
const EYES: f64 = 1.7;

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
    /// Pixels per unit, at a distance of 1 in perspective.
    focal: f32,
    center: [f32; 2],
    /// Depth of the model behind the nearest plane, in parallel projection.
    depth: Option<f32>,
}

impl Camera {
    /// Size of an image relative to the part between its margins.
    pub(super) const PADDED: f64 = 1.0 / (1.0 - 2.0 * MARGIN as f64);

    /// Fits a camera in direction `eye`, as near as possible with all of `points` in an image of `size` (pixels).
    pub(super) fn fit(points: impl Iterator<Item = Vec3A>, eye: Viewpoint, size: [u32; 2]) -> Self {
        Self::fit_field(points, eye, None, 0.5, size)
    }

    /// Fits a camera as [`fit`](Self::fit) does, with this vertical field of view (rad), at least at the distance `apart` from
    /// the nearest point.
    pub(super) fn fit_field(
        points: impl Iterator<Item = Vec3A>,
        eye: Viewpoint,
        fov: Option<f64>,
        apart: f32,
        size: [u32; 2],
    ) -> Self {
        let forward = -eye.direction();
        let (sin, cos) = eye.azimuth.sin_cos();
        let right = DVec3::new(-cos, sin, 0.0);
        let down = forward.cross(right).as_vec3a();
        let (right, forward) = (right.as_vec3a(), forward.as_vec3a());
        let (width, height) = (size[0] as f32, size[1] as f32);
        let focal = fov.map_or(FOCAL * width.max(height), |fov| focal_length(fov, size));
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
        // The nearest point stays apart, even if the model is a single point.
        let z = back(0).min(back(1)).min(nearest - apart);
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
            depth: None,
        }
    }

    /// Places a camera at `from` with `to` in the middle of the image and a vertical field of view (rad). `bounds` are the
    /// corners of the model's box.
    pub(super) fn between(from: DVec3, to: DVec3, fov: f64, bounds: (Vec3A, Vec3A), size: [u32; 2]) -> Self {
        let eye = from.as_vec3a();
        let outside = (eye - eye.clamp(bounds.0, bounds.1)).length();
        let focal = focal_length(fov, size);
        // At this distance, a point in a corner of the image is nearest along the view direction.
        let half = size.map(|side| side as f32 / 2.0);
        let corner = focal / Vec3A::new(half[0], half[1], focal).length();
        Self::along(eye, to - from, (outside * corner * 0.99).max(CLOSEST), focal, size)
    }

    /// Fits a parallel projection that looks along `forward` to `points`. If `middle` is given, it is the point in the
    /// middle of the image and the height that the image shows.
    pub(super) fn parallel(
        points: &[Vec3A],
        forward: DVec3,
        middle: Option<(DVec3, f64)>,
        size: [u32; 2],
    ) -> Self {
        let camera = Self::along(Vec3A::ZERO, forward, 1.0, 1.0, size);
        let turn = camera.view.matrix3;
        let (low, high) = points
            .iter()
            .map(|point| turn * *point)
            .fold(None, |bounds: Option<(Vec3A, Vec3A)>, p| {
                Some(bounds.map_or((p, p), |(low, high)| (low.min(p), high.max(p))))
            })
            .unwrap_or_default();
        let extent = (high - low).max(Vec3A::splat(1e-6));
        let [width, height] = size.map(|side| side as f32);
        let fitted = (width * (1.0 - 2.0 * MARGIN) / extent.x).min(height * (1.0 - 2.0 * MARGIN) / extent.y);
        let (center, focal) = match middle {
            Some((at, shown)) => (turn * at.as_vec3a(), height / shown.max(1e-9) as f32),
            None => ((low + high) / 2.0, fitted),
        };
        // The whole model is in front of the camera.
        let eye = turn.transpose() * center.with_z(low.z - 0.5);
        let depth = Some(extent.z * 1.01);
        Self { near: 0.5, focal, depth, ..Self::along(eye, forward, 0.5, focal, size) }
    }

    /// Fits a camera at the height of a person's eyes above the lowest of `points`, in the direction `azimuth` (rad).
    /// `metre` is the length of a metre on the stage.
    pub(super) fn at_eye_level(points: &[Vec3A], azimuth: f64, metre: f64, size: [u32; 2]) -> Self {
        let lowest = points.iter().map(|point| point.z).fold(f32::INFINITY, f32::min);
        let height = if lowest.is_finite() { lowest + (EYES * metre) as f32 } else { 0.0 };
        let fit = |elevation: f64| Self::fit(points.iter().copied(), Viewpoint { azimuth, elevation }, size);
        let (mut low, mut high) = (-0.7, 0.7);
        for _ in 0..24 {
            let middle = 0.5 * (low + high);
            match fit(middle).eye.z < height {
                true => low = middle,
                false => high = middle,
            }
        }
        fit(0.5 * (low + high))
    }

    /// Creates a camera at `eye` that looks along `forward`, which need not have unit length.
    fn along(eye: Vec3A, forward: DVec3, near: f32, focal: f32, size: [u32; 2]) -> Self {
        let forward = forward.normalize_or(DVec3::Y);
        // North is up if the camera looks down or up.
        let right = forward.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
        let down = forward.cross(right).as_vec3a();
        let (right, forward) = (right.as_vec3a(), forward.as_vec3a());
        let turn = Mat3A::from_cols(right, down, forward).transpose();
        let center = size.map(|side| side as f32 / 2.0);
        let view = Affine3A { matrix3: turn, translation: -(turn * eye) };
        Self { eye, view, near, right, down, forward, focal, center, depth: None }
    }

    /// Returns the direction from which the camera sees the model.
    pub(super) fn viewpoint(&self) -> Viewpoint {
        let back = -self.forward.as_dvec3();
        // A camera that looks down has the image's lower edge towards the viewer.
        let flat = if back.truncate().length() > 1e-6 { back } else { self.down.as_dvec3() };
        Viewpoint { azimuth: flat.x.atan2(flat.y), elevation: back.z.clamp(-1.0, 1.0).asin() }
    }

    /// Returns the unit vectors forward and up, and the height of the image: the vertical field of view (rad) in
    /// perspective, the shown height (stage units) in parallel projection.
    pub(super) fn axes(&self) -> (Vec3A, Vec3A, f32, bool) {
        let height = 2.0 * self.center[1] / self.focal;
        let shown = if self.is_parallel() { height } else { 2.0 * (0.5 * height).atan() };
        (self.forward, -self.down, shown, self.is_parallel())
    }

    /// Returns true for a parallel projection, whose depth is not that of a perspective.
    pub(super) fn is_parallel(&self) -> bool {
        self.depth.is_some()
    }

    /// Returns the slope of the planes beside the image at which triangles are clipped.
    pub(super) fn slope(&self) -> f32 {
        (1.3 * self.center[0].max(self.center[1]) / self.focal).max(1.0)
    }

    /// Returns the unit vector from `position` to the camera.
    pub(super) fn toward(&self, position: Vec3A) -> Vec3A {
        if self.is_parallel() { -self.forward } else { (self.eye - position).normalize_or(-self.forward) }
    }

    /// Returns the distance of `position` from the camera along the view direction.
    pub(super) fn distance(&self, position: Vec3A) -> f32 {
        (position - self.eye).dot(self.forward)
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
        if let Some(depth) = self.depth {
            let [x, y] = self.center;
            return Vec3A::new(
                x + point.x * self.focal,
                y + point.y * self.focal,
                (point.z - self.near) / depth,
            );
        }
        let scale = 1.0 / point.z;
        let x = self.center[0] + point.x * self.focal * scale;
        let y = self.center[1] + point.y * self.focal * scale;
        Vec3A::new(x, y, 1.0 - self.near * scale)
    }

    /// Returns the size of a pixel at the distance of `position`, in the stage's units.
    pub(super) fn footprint(&self, position: Vec3A) -> f32 {
        if self.is_parallel() { 1.0 / self.focal } else { self.distance(position) / self.focal }
    }

    /// Returns a point and the direction, not of unit length, of the line of sight through pixel coordinates `x`, `y`.
    pub(super) fn ray(&self, x: f32, y: f32) -> (Vec3A, Vec3A) {
        let (x, y) = ((x - self.center[0]) / self.focal, (y - self.center[1]) / self.focal);
        let aside = self.right * x + self.down * y;
        if self.is_parallel() { (self.eye + aside, self.forward) } else { (self.eye, self.forward + aside) }
    }
}

/// Returns the pixels per unit at a distance of 1, for a vertical field of view (rad) of an image of `size` (pixels).
fn focal_length(fov: f64, size: [u32; 2]) -> f32 {
    (0.5 * f64::from(size[1]) / (0.5 * fov).tan()) as f32
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
            assert!(low.iter().all(|x| *x > 0.035) && high.iter().all(|x| *x < 0.965), "{low:?} {high:?}");
            let filled = (high[0] - low[0]).max(high[1] - low[1]);
            assert!((filled - 0.92).abs() < 0.005, "the model fills {filled} of the picture");
        }
    }

    #[test]
    fn the_ray_through_a_projected_point_leads_to_it() {
        let scene = samples::twisted_tower(4);
        let stage = Stage::new(&scene).unwrap();
        let camera = Camera::fit(stage.points(), Viewpoint { azimuth: 1.0, elevation: 0.3 }, [300, 200]);
        let point = Vec3A::new(0.1, -0.2, 0.3);
        let pixel = camera.project(camera.view.transform_point3a(point));
        let ray = camera.ray(pixel.x, pixel.y).1.normalize();
        assert!(ray.dot((point - camera.eye).normalize()) > 0.999_999);
    }

    #[test]
    fn a_placed_camera_shows_its_point_in_the_middle_and_a_parallel_one_keeps_sizes() {
        let scene = samples::twisted_tower(4);
        let stage = Stage::new(&scene).unwrap();
        let (from, to) = (DVec3::new(3.0, -2.0, 1.0), DVec3::new(0.2, 0.1, -0.3));
        let points: Vec<Vec3A> = stage.points().collect();
        let placed = Camera::between(from, to, 0.8, stage.bounds, [300, 200]);
        let parallel = Camera::parallel(&points, to - from, Some((to, 0.5)), [300, 200]);
        for camera in [&placed, &parallel] {
            let middle = camera.project(camera.view.transform_point3a(to.as_vec3a()));
            assert!((middle.x - 150.0).abs() < 0.01 && (middle.y - 100.0).abs() < 0.01, "{middle}");
            let above = camera.project(camera.view.transform_point3a(to.as_vec3a() + Vec3A::Z * 0.01));
            assert!(above.y < middle.y && (above.x - middle.x).abs() < 1e-3);
            let (origin, direction) = camera.ray(above.x, above.y);
            let along = (to.as_vec3a() + Vec3A::Z * 0.01 - origin).normalize();
            assert!(direction.normalize().dot(along) > 0.999_99);
        }
        // The image of 200 pixels shows half a unit.
        let (_, up, shown, _) = parallel.axes();
        let top = parallel.project(parallel.view.transform_point3a(to.as_vec3a() + up * 0.25));
        assert!((shown - 0.5).abs() < 1e-6 && top.y.abs() < 0.01, "{shown} {top}");
        assert!((placed.axes().2 - 0.8).abs() < 1e-5);
    }

    #[test]
    fn what_is_beside_a_placed_camera_is_behind_its_nearest_plane() {
        let bounds = (Vec3A::new(-1.0, -0.1, -1.0), Vec3A::new(1.0, 0.1, 1.0));
        let from = DVec3::new(0.0, -1.0, 0.0);
        for turn in [-0.9_f64, -0.5, 0.0, 0.5, 0.9] {
            let to = from + DVec3::new(turn.sin(), turn.cos(), 0.0);
            let camera = Camera::between(from, to, 1.2, bounds, [320, 200]);
            for step in -100_i8..=100 {
                let point = camera.view.transform_point3a(Vec3A::new(f32::from(step) / 100.0, -0.1, 0.0));
                let pixel = camera.project(point);
                if point.z > 0.0 && (0.0..320.0).contains(&pixel.x) {
                    assert!(point.z >= camera.near, "{point} at {turn}");
                }
            }
        }
    }

    #[test]
    fn a_camera_at_eye_level_is_as_high_as_a_person_and_sees_the_model() {
        let scene = samples::twisted_tower(8);
        let stage = Stage::new(&scene).unwrap();
        let metre = stage.shrink.matrix3.x_axis.length();
        let points: Vec<Vec3A> = stage.points().collect();
        let camera = Camera::at_eye_level(&points, 2.5, metre, [300, 200]);
        let height = f64::from(camera.eye.z - stage.bounds.0.z) / metre;
        assert!((height - EYES).abs() < 0.1, "{height} m");
        for point in points {
            let pixel = camera.project(camera.view.transform_point3a(point));
            assert!((0.0..300.0).contains(&pixel.x) && (0.0..200.0).contains(&pixel.y), "{pixel}");
        }
    }

    #[test]
    fn a_plan_has_north_at_the_top() {
        let scene = samples::twisted_tower(2);
        let stage = Stage::new(&scene).unwrap();
        let points: Vec<Vec3A> = stage.points().collect();
        let camera = Camera::parallel(&points, DVec3::NEG_Z, None, [200, 200]);
        let pixel = |point: Vec3A| camera.project(camera.view.transform_point3a(point));
        assert!(pixel(Vec3A::Y).y < pixel(Vec3A::ZERO).y && pixel(Vec3A::X).x > pixel(Vec3A::ZERO).x);
    }
}
