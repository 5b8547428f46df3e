//! Views as arguments of methods.

use std::sync::Arc;

use burgeon_kit::{Expectation, Parameter, Table, TableKey, Value};
use burgeon_terrain::{TileRing, View};

/// Argument of methods that is a view.
pub struct ViewArgument(pub View);

impl Parameter for ViewArgument {
    fn luau() -> String {
        "{ cell: number, rings: { { number } } }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let what = || {
            Expectation::new(
                "a view: { cell = 512, rings = { { 4, 8 }, { 8, 6 } } }, which divides the nearest 4 x 4 cells 8 times",
            )
        };
        let Value::Table(table) = &value else { return Err(what()) };
        if table
            .entries
            .iter()
            .any(|(key, _)| !matches!(key, TableKey::Name(name) if matches!(&**name, "cell" | "rings")))
        {
            return Err(what());
        }
        let cell = table.get("cell").map(f64::read_value).transpose().map_err(|_| what())?;
        let cell = cell.filter(|cell| *cell > 0.0).ok_or_else(what)?;
        let rings = Vec::<Vec<u32>>::read_value(table.get("rings").unwrap_or(&Value::Nil));
        let rings = rings.map_err(|_| what())?.into_iter().map(|ring| match ring.as_slice() {
            [across, levels] if (1..=1024).contains(across) => {
                Ok(TileRing { across: *across, levels: *levels })
            }
            _ => Err(what()),
        });
        let rings = rings.collect::<Result<Vec<_>, _>>()?;
        if rings.is_empty() {
            return Err(what());
        }
        if rings.windows(2).any(|pair| pair[0].across >= pair[1].across || pair[0].levels < pair[1].levels) {
            return Err(Expectation::new("a view with growing rings that are divided less with distance"));
        }
        Ok(Self(View { cell, rings }))
    }

    fn into_value(self) -> Value {
        let ring = |ring: &TileRing| vec![f64::from(ring.across), f64::from(ring.levels)];
        let rings = self.0.rings.iter().map(ring).collect::<Vec<_>>().into_value();
        let entries = vec![
            (TableKey::Name("cell".into()), Value::Number(self.0.cell)),
            (TableKey::Name("rings".into()), rings),
        ];
        Value::Table(Arc::new(Table { class: None, entries }))
    }
}
