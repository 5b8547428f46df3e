//! Calls of hooks, and the functions for them: the state of the derivation, its end, and the group of rules.

use std::rc::Rc;
use std::sync::Arc;

use mlua::{Lua, Table, Value as LuaValue};

use super::Machine;
use super::current::WorkState;
use super::system::HookFunction;
use burgeon_base::error::{Error, Result};
use burgeon_language::NOW;
use burgeon_rewriting::{Chain, ModuleKey, Symbols};

/// State of a derivation that a hook reads, and its requests.
pub(crate) struct HookView {
    pub(crate) step: usize,
    /// Time of the last event, the latest of all chains.
    pub(crate) time: f64,
    pub(crate) chain: Arc<Chain>,
    pub(crate) symbols: Arc<Symbols>,
    /// Names of the groups of rules.
    pub(crate) groups: Vec<Arc<str>>,
    /// Number of the group of rules in use; `None` for the rules without a group.
    pub(crate) group: Option<usize>,
    /// Set once a hook has requested that no step follows.
    pub(crate) is_last: bool,
}

impl Machine {
    /// Calls hooks one after the other, with random numbers from `key`. Returns the state with their requests.
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
                if let Err(error) = self.call::<()>(&self.prelude().run_hook, (function, step)) {
                    // If ending the hook fails too, the machine is dropped with the run.
                    let _ = self.prelude().finish.call::<()>(());
                    return Err(self.translate(error).at(place.clone()).rule(format!("{method} (hook)")));
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
                "modules" => number(view.chain.modules()),
                "counts" => {
                    let counts = lua.create_table()?;
                    for (name, count) in view.symbols.counts(&view.chain) {
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
