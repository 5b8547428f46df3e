//! Distances and contacts between shapes.

use burgeon_base::Stop;
use burgeon_base::error::{Error, Result};
use burgeon_geometry::ClosedMesh;
use burgeon_scene::nearest_on_triangle;
use glam::DVec3;

use crate::{Shape, ShapeBody, SolidOperation};

/// Distance (m) within which shapes touch, and above which they overlap.
const CONTACT: f64 = 1e-5;
/// Number of pairs of triangles between two checks for cancellation.
const STRETCH: usize = 1 << 16;

/// BoundedTriangles of a shape with their bounding boxes.
struct BoundedTriangles(Vec<([DVec3; 3], [DVec3; 2])>);

impl Shape {
    /// Returns true if a position (m) is inside the solid. Fails if the shape is open.
    pub fn contains(&self, place: DVec3) -> Result<bool> {
        if let ShapeBody::Box(_) = self.body {
            let local = self.scope().local(place);
            return Ok(local.cmpge(DVec3::ZERO).all() && local.cmple(self.scope().size).all());
        }
        Ok(self.closed_mesh()?.contains(place))
    }

    /// Returns true if a whole solid is inside this one, and the distance (m) by which this one was moved, because the set
    /// operation fails numerically without it. Fails if a shape is open.
    pub fn contains_solid(&self, other: &Self) -> Result<(bool, f64)> {
        let rest = other.combine(self, SolidOperation::Difference)?;
        Ok((rest.leaves_less_than(self.area().min(other.area())), rest.shift))
    }

    /// Returns the distance (m) from a position to the nearest point of the faces, or of the edge; 0 inside a solid.
    pub fn distance_to_place(&self, place: DVec3) -> Result<f64> {
        if let ShapeBody::Edge(..) = self.body {
            let along = self.scope().local(place).x.clamp(0.0, self.scope().size.x);
            return Ok(place.distance(self.scope().point(DVec3::X * along)));
        }
        if self.is_closed() && self.contains(place)? {
            return Ok(0.0);
        }
        let distance =
            |(corners, _): &([DVec3; 3], [DVec3; 2])| nearest_on_triangle(place, *corners).distance(place);
        Ok(self.triangle_list()?.0.iter().map(distance).fold(f64::INFINITY, f64::min))
    }

    /// Returns the distance (m) between the faces of two shapes; 0 if they touch or overlap.
    pub fn distance(&self, other: &Self) -> Result<f64> {
        if self.overlaps(other)? {
            return Ok(0.0);
        }
        let (own, others) = (self.triangle_list()?, other.triangle_list()?);
        let mut least = f64::INFINITY;
        for (number, (one, bounds)) in own.0.iter().enumerate() {
            if (number * others.0.len()) % STRETCH < others.0.len() {
                Stop::check_current()?;
            }
            for (two, other_bounds) in &others.0 {
                if box_distance(bounds, other_bounds) < least {
                    least = least.min(triangle_distance(one, two));
                }
            }
        }
        Ok(least)
    }

    /// Returns true if two shapes touch without overlapping, or with surfaces that meet within 10 µm.
    pub fn touches(&self, other: &Self) -> Result<bool> {
        Ok(!self.overlaps(other)? && self.distance(other)? <= CONTACT)
    }

    /// Returns true if the interiors of two solids, or the faces of open shapes, intersect by more than 10 µm.
    pub fn overlaps(&self, other: &Self) -> Result<bool> {
        if self.is_apart(other) {
            return Ok(false);
        }
        if let (ShapeBody::Box(_), ShapeBody::Box(_)) = (&self.body, &other.body) {
            return Ok(boxes_overlap(self, other));
        }
        let (own, others) = (self.triangle_list()?, other.triangle_list()?);
        for (number, (one, bounds)) in own.0.iter().enumerate() {
            if (number * others.0.len()) % STRETCH < others.0.len() {
                Stop::check_current()?;
            }
            for (two, other_bounds) in &others.0 {
                if box_distance(bounds, other_bounds) <= 0.0 && (passes(one, two) || passes(two, one)) {
                    return Ok(true);
                }
            }
        }
        // Without crossing surfaces, one solid is inside the other, or they share faces.
        Ok(self.has_point_inside(other)? || other.has_point_inside(self)?)
    }

    /// Returns true if the line between two positions (m) passes through the solid or a face of it, by more than 10 µm inside.
    pub fn blocks(&self, from: DVec3, to: DVec3) -> Result<bool> {
        if let ShapeBody::Box(_) = self.body {
            return Ok(box_blocks(self, from, to));
        }
        let crosses = |(corners, _): &([DVec3; 3], [DVec3; 2])| passes(&[from, to, to], corners);
        Ok(self.triangle_list()?.0.iter().any(crosses)
            || (self.is_closed() && self.contains(from.midpoint(to))?))
    }

    /// Returns true if a point just inside of a face of this solid is inside of the other.
    fn has_point_inside(&self, other: &Self) -> Result<bool> {
        if !self.is_closed() || !other.is_closed() {
            return Ok(false);
        }
        let solid = other.closed_mesh()?;
        for ([a, b, c], _) in self.triangle_list()?.0 {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            if solid.contains((a + b + c) / 3.0 - normal * (2.0 * CONTACT)) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn closed_mesh(&self) -> Result<ClosedMesh> {
        if !self.is_closed() {
            return Err(
                Error::geometry("the shape is open, so it has no inside").help("extrude its faces first")
            );
        }
        ClosedMesh::new(self.triangle_list()?.0.into_iter().map(|(corners, _)| corners).collect())
    }

    fn triangle_list(&self) -> Result<BoundedTriangles> {
        let mesh = self.mesh();
        let mut all = Vec::new();
        for face in &mesh.faces {
            all.extend(mesh.triangles(face)?.into_iter().map(|corners| {
                let [a, b, c] = corners.map(|corner| mesh.at(corner));
                ([a, b, c], [a.min(b).min(c), a.max(b).max(c)])
            }));
        }
        Ok(BoundedTriangles(all))
    }
}

/// Returns the distance (m) between two boxes along the world's axes.
fn box_distance([low, high]: &[DVec3; 2], [other_low, other_high]: &[DVec3; 2]) -> f64 {
    (*other_low - *high).max(*low - *other_high).max(DVec3::ZERO).length()
}

/// Returns true if no axis separates two boxes by more than the contact distance.
///
/// Method: the separating axis theorem: the axes of both boxes and their cross products.
fn boxes_overlap(one: &Shape, two: &Shape) -> bool {
    let axes = |shape: &Shape| [0, 1, 2].map(|axis| shape.scope().axes.col(axis));
    let (own, others) = (axes(one), axes(two));
    let crossed = own.iter().flat_map(|a| others.iter().map(|b| a.cross(*b)));
    let offset = two.scope().center() - one.scope().center();
    let half = |shape: &Shape, axes: &[DVec3; 3], along: DVec3| -> f64 {
        (0..3).map(|axis| axes[axis].dot(along).abs() * shape.scope().size[axis] / 2.0).sum()
    };
    own.iter()
        .chain(&others)
        .copied()
        .chain(crossed)
        .filter_map(DVec3::try_normalize)
        .all(|along| offset.dot(along).abs() < half(one, &own, along) + half(two, &others, along) - CONTACT)
}

/// Returns true if the line between two positions is inside of a box for more than the contact distance.
///
/// Method: intersection of the parameter intervals between opposite planes.
fn box_blocks(shape: &Shape, from: DVec3, to: DVec3) -> bool {
    let (begin, end) = (shape.scope().local(from), shape.scope().local(to));
    let along = end - begin;
    let (mut first, mut last) = (0.0_f64, 1.0_f64);
    for axis in 0..3 {
        let (low, high) = (CONTACT, shape.scope().size[axis] - CONTACT);
        if along[axis].abs() < 1e-12 {
            if begin[axis] < low || begin[axis] > high {
                return false;
            }
            continue;
        }
        let [one, two] = [low, high].map(|plane| (plane - begin[axis]) / along[axis]);
        first = first.max(one.min(two));
        last = last.min(one.max(two));
    }
    (last - first) * along.length() > 0.0
}

/// Returns true if an edge of `one` passes through `other` by more than the contact distance.
fn passes(one: &[DVec3; 3], other: &[DVec3; 3]) -> bool {
    let normal = (other[1] - other[0]).cross(other[2] - other[0]).normalize_or_zero();
    (0..3).any(|side| {
        let (a, b) = (one[side], one[(side + 1) % 3]);
        let [from, to] = [a, b].map(|at| normal.dot(at - other[0]));
        if from.min(to) > -CONTACT || from.max(to) < CONTACT {
            return false;
        }
        let at = a.lerp(b, from / (from - to));
        (0..3).all(|side| {
            let (begin, end) = (other[side], other[(side + 1) % 3]);
            normal.cross(end - begin).normalize_or_zero().dot(at - begin) > CONTACT
        })
    })
}

/// Returns the distance (m) between two triangles that do not cross.
fn triangle_distance(one: &[DVec3; 3], two: &[DVec3; 3]) -> f64 {
    let corners = one
        .iter()
        .map(|at| nearest_on_triangle(*at, *two).distance(*at))
        .chain(two.iter().map(|at| nearest_on_triangle(*at, *one).distance(*at)));
    let edges = |corners: &[DVec3; 3]| [0, 1, 2].map(|side| [corners[side], corners[(side + 1) % 3]]);
    let (own, others) = (edges(one), edges(two));
    let pairs = own.iter().flat_map(|a| others.iter().map(|b| edge_distance(*a, *b)));
    corners.chain(pairs).fold(f64::INFINITY, f64::min)
}

/// Returns the distance (m) between two segments.
///
/// Method: C. Ericson, "Real-Time Collision Detection", 2005, section 5.1.9.
fn edge_distance([a, b]: [DVec3; 2], [c, d]: [DVec3; 2]) -> f64 {
    let (along, other, between) = (b - a, d - c, a - c);
    let (squared, other_squared) = (along.length_squared(), other.length_squared());
    let (down, across, towards) = (other.dot(between), along.dot(other), along.dot(between));
    let spread = squared * other_squared - across * across;
    let mut way = if spread > 1e-18 * squared * other_squared {
        ((across * down - towards * other_squared) / spread).clamp(0.0, 1.0)
    } else {
        0.0
    };
    let mut other_way = (across * way + down) / other_squared;
    if other_way < 0.0 || other_way.is_nan() {
        other_way = 0.0;
        way = (-towards / squared).clamp(0.0, 1.0);
    } else if other_way > 1.0 {
        other_way = 1.0;
        way = ((across - towards) / squared).clamp(0.0, 1.0);
    }
    (a + along * way).distance(c + other * other_way)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_that_share_a_face_touch_and_do_not_overlap() {
        let one = Shape::cuboid(DVec3::splat(2.0));
        for (offset, overlaps, touches, distance) in [
            (DVec3::X * 2.0, false, true, 0.0),
            (DVec3::X * 1.9, true, false, 0.0),
            (DVec3::new(5.0, 6.0, 0.0), false, false, 5.0),
            (DVec3::ZERO, true, false, 0.0),
        ] {
            let two = one.translate(offset);
            // The same box as a mesh.
            let mesh = Shape::of_mesh(two.mesh().into_owned(), glam::DMat3::IDENTITY);
            for two in [two, mesh] {
                assert_eq!(one.overlaps(&two).expect("solids"), overlaps, "{offset}");
                assert_eq!(one.touches(&two).expect("solids"), touches, "{offset}");
                let found = one.distance(&two).expect("solids");
                assert!((found - distance).abs() < 1e-9, "{offset}: {found}");
            }
        }
    }

    #[test]
    fn a_line_is_blocked_by_a_solid_that_it_passes_through() {
        let one = Shape::cuboid(DVec3::splat(2.0));
        let mesh = Shape::of_mesh(one.mesh().into_owned(), glam::DMat3::IDENTITY);
        for shape in [one, mesh] {
            for (from, to, blocked) in [
                ([-1.0, 1.0, 0.9], [3.0, 1.0, 0.8], true),
                ([-1.0, 1.0, 0.9], [0.0, 1.0, 0.8], false),
                ([-1.0, 3.0, 1.0], [3.0, 3.0, 1.0], false),
                ([-1.0, 0.5, 2.0], [3.0, 0.7, 2.0], false),
                ([0.5, 0.5, 0.5], [1.5, 1.2, 1.5], true),
                ([-1.0, -1.0, -1.0], [3.0, 2.9, 2.8], true),
            ] {
                let found = shape.blocks(from.into(), to.into()).expect("a solid");
                assert_eq!(found, blocked, "{from:?} to {to:?}");
            }
        }
    }

    #[test]
    fn a_solid_inside_another_overlaps_it() {
        let outer = Shape::sphere(4.0, 16).expect("a sphere");
        let inner = Shape::sphere(1.0, 12).expect("a sphere");
        assert!(outer.overlaps(&inner).expect("solids") && inner.overlaps(&outer).expect("solids"));
        assert!(!outer.overlaps(&inner.translate(DVec3::X * 6.0)).expect("solids"));
        assert!(
            outer.contains(DVec3::X).expect("closed") && !outer.contains(DVec3::X * 5.0).expect("closed")
        );
    }
}
