//! Points on shapes.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::random::Stream;
use glam::DVec3;

use crate::Shape;

/// Maximum number of points of one call.
const MOST_POINTS: usize = 1_000_000;

impl Shape {
    /// Returns `count` points (m) on the faces, uniformly distributed, with the normals there. The same seed gives the
    /// same points.
    ///
    /// Fails if the shape has no area, or for more than a million points.
    pub fn scatter(&self, count: usize, seed: u64) -> Result<Vec<(DVec3, DVec3)>> {
        if count > MOST_POINTS {
            let message = format!("scatter makes at most {MOST_POINTS} points, not {count}");
            return Err(Error::limit(Limit::Size, message).help("call it for parts of the shape"));
        }
        let mesh = self.mesh();
        let (mut sums, mut corners, mut total) = (Vec::new(), Vec::new(), 0.0);
        for face in &mesh.faces {
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
}
