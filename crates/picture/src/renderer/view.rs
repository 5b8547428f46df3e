//! Default viewpoint, chosen from the shape of the model.

use super::super::settings::Picture;
use glam::{DMat3, DVec3, Vec3A};

/// Maximum thickness of a flat vertical model, relative to its next larger extent.
const WALL: f64 = 0.15;
/// Maximum relative thickness of a flat horizontal model. A higher model has sides worth showing.
const PLAN: f64 = 0.02;
/// Maximum relative thickness of a model that is shown as a plan, such as a map.
const FLAT: f64 = 0.002;

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

/// Returns the viewpoint that `picture` specifies. Unspecified angles are chosen to suit a model with this `hull`.
pub(super) fn viewpoint(hull: &[Vec3A], picture: &Picture) -> Viewpoint {
    let points: Vec<DVec3> = hull.iter().map(|point| point.as_dvec3()).collect();
    let (azimuth, elevation) = suitable(&points);
    Viewpoint {
        azimuth: picture.azimuth.unwrap_or(azimuth).to_radians(),
        elevation: picture.elevation.unwrap_or(elevation).to_radians(),
    }
}

/// Returns the azimuth and elevation (degrees) from which `points` are seen well.
fn suitable(points: &[DVec3]) -> (f64, f64) {
    let (normal, thickness, breadth) = thinnest(points);
    if thickness < WALL * breadth && normal.z.abs() < 0.5 {
        // A vertical curve or wall is shown from the front, slightly from the side to reveal its depth.
        let toward =
            if normal.y > 0.0 || (normal.y.abs() < 1e-6 && normal.x < 0.0) { -normal } else { normal };
        return (toward.x.atan2(toward.y).to_degrees().rem_euclid(360.0) - 12.0, 10.0);
    }
    if thickness < FLAT * breadth && normal.z.abs() > 0.9 {
        // A plan, with north at the top.
        return (180.0, 90.0);
    }
    if thickness < PLAN * breadth && normal.z.abs() > 0.9 {
        return (165.0, 58.0);
    }
    let extent = |axis: DVec3| reach(points, axis).1;
    let wide = extent(DVec3::X).max(extent(DVec3::Y)).max(1e-9);
    let slender = (extent(DVec3::Z) / wide).clamp(0.1, 3.0);
    // From 38 degrees for a low city to 22 for a cube and 14 for a tower.
    (150.0, 22.0 - 16.0 * slender.log10() * if slender < 1.0 { 1.0 } else { 1.05 })
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
            let (azimuth, elevation) = suitable(&points);
            let eye = Viewpoint { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() };
            assert!(eye.direction().cross(along).length() > 0.9, "turned by {turn}");
            assert!(elevation < 20.0);
        }
    }

    #[test]
    fn a_plan_is_seen_from_above_and_a_tower_from_the_side() {
        assert!(suitable(&grid(DVec3::X * 4.0, DVec3::Y * 3.0, DVec3::ZERO)).1 > 50.0);
        assert!(suitable(&grid(DVec3::X, DVec3::Y, DVec3::Z * 4.0)).1 < 16.0);
        assert!(suitable(&grid(DVec3::X * 8.0, DVec3::Y * 8.0, DVec3::Z * 2.0)).1 > 28.0);
    }
}
