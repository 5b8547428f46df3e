//! A spatial index of lines that finds the nearest line: `streets` in scripts.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rstar::primitives::Line as Piece;
use rstar::{PointDistance, RTree};

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Line;
use burgeon_kit::{Expectation, fields, methods, object};
use burgeon_kit::{Parameter, Value, Vector, Warn};
use burgeon_spatial::Lines;

/// Maximum distance (m) between a street and an edge that faces it.
const FARTHEST: f64 = 300.0;
/// Cosine of the maximum angle (60 degrees) between the outward normal of an edge and the direction to its street.
const FACING: f64 = 0.5;
/// Maximum number of street segments that are tested for one edge.
const TRIES: usize = 64;

/// Fields of `streets(source)`.
#[fields("streets")]
pub struct LineIndexOptions {
    /// Street lines (m): a source, or lists of points.
    pub lines: Lines,
}

/// Streets, with which footprints find their edges on a street.
///
/// They are lines on the ground, indexed by position.
#[object(
    "streets",
    can(Warn),
    options = LineIndexOptions,
    first = "lines",
    example = include_str!("../scripts/streets.lua"),
)]
pub struct LineIndex {
    pieces: Arc<RTree<Piece<[f64; 2]>>>,
    warnings: Vec<Warning>,
}

impl fmt::Debug for LineIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "streets of {} segments", self.pieces.size())
    }
}

#[methods("streets")]
impl LineIndex {
    /// Returns the distance (m) from a position on the ground to the nearest street, or infinity if there are no
    /// streets.
    pub fn distance(&self, place: Vector) -> f64 {
        let place = place.0.truncate().to_array();
        let nearest = self.pieces.nearest_neighbor(&place);
        nearest.map_or(f64::INFINITY, |piece| piece.distance_2(&place).sqrt())
    }
}

impl LineIndex {
    /// Creates the index of the lines that a script specifies.
    pub fn new(options: LineIndexOptions) -> Result<Self> {
        let Lines { lines, refused } = options.lines;
        let mut index = Self::of_lines(&lines);
        if let Some((count, first)) = refused {
            let items = if count == 1 { "item" } else { "items" };
            let text = format!("streets: skipped {count} {items} of the list: {first}");
            let warning = Warning::new(WarningKind::Data, text);
            index.warnings.push(warning.help("give lines of points with finite coordinates in metres"));
        }
        Ok(index)
    }

    /// Creates the index of `lines` (m).
    ///
    /// ```
    /// use burgeon_geometry::Line;
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::LineIndex;
    /// use glam::DVec3;
    ///
    /// let street = Line::new(vec![DVec3::ZERO, DVec3::new(100.0, 0.0, 0.0)])?;
    /// let streets = LineIndex::of_lines(&[street]);
    /// assert_eq!(streets.distance(Vector(DVec3::new(40.0, 7.0, 0.0))), 7.0);
    /// assert_eq!(LineIndex::of_lines(&[]).distance(Vector(DVec3::ZERO)), f64::INFINITY);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn of_lines(lines: &[Line<DVec3>]) -> Self {
        let pieces = lines.iter().flat_map(Line::edges).filter_map(|edge| {
            let [from, to] = edge.map(DVec3::truncate);
            // A vertical segment has no nearest point.
            (from.distance_squared(to) > 0.0).then(|| Piece::new(from.to_array(), to.to_array()))
        });
        Self { pieces: Arc::new(RTree::bulk_load(pieces.collect())), warnings: Vec::new() }
    }

    /// Returns the distance (m) from the middle of the edge from `a` to `b`, whose right side faces outwards, to the
    /// nearest street that the edge faces, or `None` if it is farther than `most`.
    pub(super) fn facing_distance(&self, a: DVec2, b: DVec2, most: f64) -> Option<f64> {
        let (middle, out) = (a.midpoint(b), -(b - a).try_normalize()?.perp());
        let most = most.min(FARTHEST);
        let near = self.pieces.nearest_neighbor_iter_with_distance_2(&middle.to_array());
        let mut near = near.take(TRIES).take_while(|(_, squared)| *squared <= most * most);
        near.find_map(|(piece, squared)| {
            let to = DVec2::from(piece.nearest_point(&middle.to_array())) - middle;
            let distance = squared.sqrt();
            (distance < 1e-9 || to.dot(out) >= FACING * distance).then_some(distance)
        })
    }
}

impl Parameter for LineIndex {
    fn luau() -> String {
        "Streets".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        object(value, "streets, created once before: streets(source)").map(Arc::unwrap_or_clone)
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Warn for LineIndex {
    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}
