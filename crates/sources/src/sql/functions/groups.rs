//! Aggregate functions that do not combine geometries: booleans, lists, boxes and clusters.

use std::borrow::Cow;
use std::panic::AssertUnwindSafe;
use std::sync::Arc;

use burgeon_spatial::{Geometry, Rings};
use glam::DVec3;
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};
use rusqlite::Connection;
use rusqlite::functions::{Aggregate, Context, FunctionFlags, WindowAggregate};
use rusqlite::types::{Value, ValueRef};

use super::argument::GeometryArgument;
use super::call::{FunctionResult, value};
use super::state::ConnectionState;
use super::texts::wrong_argument;
use crate::sql::blob;
use burgeon_base::budget::Budget;
use burgeon_base::locks::LockRecovery;

/// Names of the functions that statements may call, and of those in rewritten statements.
pub(super) const NAMES: [&str; 7] =
    ["array_agg", BOOLEAN_LIST, "bool_and", "bool_or", "ST_Extent", "burgeon_clusters", "burgeon_cluster"];

/// Name of `array_agg` in rewritten statements if it collects booleans.
pub(crate) const BOOLEAN_LIST: &str = "burgeon_booleans";

fn function_error(message: impl Into<String>) -> rusqlite::Error {
    rusqlite::Error::UserFunctionError(message.into().into())
}

/// The aggregates `bool_and` and `bool_or`.
struct Truth {
    all: bool,
}

impl Aggregate<Option<bool>, Option<bool>> for Truth {
    fn init(&self, _: &mut Context<'_>) -> rusqlite::Result<Option<bool>> {
        Ok(None)
    }

    fn step(&self, context: &mut Context<'_>, truth: &mut Option<bool>) -> rusqlite::Result<()> {
        let row = match context.get_raw(0) {
            ValueRef::Null => return Ok(()),
            ValueRef::Integer(number) => number != 0,
            other => return Err(function_error(wrong_argument(0, "true or false", other))),
        };
        let known = truth.unwrap_or(self.all);
        *truth = Some(if self.all { known && row } else { known || row });
        Ok(())
    }

    fn finalize(&self, _: &mut Context<'_>, truth: Option<Option<bool>>) -> rusqlite::Result<Option<bool>> {
        Ok(truth.flatten())
    }
}

/// The aggregate of a list of values, as JSON.
struct List {
    booleans: bool,
    state: Arc<ConnectionState>,
}

impl Aggregate<String, Option<String>> for List {
    fn init(&self, _: &mut Context<'_>) -> rusqlite::Result<String> {
        Ok(String::new())
    }

    fn step(&self, context: &mut Context<'_>, list: &mut String) -> rusqlite::Result<()> {
        let item: Cow<'_, str> = match context.get_raw(0) {
            ValueRef::Integer(number) if self.booleans => (number != 0).to_string().into(),
            ValueRef::Integer(number) => number.to_string().into(),
            ValueRef::Real(number) if number.is_finite() => format!("{number:?}").into(),
            ValueRef::Null | ValueRef::Real(_) => "null".into(),
            ValueRef::Text(text) => quote_json(&String::from_utf8_lossy(text)).into(),
            ValueRef::Blob(_) => {
                return Err(function_error("array_agg: geometries are gathered by ST_Collect"));
            }
        };
        let budget = self.state.budget();
        drop(budget.hold(list.len() + item.len()).map_err(|error| function_error(error.message()))?);
        list.push(if list.is_empty() { '[' } else { ',' });
        list.push_str(&item);
        Ok(())
    }

    fn finalize(&self, _: &mut Context<'_>, list: Option<String>) -> rusqlite::Result<Option<String>> {
        Ok(list.filter(|list| !list.is_empty()).map(|list| list + "]"))
    }
}

/// Quotes a string as JSON.
fn quote_json(text: &str) -> String {
    let mut made = String::from("\"");
    for letter in text.chars() {
        match letter {
            '"' => made.push_str("\\\""),
            '\\' => made.push_str("\\\\"),
            letter if u32::from(letter) < 0x20 => made.push_str(&format!("\\u{:04x}", u32::from(letter))),
            letter => made.push(letter),
        }
    }
    made + "\""
}

/// The box around all geometries, and their reference system.
#[derive(Default)]
struct GroupExtent {
    bounds: Option<[f64; 4]>,
    foreign: Option<u32>,
}

struct ExtentOfAll {
    state: Arc<ConnectionState>,
}

impl Aggregate<GroupExtent, Value> for ExtentOfAll {
    fn init(&self, _: &mut Context<'_>) -> rusqlite::Result<GroupExtent> {
        Ok(GroupExtent::default())
    }

    fn step(&self, context: &mut Context<'_>, extent: &mut GroupExtent) -> rusqlite::Result<()> {
        let bytes = match context.get_raw(0) {
            ValueRef::Null => return Ok(()),
            ValueRef::Blob(bytes) => bytes,
            other => {
                return Err(function_error(format!("ST_Extent: {}", wrong_argument(0, "a geometry", other))));
            }
        };
        let own = match blob::told_bounds(bytes) {
            Some(bounds) => Some(bounds),
            None => {
                let parsed = self.state.geometry(bytes).map_err(function_error)?;
                parsed.geometry.bounds().map(|[low, high]| [low.x, low.y, high.x, high.y])
            }
        };
        let Some(own) = own else { return Ok(()) };
        extent.foreign = blob::foreign(bytes);
        let known = extent.bounds.get_or_insert(own);
        *known = [known[0].min(own[0]), known[1].min(own[1]), known[2].max(own[2]), known[3].max(own[3])];
        Ok(())
    }

    fn finalize(&self, _: &mut Context<'_>, extent: Option<GroupExtent>) -> rusqlite::Result<Value> {
        let Some(GroupExtent { bounds: Some([west, south, east, north]), foreign }) = extent else {
            return Ok(Value::Null);
        };
        let at = |x: f64, y: f64| DVec3::new(x, y, 0.0);
        // PostGIS converts a degenerate box to a point or a line.
        let made = if west == east && south == north {
            Geometry::point(at(west, south))
        } else if west == east || south == north {
            Geometry::Line(vec![at(west, south), at(east, north)])
        } else {
            let ring = vec![at(west, south), at(west, north), at(east, north), at(east, south)];
            Geometry::Polygon(Rings(vec![ring]))
        };
        value(FunctionResult::Placed(made, foreign))
    }
}

/// The geometries of a partition, and the number of the clusters found in it.
#[derive(Default)]
struct ClusterPartition {
    geometries: Vec<Option<Arc<GeometryArgument>>>,
    distance: f64,
    least: usize,
    found: Option<i64>,
}

struct Clusters {
    state: Arc<ConnectionState>,
}

impl Clusters {
    fn find(&self, partition: &mut ClusterPartition) -> rusqlite::Result<i64> {
        if let Some(found) = partition.found {
            return Ok(found);
        }
        let budget = self.state.budget();
        let found = clusters(partition, &budget).map_err(function_error)?;
        let mut known = self.state.clusters.lock().recover();
        known.push(found);
        let number = i64::try_from(known.len()).unwrap_or(i64::MAX);
        partition.found = Some(number);
        Ok(number)
    }
}

impl Aggregate<AssertUnwindSafe<ClusterPartition>, Option<i64>> for Clusters {
    fn init(&self, _: &mut Context<'_>) -> rusqlite::Result<AssertUnwindSafe<ClusterPartition>> {
        Ok(AssertUnwindSafe(ClusterPartition::default()))
    }

    fn step(
        &self,
        context: &mut Context<'_>,
        partition: &mut AssertUnwindSafe<ClusterPartition>,
    ) -> rusqlite::Result<()> {
        let number = |index: usize| match context.get_raw(index) {
            #[allow(clippy::cast_precision_loss, reason = "a number of points")]
            ValueRef::Integer(number) => Ok(number as f64),
            ValueRef::Real(number) => Ok(number),
            other => {
                Err(function_error(format!("ST_ClusterDBSCAN: {}", wrong_argument(index, "a number", other))))
            }
        };
        let (distance, least) = (number(1)?, number(2)?);
        if distance < 0.0 || least < 1.0 {
            return Err(function_error(
                "ST_ClusterDBSCAN: the distance is not negative, and the least number of points at least 1",
            ));
        }
        partition.distance = distance;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "it is positive, and saturates"
        )]
        {
            partition.least = least as usize;
        }
        let geometry = match context.get_raw(0) {
            ValueRef::Null => None,
            ValueRef::Blob(bytes) => {
                let budget = self.state.budget();
                drop(budget.hold(4 * bytes.len()).map_err(|error| function_error(error.message()))?);
                Some(self.state.geometry(bytes).map_err(function_error)?)
            }
            other => {
                return Err(function_error(format!(
                    "ST_ClusterDBSCAN: {}",
                    wrong_argument(0, "a geometry", other)
                )));
            }
        };
        partition.geometries.push(geometry);
        Ok(())
    }

    fn finalize(
        &self,
        _: &mut Context<'_>,
        partition: Option<AssertUnwindSafe<ClusterPartition>>,
    ) -> rusqlite::Result<Option<i64>> {
        partition.map(|mut partition| self.find(&mut partition)).transpose()
    }
}

impl WindowAggregate<AssertUnwindSafe<ClusterPartition>, Option<i64>> for Clusters {
    fn value(
        &self,
        partition: Option<&mut AssertUnwindSafe<ClusterPartition>>,
    ) -> rusqlite::Result<Option<i64>> {
        partition.map(|partition| self.find(partition)).transpose()
    }

    fn inverse(
        &self,
        _: &mut Context<'_>,
        _: &mut AssertUnwindSafe<ClusterPartition>,
    ) -> rusqlite::Result<()> {
        Err(function_error("ST_ClusterDBSCAN: a window has no frame here; leave ROWS and RANGE out"))
    }
}

/// Finds clusters of geometries by density, and returns the cluster of each row.
///
/// A geometry with at least the minimum number of neighbours is a core, and joins the clusters of neighbouring cores.
/// Other neighbours of a core join the first cluster that reaches them. Clusters are numbered in the order of the rows,
/// as in PostGIS.
///
/// Method: Ester, Kriegel, Sander and Xu, "A density-based algorithm for discovering clusters in large spatial
/// databases with noise", 1996.
fn clusters(partition: &ClusterPartition, budget: &Budget) -> Result<Vec<Option<u32>>, String> {
    let ClusterPartition { geometries, distance, least, .. } = partition;
    let boxed = |(index, geometry): (usize, &Option<Arc<GeometryArgument>>)| {
        let [low, high] = geometry.as_ref()?.geometry.bounds()?;
        let corners = Rectangle::from_corners([low.x, low.y], [high.x, high.y]);
        Some((index, [low, high], GeomWithData::new(corners, index)))
    };
    let boxes: Vec<_> = geometries.iter().enumerate().filter_map(boxed).collect();
    let tree = RTree::bulk_load(boxes.iter().map(|(.., item)| *item).collect());
    let mut parents: Vec<usize> = (0..geometries.len()).collect();
    let mut sizes = vec![1usize; geometries.len()];
    let (mut core, mut inside) = (vec![false; geometries.len()], vec![false; geometries.len()]);
    for (index, [low, high], _) in &boxes {
        let around =
            AABB::from_corners([low.x - distance, low.y - distance], [high.x + distance, high.y + distance]);
        let mut near: Vec<usize> =
            tree.locate_in_envelope_intersecting(&around).map(|item| item.data).collect();
        if near.len() < *least {
            continue;
        }
        near.sort_unstable();
        near.retain(|other| {
            let [Some(a), Some(b)] = [&geometries[*index], &geometries[*other]] else { return false };
            index == other || a.geometry.distance(&b.geometry).is_some_and(|far| far <= *distance)
        });
        budget.check().map_err(|error| error.into_message())?;
        if near.len() < *least {
            continue;
        }
        (core[*index], inside[*index]) = (true, true);
        for other in near {
            if core[other] || !inside[other] {
                inside[other] = true;
                unite(&mut parents, &mut sizes, *index, other);
            }
        }
    }
    let mut members: Vec<(usize, usize)> = (0..geometries.len())
        .filter(|index| inside[*index])
        .map(|index| (root(&mut parents, index), index))
        .collect();
    members.sort_unstable();
    let mut found = vec![None; geometries.len()];
    let (mut number, mut last) = (0, None);
    for (cluster, index) in members {
        number += u32::from(last.is_some_and(|last| last != cluster));
        last = Some(cluster);
        found[index] = Some(number);
    }
    Ok(found)
}

fn root(parents: &mut [usize], mut index: usize) -> usize {
    while parents[index] != index {
        parents[index] = parents[parents[index]];
        index = parents[index];
    }
    index
}

/// Merges the smaller of two sets into the larger one, and of equally large sets the later one into the earlier one.
fn unite(parents: &mut [usize], sizes: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parents, a), root(parents, b));
    if a == b {
        return;
    }
    let (from, to) = if sizes[a] < sizes[b] || sizes[a] == sizes[b] && a > b { (a, b) } else { (b, a) };
    parents[from] = to;
    sizes[to] += sizes[from];
}

/// Registers the functions with a connection.
pub(super) fn register(connection: &Connection, state: &Arc<ConnectionState>) -> rusqlite::Result<()> {
    let flags = FunctionFlags::SQLITE_UTF8 | FunctionFlags::SQLITE_DETERMINISTIC;
    connection.create_aggregate_function("bool_and", 1, flags, Truth { all: true })?;
    connection.create_aggregate_function("bool_or", 1, flags, Truth { all: false })?;
    for (name, booleans) in [("array_agg", false), (BOOLEAN_LIST, true)] {
        connection.create_aggregate_function(name, 1, flags, List { booleans, state: Arc::clone(state) })?;
    }
    connection.create_aggregate_function("ST_Extent", 1, flags, ExtentOfAll { state: Arc::clone(state) })?;
    connection.create_window_function("burgeon_clusters", 3, flags, Clusters { state: Arc::clone(state) })?;
    let own = Arc::clone(state);
    // The function is not deterministic, because its first argument differs between runs.
    let flags = FunctionFlags::SQLITE_UTF8;
    connection.create_scalar_function("burgeon_cluster", 2, flags, move |context| {
        let index = |place: usize| match context.get_raw(place) {
            ValueRef::Integer(number) => usize::try_from(number - 1).ok(),
            _ => None,
        };
        let known = own.clusters.lock().recover();
        let found = index(0).zip(index(1)).and_then(|(number, row)| *known.get(number)?.get(row)?);
        Ok(found.map_or(Value::Null, |found| Value::Integer(found.into())))
    })
}
