//! Assembles a CityJSON document.

use std::io::{self, Write as _};
use std::path::Path;

use crate::layers::OutputPlacement;
use burgeon_base::error::Result;
use burgeon_spatial::Attribute;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use serde_json::{Map, Value as Json, json};

use super::super::check::check;
use super::super::files::{Files, Out};
use super::super::stem;
use super::boundaries::{boundaries, semantics};
use super::object::{CityObject, ObjectShape, Quantiser, STEPS, objects, placed_transform};
use super::templates::ShapeTemplates;
use crate::Export;

/// Number of objects whose shapes are computed at a time.
const CHUNK: usize = 512;

/// Writes a `.city.json` file to `path`.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let checked = check(export.scene)?;
    let outward = OutputPlacement::metric(export.facts.frame)?;
    let low = checked.scene.bounds().map_or(DVec3::ZERO, |(low, _)| low);
    let origin = outward.place(low).unwrap_or_default().floor() + 0.0;
    let quantiser = Quantiser { outward: &outward, origin };
    let objects = objects(&checked, &export.facts);
    let mut document = CityWriter {
        export,
        quantiser: &quantiser,
        vertices: Vec::new(),
        numbers: FxHashMap::default(),
        templates: ShapeTemplates::default(),
    };
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
        document.write_rest(stem(path).trim_end_matches(".city"), origin, out)
    })?;
    failed
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
    export: &'a Export<'a>,
    quantiser: &'a Quantiser<'a>,
    vertices: Vec<[i64; 3]>,
    numbers: FxHashMap<[i64; 3], u32>,
    templates: ShapeTemplates,
}

impl CityWriter<'_> {
    fn vertex(&mut self, at: [i64; 3]) -> u32 {
        *self.numbers.entry(at).or_insert_with(|| {
            self.vertices.push(at);
            (self.vertices.len() - 1) as u32
        })
    }

    /// Returns the entries of an object and of the objects that are fixed to it.
    fn object(&mut self, object: &CityObject<'_>, shape: &ObjectShape) -> Result<CityEntries> {
        let detail = self.export.facts.detail;
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
            let mut described = json!({ "type": kind, "lod": detail.to_string(), "boundaries": boundaries });
            if let Some(semantics) = semantics(&shape.faces, closed) {
                described["semantics"] = semantics;
            }
            geometry.push(described);
        }
        let mut instances = Vec::new();
        for instance in &object.placed {
            let surfaces = object.class.has_surfaces();
            let template = self.templates.number(self.export.scene, instance, surfaces, detail);
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

    /// Writes the rest of the document after the objects.
    fn write_rest(self, title: &str, origin: DVec3, out: &mut Out) -> io::Result<()> {
        let mut metadata = Map::new();
        metadata.insert("title".into(), title.into());
        if let Some(code) = self.quantiser.outward.code {
            let name = format!("https://www.opengis.net/def/crs/EPSG/0/{code}");
            metadata.insert("referenceSystem".into(), name.into());
        }
        let axis = |axis: usize| self.vertices.iter().map(move |at| at[axis]);
        let ends = [0, 1, 2].map(|number| axis(number).min().zip(axis(number).max()));
        if let [Some(x), Some(y), Some(z)] = ends {
            let place = |step: i64, axis: usize| step as f64 / STEPS + origin[axis];
            metadata.insert(
                "geographicalExtent".into(),
                json!([
                    place(x.0, 0),
                    place(y.0, 1),
                    place(z.0, 2),
                    place(x.1, 0),
                    place(y.1, 1),
                    place(z.1, 2)
                ]),
            );
        }
        write!(out, ",\n\"metadata\":{}", Json::from(metadata))?;
        let scale = 1.0 / STEPS;
        let transform = json!({ "scale": [scale, scale, scale], "translate": origin.to_array() });
        write!(out, ",\n\"transform\":{transform}")?;
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
