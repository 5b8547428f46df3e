//! Writer of GeoJSON according to RFC 7946: degrees of WGS 84, outer rings counter-clockwise.

use std::io::{self, Write};

use glam::DVec3;
use serde_json::{Map, Value as Json, json};

use super::place::OutputPlacement;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Attribute, Geometry, Record, RecordTable, ReferenceFrame};

/// Writes `tables` as one feature collection. If there are several tables, the property `layer` of each feature
/// contains the name of its table.
///
/// Longitudes of a geometry across the antimeridian continue beyond 180. Fails if there are geometries but no `frame`
/// with a position on Earth, and if a position has no longitude and latitude.
///
/// ```
/// use burgeon_export::layers::write_geojson;
/// use burgeon_spatial::{Attribute, Crs, Geometry, Record, RecordTable, ReferenceFrame};
/// use glam::DVec3;
///
/// let frame = ReferenceFrame::around(&Crs::epsg(4326)?, [27.0, 60.0], "the town")?;
/// let (geometry, values) = (Some(Geometry::point(DVec3::ZERO)), vec![(0, Attribute::Number(2.0))]);
/// let records = vec![Record { id: "7".into(), geometry, values }];
/// let table = RecordTable { name: "houses".into(), columns: vec!["floors".into()], records };
/// let mut text = Vec::new();
/// write_geojson(&[table], Some(&frame), &mut text)?;
/// let json: serde_json::Value = serde_json::from_slice(&text)?;
/// assert_eq!(json["features"][0]["properties"]["floors"], 2);
/// assert!((json["features"][0]["geometry"]["coordinates"][0].as_f64().unwrap_or(0.0) - 27.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_geojson(
    tables: &[RecordTable],
    frame: Option<&ReferenceFrame>,
    out: &mut impl Write,
) -> Result<()> {
    let places = tables.iter().flat_map(|table| &table.records).any(|record| record.geometry.is_some());
    let outward = match frame {
        Some(frame) => Some(OutputPlacement::degrees(frame)?),
        None if places => {
            return Err(Error::script("the model has no location on the earth, which GeoJSON needs")
                .help("read data with a location, source(FILE), or write a .gpkg, which accepts metres without a location"));
        }
        None => None,
    };
    let failed = |error: io::Error| Error::system(format!("cannot write GeoJSON: {error}"));
    out.write_all(b"{\"type\":\"FeatureCollection\",\"features\":[").map_err(failed)?;
    let mut first = true;
    for table in tables {
        for record in &table.records {
            let layer = (tables.len() > 1).then_some(table.name.as_str());
            let feature = feature(table, record, layer, outward.as_ref())?;
            let comma: &[u8] = if first { b"\n" } else { b",\n" };
            first = false;
            out.write_all(comma)
                .and_then(|()| serde_json::to_writer(&mut *out, &feature).map_err(io::Error::from))
                .map_err(failed)?;
        }
    }
    out.write_all(b"\n]}\n").map_err(failed)
}

fn feature(
    table: &RecordTable,
    record: &Record,
    layer: Option<&str>,
    outward: Option<&OutputPlacement<'_>>,
) -> Result<Json> {
    let mut properties = Map::new();
    if let Some(layer) = layer {
        properties.insert("layer".into(), layer.into());
    }
    for (column, name) in table.columns.iter().enumerate() {
        let value = match record.value(column) {
            None => Json::Null,
            Some(Attribute::Boolean(value)) => Json::Bool(*value),
            // Integers are written without a decimal point.
            #[allow(clippy::cast_possible_truncation, reason = "whole and small")]
            Some(Attribute::Number(number)) if number.fract() == 0.0 && number.abs() < 1e15 => {
                Json::from(*number as i64)
            }
            Some(Attribute::Number(number)) => Json::from(*number),
            Some(Attribute::Text(text)) => Json::String(text.to_string()),
            Some(Attribute::Nested(value)) => Json::clone(value),
        };
        properties.insert(name.clone(), value);
    }
    let geometry = match (&record.geometry, outward) {
        (Some(geometry), Some(outward)) => {
            let mut turned = geometry.clone();
            turned.turn();
            DegreeWriter { outward, record, table }.geometry(&turned)?
        }
        _ => Json::Null,
    };
    Ok(json!({ "type": "Feature", "id": record.id, "geometry": geometry, "properties": properties }))
}

/// Converter of a record's geometry to degrees.
struct DegreeWriter<'a> {
    outward: &'a OutputPlacement<'a>,
    record: &'a Record,
    table: &'a RecordTable,
}

impl DegreeWriter<'_> {
    fn geometry(&self, geometry: &Geometry) -> Result<Json> {
        let lines = |lines: &[Vec<DVec3>]| lines.iter().map(|line| self.points(line, false)).collect();
        let (kind, coordinates): (_, Result<Json>) = match geometry {
            Geometry::Point(point) => {
                let place = match self.points(point.as_slice(), false)? {
                    Json::Array(mut places) if !places.is_empty() => places.swap_remove(0),
                    _ => json!([]),
                };
                ("Point", Ok(place))
            }
            Geometry::Line(points) => ("LineString", self.points(points, false)),
            Geometry::Polygon(rings) => ("Polygon", self.rings(rings)),
            Geometry::MultiPoint(points) => ("MultiPoint", self.points(points, false)),
            Geometry::MultiLine(all) => ("MultiLineString", lines(all)),
            Geometry::MultiPolygon(polygons) => {
                ("MultiPolygon", polygons.iter().map(|rings| self.rings(rings)).collect())
            }
            Geometry::Collection(parts) => {
                let parts: Json = parts.iter().map(|part| self.geometry(part)).collect::<Result<_>>()?;
                return Ok(json!({ "type": "GeometryCollection", "geometries": parts }));
            }
        };
        Ok(json!({ "type": kind, "coordinates": coordinates? }))
    }

    fn rings(&self, rings: &[Vec<DVec3>]) -> Result<Json> {
        rings.iter().map(|ring| self.points(ring, true)).collect()
    }

    fn points(&self, points: &[DVec3], closed: bool) -> Result<Json> {
        let high = points.iter().any(|point| point.z != 0.0);
        let again = points.first().filter(|_| closed);
        let mut last: Option<f64> = None;
        let place = |point: &DVec3| {
            let Some(DVec3 { x, y, z }) = self.outward.place(*point) else {
                return Err(self.position_error());
            };
            let beyond = last.map_or(0.0, |last| ((last - x) / 360.0).round() * 360.0);
            last = Some(x + beyond);
            // Rounded to 0.1 mm.
            let round = |degrees: f64| (degrees * 1e9).round() / 1e9 + 0.0;
            Ok(if high {
                json!([round(x + beyond), round(y), z])
            } else {
                json!([round(x + beyond), round(y)])
            })
        };
        points.iter().chain(again).map(place).collect()
    }

    fn position_error(&self) -> Error {
        let (id, name) = (burgeon_base::text::shown(&self.record.id), &self.table.name);
        Error::data(format!("{id} of the layer {name} has no longitude and latitude"))
            .help("remove it, or write a .gpkg, whose positions are in metres")
    }
}
