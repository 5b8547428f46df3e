//! Presets: named values of parameters with a seed.

use super::param::{Param, Setting};
use burgeon_base::error::{Error, SourcePlace};

/// Named values of a script's parameters, with a seed.
///
/// Other parameters keep the defaults of the script.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Preset {
    /// Name of the preset.
    pub name: String,
    /// Name of the preset of the same file whose seed and values this one extends.
    pub extends: Option<String>,
    /// Seed of all random numbers, if the preset has one.
    pub seed: Option<u64>,
    /// Values by parameter name, in the order of the file.
    pub params: Vec<(String, Setting)>,
    /// Location of the preset in its file, if it came from one.
    pub place: Option<SourcePlace>,
    /// Location of each entry of `params`; empty if the preset came from no file.
    pub places: Vec<SourcePlace>,
}

impl Preset {
    /// Returns the values as text, in the format of [`ParamValues::set`](super::ParamValues::set).
    pub fn set(&self) -> Vec<(String, String)> {
        self.params.iter().map(|(name, value)| (name.clone(), value.plain())).collect()
    }

    /// Returns the preset with the seed and the values of `base` where it has none.
    #[must_use]
    pub fn over(mut self, base: &Self) -> Self {
        self.seed = self.seed.or(base.seed);
        for (index, (name, value)) in base.params.iter().enumerate() {
            if self.params.iter().all(|(known, _)| known != name) {
                self.params.push((name.clone(), value.clone()));
                self.places.extend(base.places.get(index).or(base.place.as_ref()).cloned());
            }
        }
        self
    }

    /// Returns the preset as a preset of `package`: names without prefix become parameters of that package.
    /// Names of other packages' parameters have a prefix, as in `masonry.stone`.
    #[must_use]
    pub fn of_package(mut self, package: &str) -> Self {
        for (name, _) in &mut self.params {
            let has_package =
                name.split_once('.').is_some_and(|(package, _)| burgeon_packages::is_name(package));
            if !has_package {
                *name = format!("{package}.{name}");
            }
        }
        self
    }

    /// Returns true if `other` has the same name, seed and values, regardless of locations.
    pub fn is_like(&self, other: &Self) -> bool {
        (&self.name, self.seed, &self.params) == (&other.name, other.seed, &other.params)
    }

    /// Returns the location of the value of the parameter `name`.
    pub(crate) fn place_of(&self, name: &str) -> Option<&SourcePlace> {
        let index = self.params.iter().position(|(known, _)| known == name)?;
        self.places.get(index).or(self.place.as_ref())
    }

    /// Returns the error for a value of a parameter `name` that `script` does not have.
    pub(crate) fn outdated(&self, name: &str, script: &str, params: &[Param]) -> Error {
        let preset = &self.name;
        let names = params.iter().map(|param| param.name.as_str());
        let message = format!("preset {preset} sets the unknown parameter `{name}` of {script}");
        Error::not_found("parameter", name, names, message)
            .help(format!("remove {name} from the preset, or declare it again: param(\"{name}\", ...)"))
            .at_place(self.place_of(name))
    }

    /// Adds the preset and the location of the value of parameter `name` to an error.
    pub(crate) fn refused(&self, name: &str, error: &Error) -> Error {
        let said = Error::of(error.kind().clone(), format!("preset {}: {}", self.name, error.message()));
        let said = match error.remedy() {
            Some(help) => said.help(format!("{help}; change the preset")),
            None => said.help("change the preset"),
        };
        said.at_place(self.place_of(name))
    }
}
