//! Polygons with holes.

use std::borrow::Cow;
use std::ops::{Add, Deref};

use geo::Simplify;
use glam::{DVec2, DVec3};

use super::Rings;
use super::measure::{bounds, contains, has_area};
use super::point::{Point, point_text};
use super::ring::{Ring, hull};
use super::strings::{closed_string, open};
use super::triangulation::triangulate;
use burgeon_base::error::{Error, Result};

/// A polygon: an outer ring and holes; a polygon without rings is empty.
///
/// The outer ring is counter-clockwise and the holes are clockwise as seen from above, and consecutive points
/// of a ring differ as seen from above. A polygon dereferences to the slice of its rings, the outer ring
/// first.
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
    /// Creates a polygon inside the first ring and outside the others; fails with the ring or point that
    /// violates a condition.
    pub fn new(rings: impl Into<Rings<P>>) -> Result<Self> {
        Self::check_rings(rings.into(), |ring, is_outer, name| {
            if ring.is_counter_clockwise() == is_outer || !has_area(ring.iter().map(|point| point.flat())) {
                return Ok(ring);
            }
            let way = if is_outer { "clockwise" } else { "counter-clockwise" };
            Err(Error::geometry(format!("{name} of the polygon is {way}"))
                .help("an outer ring is counter-clockwise, and a hole is clockwise: reverse it"))
        })
    }

    /// Creates a polygon like [`Polygon::new`], and reverses rings with the wrong direction; each ring keeps
    /// its first point.
    pub fn turned(rings: impl Into<Rings<P>>) -> Result<Self> {
        Self::check_rings(rings.into(), |ring, is_outer, _| {
            Ok(if ring.is_counter_clockwise() == is_outer { ring } else { ring.turned() })
        })
    }

    fn check_rings(rings: Rings<P>, turned: impl Fn(Ring<P>, bool, &str) -> Result<Ring<P>>) -> Result<Self> {
        let mut checked = Vec::with_capacity(rings.len());
        for (index, points) in rings.0.into_iter().enumerate() {
            let name = match index {
                0 => Cow::Borrowed("the outer ring"),
                _ => format!("hole {index}").into(),
            };
            let ring = Ring::with_name(&name, points)?;
            let last = ring.len();
            let pairs = (1..).zip(ring.edges());
            if let Some((number, [a, _])) = pairs.into_iter().find(|(_, [a, b])| a.flat() == b.flat()) {
                let next = number % last + 1;
                let message = format!(
                    "points {number} and {next} of {name} of the polygon are both at {}",
                    point_text(a)
                );
                return Err(Error::geometry(message).help("remove one: they are equal as seen from above"));
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

    /// Returns the outer ring; `None` if the polygon is empty.
    pub fn outer(&self) -> Option<&Ring<P>> {
        self.rings.first()
    }

    /// Returns the holes.
    pub fn holes(&self) -> &[Ring<P>] {
        self.rings.get(1..).unwrap_or_default()
    }

    /// Returns the points of all rings.
    pub fn points(&self) -> impl Iterator<Item = P> + Clone + '_ {
        self.rings.iter().flat_map(|ring| ring.iter().copied())
    }

    /// Returns the edges of all rings, each as its two ends.
    pub fn edges(&self) -> impl Iterator<Item = [P; 2]> + Clone + '_ {
        self.rings.iter().flat_map(Ring::edges)
    }

    /// Returns the number of edges, which is also the number of points.
    pub fn size(&self) -> usize {
        self.rings.iter().map(|ring| ring.len()).sum()
    }

    /// Returns the area (m²) without the holes.
    pub fn area(&self) -> f64 {
        self.rings.iter().map(Ring::twice_area).sum::<f64>() / 2.0
    }

    /// Returns the horizontal length (m) of all edges.
    pub fn length(&self) -> f64 {
        self.rings.iter().map(Ring::length).sum()
    }

    /// Returns the minimum and maximum coordinates (m); `None` if the polygon is empty.
    pub fn bounds(&self) -> Option<[DVec2; 2]> {
        bounds(self.points().map(Point::flat))
    }

    /// Returns true if `place` is inside the outer ring and outside the holes; on a border the result may be
    /// either.
    pub fn contains(&self, place: DVec2) -> bool {
        self.rings.iter().filter(|ring| contains(ring, place)).count() % 2 == 1
    }

    /// Returns the horizontal convex hull; `None` if the polygon is empty.
    pub fn hull(&self) -> Option<Ring> {
        hull(self.outer()?.iter().copied())
    }

    /// Returns the rings reversed, as seen from below.
    pub fn from_below(&self) -> Vec<Ring<P>> {
        self.rings.iter().cloned().map(Ring::reversed).collect()
    }
}

impl<P: Point + Add<Output = P>> Polygon<P> {
    /// Moves the polygon by `offset` (m), which must be small enough that distinct points stay distinct after
    /// rounding.
    #[must_use]
    pub fn moved(self, offset: P) -> Self {
        Self { rings: self.rings.into_iter().map(|ring| ring.moved(offset)).collect() }
    }
}

impl Polygon<DVec3> {
    /// Projects the polygon onto the horizontal plane.
    pub fn flat(&self) -> Polygon {
        Polygon { rings: self.rings.iter().map(Ring::flattened).collect() }
    }
}

impl Polygon {
    /// Returns the polygon at a height (m).
    pub fn at_height(&self, height: f64) -> Polygon<DVec3> {
        Polygon { rings: self.rings.iter().map(|ring| ring.at_height(height)).collect() }
    }

    /// Triangulates the polygon, and returns counter-clockwise triangles of indices into [`Polygon::points`].
    ///
    /// The rings must not intersect. Every edge belongs to exactly one triangle, even if points are
    /// collinear. Slivers occur only where the rings leave no choice.
    ///
    /// Method: ear clipping (D. Eberly, "Triangulation by Ear Clipping", 2002), then edge flips until the
    /// triangulation is constrained Delaunay (C. Lawson, "Software for C1 surface interpolation", 1977); if
    /// clipping fails, a constrained Delaunay triangulation. Fails if the polygon is too narrow at some
    /// point.
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
        triangulate(self)
    }

    /// Returns the rings without points that are within `distance` (m) of the line between others; the result
    /// may intersect itself.
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
        self.rings.iter().map(|ring| open(&closed_string(ring).simplify(distance))).collect()
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

impl<P: Clone> From<&Polygon<P>> for Rings<P> {
    fn from(polygon: &Polygon<P>) -> Self {
        polygon.iter().map(|ring| ring.to_vec()).collect()
    }
}
