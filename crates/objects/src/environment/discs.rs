//! Plants that compete for space: `discs` in scripts.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, Vector, fields, methods, object};
use glam::DVec2;
use rstar::RTree;
use rstar::primitives::GeomWithData;
use rustc_hash::FxHashMap;

use super::place_key::PlaceKey;

/// Number of discs between two checks for cancellation.
const STRETCH: usize = 1024;

/// Fields of `discs { ... }`.
#[fields("discs")]
pub struct DiscOptions {
    /// Part of its radius by which a disc may overlap another one, from 0 to 1.
    pub overlap: f64,
}

/// Discs on the ground that compete for space: where two of them overlap, the weaker one is dominated.
///
/// The weaker one is that with less vigor; of equal ones, the smaller; of equally large ones, the later. Method: O. Deussen
/// and others, "Realistic modeling and rendering of plant ecosystems", 1998.
#[object(
    "discs",
    can(Environment),
    options = DiscOptions,
    example = include_str!("../../scripts/discs.lua"),
    begins_empty,
    begin = restart,
)]
pub struct Discs {
    overlap: f64,
    discs: Vec<Disc>,
    /// Results of the last pass, by place: set if the disc is dominated.
    dominated: FxHashMap<PlaceKey, bool>,
}

/// Disc of a plant.
#[derive(Debug, Clone, Copy)]
struct Disc {
    place: Vector,
    radius: f64,
    vigor: f64,
}

#[methods("discs")]
impl Discs {
    /// Adds a disc around a place with `radius` (m), and `vigor`, the radius unless given.
    pub fn add(&mut self, place: Vector, radius: f64, vigor: Option<f64>) -> Result<()> {
        let vigor = vigor.unwrap_or(radius);
        if !(place.0.is_finite() && radius >= 0.0 && radius.is_finite() && vigor.is_finite()) {
            return Err(Error::argument(format!(
                "discs:add: the place is {}, the radius {radius} and the vigor {vigor}",
                place.0
            ))
            .help("give finite numbers, and a radius of at least 0"));
        }
        if self.discs.len() == self.discs.capacity() {
            MemoryOwner::ensure_room(2 * self.discs.len() * size_of::<Disc>())?;
        }
        self.discs.push(Disc { place, radius, vigor });
        Ok(())
    }

    /// Returns true if the disc at a place was dominated by another one in the last pass.
    pub fn dominated(&self, place: Vector) -> bool {
        self.dominated.get(&place.0.into()).copied().unwrap_or(false)
    }
}

impl Discs {
    /// Creates an empty ground.
    ///
    /// ```
    /// use burgeon_kit::{Environment, Vector};
    /// use burgeon_objects::Discs;
    /// use glam::DVec3;
    ///
    /// let mut ground = Discs::new(Default::default())?;
    /// let [oak, weed] = [0.0, 2.0].map(|x| DVec3::new(x, 0.0, 0.0));
    /// ground.add(Vector(oak), 1.5, None)?;
    /// ground.add(Vector(weed), 0.6, None)?;
    /// ground.end_pass()?;
    /// assert!(ground.dominated(Vector(weed)) && !ground.dominated(Vector(oak)));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: DiscOptions) -> Result<Self> {
        if !(0.0..=1.0).contains(&options.overlap) {
            return Err(Error::argument(format!("discs: overlap is {}", options.overlap))
                .help("give a part of the radius from 0 to 1"));
        }
        Ok(Self { overlap: options.overlap, discs: Vec::new(), dominated: FxHashMap::default() })
    }

    fn restart(&mut self) {
        self.discs.clear();
        self.dominated.clear();
    }
}

impl Environment for Discs {
    fn end_pass(&mut self) -> Result<()> {
        let ground = |disc: &Disc| disc.place.0.truncate();
        let places = self.discs.iter().enumerate();
        let places = places.map(|(number, disc)| GeomWithData::new(ground(disc).to_array(), number));
        let tree = RTree::bulk_load(places.collect());
        let widest = self.discs.iter().fold(0.0, |widest: f64, disc| widest.max(disc.radius));
        let allowed = 1.0 - self.overlap;
        for (number, disc) in self.discs.iter().enumerate() {
            if number % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            let reach = (disc.radius + widest) * allowed;
            let at = ground(disc);
            let is_stronger = |other: usize| {
                let it = &self.discs[other];
                let order = it.vigor.total_cmp(&disc.vigor).then(it.radius.total_cmp(&disc.radius));
                let distance = DVec2::distance(ground(it), at);
                other != number
                    && distance < (it.radius + disc.radius) * allowed
                    && order.then(number.cmp(&other)).is_gt()
            };
            let mut near = tree.locate_within_distance(at.to_array(), reach * reach);
            let is_dominated = near.any(|near| is_stronger(near.data));
            *self.dominated.entry(disc.place.0.into()).or_default() |= is_dominated;
        }
        Ok(())
    }
}
