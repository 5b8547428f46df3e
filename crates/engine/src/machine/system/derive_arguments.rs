//! Arguments of `derive`.

use mlua::{Table, Value as LuaValue};

use crate::machine::convert::{to_value, type_of};
use burgeon_base::error::{Error, Result};
use burgeon_kit::Value;
use burgeon_language::DERIVE;

/// Arguments of `derive`: numbers of steps and a group, or a table with them and a time.
#[derive(Debug, Default)]
pub(super) struct DeriveArguments {
    pub steps: Option<usize>,
    pub group: Option<String>,
    pub time: Option<f64>,
}

impl DeriveArguments {
    /// Reads the two arguments of a call.
    pub(super) fn read(first: &LuaValue, group: &LuaValue) -> Result<Self> {
        match (first, group) {
            (LuaValue::Table(options), LuaValue::Nil) => Self::of_table(options),
            (LuaValue::Table(_), _) => Err(Error::argument("derive takes a table and nothing else")
                .help("write the group in the table: system:derive({ time = 10, group = \"grow\" })")),
            (steps, group) => {
                Ok(Self { steps: number_of_steps(steps)?, group: group_name(group)?, time: None })
            }
        }
    }

    fn of_table(options: &Table) -> Result<Self> {
        let mut read = Self::default();
        for pair in options.pairs::<LuaValue, LuaValue>() {
            let (key, value) = pair.map_err(|error| Error::internal(error.to_string()))?;
            let key = key.to_string().unwrap_or_default();
            match key.as_str() {
                "steps" => read.steps = number_of_steps(&value)?,
                "group" => read.group = group_name(&value)?,
                "time" => read.time = end_time(&value)?,
                other => {
                    let known = DERIVE.part_names();
                    let message = format!("unknown option `{other}` of derive");
                    let error = Error::not_found("option", other, known.iter().copied(), message);
                    return Err(error.help(format!("it has {}", known.join(", "))));
                }
            }
        }
        Ok(read)
    }
}

fn number_of_steps(value: &LuaValue) -> Result<Option<usize>> {
    match to_value(value, false)? {
        Value::Nil => Ok(None),
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is checked")]
        Value::Number(steps) if steps.fract() == 0.0 && (0.0..1e9).contains(&steps) => {
            Ok(Some(steps as usize))
        }
        Value::Number(steps) if steps >= 1e9 && steps.is_finite() => {
            Err(Error::argument(format!("derive takes fewer than 1,000,000,000 steps, not {steps}"))
                .help("omit the number to derive until no rule applies"))
        }
        other => Err(Error::argument(format!(
            "derive needs an integer number of steps of at least 0, not {other}"
        ))
        .help("omit it to derive until no rule applies")),
    }
}

fn group_name(value: &LuaValue) -> Result<Option<String>> {
    match value {
        LuaValue::Nil => Ok(None),
        LuaValue::String(name) => Ok(Some(name.to_string_lossy())),
        other => {
            let message = format!("derive needs the name of a group, not a {}", type_of(other));
            Err(Error::argument(message).help("write system:derive(5, \"grow\")"))
        }
    }
}

fn end_time(value: &LuaValue) -> Result<Option<f64>> {
    match to_value(value, false)? {
        Value::Nil => Ok(None),
        Value::Number(time) if time >= 0.0 && time.is_finite() => Ok(Some(time)),
        other => {
            Err(Error::argument(format!("the time of derive must be a number of at least 0, not {other}"))
                .help("write system:derive({ time = 10 })"))
        }
    }
}
