//! Rust functions for `prelude/queries.luau`: SQL queries of scripts, and their results.

use std::cell::RefCell;
use std::rc::Rc;
use std::sync::Arc;

use mlua::{Lua, LuaString, Table, Value as LuaValue};
use rustc_hash::FxHashMap;

use super::convert::{to_lua, to_value};
use super::library::Library;
use super::{Machine, WorkState};
use crate::queries::SqlQuery;
use burgeon_kit::{QueryRows, Value};
use burgeon_language::analysis::sql_parameters;
use burgeon_rewriting::{Pattern, Symbols};

/// Maximum number of result values that a machine keeps as tables.
const MOST: usize = 200_000;

/// Query results as tables, by the address of the rows.
#[derive(Default)]
struct RowTables {
    known: FxHashMap<usize, (Arc<QueryRows>, Table)>,
    values: usize,
}

/// Adds the functions that [`prelude/queries.luau`](self) calls.
pub(super) fn add_queries(
    lua: &Lua,
    host: &Table,
    current: &Rc<WorkState>,
    library: &Rc<Library>,
) -> mlua::Result<()> {
    host.set(
        "sql_parameters",
        lua.create_function(|lua, sql: LuaString| {
            let sql = sql.to_string_lossy();
            let names = lua.create_sequence_from(sql_parameters(&sql).map_err(mlua::Error::external)?)?;
            names.set_readonly(true);
            Ok(names)
        })?,
    )?;
    let state = Rc::clone(current);
    host.set(
        "note_pending",
        lua.create_function(move |_, ()| {
            state.session.note_pending();
            Ok(())
        })?,
    )?;
    let (state, library, tables) = (Rc::clone(current), Rc::clone(library), RefCell::<RowTables>::default());
    let none = lua.create_table()?;
    none.set_readonly(true);
    host.set(
        "rows",
        lua.create_function(
            move |lua, (sql, values, at_top, asker): (LuaString, LuaValue, bool, Option<usize>)| {
                let values = match to_value(&values, false).map_err(mlua::Error::external)? {
                    Value::Table(values) => Some(values),
                    _ => None,
                };
                let scope = library.question_scope(&state.session, |session| Machine::asker(lua, session));
                let question = SqlQuery::new(sql.to_string_lossy().into(), values).asked_in(scope);
                let rows = match at_top {
                    true => state.session.ask_about(&question, &state.chains_derived.borrow(), true),
                    false => state.session.ask(&question),
                };
                let rows = rows.map_err(mlua::Error::external)?;
                if let Some(place) = asker.and_then(|asker| state.noted_place(asker)) {
                    state.session.rows.note(place, &question, rows.len());
                }
                let mut tables = tables.borrow_mut();
                if rows.is_empty() {
                    return Ok(none.clone());
                }
                let address = Arc::as_ptr(&rows) as usize;
                if let Some((_, known)) = tables.known.get(&address) {
                    return Ok(known.clone());
                }
                let table = row_tables(lua, &rows)?;
                if tables.values > MOST {
                    *tables = RowTables::default();
                }
                tables.values += rows.values.len() + 1;
                tables.known.insert(address, (rows, table.clone()));
                Ok(table)
            },
        )?,
    )
}

/// Returns a frozen list of frozen tables, one per row, without NULL values.
fn row_tables(lua: &Lua, rows: &QueryRows) -> mlua::Result<Table> {
    let names: Vec<LuaString> =
        rows.names.iter().map(|name| lua.create_string(name.as_bytes())).collect::<mlua::Result<_>>()?;
    let list = lua.create_table_with_capacity(rows.len(), 0)?;
    for row in rows.iter() {
        let table = lua.create_table_with_capacity(0, names.len())?;
        for (name, value) in names.iter().zip(row) {
            table.raw_set(name, to_lua(lua, value, true)?)?;
        }
        table.set_readonly(true);
        list.raw_push(table)?;
    }
    list.set_readonly(true);
    Ok(list)
}

/// Returns the argument indices of a rule with this pattern, by name, for `prelude/queries.luau`.
pub(super) fn argument_places(lua: &Lua, pattern: &Pattern, symbols: &Symbols) -> mlua::Result<Table> {
    let places = lua.create_table()?;
    for (place, name) in pattern.arguments(symbols) {
        places.raw_set(name, place + 1)?;
    }
    places.set_readonly(true);
    Ok(places)
}
