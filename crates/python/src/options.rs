//! Options of a run, from JSON.

use std::path::PathBuf;
use std::time::Duration;

use burgeon::script::{Limits, ParamValues, Preset, Print, RunInputs, RunOptions, RunReports};
use burgeon::{Error, Result};
use serde_json::Value;

/// Options of a run, parsed from the JSON of the package, which checks their types.
pub(crate) struct OptionValues(Value);

impl OptionValues {
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let parsed = serde_json::from_str(text);
        parsed.map(Self).map_err(|error| Error::argument(format!("the options are not JSON: {error}")))
    }

    fn number(&self, name: &str) -> Result<Option<u64>> {
        match &self.0[name] {
            Value::Null => Ok(None),
            value => value.as_u64().map(Some).ok_or_else(|| {
                Error::argument(format!("{name} must be a whole number from 0 on, not {value}"))
            }),
        }
    }

    fn count(&self, name: &str) -> Result<Option<usize>> {
        let number = self.number(name)?;
        number
            .map(|number| {
                usize::try_from(number).map_err(|_| Error::argument(format!("{name} is too large: {number}")))
            })
            .transpose()
    }

    fn texts(&self, name: &str) -> Vec<String> {
        let items = self.0[name].as_array();
        items.into_iter().flatten().filter_map(|item| item.as_str().map(str::to_owned)).collect()
    }

    fn paths(&self, name: &str) -> Vec<PathBuf> {
        self.texts(name).into_iter().map(PathBuf::from).collect()
    }

    fn flag(&self, name: &str) -> bool {
        self.0[name].as_bool().unwrap_or(false)
    }

    fn values(&self) -> Vec<(String, String)> {
        let values = self.0["values"].as_object();
        let values = values.into_iter().flatten();
        values.filter_map(|(name, value)| Some((name.clone(), value.as_str()?.to_owned()))).collect()
    }

    fn limits(&self) -> Result<Limits> {
        let mut limits = Limits::default();
        if let Some(seconds) = self.0["time_limit"].as_f64() {
            limits.time = Duration::try_from_secs_f64(seconds)
                .map_err(|_| Error::argument(format!("time_limit must be above 0 s, not {seconds}")))?;
        }
        if let Some(megabytes) = self.count("memory_limit")? {
            limits.memory = megabytes.saturating_mul(1_000_000);
        }
        limits.modules = self.count("module_limit")?.unwrap_or(limits.modules);
        limits.triangles = self.count("triangle_limit")?.unwrap_or(limits.triangles);
        Ok(limits)
    }

    /// Returns the options of a run that passes printed texts to `print`.
    pub(crate) fn run_options(&self, preset: Option<Preset>, print: Option<Print>) -> Result<RunOptions> {
        let lod = self.number("lod")?.unwrap_or(3);
        let lod = u8::try_from(lod).ok().filter(|lod| *lod <= 3);
        let lod = lod.ok_or_else(|| Error::argument("lod must be 0, 1, 2 or 3"))?;
        Ok(RunOptions {
            params: ParamValues { set: self.values(), preset, forgiving: false },
            seed: self.number("seed")?.unwrap_or(0),
            steps: self.count("steps")?,
            lod,
            inputs: RunInputs {
                data: self.paths("data"),
                databases: self.texts("databases"),
                mods: self.paths("mods"),
                ..RunInputs::default()
            },
            reports: RunReports { print, records: true, ..RunReports::default() },
            limits: self.limits()?,
            strict: self.flag("strict"),
            threads: self.count("threads")?,
            ..burgeon::options()
        })
    }

    /// Returns the name of the preset, if one is given.
    pub(crate) fn preset(&self) -> Option<&str> {
        self.0["preset"].as_str()
    }
}
