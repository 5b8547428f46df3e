//! Rings of points.

use std::fmt::Write as _;
use std::ops::{Add, Deref};

use glam::{DVec2, DVec3};

use super::measure::{bounds, contains, edges, hull, twice_area};
use super::{Line, Point};
use burgeon_base::error::{Error, Result};

/// A ring of points, open: it goes on from its last point to its first by itself.
///
/// It has three points or more, all finite, each other than the one before, and the last is not the first again. It may
/// run either way, and if its points have heights it may be any ring in space, such as that of a wall.
///
/// ```
/// use burgeon_geometry::Ring;
/// use glam::DVec2;
///
/// let points = [(0.0, 0.0), (4.0, 0.0), (4.0, 3.0)].map(DVec2::from);
/// let ring = Ring::new(points.to_vec())?;
/// assert_eq!((ring.area(), ring.length()), (6.0, 12.0));
/// assert_eq!(ring.clone().reversed().area(), -6.0);
/// assert!(ring.contains(DVec2::new(3.0, 1.0)) && !ring.contains(DVec2::new(1.0, 2.0)));
///
/// let closed = [points.as_slice(), &points[..1]].concat();
/// let error = Ring::new(closed).expect_err("a ring is open");
/// assert_eq!(error.message(), "the last point of the ring, 4, repeats point 1, (0, 0)");
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Ring<P = DVec2> {
    points: Vec<P>,
}

impl<P: Point> Ring<P> {
    /// The ring of `points`; fails if a promise is broken, and says by which point.
    pub fn new(points: Vec<P>) -> Result<Self> {
        Self::named("the ring", points)
    }

    /// The same, which errors call `name`.
    pub(super) fn named(name: &str, points: Vec<P>) -> Result<Self> {
        check(name, &points)?;
        if let ([first, .., last], count) = (points.as_slice(), points.len())
            && first == last
        {
            let place = shown(*first);
            let message = format!("the last point of {name}, {count}, repeats point 1, {place}");
            return Err(Error::geometry(message).help("leave it out: a ring closes by itself"));
        }
        if points.len() < 3 {
            let count = points.len();
            return Err(Error::geometry(format!("{name} has too few points: {count}"))
                .help("give at least 3 points that differ"));
        }
        Ok(Self { points })
    }

    /// The ring of `points` but those that repeat the one before; `None` if fewer than three are left, or one is not
    /// finite.
    pub fn without_repeats(mut points: Vec<P>) -> Option<Self> {
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        Self::new(points).ok()
    }

    /// Its points.
    pub fn into_points(self) -> Vec<P> {
        self.points
    }

    /// Its edges, each with its two ends, in the order of their first points.
    pub fn edges(&self) -> impl Iterator<Item = [P; 2]> + Clone + '_ {
        edges(&self.points)
    }

    /// The area (m²) inside it as seen from above; negative if it is clockwise.
    pub fn area(&self) -> f64 {
        self.twice_area() / 2.0
    }

    pub(super) fn twice_area(&self) -> f64 {
        twice_area(self.points.iter().copied())
    }

    /// Whether it turns counter-clockwise as seen from above.
    pub fn is_counter_clockwise(&self) -> bool {
        self.twice_area() > 0.0
    }

    /// The length (m) of its edges as seen from above.
    pub fn length(&self) -> f64 {
        self.edges().map(|edge| edge.map(Point::flat)).map(|[a, b]| a.distance(b)).sum()
    }

    /// Its least and its greatest coordinates (m).
    pub fn bounds(&self) -> [DVec2; 2] {
        bounds(self.points.iter().map(|point| point.flat())).unwrap_or_default()
    }

    /// Whether `place` is inside it as seen from above, whichever way it runs. On its border the answer may be either.
    pub fn contains(&self, place: DVec2) -> bool {
        contains(&self.points, place)
    }

    /// The convex hull of its points as seen from above; `None` if they lie on one line.
    pub fn hull(&self) -> Option<Ring> {
        hull(self.points.iter().copied())
    }

    /// The ring in the other direction, from its last point on.
    #[must_use]
    pub fn reversed(mut self) -> Self {
        self.points.reverse();
        self
    }

    /// The ring in the other direction from the same first point on.
    #[must_use]
    pub fn turned(mut self) -> Self {
        self.points[1..].reverse();
        self
    }

    /// The line once around it, whose last point is its first.
    pub fn around(&self) -> Line<P> {
        let closed = self.points.iter().chain(self.points.first()).copied().collect();
        // What is promised of a ring is more than what is promised of a line.
        Line::trusted(closed)
    }
}

impl<P: Point + Add<Output = P>> Ring<P> {
    /// The ring moved by `offset` (m), which is not so great that points which differ are rounded to one.
    #[must_use]
    pub fn moved(mut self, offset: P) -> Self {
        self.points.iter_mut().for_each(|point| *point = *point + offset);
        self
    }
}

impl Ring {
    /// The ring with the height (m) that each of its points is to have, which is finite.
    pub fn raised(&self, height: impl Fn(DVec2) -> f64) -> Ring<DVec3> {
        Ring { points: self.points.iter().map(|&point| point.extend(height(point))).collect() }
    }

    /// The ring at a height (m).
    pub fn at_height(&self, height: f64) -> Ring<DVec3> {
        self.raised(|_| height)
    }
}

impl Ring<DVec3> {
    /// The ring as seen from above; its points differ there as well.
    pub(super) fn flattened(&self) -> Ring {
        Ring { points: self.points.iter().map(|point| point.truncate()).collect() }
    }
}

impl<P> AsRef<[P]> for Ring<P> {
    fn as_ref(&self) -> &[P] {
        &self.points
    }
}

impl<P> Deref for Ring<P> {
    type Target = [P];

    fn deref(&self) -> &[P] {
        &self.points
    }
}

impl<'a, P> IntoIterator for &'a Ring<P> {
    type Item = &'a P;
    type IntoIter = std::slice::Iter<'a, P>;

    fn into_iter(self) -> Self::IntoIter {
        self.points.iter()
    }
}

/// Fails if a point of `name` is not finite, or repeats the one before.
pub(super) fn check<P: Point>(name: &str, points: &[P]) -> Result<()> {
    for (number, point) in (1..).zip(points) {
        if !point.is_finite() {
            return Err(Error::geometry(format!("point {number} of {name} is {}", shown(*point)))
                .help("give finite coordinates in metres"));
        }
        if number > 1 && points[number - 2] == *point {
            let message = format!("point {number} of {name} repeats point {}, {}", number - 1, shown(*point));
            return Err(Error::geometry(message).help("leave one of them out"));
        }
    }
    Ok(())
}

/// A point for a message.
pub(super) fn shown<P: Point>(point: P) -> String {
    let DVec2 { x, y } = point.flat();
    let mut text = format!("({x}, {y})");
    if !point.is_finite() && point.flat().is_finite() {
        let _ = write!(text, " with a height that is no number");
    }
    text
}
