//! Sizes of a split as scripts write them.

use burgeon_kit::{Expectation, Parameter, Value};
use burgeon_shapes::{PartSize, PartSizes, SizedParts};

/// A list of sizes: numbers (m), "30%", "~3" for a flexible size, "3*" and "~3*" for repeated ones, and lists of
/// sizes as repeated groups.
#[derive(Debug, Clone, Default)]
pub struct SplitSizes(pub PartSizes);

const EXPECTED: &str =
    "a list of sizes: numbers (m), \"30%\", \"~3\", \"3*\", \"~3*\", or a list that is repeated";

impl Parameter for SplitSizes {
    fn luau() -> String {
        "{ any }".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = &value else { return Err(Expectation::new(EXPECTED)) };
        let items = table.list();
        if items.is_empty() || items.len() != table.entries.len() {
            return Err(Expectation::new(EXPECTED));
        }
        let parts = items.into_iter().map(|item| match item {
            Value::Table(group) => {
                let sizes = group.list().into_iter().map(|item| match size(item)? {
                    (size, false) => Ok(size),
                    (_, true) => {
                        Err(Expectation::new("a size without *, since its list is repeated").found(item))
                    }
                });
                Ok(SizedParts::Repeated(sizes.collect::<Result<_, Expectation>>()?))
            }
            other => Ok(match size(other)? {
                (size, false) => SizedParts::One(size),
                (size, true) => SizedParts::Repeated(vec![size]),
            }),
        });
        Ok(Self(PartSizes(parts.collect::<Result<_, Expectation>>()?)))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

/// Reads a size, and whether it is repeated.
fn size(value: &Value) -> Result<(PartSize, bool), Expectation> {
    let refuse = || Expectation::new("a size: a number (m), \"30%\", \"~3\", \"3*\" or \"~3*\"").found(value);
    match value {
        Value::Number(length) if length.is_finite() => Ok((PartSize::Absolute(*length), false)),
        Value::Text(text) => {
            let (text, repeated) = match text.trim().strip_suffix('*') {
                Some(rest) => (rest.trim(), true),
                None => (text.trim(), false),
            };
            let number = |text: &str| text.trim().parse::<f64>().ok().filter(|number| number.is_finite());
            let size = if let Some(share) = text.strip_suffix('%') {
                PartSize::Relative(number(share).ok_or_else(refuse)? / 100.0)
            } else if let Some(length) = text.strip_prefix('~') {
                PartSize::Flexible(number(length).ok_or_else(refuse)?)
            } else {
                PartSize::Absolute(number(text).ok_or_else(refuse)?)
            };
            Ok((size, repeated))
        }
        _ => Err(refuse()),
    }
}
