//! Cross-sections: the flat shape that a sweep moves along a path.

use std::sync::OnceLock;

use glam::DVec2;

use super::outline;
use super::point::{Knot, SectionPoint};
use super::skin::Skin;
use crate::planar::{Rings, triangulate};
use burgeon_base::error::{Error, Limit, Result};

/// Maximum number of points of a cross-section.
pub const MOST_POINTS: usize = 10_000;

/// A cross-section in its own plane, in metres at scale 1.
///
/// x is to the right and y is up, as seen against the extrusion direction. The outer ring is
/// counter-clockwise and the holes are clockwise, regardless of the input directions. An open section is one
/// line without holes; its sweep is a ribbon whose front is to the right of the line's direction.
#[derive(Debug, Clone)]
pub struct Section {
    rings: Vec<Vec<Knot>>,
    open: bool,
    cap: Vec<[usize; 3]>,
    /// Cached divisions into faces: with edges at all points, or only at sharp points.
    skins: [OnceLock<Skin>; 2],
}

// All other fields follow from these.
impl PartialEq for Section {
    fn eq(&self, other: &Self) -> bool {
        self.open == other.open && self.rings == other.rings
    }
}

impl Section {
    /// Creates a section from an outer ring and holes, each in either direction and without a repeated last
    /// point.
    ///
    /// Drops repeated points, and sharp points on a straight line between sharp points. Fails if a coordinate
    /// is not finite, if a ring has fewer than 3 distinct points or no area, if rings cross or touch
    /// themselves or each other, or if a hole is outside the outer ring or inside another hole.
    pub fn new(rings: &Rings<SectionPoint>) -> Result<Self> {
        refuse_too_many(rings.iter().map(Vec::len).sum())?;
        let (outer, holes) =
            rings.split_first().map_or((&[][..], &[][..]), |(outer, holes)| (&outer[..], holes));
        let rings = outline::closed(outer, holes)?;
        Self::with_rings(rings.iter().map(|ring| knots(ring)).collect(), false)
    }

    /// Creates a section from a ring that is known to be counter-clockwise, convex and valid.
    pub(crate) fn convex<const N: usize>(points: [SectionPoint; N]) -> Self {
        let cap = (1..N - 1).map(|corner| [0, corner, corner + 1]).collect();
        Self { rings: vec![knots(&points)], open: false, cap, skins: Default::default() }
    }

    /// Creates a section from rings of sharp points (m), with the conditions of [`Section::new`].
    ///
    /// ```
    /// use burgeon_geometry::{Rings, Section};
    /// use glam::DVec2;
    ///
    /// let square = |half: f64| [(-half, -half), (half, -half), (half, half), (-half, half)].map(DVec2::from);
    /// let tube = Section::polygon(&Rings(vec![square(2.0).to_vec(), square(1.0).to_vec()]))?;
    /// assert_eq!((tube.area(), tube.perimeter(), tube.cap().len()), (12.0, 24.0, 8));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn polygon(rings: &Rings<DVec2>) -> Result<Self> {
        let sharp = |ring: &Vec<DVec2>| ring.iter().copied().map(SectionPoint::sharp).collect();
        Self::new(&rings.iter().map(sharp).collect())
    }

    /// Creates an open section, swept to a ribbon; fails if it has fewer than 2 distinct points or intersects
    /// itself.
    ///
    /// ```
    /// use burgeon_geometry::{Section, SectionPoint, Segment, SweepOptions, sweep};
    /// use glam::DVec2;
    ///
    /// let section = Section::open(&[DVec2::ZERO, DVec2::X].map(SectionPoint::sharp))?;
    /// let (mut part, mut path) = (Default::default(), Vec::new());
    /// Segment { length: 3.0, ..Segment::default() }.stations(Default::default(), &mut path)?;
    /// let ribbon = sweep(&mut part, &section, &path, &SweepOptions { back: false, ..SweepOptions::default() })?;
    /// assert_eq!((part.triangles.len(), ribbon.open.len()), (2, 4));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn open(points: &[SectionPoint]) -> Result<Self> {
        refuse_too_many(points.len())?;
        Self::with_rings(vec![knots(&outline::open(points)?)], true)
    }

    /// Marks all corners as smooth or as sharp.
    #[must_use]
    pub fn marked(mut self, smooth: bool) -> Self {
        self.rings.iter_mut().flatten().for_each(|knot| knot.smooth = smooth);
        self.skins = Default::default();
        self
    }

    /// Marks corners as smooth, except where the outline turns by more than `angle` (radians).
    #[must_use]
    pub fn creased(mut self, angle: f64) -> Self {
        for ring in &mut self.rings {
            let places: Vec<DVec2> = ring.iter().map(|knot| knot.at).collect();
            let count = places.len();
            for (index, knot) in ring.iter_mut().enumerate() {
                let before = knot.at - places[(index + count - 1) % count];
                let after = places[(index + 1) % count] - knot.at;
                knot.smooth = before.angle_to(after).abs() <= angle;
            }
        }
        self.skins = Default::default();
        self
    }

    /// Divides the edges evenly, so that the first ring has at least `around` points and the holes have
    /// points of the same density.
    ///
    /// The shading stays the same.
    ///
    /// ```
    /// use burgeon_geometry::Section;
    ///
    /// let square = Section::rectangle(2.0, 2.0)?;
    /// let finer = square.resampled(16)?;
    /// assert_eq!((square.corners(), finer.corners()), (4, 16));
    /// assert_eq!(finer.edge_lengths(0), [0.5; 16]);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn resampled(&self, around: usize) -> Result<Self> {
        refuse_too_many(around)?;
        let step = self.edge_lengths(0).iter().sum::<f64>() / around.max(1) as f64;
        self.divide_edges(|from, to| {
            // The margin prevents rounding from adding a point if the length is an integer number of steps.
            let pieces = ((to.distance(from) / step - 1e-9).ceil()).max(1.0) as usize;
            (1..pieces).map(|i| from.lerp(to, i as f64 / pieces as f64)).collect()
        })
    }

    /// Adds a point to each edge wherever another point has the same `axis` coordinate.
    ///
    /// If the section is then squeezed to a line along that axis, its edges coincide in pairs.
    pub(crate) fn divided_at_levels(&self, axis: usize) -> Result<Self> {
        let mut levels: Vec<f64> = self.knots().map(|knot| knot.at[axis]).collect();
        levels.sort_by(f64::total_cmp);
        levels.dedup_by(|next, kept| *next - *kept < 1e-9);
        let level = |value: f64| levels[levels.partition_point(|level| *level <= value).max(1) - 1];
        let mut aligned = self.clone();
        aligned.rings.iter_mut().flatten().for_each(|knot| knot.at[axis] = level(knot.at[axis]));
        aligned.divide_edges(|from, to| {
            let (low, high) = (from[axis].min(to[axis]), from[axis].max(to[axis]));
            let between = levels.iter().copied().filter(|level| low < *level && *level < high);
            let mut points: Vec<DVec2> = between
                .map(|level| {
                    let mut point = from.lerp(to, (level - from[axis]) / (to[axis] - from[axis]));
                    point[axis] = level;
                    point
                })
                .collect();
            if from[axis] > to[axis] {
                points.reverse();
            }
            points
        })
    }

    fn divide_edges(&self, inside: impl Fn(DVec2, DVec2) -> Vec<DVec2>) -> Result<Self> {
        let mut rings = Vec::with_capacity(self.rings.len());
        let mut count = 0;
        for ring in &self.rings {
            let mut knots = Vec::new();
            for (index, &knot) in ring.iter().enumerate() {
                knots.push(knot);
                if index + 1 < ring.len() || !self.open {
                    let inserted = inside(knot.at, ring[(index + 1) % ring.len()].at).into_iter();
                    knots.extend(inserted.map(|at| Knot { at, smooth: true, inserted: true }));
                }
                refuse_too_many(count + knots.len())?;
            }
            count += knots.len();
            rings.push(knots);
        }
        Self::with_rings(rings, self.open)
    }

    fn with_rings(rings: Vec<Vec<Knot>>, open: bool) -> Result<Self> {
        let outlines: Vec<Vec<DVec2>> =
            rings.iter().map(|ring| ring.iter().map(|knot| knot.at).collect()).collect();
        let cap = if open { Vec::new() } else { triangulate(&outlines)? };
        Ok(Self { rings, open, cap, skins: Default::default() })
    }

    /// Returns true if the section is a line and its sweep is a ribbon.
    pub fn is_open(&self) -> bool {
        self.open
    }

    /// Returns the points of all rings in order, the first ring first.
    pub fn points(&self) -> impl Iterator<Item = DVec2> {
        self.knots().map(|knot| knot.at)
    }

    /// Returns the number of points of all rings.
    pub fn corners(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// Returns the number of rings: 1 plus the number of holes.
    pub fn ring_count(&self) -> usize {
        self.rings.len()
    }

    /// Returns the lengths (m) of the edges of the ring with this index, in order; empty if the ring does not
    /// exist.
    pub fn edge_lengths(&self, ring: usize) -> Vec<f64> {
        let Some(ring) = self.rings.get(ring) else { return Vec::new() };
        let edges = ring.len() - usize::from(self.open);
        (0..edges).map(|i| ring[i].at.distance(ring[(i + 1) % ring.len()].at)).collect()
    }

    /// Returns the length (m) of the outline and of all holes.
    pub fn perimeter(&self) -> f64 {
        (0..self.rings.len()).flat_map(|ring| self.edge_lengths(ring)).sum()
    }

    /// Returns the area (m²) without the holes; 0 if the section is open.
    pub fn area(&self) -> f64 {
        let points: Vec<DVec2> = self.points().collect();
        self.cap.iter().map(|&[a, b, c]| (points[b] - points[a]).perp_dot(points[c] - points[a]) / 2.0).sum()
    }

    /// Returns counter-clockwise triangles that fill the section, as indices into [`Section::points`].
    pub fn cap(&self) -> &[[usize; 3]] {
        &self.cap
    }

    /// Returns the maximum distance (m) of a point from the y axis and from the x axis.
    pub fn reach(&self) -> DVec2 {
        self.points().fold(DVec2::ZERO, |reach, point| reach.max(point.abs()))
    }

    pub(crate) fn rings(&self) -> &[Vec<Knot>] {
        &self.rings
    }

    /// Returns the division into faces, with edges at the sharp points, or at all points unless `around`
    /// requests smooth shading.
    pub(crate) fn skin(&self, around: bool) -> &Skin {
        self.skins[usize::from(around)].get_or_init(|| Skin::new(&self.rings, self.open, around))
    }

    fn knots(&self) -> impl Iterator<Item = &Knot> {
        self.rings.iter().flatten()
    }
}

fn knots(ring: &[SectionPoint]) -> Vec<Knot> {
    ring.iter().map(|point| Knot { at: point.at, smooth: point.smooth, inserted: false }).collect()
}

pub(crate) fn refuse_too_many(points: usize) -> Result<()> {
    if points <= MOST_POINTS {
        return Ok(());
    }
    Err(Error::limit(Limit::Size, format!("a cross-section of {points} points is too fine"))
        .help(format!("give at most {MOST_POINTS} points")))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn vectors(points: &[(f64, f64)]) -> Vec<DVec2> {
        points.iter().map(|&(x, y)| DVec2::new(x, y)).collect()
    }

    fn message(outer: &[(f64, f64)], holes: &[&[(f64, f64)]]) -> String {
        let holes = holes.iter().map(|hole| vectors(hole));
        let rings = std::iter::once(vectors(outer)).chain(holes).collect();
        Section::polygon(&rings).expect_err("a section that is refused").to_string()
    }

    const SQUARE: [(f64, f64); 4] = [(0., 0.), (4., 0.), (4., 4.), (0., 4.)];

    #[test]
    fn rings_are_turned_and_useless_points_dropped() {
        let outer = [(0., 4.), (4., 4.), (4., 4.), (4., 0.), (2., 0.), (0., 0.), (0., 4.)];
        let hole = vectors(&[(1., 1.), (2., 1.), (2., 2.), (1., 2.)]);
        let section = Section::polygon(&vec![vectors(&outer), hole].into()).expect("a section");
        let points: Vec<_> = section.points().map(|p| (p.x, p.y)).collect();
        assert_eq!(points[..4], [(0., 4.), (0., 0.), (4., 0.), (4., 4.)]);
        assert_eq!(points[4..], [(1., 1.), (1., 2.), (2., 2.), (2., 1.)]);
        assert_eq!((section.area(), section.perimeter()), (15.0, 20.0));
    }

    #[test]
    fn a_straight_point_next_to_a_round_one_stays_since_it_holds_the_shading() {
        let mut points: Vec<_> =
            vectors(&[(0., 0.), (2., 0.), (4., 0.), (4., 4.)]).into_iter().map(SectionPoint::sharp).collect();
        points[0].smooth = true;
        assert_eq!(Section::new(&Rings(vec![points])).expect("a section").points().count(), 4);
    }

    #[test]
    fn resampling_gives_the_number_of_points_asked_for_and_the_same_shape() {
        let section = Section::regular(8).expect("an octagon");
        let finer = section.resampled(32).expect("an octagon of 32 points");
        assert_eq!(finer.points().count(), 32);
        assert!((finer.area() - section.area()).abs() < 1e-12);
        let hole = vectors(&[(1., 1.), (1., 3.), (3., 3.), (3., 1.)]);
        let frame = Section::polygon(&vec![vectors(&SQUARE), hole].into()).expect("a frame");
        assert_eq!(frame.resampled(16).expect("a finer frame").points().count(), 16 + 8);
    }

    #[test]
    fn a_ring_that_is_no_ring_is_refused() {
        insta::assert_snapshot!(message(&[(0., 0.), (1., 0.), (1., 0.), (0., 0.)], &[]), @r"
        the outer ring of the cross-section has 2 distinct points
          help: give at least 3 points that differ
        ");
        insta::assert_snapshot!(message(&[(0., 0.), (1., 1.), (2., 2.)], &[]), @r"
        the outer ring of the cross-section has no area: its points lie on one line
          help: move a point off the line, or use an open cross-section
        ");
        insta::assert_snapshot!(message(&[(0., 0.), (1., f64::NAN), (2., 2.)], &[]), @r"
        point 2 of the outer ring of the cross-section is (1, NaN)
          help: give coordinates in metres, up to 1e9
        ");
        insta::assert_snapshot!(Section::open(&[SectionPoint::sharp(DVec2::X); 2]).expect_err("a point"), @r"
        the line of an open cross-section has fewer than 2 distinct points
          help: give at least 2 distinct points
        ");
    }

    #[test]
    fn a_ring_that_meets_itself_is_refused_by_its_edges_and_the_place() {
        insta::assert_snapshot!(message(&[(0., 0.), (2., 2.), (2., 0.), (0., 1.)], &[]), @r"
        edges 1-2 and 3-4 of the outer ring of the cross-section meet at (0.667, 0.667)
          help: edges are numbered by their points, from 1; move these points apart or remove some
        ");
        insta::assert_snapshot!(message(&[(0., 0.), (4., 0.), (2., 0.), (2., 2.)], &[]), @r"
        edges 1-2 and 2-3 of the outer ring of the cross-section meet at (4.000, 0.000)
          help: edges are numbered by their points, from 1; move these points apart or remove some
        ");
        insta::assert_snapshot!(message(&[(0., 0.), (4., 0.), (4., 4.), (2., 0.), (0., 4.)], &[]), @r"
        edges 1-2 and 4-5 of the outer ring of the cross-section meet at (2.000, 0.000)
          help: edges are numbered by their points, from 1; move these points apart or remove some
        ");
    }

    #[test]
    fn a_hole_that_is_not_inside_is_refused() {
        insta::assert_snapshot!(message(&SQUARE, &[&[(5., 1.), (6., 1.), (6., 2.)]]), @r"
        hole 1 of the cross-section is outside the outer ring: it begins at (5.000, 1.000)
          help: a hole lies inside the outer ring and outside the other holes
        ");
        insta::assert_snapshot!(message(&SQUARE, &[&[(1., 1.), (6., 1.), (1., 2.)]]), @r"
        edge 1-2 of hole 1 meets edge 2-3 of the outer ring of the cross-section at (4.000, 1.000)
          help: edges are numbered by their points, from 1; move these points apart or remove some
        ");
        insta::assert_snapshot!(
            message(&SQUARE, &[&[(1., 1.), (3., 1.), (3., 3.), (1., 3.)], &[(1.5, 1.5), (2., 2.), (2., 1.5)]]),
            @r"
            hole 2 of the cross-section is inside hole 1: it begins at (1.500, 1.500)
              help: a hole lies inside the outer ring and outside the other holes
            "
        );
    }
}
