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

use super::edit::Edit;
use super::local_edits::LocalEdits;
use crate::division::block::Area;
use crate::division::world::{DEEPEST, World};
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;

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
            return Err(Error::argument(format!("invalid terrain edit: {fault}")));
        }
        let (low, high) = edit.bounds();
        let (corner, far) = (world.corner, world.corner + world.size);
        if low.x > far.x || low.y > far.y || high.x < corner.x || high.y < corner.y {
            return Err(Error::argument(format!(
                "({}, {}) is outside the terrain",
                number(low.x),
                number(low.y)
            ))
            .help(format!("it extends from ({}, {}) to ({}, {}) m", corner.x, corner.y, far.x, far.y)));
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
    pub(crate) fn apply(&self, world: &World, level: u32, area: Area, heights: &mut [f64]) {
        let local = self.local_edits(world, level, area);
        if local.is_empty() {
            return;
        }
        for ((x, y), height) in area.cells().zip(heights.iter_mut()) {
            *height = local.at(world.middle(level, x, y), *height);
        }
    }

    /// Returns the edits that affect the cells of `area` at `level`.
    pub(crate) fn local_edits(&self, world: &World, level: u32, area: Area) -> LocalEdits {
        let (low, high) = bounds(world, level, area);
        LocalEdits::new(
            self.records_within(world, level, area).into_iter().map(|kept| kept.edit.clone()),
            low,
            high,
        )
    }

    /// Returns a hash of all edits that affect the cells of `area` at `level`; 0 if there are none.
    pub(crate) fn mark(&self, world: &World, level: u32, area: Area) -> u64 {
        let met = self.records_within(world, level, area);
        met.iter().fold(0, |mark: u64, kept| mark.rotate_left(7) ^ kept.mark)
    }

    /// Returns the edits whose extent intersects the cells of `area` at `level`, in order.
    fn records_within(&self, world: &World, level: u32, area: Area) -> Vec<&EditRecord> {
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
    ///
    /// ```
    /// use burgeon_terrain::{Edit, Edits, World};
    /// use glam::DVec2;
    ///
    /// let (corner, layers, remap) = (DVec2::ZERO, vec![], vec![]);
    /// let world = World { corner, size: 100.0, layers, smooth: true, key: None, remap, measured: None };
    /// let mut edits = Edits::default();
    /// edits.add(&world, Edit::Dig { path: vec![[10.0, 50.0], [90.0, 50.0]], width: 4.0, depth: 1.0 })?;
    /// let text = edits.to_json(&world);
    /// assert_eq!(Edits::from_json(&text, "ditch.json", &world)?.len(), 1);
    /// let other = World { size: 200.0, ..world };
    /// assert!(Edits::from_json(&text, "ditch.json", &other).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn from_json(text: &str, name: &str, world: &World) -> Result<Self> {
        let file: EditsFile = serde_json::from_str(text).map_err(|error| {
            Error::data(format!("{name} contains no terrain edits: {error}"))
                .help("write such a file with burgeon run --edits FILE")
        })?;
        if file.format != FORMAT {
            return Err(Error::data(format!("{name} has the format {:?}, not {FORMAT:?}", file.format)));
        }
        let here = WorldStamp::of(world);
        if file.world != here {
            let shown = |stamp: &WorldStamp| {
                let key = stamp.key.as_ref().map(|key| format!(", seeded by {key}")).unwrap_or_default();
                format!("{} m from ({}, {}) on{key}", stamp.size, stamp.corner[0], stamp.corner[1])
            };
            return Err(Error::data(format!(
                "{name} contains edits of another world: {}",
                shown(&file.world)
            ))
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
