//! Building footprints: cleaned and repaired outlines.

use glam::{DVec2, DVec3};
use smallvec::SmallVec;
use std::borrow::Cow;

use super::repair::{PlanRepair, fill, repair};
use crate::cross_section::outline::{OutlineOptions, numbered_rings};
use crate::cross_section::point::SectionPoint;
use crate::planar::{Polygon, Rings};
use burgeon_base::error::{Error, Limit, Result};

const PLAN: OutlineOptions = OutlineOptions { owner: "footprint", near: 0.01, straight: 2e-3 };

/// Maximum number of input points of a footprint.
const MOST_GIVEN: usize = 100_000;
/// Maximum number of corners of a simplified footprint: the time for a roof grows with their square.
const MOST_CORNERS: usize = 20_000;

/// The outline of a building: a polygon whose points have heights and whose rings do not intersect.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    polygon: Polygon<DVec3>,
    given: EdgeOrigin,
    /// Number of points of each input ring.
    sizes: Vec<usize>,
    repairs: Vec<&'static str>,
    trouble: String,
}

/// Relation between the edges of a plan and the input edges.
#[derive(Debug, Clone)]
enum EdgeOrigin {
    /// Index in its input ring (counted from 0) of each point.
    Places(Vec<Vec<usize>>),
    /// Input edges of each edge, counted from 0 over all rings.
    Edges(Vec<Vec<usize>>),
}

impl Default for EdgeOrigin {
    fn default() -> Self {
        Self::Places(Vec::new())
    }
}

impl Plan {
    /// Creates a plan from the area inside the first ring and outside the other rings; their directions do
    /// not matter.
    ///
    /// Simplifies the rings: the plan stays within 2 mm of them, or within 1 cm at edges that are shorter
    /// than 1 cm, regardless of the number of points. Drops spikes that are at most 2 mm wide, and fills
    /// openings that are nowhere wider than 1 cm. If rings cross or touch themselves or each other, or if a
    /// hole is not inside the outer ring, the plan is the largest part of the enclosed area.
    /// [`Plan::repairs`] lists filled openings and all other repairs. Fails with the position if the rings
    /// enclose no area.
    ///
    /// ```
    /// use burgeon_geometry::{Plan, Rings};
    /// use glam::{DVec2, DVec3};
    ///
    /// // It crosses itself where x is 6: what is on the right of that is a loop of its own.
    /// let ring = [(0.0, 0.0), (8.0, 4.0), (8.0, 2.0), (0.0, 6.0)].map(|(x, y)| DVec3::new(x, y, 0.0));
    /// let plan = Plan::new(&Rings(vec![ring.to_vec()]))?;
    /// assert_eq!(plan.repairs().0, ["loops of the outer ring removed"]);
    /// assert!((plan.polygon().area() - 18.0).abs() < 1e-6);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn new(rings: &Rings) -> Result<Self> {
        let count: usize = rings.iter().map(Vec::len).sum();
        if count > MOST_GIVEN {
            return Err(Error::limit(Limit::Size, format!("the footprint has {count} points"))
                .help(format!("simplify it: a footprint can have at most {MOST_GIVEN} points")));
        }
        let Some((outer, holes)) = rings.split_first() else {
            return Err(Error::geometry("the footprint has no ring").help("add a ring of at least 3 points"));
        };
        let sharp = |ring: &Vec<DVec3>| -> Vec<SectionPoint> {
            ring.iter().map(|point| SectionPoint::sharp(point.truncate())).collect()
        };
        for (ring, number, point) in rings.iter().enumerate().flat_map(|(ring, points)| {
            points.iter().enumerate().map(move |(number, point)| (ring, number + 1, point))
        }) {
            if point.z.is_nan() || point.z.abs() > 20_000.0 {
                let name = match ring {
                    0 => Cow::Borrowed("the outer ring"),
                    _ => format!("hole {ring}").into(),
                };
                let message =
                    format!("point {number} of {name} of the footprint has the height {} m", point.z);
                return Err(Error::geometry(message).help("give heights from -20000 to 20000 m"));
            }
        }
        let holes: Vec<Vec<SectionPoint>> = holes.iter().map(sharp).collect();
        let sizes = rings.iter().map(Vec::len).collect();
        let clean = match numbered_rings(&sharp(outer), &holes, &PLAN) {
            Ok(clean) => clean,
            Err(error) => {
                let Some(repair) = repair(rings, &PLAN) else { return Err(error) };
                return Ok(Self::from_repair(repair, sizes, error.into_message()));
            }
        };
        let corners: usize = clean.iter().map(Vec::len).sum();
        if corners > MOST_CORNERS {
            let message = format!("the footprint has {corners} corners after it is simplified to 2 mm");
            return Err(Error::limit(Limit::Size, message)
                .help(format!("simplify it: a footprint can have at most {MOST_CORNERS} corners")));
        }
        let sound: Vec<Vec<DVec2>> =
            clean.iter().map(|ring| ring.iter().map(|point| point.point.at).collect()).collect();
        if let Some(repair) = fill(rings, &sound, &PLAN) {
            let trouble = repair.slit.map_or_else(String::new, |slit| slit.describe());
            return Ok(Self::from_repair(repair, sizes, trouble));
        }
        let places: Vec<Vec<usize>> =
            clean.iter().map(|ring| ring.iter().map(|point| point.number - 1).collect()).collect();
        let rings = places
            .iter()
            .zip(&**rings)
            .map(|(places, ring)| places.iter().map(|&place| ring[place]).collect());
        let polygon = Polygon::new(rings.collect::<Rings>())?;
        Ok(Self { polygon, given: EdgeOrigin::Places(places), sizes, ..Self::default() })
    }

    fn from_repair(repair: PlanRepair, sizes: Vec<usize>, trouble: String) -> Self {
        let PlanRepair { polygon, given, notes, .. } = repair;
        Self { polygon, given: EdgeOrigin::Edges(given), sizes, repairs: notes, trouble }
    }

    /// Returns the polygon (m) with ground heights.
    pub fn polygon(&self) -> &Polygon<DVec3> {
        &self.polygon
    }

    /// Returns the input edges that each edge of the plan corresponds to, counted from 0 over all input
    /// rings.
    ///
    /// An edge runs from its point to the next point.
    ///
    /// ```
    /// use burgeon_geometry::{Plan, Rings};
    /// use glam::DVec3;
    ///
    /// // The second point is on the line from the first to the third.
    /// let survey = [(0.0, 0.0), (5.0, 0.0), (9.0, 0.0), (9.0, 6.0), (0.0, 6.0)];
    /// let plan = Plan::new(&Rings(vec![survey.map(|(x, y)| DVec3::new(x, y, 0.0)).to_vec()]))?;
    /// assert_eq!((plan.given(), plan.polygon().size()), (5, 4));
    /// let edges = plan.given_edges();
    /// assert!(edges.iter().any(|edge| edge[..] == [0, 1]) && edges.iter().any(|edge| edge[..] == [3]));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn given_edges(&self) -> Vec<SmallVec<[usize; 2]>> {
        let places = match &self.given {
            EdgeOrigin::Places(places) => places,
            EdgeOrigin::Edges(edges) => {
                return edges.iter().map(|edges| SmallVec::from_slice(edges)).collect();
            }
        };
        let mut given = Vec::with_capacity(self.polygon.size());
        let mut first = 0;
        for (places, &size) in places.iter().zip(&self.sizes) {
            let next = |index: usize| places[(index + 1) % places.len()];
            let rising = (0..places.len()).filter(|&index| places[index] < next(index)).count();
            let forward = rising > places.len() / 2;
            given.extend(places.iter().enumerate().map(|(index, &place)| {
                let (from, to) = if forward { (place, next(index)) } else { (next(index), place) };
                let count = (to + size - from) % size;
                (0..count).map(|step| first + (from + step) % size).collect()
            }));
            first += size;
        }
        given
    }

    /// Returns the repairs that were needed to create the plan, and the defect of the input rings.
    pub fn repairs(&self) -> (&[&'static str], &str) {
        (&self.repairs, &self.trouble)
    }

    /// Returns the number of input edges.
    pub fn given(&self) -> usize {
        self.sizes.iter().sum()
    }

    /// Moves the plan by `offset` (m).
    pub fn moved(mut self, offset: DVec3) -> Self {
        self.polygon = self.polygon.moved(offset);
        self
    }

    /// Returns the polygon projected onto the horizontal plane (m).
    pub fn flat(&self) -> Polygon {
        self.polygon.flat()
    }

    /// Returns the ratio of the area to the area of the convex hull: 1 for a convex plan without holes.
    ///
    /// ```
    /// use burgeon_geometry::{Plan, Rings};
    /// use glam::DVec3;
    ///
    /// let corner = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)];
    /// let corner = corner.map(|(x, y)| DVec3::new(f64::from(x), f64::from(y), 0.0)).to_vec();
    /// let plan = Plan::new(&Rings(vec![corner]))?;
    /// assert!((plan.convexity() - 3.0 / 3.5).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn convexity(&self) -> f64 {
        let whole = self.polygon.hull().map_or(0.0, |hull| hull.area());
        if whole > 0.0 { self.polygon.area() / whole } else { 0.0 }
    }

    /// Returns the lowest and the highest ground height (m).
    pub fn ground(&self) -> (f64, f64) {
        let heights = self.polygon.points().map(|point| point.z);
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)))
    }
}
