//! Models for Python: facts, rows, arrays and files.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon::Stop;
use burgeon::export::{FORMATS, Need};
use burgeon::kit::Attribute;
use burgeon::results::layers;
use burgeon::scene::{Material, SceneCounts, SceneDifference, ShownFeature};
use burgeon::sources::ReferenceFrame;
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::buffer::Buffer;
use crate::errors::exception;
use crate::model_data::{ExportSettings, ModelData, warning_json};
use crate::supervised::supervise_quietly;

/// Model that a script has made.
#[pyclass(frozen, module = "burgeon._burgeon")]
pub(crate) struct ScriptModel(Arc<ModelData>);

impl ScriptModel {
    pub(crate) fn new(data: ModelData) -> Self {
        Self(Arc::new(data))
    }
}

#[pymethods]
impl ScriptModel {
    /// Returns all facts except arrays and rows, as JSON.
    fn facts(&self, py: Python<'_>) -> String {
        py.detach(|| facts_json(&self.0).to_string())
    }

    /// Returns the attributes of the features of all systems as JSON: a list of rows for each system.
    fn features(&self, py: Python<'_>) -> String {
        py.detach(|| features_json(&self.0).to_string())
    }

    /// Returns the names, columns and numbers of rows of the layers as JSON.
    fn layers(&self, py: Python<'_>) -> String {
        py.detach(|| {
            let tables = layers(&self.0.session, &self.0.run.systems);
            let tables = tables.iter().map(
                |table| json!({ "name": table.name, "columns": table.columns, "count": table.records.len() }),
            );
            tables.collect::<Value>().to_string()
        })
    }

    /// Returns the differences between the model and a later one as JSON.
    fn difference(&self, py: Python<'_>, after: &Self) -> String {
        py.detach(|| difference_json(&self.0.run.scene.difference(&after.0.run.scene)).to_string())
    }

    /// Returns the feature and the name of each instance, and the index of its mesh, as JSON.
    fn instances(&self, py: Python<'_>) -> String {
        py.detach(|| {
            let instances = self.0.run.scene.instances.iter();
            let rows = instances.map(|instance| json!([instance.mesh, instance.name, instance.feature]));
            rows.collect::<Value>().to_string()
        })
    }

    /// Returns the positions (m) of a part.
    fn positions(&self, mesh: usize, part: usize) -> Option<Buffer> {
        Buffer::positions(&self.0, mesh, part)
    }

    /// Returns the unit normals of a part.
    fn normals(&self, py: Python<'_>, mesh: usize, part: usize) -> Option<Buffer> {
        py.detach(|| Buffer::normals(&self.0, mesh, part))
    }

    /// Returns the texture coordinates (m) of a part.
    fn uvs(&self, mesh: usize, part: usize) -> Option<Buffer> {
        Buffer::texture_coordinates(&self.0, mesh, part)
    }

    /// Returns the texture coordinates (m) of the dirt map of a part.
    fn second_uvs(&self, py: Python<'_>, mesh: usize, part: usize) -> Option<Buffer> {
        py.detach(|| Buffer::second_texture_coordinates(&self.0, mesh, part))
    }

    /// Returns the corners of the triangles of a part.
    fn triangles(&self, py: Python<'_>, mesh: usize, part: usize) -> Option<Buffer> {
        py.detach(|| Buffer::triangles(&self.0, mesh, part))
    }

    /// Returns the transforms of all instances.
    fn transforms(&self, py: Python<'_>) -> Buffer {
        py.detach(|| Buffer::transforms(&self.0))
    }

    /// Writes the model to a file in the format of its extension. `settings` is JSON. Returns the warnings as JSON.
    fn export(&self, py: Python<'_>, path: PathBuf, settings: &str) -> PyResult<String> {
        let settings = ExportSettings::parse(settings).map_err(|error| exception(py, &error))?;
        let (data, stop) = (Arc::clone(&self.0), Arc::new(Stop::new()));
        let working = Arc::clone(&stop);
        let work = move || {
            let _work = working.at_work();
            data.write(&path, &settings, &working)
        };
        supervise_quietly(py, &stop, work).map(|warnings| warnings.to_string())
    }
}

/// Returns the extensions, titles and needs of all formats of models as JSON.
#[pyfunction]
pub(crate) fn formats() -> String {
    let rows = FORMATS.iter().filter(|format| format.file.check().is_ok()).map(|format| {
        json!({
            "extension": format.extension(),
            "title": format.file.title,
            "layers": format.needs(Need::Layers),
            "files": if format.file.companion.is_some() || format.has_textures { "several" } else { "one" },
        })
    });
    rows.collect::<Value>().to_string()
}

fn facts_json(data: &ModelData) -> Value {
    let run = &data.run;
    let bounds = run.scene.bounds().map(|(low, high)| [low.to_array(), high.to_array()]);
    let meshes = run.scene.meshes.iter().map(|mesh| {
        let parts = mesh.parts.iter().map(|part| {
            json!({
                "material": part.material,
                "vertices": part.positions.len(),
                "triangles": part.triangles.len(),
            })
        });
        json!({ "name": mesh.name, "parts": parts.collect::<Value>() })
    });
    let materials = run.scene.materials.iter().map(material_json);
    let mut report = run.report().counts_json();
    let mut remarks = Vec::new();
    // Writing to memory does not fail.
    if run.report().write_json(&mut remarks).is_ok()
        && let Ok(whole) = serde_json::from_slice::<Value>(&remarks)
    {
        report = whole;
    }
    json!({
        "script": data.session.script().to_string_lossy(),
        "seed": data.session.options.seed,
        "triangles": run.scene.triangles(),
        "modules": run.systems.iter().map(|system| system.modules()).sum::<usize>(),
        "steps": run.systems.iter().map(|system| system.steps).collect::<Vec<_>>(),
        "bounds": bounds,
        "values": run.params.iter().map(|param| (param.name.as_str(), param.value.to_json())).collect::<Value>(),
        "warnings": run.warnings.iter().map(warning_json).collect::<Value>(),
        "notes": run.notes,
        "report": report,
        "place": run.service::<ReferenceFrame>().map(|frame| frame.world_place().to_json()),
        "meshes": meshes.collect::<Value>(),
        "materials": materials.collect::<Value>(),
        "seconds": {
            "script": run.times.script.as_secs_f64(),
            "rewriting": run.times.derivation.rewriting.as_secs_f64(),
            "interpretation": run.times.derivation.interpretation.as_secs_f64(),
            "scene": run.times.scene.as_secs_f64(),
        },
    })
}

fn material_json(material: &Material) -> Value {
    json!({
        "name": material.name,
        "color": material.base_color,
        "metallic": material.metallic,
        "roughness": material.roughness,
        "emissive": material.emissive,
        "double_sided": material.double_sided,
        "texture": material.texture.as_ref().map(|texture| texture.path.to_string_lossy()),
        "texture_size": material.image_size(),
        "normal_map": material.normal_map.as_ref().map(|map| map.image.path.to_string_lossy()),
        "normal_scale": material.normal_map.as_ref().map_or(1.0, |map| map.scale),
        "dirt_map": material.dirt_map.as_ref().map(|map| map.image.path.to_string_lossy()),
        "dirt_size": material.dirt_map.as_ref().map(|map| map.image.size),
    })
}

fn difference_json(difference: &SceneDifference) -> Value {
    let features = |features: &[ShownFeature]| {
        features.iter().map(|feature| json!([feature.system, feature.id])).collect::<Value>()
    };
    let materials = |materials: &[Material]| materials.iter().map(material_json).collect::<Value>();
    let counts = |counts: SceneCounts| {
        json!({
            "triangles": counts.triangles,
            "instances": counts.instances,
            "meshes": counts.meshes,
            "materials": counts.materials,
        })
    };
    let bounds = difference.bounds.map(|bounds| bounds.map(|(low, high)| [low.to_array(), high.to_array()]));
    json!({
        "is_empty": difference.is_empty(),
        "added": features(&difference.added),
        "removed": features(&difference.removed),
        "changed": features(&difference.changed),
        "unchanged": difference.unchanged,
        "others_changed": difference.others_changed,
        "materials_added": materials(&difference.materials.added),
        "materials_removed": materials(&difference.materials.removed),
        "materials_changed": difference.materials.changed.iter().map(|pair| materials(pair)).collect::<Value>(),
        "counts": difference.counts.map(counts),
        "bounds": bounds,
    })
}

fn features_json(data: &ModelData) -> Value {
    let tables = data.systems().into_iter().map(|system| {
        let table = system.records;
        let rows = table.records.iter().map(|record| {
            let mut values = serde_json::Map::new();
            for (column, value) in &record.values {
                if let Some(name) = table.columns.get(*column) {
                    values.insert(name.clone(), attribute_json(value));
                }
            }
            json!({ "id": record.id, "values": values })
        });
        json!({ "system": system.system, "source": table.name, "rows": rows.collect::<Value>() })
    });
    tables.collect()
}

fn attribute_json(value: &Attribute) -> Value {
    match value {
        Attribute::Boolean(value) => (*value).into(),
        Attribute::Number(number) => (*number).into(),
        Attribute::Text(text) => (&**text).into(),
        Attribute::Nested(value) => (**value).clone(),
    }
}
