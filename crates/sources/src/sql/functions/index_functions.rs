//! The functions that rewritten statements use to query indexes.

use std::sync::Arc;

use rusqlite::functions::Context;
use rusqlite::types::ValueRef;

use super::argument::GeometryArgument;
use super::call::{bounds, function_error, keys, number};
use super::registry::FunctionRegistrar;
use super::state::ConnectionState;
use crate::sql::blob;
use crate::sql::index::SpatialIndex;
use burgeon_base::locks::LockRecovery;
use burgeon_spatial::Geometry;

/// Registers the functions with a connection.
pub(super) fn register(functions: &FunctionRegistrar<'_>) -> rusqlite::Result<()> {
    functions.register("burgeon_near", 3, |context, state| {
        let index = index(context, state)?;
        let distance = number(context.get_raw(2)).unwrap_or(f64::NAN);
        let Some(bounds) = argument_bounds(context, state)? else { return Ok(keys(&[])) };
        Ok(keys(&index.keys_near(bounds, distance)))
    })?;
    functions.register("burgeon_nearest", 3, |context, state| {
        let index = index(context, state)?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it saturates, and is checked"
        )]
        let found = match number(context.get_raw(2)).unwrap_or(-1.0) {
            count if count >= 0.0 => match geometry(context, state)? {
                Some(from) if !from.geometry.is_empty() => index.nearest(from.flat(), count as usize),
                _ => index.all(),
            },
            _ => index.all(),
        };
        Ok(keys(&found))
    })?;
    functions.register("burgeon_nearest_one", 2, |context, state| {
        let index = index(context, state)?;
        Ok(match geometry(context, state)? {
            Some(from) if !from.geometry.is_empty() => index.nearest_one(from.flat()),
            _ => index.first(),
        })
    })
}

/// Returns the index that the first argument names.
fn index(context: &Context<'_>, state: &ConnectionState) -> rusqlite::Result<Arc<SpatialIndex>> {
    state.budget().tick().map_err(|error| function_error(error.into_message()))?;
    // SQLite keeps the auxiliary data while the statement runs.
    let found = context.get_or_create_aux(0, |name| -> Result<Arc<SpatialIndex>, rusqlite::Error> {
        let name = name.as_str().map_err(|error| function_error(error.to_string()))?;
        if let Some(own) = state.own_indexes.lock().recover().get(name) {
            return Ok(Arc::clone(own));
        }
        let indexes = state.indexes.read().recover();
        indexes.get(name).cloned().ok_or_else(|| function_error(format!("there is no index {name}")))
    })?;
    Ok(Arc::clone(&found))
}

/// Returns the geometry of the second argument.
fn geometry(
    context: &Context<'_>,
    state: &ConnectionState,
) -> rusqlite::Result<Option<Arc<GeometryArgument>>> {
    match context.get_raw(1) {
        ValueRef::Blob(bytes) if blob::foreign(bytes).is_some() => Err(function_error(
            "the geometries have different reference systems; bring both into one: ST_Transform(geometry, srid)"
                .into(),
        )),
        ValueRef::Blob(bytes) => {
            state.geometry(bytes).map(Some).map_err(|why| function_error(format!("a geometry {why}")))
        }
        ValueRef::Text(text) => {
            let text = std::str::from_utf8(text).unwrap_or_default();
            let read = Geometry::from_wkt_within(text, &state.budget());
            read.map(|it| Some(Arc::new(GeometryArgument::from(it))))
                .map_err(|error| function_error(error.into_message()))
        }
        _ => Ok(None),
    }
}

/// Returns the bounds of the second argument, where the inner `None` is an empty geometry and the outer one null.
fn argument_bounds(
    context: &Context<'_>,
    state: &ConnectionState,
) -> rusqlite::Result<Option<Option<[f64; 4]>>> {
    if let ValueRef::Blob(bytes) = context.get_raw(1)
        && blob::foreign(bytes).is_none()
        && let Some(bounds) = blob::told_bounds(bytes)
    {
        return Ok(Some(Some(bounds)));
    }
    Ok(geometry(context, state)?.map(|parsed| bounds(&parsed)))
}
