//! Results of runs, and the files that are written from them.

use std::path::Path;
use std::sync::Arc;

use burgeon::export::{Export, Files, Format, Need, SceneFacts, SystemFacts};
use burgeon::picture::Picture;
use burgeon::results::layers;
use burgeon::scene::Part;
use burgeon::script::Session;
use burgeon::{Error, Result, Run, Stop, Warning};
use serde_json::Value;

/// Run of a script, which buffers and exports share.
pub(crate) struct ModelData {
    pub run: Run,
    pub session: Arc<Session>,
}

impl ModelData {
    /// Returns a part of a mesh, if it exists.
    pub(crate) fn part(&self, mesh: usize, part: usize) -> Option<&Part> {
        self.run.scene.meshes.get(mesh)?.parts.get(part)
    }

    /// Returns the attributes of the features of each system.
    pub(crate) fn systems(&self) -> Vec<SystemFacts> {
        let known = self.run.systems.iter().filter_map(|system| {
            let records = system.records();
            let is_known = records.is_some() || system.city.is_some();
            let (records, class) = (records.unwrap_or_default(), system.city);
            is_known.then_some(SystemFacts { system: system.system, records, class })
        });
        known.collect()
    }

    /// Writes the model to `path`, and returns the warnings about it.
    pub(crate) fn write(&self, path: &Path, settings: &ExportSettings, stop: &Arc<Stop>) -> Result<Value> {
        let format = Format::of(path)?;
        if self.run.systems.is_empty() {
            return Err(Error::script("the script derives no system, so there is nothing to write")
                .help("end it with system:derive()"));
        }
        let systems = self.systems();
        let mut tables =
            if format.needs(Need::Layers) { layers(&self.session, &self.run.systems) } else { Vec::new() };
        if let Some(wanted) = &settings.layer {
            let names: Vec<String> = tables.iter().map(|table| table.name.clone()).collect();
            tables.retain(|table| table.name == *wanted);
            if tables.is_empty() {
                let names = names.iter().map(String::as_str);
                let message = format!("the model has no layer named {wanted:?}");
                let error = Error::not_found("layer", wanted, names.clone(), message);
                return Err(error.help(format!("it has {}", names.collect::<Vec<_>>().join(", "))));
            }
        }
        let columns = systems.iter().flat_map(|system| &system.records.columns).cloned();
        let metadata: Option<Vec<String>> = settings.metadata.then(|| columns.collect());
        let reports: Vec<_> =
            self.run.systems.iter().map(|system| (system.system, system.reports())).collect();
        let has_recipe = settings.recipe && format.needs(Need::Recipe);
        let recipe = has_recipe.then(|| self.session.recipe(&self.run.params).complete()).transpose()?;
        let facts = SceneFacts {
            reports: &reports,
            recipe: recipe.as_ref(),
            frame: self.run.service(),
            detail: self.session.options.lod,
            systems: &systems,
            layers: &tables,
            metadata: metadata.as_deref(),
            ..SceneFacts::default()
        };
        let mut files = Files::new(stop);
        files.export(&Export { scene: &self.run.scene, picture: &settings.picture, facts }, path)?;
        let warnings = files.take_warnings();
        if let (true, Some(first)) = (self.session.options.strict, warnings.first()) {
            return Err(first.clone().into_error());
        }
        files.publish()?;
        Ok(warnings.iter().map(warning_json).collect())
    }
}

/// Settings of a file.
pub(crate) struct ExportSettings {
    picture: Picture,
    metadata: bool,
    recipe: bool,
    layer: Option<String>,
}

impl ExportSettings {
    pub(crate) fn parse(text: &str) -> Result<Self> {
        let invalid =
            |error: serde_json::Error| Error::argument(format!("invalid settings of a file: {error}"));
        let mut settings: Value = serde_json::from_str(text).map_err(invalid)?;
        Ok(Self {
            picture: serde_json::from_value(settings["picture"].take()).map_err(invalid)?,
            metadata: settings["metadata"].as_bool().unwrap_or(false),
            recipe: settings["recipe"].as_bool().unwrap_or(true),
            layer: settings["layer"].as_str().map(str::to_owned),
        })
    }
}

/// Returns a warning as JSON, with its complete text.
pub(crate) fn warning_json(warning: &Warning) -> Value {
    let mut object = warning.to_json();
    object["text"] = warning.to_string().into();
    object
}
