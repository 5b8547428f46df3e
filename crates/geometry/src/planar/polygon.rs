//! Polygons with holes.

use std::ops::{Add, Deref};

use geo::{LineString, Simplify};
use glam::{DVec2, DVec3};

use super::convert::open;
use super::measure::{bounds, contains, has_area, hull};
use super::ring::shown;
use super::{Point, Ring, Rings};
use crate::cap;
use burgeon_base::error::{Error, Result};

/// A polygon: an outer ring and holes; empty without any.
///
/// The outer ring is counter-clockwise and the holes are clockwise as seen from above, where neighbours among the
/// points of a ring differ too. A polygon is the slice of its rings, the outer one first.
///
/// ```
/// use burgeon_geometry::{Polygon, Rings};
/// use glam::DVec2;
///
/// let square = |low: f64, high: f64| {
///     [(low, low), (high, low), (high, high), (low, high)].map(DVec2::from).to_vec()
/// };
/// let rings = Rings(vec![square(0.0, 10.0), square(4.0, 6.0)]);
/// let error = Polygon::new(rings.clone()).expect_err("a hole that runs as the outer ring does");
/// assert_eq!(error.message(), "hole 1 of the polygon is counter-clockwise");
///
/// let yard = Polygon::turned(rings)?;
/// assert_eq!((yard.area(), yard.length(), yard.holes().len()), (96.0, 48.0, 1));
/// assert!(!yard.contains(DVec2::splat(5.0)) && yard.contains(DVec2::splat(2.0)));
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Polygon<P = DVec2> {
    rings: Vec<Ring<P>>,
}

impl<P> Default for Polygon<P> {
    fn default() -> Self {
        Self { rings: Vec::new() }
    }
}

impl<P: Point> Polygon<P> {
    /// The polygon inside the first ring and outside the others; fails if a promise is broken, and says where.
    pub fn new(rings: impl Into<Rings<P>>) -> Result<Self> {
        Self::checked(rings.into(), |ring, is_outer, name| {
            if ring.is_counter_clockwise() == is_outer || !has_area(ring.iter().map(|point| point.flat())) {
                return Ok(ring);
            }
            let way = if is_outer { "clockwise" } else { "counter-clockwise" };
            Err(Error::geometry(format!("{name} of the polygon is {way}"))
                .help("an outer ring is counter-clockwise, and a hole is clockwise: reverse it"))
        })
    }

    /// The same, where rings that run the wrong way are turned around; each keeps its first point.
    pub fn turned(rings: impl Into<Rings<P>>) -> Result<Self> {
        Self::checked(rings.into(), |ring, is_outer, _| {
            Ok(if ring.is_counter_clockwise() == is_outer { ring } else { ring.turned() })
        })
    }

    fn checked(rings: Rings<P>, turned: impl Fn(Ring<P>, bool, &str) -> Result<Ring<P>>) -> Result<Self> {
        let mut checked = Vec::with_capacity(rings.len());
        for (index, points) in rings.0.into_iter().enumerate() {
            let name = if index == 0 { "the outer ring".to_owned() } else { format!("hole {index}") };
            let ring = Ring::named(&name, points)?;
            let last = ring.len();
            let pairs = (1..).zip(ring.edges());
            if let Some((number, [a, _])) = pairs.into_iter().find(|(_, [a, b])| a.flat() == b.flat()) {
                let next = number % last + 1;
                let message =
                    format!("points {number} and {next} of {name} of the polygon are both at {}", shown(a));
                return Err(Error::geometry(message).help("leave one out: as seen from above they are one"));
            }
            let ring = turned(ring, index == 0, &name)?;
            if !has_area(ring.iter().map(|point| point.flat())) {
                return Err(Error::geometry(format!("{name} of the polygon has no area"))
                    .help("move a point off the line of the others"));
            }
            checked.push(ring);
        }
        Ok(Self { rings: checked })
    }

    /// The outer ring; none if it is empty.
    pub fn outer(&self) -> Option<&Ring<P>> {
        self.rings.first()
    }

    /// The holes.
    pub fn holes(&self) -> &[Ring<P>] {
        self.rings.get(1..).unwrap_or_default()
    }

    /// The points of all rings.
    pub fn points(&self) -> impl Iterator<Item = P> + Clone + '_ {
        self.rings.iter().flat_map(|ring| ring.iter().copied())
    }

    /// The edges of all rings, each with its two ends.
    pub fn edges(&self) -> impl Iterator<Item = [P; 2]> + Clone + '_ {
        self.rings.iter().flat_map(Ring::edges)
    }

    /// How many edges there are, and points.
    pub fn size(&self) -> usize {
        self.rings.iter().map(|ring| ring.len()).sum()
    }

    /// Its area (m²) without the holes.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(Ring::twice_area).sum::<f64>() / 2.0
    }

    /// The length (m) of all edges as seen from above.
    pub fn length(&self) -> f64 {
        self.rings.iter().map(Ring::length).sum()
    }

    /// Its least and its greatest coordinates (m); `None` if it is empty.
    pub fn bounds(&self) -> Option<[DVec2; 2]> {
        bounds(self.points().map(Point::flat))
    }

    /// Whether `place` is inside the outer ring and outside the holes. On a border the answer may be either.
    pub fn contains(&self, place: DVec2) -> bool {
        self.rings.iter().filter(|ring| contains(ring, place)).count() % 2 == 1
    }

    /// The convex hull as seen from above; `None` if it is empty.
    pub fn hull(&self) -> Option<Ring> {
        hull(self.outer()?.iter().copied())
    }

    /// Its rings as seen from below, where they run the other way.
    pub fn from_below(&self) -> Vec<Ring<P>> {
        self.rings.iter().cloned().map(Ring::reversed).collect()
    }
}

impl<P: Point + Add<Output = P>> Polygon<P> {
    /// The polygon moved by `offset` (m), which is not so great that points which differ are rounded to one.
    #[must_use]
    pub fn moved(self, offset: P) -> Self {
        Self { rings: self.rings.into_iter().map(|ring| ring.moved(offset)).collect() }
    }
}

impl Polygon<DVec3> {
    /// The polygon as seen from above.
    pub fn flat(&self) -> Polygon {
        Polygon { rings: self.rings.iter().map(Ring::flattened).collect() }
    }
}

impl Polygon {
    /// The polygon at a height (m).
    pub fn at_height(&self, height: f64) -> Polygon<DVec3> {
        Polygon { rings: self.rings.iter().map(|ring| ring.at_height(height)).collect() }
    }

    /// Fills it: counter-clockwise triangles of places in [`Polygon::points`].
    ///
    /// Its rings do not meet. Every edge is that of exactly one triangle, also where points lie on a straight line, and
    /// there are no slivers but where the rings leave no choice.
    ///
    /// Method: ear clipping (D. Eberly, "Triangulation by Ear Clipping", 2002), after which edges are flipped until it is
    /// Delaunay but for the rings (C. Lawson, "Software for C1 surface interpolation", 1977); where clipping fails, a
    /// constrained Delaunay triangulation. Fails if it is too narrow somewhere.
    ///
    /// ```
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let angle = [(0.0, 0.0), (2.0, 0.0), (2.0, 1.0), (1.0, 1.0), (1.0, 2.0), (0.0, 2.0)].map(DVec2::from);
    /// let angle = Polygon::new(Rings(vec![angle.to_vec()]))?;
    /// let points: Vec<DVec2> = angle.points().collect();
    /// let triangles = angle.triangles()?;
    /// let area = |[a, b, c]: [usize; 3]| (points[b] - points[a]).perp_dot(points[c] - points[a]) / 2.0;
    /// assert_eq!(triangles.len(), 4);
    /// assert_eq!(triangles.into_iter().map(area).sum::<f64>(), angle.area());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn triangles(&self) -> Result<Vec<[usize; 3]>> {
        cap::triangulate(self)
    }

    /// Its rings without points that are within `distance` (m) of the line between others; they may meet.
    ///
    /// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to represent
    /// a digitized line or its caricature", 1973.
    ///
    /// ```
    /// use burgeon_geometry::{Polygon, Rings};
    /// use glam::DVec2;
    ///
    /// let ring = [(0.0, 0.0), (5.0, 0.1), (10.0, 0.0), (10.0, 6.0), (0.0, 6.0)].map(DVec2::from);
    /// let plan = Polygon::new(Rings(vec![ring.to_vec()]))?;
    /// assert_eq!(plan.simplified(0.2)[0].len(), 4);
    /// assert_eq!(plan.simplified(0.05)[0].len(), 5);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn simplified(&self, distance: f64) -> Rings<DVec2> {
        self.rings.iter().map(|ring| open(&LineString::from(ring).simplify(distance))).collect()
    }
}

impl<P> Deref for Polygon<P> {
    type Target = [Ring<P>];

    fn deref(&self) -> &[Ring<P>] {
        &self.rings
    }
}

impl<'a, P> IntoIterator for &'a Polygon<P> {
    type Item = &'a Ring<P>;
    type IntoIter = std::slice::Iter<'a, Ring<P>>;

    fn into_iter(self) -> Self::IntoIter {
        self.rings.iter()
    }
}
