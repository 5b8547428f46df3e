//! Masks: locations on the ground by height, slope, curvature, symbol and noise, with smooth transitions.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Field, Parameter, Table, Value, fields};
use burgeon_terrain::{GroundReader, World, octaves, octaves_around};

/// The locations of a cover or of plants.
#[fields("on")]
pub struct Mask {
    /// Height range (m) of the fade-in: { start, end }. If start is greater than end, it fades out.
    pub height: Vec<f64>,
    /// Slope range (degrees) of the fade-in: { start, end }. If start is greater than end, it fades out.
    pub slope: Vec<f64>,
    /// Curvature range (1/m) of the fade-in: { start, end }. Hollows are positive, crests negative.
    pub curvature: Vec<f64>,
    /// Latitude range (degrees, north or south) of the fade-in: { start, end }. Only on planets.
    pub latitude: Vec<f64>,
    /// Symbols of the included cells. If empty, all cells.
    pub symbols: Vec<String>,
    /// Shift of the fade-in by noise (0 to 1).
    #[default(0.0)]
    pub noise: f64,
    /// Strength of the gaps between patches (0 to 1).
    #[default(0.0)]
    pub patches: f64,
    /// Size (m) of patches and of noise.
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
                    "a mask with a range for {name}, such as {{ 30, 45 }}"
                )));
            }
        }
        if mask.scale <= 0.0 || [mask.noise, mask.patches].iter().any(|part| !(0.0..=1.0).contains(part)) {
            return Err(Expectation::new(
                "a mask with a scale above 0, and with noise and patches from 0 to 1",
            ));
        }
        Ok(mask)
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// A position, as used for patches.
#[derive(Debug, Clone, Copy)]
pub(crate) enum PatchPlace {
    /// Position on flat ground (m).
    Flat(DVec2),
    /// Position on a globe (m, from its centre), and the size of the grains (m).
    Round(DVec3, f64),
}

/// The properties of the ground at a position.
pub(crate) struct GroundPoint<'a> {
    pub place: PatchPlace,
    /// Height (m).
    pub height: f64,
    /// Slope (degrees).
    pub slope: f64,
    /// Curvature (1/m), positive in hollows.
    pub curvature: f64,
    /// Latitude (degrees from the equator).
    pub latitude: f64,
    /// Name of the cell's symbol.
    pub symbol: Option<&'a str>,
}

impl<'a> GroundPoint<'a> {
    /// Returns the ground at `place` (m), read by `reader`. If `bent`, computes its curvature over `reach` (m).
    pub(super) fn new(reader: &mut GroundReader<'a>, place: DVec2, reach: f64, bent: bool) -> Self {
        let sample = reader.at(place);
        let height = sample.map_or(0.0, |sample| sample.height);
        let up = sample.map_or(DVec3::Z, |sample| sample.normal);
        let beside =
            |x: f64, y: f64| reader.ground().height(place + DVec2::new(x, y) * reach).unwrap_or(height);
        let curvature = if bent {
            let around = beside(1.0, 0.0) + beside(-1.0, 0.0) + beside(0.0, 1.0) + beside(0.0, -1.0);
            (around - 4.0 * height) / (reach * reach)
        } else {
            0.0
        };
        let slope = up.z.clamp(-1.0, 1.0).acos().to_degrees();
        let symbol = sample.map(|sample| sample.symbol);
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

    /// Returns true if the mask depends on the curvature of the ground.
    pub(crate) fn is_bent(&self) -> bool {
        !self.curvature.is_empty()
    }

    /// Fails if the world has no cell with one of the mask's symbols. `kind` is the object type for the message.
    pub(crate) fn check(&self, kind: &str, world: &World) -> Result<()> {
        let names = || world.layers.iter().flat_map(|layer| layer.names.iter()).map(String::as_str);
        let Some(unknown) = self.symbols.iter().find(|symbol| names().all(|name| name != symbol.as_str()))
        else {
            return Ok(());
        };
        let known: Vec<&str> = names().filter(|name| !name.is_empty()).collect();
        let message = format!("{kind}: no rule produces {unknown}");
        Err(Error::not_found("cell", unknown, known.iter().copied(), message)
            .help(format!("the cells are {}", known.join(", "))))
    }

    /// Returns the strength (0 to 1) of the mask at a point. Masks with a different `seed` have different patches.
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
        // Noise that cannot change the result is not computed.
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
        let patches = 1.0 - self.patches * (1.0 - ease(0.5 + 2.5 * noise));
        patches * fades().map(|along| ease(along + noise * self.noise)).product::<f64>()
    }
}

fn ease(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
