//! Modules that contexts skip: those of `ignore`, or all except for those of `consider`.

use mlua::{Lua, Value as LuaValue};

use crate::machine::Machine;
use crate::machine::library::Library;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_rewriting::{FIRST_SYMBOL, Symbol, Symbols};

use super::strings::word_symbols;

/// Modules that the contexts of a system, or of one of its rules, skip.
#[derive(Debug, Clone, Default)]
pub(crate) struct IgnoredModules {
    pub(crate) ignored: Vec<Symbol>,
    /// The only modules that contexts do not skip, if they are declared.
    pub(crate) considered: Option<Vec<Symbol>>,
    /// Location of the first `ignore` or `consider` of the system.
    pub(crate) place: Option<SourcePlace>,
}

impl IgnoredModules {
    /// Returns the symbols that contexts skip, out of all `symbols`.
    pub(super) fn among(&self, symbols: &Symbols) -> Vec<Symbol> {
        match &self.considered {
            Some(considered) => (FIRST_SYMBOL..)
                .take(symbols.names().count())
                .filter(|symbol| !considered.contains(symbol) || self.ignored.contains(symbol))
                .collect(),
            None => self.ignored.clone(),
        }
    }

    /// Returns the warning about a second declaration at `place`, if there are both `ignore` and `consider`. `owner` is "system" or
    /// "rule".
    pub(super) fn conflict(&self, owner: &str, place: Option<SourcePlace>) -> Option<Warning> {
        if self.ignored.is_empty() || self.considered.is_none() {
            return None;
        }
        let first = self.place.as_ref().map(|first| format!(", the first in {first}")).unwrap_or_default();
        let text = format!(
            "the {owner} has both ignore and consider{first}: contexts see only the modules of consider that ignore does not name"
        );
        Some(Warning::new(WarningKind::NoEffect, text).at(place).help("remove one of the two"))
    }

    /// Returns true if the declaration names `symbol`.
    pub(super) fn names(&self, symbol: Symbol) -> bool {
        self.ignored.contains(&symbol)
            || self.considered.as_ref().is_some_and(|considered| considered.contains(&symbol))
    }
}

/// Warns if a system has both `ignore` and `consider`, after a call of one of them.
pub(super) fn tell_conflict(library: &Library, lua: &Lua, of_system: &mut IgnoredModules) -> Result<()> {
    let place = Machine::place(lua);
    if let Some(warning) = of_system.conflict("system", place.clone()) {
        library.machine()?.warn(warning);
    }
    of_system.place = of_system.place.take().or(place);
    Ok(())
}

/// Returns the modules that the arguments of `ignore` or `consider` name.
pub(super) fn named_symbols<'a>(
    library: &Library,
    lua: &Lua,
    names: impl IntoIterator<Item = &'a LuaValue>,
) -> Result<Vec<Symbol>> {
    let symbols = library.symbols.borrow();
    let scope = library.scope_at(lua);
    let mut found = Vec::new();
    for name in names {
        match name {
            LuaValue::String(text) => {
                for name in text.to_string_lossy().split_whitespace() {
                    found.extend(word_symbols(name, &symbols, &scope)?);
                }
            }
            _ => {
                return Err(Error::argument("ignore and consider take names of modules")
                    .help("write system:ignore(\"Turn\"), or { ignore = \"Turn Roll\" } for one rule"));
            }
        }
    }
    Ok(found)
}

/// Returns the modules that an option `ignore` or `consider` names: a text with their names, or a list of them.
pub(super) fn named_in_option(library: &Library, lua: &Lua, value: &LuaValue) -> Result<Vec<Symbol>> {
    let LuaValue::Table(list) = value else { return named_symbols(library, lua, [value]) };
    let names: mlua::Result<Vec<LuaValue>> = list.sequence_values().collect();
    let names = names.map_err(|error| Error::internal(error.to_string()))?;
    named_symbols(library, lua, &names)
}
