//! Changes of the ground that are kept apart from what the rules give: flattened places, cuttings and ditches.
//!
//! Each change is kept with the smallest cell that holds all it reaches, and is applied wherever cells are expanded.
//! Changes act in the order in which they were made: where two of them meet, the later one acts on what the earlier
//! one has left.

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

/// A change of the ground.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Edit {
    /// The ground within an outline is level.
    Flatten {
        /// The outline (m).
        outline: Vec<[f64; 2]>,
        /// The height (m) that it gets.
        height: f64,
        /// Over which distance (m) around it the ground changes less and less.
        margin: f64,
    },
    /// The ground along a path is as high as the path.
    Cut {
        /// The path (m), with heights.
        path: Vec<[f64; 3]>,
        /// How wide (m) it is.
        width: f64,
        /// Over which distance (m) beside it the ground changes less and less.
        margin: f64,
    },
    /// The ground along a path is nowhere higher than the path.
    Carve {
        /// The path (m), with heights.
        path: Vec<[f64; 3]>,
        /// Width (m) of the bed.
        width: f64,
        /// Width (m) of the slope on each side, over which the ground changes less and less.
        margin: f64,
    },
    /// The ground along a path is lower than it was; higher, if the depth is below 0.
    Dig {
        /// The path (m).
        path: Vec<[f64; 2]>,
        /// How wide (m) it is.
        width: f64,
        /// How deep (m) it is in the middle.
        depth: f64,
    },
    /// The ground is nowhere lower than a bed, and rises towards it from beside.
    Embank {
        /// What lies on it.
        bed: GroundBed,
    },
    /// The ground is nowhere higher than a bed, and falls towards it from beside.
    Excavate {
        /// What lies in it.
        bed: GroundBed,
    },
}

impl Edit {
    /// The same, higher by `lift` (m).
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

    /// The corners (m) of the box that it reaches.
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

    /// The height (m) at `place` (m), where it was `height` (m).
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

    /// What is wrong with it, if anything is.
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

/// The height (m) at `place` (m), where it was `height` (m), once the ground follows a path of `width` (m).
fn along_path(path: &[[f64; 3]], width: f64, margin: f64, place: DVec2, height: f64) -> f64 {
    let flat: Vec<[f64; 2]> = path.iter().map(|[x, y, _]| [*x, *y]).collect();
    let (distance, piece, along) = to_line(&flat, place, false);
    let level = match path.get(piece + 1) {
        Some(next) => mix(path[piece][2], next[2], along),
        None => path[piece][2],
    };
    mix(height, level, fade(distance - width / 2.0, margin))
}

/// The smallest cell that holds what an edit reaches: level, row and column.
type EditCell = (u32, i64, i64);

/// Changes of the ground, by cell.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Edits {
    cells: BTreeMap<EditCell, Vec<EditRecord>>,
    count: usize,
}

/// An edit and when it was made.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct EditRecord {
    order: usize,
    /// A number for what it is.
    #[serde(skip)]
    mark: u64,
    /// The corners (m) of the box that it reaches.
    #[serde(skip)]
    bounds: (DVec2, DVec2),
    #[serde(flatten)]
    edit: Edit,
}

/// A file of edits.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct EditsFile {
    format: String,
    world: WorldStamp,
    cells: BTreeMap<String, Vec<EditRecord>>,
}

/// What tells the world that edits are of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct WorldStamp {
    corner: [f64; 2],
    size: f64,
    /// The key that all that is drawn comes from, in hexadecimal; none where nothing is.
    key: Option<String>,
}

const FORMAT: &str = "burgeon edits 1";

impl Edits {
    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// The number of edits.
    pub fn len(&self) -> usize {
        self.count
    }

    /// Adds an edit after all others. Fails for one that cannot be, or that reaches nothing of the world.
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

    /// Changes the heights (m) of the cells of `area` at `level`.
    pub(super) fn apply(&self, world: &World, level: u32, area: Area, heights: &mut [f64]) {
        let local = self.reaching(world, level, area);
        if local.is_empty() {
            return;
        }
        for ((x, y), height) in area.cells().zip(heights.iter_mut()) {
            *height = local.at(world.middle(level, x, y), *height);
        }
    }

    /// What changes the cells of `area` at `level`.
    pub(super) fn reaching(&self, world: &World, level: u32, area: Area) -> LocalEdits {
        let (low, high) = bounds(world, level, area);
        LocalEdits::new(self.met(world, level, area).into_iter().map(|kept| kept.edit.clone()), low, high)
    }

    /// A number for all that changes the cells of `area` at `level`; 0 where nothing does.
    pub(super) fn mark(&self, world: &World, level: u32, area: Area) -> u64 {
        let met = self.met(world, level, area);
        met.iter().fold(0, |mark: u64, kept| mark.rotate_left(7) ^ kept.mark)
    }

    /// The edits that reach cells of `area` at `level`, in their order.
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

    /// The text of a file that holds them.
    pub fn to_json(&self, world: &World) -> String {
        let cells = self.cells.iter().map(|((level, y, x), kept)| (format!("{level}/{x}/{y}"), kept.clone()));
        let file = EditsFile { format: FORMAT.into(), world: WorldStamp::of(world), cells: cells.collect() };
        serde_json::to_string_pretty(&file).unwrap_or_default() + "\n"
    }

    /// Reads the text of a file called `name`, which holds edits of `world`.
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

/// The corners (m) of the box around the cells of `area` at `level`.
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

/// The smallest cell of `world` that holds the box from `low` to `high` (m); the whole where it reaches outside.
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

/// How much (1 to 0) a change acts at a distance (m) from where it acts fully.
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
    // What acts fully leaves exactly its own height.
    if part >= 1.0 { b } else { a + (b - a) * part }
}

/// The distance (m) of `place` from a line, the piece of it that is nearest, and how far (0 to 1) along that piece.
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
