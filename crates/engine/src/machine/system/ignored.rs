//! Modules that contexts skip: those of `ignore`, or all except for those of `consider`.

use mlua::{Lua, Value as LuaValue};

use crate::machine::library::Library;
use burgeon_base::error::{Error, Result};
use burgeon_rewriting::{FIRST_SYMBOL, Symbol, Symbols};

use super::strings::word_symbols;

/// Modules that the contexts of a system, or of one of its rules, skip.
#[derive(Debug, Clone, Default)]
pub(crate) struct IgnoredModules {
    pub(crate) ignored: Vec<Symbol>,
    /// The only modules that contexts do not skip, if they are declared.
    pub(crate) considered: Option<Vec<Symbol>>,
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

    /// Returns true if the declaration names `symbol`.
    pub(super) fn names(&self, symbol: Symbol) -> bool {
        self.ignored.contains(&symbol)
            || self.considered.as_ref().is_some_and(|considered| considered.contains(&symbol))
    }
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
