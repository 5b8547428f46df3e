//! Options of `source`.

use burgeon_base::error::{Error, Result};
use burgeon_data::SourceOptions;
use burgeon_kit::{Table, TableKey, Value};
use burgeon_spatial::GeometryKind;

/// Names of the options.
const OPTIONS: [&str; 9] = ["where", "tags", "within", "limit", "id", "kind", "crs", "layer", "table"];

/// Parses the options of `source`, and the name of its table in SQL statements.
pub(super) fn parse_options(options: &Table) -> Result<(SourceOptions, Option<String>)> {
    let (mut wanted, mut table) = (SourceOptions::default(), None);
    for (key, value) in &options.entries {
        let name = match key {
            TableKey::Name(name) => name,
            TableKey::Index(_) => {
                return Err(Error::argument("source takes named options").help("write { limit = 100 }"));
            }
        };
        let text = |example: &str| match value {
            Value::Text(text) => Ok(Some(text.to_string())),
            other => Err(Error::argument(format!("source: {name} must be a text, not {}", other.describe()))
                .help(format!("write {{ {name} = {example} }}"))),
        };
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        let whole = |example: &str| match value {
            Value::Number(number) if number.fract() == 0.0 && (0.0..=4e9).contains(number) => {
                Ok(*number as u32)
            }
            other => {
                Err(Error::argument(format!("source: {name} must be an integer of at least 0, not {other}"))
                    .help(format!("write {{ {name} = {example} }}")))
            }
        };
        match &**name {
            "where" => wanted.condition = text("\"height > 10\"")?,
            "limit" => wanted.limit = Some(whole("100")? as usize),
            "id" => wanted.id = text("\"name\"")?,
            "table" => table = text("\"houses\"")?,
            "layer" => wanted.layer = text("\"buildings\"")?,
            "crs" => wanted.crs = Some(whole("3067")?),
            "tags" => wanted.tags = Some(super::tags::filter(value)?),
            "within" => wanted.within = Some(corners(value)?),
            "kind" => {
                let kind = text("\"polygon\"")?.unwrap_or_default();
                let known = GeometryKind::SINGLE.into_iter().find(|known| known.name() == kind);
                wanted.kind = Some(known.ok_or_else(|| {
                    let names = GeometryKind::SINGLE.map(GeometryKind::name);
                    let message = format!("source: there is no kind {kind:?} of geometry");
                    Error::not_found("kind", &kind, names, message)
                        .help(format!("it is one of {}", names.join(", ")))
                })?);
            }
            other => {
                let message = format!("source has no option called {other}");
                return Err(Error::not_found("option", other, OPTIONS, message)
                    .help(format!("it has {}", OPTIONS.join(", "))));
            }
        }
    }
    Ok((wanted, table))
}

/// Parses a bounding box: west, south, east, north.
fn corners(value: &Value) -> Result<[f64; 4]> {
    let numbers = match value {
        Value::Table(table) => table.list(),
        _ => Vec::new(),
    };
    let corners = match numbers[..] {
        [Value::Number(west), Value::Number(south), Value::Number(east), Value::Number(north)] => {
            Some([*west, *south, *east, *north])
        }
        _ => None,
    };
    corners.filter(|[west, south, east, north]| west <= east && south <= north).ok_or_else(|| {
        Error::argument("source: within must be { west, south, east, north }, the lesser number first")
            .help("write { within = { 24.94, 60.16, 24.95, 60.17 } }, in the coordinates of the file")
    })
}

#[cfg(test)]
mod tests {
    use super::OPTIONS;

    #[test]
    fn the_options_are_those_of_the_reference() {
        assert_eq!(burgeon_language::SOURCE.part_names(), OPTIONS);
    }
}
