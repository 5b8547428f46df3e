//! Streets that are there before a network grows, as scripts give them.

use std::sync::Arc;

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Expectation, Field, Lines, Parameter, Table, Value, fields};
use burgeon_streets::{ExistingLosses, ExistingStreet, StreetAttributes, StreetNetwork};
use glam::DVec3;

/// One of the streets that are `existing` in `network { ... }`.
#[fields("a street of network { existing = ... }")]
pub struct ExistingLines {
    /// Its lines (m): a source, features, geometries or lists of points.
    pub lines: Lines,
    /// Its depth, as that of streets that grow: 0 for a main street.
    #[default(0)]
    pub depth: u32,
    /// Whether it leads over or under others, and has no junction where it crosses them.
    pub bridge: bool,
}

impl Parameter for ExistingLines {
    fn luau() -> String {
        "{ [string]: any }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Table(table) => Self::from_table(&table)
                .map_err(|error| Expectation::new(format!("a street ({})", error.message()))),
            _ => Err(Expectation::new("a table of a street's fields, such as { lines = ..., depth = 1 }")),
        }
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// Adds streets to a network; gives what is to be told of those that were left out.
pub(super) fn add(
    network: &mut StreetNetwork,
    existing: &[ExistingLines],
    attributes: impl Fn(u32) -> StreetAttributes,
) -> Result<Option<Warning>> {
    let mut streets = Vec::new();
    let mut refused = 0;
    for ExistingLines { lines, depth, bridge } in existing {
        refused += lines.refused.as_ref().map_or(0, |(count, _)| *count);
        streets.extend(lines.lines.iter().map(|line| ExistingStreet {
            line: line.iter().copied().map(DVec3::truncate).collect(),
            attributes: attributes(*depth),
            is_bridge: *bridge,
        }));
    }
    let ExistingLosses { short, outside, over, refused: by_reason } = network.add_existing(&streets)?;
    let mut losses = vec![
        (refused, "without a line".to_owned()),
        (short, "of less than two places".to_owned()),
        (outside, "with places that are none within 500 km".to_owned()),
        (over, "of bridges that cross other streets".to_owned()),
    ];
    losses.extend(by_reason.into_iter().map(|(why, count)| (count, format!("refused ({why})"))));
    if network.size() == 0 && !existing.is_empty() && losses.iter().all(|(count, _)| *count == 0) {
        let text = "network: existing gives no line, so that no street is there";
        return Ok(Some(
            Warning::new(WarningKind::Data, text).help("give lines: a layer of streets, not of areas"),
        ));
    }
    let losses: Vec<String> = losses
        .into_iter()
        .filter(|(count, _)| *count > 0)
        .map(|(count, what)| format!("{count} {what}"))
        .collect();
    Ok((!losses.is_empty()).then(|| {
        let text = format!("network: existing: pieces were left out: {}", losses.join(", "));
        Warning::new(WarningKind::Data, text)
            .help("they keep their place where min_angle, clearance, min_length and snap are less")
    }))
}
