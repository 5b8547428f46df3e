//! What one rule made of the modules of a piece, as Lua wrote it.

use std::time::Duration;

use burgeon_kit::rules::{CLOSE, OPEN, Symbol};

/// Brackets in the order that Lua writes.
const OPENS: u32 = 0xFFFF_FFFE;
const CLOSES: u32 = 0xFFFF_FFFF;

/// What became of one module.
pub(super) enum Product {
    /// It stays.
    Nothing,
    /// The modules and brackets of the shape with this number.
    Shape(usize),
    /// The modules up to this one, in another order than they were made.
    Ordered(usize),
    /// The modules up to this one.
    UpTo(usize),
}

impl Product {
    /// Reads what Lua wrote: a number of modules or of a shape, and a mark that tells which.
    #[inline]
    pub(super) fn read(word: u32) -> Self {
        const STAY: u32 = 0x8000_0000;
        const SHAPE: u32 = 0x4000_0000;
        const ORDERED: u32 = 0x2000_0000;
        if word & STAY != 0 {
            Self::Nothing
        } else if word & SHAPE != 0 {
            Self::Shape((word & !SHAPE) as usize)
        } else if word & ORDERED != 0 {
            Self::Ordered((word & !ORDERED) as usize)
        } else {
            Self::UpTo(word as usize)
        }
    }
}

/// The modules that one rule is applied to, and what it made of them.
#[derive(Default)]
pub(super) struct RuleGroup {
    pub members: Vec<u32>,
    pub symbols: Vec<Symbol>,
    pub params: Vec<f64>,
    /// For each application, what [`Product::read`] reads.
    pub ends: Vec<u32>,
    /// For each application whose modules are in another order: the number of its items, and the items.
    pub order: Vec<u32>,
    pub next: usize,
    pub symbol_at: usize,
    pub param_at: usize,
    order_at: usize,
    pub made: usize,
    /// The most random numbers that the rule has drawn for one module.
    pub draws: usize,
    pub time: Duration,
}

impl RuleGroup {
    pub(super) fn rewind(&mut self) {
        (self.next, self.symbol_at, self.param_at, self.order_at, self.made) = (0, 0, 0, 0, 0);
    }

    /// The successor of the application whose modules end at `end`: its symbols, and its parameters behind `params`.
    pub(super) fn arrange(
        &mut self,
        end: usize,
        arities: &[u8],
        to: &mut ModuleOrder,
        params: &mut Vec<f64>,
    ) {
        let arity = |symbol: Symbol| usize::from(arities[usize::from(symbol)]);
        let made = &self.symbols[self.symbol_at..end];
        self.symbol_at = end;
        to.starts.clear();
        for symbol in made {
            to.starts.push(self.param_at);
            self.param_at += arity(*symbol);
        }
        let count = self.order[self.order_at] as usize;
        let items = &self.order[self.order_at + 1..][..count];
        self.order_at += 1 + count;
        to.symbols.clear();
        for item in items {
            let symbol = match *item {
                OPENS => OPEN,
                CLOSES => CLOSE,
                place => {
                    let symbol = made[place as usize];
                    let start = to.starts[place as usize];
                    params.extend_from_slice(&self.params[start..start + arity(symbol)]);
                    symbol
                }
            };
            to.symbols.push(symbol);
        }
    }
}

/// A successor whose modules are in another order than they were made.
#[derive(Default)]
pub(super) struct ModuleOrder {
    pub symbols: Vec<Symbol>,
    /// Where the parameters of each module that was made begin.
    starts: Vec<usize>,
}
