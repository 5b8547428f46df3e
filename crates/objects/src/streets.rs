//! Streets, for those who ask which way the nearest one lies.

use std::fmt;
use std::sync::{Arc, LazyLock};

use glam::{DVec2, DVec3};
use rstar::primitives::Line;
use rstar::{PointDistance, RTree};

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_data::Geometry;
use burgeon_kit::{Expected, fields, methods, object};
use burgeon_kit::{Features, Kind, Object, Parameter, Shape, Value, Vector};

/// The farthest (m) that a street lies from what faces it.
const FARTHEST: f64 = 300.0;
/// The cosine of the greatest angle (60 degrees) between the way an edge faces and the way to its street.
const FACING: f64 = 0.5;
/// How many pieces of streets are looked at for one that an edge faces.
const TRIES: usize = 64;

/// Lines of points (m): a source, geometries, or lists of points.
#[derive(Debug, Clone, Default)]
pub struct Lines {
    /// The lines.
    pub lines: Vec<Vec<DVec3>>,
    /// How many items of a list were left out, and the first of them.
    pub refused: Option<(usize, String)>,
}

impl Parameter for Lines {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expected> {
        let mut lines = Self::default();
        collect(value, &mut lines, 0)?;
        Ok(lines)
    }

    fn into_value(self) -> Value {
        let lines = self.lines.into_iter().map(|line| line.into_iter().map(Vector).collect());
        lines.collect::<Vec<Vec<Vector>>>().into_value()
    }
}

/// Adds the lines of a value: of a source, a feature, a geometry, or a list of these or of points.
fn collect(value: Value, lines: &mut Lines, depth: usize) -> Result<(), Expected> {
    let what = || Expected::new("a source of lines, a list of lines, or a list of points");
    match value {
        Value::Object(object) => {
            let any: &dyn std::any::Any = &*object;
            if let Some(shape) = any.downcast_ref::<Shape>() {
                add(shape.geometry(), &mut lines.lines);
                return Ok(());
            }
            let features = any.downcast_ref::<Features>().ok_or_else(what)?;
            features.0.features.iter().for_each(|feature| add(&feature.geometry, &mut lines.lines));
        }
        Value::Table(table) => {
            if let Some(geometry) = table.get("geometry") {
                return collect(geometry.clone(), lines, depth + 1);
            }
            if let Some(points) = table.get("points") {
                return collect(points.clone(), lines, depth + 1);
            }
            if let Some(rings) = table.get("rings") {
                let rings = Vec::<Vec<Vector>>::from_value(rings.clone()).map_err(|_| what())?;
                lines
                    .lines
                    .extend(rings.into_iter().map(|ring| closed(ring.into_iter().map(|at| at.0).collect())));
                return Ok(());
            }
            if let Ok(points) = Vec::<Vector>::from_value(Value::Table(Arc::clone(&table))) {
                if !points.is_empty() {
                    lines.lines.push(points.into_iter().map(|point| point.0).collect());
                }
                return Ok(());
            }
            let list = table.list();
            if depth > 4 || list.len() != table.entries.len() {
                return Err(what());
            }
            // One bad item among others is left out alone.
            let (mut good, mut bad) = (0, None);
            for (number, item) in (1..).zip(list) {
                let known = lines.lines.len();
                match collect(item, lines, depth + 1) {
                    Ok(()) => good += 1,
                    Err(error) => {
                        lines.lines.truncate(known);
                        let (count, _) = lines.refused.get_or_insert_with(|| (0, error.item(number)));
                        *count += 1;
                        bad.get_or_insert(error);
                    }
                }
            }
            if let (0, Some(error)) = (good, bad) {
                return Err(error);
            }
        }
        _ => return Err(what()),
    }
    Ok(())
}

fn add(geometry: &Geometry, lines: &mut Vec<Vec<DVec3>>) {
    let points = |points: &[[f64; 3]]| points.iter().copied().map(DVec3::from).collect();
    match geometry {
        Geometry::Line(line) => lines.push(points(line)),
        // A square is walked around.
        Geometry::Polygon(rings) => lines.extend(rings.iter().map(|ring| closed(points(ring)))),
        Geometry::Point(_) => {}
    }
}

fn closed(mut ring: Vec<DVec3>) -> Vec<DVec3> {
    ring.extend(ring.first().copied());
    ring
}

/// What `streets(source)` takes.
#[fields("streets")]
pub struct StreetsOptions {
    /// The streets' lines (m): a source, or lists of points.
    pub lines: Lines,
}

/// Streets as lines on the ground, to be found by place.
#[derive(Clone)]
pub struct Streets {
    pieces: Arc<RTree<Line<[f64; 2]>>>,
    warnings: Vec<Warning>,
}

impl fmt::Debug for Streets {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "streets of {} pieces", self.pieces.size())
    }
}

#[methods("streets")]
impl Streets {
    /// Distance (m) from a place on the ground to the nearest street; infinite if there is none.
    pub fn distance(&self, place: Vector) -> f64 {
        let place = place.0.truncate().to_array();
        let nearest = self.pieces.nearest_neighbor(&place);
        nearest.map_or(f64::INFINITY, |piece| piece.distance_2(&place).sqrt())
    }
}

impl Streets {
    /// The type, as scripts see it.
    pub fn kind() -> &'static Arc<Kind> {
        static KIND: LazyLock<Arc<Kind>> = LazyLock::new(|| {
            let kind =
                Kind::new("streets", "Streets, for footprints to know which of their edges is on one.")
                    .example(include_str!("../scripts/streets.lua"));
            Arc::new(
                kind.made_of(StreetsOptions::fields(), |table| {
                    Streets::new(StreetsOptions::from_table(table)?)
                })
                .first("lines")
                .methods(Streets::methods()),
            )
        });
        &KIND
    }

    /// The streets that a script names.
    pub fn new(options: StreetsOptions) -> Result<Self> {
        let Lines { lines, refused } = options.lines;
        let mut streets = Self::over(&lines);
        if let Some((count, first)) = refused {
            let items = if count == 1 { "item" } else { "items" };
            let text = format!("streets: left out {count} {items} of the list: {first}");
            let warning = Warning::new(WarningKind::Data, text);
            streets.warnings.push(warning.help("give lines of points with finite coordinates in metres"));
        }
        Ok(streets)
    }

    /// Streets along `lines` (m).
    pub fn over(lines: &[Vec<DVec3>]) -> Self {
        let pieces = lines.iter().flat_map(|line| line.windows(2)).filter_map(|pair| {
            let [from, to] = [pair[0], pair[1]].map(|point| point.truncate());
            // A piece without length has no nearest point.
            (from.distance_squared(to) > 0.0).then(|| Line::new(from.to_array(), to.to_array()))
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

impl Parameter for Streets {
    fn luau() -> String {
        "Streets".into()
    }

    fn from_value(value: Value) -> Result<Self, Expected> {
        object(value, "streets, made once before: streets(source)")
            .map(|streets: Arc<Self>| (*streets).clone())
    }

    fn into_value(self) -> Value {
        Value::Object(Arc::new(self))
    }
}

impl Object for Streets {
    fn kind(&self) -> &Arc<Kind> {
        Self::kind()
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }

    fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }
}
