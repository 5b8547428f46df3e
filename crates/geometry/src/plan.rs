//! Plans: the outline of a building on the ground, made clean, repaired or refused.

use geo::{ConvexHull, Coord, LineString};
use glam::{DVec2, DVec3};
use smallvec::SmallVec;

use super::outline::{Manner, numbered_rings};
use super::repair::{Repaired, repair};
use super::section::{MOST_POINTS, SectionPoint};
use burgeon_base::error::{Error, Limit, Result};

const PLAN: Manner = Manner { owner: "footprint", near: 0.01, straight: 2e-3 };

/// The outline of a building: an outer ring and holes whose points have heights.
///
/// The outer ring is counter-clockwise, the holes are clockwise, seen from above.
#[derive(Debug, Clone, Default)]
pub struct Plan {
    rings: Vec<Vec<DVec3>>,
    given: Given,
    /// How many points the rings had that were given.
    sizes: Vec<usize>,
    repairs: Vec<&'static str>,
    trouble: String,
}

/// What the edges of a plan stand for.
#[derive(Debug, Clone)]
enum Given {
    /// For each point the place, counted from 0, that it had in its ring.
    Places(Vec<Vec<usize>>),
    /// For each edge the edges that were given, counted from 0 over all rings.
    Edges(Vec<Vec<usize>>),
}

impl Default for Given {
    fn default() -> Self {
        Self::Places(Vec::new())
    }
}

impl Plan {
    /// The plan inside the first ring and outside the others, whichever way they run.
    ///
    /// Points within 1 cm of the one before are dropped, and so are points within 2 mm of the line between
    /// their neighbours and the tips of spikes. Where rings cross or touch themselves or each other, or a hole is
    /// not inside the outer ring, the greatest part of what they enclose is the plan, and [`Plan::repairs`] tells
    /// what was done. Fails, with the place, if nothing is enclosed.
    pub fn new(rings: &[Vec<DVec3>]) -> Result<Self> {
        let count: usize = rings.iter().map(Vec::len).sum();
        if count > MOST_POINTS {
            return Err(Error::limit(Limit::Size, format!("the footprint has {count} points"))
                .help(format!("simplify it to at most {MOST_POINTS} points")));
        }
        let Some((outer, holes)) = rings.split_first() else {
            return Err(Error::geometry("the footprint has no ring").help("give it at least 3 points"));
        };
        let sharp = |ring: &Vec<DVec3>| -> Vec<SectionPoint> {
            ring.iter().map(|point| SectionPoint::sharp(point.truncate())).collect()
        };
        for (ring, number, point) in rings.iter().enumerate().flat_map(|(ring, points)| {
            points.iter().enumerate().map(move |(number, point)| (ring, number + 1, point))
        }) {
            if point.z.is_nan() || point.z.abs() > 20_000.0 {
                let name = if ring == 0 { "the outer ring".to_owned() } else { format!("hole {ring}") };
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
                let Some(Repaired { rings, given, notes }) = repair(rings, &PLAN) else { return Err(error) };
                let trouble = error.message().to_owned();
                return Ok(Self { rings, given: Given::Edges(given), sizes, repairs: notes, trouble });
            }
        };
        let places: Vec<Vec<usize>> =
            clean.iter().map(|ring| ring.iter().map(|point| point.number - 1).collect()).collect();
        let rings =
            places.iter().zip(rings).map(|(places, ring)| places.iter().map(|&place| ring[place]).collect());
        let rings = rings.collect();
        Ok(Self { rings, given: Given::Places(places), sizes, ..Self::default() })
    }

    /// The rings (m), with the heights of the ground.
    pub fn rings(&self) -> &[Vec<DVec3>] {
        &self.rings
    }

    /// For each edge of all rings, the edges that it stands for: those of the rings that were given, counted from 0
    /// over all of them. An edge goes from its point to the next one.
    pub fn given_edges(&self) -> Vec<SmallVec<[usize; 2]>> {
        let places = match &self.given {
            Given::Places(places) => places,
            Given::Edges(edges) => return edges.iter().map(|edges| SmallVec::from_slice(edges)).collect(),
        };
        let mut given = Vec::with_capacity(self.edges());
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

    /// What was done to make a plan of the rings, if that was needed, and what was wrong with them.
    pub fn repairs(&self) -> (&[&'static str], &str) {
        (&self.repairs, &self.trouble)
    }

    /// The number of edges of the rings that were given.
    pub fn given(&self) -> usize {
        self.sizes.iter().sum()
    }

    /// The plan moved by `offset` (m).
    pub fn moved(mut self, offset: DVec3) -> Self {
        self.rings.iter_mut().flatten().for_each(|point| *point += offset);
        self
    }

    /// The rings as seen from above (m).
    pub fn flat(&self) -> Vec<Vec<DVec2>> {
        self.rings.iter().map(|ring| ring.iter().map(|point| point.truncate()).collect()).collect()
    }

    /// The number of edges.
    pub fn edges(&self) -> usize {
        self.rings.iter().map(Vec::len).sum()
    }

    /// The area (m²) without the holes.
    pub fn area(&self) -> f64 {
        self.flat().iter().map(|ring| twice_area(ring)).sum::<f64>() / 2.0
    }

    /// The length (m) of all edges, seen from above.
    pub fn perimeter(&self) -> f64 {
        let length = |ring: &Vec<DVec2>| -> f64 {
            (0..ring.len()).map(|index| ring[index].distance(ring[(index + 1) % ring.len()])).sum()
        };
        self.flat().iter().map(length).sum()
    }

    /// The area as a part of its convex hull's: 1 if it is convex and has no holes.
    pub fn convexity(&self) -> f64 {
        let points = self.flat().into_iter().next().unwrap_or_default();
        let line: LineString = points.iter().map(|point| Coord { x: point.x, y: point.y }).collect();
        let hull = line.convex_hull();
        let mut hull: Vec<DVec2> = hull.exterior().0.iter().map(|at| DVec2::new(at.x, at.y)).collect();
        hull.pop();
        // From its westernmost corner on, so that the sum does not depend on where the outline begins.
        let west = |a: &DVec2, b: &DVec2| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y));
        let first = (0..hull.len()).min_by(|&a, &b| west(&hull[a], &hull[b])).unwrap_or(0);
        hull.rotate_left(first);
        let whole = twice_area(&hull) / 2.0;
        if whole > 0.0 { self.area() / whole } else { 0.0 }
    }

    /// The lowest and the highest ground (m).
    pub fn ground(&self) -> (f64, f64) {
        let heights = self.rings.iter().flatten().map(|point| point.z);
        heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)))
    }
}

fn twice_area(ring: &[DVec2]) -> f64 {
    let Some(&from) = ring.first() else { return 0.0 };
    ring.windows(2).map(|edge| (edge[0] - from).perp_dot(edge[1] - from)).sum()
}
