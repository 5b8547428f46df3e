//! Points on shapes.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::random::Stream;
use glam::DVec3;

use crate::Shape;

/// Maximum number of points of one call.
const MOST_POINTS: usize = 1_000_000;
/// Maximum number of positions outside of a solid for each one inside.
const MOST_MISSES: usize = 10_000;

impl Shape {
    /// Returns `count` points (m) on the faces, uniformly distributed, with the normals there. The same seed gives the
    /// same points.
    ///
    /// Fails if the shape has no area, or for more than a million points.
    pub fn scatter(&self, count: usize, seed: u64) -> Result<Vec<(DVec3, DVec3)>> {
        check_count(count)?;
        let mesh = self.mesh();
        let (mut sums, mut corners, mut total) = (Vec::new(), Vec::new(), 0.0);
        for face in &mesh.faces {
            Stop::check_current()?;
            let normal = mesh.normal(face);
            for triangle in mesh.triangles(face)? {
                let [a, b, c] = triangle.map(|point| mesh.at(point));
                total += (b - a).cross(c - a).length();
                sums.push(total);
                corners.push(([a, b, c], normal));
            }
        }
        if total <= 0.0 {
            return Err(
                Error::argument("the shape has no area to scatter points on").help("use faces or a solid")
            );
        }
        Stop::check_current()?;
        let mut stream = Stream::new(seed);
        let mut draw = || stream.uniform();
        let points = (0..count).map(|_| {
            let at = draw() * total;
            let index = sums.partition_point(|sum| *sum <= at).min(sums.len() - 1);
            let ([a, b, c], normal) = corners[index];
            let (root, along) = (draw().sqrt(), draw());
            (a * (1.0 - root) + b * (root * (1.0 - along)) + c * (root * along), normal)
        });
        Ok(points.collect())
    }

    /// Returns `count` points (m) in a solid, uniformly distributed. The same seed gives the same points.
    ///
    /// Fails if the shape is open or so thin that it fills less than a ten-thousandth of its scope, and for more than a
    /// million points.
    pub fn scatter_inside(&self, count: usize, seed: u64) -> Result<Vec<DVec3>> {
        if !self.is_closed() {
            return Err(Error::argument("the shape is open, so it has no inside").help("extrude faces first"));
        }
        let is_box = matches!(self.body, crate::ShapeBody::Box(_));
        self.scatter_where(count, seed, |at| if is_box { Ok(true) } else { self.contains(at) })
    }

    /// Returns `count` points (m) in the scope, uniformly distributed. The same seed gives the same points.
    ///
    /// Fails for more than a million points.
    pub fn scatter_in_scope(&self, count: usize, seed: u64) -> Result<Vec<DVec3>> {
        self.scatter_where(count, seed, |_| Ok(true))
    }

    /// Returns points in the scope for which `keep` returns true.
    fn scatter_where(
        &self,
        count: usize,
        seed: u64,
        keep: impl Fn(DVec3) -> Result<bool>,
    ) -> Result<Vec<DVec3>> {
        check_count(count)?;
        let mut stream = Stream::new(seed);
        let mut points = Vec::with_capacity(count);
        let mut misses = 0;
        while points.len() < count {
            if (points.len() + misses).is_multiple_of(256) {
                Stop::check_current()?;
            }
            let local = DVec3::new(stream.uniform(), stream.uniform(), stream.uniform()) * self.scope().size;
            let at = self.scope().point(local);
            if keep(at)? {
                points.push(at);
            } else {
                misses += 1;
            }
            if misses > MOST_MISSES * (points.len() + 1) {
                return Err(Error::geometry("the solid fills less than a ten-thousandth of its scope")
                    .help("align its scope, shape:align(), or scatter points in its parts"));
            }
        }
        Ok(points)
    }
}

/// Fails for too many points.
fn check_count(count: usize) -> Result<()> {
    if count > MOST_POINTS {
        let message = format!("scatter makes at most {MOST_POINTS} points, not {count}");
        return Err(Error::limit(Limit::Size, message).help("call it for parts of the shape"));
    }
    burgeon_base::MemoryOwner::ensure_room(count * size_of::<DVec3>())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_in_a_solid_are_inside_and_uniform() {
        // A cone: a third of its points lie below the height that divides its volume so.
        let cone = Shape::cylinder(2.0, 0.0, 3.0, 32).expect("a cone");
        let points = cone.scatter_inside(3000, 7).expect("points");
        assert!(points.iter().all(|at| cone.contains(*at).expect("known")));
        let height = 3.0 * (1.0 - (2.0f64 / 3.0).cbrt());
        let low = points.iter().filter(|at| at.z < height).count();
        assert!((900..1100).contains(&low), "{low}");
        assert_eq!(points, cone.scatter_inside(3000, 7).expect("points"));
        assert!(Shape::rectangle(glam::DVec2::ONE).scatter_inside(1, 1).is_err());
        let scope = cone.scatter_in_scope(100, 1).expect("points");
        assert!(scope.iter().any(|at| !cone.contains(*at).expect("known")));
    }
}
