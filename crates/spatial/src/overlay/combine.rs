//! The four set operations, by what lies in one geometry and in the other.
//!
//! Method: every piece of the arrangement, and every node of it, lies in a geometry or not, and so do the areas to both
//! sides of a piece. The operation says whether each is part of the result; of that, lines are what does not lie along
//! its areas, and points what does not lie on its lines.

use geo::bool_ops::OpType;
use geo::{Coord, MultiPolygon};
use glam::{DVec2, DVec3};

use super::areas;
use super::arrangement::{Arrangement, Piece, Way};
use super::inside::Inside;
use super::operand::Operand;
use crate::Geometry;
use crate::edges::with_heights;
use crate::plane::Plane;

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

    fn of_areas(self) -> OpType {
        match self {
            Self::Intersection => OpType::Intersection,
            Self::Union => OpType::Union,
            Self::Difference => OpType::Difference,
            Self::Symmetric => OpType::Xor,
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

/// With more edges than these the corners of areas stay on the grid of i_overlay, unless they were corners before.
const MANY: usize = 20_000;

fn combine(one: &Geometry, two: &Geometry, operation: Operation, dimension: usize) -> Geometry {
    let plane = Plane::of(&[one, two]);
    let operands = [Operand::new(plane, one), Operand::new(plane, two)];
    let [a, b] = &operands;
    let ways: Vec<Way> =
        operands.iter().zip([false, true]).flat_map(|(it, second)| it.ways(second)).collect();
    // Of areas alone only what they have in common may be less than an area.
    let is_of_areas = a.is_of_areas() && b.is_of_areas() && operation != Operation::Intersection;
    let arrangement =
        if is_of_areas && (two.is_empty() || ways.iter().map(|way| way.places.len()).sum::<usize>() > MANY) {
            None
        } else {
            let points: Vec<DVec2> = operands.iter().flat_map(|it| it.points.iter().copied()).collect();
            Some(Arrangement::new(&ways, &points, plane))
        };
    let coord = |at: &DVec2| Coord { x: at.x, y: at.y };
    let areas = match (&arrangement, a.areas.0.is_empty() && b.areas.0.is_empty()) {
        (_, true) => MultiPolygon::new(Vec::new()),
        (Some(arrangement), false) => {
            let nodes = arrangement.nodes.iter().map(coord);
            areas::combine(&a.areas, &b.areas, operation.of_areas(), nodes)
        }
        (None, false) => {
            let nodes = areas::corners(&a.areas).chain(areas::corners(&b.areas));
            areas::combine(&a.areas, &b.areas, operation.of_areas(), nodes)
        }
    };
    let mut parts = match plane.areas(&areas) {
        Geometry::Polygon(rings) if rings.is_empty() => Vec::new(),
        areas => vec![areas],
    };
    if let (Some(arrangement), false) = (&arrangement, is_of_areas) {
        let (lines, points) = lines_and_points(&operands, &ways, arrangement, operation);
        let back = |places: Vec<DVec2>| places.into_iter().map(|at| plane.back(at)).collect::<Vec<DVec3>>();
        parts.extend(lines.into_iter().map(|line| Geometry::Line(back(line))));
        parts.push(Geometry::MultiPoint(back(points)));
    }
    let made = Geometry::gathered(parts);
    if made.is_empty() { Geometry::empty(dimension) } else { with_heights(made, &[one, two]) }
}

/// The lines and points of the result that its areas have not.
fn lines_and_points(
    operands: &[Operand; 2],
    ways: &[Way],
    arrangement: &Arrangement,
    operation: Operation,
) -> (Vec<Vec<DVec2>>, Vec<DVec2>) {
    let inside = [0, 1].map(|index| Inside::new(&operands[index].areas));
    let coord = |at: DVec2| Coord { x: at.x, y: at.y };
    // By piece: whether it is a line of the result, and what lies in each geometry at it and beside it.
    let pieces: Vec<PieceLabel> = arrangement
        .pieces
        .iter()
        .map(|piece| {
            PieceLabel::new(piece, operation, |geometry| {
                let [from, to] = piece.nodes.map(|node| arrangement.nodes[node]);
                inside[geometry].holds(coord((from + to) / 2.0))
            })
        })
        .collect();
    // By node: whether it lies in each geometry, and whether the result has it already.
    let mut nodes = vec![NodeLabel::default(); arrangement.nodes.len()];
    for (piece, label) in arrangement.pieces.iter().zip(&pieces) {
        for node in piece.nodes {
            let node = &mut nodes[node];
            node.is_met = true;
            node.is_covered |= label.is_line || label.is_beside_area;
            (0..2).for_each(|geometry| node.is_in[geometry] |= label.is_in[geometry]);
        }
    }
    let first = operands[0].points.len();
    for (number, node) in arrangement.asked.iter().enumerate() {
        let at = coord(arrangement.nodes[*node]);
        let label = &mut nodes[*node];
        if !label.is_met {
            let areas = [0, 1].map(|geometry| inside[geometry].holds(at));
            label.is_covered |= operation.keeps(areas);
            (0..2).for_each(|geometry| label.is_in[geometry] |= areas[geometry]);
            label.is_met = true;
        }
        label.is_in[usize::from(number >= first)] = true;
    }
    let points = nodes
        .iter()
        .zip(&arrangement.nodes)
        .filter(|(node, _)| node.is_met && !node.is_covered && operation.keeps(node.is_in));
    let points = points.map(|(_, place)| *place).collect();
    (runs(arrangement, ways, &pieces), points)
}

/// What is known of a node.
#[derive(Debug, Clone, Copy, Default)]
struct NodeLabel {
    is_in: [bool; 2],
    /// Whether a line or an area of the result reaches it.
    is_covered: bool,
    is_met: bool,
}

/// What is known of a piece.
struct PieceLabel {
    /// By geometry: whether it lies in it, borders counted in.
    is_in: [bool; 2],
    /// Whether it is part of the lines of the result.
    is_line: bool,
    /// Whether an area of the result lies beside it.
    is_beside_area: bool,
}

impl PieceLabel {
    fn new(piece: &Piece, operation: Operation, holds: impl Fn(usize) -> bool) -> Self {
        // By geometry: whether its area lies to the left, and to the right.
        let sides = [0, 1].map(|geometry| match piece.ring[geometry] {
            [false, false] => [holds(geometry); 2],
            sides => sides,
        });
        let is_in = [0, 1].map(|geometry| piece.line[geometry] || sides[geometry].contains(&true));
        let is_beside_area = (0..2).any(|side| operation.keeps([sides[0][side], sides[1][side]]));
        Self { is_in, is_line: operation.keeps(is_in) && !is_beside_area, is_beside_area }
    }
}

/// The lines of the result: each as far as one way leads along pieces that are part of it.
fn runs(arrangement: &Arrangement, ways: &[Way], pieces: &[PieceLabel]) -> Vec<Vec<DVec2>> {
    let mut done = vec![false; pieces.len()];
    let mut lines: Vec<Vec<usize>> = Vec::new();
    for (walked, way) in arrangement.ways.iter().zip(ways) {
        let (begin, mut open) = (lines.len(), false);
        let mut first = false;
        for (number, (piece, forwards)) in walked.iter().enumerate() {
            let [mut from, mut to] = arrangement.pieces[*piece].nodes;
            if !forwards {
                (from, to) = (to, from);
            }
            let is_part = pieces[*piece].is_line && !std::mem::replace(&mut done[*piece], true);
            first |= is_part && number == 0;
            match lines.last_mut() {
                Some(line) if is_part && open => line.push(to),
                _ if is_part => lines.push(vec![from, to]),
                _ => {}
            }
            open = is_part;
        }
        // What ends where its ring began goes on there.
        if way.origin.ring
            && first
            && open
            && lines.len() > begin + 1
            && let Some(mut last) = lines.pop()
        {
            last.extend(lines[begin].iter().skip(1));
            lines[begin] = last;
        }
    }
    lines.into_iter().map(|line| line.into_iter().map(|node| arrangement.nodes[node]).collect()).collect()
}
