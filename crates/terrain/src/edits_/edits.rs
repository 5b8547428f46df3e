//! Terrain edits, stored separately from the terrain of the rules: level areas, cuttings and ditches.
//!
//! Each edit is stored with the smallest cell that contains its extent, and is applied whenever cells are
//! expanded. Edits are applied in the order of their creation: where two overlap, the later edit changes the
//! result of the earlier one.

use std::collections::BTreeMap;
use std::hash::{Hash, Hasher};

use glam::DVec2;
use rustc_hash::FxHasher;
use serde::{Deserialize, Serialize};

use super::bed::GroundBed;
use super::block::Area;
use super::local_edits::LocalEdits;
use super::view::DEEPEST;
use super::world::World;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_geometry::planar::{contains, foot};

/// A terrain edit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Edit {
    /// Levels the ground within an outline.
    Flatten {
        /// Outline (m).
        outline: Vec<[f64; 2]>,
        /// New height (m).
        height: f64,
        /// Distance (m) around the outline over which the effect fades.
        margin: f64,
    },
    /// Sets the ground along a path to the height of the path.
    Cut {
        /// Path (m) with heights.
        path: Vec<[f64; 3]>,
        /// Width (m).
        width: f64,
        /// Distance (m) on each side over which the effect fades.
        margin: f64,
    },
    /// Lowers the ground along a path to at most the height of the path.
    Carve {
        /// Path (m) with heights.
        path: Vec<[f64; 3]>,
        /// Width (m) of the bed.
        width: f64,
        /// Width (m) of the slope on each side, over which the effect fades.
        margin: f64,
    },
    /// Lowers the ground along a path, or raises it if the depth is negative.
    Dig {
        /// Path (m).
        path: Vec<[f64; 2]>,
        /// Width (m).
        width: f64,
        /// Depth (m) at the centreline.
        depth: f64,
    },
    /// Raises the ground to at least the height of a bed, with slopes next to it.
    Embank {
        /// Bed on the embankment.
        bed: GroundBed,
    },
    /// Lowers the ground to at most the height of a bed, with slopes next to it.
    Excavate {
        /// Bed in the excavation.
        bed: GroundBed,
    },
}

impl Edit {
    /// Raises the edit by `lift` (m).
    #[must_use]
    pub fn raised(mut self, lift: f64) -> Self {
        match &mut self {
            Self::Flatten { height, .. } => *height += lift,
            Self::Cut { path: line, .. }
            | Self::Carve { path: line, .. }
            | Self::Embank { bed: GroundBed { line, .. } }
            | Self::Excavate { bed: GroundBed { line, .. } } => line.iter_mut().for_each(|at| at[2] += lift),
            Self::Dig { .. } => {}
        }
        self
    }

    /// Returns the corners (m) of the bounding box of the edit's extent.
    pub(super) fn bounds(&self) -> (DVec2, DVec2) {
        let (points, reach): (Vec<DVec2>, f64) = match self {
            Self::Flatten { outline, margin, .. } => {
                (outline.iter().map(|at| DVec2::from(*at)).collect(), *margin)
            }
            Self::Cut { path, width, margin } | Self::Carve { path, width, margin } => {
                (path.iter().map(|[x, y, _]| DVec2::new(*x, *y)).collect(), width / 2.0 + margin)
            }
            Self::Dig { path, width, .. } => (path.iter().map(|at| DVec2::from(*at)).collect(), width / 2.0),
            Self::Embank { bed } | Self::Excavate { bed } => {
                (bed.line.iter().map(|[x, y, _]| DVec2::new(*x, *y)).collect(), bed.reach())
            }
        };
        let low = points.iter().fold(DVec2::INFINITY, |low, at| low.min(*at));
        let high = points.iter().fold(DVec2::NEG_INFINITY, |high, at| high.max(*at));
        (low - reach, high + reach)
    }

    /// Returns the new height (m) at `place` (m), given the previous height (m).
    pub(super) fn change(&self, place: DVec2, height: f64) -> f64 {
        match self {
            Self::Flatten { outline, height: level, margin } => {
                let distance = if contains(outline, place) { 0.0 } else { to_line(outline, place, true).0 };
                mix(height, *level, fade(distance, *margin))
            }
            Self::Cut { path, width, margin } => along_path(path, *width, *margin, place, height),
            Self::Carve { path, width, margin } => {
                height.min(along_path(path, *width, *margin, place, height))
            }
            Self::Dig { path, width, depth } => {
                let (distance, ..) = to_line(path, place, false);
                let across = (1.0 - distance / (width / 2.0)).clamp(0.0, 1.0);
                height - depth * across * across * (3.0 - 2.0 * across)
            }
            Self::Embank { bed } => {
                bed.beside(place).map_or(height, |(beyond, level)| height.max(level - beyond * bed.slope))
            }
            Self::Excavate { bed } => {
                bed.beside(place).map_or(height, |(beyond, level)| height.min(level + beyond * bed.slope))
            }
        }
    }

    /// Returns the reason why the edit is invalid, if it is.
    fn fault(&self) -> Option<&'static str> {
        let (points, least, sizes): (Vec<f64>, usize, Vec<f64>) = match self {
            Self::Flatten { outline, height, margin } => {
                (outline.iter().flatten().copied().chain([*height]).collect(), 2 * 3 + 1, vec![*margin])
            }
            Self::Cut { path, width, margin } | Self::Carve { path, width, margin } => {
                (path.iter().flatten().copied().collect(), 2 * 3, vec![*width, *margin])
            }
            Self::Dig { path, width, depth } => {
                (path.iter().flatten().copied().chain([*depth]).collect(), 2 * 2 + 1, vec![*width])
            }
            Self::Embank { bed } | Self::Excavate { bed } => {
                let least = if bed.is_area { 3 * 3 } else { 2 * 3 };
                let numbers = bed.line.iter().flatten().copied().collect();
                (numbers, least, vec![bed.width, bed.slope, bed.margin])
            }
        };
        if points.iter().chain(&sizes).any(|number| !number.is_finite()) {
            return Some("a number of it is not finite");
        }
        if points.len() < least {
            return Some(match self {
                Self::Flatten { .. } => "its outline has fewer than three points",
                Self::Embank { bed } | Self::Excavate { bed } if bed.is_area => {
                    "its outline has fewer than three points"
                }
                _ => "its path has fewer than two points",
            });
        }
        if sizes.iter().any(|size| *size < 0.0) {
            return Some("its width, margin or slope is below 0");
        }
        if matches!(self, Self::Dig { width, .. } if *width == 0.0) {
            return Some("its width is 0");
        }
        None
    }
}

/// Returns the height (m) at `place` (m) after adapting the ground to a path of `width` (m), given the
/// previous height (m).
fn along_path(path: &[[f64; 3]], width: f64, margin: f64, place: DVec2, height: f64) -> f64 {
    let flat: Vec<[f64; 2]> = path.iter().map(|[x, y, _]| [*x, *y]).collect();
    let (distance, piece, along) = to_line(&flat, place, false);
    let level = match path.get(piece + 1) {
        Some(next) => mix(path[piece][2], next[2], along),
        None => path[piece][2],
    };
    mix(height, level, fade(distance - width / 2.0, margin))
}

/// Smallest cell that contains the extent of an edit: level, row and column.
type EditCell = (u32, i64, i64);

/// Terrain edits, by cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Edits {
    cells: BTreeMap<EditCell, Vec<EditRecord>>,
    count: usize,
}

/// An edit with its position in the order.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct EditRecord {
    order: usize,
    /// Hash of the edit.
    #[serde(skip)]
    mark: u64,
    /// Corners (m) of the bounding box of its extent.
    #[serde(skip)]
    bounds: (DVec2, DVec2),
    #[serde(flatten)]
    edit: Edit,
}

/// File format of edits.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EditsFile {
    format: String,
    world: WorldStamp,
    cells: BTreeMap<String, Vec<EditRecord>>,
}

/// Identification of the world of edits.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WorldStamp {
    corner: [f64; 2],
    size: f64,
    /// Random key of the world in hexadecimal; `None` if it uses no random numbers.
    key: Option<String>,
}

const FORMAT: &str = "burgeon edits 1";

impl Edits {
    /// Returns true if there are no edits.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Returns the number of edits.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Appends an edit. Fails if the edit is invalid or its extent is outside the world.
    pub fn add(&mut self, world: &World, edit: Edit) -> Result<()> {
        if let Some(fault) = edit.fault() {
            return Err(Error::argument(format!("the ground cannot be changed so: {fault}")));
        }
        let (low, high) = edit.bounds();
        let (corner, far) = (world.corner, world.corner + world.size);
        if low.x > far.x || low.y > far.y || high.x < corner.x || high.y < corner.y {
            return Err(Error::argument(format!(
                "({}, {}) is outside the terrain",
                number(low.x),
                number(low.y)
            ))
            .help(format!("it reaches from ({}, {}) to ({}, {}) m", corner.x, corner.y, far.x, far.y)));
        }
        let cell = smallest(world, low, high);
        let mut hasher = FxHasher::default();
        (self.count, serde_json::to_string(&edit).unwrap_or_default()).hash(&mut hasher);
        let kept = EditRecord { order: self.count, mark: hasher.finish(), bounds: (low, high), edit };
        self.cells.entry(cell).or_default().push(kept);
        self.count += 1;
        Ok(())
    }

    /// Applies the edits to the heights (m) of the cells of `area` at `level`.
    pub(super) fn apply(&self, world: &World, level: u32, area: Area, heights: &mut [f64]) {
        let local = self.reaching(world, level, area);
        if local.is_empty() {
            return;
        }
        for ((x, y), height) in area.cells().zip(heights.iter_mut()) {
            *height = local.at(world.middle(level, x, y), *height);
        }
    }

    /// Returns the edits that affect the cells of `area` at `level`.
    pub(super) fn reaching(&self, world: &World, level: u32, area: Area) -> LocalEdits {
        let (low, high) = bounds(world, level, area);
        LocalEdits::new(self.met(world, level, area).into_iter().map(|kept| kept.edit.clone()), low, high)
    }

    /// Returns a hash of all edits that affect the cells of `area` at `level`; 0 if there are none.
    pub(super) fn mark(&self, world: &World, level: u32, area: Area) -> u64 {
        let met = self.met(world, level, area);
        met.iter().fold(0, |mark: u64, kept| mark.rotate_left(7) ^ kept.mark)
    }

    /// Returns the edits whose extent intersects the cells of `area` at `level`, in order.
    fn met(&self, world: &World, level: u32, area: Area) -> Vec<&EditRecord> {
        if self.is_empty() || area.is_empty() {
            return Vec::new();
        }
        let (low, high) = bounds(world, level, area);
        let reaches = |kept: &&EditRecord| {
            let (from, to) = kept.bounds;
            from.cmple(high).all() && to.cmpge(low).all()
        };
        let mut met: Vec<&EditRecord> = self.cells.values().flatten().filter(reaches).collect();
        met.sort_by_key(|kept| kept.order);
        met
    }

    /// Returns the edits as the JSON text of a file.
    pub fn to_json(&self, world: &World) -> String {
        let cells = self.cells.iter().map(|((level, y, x), kept)| (format!("{level}/{x}/{y}"), kept.clone()));
        let file = EditsFile { format: FORMAT.into(), world: WorldStamp::of(world), cells: cells.collect() };
        serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
    }

    /// Reads edits of `world` from the JSON text of the file `name`. Fails if the text is invalid or belongs
    /// to another world.
    pub fn from_json(text: &str, name: &str, world: &World) -> Result<Self> {
        let file: EditsFile = serde_json::from_str(text).map_err(|error| {
            Error::data(format!("{name} holds no edits of a terrain: {error}"))
                .help("such a file is written by burgeon run --edits FILE")
        })?;
        if file.format != FORMAT {
            return Err(Error::data(format!("{name} is of the kind {:?}, not {FORMAT:?}", file.format)));
        }
        let here = WorldStamp::of(world);
        if file.world != here {
            let shown = |stamp: &WorldStamp| {
                let key = stamp.key.as_ref().map(|key| format!(", drawn from {key}")).unwrap_or_default();
                format!("{} m from ({}, {}) on{key}", stamp.size, stamp.corner[0], stamp.corner[1])
            };
            return Err(Error::data(format!("{name} holds edits of another world: {}", shown(&file.world)))
                .help(format!("this one is {}", shown(&here))));
        }
        let mut kept: Vec<EditRecord> = file.cells.into_values().flatten().collect();
        kept.sort_by_key(|kept| kept.order);
        let mut edits = Self::default();
        for EditRecord { edit, .. } in kept {
            edits.add(world, edit).map_err(|error| Error::data(format!("{name}: {}", error.message())))?;
        }
        Ok(edits)
    }
}

/// Returns the corners (m) of the bounding box of the cells of `area` at `level`.
fn bounds(world: &World, level: u32, area: Area) -> (DVec2, DVec2) {
    if area.is_empty() {
        return (world.corner, world.corner);
    }
    let half = world.cell(level) / 2.0;
    let (west, north) = area.at(0);
    let (east, south) = area.at(area.len() - 1);
    let (a, b) = (world.middle(level, west, north), world.middle(level, east, south));
    (a.min(b) - half, a.max(b) + half)
}

impl WorldStamp {
    fn of(world: &World) -> Self {
        let key = world.key.map(|key| format!("{:016x}", key.0));
        Self { corner: world.corner.to_array(), size: world.size, key }
    }
}

/// Returns the smallest cell of `world` that contains the box from `low` to `high` (m); the root cell if the
/// box extends beyond the world.
#[allow(clippy::cast_possible_truncation, reason = "columns are below 2^31")]
fn smallest(world: &World, low: DVec2, high: DVec2) -> EditCell {
    let north = world.corner.y + world.size;
    let mut found = (0, 0, 0);
    for level in 1..=DEEPEST {
        let cell = world.cell(level);
        let of = |at: DVec2| {
            (((at.x - world.corner.x) / cell).floor() as i64, ((north - at.y) / cell).floor() as i64)
        };
        let ((west, south), (east, top)) = (of(low), of(high));
        let inside = |at: i64| (0..World::across(level)).contains(&at);
        if west != east || south != top || !inside(west) || !inside(top) {
            break;
        }
        found = (level, top, west);
    }
    found
}

/// Returns the strength (1 to 0) of an edit at a distance (m) from its full effect.
fn fade(distance: f64, margin: f64) -> f64 {
    if distance <= 0.0 {
        return 1.0;
    }
    if distance >= margin {
        return 0.0;
    }
    let part = 1.0 - distance / margin;
    part * part * (3.0 - 2.0 * part)
}

pub(super) fn mix(a: f64, b: f64, part: f64) -> f64 {
    // At full strength the result is exactly the new height.
    if part >= 1.0 { b } else { a + (b - a) * part }
}

/// Returns the distance (m) of `place` from a line, the index of the nearest segment, and the position (0 to
/// 1) along it.
pub(super) fn to_line(points: &[[f64; 2]], place: DVec2, closed: bool) -> (f64, usize, f64) {
    let count = if closed { points.len() } else { points.len().saturating_sub(1) };
    let mut best = (f64::INFINITY, 0, 0.0);
    for piece in 0..count {
        let edge = [points[piece], points[(piece + 1) % points.len()]].map(DVec2::from);
        let along = foot(edge, place);
        let distance = place.distance(edge[0] + (edge[1] - edge[0]) * along);
        if distance < best.0 {
            best = (distance, piece, along);
        }
    }
    best
}
