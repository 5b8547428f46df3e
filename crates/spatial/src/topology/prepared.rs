//! A geometry as it is compared with others.

use std::sync::OnceLock;

use glam::DVec2;

use crate::Geometry;
use crate::overlay::Operand;
use crate::plane::Plane;
use crate::ways::WayEdges;

/// A geometry that is compared with many others: what that takes of it alone is done once.
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
    /// As it was given.
    pub(crate) whole: Geometry,
    pub(crate) bounds: Option<[DVec2; 2]>,
    pub(crate) is_sound: bool,
    /// That of the geometry, whose empty parts count too.
    pub(crate) dimension: usize,
    parts: OnceLock<TopologyParts>,
    /// What its areas are divided into, for points at random: corners in its plane.
    pub(crate) triangles: OnceLock<Vec<[DVec2; 3]>>,
}

/// What a geometry is made of.
#[derive(Debug, Clone)]
pub(super) enum TopologyParts {
    /// Nothing.
    None,
    /// Places, each once, in order.
    Points(Vec<DVec2>),
    /// Ways of edges, and the places where an odd number of them ends, in order.
    Lines(WayEdges, Vec<DVec2>),
    /// Rings, with the area to their left.
    Areas(WayEdges),
    /// Several of these, or areas that had to be computed, whose corners are rounded.
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

    /// What it is made of; nothing if it is not sound.
    pub(super) fn parts(&self) -> &TopologyParts {
        self.parts
            .get_or_init(|| if self.is_sound { TopologyParts::new(&self.whole) } else { TopologyParts::None })
    }
}

impl TopologyParts {
    fn new(geometry: &Geometry) -> Self {
        let plane = Plane::of(&[geometry]);
        let Operand { areas, lines, mut points, are_given } = Operand::new(plane, geometry);
        // Of the two zeros there is only one behind a sum.
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

/// Puts places in an order in which equal ones are neighbours.
fn sort(places: &mut [DVec2]) {
    places.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
}

/// Whether a place is among those that are in order.
pub(super) fn is_among(places: &[DVec2], place: DVec2) -> bool {
    let first = places.partition_point(|it| it.x < place.x || it.x == place.x && it.y < place.y);
    places.get(first) == Some(&place)
}
