//! Distances of edges as scripts write them.

use burgeon_base::error::Result;
use burgeon_kit::{Expectation, Parameter, TableKey, Value};
use burgeon_shapes::{EnvelopeLimit, Selector, Shape};
use glam::DMat3;

/// One distance (m) for all edges, a list with one for each edge, or a table by direction: { front = 3, side = 1 }.
#[derive(Debug, Clone)]
pub enum EdgeDistances {
    /// All edges.
    All(f64),
    /// Each edge, in its order.
    Each(Vec<f64>),
    /// Edges by selector, the most particular first.
    Selected(Vec<(String, f64)>),
}

const EXPECTED: &str =
    "a distance (m), a list with one for each edge, or a table such as { front = 3, side = 1 }";

impl Parameter for EdgeDistances {
    fn luau() -> String {
        "number | { any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let table = match value {
            Value::Number(distance) if distance.is_finite() => return Ok(Self::All(distance)),
            Value::Table(table) => table,
            _ => return Err(Expectation::new(EXPECTED)),
        };
        let number =
            |value: &Value| f64::read_value(value).map_err(|_| Expectation::new(EXPECTED).found(value));
        let list = table.list();
        if !list.is_empty() && list.len() == table.entries.len() {
            return Ok(Self::Each(list.into_iter().map(number).collect::<Result<_, Expectation>>()?));
        }
        let mut named = Vec::with_capacity(table.entries.len());
        for (key, value) in &table.entries {
            let TableKey::Name(name) = key else { return Err(Expectation::new(EXPECTED)) };
            named.push((name.to_string(), number(value)?));
        }
        sort_by_rank(&mut named);
        Ok(Self::Selected(named))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

impl EdgeDistances {
    /// Returns the function that gives the distance of an edge, for the edges of a face with these axes; edges that no
    /// selector matches have 0. Fails if a selector is unknown.
    pub fn by_edge(&self, axes: DMat3) -> Result<impl Fn(usize, &Shape) -> f64 + '_> {
        let selectors: Vec<(Selector, f64)> = match self {
            Self::Selected(named) => {
                let read = |(name, distance): &(String, f64)| Ok((Selector::read(name)?, *distance));
                named.iter().map(read).collect::<Result<_>>()?
            }
            _ => Vec::new(),
        };
        Ok(move |number: usize, edge: &Shape| match self {
            Self::All(distance) => *distance,
            Self::Each(distances) => distances.get(number).copied().unwrap_or(0.0),
            Self::Selected(_) => {
                let found = selectors.iter().find(|(selector, _)| selector.matches_edge(edge, &axes));
                found.map_or(0.0, |(_, distance)| *distance)
            }
        })
    }
}

/// Sorts names of selectors: "side" and "all" stand for the edges that no other name matches.
fn sort_by_rank<T>(named: &mut [(String, T)]) {
    let rank = |name: &str| match name {
        "all" => 2,
        "side" => 1,
        _ => 0,
    };
    named.sort_by(|a, b| rank(&a.0).cmp(&rank(&b.0)).then(a.0.cmp(&b.0)));
}

/// Limits of a zoning envelope by selectors of edges: { front = { 6, 45 }, side = { 12, 60 } }.
#[derive(Debug, Clone)]
pub struct EnvelopeLimits(Vec<(String, EnvelopeLimit)>);

const LIMITS: &str = "a table such as { front = { 6, 45 } }: a height (m) and an angle (degrees) for edges";

impl Parameter for EnvelopeLimits {
    fn luau() -> String {
        "{ [string]: { number } }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = value else { return Err(Expectation::new(LIMITS)) };
        let mut named = Vec::with_capacity(table.entries.len());
        for (key, value) in &table.entries {
            let pair = Vec::<f64>::read_value(value).map_err(|_| Expectation::new(LIMITS).found(value))?;
            let (TableKey::Name(name), &[height, angle]) = (key, pair.as_slice()) else {
                return Err(Expectation::new(LIMITS));
            };
            named.push((name.to_string(), EnvelopeLimit { height, angle: angle.to_radians() }));
        }
        sort_by_rank(&mut named);
        Ok(Self(named))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

impl EnvelopeLimits {
    /// Returns the function that gives the limit of an edge, for the edges of a face with these axes. Fails if a selector
    /// is unknown.
    pub fn by_edge(&self, axes: DMat3) -> Result<impl Fn(&Shape) -> Option<EnvelopeLimit> + use<>> {
        let read = |(name, limit): &(String, EnvelopeLimit)| Ok((Selector::read(name)?, *limit));
        let selectors: Vec<(Selector, EnvelopeLimit)> = self.0.iter().map(read).collect::<Result<_>>()?;
        Ok(move |edge: &Shape| {
            let found = selectors.iter().find(|(selector, _)| selector.matches_edge(edge, &axes));
            found.map(|(_, limit)| *limit)
        })
    }
}
