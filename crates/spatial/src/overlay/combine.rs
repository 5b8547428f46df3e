//! The four set operations, based on membership in both geometries.
//!
//! Method: for every edge and node of the subdivision, and for the areas on both sides of an edge, membership
//! in each geometry is known. The operation decides which of these belong to the result. Edges of the result
//! that do not border its areas become lines, and nodes that its areas and lines do not cover become points.

use burgeon_base::error::Result;
use burgeon_geometry::overlay::{SubdivisionEdge, overlay};
use glam::DVec3;

use super::arranged::{OperandArrangement, key, sides};
use super::convert::{area_of, geometry_of};
use super::operand::Operand;
use crate::Geometry;
use crate::edges::with_heights;

/// A set operation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Operation {
    Intersection,
    Union,
    Difference,
    Symmetric,
}

impl Operation {
    /// Returns true if a point with this membership in both geometries belongs to the result.
    fn keeps(self, [first, second]: [bool; 2]) -> bool {
        match self {
            Self::Intersection => first && second,
            Self::Union => first || second,
            Self::Difference => first && !second,
            Self::Symmetric => first != second,
        }
    }
}

/// Set operations of OGC Simple Features, for geometries of any type.
///
/// ```
/// use burgeon_spatial::Geometry;
///
/// let lawn = Geometry::from_wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))")?;
/// let pond = Geometry::from_wkt("POLYGON ((6 2, 9 2, 9 5, 6 5, 6 2))")?;
/// let path = Geometry::from_wkt("LINESTRING (-5 4, 15 4)")?;
/// assert_eq!(lawn.difference(&pond).area(), 91.0);
/// assert_eq!(path.difference(&pond).length(), 17.0);
/// assert_eq!(path.intersection(&lawn).to_wkt(), "LINESTRING (0 4, 10 4)");
/// let house = Geometry::from_wkt("POLYGON ((10 3, 18 3, 18 12, 10 12, 10 3))")?;
/// assert_eq!(lawn.intersection(&house).to_wkt(), "LINESTRING (10 3, 10 10)");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
impl Geometry {
    /// Computes the intersection of both geometries: areas where they overlap, lines along which they touch,
    /// points in which they meet. Empty if they do not intersect.
    pub fn intersection(&self, other: &Self) -> Self {
        let apart = self
            .bounds()
            .zip(other.bounds())
            .is_none_or(|([a, b], [c, d])| !(a.cmple(d).all() && c.cmple(b).all()));
        if apart {
            return Self::empty(self.dimension().min(other.dimension()));
        }
        combine(self, other, Operation::Intersection, self.dimension().min(other.dimension()))
    }

    /// Computes the union of both geometries.
    pub fn union(&self, other: &Self) -> Self {
        combine(self, other, Operation::Union, self.dimension().max(other.dimension()))
    }

    /// Computes this geometry minus the other.
    pub fn difference(&self, other: &Self) -> Self {
        combine(self, other, Operation::Difference, self.dimension())
    }

    /// Computes the symmetric difference: the points of exactly one of both geometries.
    pub fn sym_difference(&self, other: &Self) -> Self {
        combine(self, other, Operation::Symmetric, self.dimension().max(other.dimension()))
    }

    /// Removes duplicates from the areas, lines and points: overlapping areas are merged.
    pub fn dissolved(&self) -> Self {
        self.union(&Self::default())
    }
}

/// Computes the union of all `geometries` at once, which is faster than pairwise unions.
///
/// ```
/// use burgeon_spatial::{Geometry, union_all};
///
/// let row = (0..10).map(|x| Geometry::from_wkt(&format!("POLYGON (({x} 0, {0} 0, {0} 5, {x} 5, {x} 0))", x + 1)));
/// let row = row.collect::<Result<Vec<_>, _>>()?;
/// assert_eq!(union_all(&row).area(), 50.0);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn union_all<'a>(geometries: impl IntoIterator<Item = &'a Geometry>) -> Geometry {
    Geometry::Collection(geometries.into_iter().filter(|it| it.is_sound()).cloned().collect()).dissolved()
}

/// Computes an operation; returns an empty geometry of `dimension` if the result is empty or if the work of
/// this thread is cancelled.
fn combine(one: &Geometry, two: &Geometry, operation: Operation, dimension: usize) -> Geometry {
    let operands = [one, two].map(Operand::for_overlay);
    let [a, b] = &operands;
    // Of all operations on two areas, only the intersection can have lines and points.
    let made = if a.is_of_areas() && b.is_of_areas() && operation != Operation::Intersection {
        overlay(&area_of(&a.areas), &area_of(&b.areas), |is_in| operation.keeps(is_in))
            .map(|areas| geometry_of(&areas))
    } else {
        combine_all(&operands, operation)
    };
    let made = made.unwrap_or_default();
    if made.is_empty() { Geometry::empty(dimension) } else { with_heights(made, &[one, two]) }
}

/// Computes the areas, lines and points of the result.
fn combine_all(operands: &[Operand; 2], operation: Operation) -> Result<Geometry> {
    let arranged = OperandArrangement::new(operands)?;
    let areas = arranged.subdivision.areas(|around| operation.keeps(around.map(|count| count != 0)));
    let (lines, points) = lines_and_points(&arranged, operation);
    let places = |nodes: Vec<u32>| -> Vec<DVec3> {
        nodes.into_iter().map(|node| arranged.subdivision.places[node as usize].extend(0.0)).collect()
    };
    let mut parts = vec![geometry_of(&areas)];
    parts.extend(lines.into_iter().map(|line| Geometry::Line(places(line))));
    parts.push(Geometry::MultiPoint(places(points)));
    Ok(Geometry::gathered(parts))
}

/// Returns the nodes of the lines and points of the result that its areas do not cover.
fn lines_and_points(arranged: &OperandArrangement, operation: Operation) -> (Vec<Vec<u32>>, Vec<u32>) {
    let subdivision = &arranged.subdivision;
    let labels: Vec<EdgeLabel> =
        subdivision.edges.iter().map(|edge| EdgeLabel::new(edge, operation)).collect();
    // Membership of each node in both geometries, and whether the result already covers it.
    let mut nodes = vec![NodeLabel::default(); subdivision.places.len()];
    for (edge, label) in subdivision.edges.iter().zip(&labels) {
        for node in edge.ends {
            let node = &mut nodes[node as usize];
            node.is_met = true;
            node.is_covered |= label.is_line || label.is_beside_area;
            (0..2).for_each(|geometry| node.is_in[geometry] |= label.is_in[geometry]);
        }
    }
    for (geometry, points) in arranged.points.iter().enumerate() {
        for node in points {
            let label = &mut nodes[*node as usize];
            if !label.is_met {
                let areas = subdivision.around(*node).map(|count| count != 0);
                label.is_covered |= operation.keeps(areas);
                label.is_in = areas;
                label.is_met = true;
            }
            label.is_in[geometry] = true;
        }
    }
    let is_point = |label: &NodeLabel| label.is_met && !label.is_covered && operation.keeps(label.is_in);
    let points = (0..).zip(&nodes).filter(|(_, label)| is_point(label)).map(|(node, _)| node).collect();
    (runs(arranged, &labels), points)
}

/// A node of the result.
#[derive(Debug, Clone, Copy, Default)]
struct NodeLabel {
    is_in: [bool; 2],
    /// Set if a line or an area of the result touches it.
    is_covered: bool,
    is_met: bool,
}

/// An edge of the result.
struct EdgeLabel {
    /// Membership in each geometry, including its border.
    is_in: [bool; 2],
    /// Set if the edge is part of the lines of the result.
    is_line: bool,
    /// Set if an area of the result borders the edge.
    is_beside_area: bool,
}

impl EdgeLabel {
    fn new(edge: &SubdivisionEdge, operation: Operation) -> Self {
        let sides = sides(edge);
        let is_in = [0, 1].map(|geometry| edge.line[geometry] || sides[geometry].contains(&true));
        let is_beside_area = (0..2).any(|side| operation.keeps([sides[0][side], sides[1][side]]));
        Self { is_in, is_line: operation.keeps(is_in) && !is_beside_area, is_beside_area }
    }
}

/// Returns the nodes along the lines of the result: maximal runs of edges of the result along one line or
/// ring.
fn runs(arranged: &OperandArrangement, labels: &[EdgeLabel]) -> Vec<Vec<u32>> {
    if !labels.iter().any(|label| label.is_line) {
        return Vec::new();
    }
    let edges = arranged.edges_by_nodes();
    let mut done = vec![false; labels.len()];
    let mut lines: Vec<Vec<u32>> = Vec::new();
    for way in &arranged.ways {
        let (begin, mut open) = (lines.len(), false);
        let mut first = false;
        for (number, pair) in way.nodes.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            let edge = edges.get(&key([from, to])).map(|edge| *edge as usize);
            let is_part =
                edge.is_some_and(|edge| labels[edge].is_line && !std::mem::replace(&mut done[edge], true));
            first |= is_part && number == 0;
            match lines.last_mut() {
                Some(line) if is_part && open => line.push(to),
                _ if is_part => lines.push(vec![from, to]),
                _ => {}
            }
            open = is_part;
        }
        // A line that ends at the start of its ring continues there.
        if way.is_ring
            && first
            && open
            && lines.len() > begin + 1
            && let Some(mut last) = lines.pop()
        {
            last.extend(lines[begin].iter().skip(1));
            lines[begin] = last;
        }
    }
    lines
}
