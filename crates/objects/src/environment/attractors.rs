//! Points that attract growth: `attractors` in scripts.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, Vector, fields, methods, object};
use glam::DVec3;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use rustc_hash::FxHashMap;

use super::place_key::PlaceKey;

/// Number of points between two checks for cancellation.
const STRETCH: usize = 4096;

/// Fields of `attractors { ... }`.
#[fields("attractors")]
pub struct AttractorOptions {
    /// Points (m) that attract growth.
    pub points: Vec<Vector>,
    /// Distance (m) up to which a point attracts the nearest place.
    #[default(2.0)]
    pub influence: f64,
    /// Distance (m) from a place at which a point disappears.
    #[default(0.5)]
    pub kill: f64,
}

/// Points that attract growth until it reaches them: space colonisation.
///
/// Each point attracts the nearest place that interpretations add in a pass, and disappears once a place is near. Points that
/// have disappeared return when a derivation begins.
///
/// Method: A. Runions, B. Lane and P. Prusinkiewicz, "Modeling trees with a space colonization algorithm", 2007.
#[object(
    "attractors",
    can(Environment),
    options = AttractorOptions,
    first = "points",
    example = include_str!("../../scripts/attractors.lua"),
    begin = restart,
)]
pub struct Attractors {
    influence: f64,
    kill: f64,
    points: Vec<DVec3>,
    /// Places that were added since the pass began.
    places: Vec<DVec3>,
    /// Number of points that each place attracts, and the sum of their directions.
    attracted: FxHashMap<PlaceKey, (u32, DVec3)>,
}

#[methods("attractors")]
impl Attractors {
    /// Adds a place that points can attract, such as a node of a tree.
    pub fn add(&mut self, place: Vector) -> Result<()> {
        if !place.0.is_finite() {
            return Err(Error::argument(format!("attractors:add: the place is {}", place.0))
                .help("give finite coordinates"));
        }
        if self.places.len() == self.places.capacity() {
            MemoryOwner::ensure_room(2 * self.places.len() * size_of::<DVec3>())?;
        }
        self.places.push(place.0);
        Ok(())
    }

    /// Returns the number of points that attracted a place in the last pass.
    pub fn count(&self, place: Vector) -> u32 {
        self.attracted.get(&place.0.into()).map_or(0, |(count, _)| *count)
    }

    /// Returns the mean direction from a place to the points that attracted it, of length 1; the zero vector if there are
    /// none.
    pub fn direction(&self, place: Vector) -> DVec3 {
        self.attracted.get(&place.0.into()).map_or(DVec3::ZERO, |(_, sum)| sum.normalize_or_zero())
    }

    /// Returns the number of points that have not been reached.
    pub fn remaining(&self) -> u32 {
        u32::try_from(self.points.len()).unwrap_or(u32::MAX)
    }
}

impl Attractors {
    /// Creates the points.
    ///
    /// ```
    /// use burgeon_kit::{Environment, Vector};
    /// use burgeon_objects::{AttractorOptions, Attractors};
    /// use glam::DVec3;
    ///
    /// let points = vec![Vector(DVec3::new(0.0, 0.0, 1.0)), Vector(DVec3::new(0.1, 0.0, 0.0))];
    /// let mut space = Attractors::new(AttractorOptions { points, ..AttractorOptions::default() })?;
    /// let root = || Vector(DVec3::ZERO);
    /// space.add(root())?;
    /// space.end_pass()?;
    /// assert_eq!((space.count(root()), space.remaining()), (1, 1));
    /// assert_eq!(space.direction(root()), DVec3::Z);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: AttractorOptions) -> Result<Self> {
        let AttractorOptions { points, influence, kill } = options;
        for (name, value) in [("influence", influence), ("kill", kill)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(Error::argument(format!("attractors: {name} is {value}"))
                    .help("give a distance (m) of at least 0"));
            }
        }
        let points: Vec<DVec3> = points.iter().map(|point| point.0).collect();
        if let Some(wrong) = points.iter().position(|point| !point.is_finite()) {
            return Err(Error::argument(format!("attractors: point {} is {}", wrong + 1, points[wrong]))
                .help("give finite coordinates"));
        }
        Ok(Self { influence, kill, points, places: Vec::new(), attracted: FxHashMap::default() })
    }

    fn restart(&mut self) {
        self.places.clear();
        self.attracted.clear();
    }
}

impl Environment for Attractors {
    fn end_pass(&mut self) -> Result<()> {
        let places: Vec<_> = self
            .places
            .iter()
            .enumerate()
            .map(|(number, place)| GeomWithData::new(place.to_array(), number))
            .collect();
        let places = RTree::bulk_load(places);
        let mut left = Vec::with_capacity(self.points.len());
        for (index, point) in self.points.iter().enumerate() {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            // Of equally near places, the first one counts.
            let mut nearest = places.nearest_neighbor_iter_with_distance_2(&point.to_array());
            let first = nearest.next();
            let best = first.map(|(place, square)| {
                let others = nearest.take_while(|(_, other)| *other <= square);
                (others.fold(place.data, |best, (place, _)| best.min(place.data)), square)
            });
            let Some((number, square)) = best else {
                left.push(*point);
                continue;
            };
            if square <= self.kill * self.kill {
                continue;
            }
            left.push(*point);
            if square <= self.influence * self.influence {
                let place = self.places[number];
                let (count, sum) = self.attracted.entry(place.into()).or_default();
                *count += 1;
                *sum += (*point - place).normalize_or_zero();
            }
        }
        self.points = left;
        Ok(())
    }
}
