//! Assembles a CityJSON document.

use std::io::{self, Write as _};
use std::path::Path;

use crate::layers::OutputPlacement;
use burgeon_base::error::Result;
use burgeon_scene::Scene;
use burgeon_spatial::Attribute;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use serde_json::{Map, Value as Json, json};

use super::super::check::check;
use super::super::files::{Files, Out};
use super::super::stem;
use super::boundaries::{boundaries, level_name, semantics};
use super::object::{CityObject, ObjectShape, Quantiser, STEPS, objects, placed_transform};
use super::templates::ShapeTemplates;
use crate::{Export, SceneFacts};

/// Number of objects whose shapes are computed at a time.
const CHUNK: usize = 512;

/// Writes a `.city.json` file to `path`.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check(export.scene)?;
    let outward = OutputPlacement::metric(export.facts.frame)?;
    let quantiser = Quantiser::new(checked.scene, &outward);
    let objects = objects(&checked, &export.facts);
    let mut document = CityWriter::new(export.scene, &export.facts, &quantiser);
    let mut failed = Ok(());
    files.write(path, |out| {
        write!(out, "{{\"type\":\"CityJSON\",\"version\":\"2.0\",\"CityObjects\":{{")?;
        let mut first = true;
        for chunk in objects.chunks(CHUNK) {
            let shapes: Vec<Result<ObjectShape>> =
                chunk.par_iter().map(|object| object.shape(export.scene, &quantiser)).collect();
            for (object, shape) in chunk.iter().zip(shapes) {
                match shape.and_then(|shape| document.object(object, &shape)) {
                    Ok(described) => write_object(described, &mut first, out)?,
                    Err(error) => {
                        failed = Err(error);
                        return Ok(());
                    }
                }
            }
        }
        write!(out, "\n}}")?;
        document.write_rest(stem(path).trim_end_matches(".city"), out)
    })?;
    failed
}

/// Writes a `.city.jsonl` file to `path`.
pub(crate) fn write_sequence(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    write_city_sequence(export.scene, &export.facts, path, files).map(|_| ())
}

/// Writes a CityJSON sequence of a scene to the future file `path`, and returns the number of its features: the first line has what
/// all objects share, and each other line an object with those that belong to it, which a reader can handle one by one.
///
/// Fails if a point is outside the domain of the projection, and as [`Files::write`] does.
pub fn write_city_sequence(
    scene: &Scene,
    facts: &SceneFacts<'_>,
    path: &Path,
    files: &mut Files,
) -> Result<usize> {
    let checked = check(scene)?;
    let outward = OutputPlacement::metric(facts.frame)?;
    let quantiser = Quantiser::new(checked.scene, &outward);
    let mut document = CityWriter::new(scene, facts, &quantiser);
    let (mut lines, mut count) = (String::new(), 0);
    for chunk in objects(&checked, facts).chunks(CHUNK) {
        files.stop().check()?;
        let shapes: Vec<Result<ObjectShape>> =
            chunk.par_iter().map(|object| object.shape(scene, &quantiser)).collect();
        for (object, shape) in chunk.iter().zip(shapes) {
            let entries = document.object(object, &shape?)?;
            let objects: Map<String, Json> = entries.into_iter().collect();
            let vertices = document.take_vertices();
            let feature = json!({
                "type": "CityJSONFeature", "id": object.id, "CityObjects": objects, "vertices": vertices,
            });
            lines.push_str(&feature.to_string());
            lines.push('\n');
            count += 1;
        }
    }
    let mut first = json!({
        "type": "CityJSON", "version": "2.0", "transform": document.transform(),
        "metadata": document.metadata(stem(path).trim_end_matches(".city")), "CityObjects": {}, "vertices": [],
    });
    if let Some(templates) = document.templates.finish() {
        first["geometry-templates"] = templates;
    }
    files.write(path, |out| write!(out, "{first}\n{lines}"))?;
    Ok(count)
}

/// Described object and the objects that belong to it, each with its id.
type CityEntries = Vec<(String, Json)>;

fn write_object(described: CityEntries, first: &mut bool, out: &mut Out) -> io::Result<()> {
    for (id, object) in described {
        write!(out, "{}", if *first { "\n" } else { ",\n" })?;
        *first = false;
        serde_json::to_writer(&mut *out, &id)?;
        write!(out, ":")?;
        serde_json::to_writer(&mut *out, &object)?;
    }
    Ok(())
}

/// State of a document during writing.
struct CityWriter<'a> {
    scene: &'a Scene,
    facts: &'a SceneFacts<'a>,
    quantiser: &'a Quantiser<'a>,
    vertices: Vec<[i64; 3]>,
    numbers: FxHashMap<[i64; 3], u32>,
    /// Minimum and maximum of all vertices so far; `None` without vertices.
    extent: Option<[[i64; 3]; 2]>,
    templates: ShapeTemplates,
}

impl<'a> CityWriter<'a> {
    fn new(scene: &'a Scene, facts: &'a SceneFacts<'a>, quantiser: &'a Quantiser<'a>) -> Self {
        let (vertices, numbers, templates) = (Vec::new(), FxHashMap::default(), ShapeTemplates::default());
        Self { scene, facts, quantiser, vertices, numbers, extent: None, templates }
    }

    /// Takes the vertices, so that the next object has its own.
    fn take_vertices(&mut self) -> Vec<[i64; 3]> {
        self.numbers.clear();
        std::mem::take(&mut self.vertices)
    }

    fn vertex(&mut self, at: [i64; 3]) -> u32 {
        *self.numbers.entry(at).or_insert_with(|| {
            self.vertices.push(at);
            let [low, high] = self.extent.unwrap_or([at; 2]);
            let axes = [0, 1, 2];
            self.extent =
                Some([axes.map(|axis| low[axis].min(at[axis])), axes.map(|axis| high[axis].max(at[axis]))]);
            (self.vertices.len() - 1) as u32
        })
    }

    /// Returns the entries of an object and of the objects that are fixed to it.
    fn object(&mut self, object: &CityObject<'_>, shape: &ObjectShape) -> Result<CityEntries> {
        let detail = self.facts.detail;
        let numbers: Vec<u32> = shape.points.iter().map(|at| self.vertex(*at)).collect();
        let mut geometry = Vec::new();
        if !shape.faces.is_empty() {
            let closed = shape.closed && detail > 0 && object.class.takes_solids();
            let kind = match (closed, object.class.is_relief()) {
                (true, _) => "Solid",
                (_, true) => "CompositeSurface",
                _ => "MultiSurface",
            };
            let boundaries = boundaries(&shape.faces, |point| numbers[point as usize]);
            let boundaries = if closed { json!([boundaries]) } else { boundaries };
            let mut described = json!({ "type": kind, "lod": level_name(detail), "boundaries": boundaries });
            if let Some(semantics) = semantics(&shape.faces, closed) {
                described["semantics"] = semantics;
            }
            geometry.push(described);
        }
        let mut instances = Vec::new();
        for instance in &object.placed {
            let surfaces = object.class.has_surfaces();
            let template = self.templates.number(self.scene, instance, surfaces, detail);
            let (matrix, at) = placed_transform(instance, self.quantiser)?;
            let rows = [0, 1, 2].map(|row| [matrix.col(0)[row], matrix.col(1)[row], matrix.col(2)[row], 0.0]);
            let rows: Vec<f64> =
                rows.into_iter().flatten().map(|it| it + 0.0).chain([0.0, 0.0, 0.0, 1.0]).collect();
            let vertex = self.vertex(at);
            instances.push(json!({
                "type": "GeometryInstance", "template": template, "boundaries": [vertex], "transformationMatrix": rows,
            }));
        }
        let mut described = Map::new();
        described.insert("type".into(), object.class.name().into());
        let attributes = attributes(object);
        if !attributes.is_empty() {
            described.insert("attributes".into(), attributes.into());
        }
        let installation = object.class.installation().filter(|_| !instances.is_empty());
        let mut fixed = None;
        if let Some(class) = installation {
            let id = format!("{} installation", object.id);
            described.insert("children".into(), json!([id]));
            fixed = Some((id, json!({ "type": class, "parents": [object.id], "geometry": instances })));
        } else {
            geometry.append(&mut instances);
        }
        described.insert("geometry".into(), geometry.into());
        Ok(std::iter::once((object.id.clone(), described.into())).chain(fixed).collect())
    }

    /// Returns the metadata of the file.
    fn metadata(&self, title: &str) -> Map<String, Json> {
        let mut metadata = Map::new();
        metadata.insert("title".into(), title.into());
        if let Some(code) = self.quantiser.outward.code {
            let name = format!("https://www.opengis.net/def/crs/EPSG/0/{code}");
            metadata.insert("referenceSystem".into(), name.into());
        }
        if let Some([low, high]) = self.extent {
            let place =
                |at: [i64; 3]| [0, 1, 2].map(|axis| at[axis] as f64 / STEPS + self.quantiser.origin[axis]);
            metadata.insert("geographicalExtent".into(), json!([place(low), place(high)].concat()));
        }
        metadata
    }

    /// Returns the transform of the vertices.
    fn transform(&self) -> Json {
        let scale = 1.0 / STEPS;
        json!({ "scale": [scale, scale, scale], "translate": self.quantiser.origin.to_array() })
    }

    /// Writes the rest of the document after the objects.
    fn write_rest(self, title: &str, out: &mut Out) -> io::Result<()> {
        write!(out, ",\n\"metadata\":{}", Json::from(self.metadata(title)))?;
        write!(out, ",\n\"transform\":{}", self.transform())?;
        if let Some(templates) = self.templates.finish() {
            write!(out, ",\n\"geometry-templates\":{templates}")?;
        }
        write!(out, ",\n\"vertices\":")?;
        serde_json::to_writer(&mut *out, &self.vertices)?;
        writeln!(out, "}}")
    }
}

/// Returns the attributes of an object's feature.
fn attributes(object: &CityObject<'_>) -> Map<String, Json> {
    let Some((columns, record)) = object.record else { return Map::new() };
    let value = |column: usize| {
        Some(match record.value(column)? {
            Attribute::Boolean(value) => Json::Bool(*value),
            Attribute::Number(value) => Json::from(*value),
            Attribute::Text(text) => Json::String(text.to_string()),
            Attribute::Nested(value) => Json::clone(value),
        })
    };
    columns.iter().enumerate().filter_map(|(column, name)| Some((name.clone(), value(column)?))).collect()
}
