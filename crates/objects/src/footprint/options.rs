//! The fields of footprints.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::roofs::Height;
use crate::{LineIndex, Terrain};
use burgeon_kit::{Color, Expectation, Parameter, Table, TableKey, Value, fields};
use burgeon_spatial::PolygonArgument;

/// Options of `footprint(geometry, { ... })`.
#[fields("footprint")]
pub struct FootprintOptions {
    /// Polygon on the ground (m): a feature's geometry, or rings of points, the outer ring first and then the holes.
    pub geometry: PolygonArgument,
    /// Keywords for the type of building, such as "shop".
    pub keywords: Vec<String>,
    /// Keywords of single edges, by edge number: { [2] = { "entry door" } }. Edge 1 runs from the first given point to
    /// the second. The edges of holes follow the edges of the outer ring.
    pub edge_keywords: EdgeKeywords,
    /// Further data, which `attribute` returns: any table, such as the feature.
    pub attributes: Arc<Table>,
    /// Nearby streets, as `streets(source)` returns them.
    pub streets: Option<LineIndex>,
    /// Terrain under the building, which sets the heights of its points.
    pub ground: Option<Arc<Terrain>>,
    /// Default height of the walls (m).
    pub height: Option<Height>,
    /// Default colour of the building.
    #[default(Color([0.62, 0.58, 0.52, 1.0]))]
    pub color: Color,
}

/// Keywords by edge number, counted from 1 over the rings as they were given.
#[derive(Debug, Clone, Default)]
pub struct EdgeKeywords(pub BTreeMap<usize, Vec<String>>);

impl Parameter for EdgeKeywords {
    fn luau() -> String {
        "{ [number]: { string } }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || {
            Expectation::new(
                "a table that maps edge numbers to lists of keywords: { [2] = { \"entry door\" } }",
            )
        };
        let Value::Table(table) = value else { return Err(what()) };
        let edge = |(key, words): &(TableKey, Value)| {
            let TableKey::Index(number) = key else { return Err(what()) };
            let number = usize::try_from(*number).map_err(|_| what())?;
            Ok((number, Vec::<String>::read_value(words).map_err(|_| what())?))
        };
        table.entries.iter().map(edge).collect::<Result<_, _>>().map(Self)
    }

    fn into_value(self) -> Value {
        let index = |number: usize| TableKey::Index(i64::try_from(number).unwrap_or(i64::MAX));
        let entries = self.0.into_iter().map(|(number, words)| (index(number), words.into_value()));
        Value::Table(Table { class: None, entries: entries.collect() }.into())
    }
}
