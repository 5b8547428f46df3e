//! Division of the cells of a terrain by the rules of a system: a level of cells is a chain, and a derivation
//! step replaces each cell by its four quadrants.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use burgeon_base::error::{Error, Result};
use burgeon_base::memory::allocate_zeroed;
use burgeon_kit::{RewriteOutcome, Rewriter, RuleSet};
use burgeon_rewriting::{Chain, ColumnValue, END, FIRST_SYMBOL, Mark, ModuleKey, NO_RULE, module_brief};
use burgeon_terrain::{Area, Begin, Block, Divide};

/// Name of the parameter for the cell's height.
const HEIGHT: &str = "height";
/// Name of the parameter for an addition to the cell's height without smoothing.
const FORM: &str = "form";

/// Number of cells that are divided at a time.
const STRIP: usize = 1 << 17;

/// Division of cells by the rules of a script's systems.
pub(crate) struct Cells<'a> {
    rewriter: &'a dyn Rewriter,
    systems: RefCell<FxHashMap<usize, Arc<CellSystem>>>,
}

/// A system whose rules divide cells.
struct CellSystem {
    index: usize,
    rules: Arc<RuleSet>,
    begin: Begin,
    /// Index of the height parameter of each symbol.
    heights: Vec<Option<usize>>,
    /// Index of the form parameter of each symbol, if it has one.
    forms: Vec<Option<usize>>,
}

impl<'a> Cells<'a> {
    /// Creates a division by the rules that `rewriter` applies.
    pub(crate) fn new(rewriter: &'a dyn Rewriter) -> Self {
        Self { rewriter, systems: RefCell::default() }
    }

    /// Returns system `index`, and prepares it the first time. Fails if its rules cannot divide cells.
    fn system(&self, index: usize) -> Result<Arc<CellSystem>> {
        let mut systems = self.systems.borrow_mut();
        let system = match systems.entry(index) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(unknown) => unknown.insert(Arc::new(CellSystem::new(self.rewriter, index)?)),
        };
        Ok(Arc::clone(system))
    }
}

impl Divide for Cells<'_> {
    fn begin(&self, system: usize) -> Result<Begin> {
        self.system(system).map(|system| system.begin.clone())
    }

    fn divide(&self, system: usize, cells: &Block, area: Area, last: bool) -> Result<Block> {
        self.system(system)?.divide(self.rewriter, cells, area, last)
    }
}

impl CellSystem {
    fn new(rewriter: &dyn Rewriter, index: usize) -> Result<Self> {
        let rules = rewriter.rules(index)?;
        let named = |error: Error| error.rather_at(rules.place.clone());
        if rules.has_object {
            return Err(named(
                Error::script("a system that divides the cells of a terrain cannot have an object")
                    .help("remove object: only the modules of the cells are used"),
            ));
        }
        let grammar = &rules.grammar;
        if grammar.has_contexts() {
            return Err(named(
                Error::script("rules for the cells of a terrain cannot have contexts")
                    .help("write rules for single modules, without < and >"),
            ));
        }
        if let Some(rule) = grammar.rules().iter().find(|rule| rule.pattern.has_run()) {
            let error =
                Error::script("a rule for the cells of a terrain rewrites one cell, not several modules")
                    .help("write a rule for one module, such as \"Cell(height)\"");
            return Err(error.at_place(rule.place.as_ref()).rule(&rule.pattern.text));
        }
        let axiom = rewriter.axiom(index)?;
        let signatures = grammar.symbols();
        let find = |parameter: &str| -> Vec<Option<usize>> {
            let of =
                |symbol| signatures.signature(symbol).parameters.iter().position(|name| name == parameter);
            let declared = (FIRST_SYMBOL..).take(signatures.names().count());
            (0..FIRST_SYMBOL).map(|_| None).chain(declared.map(of)).collect()
        };
        let (heights, forms) = (find(HEIGHT), find(FORM));
        let begin = match axiom.symbols.as_slice() {
            [symbol, END] if *symbol >= FIRST_SYMBOL => {
                let height = heights[usize::from(*symbol)]
                    .ok_or_else(|| no_height(&signatures.signature(*symbol).name))?;
                let mut rest = axiom.params;
                let height = rest.remove(height);
                let stride =
                    grammar.arities().iter().max().map_or(0, |most| usize::from(*most).saturating_sub(1));
                rest.resize(stride, ColumnValue::Nil.pack());
                let reserved = (0..FIRST_SYMBOL).map(|_| String::new());
                let names = reserved.chain(signatures.names().map(str::to_owned)).collect();
                Begin { symbol: *symbol, height, rest, names }
            }
            _ => {
                return Err(named(
                    Error::script("a terrain must begin with one cell")
                        .help("use one module without branches as axiom: cells:axiom(Hill(0, 100))"),
                ));
            }
        };
        Ok(Self { index, rules, begin, heights, forms })
    }

    fn divide(&self, rewriter: &dyn Rewriter, cells: &Block, area: Area, last: bool) -> Result<Block> {
        let made = area.quadrants();
        let (count, stride) = (made.len(), self.begin.rest.len());
        let random = !cells.keys.is_empty();
        let mut block = Block {
            level: cells.level + 1,
            area: made,
            symbols: allocate_zeroed(count),
            heights: allocate_zeroed(count),
            rest: allocate_zeroed(if last { 0 } else { count * stride }),
            stride,
            keys: allocate_zeroed(if last || !random { 0 } else { count }),
            forms: allocate_zeroed(if self.forms.iter().any(Option::is_some) { count } else { 0 }),
            smooth: Vec::new(),
        };
        let rows = (STRIP / area.columns.max(1)).max(1);
        for first in (0..area.rows).step_by(rows) {
            rewriter.check()?;
            let rows = rows.min(area.rows - first);
            #[allow(clippy::cast_possible_wrap, reason = "rows are below 2^31")]
            let strip = Area { y: area.y + first as i64, rows, ..area };
            self.strip(rewriter, cells, strip, &mut block)?;
        }
        Ok(block)
    }

    /// Divides the cells of some rows, and stores the quadrants in `block`.
    fn strip(&self, rewriter: &dyn Rewriter, cells: &Block, area: Area, block: &mut Block) -> Result<()> {
        let grammar = &self.rules.grammar;
        let arities = grammar.arities();
        let random = grammar.draws_random();
        let mut chain = Chain::default();
        chain.symbols.reserve(area.len() + 1);
        for (x, y) in area.cells() {
            let from = cells.area.index(x, y);
            let symbol = cells.symbols[from];
            chain.symbols.push(symbol);
            let rest = &cells.rest[from * cells.stride..][..usize::from(arities[usize::from(symbol)]) - 1];
            let height = self.heights[usize::from(symbol)].unwrap_or(0);
            chain.params.extend_from_slice(&rest[..height]);
            chain.params.push(cells.heights[from]);
            chain.params.extend_from_slice(&rest[height..]);
            if random {
                chain.keys.push(cells.keys.get(from).copied().unwrap_or_default());
            }
        }
        chain.symbols.push(END);
        if random {
            chain.keys.push(ModuleKey::default());
        }
        chain.mark(self.rules.batch, arities);
        let step = cells.level as usize + 1;
        let RewriteOutcome { chain, applied } = rewriter.rewrite(self.index, chain, step)?;
        let mut here = Mark::default();
        for ((x, y), (rule, count)) in area.cells().zip(&applied) {
            let from = cells.area.index(x, y);
            let whole =
                *rule == NO_RULE || (*count == 1 && chain.symbols[here.module] == cells.symbols[from]);
            if !whole && *count != 4 {
                return Err(self.not_four(cells, from, (*rule, *count), step));
            }
            let key = cells.keys.get(from).copied();
            for ordinal in 0..4 {
                let symbol = chain.symbols[here.module];
                let arity = usize::from(arities[usize::from(symbol)]);
                let Some(at) = self.heights[usize::from(symbol)].filter(|_| symbol > END) else {
                    return Err(match symbol {
                        ..=END => self.not_four(cells, from, (*rule, 1), step),
                        _ => self.blame(no_height(&grammar.symbols().signature(symbol).name), *rule),
                    });
                };
                let params = &chain.params[here.param..here.param + arity];
                let height = params[at];
                let form = self.forms[usize::from(symbol)].map_or(0.0, |form| params[form]);
                if !(height + form).is_finite() {
                    let module = module_brief(grammar.symbols(), &self.rules.values, symbol, params);
                    let error = Error::script(format!("the height of {module} is not finite"))
                        .help("set a height in metres for each quadrant");
                    return Err(self.blame(error, *rule));
                }
                let (column, row) = (x * 2 + i64::from(ordinal & 1 == 1), y * 2 + i64::from(ordinal > 1));
                let to = block.area.index(column, row);
                block.symbols[to] = symbol;
                block.heights[to] = height;
                if let Some(into) = block.forms.get_mut(to) {
                    *into = form;
                }
                if !block.rest.is_empty() {
                    let into = &mut block.rest[to * block.stride..][..arity - 1];
                    into[..at].copy_from_slice(&params[..at]);
                    into[at..].copy_from_slice(&params[at + 1..]);
                }
                if let (Some(into), Some(key)) = (block.keys.get_mut(to), key) {
                    *into = key.child(ordinal);
                }
                if !whole {
                    here.module += 1;
                    here.param += arity;
                }
            }
            if whole {
                here.param += usize::from(arities[usize::from(chain.symbols[here.module])]);
                here.module += 1;
            }
        }
        rewriter.reuse(self.index, chain);
        Ok(())
    }

    /// Creates the error for a cell that was not replaced by four cells.
    fn not_four(&self, cells: &Block, from: usize, (rule, count): (u16, u32), step: usize) -> Error {
        let grammar = &self.rules.grammar;
        let symbol = cells.symbols[from];
        let arity = usize::from(grammar.arities()[usize::from(symbol)]);
        let mut params = cells.rest[from * cells.stride..][..arity - 1].to_vec();
        params.insert(self.heights[usize::from(symbol)].unwrap_or(0), cells.heights[from]);
        let module = module_brief(grammar.symbols(), &self.rules.values, symbol, &params);
        let count = match count {
            0 => Cow::Borrowed("nothing"),
            1 => "one module or a branch".into(),
            count => format!("{count} modules").into(),
        };
        let error = Error::script(format!("a cell must be replaced by four quadrants, not by {count}"))
            .help("return four modules: north-west, north-east, south-west and south-east; or no value to keep the cell unchanged");
        self.blame(error, rule).module(module, step)
    }

    fn blame(&self, error: Error, rule: u16) -> Error {
        match self.rules.grammar.rules().get(usize::from(rule)) {
            Some(rule) => error.at_place(rule.place.as_ref()).rule(&rule.pattern.text),
            None => error,
        }
    }
}

fn no_height(name: &str) -> Error {
    Error::script(format!("module {name} cannot be a terrain cell: missing parameter `{HEIGHT}`"))
        .help(format!("add it: module(\"{name}\", \"{HEIGHT}\", ...)"))
}
