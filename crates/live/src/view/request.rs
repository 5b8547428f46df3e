//! Request of the pages: parameter values, the seed and the step limit.
//!
//! Values are kept by name across saves of the script. Each value is stored with the script's default at the time when
//! it was set, so that a page can show both if the script changes its default.

use std::borrow::Cow;
use std::collections::BTreeMap;

use serde_json::{Map, Value};

use super::message::ParamMessage;
use burgeon_base::error::{Error, Result};
use burgeon_engine::script::{Param, Preset, RunOptions, Setting};

/// Current request of the pages.
#[derive(Debug, Clone, Default)]
pub(super) struct Request {
    values: BTreeMap<String, ParamText>,
    seed: u64,
    pub steps: Option<usize>,
    /// Preset that was loaded or saved, while its values and its seed equal the present ones.
    preset: Option<Preset>,
}

/// Value that was set.
#[derive(Debug, Clone)]
struct ParamText {
    text: String,
    /// Default of the script at that time, if known.
    default: Option<Setting>,
}

/// Inputs that determine the result of a run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Inputs {
    pub set: Vec<(String, String)>,
    pub seed: u64,
    pub steps: Option<usize>,
    /// Number of file changes so far.
    pub generation: u64,
}

impl Inputs {
    /// Returns the inputs of the run without a limit of its steps.
    pub(super) fn unlimited(&self) -> Self {
        Self { steps: None, ..self.clone() }
    }
}

impl Request {
    /// Creates the request of the command line.
    pub(super) fn new(options: &RunOptions) -> Self {
        let preset = options.params.preset.as_ref().map(Preset::set).unwrap_or_default();
        let values = preset
            .into_iter()
            .chain(options.params.set.iter().cloned())
            .map(|(name, text)| (name, ParamText { text, default: None }))
            .collect();
        Self { values, seed: options.seed, steps: options.steps, preset: None }
    }

    pub(super) fn inputs(&self, generation: u64) -> Inputs {
        let set = self.values.iter().map(|(name, given)| (name.clone(), given.text.clone())).collect();
        Inputs { set, seed: self.seed, steps: self.steps, generation }
    }

    /// Sets parameters, all or none of them; null restores a default.
    ///
    /// Fails if a value is not a string, a number, a boolean or a list. Also fails if the parameter does not accept the value,
    /// provided that `params`, the current parameters of the script, are known.
    pub(super) fn set(&mut self, wished: Map<String, Value>, params: Option<&[Param]>) -> Result<()> {
        let mut read = Vec::new();
        for (name, value) in wished {
            let text = match value {
                Value::Null => None,
                Value::String(text) => Some(text),
                Value::Number(_) | Value::Bool(_) | Value::Array(_) => Some(value.to_string()),
                _ => {
                    return Err(Error::argument(format!(
                        "the value of {name} must be a string, a number, a boolean or a list of points"
                    )));
                }
            };
            let param = params.map(|params| Param::find(params, &name)).transpose()?.flatten();
            match (&text, param, params) {
                (Some(text), Some(param), _) => {
                    param.accept(text)?;
                }
                (Some(_), None, Some(params)) => {
                    let names = params.iter().map(|param| param.name.as_str());
                    let message = format!("unknown parameter `{name}`");
                    return Err(Error::not_found("parameter", &name, names, message));
                }
                _ => {}
            }
            let (full, default) = match param {
                Some(param) => (param.name.clone(), Some(param.default.clone())),
                None => (name, None),
            };
            read.push((full, text, default));
        }
        if !read.is_empty() {
            self.preset = None;
        }
        for (name, text, default) in read {
            match text {
                Some(text) => {
                    self.values.insert(name, ParamText { text, default });
                }
                None => {
                    self.values.remove(&name);
                }
            }
        }
        Ok(())
    }

    /// Removes the value of `param` if it is `stored`, which a file contains from now on.
    pub(super) fn forget(&mut self, param: &Param, stored: &Setting) {
        let given = self.values.get(&param.name).and_then(|given| param.accept(&given.text).ok());
        if given.as_ref() == Some(stored) {
            self.values.remove(&param.name);
            self.preset = None;
        }
    }

    /// Restores all defaults.
    pub(super) fn reset(&mut self) {
        self.values.clear();
        self.preset = None;
    }

    /// Returns the seed.
    pub(super) fn seed(&self) -> u64 {
        self.seed
    }

    /// Sets the seed.
    pub(super) fn set_seed(&mut self, seed: u64) {
        if seed != self.seed {
            self.preset = None;
        }
        self.seed = seed;
    }

    /// Returns the name of the preset whose values and seed equal the present ones.
    pub(super) fn preset(&self) -> Option<String> {
        self.preset.as_ref().map(|preset| preset.name.clone())
    }

    /// Records that `preset` has the present values and seed.
    pub(super) fn is_preset(&mut self, preset: Preset) {
        self.preset = Some(preset);
    }

    /// Clears the preset unless `find` still finds it unchanged.
    pub(super) fn look_for_preset(&mut self, find: impl Fn(&str) -> Result<Preset>) {
        self.preset.take_if(|known| !find(&known.name).is_ok_and(|preset| preset.is_like(known)));
    }

    /// Replaces all values by those of a preset, and the seed if the preset has one.
    pub(super) fn load(&mut self, preset: Preset) {
        let given = |(name, text)| (name, ParamText { text, default: None });
        self.values = preset.set().into_iter().map(given).collect();
        self.seed = preset.seed.unwrap_or(self.seed);
        self.preset = Some(preset);
    }

    /// Returns the values that are set and that `params` accept.
    pub(super) fn used_values(&self, params: &[Param]) -> Vec<(String, Setting)> {
        let used = params.iter().filter_map(|param| {
            let given = self.values.get(&param.name)?;
            Some((param.name.clone(), param.accept(&given.text).ok()?))
        });
        used.collect()
    }

    /// Returns `params` of an earlier run with the currently requested values, as far as the parameters accept them.
    pub(super) fn requested_params<'p>(&mut self, params: &'p [Param]) -> Vec<ParamMessage> {
        let value = |param: &'p Param| {
            let given = self.values.get(&param.name).and_then(|given| param.accept(&given.text).ok());
            given.map_or_else(|| Cow::Borrowed(param.base_value()), Cow::Owned)
        };
        let values = params.iter().map(value).collect();
        self.describe(params, values)
    }

    /// Replaces short names by the parameters' full names, if a short name refers to a parameter of a package.
    fn qualify(&mut self, params: &[Param]) {
        let plain: Vec<(String, String)> = self
            .values
            .keys()
            .filter_map(|name| {
                let param = Param::find(params, name).ok().flatten().filter(|param| param.name != *name)?;
                Some((name.clone(), param.name.clone()))
            })
            .collect();
        for (name, full) in plain {
            if let Some(given) = self.values.remove(&name) {
                self.values.entry(full).or_insert(given);
            }
        }
    }

    /// Describes the parameters of a run for pages, the script's own first. Stores the defaults of values whose default
    /// was unknown.
    pub(super) fn params(&mut self, params: &[Param]) -> Vec<ParamMessage> {
        self.describe(params, params.iter().map(|param| Cow::Borrowed(&param.value)).collect())
    }

    fn describe(&mut self, params: &[Param], values: Vec<Cow<Setting>>) -> Vec<ParamMessage> {
        self.qualify(params);
        let mut messages = Vec::with_capacity(params.len());
        for (param, value) in params.iter().zip(values) {
            let given = self.values.get_mut(&param.name);
            // A value that the script no longer accepts is not shown.
            let used = given.filter(|given| param.accept(&given.text).is_ok());
            let old = used.map(|given| given.default.get_or_insert_with(|| param.default.clone()));
            messages.push((!param.own, ParamMessage::new(param, &value, old.as_deref())));
        }
        // The parameters of required files are declared before the script's own.
        messages.sort_by_key(|(required, _)| *required);
        messages.into_iter().map(|(_, message)| message).collect()
    }
}

/// Parses the seed that a page sent: an integer from 0, as a string or a number.
pub(super) fn seed(value: &Value) -> Result<u64> {
    let seed = match value {
        Value::String(text) => text.trim().parse().ok(),
        other => other.as_u64(),
    };
    seed.ok_or_else(|| Error::argument(format!("a seed is an integer from 0 to {}", u64::MAX)))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;
    use burgeon_engine::script::Control;

    fn param(default: f64, max: f64) -> Param {
        Param {
            name: "floors".into(),
            package: None,
            value: Setting::Number(default),
            default: Setting::Number(default),
            stored: None,
            control: Control::Number { min: Some(1.0), max: Some(max), step: Some(1.0) },
            group: String::new(),
            unit: String::new(),
            doc: String::new(),
            own: true,
        }
    }

    fn set(request: &mut Request, value: Value, params: &[Param]) -> Result<()> {
        let Value::Object(map) = value else { panic!() };
        request.set(map, Some(params))
    }

    #[test]
    fn values_that_the_script_does_not_take_are_refused_with_the_others_of_their_message() {
        let (mut request, params) = (Request::default(), [param(4.0, 10.0)]);
        set(&mut request, json!({ "floors": "7" }), &params).unwrap();
        for wrong in [
            json!({ "floors": "3", "flors": "1" }),
            json!({ "floors": 30 }),
            json!({ "floors": "x" }),
            json!({ "floors": [1] }),
        ] {
            assert!(set(&mut request, wrong, &params).is_err());
        }
        assert_eq!(request.inputs(0).set, [("floors".to_owned(), "7".to_owned())]);
        set(&mut request, json!({ "floors": null }), &params).unwrap();
        assert!(request.inputs(0).set.is_empty());
    }

    #[test]
    fn a_default_that_changed_since_the_value_was_set_is_shown_beside_it() {
        let mut request = Request::default();
        set(&mut request, json!({ "floors": 7 }), &[param(4.0, 10.0)]).unwrap();
        let old = |request: &mut Request, default: f64, max: f64| {
            request.params(&[Param { value: Setting::Number(7.0), ..param(default, max) }])[0]
                .old_default
                .clone()
        };
        assert_eq!(old(&mut request, 4.0, 10.0), None);
        assert_eq!(old(&mut request, 5.0, 10.0), Some(json!(4.0)));
        assert_eq!(old(&mut request, 5.0, 6.0), None);
        set(&mut request, json!({ "floors": 7 }), &[param(5.0, 10.0)]).unwrap();
        assert_eq!(old(&mut request, 5.0, 10.0), None);
        let mut early = Request::new(&RunOptions {
            params: vec![("floors".into(), "7".into())].into(),
            ..RunOptions::default()
        });
        assert_eq!(old(&mut early, 4.0, 10.0), None);
        assert_eq!(old(&mut early, 5.0, 10.0), Some(json!(4.0)));
    }

    #[test]
    fn a_seed_is_a_whole_number_of_64_bits() {
        assert_eq!(seed(&json!("18446744073709551615")).unwrap(), u64::MAX);
        assert_eq!(seed(&json!(7)).unwrap(), 7);
        for wrong in
            [json!("-1"), json!("1.5"), json!(""), json!(null), json!("18446744073709551616"), json!(-3)]
        {
            assert!(seed(&wrong).is_err(), "{wrong}");
        }
    }
}
