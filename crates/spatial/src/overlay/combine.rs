//! The four set operations, by what lies in one geometry and in the other.
//!
//! Method: every edge of the subdivision, and every node of it, lies in a geometry or not, and so do the areas to both
//! sides of an edge. The operation says whether each is part of the result; of that, lines are what does not lie along
//! its areas, and points what does not lie on its lines.

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
    /// Whether what lies in the first or in the second is part of the result.
    fn keeps(self, [first, second]: [bool; 2]) -> bool {
        match self {
            Self::Intersection => first && second,
            Self::Union => first || second,
            Self::Difference => first && !second,
            Self::Symmetric => first != second,
        }
    }
}

/// The set operations of OGC Simple Features, for geometries of any kinds.
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
    /// What both have in common: areas where they overlap, lines along which they touch, points in which they meet.
    /// Empty if they have nothing in common.
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

    /// What one of them has.
    pub fn union(&self, other: &Self) -> Self {
        combine(self, other, Operation::Union, self.dimension().max(other.dimension()))
    }

    /// What it has and the other one has not.
    pub fn difference(&self, other: &Self) -> Self {
        combine(self, other, Operation::Difference, self.dimension())
    }

    /// What one of them has and the other one has not.
    pub fn sym_difference(&self, other: &Self) -> Self {
        combine(self, other, Operation::Symmetric, self.dimension().max(other.dimension()))
    }

    /// Its areas, lines and points without what lies twice: areas that overlap become one.
    pub fn dissolved(&self) -> Self {
        self.union(&Self::default())
    }
}

/// The union of all of `geometries`: at once, which is faster than one by one.
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

/// The result of an operation; empty of the dimension if it has nothing, and once the work of this thread is to stop.
fn combine(one: &Geometry, two: &Geometry, operation: Operation, dimension: usize) -> Geometry {
    let operands = [one, two].map(Operand::for_overlay);
    let [a, b] = &operands;
    // Of areas alone only what they have in common may be less than an area.
    let made = if a.is_of_areas() && b.is_of_areas() && operation != Operation::Intersection {
        overlay(&area_of(&a.areas), &area_of(&b.areas), |is_in| operation.keeps(is_in))
            .map(|areas| geometry_of(&areas))
    } else {
        combine_all(&operands, operation)
    };
    let made = made.unwrap_or_default();
    if made.is_empty() { Geometry::empty(dimension) } else { with_heights(made, &[one, two]) }
}

/// The areas, lines and points of the result.
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

/// The nodes of the lines and points of the result that its areas have not.
fn lines_and_points(arranged: &OperandArrangement, operation: Operation) -> (Vec<Vec<u32>>, Vec<u32>) {
    let subdivision = &arranged.subdivision;
    let labels: Vec<EdgeLabel> =
        subdivision.edges.iter().map(|edge| EdgeLabel::new(edge, operation)).collect();
    // By node: whether it lies in each geometry, and whether the result has it already.
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

/// A node in the result.
#[derive(Debug, Clone, Copy, Default)]
struct NodeLabel {
    is_in: [bool; 2],
    /// Whether a line or an area of the result reaches it.
    is_covered: bool,
    is_met: bool,
}

/// An edge in the result.
struct EdgeLabel {
    /// By geometry: whether it lies in it, borders counted in.
    is_in: [bool; 2],
    /// Whether it is part of the lines of the result.
    is_line: bool,
    /// Whether an area of the result lies beside it.
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

/// The nodes along the lines of the result: each as far as one way leads along edges that are part of it.
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
        // A line that ends where its ring began goes on there.
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
