//! Lists of features from a script, as tables for queries.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_data::{Attribute, Feature, Layer};
use burgeon_kit::{Parameter, Table, TableKey, Value};
use burgeon_spatial::GeometryInput;

/// List of features of a script, in metres around the origin of the run.
#[derive(Debug, Default, Clone)]
pub(super) struct ScriptList {
    /// Attribute names.
    names: Vec<String>,
    features: Vec<Feature>,
}

impl ScriptList {
    /// Converts a list to a table. Each feature has its `id` or its number, its geometry, and all attributes that a table
    /// can store.
    pub(super) fn new(features: &Value) -> Result<Self> {
        let mut made = Self::default();
        let Value::Table(list) = features else { return Ok(made) };
        for (number, feature) in list.list().into_iter().enumerate() {
            let refuse = |why: &str| {
                Error::argument(format!("feature {} of the list {why}, so it is in no table", number + 1))
                    .help("write { id = \"a\", geometry = polygon({ ... }), height = 3 }")
            };
            let Value::Table(feature) = feature else { return Err(refuse("is no table")) };
            let geometry = feature.get("geometry").ok_or_else(|| refuse("has no geometry"))?;
            let shape = GeometryInput::read_value(geometry)
                .map_err(|_| refuse("has no geometry that can be read"))?;
            let id = match feature.get("id") {
                Some(Value::Text(id)) => id.to_string(),
                Some(Value::Nil) | None => (number + 1).to_string(),
                Some(other) => other.to_string(),
            };
            let attributes = attributes(feature, &mut made.names);
            made.features.push(Feature {
                id: id.as_str().into(),
                geometry: shape.geometry().clone(),
                attributes,
            });
        }
        Ok(made)
    }

    /// Returns the list as a layer called `name`, with `label` for messages, around `origin` (m).
    pub(super) fn to_layer(&self, name: &str, label: String, origin: [f64; 2]) -> Layer {
        Layer {
            name: name.to_owned(),
            shown: label,
            crs: String::new(),
            origin,
            names: self.names.clone(),
            features: self.features.clone(),
            bounds: [[0.0; 3]; 2],
            empty: 0,
            collapsed: 0,
            refused: Vec::new(),
            notes: Vec::new(),
            derived: 0,
        }
    }
}

/// Returns the other attributes of a feature, with their indices in `names`.
fn attributes(feature: &Table, names: &mut Vec<String>) -> Arc<[(usize, Attribute)]> {
    let mut attributes = Vec::new();
    for (key, value) in &feature.entries {
        let TableKey::Name(name) = key else { continue };
        let value = match value {
            _ if ["id", "geometry", "layer"].contains(&&**name) => continue,
            Value::Boolean(value) => Attribute::Boolean(*value),
            Value::Number(value) if value.is_finite() => Attribute::Number(*value),
            Value::Text(text) => Attribute::Text(Arc::clone(text)),
            _ => continue,
        };
        let number = names.iter().position(|known| **known == **name).unwrap_or_else(|| {
            names.push(name.to_string());
            names.len() - 1
        });
        attributes.push((number, value));
    }
    attributes.into()
}
