//! Geometries of CityJSON: boundaries of vertex indices, with the roles of their surfaces.

use glam::DVec3;
use serde::Deserialize;
use serde_json::Value;
use serde_json::value::RawValue;

use super::shape::{CityShape, CitySurface, SurfaceRole};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_base::text::shown;

/// Scale and offset of vertices.
#[derive(Deserialize, Clone)]
pub(super) struct Transform {
    scale: [f64; 3],
    translate: [f64; 3],
}

/// Geometry as stored in the file.
#[derive(Deserialize)]
pub(super) struct CityGeometry<'a> {
    r#type: String,
    #[serde(default)]
    lod: Option<Value>,
    #[serde(borrow, default)]
    boundaries: Option<&'a RawValue>,
    #[serde(default)]
    semantics: Option<Semantics>,
}

#[derive(Deserialize)]
struct Semantics {
    #[serde(default)]
    surfaces: Vec<SemanticSurface>,
    #[serde(default)]
    values: Value,
}

#[derive(Deserialize)]
struct SemanticSurface {
    #[serde(default)]
    r#type: String,
}

/// Vertices of a document.
pub(super) struct CityVertices {
    pub(super) places: Vec<Vec<f64>>,
    pub(super) transform: Option<Transform>,
}

impl CityVertices {
    fn ring(&self, numbers: &[usize]) -> std::result::Result<Vec<DVec3>, String> {
        numbers.iter().map(|number| self.place(*number)).collect()
    }

    fn place(&self, number: usize) -> std::result::Result<DVec3, String> {
        let place =
            self.places.get(number).ok_or_else(|| format!("refers to the missing vertex {number}"))?;
        let [x, y, z] = place[..] else { return Err(format!("has a vertex of {} numbers", place.len())) };
        let place = DVec3::new(x, y, z);
        Ok(match &self.transform {
            Some(Transform { scale, translate }) => place * DVec3::from(*scale) + DVec3::from(*translate),
            None => place,
        })
    }
}

/// Rings of a surface, as vertex indices.
type SurfaceRings = Vec<Vec<usize>>;

/// Adds a geometry to a shape. Fails with the reason.
pub(super) fn add_geometry(
    geometry: &CityGeometry<'_>,
    vertices: &CityVertices,
    shape: &mut CityShape,
    budget: &Budget,
) -> Result<std::result::Result<(), String>> {
    let Some(text) = geometry.boundaries.map(RawValue::get) else { return Ok(Ok(())) };
    let level = match &geometry.lod {
        Some(Value::Number(number)) => number.as_f64(),
        Some(Value::String(text)) => text.parse().ok(),
        _ => None,
    };
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the range is clamped")]
    let level = (level.unwrap_or(1.0) * 10.0).round().clamp(0.0, 100.0) as u32;
    let wrong = |error: serde_json::Error| {
        format!("has boundaries that cannot be read: {}", shown(&error.to_string()))
    };
    let is_solid = geometry.r#type.ends_with("Solid");
    let read = || -> std::result::Result<(Vec<SurfaceRings>, Vec<usize>), String> {
        match &*geometry.r#type {
            "MultiSurface" | "CompositeSurface" => {
                Ok((serde_json::from_str(text).map_err(wrong)?, Vec::new()))
            }
            "Solid" => {
                let shells: Vec<Vec<SurfaceRings>> = serde_json::from_str(text).map_err(wrong)?;
                Ok((shells.into_iter().flatten().collect(), Vec::new()))
            }
            "MultiSolid" | "CompositeSolid" => {
                let solids: Vec<Vec<Vec<SurfaceRings>>> = serde_json::from_str(text).map_err(wrong)?;
                Ok((solids.into_iter().flatten().flatten().collect(), Vec::new()))
            }
            "MultiPoint" | "GeometryInstance" => Ok((Vec::new(), serde_json::from_str(text).map_err(wrong)?)),
            "MultiLineString" => {
                let lines: SurfaceRings = serde_json::from_str(text).map_err(wrong)?;
                Ok((vec![lines], Vec::new()))
            }
            other => Err(format!("has a geometry of unknown type \"{}\"", shown(other))),
        }
    };
    let (surfaces, points) = match read() {
        Ok(read) => read,
        Err(why) => return Ok(Err(why)),
    };
    let mut roles = Vec::new();
    if let Some(semantics) = &geometry.semantics {
        collect_roles(&semantics.values, &semantics.surfaces, &mut roles, 0);
    }
    for (number, rings) in surfaces.into_iter().enumerate() {
        budget.tick()?;
        let rings: std::result::Result<Vec<Vec<DVec3>>, String> =
            rings.iter().map(|ring| vertices.ring(ring)).collect();
        let rings = match rings {
            Ok(rings) => rings,
            Err(why) => return Ok(Err(why)),
        };
        if geometry.r#type == "MultiLineString" {
            shape.lines.extend(rings);
            continue;
        }
        let told = roles.get(number).copied().flatten();
        let role = match told {
            Some(role) => role,
            None if level < 10 && !is_solid => SurfaceRole::Footprint,
            None => SurfaceRole::Other,
        };
        shape.surfaces.push(CitySurface { rings, role, level, is_solid });
    }
    for number in points {
        match vertices.place(number) {
            Ok(place) => shape.points.push(place),
            Err(why) => return Ok(Err(why)),
        }
    }
    Ok(Ok(()))
}

/// Collects the roles of surfaces, in the order of the boundaries.
fn collect_roles(
    values: &Value,
    surfaces: &[SemanticSurface],
    roles: &mut Vec<Option<SurfaceRole>>,
    depth: usize,
) {
    let Value::Array(values) = values else { return };
    for value in values {
        match value {
            Value::Array(_) if depth < 4 => collect_roles(value, surfaces, roles, depth + 1),
            value => {
                let number = value.as_u64().and_then(|number| usize::try_from(number).ok());
                let surface = number.and_then(|number| surfaces.get(number));
                roles.push(surface.map(|surface| SurfaceRole::of_name(&surface.r#type)));
            }
        }
    }
}
