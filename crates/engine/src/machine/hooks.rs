//! Calls of hooks, and the functions for them: the state of the derivation, its end, and the group of rules.

use std::rc::Rc;
use std::sync::Arc;

use mlua::{Lua, MultiValue, Table, Value as LuaValue};

use super::Machine;
use super::current::WorkState;
use super::system::{HookFunction, replaced_chain};
use super::types::{ReadChain, ReadableChain};
use burgeon_base::error::{Error, Result};
use burgeon_language::NOW;
use burgeon_rewriting::{Chain, ChainsBetween, END, ModuleKey, Symbols};

/// Chain that a hook reads.
pub(crate) enum HookChain {
    /// Chain between phases.
    Whole(Arc<Chain>),
    /// Chains between events, which become a whole chain once a hook reads them.
    Between(ChainsBetween),
}

impl HookChain {
    /// Returns the whole chain.
    pub(crate) fn whole(&mut self) -> Arc<Chain> {
        let whole = match self {
            Self::Whole(chain) => return Arc::clone(chain),
            Self::Between(chains) => Arc::clone(chains.whole()),
        };
        *self = Self::Whole(Arc::clone(&whole));
        whole
    }

    /// Returns the number of modules, without brackets and ends.
    fn modules(&self) -> usize {
        match self {
            Self::Whole(chain) => chain.modules(),
            Self::Between(chains) => chains.symbols().flatten().filter(|symbol| **symbol > END).count(),
        }
    }

    /// Returns the names of the declared modules, and their numbers in the chain.
    fn counts<'a>(&self, symbols: &'a Symbols) -> Vec<(&'a str, usize)> {
        match self {
            Self::Whole(chain) => symbols.counts(chain),
            Self::Between(chains) => symbols.counts_of(chains.symbols()),
        }
    }
}

/// State of a derivation that a hook reads, and its requests.
pub(crate) struct HookView {
    pub(crate) step: usize,
    /// Time of the last event, the latest of all chains.
    pub(crate) time: f64,
    pub(crate) chain: HookChain,
    pub(crate) symbols: Arc<Symbols>,
    /// Names of the groups of rules.
    pub(crate) groups: Vec<Arc<str>>,
    /// Number of the group of rules in use; `None` for the rules without a group.
    pub(crate) group: Option<usize>,
    /// Set once a hook has replaced the chain.
    pub(crate) is_replaced: bool,
    /// Set once a hook has requested that no step follows.
    pub(crate) is_last: bool,
    /// Set if there is one chain, and the hooks run before anything sees it.
    pub(crate) may_replace: bool,
    /// The chain as a list, once a hook has read it.
    pub(crate) read: Option<ReadChain>,
}

impl Machine {
    /// Calls hooks one after the other, with random numbers from `key`. Returns the state with their requests. A hook that returns
    /// modules replaces the chain.
    pub(crate) fn run_hooks(
        &self,
        hooks: &[HookFunction],
        method: &str,
        view: HookView,
        key: ModuleKey,
    ) -> Result<HookView> {
        let step = view.step;
        self.current.hook.replace(Some(view));
        let run = || {
            for (index, (function, place)) in hooks.iter().enumerate() {
                self.current.keys.replace(vec![key.child(index)]);
                self.current.used.set(0);
                let named = |error: Error| error.at_place(place.as_ref()).rule(format!("{method} (hook)"));
                match self.call::<MultiValue>(&self.prelude().run_hook, (function, step)) {
                    Ok(returned) => {
                        let returned: Vec<LuaValue> = returned.into_iter().collect();
                        if returned.iter().any(|value| !value.is_nil()) {
                            self.replace_chain(&returned, method, key.child(index)).map_err(named)?;
                        }
                    }
                    Err(error) => {
                        // If ending the hook fails too, the machine is dropped with the run.
                        let _ = self.prelude().finish.call::<()>(());
                        return Err(named(self.translate(error)));
                    }
                }
            }
            Ok(())
        };
        let done = run();
        let view = self.current.hook.take();
        done?;
        let mut view = view.ok_or_else(|| Error::internal("a hook has lost its derivation"))?;
        view.is_last |= self.current.take_end();
        Ok(view)
    }

    /// Replaces the chain by the modules that a hook has `returned`. New modules have random keys from `key`.
    fn replace_chain(&self, returned: &[LuaValue], method: &str, key: ModuleKey) -> Result<()> {
        let mut hook = self.current.hook.borrow_mut();
        let view = hook.as_mut().ok_or_else(|| Error::internal("a hook has lost its derivation"))?;
        if !view.may_replace {
            return Err(match method {
                "at_start" | "before_step" => {
                    Error::script("a hook can replace the chain only of a system with one chain")
                        .help("use rules, which see each chain")
                }
                _ => Error::script(format!("{method} cannot replace the chain, because it has been drawn"))
                    .help(
                        "return the modules from before_step; after the derivation, change derived:chain()",
                    ),
            });
        }
        let chain = replaced_chain(self, returned, &view.chain.whole(), view.read.as_ref(), key)?;
        (view.chain, view.is_replaced) = (HookChain::Whole(Arc::new(chain)), true);
        view.read = None;
        Ok(())
    }
}

/// Adds the functions of [`prelude/hooks.luau`](self) for derivations.
pub(super) fn add_hooks(lua: &Lua, host: &Table, current: &Rc<WorkState>) -> mlua::Result<()> {
    let state = Rc::clone(current);
    host.set(
        "now",
        lua.create_function(move |lua, name: String| {
            let hook = state.hook.borrow();
            let view = hook.as_ref().ok_or_else(|| mlua::Error::external(Error::internal("no hook runs")))?;
            #[allow(clippy::cast_precision_loss, reason = "counts below 2^53")]
            let number = |count: usize| LuaValue::Number(count as f64);
            Ok(match name.as_str() {
                "step" => number(view.step),
                "time" => LuaValue::Number(view.time),
                "chain" => {
                    drop(hook);
                    LuaValue::Table(read_chain(lua, &state).map_err(mlua::Error::external)?)
                }
                "modules" => number(view.chain.modules()),
                "counts" => {
                    let counts = lua.create_table()?;
                    for (name, count) in view.chain.counts(&view.symbols) {
                        counts.raw_set(name, count)?;
                    }
                    counts.set_readonly(true);
                    LuaValue::Table(counts)
                }
                _ => {
                    let known = NOW.part_names();
                    let message = format!("unknown field `{name}` of the state in a hook");
                    let error = Error::not_found("field", &name, known.iter().copied(), message);
                    return Err(mlua::Error::external(error.help(format!("it has {}", known.join(", ")))));
                }
            })
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "stop",
        lua.create_function(move |_, ()| {
            state.request_end();
            Ok(())
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "use_group",
        lua.create_function(move |_, name: Option<String>| {
            let mut hook = state.hook.borrow_mut();
            let view = hook.as_mut().ok_or_else(|| mlua::Error::external(Error::internal("no hook runs")))?;
            view.group = match name {
                Some(name) => Some(group_number(&view.groups, &name).map_err(mlua::Error::external)?),
                None => None,
            };
            Ok(())
        })?,
    )
}

/// Returns the chain of the hook that runs as a list of modules, which is read once.
fn read_chain(lua: &Lua, state: &WorkState) -> Result<Table> {
    let mut hook = state.hook.borrow_mut();
    let view = hook.as_mut().ok_or_else(|| Error::internal("no hook runs"))?;
    let read = match &mut view.read {
        Some(read) => read,
        unread => {
            let chain = view.chain.whole();
            if chain.symbols.iter().filter(|symbol| **symbol == END).count() != 1 {
                return Err(Error::script(
                    "now.chain is the chain of a system with one chain, but this system has several",
                )
                .help("read their modules with query, such as query(\"select n from A\")"));
            }
            let readable =
                ReadableChain { chain: &chain, symbols: &view.symbols, values: &state.session.values };
            let read = ReadChain::read(lua, &readable).map_err(|error| Error::other(error.to_string()))?;
            unread.insert(read)
        }
    };
    Ok(read.list.clone())
}

/// Returns the number of the group of rules called `name`.
pub(crate) fn group_number(groups: &[Arc<str>], name: &str) -> Result<usize> {
    groups.iter().position(|group| **group == *name).ok_or_else(|| {
        let known = groups.iter().map(|group| &**group);
        let help = match groups {
            [] => format!("add rules to it: {{ group = \"{name}\" }} before the successor"),
            groups => format!("there are {}", groups.join(", ")),
        };
        Error::not_found("group", name, known, format!("the system has no rules of the group {name}"))
            .help(help)
    })
}
