//! Masks: locations on the ground by height, slope, curvature, symbol and noise, with smooth transitions.

use std::slice;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_kit::{Expectation, Field, Parameter, Table, Value, fields};
use burgeon_terrain::{GroundReader, World, octaves, octaves_along, octaves_around};

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
#[derive(Debug, Clone, Copy)]
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

    fn properties(&self) -> [f64; 4] {
        [self.height, self.slope, self.curvature, self.latitude]
    }
}

/// Fade-in of a mask over the range of a property.
struct Fade {
    /// Index in [`GroundPoint::properties`].
    property: usize,
    from: f64,
    to: f64,
}

impl Fade {
    /// Returns the position of a point along the fade-in: 0 at its start, 1 at its end.
    fn position(&self, point: &GroundPoint<'_>) -> f64 {
        let value = point.properties()[self.property];
        if self.from == self.to {
            return f64::from(u8::from(value >= self.from));
        }
        (value - self.from) / (self.to - self.from)
    }
}

/// The effect of noise on the strength of a mask at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum NoiseEffect {
    /// The strength is 0 with any noise.
    Hidden,
    /// The strength is the same with any noise.
    None,
    /// The strength depends on the noise.
    Some,
}

impl Mask {
    /// Returns the ranges of the fade-ins with their names, in the order of [`GroundPoint::properties`].
    fn ranges(&self) -> [(&'static str, &[f64]); 4] {
        [
            ("height", &self.height),
            ("slope", &self.slope),
            ("curvature", &self.curvature),
            ("latitude", &self.latitude),
        ]
    }

    /// Returns the fade-ins of the mask.
    fn fades(&self) -> impl Iterator<Item = Fade> {
        let fade = |(property, (_, range)): (usize, (_, &[f64]))| match *range {
            [from, to] => Some(Fade { property, from, to }),
            _ => None,
        };
        self.ranges().into_iter().enumerate().filter_map(fade)
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
    pub(crate) fn at(&self, point: &GroundPoint<'_>, seed: u64) -> f64 {
        self.strengths(slice::from_ref(point), seed, &[1.0]).first().copied().unwrap_or(0.0)
    }

    /// Returns the strength (0 to 1) of the mask at each of `points`; 0 for those that are not `visible`, for which nothing is
    /// computed. Points in a row from west to east are faster than single ones.
    pub(crate) fn strengths(&self, points: &[GroundPoint<'_>], seed: u64, visible: &[f32]) -> Vec<f64> {
        let fades: Vec<Fade> = self.fades().collect();
        let effects: Vec<NoiseEffect> = points
            .iter()
            .zip(visible)
            .map(|(point, visible)| match *visible > 0.0 {
                true => self.noise_effect(point, &fades),
                false => NoiseEffect::Hidden,
            })
            .collect();
        let mut strengths = Vec::with_capacity(points.len());
        for run in effects.chunk_by(|a, b| a == b) {
            let points = &points[strengths.len()..][..run.len()];
            match run[0] {
                NoiseEffect::Hidden => strengths.extend(points.iter().map(|_| 0.0)),
                NoiseEffect::None => {
                    strengths.extend(points.iter().map(|point| strength(&fades, point, 0.0)))
                }
                NoiseEffect::Some => {
                    let noise = self.noise_along(points, seed);
                    strengths.extend(points.iter().zip(noise).map(|(point, noise)| {
                        let patches = 1.0 - self.patches * (1.0 - ease(0.5 + 2.5 * noise));
                        patches * strength(&fades, point, noise * self.noise)
                    }));
                }
            }
        }
        strengths
    }

    /// Returns how noise changes the strength at a point. Noise that cannot change it is not computed.
    fn noise_effect(&self, point: &GroundPoint<'_>, fades: &[Fade]) -> NoiseEffect {
        let here = |symbol: &String| point.symbol == Some(symbol.as_str());
        if !self.symbols.is_empty() && !self.symbols.iter().any(here) {
            return NoiseEffect::Hidden;
        }
        let least = fades.iter().map(|fade| fade.position(point)).fold(f64::INFINITY, f64::min);
        if least <= -self.noise {
            NoiseEffect::Hidden
        } else if self.patches > 0.0 || (self.noise > 0.0 && least < 1.0 + self.noise) {
            NoiseEffect::Some
        } else {
            NoiseEffect::None
        }
    }

    /// Returns the noise at each of `points`.
    fn noise_along(&self, points: &[GroundPoint<'_>], seed: u64) -> Vec<f64> {
        let flat = |point: &GroundPoint<'_>| match point.place {
            PatchPlace::Flat(place) => Some(place / self.scale),
            PatchPlace::Round(..) => None,
        };
        if let Some(places) = points.iter().map(flat).collect::<Option<Vec<DVec2>>>() {
            let mut noise = vec![0.0; places.len()];
            octaves_along(&places, 4, seed, &mut noise);
            return noise;
        }
        let noise = |point: &GroundPoint<'_>| match point.place {
            PatchPlace::Flat(place) => octaves(place / self.scale, 4, seed),
            PatchPlace::Round(place, grain) => {
                octaves_around(place / self.scale, 4, seed, grain / self.scale)
            }
        };
        points.iter().map(noise).collect()
    }
}

/// Returns the product of `fades` at a point, shifted by `shift`.
fn strength(fades: &[Fade], point: &GroundPoint<'_>, shift: f64) -> f64 {
    fades.iter().map(|fade| ease(fade.position(point) + shift)).product()
}

fn ease(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
