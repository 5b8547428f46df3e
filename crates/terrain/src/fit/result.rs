//! Result of a fit: a rule table, as a world and as a Luau module.

use std::fmt::Write as _;
use std::sync::Arc;

use glam::DVec2;

use super::code::Code;
use super::targets::Target;
use crate::division::block::CellSymbol;
use crate::{Area, DivisionRules, LevelRules, NumberRange, Quadrants, RuleTable, Tables, World};
use burgeon_base::error::Result;

/// A rule table whose map resembles a target.
#[derive(Debug, Clone, PartialEq)]
pub struct FitResult {
    code: Code,
    levels: u32,
    height: f64,
    decay: f64,
    error: f64,
    /// Number of tables that were tried.
    pub tried: usize,
}

impl FitResult {
    /// Creates a result from `code`, which makes a map from 0 to 1, for the height range of `target`.
    pub(super) fn new(code: Code, target: &Target) -> Self {
        let code = code.tidy().rounded();
        let (low, high) = target.range();
        let (height, decay) = (low + code.height * (high - low), high - low);
        let levels = target.across().trailing_zeros();
        let mut fitted = Self { code, levels, height, decay, error: f64::INFINITY, tried: 0 };
        // A table without systems never fails.
        fitted.error = fitted.map().map_or(f64::INFINITY, |heights| target.error(&heights));
        fitted
    }

    /// Returns the error relative to the target, as defined by [`Target::error`].
    pub fn error(&self) -> f64 {
        self.error
    }

    /// Returns the number of symbols.
    pub fn symbols(&self) -> usize {
        self.code.rules.len()
    }

    /// Returns the heights (m) of the map, row by row from the north-west, in the size of the target.
    pub fn map(&self) -> Result<Vec<f64>> {
        let world = World {
            corner: DVec2::ZERO,
            size: 1.0,
            layers: vec![LevelRules {
                from: 0,
                rules: DivisionRules::Table(Arc::new(self.table())),
                start: 0,
                height: self.height,
                rest: vec![self.decay],
                names: Arc::default(),
            }],
            smooth: false,
            key: None,
            remap: Vec::new(),
            measured: None,
        };
        let across = 1 << self.levels;
        let area = Area { x: 0, y: 0, columns: across, rows: across };
        Ok(world.cells(self.levels, area, &Tables)?.heights)
    }

    /// Returns the rule table.
    fn table(&self) -> RuleTable {
        let rule = |rule: &super::code::SymbolRule| {
            vec![Quadrants {
                weight: 1.0,
                symbols: rule.symbols.map(|symbol| CellSymbol::try_from(symbol).unwrap_or(0)),
                change: rule.change.map(NumberRange::exactly),
                decay: rule.factor.map(NumberRange::exactly),
            }]
        };
        RuleTable {
            names: (0..self.symbols()).map(name).collect(),
            rules: self.code.rules.iter().map(rule).collect(),
        }
    }

    /// Returns a Luau module with the table, its start symbol, and the height (m) and the decay (m) of the
    /// root cell; `told` are the lines of its leading comment.
    pub fn module(&self, told: &[String]) -> String {
        let mut text = String::from("--!strict\n");
        for line in told {
            text += "-- ";
            // A line break would end the comment.
            text.extend(line.chars().map(|letter| if letter.is_control() { ' ' } else { letter }));
            text += "\n";
        }
        let numbers = |numbers: [f64; 4]| numbers.map(|number| format!("{number:?}")).join(", ");
        // Writing to a string cannot fail.
        let _ = writeln!(
            text,
            "return {{\n  start = \"A\",\n  levels = {},\n  height = {:?},\n  decay = {:?},\n  rules = {{",
            self.levels, self.height, self.decay
        );
        for (symbol, rule) in self.code.rules.iter().enumerate() {
            let _ = writeln!(text, "    {} = {{", name(symbol));
            for child in rule.symbols {
                let _ = writeln!(text, "      \"{}\",", name(child));
            }
            let _ = writeln!(text, "      change = {{ {} }},", numbers(rule.change));
            let _ = writeln!(text, "      decay = {{ {} }},\n    }},", numbers(rule.factor));
        }
        text += "  },\n}\n";
        text
    }
}

/// Returns the name of a symbol by its index: A to Z, then A1 to Z1, and so on.
fn name(symbol: usize) -> String {
    let letter = char::from(b"ABCDEFGHIJKLMNOPQRSTUVWXYZ"[symbol % 26]);
    match symbol / 26 {
        0 => letter.to_string(),
        turn => format!("{letter}{turn}"),
    }
}
