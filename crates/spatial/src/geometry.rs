//! The geometry value type.

use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_geometry::Rings;
use glam::{DVec2, DVec3};

use super::GeometryKind;

/// Maximum coordinate (m): twenty-five times the circumference of the Earth.
///
/// Larger coordinates have a rounding error of more than a tenth of a micrometre.
pub const FARTHEST: f64 = 1e9;

/// An unvalidated geometry of OGC Simple Features.
///
/// Points keep their heights, and measurements are horizontal. A height of 0 means that the point has none.
/// Operations interpret irregular geometries as far as possible, and treat a geometry with a coordinate that
/// is NaN or exceeds [`FARTHEST`] as empty; the readers refuse such geometries.
#[derive(Debug, Clone, PartialEq)]
pub enum Geometry {
    /// A point; `None` if it is empty.
    Point(Option<DVec3>),
    /// The points of a line, at least two unless it is empty.
    Line(Vec<DVec3>),
    /// The outer ring and then the holes, each with at least three points, without repeating the first point;
    /// no rings if it is empty.
    Polygon(Rings),
    /// Several points.
    MultiPoint(Vec<DVec3>),
    /// The points of several lines.
    MultiLine(Vec<Vec<DVec3>>),
    /// The rings of several polygons.
    MultiPolygon(Vec<Rings>),
    /// Geometries of any type.
    Collection(Vec<Geometry>),
}

impl Default for Geometry {
    /// Returns the empty collection.
    fn default() -> Self {
        Self::Collection(Vec::new())
    }
}

impl Geometry {
    /// Creates a point.
    pub fn point(place: impl Into<DVec3>) -> Self {
        Self::Point(Some(place.into()))
    }

    /// Creates a line; `None` if it has fewer than two points.
    pub fn line(points: Vec<DVec3>) -> Option<Self> {
        (points.len() >= 2).then_some(Self::Line(points))
    }

    /// Creates a polygon from rings that may repeat their first point; `None` if the outer ring has fewer
    /// than three points.
    ///
    /// Holes with fewer than three points are omitted.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    /// use glam::DVec3;
    ///
    /// let corners = [(0.0, 0.0), (4.0, 0.0), (0.0, 3.0)].map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec();
    /// let triangle = Geometry::polygon(vec![corners.clone()]).expect("three points");
    /// assert_eq!((triangle.area(), triangle.perimeter()), (6.0, 12.0));
    /// assert_eq!(Geometry::polygon(vec![corners[..2].to_vec()]), None);
    /// ```
    pub fn polygon(rings: impl Into<Rings>) -> Option<Self> {
        opened(rings.into()).map(Self::Polygon)
    }

    /// Returns the empty geometry of a dimension: 0 for points, 1 for lines, 2 for areas.
    pub fn empty(dimension: usize) -> Self {
        match dimension {
            0 => Self::Point(None),
            1 => Self::Line(Vec::new()),
            _ => Self::Polygon(Rings::default()),
        }
    }

    /// Returns the simplest geometry with all `parts` that are not empty: a single part unchanged, several
    /// parts of one type as a multi-geometry, other parts as a collection.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    /// use glam::DVec3;
    ///
    /// let points = vec![Geometry::point(DVec3::ZERO), Geometry::empty(1), Geometry::point(DVec3::X)];
    /// assert_eq!(Geometry::gathered(points).to_wkt(), "MULTIPOINT ((0 0), (1 0))");
    /// ```
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

    /// Returns the type.
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

    /// Returns true if the geometry has no points.
    pub fn is_empty(&self) -> bool {
        self.points().next().is_none()
    }

    /// Returns the dimension: 0 for points, 1 for lines, 2 for areas, and the maximum of all members for a
    /// collection, including empty ones.
    pub fn dimension(&self) -> usize {
        match self {
            Self::Point(_) | Self::MultiPoint(_) => 0,
            Self::Line(_) | Self::MultiLine(_) => 1,
            Self::Polygon(_) | Self::MultiPolygon(_) => 2,
            Self::Collection(members) => members.iter().map(Self::dimension).max().unwrap_or(0),
        }
    }

    /// Returns the point lists of all lines and rings.
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

    /// Releases the unused capacity of the lists, for very large numbers of geometries.
    ///
    /// The lists are copied because allocators shrink an array in place, where the released memory is not
    /// reusable.
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

    /// Returns all points.
    pub fn points(&self) -> impl Iterator<Item = &DVec3> {
        self.lists().into_iter().flatten()
    }

    /// Returns all points as mutable references.
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

    /// Returns the points, lines and polygons in order, without empty ones.
    pub fn parts(&self) -> Vec<Self> {
        self.clone().into_parts()
    }

    /// Converts the geometry into its points, lines and polygons, without empty ones.
    ///
    /// ```
    /// use burgeon_spatial::{Geometry, GeometryKind};
    ///
    /// let nested = "GEOMETRYCOLLECTION (MULTIPOINT ((0 0), (1 0)), LINESTRING (0 0, 2 0), POLYGON EMPTY)";
    /// let kinds: Vec<_> = Geometry::from_wkt(nested)?.into_parts().iter().map(Geometry::kind).collect();
    /// assert_eq!(kinds, [GeometryKind::Point, GeometryKind::Point, GeometryKind::Line]);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
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

    /// Returns the horizontal minimum and maximum coordinates (m); `None` if the geometry is empty.
    pub fn bounds(&self) -> Option<[DVec2; 2]> {
        let mut points = self.points().map(|point| point.truncate());
        let first = points.next()?;
        Some(points.fold([first; 2], |[low, high], point| [low.min(point), high.max(point)]))
    }

    /// Returns true if a point has a height.
    pub fn has_heights(&self) -> bool {
        self.points().any(|point| point.z != 0.0)
    }

    /// Returns true if operations can use the geometry: no coordinate is NaN or exceeds [`FARTHEST`].
    pub fn is_sound(&self) -> bool {
        self.points().all(|point| point.abs().max_element() <= FARTHEST && !point.is_nan())
    }

    /// Fails with the first invalid point unless the geometry is [sound](Self::is_sound).
    pub fn check(&self) -> Result<()> {
        let wrong = self.points().find(|point| point.is_nan() || point.abs().max_element() > FARTHEST);
        let Some(point) = wrong else { return Ok(()) };
        let [x, y, z] = point.to_array().map(number);
        let place = if point.z == 0.0 { format!("({x}, {y})") } else { format!("({x}, {y}, {z})") };
        Err(Error::geometry(format!("a geometry has the point {place}"))
            .help("give coordinates that are finite and at most 1e9"))
    }

    /// Orients the rings: outer rings counter-clockwise, holes clockwise.
    pub fn turn(&mut self) {
        match self {
            Self::Polygon(rings) => rings.turn(),
            Self::MultiPolygon(polygons) => polygons.iter_mut().for_each(Rings::turn),
            Self::Collection(members) => members.iter_mut().for_each(Self::turn),
            _ => {}
        }
    }
}

/// Removes repeated first points from rings; `None` if the outer ring has fewer than three points. Holes with
/// fewer than three points are omitted.
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
