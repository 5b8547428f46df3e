//! Prelude: the Lua side of the hot path, and globals of scripts.

mod words;

use std::cell::RefCell;

use mlua::chunk::ChunkMode;
use mlua::{Buffer, Function, Lua, Table};

use self::words::WORDS;
use super::native::as_bytecode;
use crate::machine::system::UNREAD;
use crate::machine::types::{POINTS, READ_MODULE};
use burgeon_rewriting::{CLOSE, DependentModules, END, NO_RULE, OPEN, Successors};

/// Recorded calls that stand for the brackets of a branch that an interpretation returned, instead of methods.
pub(crate) const OPEN_CALL: u16 = u16::MAX - 1;
pub(crate) const CLOSE_CALL: u16 = u16::MAX - 2;

/// Bytecode of the prelude.
static COMPILED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/prelude.bytecode"));

const _: () = {
    let numbers = [
        Successors::KEEP,
        Successors::SHAPE,
        NO_RULE as u32,
        DependentModules::SKIPPED,
        OPEN as u32,
        CLOSE as u32,
        END as u32,
        Successors::ORDERED,
        Successors::OPEN_ITEM,
        Successors::CLOSE_ITEM,
        OPEN_CALL as u32,
        CLOSE_CALL as u32,
    ];
    let mut index = 0;
    while index < numbers.len() {
        assert!(numbers[index] == WORDS[index].1, "prelude/words.rs has the numbers of Rust, in this order");
        index += 1;
    }
};

/// Functions of the prelude that Rust calls.
pub(crate) struct Prelude {
    /// `(symbol, signature)`: returns the constructor of a module.
    pub constructor: Function,
    /// `(query, fragment)`: sets the constructors of the placeholder modules.
    pub pending: Function,
    /// `(rule, arity, places, reads)`: returns a function that applies the rule to a batch; `places` has the
    /// argument indices by name, and `reads` the numbers of the parameters that the rule reads, if they are known.
    pub driver: Function,
    /// `(guard, arity, places, reads)`: returns a function that evaluates the guard for a batch.
    pub guard_driver: Function,
    /// `(rule)`: returns the formulas of a function that only calculates with numbers, separated by semicolons, the numbers in
    /// them, see [`RuleFormula::read`](burgeon_rewriting::RuleFormula::read), and the number of the shape that it returns; nil for other functions.
    pub formulas: Function,
    /// `(propensity, arity, places)`: returns the function that evaluates the propensity of a rule for a batch.
    pub propensity_driver: Function,
    /// `(rule, arity)`: returns what a rule divides, how, and the modules of the parts; nil unless that is known before it is
    /// applied.
    pub division: Function,
    /// `(rule, guard, arity, places)`: returns a function for [`dependents`](Self::dependents) that applies the rule to arguments
    /// at an offset, if its guard holds.
    pub applier: Function,
    /// `(appliers, symbols, offsets, sizes, is_backward, ignored)`: returns a function that chooses and applies rules, by number,
    /// to modules that depend on one another, with a special loop if all modules try one rule. `symbols` has the symbols that match the context of each rule in the new chain,
    /// `offsets` and `sizes` the place of its arguments (bytes).
    pub dependents: Function,
    /// `(rules, standards, max_depth)`: removes the interpretation rules of the last system, and sets the rule of each
    /// symbol of each region, the method of the standard library of each symbol, and the maximum depth of interpretations that
    /// return modules. With regions, `rules.bases` has the index of the first symbol of each rule's region.
    pub interpretations: Function,
    /// `(id, rule, arity, places)`: sets an interpretation rule.
    pub interpreter: Function,
    /// `(id, symbol, place, arity, candidates, most)`: sets the candidates of a symbol, whose contexts have at most `most`
    /// parameters; `place` is the index of the symbol in its region.
    pub candidates: Function,
    /// `(method, name, arity, kind)`: returns a method that records its calls.
    pub recorder: Function,
    /// `(method, name, changes, kind)`: returns a method that runs immediately.
    pub direct: Function,
    /// `(count)`: interprets a batch; returns the numbers of calls and arguments recorded last, and the number of times
    /// that rules have run in addition to those of the entries, by rule.
    pub interpret: Function,
    /// `(hook, number)`: runs a hook in step `number`.
    pub run_hook: Function,
    /// `(number, values)`: sets the values of a table of variables by name; nil removes them.
    pub load_variables: Function,
    /// `(value)`: returns the number of a table of variables, or nil for another value.
    pub variables_of: Function,
    /// `(entry, call)`: runs an interpretation rule again, and raises an error at one of its recorded calls.
    pub relive: Function,
    /// Marks the modules that are declared until it is called again as those of the standard library.
    pub begin_standard: Function,
    /// Ends a batch that failed.
    pub finish: Function,
    /// Returns the current application, the number of its modules and of its calls, and the interpretation rule that
    /// runs if it is not that of the entry, or -1.
    pub at: Function,
    /// `(object, kind, type)`: sets `this`, the name of its type, and the type itself if the script declared
    /// it.
    pub set_this: Function,
    /// `(object, name, value)`: refuses the assignment of a field of `this`.
    pub refuse_field: Function,
    /// `(type)`: adds a type that the script declares.
    pub script_type: Function,
    /// `(kind, methods, type, reads, changes)`: adds functions of the script to a type.
    pub extension: Function,
    /// `(type)`: returns the functions that run at the start and end of a chain, and at the start and end of
    /// a branch.
    pub hooks: Function,
    /// Drops cached parameters.
    pub forget_values: Function,
    /// Globals of scripts.
    pub globals: Table,
    /// Returns the current phase: 0 top level, 1 rule, 2 guard, 3 interpretation, 4 hook.
    pub phase: Function,
    /// `(value)`: returns the list of modules for which a value stands, or nil.
    pub elements: Function,
    /// `(value)`: returns true for a module made outside of rules.
    pub is_module: Function,
    points: Function,
    unread: Function,
    read_module: Function,
    input: GrowingColumn,
    counts: GrowingColumn,
    links: GrowingColumn,
    randoms: Function,
    entries: GrowingColumn,
    outputs: Function,
    recorded: Function,
}

/// Column of the prelude that is only replaced by a longer one.
struct GrowingColumn {
    /// `(size)`: returns a buffer of at least `size` bytes.
    grow: Function,
    /// Last buffer, and its number of bytes.
    last: RefCell<Option<(Buffer, usize)>>,
}

impl GrowingColumn {
    fn new(grow: Function) -> Self {
        Self { grow, last: RefCell::default() }
    }

    /// Returns the column, at least `size` bytes long.
    fn of_size(&self, size: usize) -> mlua::Result<Buffer> {
        let mut last = self.last.borrow_mut();
        let (buffer, _) = match &mut *last {
            Some(known) if known.1 >= size => known,
            other => {
                let buffer: Buffer = self.grow.call(size)?;
                let length = buffer.len();
                other.insert((buffer, length))
            }
        };
        Ok(buffer.clone())
    }
}

impl Prelude {
    /// Loads the prelude as bytecode. The function takes the Rust functions for the prelude, and returns the
    /// argument of [`Prelude::new`].
    pub(super) fn chunk(lua: &Lua) -> mlua::Result<Function> {
        let chunk = lua.load(COMPILED).set_name("=burgeon").set_mode(ChunkMode::Binary);
        as_bytecode(lua, || chunk.into_function())
    }

    pub(super) fn new(table: &Table) -> mlua::Result<Self> {
        Ok(Self {
            constructor: table.get("constructor")?,
            pending: table.get("pending")?,
            driver: table.get("driver")?,
            guard_driver: table.get("guard_driver")?,
            formulas: table.get("formulas")?,
            propensity_driver: table.get("propensity_driver")?,
            division: table.get("division")?,
            applier: table.get("applier")?,
            dependents: table.get("dependents")?,
            interpretations: table.get("interpretations")?,
            interpreter: table.get("interpreter")?,
            candidates: table.get("candidates")?,
            recorder: table.get("recorder")?,
            direct: table.get("direct")?,
            interpret: table.get("interpret")?,
            run_hook: table.get("run_hook")?,
            load_variables: table.get("load_variables")?,
            variables_of: table.get("variables_of")?,
            relive: table.get("relive")?,
            begin_standard: table.get("begin_standard")?,
            finish: table.get("finish")?,
            at: table.get("current")?,
            set_this: table.get("set_this")?,
            refuse_field: table.get("refuse_field")?,
            script_type: table.get("script_type")?,
            extension: table.get("extension")?,
            hooks: table.get("hooks")?,
            forget_values: table.get("forget_values")?,
            globals: table.get("globals")?,
            phase: table.get("phase")?,
            elements: table.get("elements")?,
            is_module: table.get("is_module")?,
            points: table.get("points")?,
            unread: table.get("unread")?,
            read_module: table.get("read_module")?,
            input: GrowingColumn::new(table.get("input")?),
            counts: GrowingColumn::new(table.get("counts")?),
            links: GrowingColumn::new(table.get("links")?),
            randoms: table.get("randoms")?,
            entries: GrowingColumn::new(table.get("entries")?),
            outputs: table.get("outputs")?,
            recorded: table.get("recorded")?,
        })
    }

    /// Stores the functions that make features, their geometries and modules of derived chains in the registry.
    pub(super) fn keep_features(&self, lua: &Lua) -> mlua::Result<()> {
        lua.set_named_registry_value(READ_MODULE, &self.read_module)?;
        lua.set_named_registry_value(UNREAD, &self.unread)?;
        lua.set_named_registry_value(POINTS, &self.points)
    }

    /// Returns the column of arguments, at least `size` bytes long.
    pub(crate) fn input(&self, size: usize) -> mlua::Result<Buffer> {
        self.input.of_size(size)
    }

    /// Returns the column of counts, at least `size` bytes long.
    pub(crate) fn counts(&self, size: usize) -> mlua::Result<Buffer> {
        self.counts.of_size(size)
    }

    /// Returns the column of modules that depend on one another, with their neighbours and rules, at least `size` bytes long.
    pub(crate) fn links(&self, size: usize) -> mlua::Result<Buffer> {
        self.links.of_size(size)
    }

    /// Returns the column of random numbers, `each` per application.
    pub(crate) fn randoms(&self, size: usize, each: usize) -> mlua::Result<Buffer> {
        self.randoms.call((size, each))
    }

    /// Returns the column of the interpretation rule of each entry.
    pub(crate) fn entries(&self, size: usize) -> mlua::Result<Buffer> {
        self.entries.of_size(size)
    }

    /// Returns the columns of new symbols and parameters, and the column of their order with its length.
    pub(crate) fn outputs(&self) -> mlua::Result<(Buffer, Buffer, Buffer, usize)> {
        self.outputs.call(())
    }

    /// Returns the columns of recorded calls, of their arguments, and of the number of calls up to each
    /// entry.
    pub(crate) fn recorded(&self) -> mlua::Result<(Buffer, Buffer, Buffer)> {
        self.recorded.call(())
    }
}
