//! Geometries prepared for many comparisons.

use std::sync::OnceLock;

use glam::DVec2;

use crate::Geometry;
use crate::overlay::Operand;
use crate::plane::Plane;
use crate::ways::WayEdges;

/// A geometry that is compared with many others; data that depend only on this geometry are computed once.
///
/// ```
/// use burgeon_spatial::{Geometry, PreparedGeometry};
///
/// let lawn = Geometry::from_wkt("POLYGON ((0 0, 10 0, 10 10, 0 10, 0 0))")?;
/// let prepared = PreparedGeometry::new(&lawn);
/// let inside = |x: i32| prepared.contains(&PreparedGeometry::new(&Geometry::point([f64::from(x), 5.0, 0.0])));
/// assert_eq!((0..20).filter(|x| inside(*x)).count(), 9);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct PreparedGeometry {
    /// Original geometry.
    pub(crate) whole: Geometry,
    pub(crate) bounds: Option<[DVec2; 2]>,
    pub(crate) is_sound: bool,
    /// Dimension of the geometry, including its empty parts.
    pub(crate) dimension: usize,
    parts: OnceLock<TopologyParts>,
    /// Triangles of its areas for random points, with corners in the coordinates of its plane.
    pub(crate) triangles: OnceLock<Vec<[DVec2; 3]>>,
}

/// Components of a geometry.
#[derive(Debug, Clone)]
pub(super) enum TopologyParts {
    /// No components.
    None,
    /// Distinct points, sorted.
    Points(Vec<DVec2>),
    /// Edges of lines, and the sorted points where an odd number of lines end.
    Lines(WayEdges, Vec<DVec2>),
    /// Rings with the area to their left.
    Areas(WayEdges),
    /// Components of several dimensions, or computed areas, whose corners are rounded.
    Mixed,
}

impl PreparedGeometry {
    /// Prepares a geometry.
    pub fn new(geometry: &Geometry) -> Self {
        Self {
            whole: geometry.clone(),
            bounds: geometry.bounds(),
            is_sound: geometry.is_sound(),
            dimension: geometry.dimension(),
            parts: OnceLock::new(),
            triangles: OnceLock::new(),
        }
    }

    /// Returns the components; none if the geometry is not sound.
    pub(super) fn parts(&self) -> &TopologyParts {
        self.parts
            .get_or_init(|| if self.is_sound { TopologyParts::new(&self.whole) } else { TopologyParts::None })
    }
}

impl TopologyParts {
    fn new(geometry: &Geometry) -> Self {
        let plane = Plane::of(&[geometry]);
        let Operand { areas, lines, mut points, are_given } = Operand::new(plane, geometry);
        // Adding 0 turns -0 into 0.
        let back = |place: DVec2| plane.back(place).truncate() + 0.0;
        match [areas.0.is_empty(), lines.is_empty(), points.is_empty()] {
            [true, true, true] => Self::None,
            [true, true, false] => {
                points.iter_mut().for_each(|place| *place = back(*place));
                sort(&mut points);
                points.dedup();
                Self::Points(points)
            }
            [true, false, true] => {
                let ways = lines.iter().map(|line| line.iter().map(|place| back(*place)).collect());
                let ways: Vec<Vec<DVec2>> = ways.collect();
                let ends = ways.iter().filter(|way| way.first() != way.last());
                let mut ends: Vec<DVec2> =
                    ends.flat_map(|way| way.first().into_iter().chain(way.last())).copied().collect();
                sort(&mut ends);
                let odd = ends.chunk_by(|a, b| a == b).filter(|same| same.len() % 2 == 1);
                let boundary = odd.map(|same| same[0]).collect();
                Self::Lines(WayEdges::new(&ways), boundary)
            }
            [false, true, true] if are_given => {
                let rings = areas.iter().flat_map(|it| std::iter::once(it.exterior()).chain(it.interiors()));
                let place = |at: &geo::Coord| back(DVec2::new(at.x, at.y));
                let rings: Vec<Vec<DVec2>> = rings.map(|ring| ring.0.iter().map(place).collect()).collect();
                Self::Areas(WayEdges::new(&rings))
            }
            _ => Self::Mixed,
        }
    }
}

/// Sorts points so that equal points are adjacent.
fn sort(places: &mut [DVec2]) {
    places.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
}

/// Returns true if sorted points contain a point.
pub(super) fn is_among(places: &[DVec2], place: DVec2) -> bool {
    let first = places.partition_point(|it| it.x < place.x || it.x == place.x && it.y < place.y);
    places.get(first) == Some(&place)
}
