//! Where something is on the ground: by height, slope, curvature, symbol and noise, with smooth transitions.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Field, Parameter, Table, Value, fields};
use burgeon_terrain::{Ground, World, octaves, octaves_around};

/// Where a cover lies or plants grow.
#[fields("on")]
pub struct Mask {
    /// From which height (m) to which it fades in; out, if the first is greater.
    pub height: Vec<f64>,
    /// From which slope (degrees) to which it fades in; out, if the first is greater.
    pub slope: Vec<f64>,
    /// From which curvature (1/m) to which it fades in; hollows are above 0, crests below.
    pub curvature: Vec<f64>,
    /// From which latitude (degrees, north or south) to which it fades in; on planets only.
    pub latitude: Vec<f64>,
    /// The symbols of the cells where it is; all, if there are none.
    pub symbols: Vec<String>,
    /// How far (0 to 1) noise shifts where it fades in.
    #[default(0.0)]
    pub noise: f64,
    /// How much (0 to 1) it is missing between patches.
    #[default(0.0)]
    pub patches: f64,
    /// The size (m) of patches, and of what noise shifts.
    #[default(50.0)]
    pub scale: f64,
}

impl Parameter for Mask {
    fn luau() -> String {
        "{ height: { number }?, slope: { number }?, curvature: { number }?, latitude: { number }?, symbols: { string }?, noise: number?, patches: number?, scale: number? }"
            .into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = &value else {
            return Err(Expectation::new(
                "a table of height, slope, curvature, latitude, symbols, noise, patches and scale",
            ));
        };
        let mask = Self::from_table(table)
            .map_err(|error| Expectation::new(format!("a place ({})", error.message())))?;
        for (name, range) in mask.ranges() {
            if !matches!(range, [] | [_, _]) {
                return Err(Expectation::new(format!(
                    "a place whose {name} is a range, such as {{ 30, 45 }}"
                )));
            }
        }
        if mask.scale <= 0.0 || [mask.noise, mask.patches].iter().any(|part| !(0.0..=1.0).contains(part)) {
            return Err(Expectation::new(
                "a place whose scale is above 0, and whose noise and patches are from 0 to 1",
            ));
        }
        Ok(mask)
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// A place, as patches know it.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PatchPlace {
    /// On flat ground (m).
    Flat(DVec2),
    /// On a globe (m, from its middle), seen with grains of a size (m).
    Round(DVec3, f64),
}

/// How the ground is at a place.
pub(crate) struct GroundPoint<'a> {
    pub place: PatchPlace,
    /// m.
    pub height: f64,
    /// degrees.
    pub slope: f64,
    /// 1/m; above 0 in hollows.
    pub curvature: f64,
    /// degrees from the equator.
    pub latitude: f64,
    /// The name of the symbol of the cell there.
    pub symbol: Option<&'a str>,
}

impl<'a> GroundPoint<'a> {
    /// The ground at `place` (m); its curvature over `reach` (m), if that is wanted.
    pub(super) fn new(ground: &'a Ground, place: DVec2, reach: f64, bent: bool) -> Self {
        let height = ground.height(place).unwrap_or(0.0);
        let up = ground.way_up(place).unwrap_or(DVec3::Z);
        let beside = |x: f64, y: f64| ground.height(place + DVec2::new(x, y) * reach).unwrap_or(height);
        let curvature = if bent {
            let around = beside(1.0, 0.0) + beside(-1.0, 0.0) + beside(0.0, 1.0) + beside(0.0, -1.0);
            (around - 4.0 * height) / (reach * reach)
        } else {
            0.0
        };
        let slope = up.z.clamp(-1.0, 1.0).acos().to_degrees();
        let symbol = ground.symbol(place);
        Self { place: PatchPlace::Flat(place), height, slope, curvature, latitude: 0.0, symbol }
    }
}

impl Mask {
    fn ranges(&self) -> [(&'static str, &[f64]); 4] {
        [
            ("height", &self.height),
            ("slope", &self.slope),
            ("curvature", &self.curvature),
            ("latitude", &self.latitude),
        ]
    }

    /// Whether it asks for the curvature of the ground.
    pub(crate) fn is_bent(&self) -> bool {
        !self.curvature.is_empty()
    }

    /// Fails if no cell of the world of a `kind` of object has one of its symbols.
    pub(crate) fn check(&self, kind: &str, world: &World) -> Result<()> {
        let names = || world.layers.iter().flat_map(|layer| layer.names.iter()).map(String::as_str);
        let Some(unknown) = self.symbols.iter().find(|symbol| names().all(|name| name != symbol.as_str()))
        else {
            return Ok(());
        };
        let known: Vec<&str> = names().filter(|name| !name.is_empty()).collect();
        let message = format!("{kind}: no rule makes {unknown}");
        Err(Error::not_found("cell", unknown, known.iter().copied(), message)
            .help(format!("the cells are {}", known.join(", "))))
    }

    /// How much (0 to 1) of it there is at a spot; masks with other `seed`s have other patches.
    pub(crate) fn at(&self, spot: &GroundPoint<'_>, seed: u64) -> f64 {
        let here = |symbol: &String| spot.symbol == Some(symbol.as_str());
        if !self.symbols.is_empty() && !self.symbols.iter().any(here) {
            return 0.0;
        }
        let values = [spot.height, spot.slope, spot.curvature, spot.latitude];
        let along = |((_, range), value): ((&str, &[f64]), f64)| match *range {
            [from, to] if from == to => Some(f64::from(u8::from(value >= from))),
            [from, to] => Some((value - from) / (to - from)),
            _ => None,
        };
        let fades = || self.ranges().into_iter().zip(values).filter_map(along);
        // Where noise cannot change anything, it need not be known.
        if fades().any(|along| along <= -self.noise) {
            return 0.0;
        }
        let noisy = self.patches > 0.0 || (self.noise > 0.0 && fades().any(|along| along < 1.0 + self.noise));
        let noise = match spot.place {
            _ if !noisy => 0.0,
            PatchPlace::Flat(place) => octaves(place / self.scale, 4, seed),
            PatchPlace::Round(place, grain) => {
                octaves_around(place / self.scale, 4, seed, grain / self.scale)
            }
        };
        let patches = 1.0 - self.patches * (1.0 - eased(0.5 + 2.5 * noise));
        patches * fades().map(|along| eased(along + noise * self.noise)).product::<f64>()
    }
}

fn eased(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
