//! A preset: values of a script's parameters and a seed, under a name.

use super::param::{Param, Setting};
use burgeon_base::error::{Error, SourcePlace};

/// Values of a script's parameters and a seed, under a name.
///
/// Parameters that it does not name keep the script's own values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Preset {
    /// Its name.
    pub name: String,
    /// The seed of all random numbers, if it has one.
    pub seed: Option<u64>,
    /// Values by the parameters' names, in the order of the file.
    pub params: Vec<(String, Setting)>,
    /// Where it begins in its file, if it came from one.
    pub place: Option<SourcePlace>,
    /// Where each of `params` stands; empty if it came from no file.
    pub places: Vec<SourcePlace>,
}

impl Preset {
    /// The values as text, as [`ParamValues::set`](super::ParamValues::set) takes them.
    pub fn set(&self) -> Vec<(String, String)> {
        self.params.iter().map(|(name, value)| (name.clone(), value.plain())).collect()
    }

    /// The same as a preset of `package`, whose names mean that package's own parameters: those of others have their package
    /// before them, as in `masonry.stone`.
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

    /// Whether `other` has the same name, seed and values, wherever they stand.
    pub fn is_like(&self, other: &Self) -> bool {
        (&self.name, self.seed, &self.params) == (&other.name, other.seed, &other.params)
    }

    /// Where the value of the parameter `name` stands.
    pub(crate) fn place_of(&self, name: &str) -> Option<SourcePlace> {
        let index = self.params.iter().position(|(known, _)| known == name)?;
        self.places.get(index).or(self.place.as_ref()).cloned()
    }

    /// The error for the value of a parameter `name` that `script` does not have.
    pub(crate) fn outdated(&self, name: &str, script: &str, params: &[Param]) -> Error {
        let preset = &self.name;
        let names = params.iter().map(|param| param.name.as_str());
        let message = format!("preset {preset} sets {name}, but {script} has no parameter called {name}");
        Error::not_found("parameter", name, names, message)
            .help(format!("remove {name} from the preset, or declare it again: param(\"{name}\", ...)"))
            .at(self.place_of(name))
    }

    /// An `error` that the value of the parameter `name` led to.
    pub(crate) fn refused(&self, name: &str, error: &Error) -> Error {
        let said = Error::of(error.kind().clone(), format!("preset {}: {}", self.name, error.message()));
        let said = match error.remedy() {
            Some(help) => said.help(format!("{help}; change the preset")),
            None => said.help("change the preset"),
        };
        said.at(self.place_of(name))
    }
}
