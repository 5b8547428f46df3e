//! Writer of DXF R12, which CAD programs read: points and polylines in metres, with a layer for each table.
//!
//! Format: Autodesk, "AutoCAD Release 12 Customization Manual", 1992.

use std::io::{self, Write};

use glam::DVec3;
use rustc_hash::FxHashSet;

use super::place::OutputPlacement;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::{Geometry, RecordTable, ReferenceFrame};

/// Maximum number of characters of a layer's name.
const LONGEST: usize = 31;

/// Colours (AutoCAD colour index) of the layers, in turn: black or white, red, green, cyan, blue, magenta, yellow.
const COLORS: [u8; 7] = [7, 1, 3, 4, 5, 6, 2];

/// Writes `tables` as a drawing in metres of a projection: that of the data, or the UTM zone of a run in degrees.
///
/// Rings become closed polylines, in the layer of their table. Lines and rings with heights become polylines in space.
/// Fails if a position is outside the domain of the projection.
///
/// ```
/// use burgeon_export::layers::write_dxf;
/// use burgeon_spatial::{Geometry, Record, RecordTable};
/// use glam::DVec3;
///
/// let geometry = Geometry::line(vec![DVec3::ZERO, DVec3::X * 10.0]);
/// let records = vec![Record { id: "7".into(), geometry, values: vec![] }];
/// let table = RecordTable { name: "streets".into(), columns: vec![], records };
/// let mut text = Vec::new();
/// write_dxf(&[table], None, &mut text)?;
/// let text = String::from_utf8(text)?;
/// assert!(text.contains("POLYLINE\n8\nSTREETS\n") && text.ends_with("0\nEOF\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn write_dxf(tables: &[RecordTable], frame: Option<&ReferenceFrame>, out: &mut impl Write) -> Result<()> {
    let placement = OutputPlacement::metric(frame)?;
    let mut layers = Vec::with_capacity(tables.len());
    let mut known = FxHashSet::default();
    let mut bounds: Option<(DVec3, DVec3)> = None;
    for table in tables {
        let mut items = Vec::new();
        for record in &table.records {
            if let Some(geometry) = &record.geometry {
                collect(geometry, &placement, &mut items).map_err(|at| outside(table, &record.id, at))?;
            }
        }
        for point in items.iter().flat_map(|item| &item.points) {
            bounds = Some(bounds.map_or((*point, *point), |(low, high)| (low.min(*point), high.max(*point))));
        }
        layers.push((layer_name(&table.name, &mut known), items));
    }
    let failed = |error: io::Error| Error::system(format!("cannot write DXF: {error}"));
    write_drawing(&layers, bounds, placement.code, out).map_err(failed)
}

/// Point, line or ring of a drawing.
struct DrawingItem {
    points: Vec<DVec3>,
    kind: ItemKind,
}

/// Kind of an item.
#[derive(Clone, Copy, PartialEq)]
enum ItemKind {
    Point,
    Line,
    Ring,
}

/// Adds the items of `geometry`. Fails with the first position that cannot be projected.
fn collect(
    geometry: &Geometry,
    placement: &OutputPlacement<'_>,
    items: &mut Vec<DrawingItem>,
) -> Result<(), DVec3> {
    let mut add = |points: &[DVec3], kind: ItemKind| {
        let placed = points.iter().map(|point| placement.place(*point).ok_or(*point));
        let mut points: Vec<DVec3> = placed.collect::<Result<_, _>>()?;
        if kind == ItemKind::Ring && points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() > usize::from(kind != ItemKind::Point) {
            items.push(DrawingItem { points, kind });
        }
        Ok(())
    };
    match geometry {
        Geometry::Point(point) => add(point.as_slice(), ItemKind::Point),
        Geometry::MultiPoint(points) => {
            points.iter().try_for_each(|point| add(std::slice::from_ref(point), ItemKind::Point))
        }
        Geometry::Line(points) => add(points, ItemKind::Line),
        Geometry::MultiLine(lines) => lines.iter().try_for_each(|line| add(line, ItemKind::Line)),
        Geometry::Polygon(rings) => rings.iter().try_for_each(|ring| add(ring, ItemKind::Ring)),
        Geometry::MultiPolygon(polygons) => {
            let mut rings = polygons.iter().flat_map(|rings| rings.iter());
            rings.try_for_each(|ring| add(ring, ItemKind::Ring))
        }
        Geometry::Collection(members) => {
            members.iter().try_for_each(|member| collect(member, placement, items))
        }
    }
}

fn outside(table: &RecordTable, id: &str, at: DVec3) -> Error {
    let message = format!(
        "the geometry of {:?} in layer {:?} is outside the projection, at ({}, {}) m",
        id, table.name, at.x, at.y
    );
    Error::data(message).help("remove it, or use data in another coordinate system")
}

/// Returns a layer name of R12 that is similar to `name` and differs from the `known` ones.
fn layer_name(name: &str, known: &mut FxHashSet<String>) -> String {
    let letter =
        |letter: char| if letter.is_ascii_alphanumeric() { letter.to_ascii_uppercase() } else { '_' };
    let plain: String = name.chars().map(letter).take(LONGEST).collect();
    let plain = if plain.is_empty() { "LAYER".to_owned() } else { plain };
    let mut unique = plain.clone();
    let mut count = 1;
    while !known.insert(unique.clone()) {
        count += 1;
        let number = format!("_{count}");
        unique = format!("{}{number}", &plain[..plain.len().min(LONGEST - number.len())]);
    }
    unique
}

fn write_drawing(
    layers: &[(String, Vec<DrawingItem>)],
    bounds: Option<(DVec3, DVec3)>,
    code: Option<u16>,
    out: &mut impl Write,
) -> io::Result<()> {
    writeln!(out, "999\nBurgeon {}", env!("CARGO_PKG_VERSION"))?;
    match code {
        Some(code) => writeln!(out, "999\nMetres of EPSG:{code}")?,
        None => writeln!(out, "999\nMetres")?,
    }
    writeln!(out, "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n9\n$INSUNITS\n70\n6")?;
    let (low, high) = bounds.unwrap_or_default();
    for (key, DVec3 { x, y, z }) in [("$EXTMIN", low), ("$EXTMAX", high)] {
        writeln!(out, "9\n{key}\n10\n{x}\n20\n{y}\n30\n{z}")?;
    }
    writeln!(out, "0\nENDSEC\n0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLTYPE\n70\n1")?;
    writeln!(out, "0\nLTYPE\n2\nCONTINUOUS\n70\n0\n3\nSolid line\n72\n65\n73\n0\n40\n0.0\n0\nENDTAB")?;
    writeln!(out, "0\nTABLE\n2\nLAYER\n70\n{}", layers.len() + 1)?;
    writeln!(out, "0\nLAYER\n2\n0\n70\n0\n62\n7\n6\nCONTINUOUS")?;
    for ((name, _), color) in layers.iter().zip(COLORS.iter().cycle()) {
        writeln!(out, "0\nLAYER\n2\n{name}\n70\n0\n62\n{color}\n6\nCONTINUOUS")?;
    }
    writeln!(out, "0\nENDTAB\n0\nENDSEC\n0\nSECTION\n2\nENTITIES")?;
    for (name, items) in layers {
        for DrawingItem { points, kind } in items {
            if *kind == ItemKind::Point {
                for DVec3 { x, y, z } in points {
                    writeln!(out, "0\nPOINT\n8\n{name}\n10\n{x}\n20\n{y}\n30\n{z}")?;
                }
                continue;
            }
            // 1: closed, 8: in space.
            let in_space = points.iter().any(|point| point.z != 0.0);
            let flags = u8::from(*kind == ItemKind::Ring) + if in_space { 8 } else { 0 };
            writeln!(out, "0\nPOLYLINE\n8\n{name}\n66\n1\n10\n0.0\n20\n0.0\n30\n0.0\n70\n{flags}")?;
            let vertex = if in_space { "70\n32\n" } else { "" };
            for DVec3 { x, y, z } in points {
                write!(out, "0\nVERTEX\n8\n{name}\n10\n{x}\n20\n{y}\n30\n{z}\n{vertex}")?;
            }
            writeln!(out, "0\nSEQEND\n8\n{name}")?;
        }
    }
    writeln!(out, "0\nENDSEC\n0\nEOF")
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_spatial::Record;

    fn drawing(name: &str, geometries: Vec<Geometry>) -> String {
        let record = |geometry| Record { id: "way/1".into(), geometry: Some(geometry), values: Vec::new() };
        let records = geometries.into_iter().map(record).collect();
        let table = RecordTable { name: name.into(), columns: Vec::new(), records };
        let mut text = Vec::new();
        write_dxf(&[table.clone(), table], None, &mut text).unwrap();
        String::from_utf8(text).unwrap()
    }

    #[test]
    fn a_polygon_with_a_hole_becomes_two_closed_polylines_without_a_repeated_point() {
        let square = |size: f64, z: f64| {
            let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (0.0, 0.0)];
            corners.map(|(x, y)| DVec3::new(x * size, y * size, z)).to_vec()
        };
        let polygon = Geometry::polygon(vec![square(10.0, 0.0), square(1.0, 0.0)]).unwrap();
        let text = drawing("Lot", vec![polygon, Geometry::point(DVec3::X)]);
        // Two tables.
        assert_eq!(text.matches("\nPOLYLINE\n").count(), 4, "{text}");
        assert_eq!(text.matches("\nVERTEX\n").count(), 16);
        assert_eq!(text.matches("30\n0.0\n70\n1\n").count(), 4, "closed, flat");
        assert_eq!(text.matches("\nPOINT\n").count(), 2);
        assert!(text.contains("$EXTMAX\n10\n10\n20\n10\n30\n0\n"), "{text}");
        let high = drawing("Lot", vec![Geometry::polygon(vec![square(10.0, 3.0)]).unwrap()]);
        assert_eq!(high.matches("30\n0.0\n70\n9\n").count(), 2, "closed, in space");
    }

    #[test]
    fn names_of_layers_are_plain_short_and_unique() {
        let mut known = FxHashSet::default();
        let names = ["Straße 1", "Straße_1", "", "a".repeat(40).as_str(), "a".repeat(50).as_str()]
            .map(|name| layer_name(name, &mut known));
        let (a, b) = ("A".repeat(31), format!("{}_2", "A".repeat(29)));
        assert_eq!(names, ["STRA_E_1", "STRA_E_1_2", "LAYER", &a, &b]);
    }
}
