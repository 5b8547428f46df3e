//! Where something is on the ground: by height, slope, curvature, symbol and noise, with smooth transitions.

use std::sync::Arc;

use glam::{DVec2, DVec3};

use crate::error::{Error, Result, nearest};
use crate::objects::{Expected, Parameter, Table, Value};
use crate::rules::Symbol;
use crate::terrain::{Ground, octaves};

fields! {
    /// Where a cover lies or plants grow.
    pub struct Mask for "on" {
        /// From which height (m) to which it fades in; out, if the first is greater.
        pub height: Vec<f64> = Vec::new(),
        /// From which slope (degrees) to which it fades in; out, if the first is greater.
        pub slope: Vec<f64> = Vec::new(),
        /// From which curvature (1/m) to which it fades in; hollows are above 0, crests below.
        pub curvature: Vec<f64> = Vec::new(),
        /// The symbols of the cells where it is; all, if there are none.
        pub symbols: Vec<String> = Vec::new(),
        /// How far (0 to 1) noise shifts where it fades in.
        pub noise: f64 = 0.0,
        /// How much (0 to 1) it is missing between patches.
        pub patches: f64 = 0.0,
        /// The size (m) of patches, and of what noise shifts.
        pub scale: f64 = 50.0,
    }
}

impl Parameter for Mask {
    fn luau() -> String {
        "{ height: { number }?, slope: { number }?, curvature: { number }?, symbols: { string }?, noise: number?, patches: number?, scale: number? }"
            .into()
    }

    fn from_value(value: Value) -> Result<Self, Expected> {
        let Value::Table(table) = &value else {
            return Err(Expected::new(
                "a table of height, slope, curvature, symbols, noise, patches and scale",
            ));
        };
        let mask = Self::from_table(table)
            .map_err(|error| Expected::new(format!("a place ({})", error.message())))?;
        for (name, range) in mask.ranges() {
            if !matches!(range, [] | [_, _]) {
                return Err(Expected::new(format!("a place whose {name} is a range, such as {{ 30, 45 }}")));
            }
        }
        if mask.scale <= 0.0 || [mask.noise, mask.patches].iter().any(|part| !(0.0..=1.0).contains(part)) {
            return Err(Expected::new(
                "a place whose scale is above 0, and whose noise and patches are from 0 to 1",
            ));
        }
        Ok(mask)
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// How the ground is at a place.
pub(super) struct Spot {
    place: DVec2,
    pub height: f64,
    up: DVec3,
    /// 1/m; above 0 in hollows.
    curvature: f64,
}

impl Spot {
    /// The ground at `place` (m); its curvature over `reach` (m), if that is wanted.
    pub(super) fn new(ground: &Ground, place: DVec2, reach: f64, bent: bool) -> Self {
        let height = ground.height(place).unwrap_or(0.0);
        let up = ground.way_up(place).unwrap_or(DVec3::Z);
        let beside = |x: f64, y: f64| ground.height(place + DVec2::new(x, y) * reach).unwrap_or(height);
        let curvature = if bent {
            let around = beside(1.0, 0.0) + beside(-1.0, 0.0) + beside(0.0, 1.0) + beside(0.0, -1.0);
            (around - 4.0 * height) / (reach * reach)
        } else {
            0.0
        };
        Self { place, height, up, curvature }
    }
}

impl Mask {
    fn ranges(&self) -> [(&'static str, &[f64]); 3] {
        [("height", &self.height), ("slope", &self.slope), ("curvature", &self.curvature)]
    }

    /// Whether it asks for the curvature of the ground.
    pub(super) fn is_bent(&self) -> bool {
        !self.curvature.is_empty()
    }

    /// The numbers of its symbols among `names`.
    pub(super) fn numbers(&self, names: &[String]) -> Result<Vec<Symbol>> {
        let number = |symbol: &String| {
            let found = names.iter().position(|name| name == symbol).and_then(|at| Symbol::try_from(at).ok());
            found.ok_or_else(|| {
                let error = Error::new(format!("terrain: no rule makes {symbol}"));
                match nearest(symbol, names.iter().map(String::as_str)) {
                    Some(near) => error.help(format!("did you mean {near}?")),
                    None => error.help(format!("the cells are {}", names.join(", "))),
                }
            })
        };
        self.symbols.iter().map(number).collect()
    }

    /// How much (0 to 1) of it there is at a spot. `symbols` are the numbers of its symbols; masks with other `seed`s
    /// have other patches.
    pub(super) fn at(&self, ground: &Ground, spot: &Spot, symbols: &[Symbol], seed: u64) -> f64 {
        if !symbols.is_empty() && !ground.symbol(spot.place).is_some_and(|symbol| symbols.contains(&symbol)) {
            return 0.0;
        }
        let noisy = self.noise > 0.0 || self.patches > 0.0;
        let noise = if noisy { octaves(spot.place / self.scale, 4, seed) } else { 0.0 };
        let shift = noise * self.noise;
        let slope = if self.slope.is_empty() { 0.0 } else { spot.up.z.clamp(-1.0, 1.0).acos().to_degrees() };
        let values = [spot.height, slope, spot.curvature];
        let mut amount = 1.0 - self.patches * (1.0 - eased(0.5 + 2.5 * noise));
        for ((_, range), value) in self.ranges().into_iter().zip(values) {
            if let [from, to] = *range {
                let step = f64::from(u8::from(value >= from));
                let along = if from == to { step } else { (value - from) / (to - from) };
                amount *= eased(along + shift);
            }
        }
        amount
    }
}

fn eased(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}
