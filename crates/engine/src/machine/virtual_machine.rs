//! Virtual machine: libraries, limits, and translation of errors.

use std::cell::Cell;
use std::io::{Read, Write};
use std::rc::Rc;
use std::sync::Arc;

use super::blank::BlankMachine;
use super::library::Library;
use super::messages::{PhaseFunction, SilentMark};
use super::native::{as_bytecode, end_wait_if_due, is_kept_for_later, wait_with_native};
use super::prelude::Prelude;
use super::system::tell_unseen;
use super::translation::{OUT_OF_MEMORY_IN_LUA, OWN, translate};
use super::{Driver, Watchdog, WorkState, host, protected, watchdog};
use crate::declare::{Session, SourceFile, bytecode};
use burgeon_base::error::{Error, ErrorKind, Limit, Result, SourcePlace};
use burgeon_base::stop::StopAtWork;
use burgeon_base::warning::Warning;
use burgeon_language::slips::explain_syntax;
use burgeon_packages::Package;
use burgeon_rewriting::{Symbol, Symbols};
use mlua::chunk::ChunkMode;
use mlua::{Buffer, Function, Lua, Value};

/// Number of parameters in the caches above which they are cleared.
const MOST_UNPACKED: usize = 4096;

/// Virtual machine that runs a script and its rules.
pub struct Machine {
    // Declared before the state, so it is dropped first and the watchdog never uses a closing state.
    guard: watchdog::Registration,
    lua: Lua,
    /// Run that the machine belongs to.
    pub session: Arc<Session>,
    /// Marks the thread as working on the run until the machine is dropped.
    _work: StopAtWork,
    /// Current work, for the Rust functions that Lua calls.
    pub(crate) current: Rc<WorkState>,
    pub(crate) library: Rc<Library>,
    /// Driver that derives the systems.
    pub(crate) driver: Rc<dyn Driver>,
    prelude: Prelude,
    /// Function for protected calls of script functions.
    pub(super) protected: Function,
    epoch: Cell<usize>,
    /// Used memory (bytes) after the last forced collection.
    pub(super) collected: Cell<usize>,
}

impl Machine {
    /// Creates a sandboxed machine with the standard library.
    pub(crate) fn new(
        session: &Arc<Session>,
        watchdog: &Watchdog,
        driver: Rc<dyn Driver>,
    ) -> Result<Rc<Self>> {
        let build = || -> mlua::Result<Rc<Self>> {
            let BlankMachine { lua, prelude } = BlankMachine::take()?;
            if session.options.waits_with_native {
                wait_with_native(&lua);
            }
            let guard = watchdog.register(&lua);
            let current = Rc::new(WorkState::new(Arc::clone(session)));
            let library = Rc::new(Library::new());
            let host = host::functions(&lua, &current, &library)?;
            let prelude = Prelude::new(&prelude.call(host)?)?;
            lua.set_app_data(PhaseFunction(prelude.phase.clone()));
            let (session, work) = (Arc::clone(session), session.stop.at_work());
            let protected = protected::function(&lua)?;
            Ok(Rc::new(Self {
                guard,
                lua,
                session,
                _work: work,
                current,
                library,
                driver,
                prelude,
                protected,
                epoch: Cell::new(0),
                collected: Cell::new(0),
            }))
        };
        let machine = build();
        // A run that is stopped while a machine starts ends with the reason, such as the time limit.
        session.stop.check()?;
        let machine = machine
            .map_err(|error| Error::internal(format!("the virtual machine did not start: {error}")))?;
        machine.library.set_machine(&machine);
        machine.prelude.keep_features(&machine.lua).map_err(|error| machine.translate(error))?;
        machine.library.install(&machine)?;
        machine.lua.sandbox(true).map_err(|error| machine.translate(error))?;
        machine.lua.globals().set_readonly(true);
        machine
            .lua
            .set_memory_limit(session.options.limits.memory)
            .map_err(|error| machine.translate(error))?;
        Ok(machine)
    }

    /// Runs the script's main file, and warns about declarations without effect.
    pub fn run(&self) -> Result<()> {
        let session = &self.session;
        let name = session.script().display().to_string();
        let source = session.source(session.path(), &name, &self.library.globals())?;
        let problems = session.problems();
        if !problems.is_empty() && !session.options.check {
            self.load_file(&source)?;
            return Err(Error::several(problems));
        }
        let chunk = self.load_file(&source)?;
        let value: Value = self.call(&chunk, ()).map_err(|error| self.translate(error))?;
        tell_unseen(self, !value.is_nil());
        Ok(())
    }

    /// Adds a warning at the line of the script that is being run. A helper machine adds none, because the
    /// leading machine runs the same line.
    pub(crate) fn warn(&self, warning: Warning) {
        if self.driver.leads() {
            self.session.warn(warning.at(Self::place(&self.lua)).called_at(Self::outermost(&self.lua)));
        }
    }

    /// Adds a warning about values of the script at the line that is being run.
    ///
    /// A check derives nothing, so after the first derivation it has no warnings about values: they can depend on a model that
    /// it does not make. A run has them.
    pub(crate) fn warn_of_values(&self, warning: Warning) {
        if !self.has_skipped_derivation() {
            self.warn(warning);
        }
    }

    /// Returns true if the script has derived a system in a check, which derives nothing.
    pub(crate) fn has_skipped_derivation(&self) -> bool {
        self.session.options.check && self.driver.count() > 0
    }

    /// Suppresses the output of the script, because another machine also runs it.
    pub(crate) fn silence(&self) {
        self.lua.set_app_data(SilentMark);
    }

    /// Prepares the machine for a batch. Clears the caches of parameters if parameter values have been dropped, or if the caches are
    /// large: most objects in parameters are read by one application only.
    pub(crate) fn refresh(&self) {
        end_wait_if_due(&self.lua);
        let epoch = self.session.values.epoch();
        if self.epoch.replace(epoch) != epoch || self.current.unpacked.get() > MOST_UNPACKED {
            self.current.unpacked.set(0);
            // The function only clears two tables.
            let _ = self.prelude.forget_values.call::<()>(());
        }
    }

    /// Switches the machine to system `index` of the script.
    pub(crate) fn enter(&self, index: usize) -> Result<()> {
        if self.current.system.replace(Some(index)) == Some(index) {
            return Ok(());
        }
        self.library.systems.borrow()[index].enter(self).map_err(|error| self.translate(error))
    }

    /// Returns the application at which a batch failed, the number of modules it had made, and the number of
    /// calls it had recorded, and the interpretation rule that ran if it was not that of the entry, or -1.
    pub(crate) fn failed_at(&self) -> Option<(usize, f64, usize, i32)> {
        self.guard.despite_stop(|| self.prelude.at.call(()).ok())
    }

    pub(crate) fn lua(&self) -> &Lua {
        &self.lua
    }

    pub(crate) fn prelude(&self) -> &Prelude {
        &self.prelude
    }

    /// Compiles `text`. Errors refer to the file `name`.
    pub(crate) fn load(&self, name: &str, text: &str) -> Result<Function> {
        self.load_text(name, text, None)
    }

    /// Returns the function of a script file.
    pub(crate) fn load_file(&self, file: &SourceFile) -> Result<Function> {
        let text = &file.analysis.text;
        let function = self.load_text(&file.name, text, file.analysis.code.as_deref());
        function.map_err(|error| match error.kind() {
            ErrorKind::Syntax => explain_syntax(error, text),
            _ => error,
        })
    }

    fn load_text(&self, name: &str, text: &str, code: Option<&[u8]>) -> Result<Function> {
        self.library.prepare_functions(&self.lua, text).map_err(|error| self.translate(error))?;
        let chunk = match code {
            Some(code) => self.lua.load(code).set_mode(ChunkMode::Binary),
            None => self.lua.load(text).set_mode(ChunkMode::Text),
        };
        let function = chunk.set_name(format!("@{name}")).into_function();
        let function = function.map_err(|error| self.translate(error))?;
        is_kept_for_later(&self.lua, &function);
        Ok(function)
    }

    /// Loads bytecode from [`compile`], without native code until [`native`] is called. Errors in it refer to
    /// the calling line of the script.
    pub(crate) fn load_compiled(&self, code: &[u8]) -> Result<Function> {
        let chunk = self.lua.load(code).set_name(format!("={OWN}")).set_mode(ChunkMode::Binary);
        as_bytecode(&self.lua, || chunk.into_function()).map_err(|error| self.translate(error))
    }

    /// Creates the constructor of a module.
    pub(crate) fn constructor(&self, symbols: &Symbols, symbol: Symbol) -> mlua::Result<Function> {
        let signature = symbols.signature(symbol);
        let table = self.lua.create_table()?;
        table.raw_set("name", signature.name.as_str())?;
        table.raw_set("qualified", symbols.qualified_name(symbol))?;
        table.raw_set("arity", signature.arity())?;
        table.raw_set("required", signature.required)?;
        table.raw_set("count", signature.count())?;
        table.raw_set("usage", signature.usage())?;
        table.raw_set(
            "parameters",
            self.lua.create_sequence_from(signature.parameters.iter().map(String::as_str))?,
        )?;
        self.prelude.constructor.call((symbol, table))
    }

    /// Converts a Lua error: extracts location and remedy from its text, and replaces it if the run was
    /// stopped.
    pub(crate) fn translate(&self, error: mlua::Error) -> Error {
        let limit = self.session.options.limits.memory;
        // If memory is exhausted, the error handler may fail too.
        let is_full = self.lua.used_memory() > limit / 2;
        let out_of_memory = is_out_of_memory(&error) || is_full && is_error_of_a_handler(&error);
        let translated = translate(&error);
        let exhausted = protected::exhausted();
        let limit = limit / 1_000_000;
        match self.session.stop.check() {
            Err(reason) if out_of_memory => translated.at(exhausted).because(&reason),
            Err(reason) => translated.because(&reason),
            Ok(()) if out_of_memory => translated.at(exhausted).because(
                &Error::limit(Limit::Memory, format!("the run exceeds the memory limit of {limit} MB"))
                    .help("look for a growing table, string or report, or raise the limit: --memory-limit MEGABYTES"),
            ),
            Ok(()) => translated,
        }
    }

    /// Fails if rules are running, because `what` is allowed only at the top level.
    pub(crate) fn refuse_in_rules(&self, what: &str) -> Result<()> {
        match self.prelude.phase.call::<u8>(()) {
            Ok(0) => Ok(()),
            _ => Err(Error::scope(format!(
                "{what} can be called only at the top level of the script, not in a rule"
            ))
            .help("call it before derive, and use the result in the rule")),
        }
    }

    /// Returns true if a hook is running.
    pub(crate) fn runs_hook(&self) -> bool {
        self.current.hook.borrow().is_some()
    }

    /// Returns the package of the file that is being run; `None` for the script's own files.
    pub(crate) fn asker<'a>(lua: &Lua, session: &'a Session) -> Option<&'a Package> {
        if session.packages().order().is_empty() {
            return None;
        }
        session.package_of(&Self::place(lua)?.file)
    }

    /// Returns the line of the script that is being run.
    pub(crate) fn place(lua: &Lua) -> Option<SourcePlace> {
        (1..20).find_map(|level| Self::frame(lua, level)?)
    }

    /// Returns the outermost line of the script in the current call stack.
    pub(crate) fn outermost(lua: &Lua) -> Option<SourcePlace> {
        (1..200).map_while(|level| Self::frame(lua, level)).flatten().last()
    }

    /// Returns the line at stack level `level`, counted from the calling Rust function. `Some(None)` if it is
    /// not a line of a script, `None` if the stack has fewer levels.
    fn frame(lua: &Lua, level: usize) -> Option<Option<SourcePlace>> {
        lua.inspect_stack(level, |debug| {
            let source = debug.source();
            let file = source.source?.strip_prefix('@')?.to_owned();
            Some(SourcePlace { file, line: debug.current_line()? })
        })
    }
}

/// Compiles Burgeon's own Lua code; empty if it has a syntax error.
pub(crate) fn compile(text: &str) -> Vec<u8> {
    bytecode::compile(text).unwrap_or_default()
}

/// Returns true if Lua ran out of memory.
fn is_out_of_memory(error: &mlua::Error) -> bool {
    match error {
        mlua::Error::CallbackError { cause, .. } | mlua::Error::WithContext { cause, .. } => {
            is_out_of_memory(cause)
        }
        mlua::Error::MemoryError(_) => true,
        mlua::Error::RuntimeError(message) => message.contains(OUT_OF_MEMORY_IN_LUA),
        _ => false,
    }
}

/// Returns true if the error handler itself failed.
fn is_error_of_a_handler(error: &mlua::Error) -> bool {
    match error {
        mlua::Error::CallbackError { cause, .. } | mlua::Error::WithContext { cause, .. } => {
            is_error_of_a_handler(cause)
        }
        mlua::Error::RuntimeError(message) => message.contains("error in error handling"),
        _ => false,
    }
}

/// Copies a column to the start of a buffer, which must be long enough.
pub(crate) fn write_column<T: bytemuck::Pod>(buffer: Buffer, column: &[T]) -> Result<()> {
    write_columns(buffer, &[bytemuck::cast_slice(column)]).map_err(|error| Error::internal(error.to_string()))
}

/// Copies the bytes of columns, one after the other, to the start of a buffer, which must be long enough.
pub(crate) fn write_columns(buffer: Buffer, columns: &[&[u8]]) -> mlua::Result<()> {
    let mut cursor = buffer.cursor();
    columns.iter().try_for_each(|column| cursor.write_all(column)).map_err(mlua::Error::external)
}

/// Replaces `column` by the first `count` items of a buffer.
pub(crate) fn read_column<T: bytemuck::Pod + Default>(
    buffer: Buffer,
    count: usize,
    column: &mut Vec<T>,
) -> Result<()> {
    column.clear();
    column.resize(count, T::default());
    buffer
        .cursor()
        .read_exact(bytemuck::cast_slice_mut(column))
        .map_err(|error| Error::internal(error.to_string()))
}
