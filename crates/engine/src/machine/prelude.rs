//! The prelude: the Lua side of the hot path, and what scripts see.

use std::sync::LazyLock;

use mlua::chunk::ChunkMode;
use mlua::{Buffer, Function, Lua, Table};

use super::native::as_bytecode;
use crate::machine::system::UNREAD;
use crate::machine::types::POINTS;
use burgeon_rewriting::Successors;

/// Its parts: one chunk of Luau, whose locals each part has from those before it.
const PARTS: [&str; 12] = [
    include_str!("prelude/batch.luau"),
    include_str!("prelude/constructors.luau"),
    include_str!("prelude/successors.luau"),
    include_str!("prelude/drivers.luau"),
    include_str!("prelude/calls.luau"),
    include_str!("prelude/script_types.luau"),
    include_str!("prelude/held_objects.luau"),
    include_str!("prelude/declarations.luau"),
    include_str!("prelude/interpretation.luau"),
    include_str!("prelude/questions.luau"),
    include_str!("prelude/globals.luau"),
    include_str!("prelude/exports.luau"),
];

/// The parts written out and compiled, once for all machines.
static COMPILED: LazyLock<Vec<u8>> = LazyLock::new(|| super::compile(&expand(&with_words(&PARTS.concat()))));

/// The functions of the prelude that Rust calls.
pub(crate) struct Prelude {
    /// `(symbol, signature)`: a module's constructor.
    pub constructor: Function,
    /// `(query, fragment)`: the constructors of the modules that stand for others.
    pub pending: Function,
    /// `(rule, arity, places)`: a function that applies the rule to a batch; `places` are those of its arguments by name.
    pub driver: Function,
    /// `(guard, arity, places)`: a function that asks the guard about a batch.
    pub guard_driver: Function,
    /// `(id, rule, arity, places)`: sets an interpretation rule.
    pub interpreter: Function,
    /// `(method, name, arity, kind)`: a method that records its calls.
    pub recorder: Function,
    /// `(method, name, changes, kind)`: a method that runs at once.
    pub direct: Function,
    /// `(count)`: interprets a batch; gives the calls and arguments recorded last.
    pub interpret: Function,
    /// `(entry, call)`: runs an interpretation rule again, and fails at one of its recorded calls.
    pub relive: Function,
    /// Ends a batch that failed.
    pub finish: Function,
    /// The application at hand.
    pub at: Function,
    /// `(object, kind, type)`: sets `this`, the name of its type, and the type itself if the script declared it.
    pub set_this: Function,
    /// `(type)`: makes a type known that the script declares.
    pub script_type: Function,
    /// `(kind, methods, type, reads, changes)`: adds functions of the script to a type.
    pub extension: Function,
    /// `(type)`: what is run at the beginning and the end of a chain, and where a branch opens and closes.
    pub hooks: Function,
    /// Forgets cached parameters.
    pub forget_values: Function,
    /// Forgets the interpretation rules of the last system.
    pub fresh_interpreters: Function,
    /// What scripts get from it.
    pub globals: Table,
    /// What is being done: 0 nothing, 1 a rule, 2 a guard, 3 an interpretation.
    pub phase: Function,
    /// `(value)`: whether it is a module made outside of rules.
    pub is_module: Function,
    points: Function,
    unread: Function,
    input: Function,
    counts: Function,
    randoms: Function,
    entries: Function,
    outputs: Function,
    recorded: Function,
}

impl Prelude {
    /// The prelude as bytecode: called with the functions that Rust gives to it, it returns what [`Prelude::new`] takes.
    pub(super) fn chunk(lua: &Lua) -> mlua::Result<Function> {
        let chunk = lua.load(COMPILED.as_slice()).set_name("=burgeon").set_mode(ChunkMode::Binary);
        as_bytecode(lua, || chunk.into_function())
    }

    pub(super) fn new(table: &Table) -> mlua::Result<Self> {
        Ok(Self {
            constructor: table.get("constructor")?,
            pending: table.get("pending")?,
            driver: table.get("driver")?,
            guard_driver: table.get("guard_driver")?,
            interpreter: table.get("interpreter")?,
            recorder: table.get("recorder")?,
            direct: table.get("direct")?,
            interpret: table.get("interpret")?,
            relive: table.get("relive")?,
            finish: table.get("finish")?,
            at: table.get("current")?,
            set_this: table.get("set_this")?,
            script_type: table.get("script_type")?,
            extension: table.get("extension")?,
            hooks: table.get("hooks")?,
            forget_values: table.get("forget_values")?,
            fresh_interpreters: table.get("fresh_interpreters")?,
            globals: table.get("globals")?,
            phase: table.get("phase")?,
            is_module: table.get("is_module")?,
            points: table.get("points")?,
            unread: table.get("unread")?,
            input: table.get("input")?,
            counts: table.get("counts")?,
            randoms: table.get("randoms")?,
            entries: table.get("entries")?,
            outputs: table.get("outputs")?,
            recorded: table.get("recorded")?,
        })
    }

    /// Keeps what makes features and their geometries where sources find it.
    pub(super) fn keep_features(&self, lua: &Lua) -> mlua::Result<()> {
        lua.set_named_registry_value(UNREAD, &self.unread)?;
        lua.set_named_registry_value(POINTS, &self.points)
    }

    /// The column of arguments, at least `size` bytes long.
    pub(crate) fn input(&self, size: usize) -> mlua::Result<Buffer> {
        self.input.call(size)
    }

    /// The column of counts, at least `size` bytes long.
    pub(crate) fn counts(&self, size: usize) -> mlua::Result<Buffer> {
        self.counts.call(size)
    }

    /// The column of random numbers, `each` for an application.
    pub(crate) fn randoms(&self, size: usize, each: usize) -> mlua::Result<Buffer> {
        self.randoms.call((size, each))
    }

    /// The column that tells which interpretation rule each entry runs.
    pub(crate) fn entries(&self, size: usize) -> mlua::Result<Buffer> {
        self.entries.call(size)
    }

    /// The columns of new symbols and parameters, and that of their order with its length.
    pub(crate) fn outputs(&self) -> mlua::Result<(Buffer, Buffer, Buffer, usize)> {
        self.outputs.call(())
    }

    /// The columns of recorded calls, their arguments, and the number of calls up to each entry.
    pub(crate) fn recorded(&self) -> mlua::Result<(Buffer, Buffer, Buffer)> {
        self.recorded.call(())
    }
}

/// Puts the words of successors that Rust reads in the places of their names, such as `@KEEP`.
fn with_words(template: &str) -> String {
    [
        ("@KEEP", Successors::KEEP),
        ("@ORDERED", Successors::ORDERED),
        ("@OPEN_ITEM", Successors::OPEN_ITEM),
        ("@CLOSE_ITEM", Successors::CLOSE_ITEM),
    ]
    .into_iter()
    .fold(template.to_owned(), |text, (name, word)| text.replace(name, &word.to_string()))
}

/// Repeats the marked parts of the template for each number of parameters.
fn expand(template: &str) -> String {
    let mut out = String::with_capacity(template.len() * 3);
    let mut lines = template.lines();
    while let Some(line) = lines.next() {
        let Some(range) = line.strip_prefix("--@each K=") else {
            out.push_str(line);
            out.push('\n');
            continue;
        };
        let part: Vec<&str> = lines.by_ref().take_while(|line| *line != "--@end").collect();
        let (first, last) = range.split_once("..").unwrap_or((range, range));
        let bounds = first.parse().unwrap_or(0)..=last.parse().unwrap_or(0);
        for count in bounds {
            for line in &part {
                out.push_str(&instance(line, count));
                out.push('\n');
            }
        }
    }
    out
}

/// One line of the template for `count` parameters.
fn instance(line: &str, count: usize) -> String {
    let names: Vec<String> = (1..=count).map(|index| format!("a{index}")).collect();
    if let Some(each) = line.trim().strip_prefix("@{").and_then(|line| line.strip_suffix('}')) {
        return (1..=count)
            .map(|index| {
                each.replace("aI", &names[index - 1])
                    .replace("OFFSET", &((index - 1) * 8).to_string())
                    .replace(", I)", &format!(", {index})"))
            })
            .collect::<Vec<_>>()
            .join(" ");
    }
    let arguments = names.join(", ");
    let with_comma = if count > 0 { format!(", {arguments}") } else { String::new() };
    line.replace(" @COMMA_ARGS", &with_comma).replace("@ARGS", &arguments).replace('K', &count.to_string())
}
