//! A spatial index of a table: the boxes of its rows in a tree, and for nearest-neighbour searches their lines.
//!
//! Input: keys and blobs of a column. Output: the keys of rows whose boxes intersect a box, and of the rows nearest to
//! a geometry. Rows without a geometry are included, because they come last when rows are ordered by distance.

use geo::{BoundingRect, Coord, CoordsIter, Intersects, Line, LinesIter};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, Envelope, PointDistance, RTree, RTreeObject};
use rustc_hash::FxHashMap;

use crate::sql::{blob, plane};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};

/// The box of a row, and its number.
type RowBox = GeomWithData<Rectangle<[f64; 2]>, u32>;

/// A line of a row's geometry; a point is a line of length 0.
#[derive(Debug, Clone, Copy)]
struct RowSegment {
    line: Line<f64>,
    row: u32,
}

impl RTreeObject for RowSegment {
    type Envelope = AABB<[f64; 2]>;

    fn envelope(&self) -> Self::Envelope {
        AABB::from_corners(self.line.start.into(), self.line.end.into())
    }
}

impl PointDistance for RowSegment {
    fn distance_2(&self, point: &[f64; 2]) -> f64 {
        square_distance(&self.line, (*point).into())
    }
}

/// The index of one geometry column.
#[derive(Debug)]
pub(crate) struct SpatialIndex {
    boxes: RTree<RowBox>,
    /// Key of each row that has a geometry.
    keys: Vec<i64>,
    /// Keys of rows without a geometry or with an empty one, in order.
    without: Vec<i64>,
    /// Lines for nearest-neighbour searches, if requested.
    lines: Option<RowLines>,
    /// Tolerance of comparisons of coordinates.
    slack: f64,
}

#[derive(Debug)]
struct RowLines {
    tree: RTree<RowSegment>,
    /// Geometry of each row that is an area.
    areas: Vec<Option<geo::Geometry<f64>>>,
    /// Set if there is an area.
    has_areas: bool,
}

/// The lines of all rows, and the geometry of each row that is an area.
type RowParts = (Vec<RowSegment>, Vec<Option<geo::Geometry<f64>>>);

/// The builder of an index, to which rows are added.
#[derive(Default)]
pub(crate) struct IndexBuilder {
    boxes: Vec<RowBox>,
    keys: Vec<i64>,
    without: Vec<i64>,
    lines: Option<RowParts>,
    greatest: f64,
}

impl IndexBuilder {
    /// Creates a builder, with lines for nearest-neighbour searches if `nearest`.
    pub(crate) fn new(nearest: bool) -> Self {
        Self { lines: nearest.then(Default::default), ..Self::default() }
    }

    /// Adds a row. A geometry that cannot be read counts as missing, because functions report it.
    pub(crate) fn push(&mut self, key: i64, bytes: Option<&[u8]>, budget: &Budget) -> Result<()> {
        budget.tick()?;
        let told = bytes.and_then(blob::told_bounds).filter(|_| self.lines.is_none());
        let (bounds, geometry) = match (told, bytes) {
            (Some(bounds), _) => (Some(bounds), None),
            (None, Some(bytes)) => {
                let geometry = blob::read(bytes, budget).ok().map(|geometry| plane::flat(&geometry));
                let bounds = geometry.as_ref().and_then(BoundingRect::bounding_rect);
                (bounds.map(|it| [it.min().x, it.min().y, it.max().x, it.max().y]), geometry)
            }
            (None, None) => (None, None),
        };
        let Some([low_x, low_y, high_x, high_y]) = bounds else {
            budget.take(8)?;
            self.without.push(key);
            return Ok(());
        };
        let Ok(row) = u32::try_from(self.keys.len()) else { return Err(too_many()) };
        budget.take(80)?;
        self.keys.push(key);
        self.greatest =
            [low_x, low_y, high_x, high_y].iter().fold(self.greatest, |most, it| most.max(it.abs()));
        let corners = Rectangle::from_corners([low_x, low_y], [high_x, high_y]);
        self.boxes.push(GeomWithData::new(corners, row));
        if let (Some((segments, areas)), Some(geometry)) = (&mut self.lines, geometry) {
            let before = segments.len();
            segments.extend(lines(&geometry).into_iter().map(|line| RowSegment { line, row }));
            let area = is_area(&geometry);
            budget.take((segments.len() - before) * if area { 120 } else { 80 } + 40)?;
            areas.push(area.then_some(geometry));
        }
        Ok(())
    }

    /// Builds the index of all added rows.
    pub(crate) fn build(mut self) -> SpatialIndex {
        self.without.sort_unstable();
        SpatialIndex {
            boxes: RTree::bulk_load(self.boxes),
            keys: self.keys,
            without: self.without,
            lines: self.lines.map(|(segments, areas)| RowLines {
                tree: RTree::bulk_load(segments),
                has_areas: areas.iter().any(Option::is_some),
                areas,
            }),
            slack: 1e-12 * self.greatest,
        }
    }
}

impl SpatialIndex {
    /// Returns true if the index supports nearest-neighbour searches.
    pub(crate) fn has_lines(&self) -> bool {
        self.lines.is_some()
    }

    /// Returns the keys of rows whose boxes are within `distance` of the box of a geometry, or of the rows without a
    /// geometry if `bounds` is `None`.
    pub(crate) fn keys_near(&self, bounds: Option<[f64; 4]>, distance: f64) -> Vec<i64> {
        let Some([low_x, low_y, high_x, high_y]) = bounds else { return self.without.clone() };
        let most = distance + 1e-12 * distance.abs() + 4.0 * self.slack;
        if most.is_nan() || most < 0.0 {
            return Vec::new();
        }
        let around = AABB::from_corners([low_x - most, low_y - most], [high_x + most, high_y + most]);
        let mut keys: Vec<i64> = self
            .boxes
            .locate_in_envelope_intersecting(&around)
            .map(|row| self.keys[row.data as usize])
            .collect();
        keys.sort_unstable();
        keys
    }

    /// Returns the keys of the `count` rows nearest to a geometry, and of the rows at the same distance as the last of
    /// them. Rows without a geometry are farther than all others. If `from` is empty, all rows are at the same
    /// distance.
    pub(crate) fn nearest(&self, from: &geo::Geometry<f64>, count: usize) -> Vec<i64> {
        let mut rows = self.candidates(from, count);
        rows.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        let farthest =
            rows.get(count.saturating_sub(1)).map_or(f64::INFINITY, |row| row.1 * (1.0 + 1e-12) + self.slack);
        let mut keys: Vec<i64> = rows.iter().filter(|row| row.1 <= farthest).map(|row| row.0).collect();
        if keys.len() < count {
            keys.extend(&self.without);
        }
        keys.sort_unstable();
        keys
    }

    /// Returns the key of the row nearest to a geometry; among equally near rows, the lowest key.
    pub(crate) fn nearest_one(&self, from: &geo::Geometry<f64>) -> Option<i64> {
        let asked = self.lines.as_ref().zip(NearestFrom::new(from));
        let best = asked.and_then(|(lines, from)| {
            let first = lines.tree.nearest_neighbor(&from.middle())?;
            let mut best = (from.distance(&first.line, f64::INFINITY), self.keys[first.row as usize]);
            for segment in lines.tree.locate_in_envelope_intersecting(&from.expanded_box(best.0 + self.slack))
            {
                let far = from.distance(&segment.line, best.0);
                let key = self.keys[segment.row as usize];
                if far < best.0 || far <= best.0 && key < best.1 {
                    best = (far, key);
                }
            }
            for row in self.rows_around(lines, &from) {
                let key = self.keys[row as usize];
                if best.0 > 0.0 || key < best.1 {
                    best = (0.0, key);
                }
            }
            Some(best.1)
        });
        best.or_else(|| self.without.first().copied())
    }

    /// Returns the lowest key.
    pub(crate) fn first(&self) -> Option<i64> {
        self.keys.iter().chain(self.without.first()).min().copied()
    }

    /// Returns all keys.
    pub(crate) fn all(&self) -> Vec<i64> {
        let mut keys: Vec<i64> = self.keys.iter().chain(&self.without).copied().collect();
        keys.sort_unstable();
        keys
    }

    /// Returns the rows that may be among the `count` nearest, with their distances.
    fn candidates(&self, from: &geo::Geometry<f64>, count: usize) -> Vec<(i64, f64)> {
        let (Some(lines), Some(from)) = (&self.lines, NearestFrom::new(from)) else { return Vec::new() };
        // The rows nearest to the centre give an upper bound of the distance.
        let mut found: Vec<(u32, f64)> = Vec::new();
        for segment in lines.tree.nearest_neighbor_iter(&from.middle()) {
            let far = from.distance(&segment.line, f64::INFINITY);
            match found.iter_mut().find(|(row, _)| *row == segment.row) {
                Some((_, known)) => *known = known.min(far),
                None => found.push((segment.row, far)),
            }
            if found.len() >= count {
                break;
            }
        }
        let bound = match found.len() < count {
            true => f64::INFINITY,
            false => found.iter().map(|(_, far)| *far).fold(0.0, f64::max) + self.slack,
        };
        let mut nearest: FxHashMap<u32, f64> = FxHashMap::default();
        let mut best = |row: u32, far: f64| {
            let known = nearest.entry(row).or_insert(f64::INFINITY);
            *known = known.min(far);
        };
        for segment in lines.tree.locate_in_envelope_intersecting(&from.expanded_box(bound)) {
            let far = from.distance(&segment.line, bound);
            if far <= bound {
                best(segment.row, far);
            }
        }
        for row in self.rows_around(lines, &from) {
            best(row, 0.0);
        }
        let mut found: Vec<(u32, f64)> = nearest.into_iter().collect();
        found.sort_unstable_by_key(|row| row.0);
        found.into_iter().map(|(row, far)| (self.keys[row as usize], far)).collect()
    }

    /// Returns the rows whose areas contain the first corner of the geometry.
    fn rows_around<'a>(
        &'a self,
        lines: &'a RowLines,
        from: &NearestFrom<'a>,
    ) -> impl Iterator<Item = u32> + 'a {
        let corner = from.geometry.coords_iter().next();
        let near = corner.filter(|_| lines.has_areas).map(|corner| {
            let rows = self.boxes.locate_in_envelope_intersecting(&AABB::from_point(corner.into()));
            rows.map(|row| row.data).filter(move |row| {
                let area = lines.areas.get(*row as usize).and_then(Option::as_ref);
                area.is_some_and(|area| area.intersects(&geo::Point(corner)))
            })
        });
        near.into_iter().flatten()
    }
}

/// A geometry from which distances are measured.
struct NearestFrom<'a> {
    geometry: &'a geo::Geometry<f64>,
    /// Lines of the geometry.
    lines: Vec<Line<f64>>,
    /// Set if the geometry includes its interior.
    is_area: bool,
    bounds: AABB<[f64; 2]>,
}

impl<'a> NearestFrom<'a> {
    /// Prepares a geometry, or returns `None` if it is empty.
    fn new(geometry: &'a geo::Geometry<f64>) -> Option<Self> {
        let bounds = geometry.bounding_rect()?;
        let bounds = AABB::from_corners(bounds.min().into(), bounds.max().into());
        Some(Self { geometry, lines: lines(geometry), is_area: is_area(geometry), bounds })
    }

    fn middle(&self) -> [f64; 2] {
        self.bounds.center()
    }

    /// Returns the box of all points within `reach`.
    fn expanded_box(&self, reach: f64) -> AABB<[f64; 2]> {
        let reach = if reach.is_finite() { reach } else { f64::MAX / 4.0 };
        let ([west, south], [east, north]) = (self.bounds.lower(), self.bounds.upper());
        AABB::from_corners([west - reach, south - reach], [east + reach, north + reach])
    }

    /// Returns the distance to a line, or any number above `most` if it is farther.
    fn distance(&self, line: &Line<f64>, most: f64) -> f64 {
        let own = line_box(line);
        if square_box_distance(&self.bounds, &own) > most * most {
            return f64::INFINITY;
        }
        // A line exactly at the maximum distance counts as well.
        let mut least = most * most * (1.0 + 4.0 * f64::EPSILON);
        let mut found = f64::INFINITY;
        for each in &self.lines {
            let apart = square_box_distance(&line_box(each), &own);
            if apart <= least {
                if apart == 0.0 && each.intersects(line) {
                    return 0.0;
                }
                let near = square_distance(each, line.start)
                    .min(square_distance(each, line.end))
                    .min(square_distance(line, each.start))
                    .min(square_distance(line, each.end));
                found = found.min(near);
                least = least.min(near);
            }
        }
        let start: [f64; 2] = line.start.into();
        let within = self.is_area
            && self.bounds.contains_point(&start)
            && self.geometry.intersects(&geo::Point(line.start));
        if within { 0.0 } else { found.sqrt() }
    }
}

fn too_many() -> Error {
    Error::limit(Limit::Size, "a table has more than 4,294,967,295 rows with a geometry")
        .help("read a part of it")
}

fn is_area(geometry: &geo::Geometry<f64>) -> bool {
    match geometry {
        geo::Geometry::Polygon(_) | geo::Geometry::MultiPolygon(_) => true,
        geo::Geometry::GeometryCollection(members) => members.iter().any(is_area),
        _ => false,
    }
}

/// Returns all lines of a geometry, with points as lines of length 0.
fn lines(geometry: &geo::Geometry<f64>) -> Vec<Line<f64>> {
    let dot = |at: Coord<f64>| Line::new(at, at);
    match geometry {
        geo::Geometry::Point(point) => vec![dot(point.0)],
        geo::Geometry::MultiPoint(points) => points.iter().map(|point| dot(point.0)).collect(),
        geo::Geometry::GeometryCollection(members) => members.iter().flat_map(lines).collect(),
        geo::Geometry::LineString(line) => line.lines().collect(),
        geo::Geometry::MultiLineString(lines) => lines.lines_iter().collect(),
        geo::Geometry::Polygon(polygon) => polygon.lines_iter().collect(),
        geo::Geometry::MultiPolygon(polygons) => polygons.lines_iter().collect(),
        _ => Vec::new(),
    }
}

fn line_box(line: &Line<f64>) -> AABB<[f64; 2]> {
    AABB::from_corners(line.start.into(), line.end.into())
}

/// Returns the square of the distance between two boxes.
fn square_box_distance(a: &AABB<[f64; 2]>, b: &AABB<[f64; 2]>) -> f64 {
    let apart =
        |axis: usize| (b.lower()[axis] - a.upper()[axis]).max(a.lower()[axis] - b.upper()[axis]).max(0.0);
    apart(0) * apart(0) + apart(1) * apart(1)
}

/// Returns the square of the distance between a point and a line.
fn square_distance(line: &Line<f64>, at: Coord<f64>) -> f64 {
    let (along, to) = (line.end - line.start, at - line.start);
    let squared = along.x * along.x + along.y * along.y;
    let part =
        if squared > 0.0 { ((to.x * along.x + to.y * along.y) / squared).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (to.x - along.x * part, to.y - along.y * part);
    x * x + y * y
}
