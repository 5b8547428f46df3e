//! Water in the ground: `soil` in scripts.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Environment, Vector, fields, methods, object};
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::cell_grid::CellGrid;
use super::place_key::PlaceKey;

/// Share of the sum of all distances below which a direction counts as rounding.
const EVEN: f64 = 1e-9;

/// Fields of `soil { ... }`.
#[fields("soil")]
pub struct SoilOptions {
    /// Size (m) of the ground along x, y and z.
    #[default(Vector(DVec3::new(4.0, 4.0, 2.0)))]
    pub size: Vector,
    /// Centre of the surface (m); the ground is below.
    #[default(Vector(DVec3::ZERO))]
    pub position: Vector,
    /// Length of the side of a cell (m).
    #[default(0.1)]
    pub cell: f64,
    /// Amount of water in each cell at the beginning.
    #[default(1.0)]
    pub amount: f64,
    /// Diffusion in each pass (m²), as for `diffuse`.
    pub diffusion: f64,
}

/// Water, or a nutrient, in a grid of cells in the ground. Roots take it, and it spreads by diffusion.
///
/// Changes stay from pass to pass. Nothing enters or leaves the ground at its sides. Amounts are in any unit, such as
/// litres.
///
/// Source: R. Mech and P. Prusinkiewicz, "Visual models of plants interacting with their environment", 1996.
#[object(
    "soil",
    can(Environment),
    options = SoilOptions,
    example = include_str!("../../scripts/soil.lua"),
    begin = restart,
)]
pub struct Soil {
    grid: CellGrid,
    diffusion: f64,
    /// Amounts that were taken at each place since the pass began.
    taken: FxHashMap<PlaceKey, f64>,
}

#[methods("soil")]
impl Soil {
    /// Takes at most `amount` from the cells within `radius` (m) of a place, of each in proportion to its content, and
    /// returns the amount that was there.
    ///
    /// A cell counts if its centre is in the ball, and so does the cell at the place.
    pub fn take(&mut self, place: Vector, radius: f64, amount: f64) -> Result<f64> {
        check("take", place.0, radius, amount)?;
        let mut found = 0.0;
        self.grid.in_ball(place.0, radius, |content| found += *content)?;
        let taken = amount.min(found);
        if taken > 0.0 {
            let rest = (found - taken) / found;
            self.grid.in_ball(place.0, radius, |content| *content *= rest)?;
        }
        if self.taken.len() == self.taken.capacity() {
            MemoryOwner::ensure_room(2 * self.taken.len() * size_of::<(PlaceKey, f64)>())?;
        }
        *self.taken.entry(place.0.into()).or_default() += taken;
        Ok(taken)
    }

    /// Adds an amount to the cells within `radius` (m) of a place, the same to each, such as rain or a spring. Returns the
    /// amount that was added: 0 if no cell is near.
    pub fn add(&mut self, place: Vector, radius: f64, amount: f64) -> Result<f64> {
        check("add", place.0, radius, amount)?;
        let mut count = 0.0;
        self.grid.in_ball(place.0, radius, |_| count += 1.0)?;
        if count == 0.0 {
            return Ok(0.0);
        }
        self.grid.in_ball(place.0, radius, |content| *content += amount / count)?;
        Ok(amount)
    }

    /// Spreads the water by diffusion. `rate` (m²) is the diffusivity multiplied by the duration: water spreads by the
    /// square root of twice the rate along each axis.
    ///
    /// The total does not change, and no rate is too large. Method: backward Euler, one axis after the other, which is
    /// stable for every rate.
    pub fn diffuse(&mut self, rate: f64) -> Result<()> {
        if !(rate >= 0.0 && rate.is_finite()) {
            return Err(Error::argument(format!("soil:diffuse: the rate is {rate}"))
                .help("give a rate (m²) of at least 0"));
        }
        self.grid.diffuse(rate)
    }

    /// Returns the amount in the cell at a place, 0 outside of the ground.
    pub fn amount(&self, place: Vector) -> f64 {
        self.grid.content(place.0)
    }

    /// Returns the amount that interpretations took at a place in the last pass, such as for the module there.
    pub fn taken(&self, place: Vector) -> f64 {
        self.taken.get(&place.0.into()).copied().unwrap_or(0.0)
    }

    /// Returns the direction towards more water among the cells within `radius` (m, twice the cell unless given) of a place,
    /// of length 1; the zero vector if the water is even, or the place is outside of the ground.
    pub fn gradient(&self, place: Vector, radius: Option<f64>) -> Result<DVec3> {
        let radius = radius.unwrap_or(2.0 * self.grid.cell());
        check("gradient", place.0, radius, 0.0)?;
        let Some(center) = self.grid.center_of(place.0) else { return Ok(DVec3::ZERO) };
        let (mut sum, mut size) = (DVec3::ZERO, 0.0);
        self.grid.read_ball(center, radius, |at, content| {
            sum += (at - center) * content;
            size += at.distance(center) * content;
        })?;
        Ok(if sum.length() <= EVEN * size { DVec3::ZERO } else { sum.normalize_or_zero() })
    }

    /// Returns the amount in the whole ground.
    pub fn total(&self) -> f64 {
        self.grid.total()
    }
}

impl Soil {
    /// Creates the ground.
    ///
    /// ```
    /// use burgeon_kit::Vector;
    /// use burgeon_objects::{Soil, SoilOptions};
    /// use glam::DVec3;
    ///
    /// let size = Vector(DVec3::new(1.0, 1.0, 1.0));
    /// let mut ground = Soil::new(SoilOptions { size, cell: 0.25, ..SoilOptions::default() })?;
    /// assert_eq!(ground.total(), 64.0);
    /// let root = || Vector(DVec3::new(0.1, 0.1, -0.4));
    /// assert_eq!(ground.take(root(), 0.05, 3.0)?, 1.0);
    /// assert_eq!((ground.taken(root()), ground.amount(root()), ground.total()), (1.0, 0.0, 63.0));
    /// ground.diffuse(0.01)?;
    /// assert!(ground.amount(root()) > 0.0);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(options: SoilOptions) -> Result<Self> {
        let SoilOptions { size, position, cell, amount, diffusion } = options;
        for (name, value) in [("amount", amount), ("diffusion", diffusion)] {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(
                    Error::argument(format!("soil: {name} is {value}")).help("give a number of at least 0")
                );
            }
        }
        let grid = CellGrid::new(size.0, position.0, cell, amount).map_err(|error| error.about("soil"))?;
        Ok(Self { grid, diffusion, taken: FxHashMap::default() })
    }

    fn restart(&mut self) {
        self.taken.clear();
    }
}

impl Environment for Soil {
    fn end_pass(&mut self) -> Result<()> {
        Stop::check_current()?;
        if self.diffusion > 0.0 { self.grid.diffuse(self.diffusion) } else { Ok(()) }
    }
}

fn check(method: &str, place: DVec3, radius: f64, amount: f64) -> Result<()> {
    let is_sound = |number: f64| number >= 0.0 && number.is_finite();
    if place.is_finite() && is_sound(radius) && is_sound(amount) {
        return Ok(());
    }
    let [x, y, z] = place.to_array();
    let amount = if method == "gradient" { String::new() } else { format!(", and the amount {amount}") };
    Err(Error::argument(format!(
        "soil:{method}: the place is {{{x:?}, {y:?}, {z:?}}}, the radius {radius}{amount}"
    ))
    .help("give finite coordinates, and numbers of at least 0"))
}

#[cfg(test)]
mod tests {
    use burgeon_base::random::Stream;
    use burgeon_kit::Object as _;

    use super::*;

    /// Returns ground of 1.2 m by 0.8 m by 1 m, in cells of 0.1 m, and a random place near it for each call.
    fn ground(seed: u64, amount: f64) -> (Soil, impl FnMut() -> DVec3) {
        let size = Vector(DVec3::new(1.2, 0.8, 1.0));
        let position = Vector(DVec3::new(0.3, -0.2, 0.5));
        let options = SoilOptions { size, position, cell: 0.1, amount, ..SoilOptions::default() };
        let mut stream = Stream::new(seed);
        let place = move || DVec3::from_array([0; 3].map(|_| stream.uniform() * 1.6 - 0.7));
        (Soil::new(options).unwrap(), place)
    }

    /// Returns the centres (m) of all cells of `ground`, x first and z last.
    fn centers() -> Vec<DVec3> {
        let number =
            |index: usize| [index % 12, index / 12 % 8, index / 96].map(|number| number as f64 + 0.5);
        (0..960).map(|index| DVec3::new(-0.3, -0.6, -0.5) + DVec3::from_array(number(index)) * 0.1).collect()
    }

    fn contents(ground: &Soil) -> Vec<f64> {
        centers().iter().map(|center| ground.amount(Vector(*center))).collect()
    }

    #[test]
    fn roots_take_from_the_cells_around_them_in_proportion_to_their_contents() {
        for seed in 0..10 {
            let (mut ground, mut place) = ground(seed, 0.5);
            let mut plain = vec![0.5; 960];
            for number in 0..60 {
                let (at, radius) = (place(), 0.04 + f64::from(number % 5) * 0.08);
                let near: Vec<usize> = (0..960)
                    .filter(|cell| {
                        let apart = centers()[*cell] - at;
                        apart.length() <= radius || apart.abs().max_element() <= 0.05
                    })
                    .collect();
                if number % 3 == 0 {
                    let added = ground.add(Vector(at), radius, 2.0).unwrap();
                    assert_eq!(added, if near.is_empty() { 0.0 } else { 2.0 });
                    near.iter().for_each(|cell| plain[*cell] += 2.0 / near.len() as f64);
                    continue;
                }
                let all: f64 = near.iter().map(|cell| plain[*cell]).sum();
                let wanted = f64::from(number % 7);
                let taken = ground.take(Vector(at), radius, wanted).unwrap();
                assert!((taken - all.min(wanted)).abs() < 1e-12, "{taken} {all} {wanted}");
                near.iter().for_each(|cell| plain[*cell] *= if all > 0.0 { 1.0 - taken / all } else { 1.0 });
                assert!((ground.taken(Vector(at)) - taken).abs() < 1e-12);
            }
            let apart = contents(&ground).iter().zip(&plain).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-12, "{apart}");
            ground.begin();
            assert_eq!(ground.taken(Vector(place())), 0.0);
        }
    }

    #[test]
    fn what_is_taken_and_what_is_left_add_up_to_what_was_there() {
        for seed in 0..10 {
            let (mut ground, mut place) = ground(seed, 1.0);
            let (start, mut sum) = (ground.total(), 0.0);
            for number in 0..200 {
                sum += ground.take(Vector(place()), 0.25, 1.5).unwrap();
                if number % 10 == 0 {
                    ground.diffuse(10.0_f64.powi(number / 10 - 6)).unwrap();
                }
                assert!((ground.total() + sum - start).abs() < 1e-9 * start);
                assert!(contents(&ground).iter().all(|content| *content >= 0.0));
            }
            assert!(sum > 0.1 * start, "{sum}");
        }
    }

    /// Returns what the contents were before a step of backward Euler along an axis.
    fn step_back(after: &[f64], axis: usize, share: f64) -> Vec<f64> {
        let (counts, steps) = ([12, 8, 10], [1, 12, 96]);
        let flow = |cell: usize| {
            let at = cell / steps[axis] % counts[axis];
            let down = if at > 0 { after[cell] - after[cell - steps[axis]] } else { 0.0 };
            let up = if at + 1 < counts[axis] { after[cell] - after[cell + steps[axis]] } else { 0.0 };
            after[cell] + share * (down + up)
        };
        (0..960).map(flow).collect()
    }

    #[test]
    fn diffusion_solves_the_equations_of_each_axis_for_every_rate() {
        for (seed, rate) in [1e-5, 1e-3, 0.01, 0.3, 20.0].into_iter().enumerate() {
            let (mut ground, mut place) = ground(seed as u64, 0.0);
            for _ in 0..20 {
                ground.add(Vector(place()), 0.2, 1.0).unwrap();
            }
            let before = contents(&ground);
            ground.diffuse(rate).unwrap();
            let after = contents(&ground);
            let share = rate / 0.01;
            let back = (0..3).fold(after.clone(), |contents, axis| step_back(&contents, axis, share));
            for (back, before) in back.iter().zip(&before) {
                assert!((back - before).abs() < 1e-12 * (1.0 + share).powi(3), "{back} {before}");
            }
            let most = |contents: &[f64]| contents.iter().copied().fold(0.0, f64::max);
            assert!(most(&after) < most(&before));
        }
        let (mut ground, _) = ground(1, 0.0);
        ground.add(Vector(DVec3::ZERO), 0.2, 960.0).unwrap();
        ground.diffuse(1e300).unwrap();
        assert!(contents(&ground).iter().all(|content| (content - 1.0).abs() < 1e-9));
    }

    #[test]
    fn a_drop_spreads_by_the_square_root_of_twice_the_rate() {
        let size = Vector(DVec3::new(4.1, 0.1, 0.1));
        let mut ground = Soil::new(SoilOptions { size, amount: 0.0, ..SoilOptions::default() }).unwrap();
        ground.add(Vector(DVec3::new(0.0, 0.0, -0.05)), 0.0, 1.0).unwrap();
        (0..100).for_each(|_| ground.diffuse(0.0005).unwrap());
        let cells = (-20..=20).map(|number| f64::from(number) * 0.1);
        let variance: f64 = cells.map(|x| x * x * ground.amount(Vector(DVec3::new(x, 0.0, -0.05)))).sum();
        assert!((variance - 2.0 * 0.05).abs() < 1e-3, "{variance}");
    }

    #[test]
    fn the_gradient_points_to_the_water_and_is_zero_where_it_is_even() {
        let (mut ground, mut place) = ground(3, 0.1);
        let middle = Vector(DVec3::new(0.34, -0.21, 0.03));
        assert_eq!(ground.gradient(middle, None).unwrap(), DVec3::ZERO);
        assert_eq!(ground.gradient(Vector(DVec3::Z * 9.0), None).unwrap(), DVec3::ZERO);
        ground.add(Vector(middle.0 + DVec3::X * 0.2), 0.06, 1.0).unwrap();
        assert!(ground.gradient(middle, Some(0.3)).unwrap().dot(DVec3::X) > 0.9);
        let mut rest = |count| (0..count).for_each(|_| drop(ground.take(Vector(place()), 0.3, 9.0)));
        rest(3);
        let all = contents(&ground);
        let own = centers().into_iter().find(|at| (*at - middle.0).abs().max_element() < 0.05).unwrap();
        let near = centers().into_iter().zip(all).filter(|(at, _)| at.distance(own) <= 0.25 + 1e-12);
        let sum: DVec3 = near.map(|(at, content)| (at - own) * content).sum();
        assert!(ground.gradient(middle, Some(0.25)).unwrap().distance(sum.normalize_or_zero()) < 1e-9);
    }
}
