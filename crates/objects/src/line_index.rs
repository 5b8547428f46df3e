//! An index of lines, for those who ask which way the nearest one lies: `streets` in scripts.

use std::fmt;
use std::sync::Arc;

use glam::{DVec2, DVec3};
use rstar::primitives::Line as Piece;
use rstar::{PointDistance, RTree};

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Line;
use burgeon_kit::{Expectation, fields, methods, object};
use burgeon_kit::{Lines, Parameter, Value, Vector, Warn};

/// The farthest (m) that a street lies from what faces it.
const FARTHEST: f64 = 300.0;
/// The cosine of the greatest angle (60 degrees) between the way an edge faces and the way to its street.
const FACING: f64 = 0.5;
/// How many pieces of streets are looked at for one that an edge faces.
const TRIES: usize = 64;

/// What `streets(source)` takes.
#[fields("streets")]
pub struct LineIndexOptions {
    /// The streets' lines (m): a source, or lists of points.
    pub lines: Lines,
}

/// Streets, for footprints to know which of their edges is on one.
///
/// They are lines on the ground, to be found by place.
#[object(
    "streets",
    options = LineIndexOptions,
    first = "lines",
    example = include_str!("../scripts/streets.lua"),
    warns
)]
pub struct LineIndex {
    pieces: Arc<RTree<Piece<[f64; 2]>>>,
    warnings: Vec<Warning>,
}

impl fmt::Debug for LineIndex {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "streets of {} pieces", self.pieces.size())
    }
}

#[methods("streets")]
impl LineIndex {
    /// Distance (m) from a place on the ground to the nearest street; infinite if there is none.
    pub fn distance(&self, place: Vector) -> f64 {
        let place = place.0.truncate().to_array();
        let nearest = self.pieces.nearest_neighbor(&place);
        nearest.map_or(f64::INFINITY, |piece| piece.distance_2(&place).sqrt())
    }
}

impl LineIndex {
    /// The index of the lines that a script names.
    pub fn new(options: LineIndexOptions) -> Result<Self> {
        let Lines { lines, refused } = options.lines;
        let mut index = Self::over(&lines);
        if let Some((count, first)) = refused {
            let items = if count == 1 { "item" } else { "items" };
            let text = format!("streets: left out {count} {items} of the list: {first}");
            let warning = Warning::new(WarningKind::Data, text);
            index.warnings.push(warning.help("give lines of points with finite coordinates in metres"));
        }
        Ok(index)
    }

    /// The index of `lines` (m).
    pub fn over(lines: &[Line<DVec3>]) -> Self {
        let pieces = lines.iter().flat_map(Line::edges).filter_map(|edge| {
            let [from, to] = edge.map(DVec3::truncate);
            // An upright piece has no nearest point.
            (from.distance_squared(to) > 0.0).then(|| Piece::new(from.to_array(), to.to_array()))
        });
        Self { pieces: Arc::new(RTree::bulk_load(pieces.collect())), warnings: Vec::new() }
    }

    /// Distance (m) from the middle of the edge from `a` to `b`, whose right side faces outwards, to the nearest
    /// street that it faces; `None` if that is farther than `most`.
    pub(super) fn faced(&self, a: DVec2, b: DVec2, most: f64) -> Option<f64> {
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
        object(value, "streets, made once before: streets(source)")
            .map(|streets: Arc<Self>| (*streets).clone())
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
