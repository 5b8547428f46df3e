//! Script parameters (`param`): values that users can change without editing the script.

use super::json_text::parse_points;
use super::point_control::PointControl;
use super::preset::Preset;
use burgeon_base::error::{Error, Result};
use burgeon_kit::{Color, HasControlPoints, Parameter, PointRows, Table, Value};
use burgeon_language::PARAM;

/// Declared parameter and its value in this run.
#[derive(Debug, Clone, PartialEq)]
pub struct Param {
    /// Name with which the parameter is set. A parameter of a package has the package as prefix:
    /// `castle.size`.
    pub name: String,
    /// Package that declares it, if any.
    pub package: Option<String>,
    /// Value in this run.
    pub value: Setting,
    /// Default value from the script.
    pub default: Setting,
    /// Value in the file of drawn curves next to the script, which replaces the default.
    pub stored: Option<Setting>,
    /// Allowed values.
    pub control: Control,
    /// Heading under which pages show it, shared with other parameters; may be empty.
    pub group: String,
    /// Display unit; may be empty.
    pub unit: String,
    /// Description for users; may be empty.
    pub doc: String,
    /// Set if the script itself declares it, not a file that it requires.
    pub own: bool,
}

/// Value of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Setting {
    /// A number.
    Number(f64),
    /// A boolean.
    Boolean(bool),
    /// A choice, a colour or free text.
    Text(String),
    /// Control points of a function, a curve or a surface.
    Points(PointRows),
}

/// Allowed values of a parameter.
#[derive(Debug, Clone, PartialEq)]
pub enum Control {
    /// Number within bounds, on a grid of steps from the lower bound.
    Number {
        /// Minimum.
        min: Option<f64>,
        /// Maximum.
        max: Option<f64>,
        /// Distance between neighbouring values.
        step: Option<f64>,
    },
    /// True or false.
    Switch,
    /// One of these choices.
    Choice(Vec<String>),
    /// Colour as `#rrggbb`.
    Color,
    /// Free text.
    Text,
    /// Control points of a function, a curve or a surface.
    Points(PointControl),
}

impl std::fmt::Display for Setting {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Number(number) => write!(f, "{}", Value::Number(*number)),
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Text(text) => f.write_str(text),
            Self::Points(points) => write!(f, "{points}"),
        }
    }
}

impl Setting {
    /// Returns the value as text that parses to the same value.
    pub fn plain(&self) -> String {
        match self {
            Self::Number(number) => number.to_string(),
            Self::Boolean(value) => value.to_string(),
            Self::Text(text) => text.clone(),
            Self::Points(points) => points.to_string(),
        }
    }

    /// Returns the value as JSON: a number, a boolean, a string or a list of points.
    pub fn to_json(&self) -> serde_json::Value {
        match self {
            Self::Number(number) => (*number).into(),
            Self::Boolean(value) => (*value).into(),
            Self::Text(text) => text.as_str().into(),
            Self::Points(points) => points.to_json(),
        }
    }
}

impl Param {
    /// Returns the parameter of `params` with this name. Otherwise returns the only parameter of a package
    /// that has the name without its package prefix, or `None`.
    ///
    /// Fails with their names if several packages have such a parameter.
    pub fn find<'a>(params: &'a [Self], name: &str) -> Result<Option<&'a Self>> {
        if let Some(exact) = params.iter().find(|param| param.name == name) {
            return Ok(Some(exact));
        }
        let mut of_packages = params.iter().filter(|param| param.short_name() == name);
        match (of_packages.next(), of_packages.next()) {
            (Some(first), Some(second)) => Err(Self::ambiguous(&[first, second])),
            (found, _) => Ok(found),
        }
    }

    /// Returns the name from the declaration, without the package prefix.
    pub fn short_name(&self) -> &str {
        let prefix = self.package.as_ref().map_or(0, |package| package.len() + 1);
        self.name.get(prefix..).unwrap_or(&self.name)
    }

    /// Returns the error for a name without package prefix that several parameters have.
    pub(crate) fn ambiguous(of: &[&Self]) -> Error {
        let owners: Vec<&str> =
            of.iter().map(|param| param.package.as_deref().unwrap_or("the script")).collect();
        let named: Vec<String> = of.iter().map(|param| format!("--set {}=VALUE", param.name)).collect();
        let name = of.first().map_or("", |param| param.short_name());
        Error::argument(format!("{name} is a parameter of {}", owners.join(" and of ")))
            .help(format!("specify one: {}", named.join(" or ")))
    }

    /// Returns the value without options and presets: that of the file of drawn curves, or the default.
    pub fn base_value(&self) -> &Setting {
        self.stored.as_ref().unwrap_or(&self.default)
    }

    /// Returns the value of this run for the script. Fails if points do not define a value.
    pub fn script_value(&self) -> Result<Value> {
        match (&self.value, &self.control) {
            (Setting::Number(number), _) => Ok(Value::Number(*number)),
            (Setting::Boolean(value), _) => Ok(Value::Boolean(*value)),
            (Setting::Text(text), _) => Ok(Value::Text(text.as_str().into())),
            (Setting::Points(points), Control::Points(control)) => control.value(points),
            (Setting::Points(_), _) => Err(Error::internal("a parameter that is not drawn has points")),
        }
    }

    /// Parses the declaration `param(name, { default = ..., ... })`. The value is the default.
    pub fn declare(name: &str, options: &Table) -> Result<Self> {
        for (key, _) in &options.entries {
            let key = match key {
                burgeon_kit::TableKey::Name(name) => name.to_string(),
                burgeon_kit::TableKey::Index(index) => index.to_string(),
            };
            let known = PARAM.part_names();
            if !known.contains(&key.as_str()) {
                let message = format!("unknown field `{key}` in param {name}");
                return Err(Error::not_found("field", &key, known.iter().copied(), message)
                    .help(format!("it has {}", known.join(", "))));
            }
        }
        let number = |field: &str| -> Result<Option<f64>> {
            match options.get(field) {
                None => Ok(None),
                Some(value) => f64::read_value(value)
                    .map(Some)
                    .map_err(|expected| expected.refuse(&format!("param {name}"), field, value)),
            }
        };
        let text = |field: &str| -> Result<String> {
            match options.get(field) {
                None => Ok(String::new()),
                Some(value) => String::read_value(value)
                    .map_err(|expected| expected.refuse(&format!("param {name}"), field, value)),
            }
        };
        let (min, max, step) = (number("min")?, number("max")?, number("step")?);
        if let (Some(min), Some(max)) = (min, max)
            && min > max
        {
            return Err(Error::argument(format!("param {name}: min {min} is above max {max}")));
        }
        if step.is_some_and(|step| step <= 0.0) {
            return Err(Error::argument(format!("param {name}: step must be above 0")));
        }
        let (default, control) = match (options.get("default"), options.get("choices")) {
            (None, _) => {
                return Err(Error::argument(format!("param {name} has no default"))
                    .help(format!("write param(\"{name}\", {{ default = ... }})")));
            }
            (Some(default), Some(_)) if !matches!(default, Value::Text(_)) => {
                return Err(Error::argument(format!(
                    "param {name}: the default must be a string, as the choices, not {default}"
                )));
            }
            (Some(Value::Text(default)), Some(choices)) => {
                let choices = Vec::<String>::read_value(choices)
                    .map_err(|expected| expected.refuse(&format!("param {name}"), "choices", choices))?;
                (Setting::Text(default.to_string()), Control::Choice(choices))
            }
            (Some(value @ Value::Text(default)), None) => {
                // A word without `#` is a string, because it may be the name of anything.
                let is_color = default.starts_with('#') && Color::read_value(value).is_ok();
                (Setting::Text(default.to_string()), if is_color { Control::Color } else { Control::Text })
            }
            (Some(Value::Boolean(default)), _) => (Setting::Boolean(*default), Control::Switch),
            (Some(Value::Number(default)), _) => {
                (Setting::Number(*default), Control::Number { min, max, step })
            }
            (Some(other), _) => match PointControl::new(other) {
                Some(control) => (Setting::Points(control.form().points.clone()), Control::Points(control)),
                None => return Err(Self::refuse_default(name, other)),
            },
        };
        let bounds = [("min", min), ("max", max), ("step", step)];
        if !matches!(control, Control::Number { .. })
            && let Some((field, _)) = bounds.into_iter().find(|(_, bound)| bound.is_some())
        {
            return Err(Error::argument(format!("param {name} is not a number, so it cannot have {field}"))
                .help(format!("remove {field}, or give a number as default")));
        }
        let param = Self {
            name: name.to_owned(),
            package: None,
            value: default.clone(),
            default,
            stored: None,
            control,
            group: text("group")?.trim().to_owned(),
            unit: text("unit")?,
            doc: text("doc")?,
            own: true,
        };
        param.check(&param.default).map_err(|error| {
            let message = format!("the default of {}", error.message());
            error.saying(message).help("change the default or its bounds")
        })?;
        Ok(param)
    }

    fn refuse_default(name: &str, default: &Value) -> Error {
        let (message, help) = match default {
            Value::Object(object) if object.kind().has_capability::<dyn HasControlPoints>() => (
                format!("param {name}: the default, a {default}, has no points of its own"),
                "give one that is made of points, not one between two others",
            ),
            _ => (
                format!(
                    "param {name}: default must be a number, a boolean, a string, a function, a curve or a surface, not {}",
                    default.describe()
                ),
                "functions, curves and surfaces are drawn: default = ramp({ { 0, 1 }, { 1, 0.2 } })",
            ),
        };
        Error::argument(message).help(help)
    }

    /// Returns the value for this run, with values from `set` before values from `preset`, and those before the file of
    /// drawn curves.
    ///
    /// If `alone` is set, the name without its package prefix also denotes this parameter.
    pub(crate) fn given(
        &self,
        set: &[(String, String)],
        preset: Option<&Preset>,
        alone: bool,
    ) -> Result<Setting> {
        let names = [Some(&*self.name), (alone && self.package.is_some()).then(|| self.short_name())];
        let names = || names.into_iter().flatten();
        let mut given = names().filter_map(|name| set.iter().rev().find(|(known, _)| known == name));
        if let Some((_, given)) = given.next() {
            return self.accept(given);
        }
        let given = preset.and_then(|preset| {
            let mut given = names().filter_map(|name| preset.params.iter().find(|(known, _)| known == name));
            Some((preset, given.next()?))
        });
        match given {
            Some((preset, (name, given))) => {
                self.accept(&given.plain()).map_err(|error| preset.refused(name, &error))
            }
            None => Ok(self.base_value().clone()),
        }
    }

    /// Parses the text `given` as a value. Fails if the parameter does not allow the value.
    pub fn accept(&self, given: &str) -> Result<Setting> {
        let setting = self.read(given)?;
        self.check(&setting)?;
        Ok(setting)
    }

    fn read(&self, given: &str) -> Result<Setting> {
        let refuse = |what: &str| {
            Err(Error::argument(format!("param {} must be {what}, not {given:?}", self.name))
                .help(format!("its default is {}", self.default)))
        };
        match &self.control {
            Control::Number { .. } => match given.trim().parse::<f64>() {
                Ok(number) if number.is_finite() => Ok(Setting::Number(number)),
                _ => refuse("a number"),
            },
            Control::Switch => match given {
                "true" | "on" | "yes" | "1" => Ok(Setting::Boolean(true)),
                "false" | "off" | "no" | "0" => Ok(Setting::Boolean(false)),
                _ => refuse("true or false"),
            },
            Control::Color => match Color::from_value(Value::Text(given.into())) {
                Ok(_) if given.starts_with('#') && matches!(given.len(), 7 | 9) => {
                    Ok(Setting::Text(given.to_owned()))
                }
                Ok(color) => match color.into_value() {
                    Value::Text(digits) => Ok(Setting::Text(digits.to_string())),
                    _ => refuse("a colour, #rrggbb"),
                },
                Err(_) => refuse("a colour, #rrggbb"),
            },
            Control::Points(_) => Ok(Setting::Points(parse_points(given, &format!("param {}", self.name))?)),
            Control::Choice(_) | Control::Text => Ok(Setting::Text(given.to_owned())),
        }
    }

    fn check(&self, setting: &Setting) -> Result<()> {
        let name = &self.name;
        match (&self.control, setting) {
            (Control::Number { min, max, step }, Setting::Number(number)) => {
                let shown = Value::Number(*number);
                if min.is_some_and(|min| *number < min) || max.is_some_and(|max| *number > max) {
                    let range = match (min, max) {
                        (Some(min), Some(max)) => format!("the allowed values are {min} to {max}"),
                        (Some(min), None) => format!("the minimum is {min}"),
                        (None, Some(max)) => format!("the maximum is {max}"),
                        (None, None) => String::new(),
                    };
                    return Err(
                        Error::argument(format!("param {name} is {shown}, out of its range")).help(range)
                    );
                }
                if let Some(step) = step {
                    let steps = (number - min.unwrap_or(0.0)) / step;
                    if (steps - steps.round()).abs() > 1e-6 {
                        let near: Vec<String> = [steps.floor(), steps.ceil()]
                            .iter()
                            .map(|steps| min.unwrap_or(0.0) + steps * step)
                            .filter(|near| max.is_none_or(|max| *near <= max))
                            .map(|near| Value::Number(near).to_string())
                            .collect();
                        return Err(Error::argument(format!(
                            "param {name} is {shown}, between two steps of {step}"
                        ))
                        .help(format!("choose {}", near.join(" or "))));
                    }
                }
                Ok(())
            }
            (Control::Choice(choices), Setting::Text(choice)) if !choices.contains(choice) => {
                Err(Error::argument(format!("param {name} is {choice:?}, which is not one of the choices"))
                    .help(format!("choose one of {}", choices.join(", "))))
            }
            (Control::Points(control), Setting::Points(points)) => {
                control.value(points).map(|_| ()).map_err(|error| error.about(&format!("param {name}")))
            }
            _ => Ok(()),
        }
    }
}
