//! Aggregate functions of geometries.

use std::panic::AssertUnwindSafe;
use std::sync::Arc;

use rusqlite::Connection;
use rusqlite::functions::{Aggregate, Context, FunctionFlags};
use rusqlite::types::{Value, ValueRef};

use super::call::{FunctionResult, value};
use super::state::ConnectionState;
use burgeon_spatial::Geometry;

/// Names of the functions.
pub(super) const NAMES: [&str; 2] = ["ST_Collect", "ST_Union"];

/// The way in which the geometries of a group are combined.
#[derive(Clone, Copy)]
enum Gathering {
    /// Collection of the unchanged geometries.
    Collect,
    /// Union of the geometries.
    Union,
}

struct GeometryGathering {
    state: Arc<ConnectionState>,
    gathering: Gathering,
}

/// The geometries so far, and the size (bytes) of their blobs.
type GeometryGroup = AssertUnwindSafe<(Vec<Geometry>, usize)>;

fn function_error(message: String) -> rusqlite::Error {
    rusqlite::Error::UserFunctionError(message.into())
}

impl Aggregate<GeometryGroup, Value> for GeometryGathering {
    fn init(&self, _: &mut Context<'_>) -> rusqlite::Result<GeometryGroup> {
        Ok(AssertUnwindSafe((Vec::new(), 0)))
    }

    fn step(&self, context: &mut Context<'_>, gathered: &mut GeometryGroup) -> rusqlite::Result<()> {
        match context.get_raw(0) {
            ValueRef::Null => Ok(()),
            ValueRef::Blob(bytes) => {
                let budget = self.state.budget();
                let taken =
                    budget.hold(4 * bytes.len()).map_err(|error| function_error(error.into_message()))?;
                let parsed = self.state.geometry(bytes);
                let parsed =
                    parsed.map_err(|why| function_error(format!("a geometry of the group {why}")))?;
                drop(taken);
                gathered.0.0.push(parsed.geometry.clone());
                gathered.0.1 += bytes.len();
                if gathered.0.1 > MOST_BYTES {
                    return Err(function_error(format!(
                        "a group has more than {} MB of geometries",
                        MOST_BYTES / 1_000_000
                    )));
                }
                Ok(())
            }
            _ => Err(function_error("ST_Collect and ST_Union gather geometries".into())),
        }
    }

    fn finalize(&self, _: &mut Context<'_>, gathered: Option<GeometryGroup>) -> rusqlite::Result<Value> {
        let Some(AssertUnwindSafe((geometries, _))) = gathered else { return Ok(Value::Null) };
        if geometries.is_empty() {
            return Ok(Value::Null);
        }
        let made = match self.gathering {
            Gathering::Collect => super::parts::collect(geometries),
            Gathering::Union => super::parts::unite(&geometries).map_err(function_error)?,
        };
        value(FunctionResult::Geometry(made))
    }
}

/// Maximum size (bytes) of a group's geometries.
const MOST_BYTES: usize = 200_000_000;

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection, state: &Arc<ConnectionState>) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    for (name, gathering) in NAMES.into_iter().zip([Gathering::Collect, Gathering::Union]) {
        let state = Arc::clone(state);
        connection.create_aggregate_function(name, 1, flags, GeometryGathering { state, gathering })?;
    }
    Ok(())
}
