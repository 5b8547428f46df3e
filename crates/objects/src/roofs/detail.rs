//! Objects on roofs: chimneys, dormers, aerials, gutters.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DVec3};

use burgeon_base::error::{Error, Result};
use burgeon_base::random::Stream;
use burgeon_geometry::Ring;
use burgeon_geometry::roof::{Patch, PatchKind, RoofLineKind, lines, normal};
use burgeon_kit::{Expectation, Field, fields};
use burgeon_kit::{Model, Parameter, Table, Value};

/// An entry of the `details` of `footprint:roof { ... }`.
///
/// The model stands upright with its origin on the roof. Its x axis runs along the line, to the right as seen from
/// outside, and its front, -y, faces outwards.
#[fields("a detail of footprint:roof")]
pub struct RoofDetail {
    /// Model to place, as returned by `derive`.
    pub model: Option<Arc<Model>>,
    /// Place on the roof: "ridge", "hip", "valley", "eaves", "slope" or "gable".
    #[default("ridge".into())]
    pub on: String,
    /// Distance between models along the line (m). If omitted, one model is placed in the middle.
    pub every: Option<f64>,
    /// Free length at both ends of the line (m).
    #[default(0.5)]
    pub margin: f64,
    /// Distance up the slope from the foot of the flap or gable (m, on the plan; m of height on gables). If omitted,
    /// the middle of a flap, and a third of the height of a gable.
    pub offset: Option<f64>,
    /// Number of rows on a slope.
    #[default(1)]
    pub rows: u32,
    /// Number of the flap on a slope with several flaps, from the eaves up.
    #[default(1)]
    pub flap: u32,
    /// Maximum number on the whole roof, chosen at random from all positions.
    pub count: Option<u32>,
    /// Probability of a model at each position, from 0 to 1.
    #[default(1.0)]
    pub chance: f64,
    /// Scale factor of the model.
    #[default(1.0)]
    pub scale: f64,
    /// Rotation about the vertical axis (degrees).
    #[default(0.0)]
    pub turn: f64,
    /// Depth of the origin below the roof (m).
    #[default(0.0)]
    pub sink: f64,
    /// Perpendicular to the roof instead of upright.
    pub tilt: bool,
    /// Stretched along x to the whole length of the line, such as a gutter.
    pub stretch: bool,
}

impl Parameter for RoofDetail {
    fn luau() -> String {
        "{ [string]: any }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Table(table) => Self::from_table(&table)
                .map_err(|error| Expectation::new(format!("a detail ({})", error.message()))),
            _ => Err(Expectation::new("a table of a detail's fields")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

const PLACES: [&str; 6] = ["ridge", "hip", "valley", "eaves", "slope", "gable"];

/// Maximum number of models of one detail on a roof.
const MOST: usize = 100_000;

/// A line along which models may be placed.
struct Track {
    from: DVec3,
    to: DVec3,
    /// Upward normal of the roof at the line.
    up: DVec3,
}

impl RoofDetail {
    /// Fails if a field is out of its range.
    pub(crate) fn check(&self) -> Result<()> {
        let what = "a detail of footprint:roof";
        if self.model.is_none() {
            return Err(
                Error::argument(format!("{what} has no model")).help("set it to the result of derive")
            );
        }
        if !PLACES.contains(&self.on.as_str()) {
            return Err(Error::argument(format!("{what}: unknown place {:?}", self.on))
                .help(format!("use {}", PLACES.join(", "))));
        }
        let positive = [("every", self.every.unwrap_or(1.0)), ("scale", self.scale)];
        if let Some((name, number)) = positive.into_iter().find(|(_, number)| !(1e-3..=1e4).contains(number))
        {
            return Err(Error::argument(format!("{what}: {name} is {number}")).help("give 0.001 to 10000"));
        }
        let lengths = [("margin", self.margin), ("offset", self.offset.unwrap_or(0.0))];
        if let Some((name, number)) = lengths.into_iter().find(|(_, number)| !(0.0..=1e4).contains(number)) {
            return Err(Error::argument(format!("{what}: {name} is {number} m")).help("give 0 to 10000 m"));
        }
        if !(0.0..=1.0).contains(&self.chance) {
            return Err(Error::argument(format!("{what}: chance is {}", self.chance)).help("give 0 to 1"));
        }
        if !(1..=100).contains(&self.rows) || self.flap == 0 {
            return Err(Error::argument(format!("{what}: rows is {} and flap is {}", self.rows, self.flap))
                .help("give 1 to 100 rows, and count flaps from 1"));
        }
        Ok(())
    }

    /// Returns the model at each of its positions on a roof. Random choices depend on `seed`.
    pub(crate) fn frames(&self, patches: &[Patch], seed: u64) -> Vec<(Arc<Model>, DAffine3)> {
        let Some(model) = &self.model else { return Vec::new() };
        let mut random = Stream::new(seed);
        let mut frames: Vec<DAffine3> = Vec::new();
        for track in self.tracks(patches) {
            let length = track.from.distance(track.to);
            let (count, every) = match self.every {
                _ if self.stretch => (1.0, 0.0),
                None => (f64::from(u8::from(length >= 2.0 * self.margin)), 0.0),
                Some(every) => (((length - 2.0 * self.margin) / every + 1e-9).floor() + 1.0, every),
            };
            let begin = (length - (count - 1.0) * every) / 2.0;
            let mut number = 0.0;
            while number < count && frames.len() < MOST {
                // Each position consumes one random number, so that the other positions do not change with `chance`.
                let taken = random.uniform() < self.chance;
                if taken {
                    let at = track.from.lerp(track.to, (begin + number * every) / length.max(1e-9));
                    frames.push(self.frame(&track, at, model));
                }
                number += 1.0;
            }
        }
        if let Some(count) = self.count {
            let count = usize::try_from(count).unwrap_or(usize::MAX);
            let mut order: Vec<usize> = (0..frames.len()).collect();
            for index in 0..count.min(order.len()) {
                let other = index + random.below(order.len() - index);
                order.swap(index, other);
            }
            order.truncate(count);
            order.sort_unstable();
            frames = order.into_iter().map(|index| frames[index]).collect();
        }
        frames.into_iter().map(|frame| (Arc::clone(model), frame)).collect()
    }

    fn frame(&self, track: &Track, at: DVec3, model: &Model) -> DAffine3 {
        let along = (track.to - track.from).normalize_or_zero();
        let (x, z) = if self.tilt || self.stretch {
            let lean = if self.tilt { track.up } else { DVec3::Z };
            (along, (lean - along * along.dot(lean)).normalize_or(DVec3::Z))
        } else {
            (along.with_z(0.0).normalize_or(DVec3::X), DVec3::Z)
        };
        let turn = DMat3::from_rotation_z(self.turn.to_radians());
        let axes = DMat3::from_cols(x, z.cross(x), z);
        let mut frame = DAffine3::from_mat3_translation(axes * turn * self.scale, at - z * self.sink);
        if self.stretch {
            let (low, high) = (model.low().x, model.high().x);
            let factor = track.from.distance(track.to) / ((high - low) * self.scale).max(1e-6);
            let stretched = DMat3::from_diagonal(DVec3::new(factor, 1.0, 1.0));
            let middle = DAffine3::from_translation(DVec3::X * -low.midpoint(high));
            frame = frame * DAffine3::from_mat3(stretched) * middle;
        }
        frame
    }

    fn tracks(&self, patches: &[Patch]) -> Vec<Track> {
        let kind = match self.on.as_str() {
            "slope" => return self.slopes(patches),
            "gable" => return self.gables(patches),
            "hip" => RoofLineKind::Hip,
            "valley" => RoofLineKind::Valley,
            "eaves" => RoofLineKind::Eaves,
            _ => RoofLineKind::Ridge,
        };
        let found = lines(patches).into_iter().filter(|line| line.kind == kind);
        let track = |line: burgeon_geometry::roof::RoofLine| {
            let [from, to] = line.ends;
            let up = (line.normals[0] + line.normals[1]).normalize_or(DVec3::Z);
            Track { from, to, up }
        };
        found.map(track).collect()
    }

    /// Returns horizontal lines across the flaps.
    fn slopes(&self, patches: &[Patch]) -> Vec<Track> {
        let flap = usize::try_from(self.flap - 1).unwrap_or(usize::MAX);
        let mut tracks = Vec::new();
        let wanted = |patch: &&Patch| patch.kind == PatchKind::Slope && patch.flap == flap;
        for patch in patches.iter().filter(wanted) {
            let (along, up) = (patch.along.extend(0.0), normal(patch));
            let inward = patch.along.perp().extend(0.0);
            let depths = || patch.rings.iter().flatten().map(|point| inward.dot(*point));
            let (low, high) =
                (depths().fold(f64::INFINITY, f64::min), depths().fold(f64::NEG_INFINITY, f64::max));
            for row in 0..self.rows {
                let row = f64::from(row);
                let depth = match self.offset {
                    Some(offset) => low + offset + row * self.every.unwrap_or(1.0),
                    None => low + (high - low) * (row + 0.5) / f64::from(self.rows),
                };
                let mut crossings: Vec<DVec3> = Vec::new();
                for [a, b] in patch.rings.iter().flat_map(Ring::edges) {
                    let (from, to) = (inward.dot(a) - depth, inward.dot(b) - depth);
                    if (from < 0.0) != (to < 0.0) {
                        crossings.push(a.lerp(b, from / (from - to)));
                    }
                }
                crossings.sort_by(|a, b| along.dot(*a).total_cmp(&along.dot(*b)));
                tracks.extend(crossings.chunks_exact(2).map(|ends| Track { from: ends[0], to: ends[1], up }));
            }
        }
        tracks
    }

    /// Returns horizontal lines across the gables.
    fn gables(&self, patches: &[Patch]) -> Vec<Track> {
        let mut tracks = Vec::new();
        let extent = |patch: &Patch| {
            patch.rings.iter().flatten().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
                (low.min(point.z), high.max(point.z))
            })
        };
        let tall = |patch: &Patch| extent(patch).1 - extent(patch).0;
        // A gable in several parts is represented by its tallest part.
        let mut tallest: Vec<&Patch> = Vec::new();
        for patch in patches.iter().filter(|patch| patch.kind == PatchKind::Gable) {
            match tallest.iter_mut().find(|known| known.edge == patch.edge) {
                Some(known) if tall(known) < tall(patch) => *known = patch,
                Some(_) => {}
                None => tallest.push(patch),
            }
        }
        for patch in tallest {
            let along = patch.along.extend(0.0);
            let (low, high) = extent(patch);
            let height = low + self.offset.unwrap_or((high - low) / 3.0);
            let mut crossings: Vec<DVec3> = Vec::new();
            for [a, b] in patch.rings.iter().flat_map(Ring::edges) {
                if (a.z < height) != (b.z < height) {
                    crossings.push(a.lerp(b, (height - a.z) / (b.z - a.z)));
                }
            }
            crossings.sort_by(|a, b| along.dot(*a).total_cmp(&along.dot(*b)));
            let up = DVec3::Z;
            tracks.extend(crossings.chunks_exact(2).map(|ends| Track { from: ends[0], to: ends[1], up }));
        }
        tracks
    }
}
