//! Default viewpoint, chosen from the shape of the model.

use super::super::settings::Picture;
use super::camera::Camera;
use super::points::spread;
use glam::{DMat3, DVec2, DVec3, Vec3A};

/// Maximum thickness of a flat vertical model, relative to its next larger extent.
const WALL: f64 = 0.15;
/// Maximum relative thickness of a flat horizontal model. A higher model has sides worth showing.
const PLAN: f64 = 0.02;
/// Maximum relative thickness of a model that is shown as a plan, such as a map.
const FLAT: f64 = 0.002;

/// Turns of the camera (degrees) among which the one that fills the image is found. They keep it 15 degrees away from a view
/// along an axis, in which a building shows one side only.
const AZIMUTHS: [f64; 8] = [0.0, -10.0, 10.0, 15.0, -20.0, -30.0, -40.0, -45.0];
/// Lifts of the camera (degrees).
const ELEVATIONS: [f64; 5] = [0.0, -5.0, 5.0, 10.0, 15.0];
/// Parts of the image that a degree of turn and of lift are worth.
const TURN: f64 = 0.001;
const LIFT: f64 = 0.005;
/// Heights relative to the width from which on the camera is lowered, and at which it is lowest.
const TALL: [f64; 2] = [1.5, 2.5];
/// Lowest elevation of the camera (degrees).
const LEVEL: f64 = 5.0;
/// Elevation (degrees) below which the camera is not lifted.
const LOW: f64 = 13.0;
/// Number of directions in which the outermost points are found.
const OUTERMOST: usize = 160;

/// Direction to the camera.
#[derive(Debug, Clone, Copy)]
pub(super) struct Viewpoint {
    /// Azimuth from north, clockwise (rad).
    pub azimuth: f64,
    /// Elevation above the horizon (rad).
    pub elevation: f64,
}

impl Viewpoint {
    /// Returns the unit vector towards the camera.
    pub(super) fn direction(self) -> DVec3 {
        let (sin, cos) = self.azimuth.sin_cos();
        DVec3::new(sin * self.elevation.cos(), cos * self.elevation.cos(), self.elevation.sin())
    }

    /// Returns the camera's axes: towards it, to its right, and up or down.
    pub(super) fn axes(self) -> [DVec3; 3] {
        let (sin, cos) = self.azimuth.sin_cos();
        let (toward, right) = (self.direction(), DVec3::new(-cos, sin, 0.0));
        [toward, right, toward.cross(right)]
    }
}

/// Returns the viewpoint that `picture` specifies. Unspecified angles are chosen to suit a model with this `hull`; if both
/// are, they are turned so that the model fills the image.
pub(super) fn viewpoint(hull: &[Vec3A], picture: &Picture) -> Viewpoint {
    let points: Vec<DVec3> = hull.iter().map(|point| point.as_dvec3()).collect();
    let (azimuth, elevation, is_solid) = suitable(&points);
    let given = Viewpoint {
        azimuth: picture.azimuth.unwrap_or(azimuth).to_radians(),
        elevation: picture.elevation.unwrap_or(elevation).to_radians(),
    };
    if !is_solid || picture.azimuth.is_some() || picture.elevation.is_some() || points.is_empty() {
        return given;
    }
    filling(hull, given, [picture.width, picture.height])
}

/// Returns the viewpoint near `given` from which a model with this `hull` fills most of an image of `size` (pixels).
fn filling(hull: &[Vec3A], given: Viewpoint, size: [u32; 2]) -> Viewpoint {
    let outermost: Vec<Vec3A> = (0..OUTERMOST)
        .filter_map(|i| {
            let direction = spread(i, OUTERMOST).as_vec3a();
            hull.iter().copied().max_by(|a, b| a.dot(direction).total_cmp(&b.dot(direction)))
        })
        .collect();
    // A tower fills more of the image from above, which is not how people see it.
    let is_level = given.elevation < LOW.to_radians();
    let lifts = ELEVATIONS.into_iter().filter(move |lift| *lift <= 0.0 || !is_level);
    let candidates = lifts.flat_map(|lift| AZIMUTHS.into_iter().map(move |turn| (turn, lift)));
    let mut best = (f64::NEG_INFINITY, given);
    for (turn, lift) in candidates {
        let eye = Viewpoint {
            azimuth: given.azimuth + turn.to_radians(),
            elevation: given.elevation + lift.to_radians(),
        };
        let camera = Camera::fit(outermost.iter().copied(), eye, size);
        let seen = outermost.iter().map(|point| camera.project(camera.view.transform_point3a(*point)));
        let area = outline_area(seen.map(|point| point.truncate().as_dvec2()).collect());
        let score =
            area / (f64::from(size[0]) * f64::from(size[1])) - TURN * f64::abs(turn) - LIFT * f64::abs(lift);
        if score > best.0 {
            best = (score, eye);
        }
    }
    best.1
}

/// Returns the area of the convex hull of `points`.
///
/// Method: Andrew, "Another efficient algorithm for convex hulls in two dimensions", 1979.
fn outline_area(mut points: Vec<DVec2>) -> f64 {
    points.retain(|point| point.is_finite());
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let chain = |points: &mut dyn Iterator<Item = DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for point in points {
            while let [.., a, b] = chain.as_slice()
                && (*b - *a).perp_dot(point - *a) <= 0.0
            {
                chain.pop();
            }
            chain.push(point);
        }
        chain
    };
    let mut ring = chain(&mut points.iter().copied());
    ring.extend(chain(&mut points.iter().rev().copied()));
    let next = ring.iter().cycle().skip(1);
    0.5 * ring.iter().zip(next).map(|(a, b)| a.perp_dot(*b)).sum::<f64>().abs()
}

/// Returns the azimuth and elevation (degrees) from which `points` are seen well, and true unless they are flat.
fn suitable(points: &[DVec3]) -> (f64, f64, bool) {
    let (normal, thickness, breadth) = thinnest(points);
    if thickness < WALL * breadth && normal.z.abs() < 0.5 {
        // A vertical curve or wall is shown from the front, slightly from the side to reveal its depth.
        let toward =
            if normal.y > 0.0 || (normal.y.abs() < 1e-6 && normal.x < 0.0) { -normal } else { normal };
        return (toward.x.atan2(toward.y).to_degrees().rem_euclid(360.0) - 12.0, 10.0, false);
    }
    if thickness < FLAT * breadth && normal.z.abs() > 0.9 {
        // A plan, with north at the top.
        return (180.0, 90.0, false);
    }
    if thickness < PLAN * breadth && normal.z.abs() > 0.9 {
        return (165.0, 58.0, true);
    }
    let extent = |axis: DVec3| reach(points, axis).1;
    let wide = extent(DVec3::X).max(extent(DVec3::Y)).max(1e-9);
    let slender = (extent(DVec3::Z) / wide).clamp(0.1, 3.0);
    // From 38 degrees for a low city to 22 for a cube.
    let elevation = 22.0 - 16.0 * slender.log10() * if slender < 1.0 { 1.0 } else { 1.05 };
    // A tower is seen from near its middle, almost level, because a high camera makes it look like a model on a table.
    let tall = ((slender - TALL[0]) / (TALL[1] - TALL[0])).clamp(0.0, 1.0);
    (150.0, elevation + (LEVEL - elevation) * tall, true)
}

/// Returns the direction of the smallest extent of `points`, that extent, and the next larger extent.
fn thinnest(points: &[DVec3]) -> (DVec3, f64, f64) {
    let axes = principal_axes(points);
    let mut extents: Vec<(f64, DVec3)> = axes.into_iter().map(|axis| (reach(points, axis).1, axis)).collect();
    extents.sort_by(|a, b| a.0.total_cmp(&b.0));
    (extents[0].1, extents[0].0, extents[1].0)
}

/// Returns the minimum coordinate of `points` along `axis`, and the distance to the maximum.
fn reach(points: &[DVec3], axis: DVec3) -> (f64, f64) {
    let (low, high) = points
        .iter()
        .map(|point| point.dot(axis))
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
    (low, (high - low).max(0.0))
}

/// Returns the eigenvectors of the points' covariance, computed by Jacobi rotations.
fn principal_axes(points: &[DVec3]) -> [DVec3; 3] {
    let mean = points.iter().sum::<DVec3>() / points.len().max(1) as f64;
    let mut matrix = DMat3::ZERO;
    for point in points {
        let d = *point - mean;
        matrix += DMat3::from_cols(d * d.x, d * d.y, d * d.z);
    }
    let mut axes = DMat3::IDENTITY;
    for (p, q) in [(0, 1), (0, 2), (1, 2)].into_iter().cycle().take(24) {
        let off = matrix.col(q)[p];
        let gap = matrix.col(q)[q] - matrix.col(p)[p];
        if off.abs() <= 1e-12 * (matrix.col(p)[p] + matrix.col(q)[q]).abs() {
            continue;
        }
        let angle = 0.5 * (2.0 * off).atan2(gap);
        let (sin, cos) = angle.sin_cos();
        let mut rotation = DMat3::IDENTITY;
        rotation.col_mut(p)[p] = cos;
        rotation.col_mut(q)[q] = cos;
        rotation.col_mut(p)[q] = -sin;
        rotation.col_mut(q)[p] = sin;
        matrix = rotation.transpose() * matrix * rotation;
        axes *= rotation;
    }
    [axes.x_axis, axes.y_axis, axes.z_axis]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(a: DVec3, b: DVec3, c: DVec3) -> Vec<DVec3> {
        let steps = |i: usize| i as f64 / 4.0 - 0.5;
        (0..125).map(|i| a * steps(i % 5) + b * steps(i / 5 % 5) + c * steps(i / 25)).collect()
    }

    #[test]
    fn a_standing_wall_is_seen_from_its_broad_side() {
        for turn in [0.0, 0.4, 0.8, 1.2, 2.0, 3.0] {
            let along = DVec3::new(f64::cos(turn), f64::sin(turn), 0.0);
            let points = grid(along * 4.0, DVec3::Z * 2.0, DVec3::ZERO);
            let (azimuth, elevation, _) = suitable(&points);
            let eye = Viewpoint { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() };
            assert!(eye.direction().cross(along).length() > 0.9, "turned by {turn}");
            assert!(elevation < 20.0);
        }
    }

    #[test]
    fn a_plan_is_seen_from_above_and_a_tower_from_the_side() {
        assert!(suitable(&grid(DVec3::X * 4.0, DVec3::Y * 3.0, DVec3::ZERO)).1 > 50.0);
        assert!(suitable(&grid(DVec3::X, DVec3::Y, DVec3::Z * 4.0)).1 < 8.0);
        assert!(suitable(&grid(DVec3::X * 8.0, DVec3::Y * 8.0, DVec3::Z * 2.0)).1 > 28.0);
    }

    #[test]
    fn a_model_twice_as_high_as_wide_is_seen_almost_level_in_any_image() {
        for height in [2.0, 3.0, 9.0] {
            let model: Vec<Vec3A> =
                grid(DVec3::X, DVec3::Y, DVec3::Z * height).iter().map(|point| point.as_vec3a()).collect();
            for (width, height) in [(640, 480), (480, 640), (300, 900)] {
                let elevation = viewpoint(&model, &Picture { width, height, ..Picture::default() }).elevation;
                assert!((0.0..13.0).contains(&elevation.to_degrees().round()), "{elevation}");
            }
        }
    }

    #[test]
    fn a_long_model_is_seen_along_its_length_so_that_it_fills_the_image() {
        let hull = |a, b, c| grid(a, b, c).iter().map(|point| point.as_vec3a()).collect::<Vec<_>>();
        let area = |hull: &[Vec3A], eye| {
            let camera = Camera::fit(hull.iter().copied(), eye, [640, 480]);
            let seen = hull.iter().map(|point| camera.project(camera.view.transform_point3a(*point)));
            outline_area(seen.map(|point| point.truncate().as_dvec2()).collect()) / (640.0 * 480.0)
        };
        for (model, least) in [
            (hull(DVec3::X * 8.0, DVec3::Y * 0.7, DVec3::Z * 0.8), 0.24),
            (hull(DVec3::X * 8.0, DVec3::Y * 8.0, DVec3::Z * 1.2), 0.55),
        ] {
            let picture = Picture { width: 640, height: 480, ..Picture::default() };
            let chosen = area(&model, viewpoint(&model, &picture));
            let (azimuth, elevation, _) = suitable(&model.iter().map(|p| p.as_dvec3()).collect::<Vec<_>>());
            let plain = Viewpoint { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() };
            let before = area(&model, plain);
            assert!(chosen > least && chosen > 1.1 * before, "{chosen} instead of {before}");
        }
    }

    #[test]
    fn the_area_of_an_outline_is_that_of_its_convex_hull() {
        let square: Vec<DVec2> = (0..49).map(|i| DVec2::new((i % 7) as f64, (i / 7) as f64)).collect();
        assert!((outline_area(square) - 36.0).abs() < 1e-9);
        assert_eq!(outline_area(vec![DVec2::ONE]), 0.0);
    }
}
