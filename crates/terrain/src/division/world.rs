//! Worlds: the rules for each level of cells, and the expansion of any part.

use std::sync::Arc;

use glam::DVec2;
use rayon::prelude::*;

use super::block::{Area, Block};
use super::height_source::HeightSource;
use super::table::RuleTable;
use crate::division::block::CellSymbol;
use burgeon_base::MemoryOwner;
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};
use burgeon_base::memory::allocate_zeroed;

/// Maximum number of divisions of a world: its finest columns and rows are numbered in 31 bits.
pub const DEEPEST: u32 = 30;

/// Memory (bytes) of the quadrants of a cell: symbols, heights and a parameter.
const DIVIDED: usize = 4 * 18;

/// Minimum slope (m/m) for the full addition of detail to measured heights.
const STEEP: f64 = 0.3;

/// Rules that divide cells.
#[derive(Clone)]
pub enum DivisionRules {
    /// No rules: quadrants are equal to their cell.
    None,
    /// A rule table.
    Table(Arc<RuleTable>),
    /// Rules of a system of the script, by its index.
    System(usize),
}

/// Rules from one level on.
#[derive(Clone)]
pub struct LevelRules {
    /// Level of the first cells that are divided.
    pub from: u32,
    /// Rules.
    pub rules: DivisionRules,
    /// Symbol of all cells of that level.
    pub start: CellSymbol,
    /// Addition to the height (m) of each cell.
    pub height: f64,
    /// Other parameters of each cell.
    pub rest: Vec<f64>,
    /// Names of the symbols of the cells, by index; for a system, empty until its first cell is known.
    pub names: Arc<Vec<String>>,
}

/// First cell of a system.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Begin {
    /// Symbol.
    pub symbol: CellSymbol,
    /// Height (m).
    pub height: f64,
    /// Other parameters, as many as the maximum of any cell of the system.
    pub rest: Vec<f64>,
    /// Names of all symbols, by index.
    pub names: Vec<String>,
}

/// Division of cells by the rules of a system.
pub trait Divide {
    /// Returns the first cell of system `system`.
    fn begin(&self, system: usize) -> Result<Begin>;

    /// Returns the quadrants of the cells of `area` by the rules of system `system`; if they are the `last`,
    /// other parameters and keys may be omitted.
    fn divide(&self, system: usize, cells: &Block, area: Area, last: bool) -> Result<Block>;
}

/// Division without systems, for worlds that only use rule tables.
pub struct Tables;

impl Divide for Tables {
    fn begin(&self, _: usize) -> Result<Begin> {
        Err(Error::internal("only a script knows what its systems begin with"))
    }

    fn divide(&self, _: usize, _: &Block, _: Area, _: bool) -> Result<Block> {
        Err(Error::internal("only a script can divide cells by the rules of a system"))
    }
}

/// A square of ground that is repeatedly divided into four quadrants.
#[derive(Clone)]
pub struct World {
    /// South-west corner (m).
    pub corner: DVec2,
    /// Side length (m).
    pub size: f64,
    /// Rules by level; the first begin at level 0.
    pub layers: Vec<LevelRules>,
    /// Smooth surface through the cells.
    pub smooth: bool,
    /// Random key of the root cell, if any rule uses random numbers.
    pub key: Option<ModuleKey>,
    /// Mapping of the heights (m) of the surface: sorted pairs of an old and a new height, with linear
    /// interpolation. Empty for no change.
    pub remap: Vec<[f64; 2]>,
    /// Measured heights, to which the heights of the rules are added.
    pub measured: Option<Arc<dyn HeightSource>>,
}

impl World {
    /// Returns the number of cells per side at `level`.
    pub fn across(level: u32) -> i64 {
        1 << level
    }

    /// Returns the side length (m) of cells at `level`.
    pub fn cell(&self, level: u32) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "a power of two")]
        let across = Self::across(level) as f64;
        self.size / across
    }

    /// Returns the centre (m) of a cell.
    #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
    pub fn middle(&self, level: u32, x: i64, y: i64) -> DVec2 {
        let cell = self.cell(level);
        let north = self.corner.y + self.size;
        DVec2::new(self.corner.x + (x as f64 + 0.5) * cell, north - (y as f64 + 0.5) * cell)
    }

    /// Returns the north-west corner (m) of a cell.
    #[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
    pub(crate) fn corner_of(&self, level: u32, x: i64, y: i64) -> DVec2 {
        let cell = self.cell(level);
        DVec2::new(self.corner.x + x as f64 * cell, self.corner.y + self.size - y as f64 * cell)
    }

    /// Returns true if the rules of a script divide any of its cells.
    pub fn has_systems(&self) -> bool {
        self.layers.iter().any(|layer| matches!(layer.rules, DivisionRules::System(_)))
    }

    /// Returns the world with the first cells of its systems; `None` if they are already known or not needed.
    pub fn begin_systems(&self, divide: &dyn Divide) -> Result<Option<Self>> {
        let unknown =
            |layer: &LevelRules| matches!(layer.rules, DivisionRules::System(_)) && layer.names.is_empty();
        if !self.layers.iter().any(unknown) {
            return Ok(None);
        }
        let mut world = self.clone();
        for layer in world.layers.iter_mut().filter(|layer| unknown(layer)) {
            if let DivisionRules::System(system) = layer.rules {
                let begin = divide.begin(system)?;
                layer.start = begin.symbol;
                layer.height += begin.height;
                layer.rest = begin.rest;
                layer.names = Arc::new(begin.names);
            }
        }
        Ok(Some(world))
    }

    /// Returns the name of a symbol of the cells of `level`; empty if no rules divide them.
    pub fn name(&self, level: u32, symbol: CellSymbol) -> &str {
        self.layer(level).names.get(usize::from(symbol)).map_or("", String::as_str)
    }

    /// Returns the cells of `area` at `level`, which depend only on the world and their positions.
    pub fn cells(&self, level: u32, area: Area, divide: &dyn Divide) -> Result<Block> {
        self.descend(&self.root(), level, area, false, divide)
    }

    /// Returns the root cell, which covers the whole world.
    pub fn root(&self) -> Block {
        let mut root = Block {
            level: 0,
            area: Area { x: 0, y: 0, columns: 1, rows: 1 },
            symbols: vec![0],
            heights: vec![0.0],
            rest: Vec::new(),
            stride: 0,
            keys: self.key.into_iter().collect(),
            forms: Vec::new(),
            smooth: Vec::new(),
        };
        if self.smooth {
            root.smooth = vec![0.0];
        }
        self.begin_layer(&mut root);
        root
    }

    /// Returns the cells of `area` at `level`, derived from `from`, which contains all their ancestors; if
    /// they are the `last`, the data for further divisions are omitted.
    pub fn descend(
        &self,
        from: &Block,
        level: u32,
        area: Area,
        last: bool,
        divide: &dyn Divide,
    ) -> Result<Block> {
        let margin = i64::from(self.smooth);
        let mut areas = vec![area];
        for above in (from.level..level).rev() {
            let below = areas[areas.len() - 1];
            areas.push(below.parents(margin, Self::across(above)));
        }
        let mut block: Option<Block> = None;
        let steps = areas.len() - 1;
        for (step, below) in areas.iter().rev().skip(1).enumerate() {
            let cells = block.as_ref().unwrap_or(from);
            let divided = below.parents(0, Self::across(cells.level));
            let last = last && step + 1 == steps;
            MemoryOwner::ensure_room(divided.len() * DIVIDED)?;
            let mut made = self.quarter(cells, divided, last, divide)?;
            if self.smooth {
                smooth(cells, &mut made);
            }
            self.begin_layer(&mut made);
            block = Some(made);
        }
        Ok(block.unwrap_or_else(|| from.clone()))
    }

    /// Returns the height (m) of the ground at `place` (m), where the surface of the rules has the height
    /// `laid` (m): that height, or the measured height with as much detail as is allowed there.
    pub(crate) fn ground(&self, place: DVec2, laid: f64) -> f64 {
        let Some(measured) = &self.measured else { return laid };
        let (height, slope) = measured.ground(place, self.smooth).unwrap_or_default();
        if laid == 0.0 {
            return height;
        }
        height + laid * measured.freedom(place) * ease(slope / STEEP)
    }

    /// Returns true if the cells of `level` are small enough to show each sample.
    pub fn shows_samples(&self, level: u32) -> bool {
        // Equal sizes may differ by rounding.
        self.measured.as_ref().is_some_and(|measured| self.cell(level) <= measured.step() * (1.0 + 1e-6))
    }

    /// Returns true if heights are mapped.
    pub(crate) fn is_remapped(&self) -> bool {
        !self.remap.is_empty()
    }

    /// Returns the mapped height (m).
    pub(crate) fn remap_height(&self, height: f64) -> f64 {
        let (Some(first), Some(last)) = (self.remap.first(), self.remap.last()) else { return height };
        let above = self.remap.partition_point(|pair| pair[0] <= height);
        match (above.checked_sub(1).map(|below| self.remap[below]), self.remap.get(above)) {
            (Some([from, a]), Some([to, b])) => a + (b - a) * (height - from) / (to - from),
            (None, _) => first[1],
            (_, None) => last[1],
        }
    }

    /// Returns the quadrants of the cells of `area`, by the rules alone.
    pub(crate) fn quarter(
        &self,
        cells: &Block,
        area: Area,
        last: bool,
        divide: &dyn Divide,
    ) -> Result<Block> {
        match &self.layer(cells.level).rules {
            DivisionRules::None => Ok(copy_quadrants(cells, area)),
            DivisionRules::Table(table) => Ok(table.divide(cells, area, last)),
            DivisionRules::System(system) => divide.divide(*system, cells, area, last),
        }
    }

    fn layer(&self, level: u32) -> &LevelRules {
        let known = self.layers.iter().rev().find(|layer| layer.from <= level);
        known.unwrap_or(&self.layers[0])
    }

    /// Initializes the cells with the symbol, height and parameters of the rules that begin at their level.
    pub(crate) fn begin_layer(&self, block: &mut Block) {
        let Some(layer) = self.layers.iter().find(|layer| layer.from == block.level) else { return };
        block.symbols.fill(layer.start);
        block.stride = layer.rest.len();
        block.rest = layer.rest.repeat(block.symbols.len());
        if layer.height != 0.0 {
            let both = block.heights.iter_mut().chain(&mut block.smooth);
            both.for_each(|height| *height += layer.height);
        }
    }
}

fn ease(along: f64) -> f64 {
    let along = along.clamp(0.0, 1.0);
    along * along * (3.0 - 2.0 * along)
}

/// Returns the quadrants of cells without rules.
fn copy_quadrants(cells: &Block, area: Area) -> Block {
    let made = area.quadrants();
    let mut block = Block {
        level: cells.level + 1,
        area: made,
        symbols: Vec::with_capacity(made.len()),
        heights: Vec::with_capacity(made.len()),
        rest: Vec::new(),
        stride: 0,
        keys: Vec::new(),
        forms: Vec::new(),
        smooth: Vec::new(),
    };
    for y in (made.y..).take(made.rows) {
        for x in (made.x..).take(made.columns) {
            let from = cells.area.index(x.div_euclid(2), y.div_euclid(2));
            block.symbols.push(cells.symbols[from]);
            block.heights.push(cells.heights[from]);
            if let Some(key) = cells.keys.get(from) {
                let ordinal = usize::from(x.rem_euclid(2) == 1) + 2 * usize::from(y.rem_euclid(2) == 1);
                block.keys.push(key.child(ordinal));
            }
        }
    }
    block
}

/// Computes the smooth surface of `made`, the quadrants of `cells`: the biquadratic B-spline surface of the
/// cells, plus the difference of the quadrants' own heights to those of the cells.
///
/// Method: Doo and Sabin, "Behaviour of recursive division surfaces near extraordinary points", 1978, on a grid.
pub(crate) fn smooth(cells: &Block, made: &mut Block) {
    let area = made.area;
    let columns = area.columns;
    if columns == 0 {
        return;
    }
    made.smooth = allocate_zeroed(area.len());
    let above = &cells.smooth;
    let across = cells.area.columns;
    let heights = &made.heights;
    let first = usize::try_from(area.x.div_euclid(2) - cells.area.x).unwrap_or(0);
    let work = |(row, out): (usize, &mut [f64])| {
        let y = area.y + i64::try_from(row).unwrap_or(0);
        let (near, far) = (y.div_euclid(2), y.div_euclid(2) + if y.rem_euclid(2) == 1 { 1 } else { -1 });
        let near = &above[cells.area.index(cells.area.x, near)..][..across];
        let far = &above[cells.area.index(cells.area.x, far)..][..across];
        let mid = &cells.heights[cells.area.index(cells.area.x, y.div_euclid(2))..][..across];
        let own = &heights[row * columns..][..columns];
        // Quadrants come in pairs, of which the first is even.
        let pairs = out.chunks_exact_mut(2).zip(own.chunks_exact(2));
        for (at, (out, own)) in (first..).zip(pairs) {
            for (quadrant, beside) in [at.saturating_sub(1), (at + 1).min(across - 1)].into_iter().enumerate()
            {
                let base = near[at] * 9.0 + near[beside] * 3.0 + far[at] * 3.0 + far[beside];
                out[quadrant] = base / 16.0 + (own[quadrant] - mid[at]);
            }
        }
    };
    let rows = made.smooth.chunks_mut(columns).enumerate();
    if area.len() > 1 << 16 {
        rows.collect::<Vec<_>>().into_par_iter().with_min_len(16).for_each(work);
    } else {
        rows.for_each(work);
    }
}
