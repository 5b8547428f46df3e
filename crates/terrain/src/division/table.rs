//! Rule tables: successors of each symbol without a script.

use rayon::prelude::*;

use super::block::{Area, Block};
use crate::division::block::CellSymbol;
use burgeon_base::ModuleKey;
use burgeon_base::memory::allocate_zeroed;
use burgeon_base::random::Stream;

/// A number, or the range of a random number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberRange {
    /// Minimum.
    pub low: f64,
    /// Maximum; equal to the minimum for a fixed number.
    pub high: f64,
}

impl NumberRange {
    /// Creates a fixed number.
    pub fn exactly(number: f64) -> Self {
        Self { low: number, high: number }
    }

    fn is_drawn(self) -> bool {
        self.low < self.high
    }

    #[inline]
    fn take(self, stream: &mut Stream) -> f64 {
        if self.is_drawn() { self.low + (self.high - self.low) * stream.uniform() } else { self.low }
    }
}

/// The four quadrants that replace a cell: north-west, north-east, south-west, south-east.
#[derive(Debug, Clone, PartialEq)]
pub struct Quadrants {
    /// Weight of the rule among the rules of its symbol.
    pub weight: f64,
    /// Symbol of each quadrant.
    pub symbols: [CellSymbol; 4],
    /// Addition to the cell's height, as a multiple of its decay.
    pub change: [NumberRange; 4],
    /// Factor of the cell's decay.
    pub decay: [NumberRange; 4],
}

/// Rules of all symbols, by index.
///
/// ```
/// use burgeon_terrain::{DivisionRules, LevelRules, NumberRange, Quadrants, RuleTable, Tables, World};
/// use glam::DVec2;
/// use std::sync::Arc;
///
/// // The north-west quadrant of each cell is higher, and each change is half the previous one.
/// let change = [1.0, 0.0, 0.0, 0.0].map(NumberRange::exactly);
/// let quadrants = Quadrants { weight: 1.0, symbols: [0; 4], change, decay: [NumberRange::exactly(0.5); 4] };
/// let table = RuleTable { names: vec!["A".into()], rules: vec![vec![quadrants]] };
/// assert!(!table.is_random());
/// let (rules, names) = (DivisionRules::Table(Arc::new(table)), Arc::new(vec!["A".to_owned()]));
/// let layers = vec![LevelRules { from: 0, rules, start: 0, height: 0.0, rest: vec![8.0], names }];
/// let (corner, remap) = (DVec2::ZERO, vec![]);
/// let world = World { corner, size: 64.0, layers, smooth: false, key: None, remap, measured: None };
/// let root = world.root();
/// let cells = world.descend(&root, 2, root.area.quadrants().quadrants(), true, &Tables)?;
/// assert_eq!(cells.heights[0], 8.0 + 4.0);
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RuleTable {
    /// Names of the symbols.
    pub names: Vec<String>,
    /// Rules of each symbol; one of them is chosen at random.
    pub rules: Vec<Vec<Quadrants>>,
}

impl RuleTable {
    /// Returns true if the table uses random numbers.
    pub fn is_random(&self) -> bool {
        let drawn = |rule: &Quadrants| rule.change.iter().chain(&rule.decay).any(|draw| draw.is_drawn());
        self.rules.iter().any(|rules| rules.len() > 1 || rules.iter().any(drawn))
    }

    /// Returns the maximum absolute factor of a decay.
    pub fn greatest_decay(&self) -> f64 {
        let rules = self.rules.iter().flatten();
        rules.flat_map(|rule| rule.decay).map(|draw| draw.low.abs().max(draw.high.abs())).fold(0.0, f64::max)
    }

    /// Returns the quadrants of the cells of `area`, without decays and keys if they are the `last`.
    pub fn divide(&self, cells: &Block, area: Area, last: bool) -> Block {
        let made = area.quadrants();
        let count = made.len();
        let random = !cells.keys.is_empty();
        let mut block = Block {
            level: cells.level + 1,
            area: made,
            symbols: allocate_zeroed(count),
            heights: allocate_zeroed(count),
            rest: allocate_zeroed(if last { 0 } else { count }),
            stride: 1,
            keys: allocate_zeroed(if last || !random { 0 } else { count }),
            forms: Vec::new(),
            smooth: Vec::new(),
        };
        let two = made.columns * 2;
        if two == 0 {
            return block;
        }
        // Empty arrays have no chunks, which must not end the iteration over the others.
        let rows = (area.y..).zip(block.symbols.chunks_mut(two).zip(block.heights.chunks_mut(two)));
        let mut decays = block.rest.chunks_mut(two);
        let mut keys = block.keys.chunks_mut(two);
        let rows: Vec<_> = rows
            .map(|(y, (symbols, heights))| {
                let into = QuadrantRows {
                    symbols,
                    heights,
                    decays: decays.next(),
                    keys: keys.next(),
                    across: made.columns,
                };
                (cells.area.index(area.x, y), into)
            })
            .collect();
        let work = |(first, into): (usize, QuadrantRows<'_>)| self.row(cells, first, area.columns, into);
        if count > 1 << 14 {
            rows.into_par_iter().with_min_len(16).for_each(work);
        } else {
            rows.into_iter().for_each(work);
        }
        block
    }

    fn row(&self, cells: &Block, first: usize, columns: usize, mut into: QuadrantRows<'_>) {
        for column in 0..columns {
            let from = first + column;
            let (height, decay) = (cells.heights[from], cells.rest[from]);
            let rules = &self.rules[usize::from(cells.symbols[from])];
            let places = [0, 1, into.across, into.across + 1].map(|place| place + 2 * column);
            let Some(key) = cells.keys.get(from) else {
                let rule = &rules[0];
                for (ordinal, place) in places.into_iter().enumerate() {
                    into.symbols[place] = rule.symbols[ordinal];
                    into.heights[place] = height + rule.change[ordinal].low * decay;
                    if let Some(decays) = &mut into.decays {
                        decays[place] = decay * rule.decay[ordinal].low;
                    }
                }
                continue;
            };
            let mut stream = key.stream();
            let rule = choose(rules, &mut stream);
            for (ordinal, place) in places.into_iter().enumerate() {
                into.symbols[place] = rule.symbols[ordinal];
                into.heights[place] = height + rule.change[ordinal].take(&mut stream) * decay;
                let factor = rule.decay[ordinal].take(&mut stream);
                if let Some(decays) = &mut into.decays {
                    decays[place] = decay * factor;
                }
                if let Some(keys) = &mut into.keys {
                    keys[place] = key.child(ordinal);
                }
            }
        }
    }
}

/// Two rows of quadrants.
struct QuadrantRows<'a> {
    symbols: &'a mut [CellSymbol],
    heights: &'a mut [f64],
    decays: Option<&'a mut [f64]>,
    keys: Option<&'a mut [ModuleKey]>,
    /// Length of one row.
    across: usize,
}

fn choose<'a>(rules: &'a [Quadrants], stream: &mut Stream) -> &'a Quadrants {
    if let [only] = rules {
        return only;
    }
    let whole: f64 = rules.iter().map(|rule| rule.weight).sum();
    let mut left = stream.uniform() * whole;
    let found = rules.iter().find(|rule| {
        left -= rule.weight;
        left < 0.0
    });
    found.unwrap_or(&rules[rules.len() - 1])
}
