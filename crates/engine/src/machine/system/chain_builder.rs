//! Chains of modules that are made outside of rules.

use std::borrow::Cow;

use mlua::{Table, Value as LuaValue};

use crate::machine::Machine;
use crate::machine::ReadChain;
use crate::machine::convert::to_value;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_kit::Value;
use burgeon_rewriting::{CLOSE, Chain, DEEPEST, END, ModuleKey, OPEN, Ordinals, Symbol};

/// Number of symbols between two checks for cancellation.
const STRETCH: usize = 4096;

/// Builder that appends modules made outside of rules to a chain.
pub(super) struct ChainBuilder<'a> {
    pub machine: &'a Machine,
    pub chain: &'a mut Chain,
    pub random: bool,
    /// Modules of another chain that keep their random keys.
    pub kept: Option<&'a ReadChain>,
}

impl ChainBuilder<'_> {
    pub(super) fn push(&mut self, symbol: Symbol, params: &[f64], key: ModuleKey) {
        self.chain.symbols.push(symbol);
        self.chain.params.extend_from_slice(params);
        if self.random {
            self.chain.keys.push(key);
        }
    }

    pub(super) fn list(&mut self, items: &[LuaValue], key: ModuleKey) -> Result<()> {
        self.items(&mut items.iter().cloned().map(Ok), key, &mut Ordinals::default(), 0)
    }

    /// Returns the name of the list of modules in errors.
    fn subject(&self) -> &'static str {
        if self.kept.is_none() { "an axiom" } else { "the chain that a hook returns" }
    }

    /// Adds the items of a list. They are read one by one, because a machine can hold only a million of them at a time.
    fn items(
        &mut self,
        items: &mut dyn Iterator<Item = mlua::Result<LuaValue>>,
        key: ModuleKey,
        ordinals: &mut Ordinals,
        depth: usize,
    ) -> Result<()> {
        for item in items {
            let item = item.map_err(|error| self.machine.translate(error))?;
            if self.chain.symbols.len().is_multiple_of(STRETCH) {
                self.machine.session.stop.check()?;
            }
            let LuaValue::Table(table) = &item else {
                let what = match to_value(&item, false) {
                    Ok(value @ (Value::Number(_) | Value::Boolean(_) | Value::Text(_))) => {
                        Cow::Owned(format!("{} {value}", value.describe().replacen('a', "the", 1)))
                    }
                    Ok(value) => Cow::Borrowed(value.describe()),
                    Err(_) => Cow::Owned(format!("a {}", item.type_name())),
                };
                let text = format!("{} must contain only modules, but one item is {what}", self.subject());
                return Err(Error::argument(text).help(match self.kept {
                    None => "write system:axiom(A(1), { B() })",
                    Some(_) => "return modules, such as A(1), { B() }, or sequence(list), or nothing",
                }));
            };
            let elements = self.machine.prelude().elements.call::<Option<Table>>(table);
            let elements = elements.map_err(|error| self.machine.translate(error))?;
            if let Some(elements) = elements.filter(|_| depth < DEEPEST) {
                self.items(&mut elements.sequence_values(), key, ordinals, depth + 1)?;
                continue;
            }
            let is_module = self
                .machine
                .prelude()
                .is_module
                .call::<bool>(table)
                .map_err(|error| self.machine.translate(error))?;
            if !is_module {
                if depth == DEEPEST {
                    return Err(Error::limit(
                        Limit::Size,
                        format!("branches are nested more than {DEEPEST} deep, or a branch contains itself"),
                    )
                    .help("use a rule to add the rest step by step"));
                }
                self.push(OPEN, &[], key);
                self.items(&mut table.sequence_values(), key, ordinals, depth + 1)?;
                self.push(CLOSE, &[], key);
                continue;
            }
            let read = |index: usize| {
                table.raw_get::<LuaValue>(index).map_err(|error| self.machine.translate(error))
            };
            let symbol = match read(1)? {
                LuaValue::Integer(symbol) => Symbol::try_from(symbol).unwrap_or(END),
                #[allow(
                    clippy::cast_possible_truncation,
                    clippy::cast_sign_loss,
                    reason = "written by the prelude"
                )]
                LuaValue::Number(symbol) => symbol as Symbol,
                _ => END,
            };
            let (arity, name) = {
                let symbols = self.machine.library.symbols.borrow();
                (symbols.signature(symbol).arity(), symbols.name_hash(symbol))
            };
            let mut params = Vec::with_capacity(arity);
            for index in 0..arity {
                params.push(self.machine.session.values.pack(to_value(&read(index + 3)?, true)?));
            }
            let kept = self.kept.and_then(|known| known.key_of(table));
            self.push(symbol, &params, kept.unwrap_or_else(|| key.successor(name, ordinals.next(symbol))));
        }
        Ok(())
    }
}

/// Returns the chain of the modules that a hook has `returned` in place of `chain`. Modules of the chain that the hook has
/// `read` keep their random keys, others have keys from `key`.
pub(crate) fn replaced_chain(
    machine: &Machine,
    returned: &[LuaValue],
    chain: &Chain,
    read: Option<&ReadChain>,
    key: ModuleKey,
) -> Result<Chain> {
    let unread = ReadChain::empty(machine.lua()).map_err(|error| machine.translate(error))?;
    let mut made = Chain::default();
    let random = !chain.keys.is_empty();
    let kept = Some(read.unwrap_or(&unread));
    let mut builder = ChainBuilder { machine, chain: &mut made, random, kept };
    builder.list(returned, key)?;
    builder.push(END, &[], chain.keys.last().copied().unwrap_or_default());
    Ok(made)
}
