//! The value that all the rest is about.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_geometry::Rings;
use glam::{DVec2, DVec3};

use super::GeometryKind;

/// The greatest coordinate: twenty-five times as far as around Earth in metres.
///
/// Farther away coordinates are rounded to more than a tenth of a micrometre.
pub const FARTHEST: f64 = 1e9;

/// A geometry of OGC Simple Features, as somebody gave it: nothing is promised of its points.
///
/// Heights go along with places, and what is measured is measured as seen from above. A height of 0 means none.
/// Operations take what is odd for what it can mean, and a geometry with a coordinate that is no number, or is farther
/// than [`FARTHEST`], for an empty one; the readers refuse these.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// Its place; none if it is empty.
    Point(Option<DVec3>),
    /// Its points, at least two unless it is empty.
    Line(Vec<DVec3>),
    /// Its outer ring and then its holes, each of at least three points, without the first one again at the end; none if
    /// it is empty.
    Polygon(Rings),
    /// Its places.
    MultiPoint(Vec<DVec3>),
    /// The points of each line.
    MultiLine(Vec<Vec<DVec3>>),
    /// The rings of each polygon.
    MultiPolygon(Vec<Rings>),
    /// Its geometries.
    Collection(Vec<Geometry>),
}

impl Default for Geometry {
    /// The empty collection.
    fn default() -> Self {
        Self::Collection(Vec::new())
    }
}

impl Geometry {
    /// A place.
    pub fn point(place: impl Into<DVec3>) -> Self {
        Self::Point(Some(place.into()))
    }

    /// A line, or nothing if it has fewer than two points.
    pub fn line(points: Vec<DVec3>) -> Option<Self> {
        (points.len() >= 2).then_some(Self::Line(points))
    }

    /// A polygon from rings that may end where they begin; nothing if the outer one has no three points. Holes that
    /// have not are left out.
    pub fn polygon(rings: impl Into<Rings>) -> Option<Self> {
        opened(rings.into()).map(Self::Polygon)
    }

    /// The empty geometry of a dimension: 0 of points, 1 of lines, 2 of areas.
    pub fn empty(dimension: usize) -> Self {
        match dimension {
            0 => Self::Point(None),
            1 => Self::Line(Vec::new()),
            _ => Self::Polygon(Rings::default()),
        }
    }

    /// The simplest geometry of `parts`, of which empty ones are left out: one of them as it is, many of one kind as a
    /// multi form, others as a collection.
    pub fn gathered(parts: Vec<Self>) -> Self {
        let mut parts: Vec<Self> = parts.into_iter().flat_map(Self::into_parts).collect();
        if parts.len() == 1
            && let Some(only) = parts.pop()
        {
            return only;
        }
        let Some(kind) = parts.first().map(Self::kind) else { return Self::default() };
        if parts.iter().any(|part| part.kind() != kind) {
            return Self::Collection(parts);
        }
        match kind {
            GeometryKind::Point => Self::MultiPoint(parts.iter().flat_map(Self::points).copied().collect()),
            GeometryKind::Line => Self::MultiLine(
                parts
                    .into_iter()
                    .filter_map(|part| if let Self::Line(line) = part { Some(line) } else { None })
                    .collect(),
            ),
            _ => Self::MultiPolygon(
                parts
                    .into_iter()
                    .filter_map(|part| if let Self::Polygon(rings) = part { Some(rings) } else { None })
                    .collect(),
            ),
        }
    }

    /// Its kind.
    pub fn kind(&self) -> GeometryKind {
        match self {
            Self::Point(_) => GeometryKind::Point,
            Self::Line(_) => GeometryKind::Line,
            Self::Polygon(_) => GeometryKind::Polygon,
            Self::MultiPoint(_) => GeometryKind::MultiPoint,
            Self::MultiLine(_) => GeometryKind::MultiLine,
            Self::MultiPolygon(_) => GeometryKind::MultiPolygon,
            Self::Collection(_) => GeometryKind::Collection,
        }
    }

    /// Whether it has no points.
    pub fn is_empty(&self) -> bool {
        self.points().next().is_none()
    }

    /// 0 of points, 1 of lines, 2 of areas; the greatest of a collection, whose empty geometries count too.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Point(_) | Self::MultiPoint(_) => 0,
            Self::Line(_) | Self::MultiLine(_) => 1,
            Self::Polygon(_) | Self::MultiPolygon(_) => 2,
            Self::Collection(members) => members.iter().map(Self::dimension).max().unwrap_or(0),
        }
    }

    /// Its lists of points: lines and rings.
    pub fn lists(&self) -> Vec<&[DVec3]> {
        let mut lists = Vec::new();
        self.collect_lists(&mut lists);
        lists
    }

    fn collect_lists<'a>(&'a self, lists: &mut Vec<&'a [DVec3]>) {
        match self {
            Self::Point(point) => lists.push(point.as_slice()),
            Self::Line(points) | Self::MultiPoint(points) => lists.push(points),
            Self::Polygon(rings) => lists.extend(rings.iter().map(Vec::as_slice)),
            Self::MultiLine(lines) => lists.extend(lines.iter().map(Vec::as_slice)),
            Self::MultiPolygon(polygons) => {
                lists.extend(polygons.iter().flat_map(|rings| rings.iter()).map(Vec::as_slice));
            }
            Self::Collection(members) => members.iter().for_each(|member| member.collect_lists(lists)),
        }
    }

    /// Gives back the room that its lists have left over, where there are very many geometries.
    ///
    /// Allocators leave an array that is asked to shrink where it is, so that its room is lost to others; hence a copy.
    pub fn compact(&mut self) {
        fn compact<T: Clone>(list: &mut Vec<T>) {
            if list.capacity() > list.len() {
                *list = list.clone();
            }
        }
        let rings = |rings: &mut Rings| {
            rings.0.iter_mut().for_each(compact);
            compact(&mut rings.0);
        };
        match self {
            Self::Point(_) => {}
            Self::Line(points) | Self::MultiPoint(points) => compact(points),
            Self::Polygon(polygon) => rings(polygon),
            Self::MultiLine(lines) => {
                lines.iter_mut().for_each(compact);
                compact(lines);
            }
            Self::MultiPolygon(polygons) => polygons.iter_mut().for_each(rings),
            Self::Collection(members) => members.iter_mut().for_each(Self::compact),
        }
    }

    /// All of its points.
    pub fn points(&self) -> impl Iterator<Item = &DVec3> {
        self.lists().into_iter().flatten()
    }

    /// All of its points, to be moved.
    pub fn points_mut(&mut self) -> impl Iterator<Item = &mut DVec3> {
        let mut lists = Vec::new();
        self.collect_lists_mut(&mut lists);
        lists.into_iter().flatten()
    }

    fn collect_lists_mut<'a>(&'a mut self, lists: &mut Vec<&'a mut [DVec3]>) {
        match self {
            Self::Point(point) => lists.push(point.as_mut_slice()),
            Self::Line(points) | Self::MultiPoint(points) => lists.push(points),
            Self::Polygon(rings) => lists.extend(rings.0.iter_mut().map(Vec::as_mut_slice)),
            Self::MultiLine(lines) => lists.extend(lines.iter_mut().map(Vec::as_mut_slice)),
            Self::MultiPolygon(polygons) => {
                lists.extend(polygons.iter_mut().flat_map(|rings| rings.0.iter_mut()).map(Vec::as_mut_slice));
            }
            Self::Collection(members) => {
                members.iter_mut().for_each(|member| member.collect_lists_mut(lists))
            }
        }
    }

    /// Its points, lines and polygons in their order, without empty ones.
    pub fn parts(&self) -> Vec<Self> {
        self.clone().into_parts()
    }

    /// The same, of a geometry that nobody needs any more.
    pub fn into_parts(self) -> Vec<Self> {
        let mut parts = Vec::new();
        self.collect_parts(&mut parts);
        parts
    }

    fn collect_parts(self, parts: &mut Vec<Self>) {
        match self {
            Self::Point(None) => {}
            Self::Line(points) if points.is_empty() => {}
            Self::Polygon(rings) if rings.first().is_none_or(Vec::is_empty) => {}
            Self::Point(_) | Self::Line(_) | Self::Polygon(_) => parts.push(self),
            Self::MultiPoint(points) => parts.extend(points.into_iter().map(Self::point)),
            Self::MultiLine(lines) => {
                lines.into_iter().map(Self::Line).for_each(|it| it.collect_parts(parts))
            }
            Self::MultiPolygon(polygons) => {
                polygons.into_iter().map(Self::Polygon).for_each(|it| it.collect_parts(parts));
            }
            Self::Collection(members) => members.into_iter().for_each(|it| it.collect_parts(parts)),
        }
    }

    /// The least and the greatest coordinates as seen from above; none of an empty one.
    pub fn bounds(&self) -> Option<[DVec2; 2]> {
        let mut points = self.points().map(|point| point.truncate());
        let first = points.next()?;
        Some(points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]))
    }

    /// Whether a point has a height.
    pub fn has_heights(&self) -> bool {
        self.points().any(|point| point.z != 0.0)
    }

    /// Whether it can be computed with: all of its coordinates are numbers, none farther than [`FARTHEST`].
    pub fn is_sound(&self) -> bool {
        self.points().all(|point| point.abs().max_element() <= FARTHEST && !point.is_nan())
    }

    /// Fails unless it is [sound](Self::is_sound), and names the first point that is not.
    pub fn check(&self) -> Result<()> {
        let wrong = self.points().find(|point| point.is_nan() || point.abs().max_element() > FARTHEST);
        let Some(point) = wrong else { return Ok(()) };
        let [x, y, z] = point.to_array().map(number);
        let place = if point.z == 0.0 { format!("({x}, {y})") } else { format!("({x}, {y}, {z})") };
        Err(Error::geometry(format!("a geometry has the point {place}"))
            .help("give coordinates that are finite and at most 1e9"))
    }

    /// Turns its rings the way that they are to run: outer ones counter-clockwise, holes clockwise.
    pub fn turn(&mut self) {
        match self {
            Self::Polygon(rings) => rings.turn(),
            Self::MultiPolygon(polygons) => polygons.iter_mut().for_each(Rings::turn),
            Self::Collection(members) => members.iter_mut().for_each(Self::turn),
            _ => {}
        }
    }
}

/// Rings without the first point again at the end; nothing if the outer one has no three points. Holes that have not
/// are left out.
pub(crate) fn opened(Rings(mut rings): Rings) -> Option<Rings> {
    for ring in &mut rings {
        while ring.len() > 1 && ring.first() == ring.last() {
            ring.pop();
        }
    }
    if rings.first()?.len() < 3 {
        return None;
    }
    rings.retain(|ring| ring.len() >= 3);
    Some(Rings(rings))
}
