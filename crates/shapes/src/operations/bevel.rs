//! Chamfers and fillets along convex edges.

use burgeon_base::error::{Error, ErrorKind, Result};
use glam::{DMat3, DVec2, DVec3};

use crate::{EdgeKind, Scope, Selector, Shape, SolidOperation};

/// Largest number of edges of one call.
const MOST_EDGES: usize = 2000;

impl Shape {
    /// Returns a solid whose convex edges are cut off by planes that begin at `distance` (m) from the edge on both faces;
    /// with `segments` above 0, rounded by arcs of as many segments that touch the faces there. Also returns the number
    /// of edges that could not be cut.
    ///
    /// `kinds` selects edges; all convex edges unless given. Fails if the shape is open.
    pub fn bevel(&self, distance: f64, segments: u32, kinds: Option<&[EdgeKind]>) -> Result<(Self, usize)> {
        if !(distance > 0.0 && distance.is_finite()) || segments > 64 {
            return Err(Error::argument(format!("a bevel of {distance} m with {segments} segments"))
                .help("use a distance above 0, and at most 64 segments"));
        }
        if !self.is_closed() {
            return Err(Error::geometry("only solids have edges to cut off").help("extrude the faces first"));
        }
        let edges = self.edges(kinds);
        if edges.len() > MOST_EDGES {
            return Err(Error::argument(format!("the solid has {} edges", edges.len()))
                .help(format!("cut off at most {MOST_EDGES}, such as those of one kind")));
        }
        let faces: Vec<(DVec3, DVec3)> =
            self.faces(&Selector::All)?.iter().map(|face| (face.normal(), face.centroid())).collect();
        let (mut solid, mut failed) = (self.clone(), 0);
        for edge in &edges {
            burgeon_base::Stop::check_current()?;
            let Some(wedge) = wedge(edge, &faces, self, distance, segments)? else { continue };
            match solid.combine(&wedge, SolidOperation::Difference) {
                Ok(Some(cut)) => solid = cut,
                Ok(None) => failed += 1,
                Err(error) if *error.kind() == ErrorKind::Geometry => failed += 1,
                Err(error) => return Err(error),
            }
        }
        let style = |style: &crate::SharedStyle| crate::FaceStyle::without_tags(style, "bool");
        Ok((solid.with_styles(style).recompose()?, failed))
    }
}

/// Returns the prism that is cut off along an edge; `None` for a concave edge.
fn wedge(
    edge: &Shape,
    faces: &[(DVec3, DVec3)],
    solid: &Shape,
    distance: f64,
    segments: u32,
) -> Result<Option<Shape>> {
    let scope = &edge.scope;
    let along = scope.axes.x_axis;
    let middle = scope.point(scope.size / 2.0);
    // The two faces at the edge.
    let is_at = |(normal, center): &&(DVec3, DVec3)| {
        normal.dot(middle - *center).abs() < 1e-6 && normal.dot(along).abs() < 1e-6
    };
    let near: Vec<DVec3> = faces.iter().filter(is_at).map(|(normal, _)| *normal).collect();
    let up = scope.axes.z_axis;
    let best = |left: bool| {
        let side = along.cross(up) * if left { -1.0 } else { 1.0 };
        let matching = near.iter().copied().filter(|normal| normal.dot(side) > 1e-6);
        matching.max_by(|a, b| a.dot(up).total_cmp(&b.dot(up)))
    };
    let (Some(one), Some(two)) = (best(false), best(true)) else { return Ok(None) };
    let out = (one + two).normalize_or_zero();
    // Inside of a convex edge lies the solid; inside of a concave one as well, but so do the other sides.
    if solid.contains(middle + out * 1e-4)? || !solid.contains(middle - out * 1e-4)? {
        return Ok(None);
    }
    let away =
        |normal: DVec3, other: DVec3| -> DVec3 { (normal * normal.dot(other) - other).normalize_or_zero() };
    let (first, second) = (away(one, two), away(two, one));
    // Coordinates across the edge: to the right and outwards.
    let right = out.cross(along);
    let flat = |vector: DVec3| DVec2::new(vector.dot(right), vector.dot(out));
    let (a, b) = (flat(first * distance), flat(second * distance));
    let beyond = (a - b) * 0.2;
    let mut ring = vec![
        a + beyond,
        DVec2::Y * (2.0 * distance) + beyond,
        DVec2::Y * (2.0 * distance) - beyond,
        b - beyond,
    ];
    if segments > 0 {
        ring.push(b);
        // The centre of the arc lies on the normals through both ends.
        let half = first.angle_between(second) / 2.0;
        let (radius, center) = (distance * half.tan(), DVec2::NEG_Y * (distance / half.cos()));
        let (from, to) = ((b - center).to_angle(), (a - center).to_angle());
        let mut turn = to - from;
        turn -= std::f64::consts::TAU * (turn / std::f64::consts::TAU).round();
        for step in 1..segments {
            ring.push(
                center + DVec2::from_angle(from + turn * f64::from(step) / f64::from(segments)) * radius,
            );
        }
        ring.push(a);
    }
    let start = scope.origin - along * distance;
    let frame =
        Scope { origin: start, axes: DMat3::from_cols(right, out, right.cross(out)), size: DVec3::ZERO };
    let Ok(polygon) = burgeon_geometry::Polygon::turned(burgeon_geometry::Rings(vec![ring])) else {
        return Ok(None);
    };
    let face = Shape::of_polygon(&polygon, &frame, &None);
    let length = scope.size.x + 2.0 * distance;
    face.extrude(length, Some(along)).map(Some)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chamfered_upright_edge_loses_a_triangular_prism() {
        let block = Shape::cuboid(DVec3::new(4.0, 3.0, 5.0));
        let (cut, failed) = block.bevel(0.5, 0, Some(&[EdgeKind::Corner])).expect("a solid");
        assert_eq!(failed, 0);
        assert!((cut.volume() - (60.0 - 4.0 * 0.125 * 5.0)).abs() < 1e-6, "{}", cut.volume());
        assert!(cut.is_closed() && cut.body.faces() == 10, "{}", cut.body.faces());
    }

    #[test]
    fn all_edges_of_a_box_can_be_rounded() {
        let block = Shape::cuboid(DVec3::splat(2.0));
        let (round, failed) = block.bevel(0.3, 4, None).expect("a solid");
        assert_eq!(failed, 0);
        assert!(round.is_closed() && round.volume() < 8.0 && round.volume() > 7.2, "{}", round.volume());
    }
}
