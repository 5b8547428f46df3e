//! The universe: galaxies, their stars and the planets of the stars, generated on demand from a seed and a position.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};
use burgeon_base::random::Stream;
use burgeon_kit::{Expectation, Parameter, Seed, Table, TableKey, Value, fields, methods, object};

/// Fields of `universe { ... }`.
#[fields("universe")]
pub struct UniverseOptions {
    /// Seed of the whole universe: a number or a string.
    #[default(Seed(0))]
    pub seed: Seed,
}

/// Galaxies, stars and planets, generated on demand from the seed. The same position always gives the same result.
///
/// ```
/// use burgeon_kit::{Parameter, Value};
/// use burgeon_objects::Universe;
///
/// let universe = Universe::new(&Default::default());
/// let galaxy = universe.galaxy(0.0, 0.0, 0.0)?;
/// assert_eq!(galaxy, universe.galaxy(0.0, 0.0, 0.0)?);
/// assert_ne!(galaxy, universe.galaxy(1.0, 0.0, 0.0)?);
/// let Value::Table(galaxy) = galaxy else { unreachable!("a galaxy is a table") };
/// assert!(galaxy.get("stars").is_some_and(|stars| matches!(stars, Value::Number(count) if *count > 1e6)));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[object(
    "universe",
    options = UniverseOptions,
    make = from_table,
    example = include_str!("../scripts/universe.lua")
)]
#[derive(Debug)]
pub struct Universe {
    key: ModuleKey,
}

#[methods("universe")]
impl Universe {
    /// Returns the galaxy in a cube of space, by its column, row and layer: a table with `position` and `radius` (light
    /// years), `kind`, `color`, `seed`, and `stars`, the number of its stars.
    pub fn galaxy(&self, x: f64, y: f64, z: f64) -> Result<Value> {
        let cell = DVec3::new(x, y, z);
        let mut key = self.key;
        for at in cell.to_array() {
            key = key.child(whole(at)?);
        }
        let mut stream = key.stream();
        let sort = BodyClass::draw(GALAXIES, |_| true, &mut stream);
        let radius = sort.size(&mut stream);
        let place = DVec3::new(stream.uniform(), stream.uniform(), stream.uniform());
        // The Milky Way has some 2e11 stars within 5e4 light years.
        let stars = (2e11 * (radius / 5e4).powi(3)).floor();
        Ok(sort.table(key, (cell + place) * CUBE, radius, ("stars", stars)))
    }

    /// Returns star number `index` of a galaxy, from 1: a table with `position` (light years from the galaxy's centre),
    /// `radius` (m), `kind`, `color`, `seed`, and `planets`, the number of its planets.
    pub fn star(&self, galaxy: Galaxy, index: f64) -> Result<Value> {
        let key = galaxy.0.key.child(galaxy.0.number("star", index)?);
        let mut stream = key.stream();
        let sort = BodyClass::draw(STARS, |_| true, &mut stream);
        let radius = sort.size(&mut stream);
        let position = galaxy.0.sort.place(&mut stream) * galaxy.0.radius;
        #[allow(clippy::cast_precision_loss, reason = "a small number")]
        let planets = stream.below(13) as f64;
        Ok(sort.table(key, position, radius, ("planets", planets)))
    }

    /// Returns planet number `index` of a star, from 1, in order of distance: a table with `position` (m from the
    /// star), `radius` (m), `kind`, `color`, `seed`, and `light`, relative to the light that the Earth receives. Pass
    /// `radius` and `seed` to `planet`.
    pub fn planet(&self, star: Star, index: f64) -> Result<Value> {
        let number = star.0.number("planet", index)?;
        let key = star.0.key.child(number);
        let mut stream = key.stream();
        // Each orbit is wider than the previous one by about the same factor, and all are wider around bright stars.
        let first = 0.25 * star.0.sort.light.powf(0.3);
        let orbit = first * 1.7f64.powf(index + 0.6 * stream.uniform());
        let (turn, tilt) = (stream.uniform() * TAU, (stream.uniform() - 0.5) * 0.08);
        let position = DVec3::new(turn.cos(), turn.sin(), tilt) * orbit * EARTH_ORBIT;
        let light = star.0.sort.light / (orbit * orbit);
        let sort = BodyClass::draw(PLANETS, |sort| sort.lit.0 <= light && light < sort.lit.1, &mut stream);
        let radius = sort.size(&mut stream);
        Ok(sort.table(key, position, radius, ("light", light)))
    }
}

impl Universe {
    fn from_table(table: &Table) -> Result<Self> {
        Ok(Self::new(&UniverseOptions::from_table(table)?))
    }

    /// Creates the universe of a seed.
    pub fn new(options: &UniverseOptions) -> Self {
        Self { key: ModuleKey::seed(options.seed.0) }
    }
}

/// Side length (light years) of the cubes of space.
const CUBE: f64 = 3e6;

/// Distance (m) between the Earth and the Sun.
const EARTH_ORBIT: f64 = 1.496e11;

/// A class of galaxies, stars or planets.
#[derive(Debug, Clone)]
struct BodyClass {
    name: &'static str,
    /// Relative frequency of the class.
    weight: f64,
    /// Minimum and maximum radius: in light years for galaxies, in metres for stars and planets.
    radius: (f64, f64),
    color: [u8; 3],
    /// Luminosity of a star, relative to the Sun.
    light: f64,
    /// Range of received light in which a class of planets occurs, relative to the Earth.
    lit: (f64, f64),
    /// Flatness of a galaxy (height over width), and its number of arms.
    shape: (f64, u32),
}

const PLAIN: BodyClass = BodyClass {
    name: "",
    weight: 1.0,
    radius: (1.0, 1.0),
    color: [255; 3],
    light: 1.0,
    lit: (0.0, f64::INFINITY),
    shape: (1.0, 0),
};

const GALAXIES: &[BodyClass] = &[
    BodyClass {
        name: "spiral",
        weight: 6.0,
        radius: (2e4, 9e4),
        color: [190, 205, 255],
        shape: (0.04, 2),
        ..PLAIN
    },
    BodyClass {
        name: "barred",
        weight: 3.0,
        radius: (2e4, 8e4),
        color: [215, 212, 240],
        shape: (0.04, 4),
        ..PLAIN
    },
    BodyClass {
        name: "elliptical",
        weight: 2.0,
        radius: (1e4, 2e5),
        color: [255, 225, 185],
        shape: (0.6, 0),
        ..PLAIN
    },
    BodyClass {
        name: "irregular",
        weight: 3.0,
        radius: (3e3, 1.5e4),
        color: [185, 215, 255],
        shape: (0.4, 0),
        ..PLAIN
    },
];

/// Star classes of Morgan and Keenan, as frequent as near the Sun.
const STARS: &[BodyClass] = &[
    BodyClass { name: "M", weight: 76.5, radius: (9e7, 4.8e8), color: [255, 180, 107], light: 0.03, ..PLAIN },
    BodyClass {
        name: "K",
        weight: 12.1,
        radius: (4.8e8, 6.6e8),
        color: [255, 214, 170],
        light: 0.3,
        ..PLAIN
    },
    BodyClass { name: "G", weight: 7.6, radius: (6.6e8, 8e8), color: [255, 241, 224], light: 1.0, ..PLAIN },
    BodyClass { name: "F", weight: 3.0, radius: (8e8, 9.7e8), color: [248, 247, 255], light: 3.0, ..PLAIN },
    BodyClass {
        name: "A",
        weight: 0.6,
        radius: (9.7e8, 1.25e9),
        color: [202, 215, 255],
        light: 14.0,
        ..PLAIN
    },
    BodyClass {
        name: "B",
        weight: 0.13,
        radius: (1.25e9, 4.6e9),
        color: [170, 191, 255],
        light: 800.0,
        ..PLAIN
    },
    BodyClass { name: "O", weight: 0.01, radius: (4.6e9, 9e9), color: [155, 176, 255], light: 4e4, ..PLAIN },
];

const PLANETS: &[BodyClass] = &[
    BodyClass {
        name: "molten",
        radius: (1.5e6, 7e6),
        color: [110, 62, 48],
        lit: (4.0, f64::INFINITY),
        ..PLAIN
    },
    BodyClass { name: "desert", radius: (2e6, 7.5e6), color: [196, 152, 96], lit: (0.6, 6.0), ..PLAIN },
    BodyClass {
        name: "ocean",
        weight: 1.5,
        radius: (4e6, 9e6),
        color: [48, 96, 150],
        lit: (0.4, 1.6),
        ..PLAIN
    },
    BodyClass { name: "ice", radius: (1e6, 7e6), color: [214, 230, 238], lit: (0.0, 0.4), ..PLAIN },
    BodyClass { name: "rock", weight: 0.7, radius: (1e6, 4e6), color: [134, 126, 118], ..PLAIN },
    BodyClass {
        name: "gas",
        weight: 1.3,
        radius: (2e7, 8e7),
        color: [205, 180, 148],
        lit: (0.0, 0.35),
        ..PLAIN
    },
];

impl BodyClass {
    /// Chooses a class for which `may` is true at random, weighted by frequency.
    fn draw(sorts: &'static [Self], may: impl Fn(&Self) -> bool, stream: &mut Stream) -> &'static Self {
        let whole: f64 = sorts.iter().filter(|sort| may(sort)).map(|sort| sort.weight).sum();
        let mut left = stream.uniform() * whole;
        let mut found = &sorts[0];
        for sort in sorts.iter().filter(|sort| may(sort)) {
            found = sort;
            left -= sort.weight;
            if left < 0.0 {
                break;
            }
        }
        found
    }

    fn size(&self, stream: &mut Stream) -> f64 {
        let (least, greatest) = self.radius;
        least * (greatest / least).powf(stream.uniform())
    }

    /// Returns a random position of a star in a galaxy of radius 1.
    fn place(&self, stream: &mut Stream) -> DVec3 {
        let (flatness, arms) = self.shape;
        let out = stream.uniform().powf(if arms > 0 { 0.7 } else { 1.2 });
        let spread = (stream.uniform() + stream.uniform() - 1.0) * (1.0 - 0.8 * out);
        let turn = if arms > 0 {
            // Arms are logarithmic spirals.
            let arm = f64::from(u32::try_from(stream.below(arms as usize)).unwrap_or(0));
            arm / f64::from(arms) * TAU + 3.2 * (out + 0.05).ln() + spread
        } else {
            stream.uniform() * TAU
        };
        let up = (stream.uniform() + stream.uniform() - 1.0) * flatness * (1.0 - out * out).max(0.0).sqrt();
        DVec3::new(turn.cos() * out, turn.sin() * out, up)
    }

    /// Returns the table that scripts receive for a body of this class.
    fn table(&self, key: ModuleKey, position: DVec3, radius: f64, more: (&str, f64)) -> Value {
        let [red, green, blue] = self.color;
        let mut entries = vec![
            (TableKey::Name("color".into()), Value::Text(format!("#{red:02x}{green:02x}{blue:02x}").into())),
            (TableKey::Name("kind".into()), Value::Text(self.name.into())),
            (TableKey::Name(more.0.into()), Value::Number(more.1)),
            (TableKey::Name("position".into()), position.into_value()),
            (TableKey::Name("radius".into()), Value::Number(radius)),
            (TableKey::Name("seed".into()), Seed(key.0).into_value()),
        ];
        entries.sort_by(|one, other| one.0.cmp(&other.0));
        Value::Table(Arc::new(Table { class: None, entries }))
    }
}

/// The data of a galaxy or a star from which its stars or planets are generated.
#[derive(Debug)]
struct Parentage {
    key: ModuleKey,
    sort: &'static BodyClass,
    radius: f64,
    /// Number of its stars or planets.
    count: f64,
}

impl Parentage {
    /// Reads the table of a body whose class is one of `sorts`; the entry `count` holds the number of its children.
    fn read(value: &Value, sorts: &'static [BodyClass], count: &str) -> Option<Self> {
        let Value::Table(table) = value else { return None };
        let number = |name: &str| match table.get(name) {
            Some(Value::Number(number)) if number.is_finite() => Some(*number),
            _ => None,
        };
        let kind = String::read_value(table.get("kind")?).ok()?;
        let seed = Seed::read_value(table.get("seed")?).ok()?;
        let sort = sorts.iter().find(|sort| sort.name == kind)?;
        Some(Self { key: ModuleKey(seed.0), sort, radius: number("radius")?, count: number(count)? })
    }

    /// Converts the number of a `what` of this body. Fails if it is not between 1 and the count.
    fn number(&self, what: &str, index: f64) -> Result<usize> {
        if !(1.0..=self.count).contains(&index) {
            return Err(Error::not_found(
                "number",
                index,
                [],
                format!("universe:{what}: unknown {what} number {index}"),
            )
            .help(format!("use a number from 1 to {}", self.count)));
        }
        whole(index)
    }
}

/// Converts the number of a body or the coordinate of a cube. Fails if it is not an integer below 2^53.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the number is whole and below 2^53"
)]
fn whole(number: f64) -> Result<usize> {
    if number.fract() == 0.0 && number.abs() < 9_007_199_254_740_992.0 {
        return Ok((number as i64) as usize);
    }
    Err(Error::argument(format!("universe: {number} is not an integer below 2^53"))
        .help("galaxies, stars and planets are numbered"))
}

/// A galaxy, as returned by [`Universe::galaxy`].
#[derive(Debug)]
pub struct Galaxy(Parentage);

impl Parameter for Galaxy {
    fn luau() -> String {
        "{ kind: string, seed: string, radius: number, stars: number }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let found = Parentage::read(&value, GALAXIES, "stars");
        found.map(Self).ok_or_else(|| Expectation::new("a galaxy, as returned by universe:galaxy"))
    }

    fn into_value(self) -> Value {
        self.0.sort.table(self.0.key, DVec3::ZERO, self.0.radius, ("stars", self.0.count))
    }
}

/// A star, as returned by [`Universe::star`].
#[derive(Debug)]
pub struct Star(Parentage);

impl Parameter for Star {
    fn luau() -> String {
        "{ kind: string, seed: string, radius: number, planets: number }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let found = Parentage::read(&value, STARS, "planets");
        found.map(Self).ok_or_else(|| Expectation::new("a star, as returned by universe:star"))
    }

    fn into_value(self) -> Value {
        self.0.sort.table(self.0.key, DVec3::ZERO, self.0.radius, ("planets", self.0.count))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_kit::Color;

    fn field(value: &Value, name: &str) -> Value {
        let Value::Table(table) = value else { panic!("{value}") };
        table.get(name).unwrap().clone()
    }

    fn read<T: Parameter>(value: &Value) -> T {
        T::read_value(value).unwrap()
    }

    #[test]
    fn who_comes_back_finds_all_of_it_the_same() {
        let universe = |seed| Universe::new(&UniverseOptions { seed: Seed(seed) });
        let tour = |universe: &Universe, x: f64| {
            let galaxy = universe.galaxy(x, -3.0, 12.0).unwrap();
            let star = universe.star(read(&galaxy), 4_000_123.0).unwrap();
            (galaxy, star)
        };
        assert_eq!(tour(&universe(1), 7.0), tour(&universe(1), 7.0));
        assert_ne!(tour(&universe(1), 7.0), tour(&universe(2), 7.0));
        assert_ne!(tour(&universe(1), 7.0), tour(&universe(1), 8.0));
    }

    #[test]
    fn things_are_where_they_belong() {
        let universe = Universe::new(&UniverseOptions { seed: Seed(5) });
        let mut kinds = std::collections::BTreeSet::new();
        let mut warm = 0;
        for x in 0..20 {
            let galaxy = universe.galaxy(f64::from(x), 0.0, 0.0).unwrap();
            let position = DVec3::from_value(field(&galaxy, "position")).unwrap();
            assert!((position / CUBE - DVec3::X * f64::from(x)).cmpge(DVec3::ZERO).all());
            let whole = f64::from_value(field(&galaxy, "radius")).unwrap();
            for index in 1..200 {
                let star = universe.star(read(&galaxy), f64::from(index)).unwrap();
                let place = DVec3::from_value(field(&star, "position")).unwrap();
                assert!(place.length() <= whole * 1.2);
                let planets = f64::from_value(field(&star, "planets")).unwrap();
                let mut last = 0.0;
                for number in 1..=12u32 {
                    let planet = universe.planet(read(&star), f64::from(number));
                    assert_eq!(planet.is_ok(), f64::from(number) <= planets);
                    let Ok(planet) = planet else { continue };
                    let orbit = DVec3::from_value(field(&planet, "position")).unwrap().length();
                    assert!(orbit > last);
                    last = orbit;
                    kinds.insert(String::from_value(field(&planet, "kind")).unwrap());
                    warm +=
                        i32::from((0.5..1.5).contains(&f64::from_value(field(&planet, "light")).unwrap()));
                    assert!(Color::from_value(field(&planet, "color")).is_ok());
                }
            }
        }
        assert!(kinds.len() == PLANETS.len() && warm > 100, "{kinds:?} {warm}");
    }
}
