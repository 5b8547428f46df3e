//! Modules that one rule produces for a piece of a chain.

use std::sync::Arc;
use std::time::Duration;

use crate::chain::{CLOSE, OPEN, Symbol};

/// Symbols of a successor that is always the same, so that only its parameters are written.
#[derive(Debug, Clone, Default)]
pub struct ReturnShape {
    /// Symbols of modules and brackets.
    pub symbols: Vec<Symbol>,
    /// Number of all parameters.
    pub params: usize,
}

/// Successor of one application.
pub(crate) enum Successor {
    /// Keep the module.
    Keep,
    /// Modules and brackets of the shape with this number.
    Shape(usize),
    /// Modules up to this one, in another order than they were made.
    Ordered(usize),
    /// Modules up to this one.
    UpTo(usize),
    /// Modules that are already in the new chain.
    Written,
}

impl Successor {
    /// Decodes a word of [`Successors::ends`].
    #[inline]
    pub(crate) fn read(word: u32) -> Self {
        if word & Successors::KEEP != 0 {
            Self::Keep
        } else if word & Successors::SHAPE != 0 {
            Self::Shape((word & !Successors::SHAPE) as usize)
        } else if word & Successors::ORDERED != 0 {
            Self::Ordered((word & !Successors::ORDERED) as usize)
        } else {
            Self::UpTo(word as usize)
        }
    }
}

/// Successors of all applications of one rule, in columns.
///
/// An implementation of [`Rules`](crate::Rules) either calls [`push`](Self::push), [`open`](Self::open), [`close`](Self::close) and
/// then [`end`](Self::end) or [`keep`](Self::keep) for each application, or fills the columns itself.
#[derive(Debug, Default)]
pub struct Successors {
    /// Symbols of all produced modules.
    pub symbols: Vec<Symbol>,
    /// Parameters of all produced modules.
    pub params: Vec<f64>,
    /// For each application, the number of modules produced so far, combined with [`KEEP`](Self::KEEP) or
    /// [`ORDERED`](Self::ORDERED) if applicable; or the number of a shape with [`SHAPE`](Self::SHAPE).
    pub ends: Vec<u32>,
    /// For each application with reordered modules, the number of its items, then the items, which are numbers of
    /// modules of the application, [`OPEN_ITEM`](Self::OPEN_ITEM) or [`CLOSE_ITEM`](Self::CLOSE_ITEM).
    pub order: Vec<u32>,
    /// Constant successors, by number.
    pub shapes: Arc<Vec<ReturnShape>>,
    /// Maximum number of random numbers that the rule has used for one module.
    pub draws: usize,
    pub(crate) members: Vec<u32>,
    pub(crate) next: usize,
    pub(crate) symbol_at: usize,
    pub(crate) param_at: usize,
    order_at: usize,
    pub(crate) made: usize,
    pub(crate) time: Duration,
}

impl Successors {
    /// Flag of an application that keeps its module.
    pub const KEEP: u32 = 0x8000_0000;
    /// Flag of the number of a shape.
    pub const SHAPE: u32 = 0x4000_0000;
    /// Flag of an application whose modules are in another order than they were made.
    pub const ORDERED: u32 = 0x2000_0000;
    /// Opening bracket among the items of [`order`](Self::order).
    pub const OPEN_ITEM: u32 = 0xFFFF_FFFE;
    /// Closing bracket among the items of [`order`](Self::order).
    pub const CLOSE_ITEM: u32 = 0xFFFF_FFFF;

    /// Removes all successors but keeps the memory.
    pub fn clear(&mut self) {
        self.symbols.clear();
        self.params.clear();
        self.ends.clear();
        self.order.clear();
        self.rewind();
    }

    /// Adds a module to the successor of the current application. The length of `params` must be the arity of the
    /// module.
    #[inline]
    pub fn push(&mut self, symbol: Symbol, params: &[f64]) {
        self.symbols.push(symbol);
        self.params.extend_from_slice(params);
    }

    /// Opens a branch.
    #[inline]
    pub fn open(&mut self) {
        self.symbols.push(OPEN);
    }

    /// Closes the branch that was opened last.
    #[inline]
    pub fn close(&mut self) {
        self.symbols.push(CLOSE);
    }

    /// Ends the successor of an application: the modules since the previous application replace its module.
    #[inline]
    pub fn end(&mut self) {
        self.ends.push(word(self.symbols.len()));
    }

    /// Ends an application that keeps its module.
    #[inline]
    pub fn keep(&mut self) {
        self.ends.push(word(self.symbols.len()) | Self::KEEP);
    }

    /// Restarts reading at the first application.
    pub(crate) fn rewind(&mut self) {
        (self.next, self.symbol_at, self.param_at, self.order_at, self.made) = (0, 0, 0, 0, 0);
    }

    /// Reads the successor of the next application: appends its symbols to `symbols` and its parameters to `params`. Returns
    /// false if the application keeps its module.
    pub(crate) fn read_next(
        &mut self,
        arities: &[u8],
        arranged: &mut ModuleOrder,
        symbols: &mut Vec<Symbol>,
        params: &mut Vec<f64>,
    ) -> bool {
        let made = Successor::read(self.ends[self.next]);
        self.next += 1;
        match made {
            Successor::Keep | Successor::Written => return false,
            Successor::Shape(number) => {
                let shape = &self.shapes[number];
                symbols.extend_from_slice(&shape.symbols);
                params.extend_from_slice(&self.params[self.param_at..][..shape.params]);
                self.param_at += shape.params;
            }
            Successor::Ordered(end) => {
                self.arrange(end, arities, arranged, params);
                symbols.extend_from_slice(&arranged.symbols);
            }
            Successor::UpTo(end) => {
                let made = &self.symbols[self.symbol_at..end];
                let arity = |symbol: &Symbol| usize::from(arities[usize::from(*symbol)]);
                let count: usize = made.iter().map(arity).sum();
                symbols.extend_from_slice(made);
                params.extend_from_slice(&self.params[self.param_at..][..count]);
                self.symbol_at = end;
                self.param_at += count;
            }
        }
        true
    }

    /// Reads the reordered successor of the application whose modules end at `end`: writes its symbols to `to`, and
    /// appends its parameters to `params`.
    pub(crate) fn arrange(
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
                Self::OPEN_ITEM => OPEN,
                Self::CLOSE_ITEM => CLOSE,
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

/// Converts a count to a word. The memory limit keeps batches far below 2^29 modules.
#[allow(clippy::cast_possible_truncation, reason = "below the limit on modules")]
fn word(count: usize) -> u32 {
    debug_assert!(count < Successors::ORDERED as usize);
    count as u32
}

/// Successor whose modules are in another order than they were made.
#[derive(Debug, Default)]
pub(crate) struct ModuleOrder {
    pub symbols: Vec<Symbol>,
    /// Index of the first parameter of each produced module.
    starts: Vec<usize>,
}
