//! Shapefiles that are made here, byte by byte.

use std::path::Path;

use crate::{Attribute, FeatureTable, Geometry, Source, SourceOptions};
use burgeon_base::error::Result;

/// A record of a `.shp`: its kind, its parts, and a height for each point if it has some.
type ShapeSketch<'a> = (u32, &'a [&'a [[f64; 2]]], Option<f64>);

fn record(number: usize, (kind, parts, height): ShapeSketch<'_>) -> Vec<u8> {
    let mut content = kind.to_le_bytes().to_vec();
    let points: Vec<[f64; 2]> = parts.concat();
    let numbers =
        |numbers: &[f64]| numbers.iter().flat_map(|number| number.to_le_bytes()).collect::<Vec<u8>>();
    if kind % 10 == 1 {
        content.extend(numbers(&points[0]));
        content.extend(height.into_iter().flat_map(f64::to_le_bytes));
    } else if kind > 0 {
        let far = |axis: usize, pick: fn(f64, f64) -> f64| {
            points.iter().map(|point| point[axis]).reduce(pick).unwrap_or(0.0)
        };
        content.extend(numbers(&[far(0, f64::min), far(1, f64::min), far(0, f64::max), far(1, f64::max)]));
        if kind % 10 != 8 {
            content.extend((parts.len() as u32).to_le_bytes());
        }
        content.extend((points.len() as u32).to_le_bytes());
        if kind % 10 != 8 {
            let mut start = 0_u32;
            for part in parts {
                content.extend(start.to_le_bytes());
                start += part.len() as u32;
            }
        }
        points.iter().for_each(|point| content.extend(numbers(point)));
        if let Some(height) = height {
            content.extend(numbers(&[height, height]));
            points.iter().for_each(|_| content.extend(height.to_le_bytes()));
        }
    }
    let head = [(number as u32 + 1).to_be_bytes(), (content.len() as u32 / 2).to_be_bytes()].concat();
    [head, content].concat()
}

fn shp(shapes: &[ShapeSketch<'_>]) -> Vec<u8> {
    let mut bytes = [0; 100];
    bytes[..4].copy_from_slice(&9994_u32.to_be_bytes());
    bytes[28..32].copy_from_slice(&1000_u32.to_le_bytes());
    shapes
        .iter()
        .enumerate()
        .fold(bytes.to_vec(), |all, (number, shape)| [all, record(number, *shape)].concat())
}

/// A table of columns with names, types and widths.
fn dbf(mark: u8, columns: &[(&str, u8, usize)], rows: &[&[&[u8]]]) -> Vec<u8> {
    let width: usize = columns.iter().map(|column| column.2).sum();
    let mut bytes = vec![0; 32];
    bytes[0] = 3;
    bytes[4..8].copy_from_slice(&(rows.len() as u32).to_le_bytes());
    bytes[8..10].copy_from_slice(&(33 + 32 * columns.len() as u16).to_le_bytes());
    bytes[10..12].copy_from_slice(&(width as u16 + 1).to_le_bytes());
    bytes[29] = mark;
    for (name, kind, width) in columns {
        let mut field = [0; 32];
        field[..name.len()].copy_from_slice(name.as_bytes());
        (field[11], field[16]) = (*kind, *width as u8);
        bytes.extend(field);
    }
    bytes.push(0x0d);
    for row in rows {
        bytes.push(if row[0] == b"*deleted" { b'*' } else { b' ' });
        for ((_, _, width), value) in columns.iter().zip(*row) {
            let mut cell = value.to_vec();
            cell.resize(*width, b' ');
            bytes.extend(cell);
        }
    }
    bytes
}

const SQUARE: &[[f64; 2]] = &[[0.0, 0.0], [0.0, 4.0], [4.0, 4.0], [4.0, 0.0], [0.0, 0.0]];
const HOLE: &[[f64; 2]] = &[[1.0, 1.0], [2.0, 1.0], [2.0, 2.0], [1.0, 2.0], [1.0, 1.0]];
const AWAY: &[[f64; 2]] = &[[6.0, 0.0], [6.0, 1.0], [7.0, 1.0], [7.0, 0.0], [6.0, 0.0]];
const UTM: &str = "PROJCS[\"ETRS_1989_UTM_Zone_32N\",GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],\
    PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\",500000.0],\
    PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",9.0],PARAMETER[\"Scale_Factor\",0.9996],\
    PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"Meter\",1.0]]";

fn read(folder: &Path) -> Result<FeatureTable> {
    let wanted = SourceOptions::default();
    Source::open_within(&folder.join("a.shp"), "a.shp", &wanted)?.read("a.shp", &wanted)
}

fn written(files: &[(&str, &[u8])]) -> Result<FeatureTable> {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|(name, bytes)| std::fs::write(folder.path().join(name), bytes).unwrap());
    read(folder.path())
}

#[test]
fn rings_become_polygons_with_the_holes_that_lie_in_them() {
    let shapes = shp(&[
        (5, &[SQUARE, AWAY, HOLE], None),
        (0, &[], None),
        (15, &[SQUARE], Some(7.5)),
        (5, &[HOLE, SQUARE], None),
    ]);
    let table = written(&[("a.shp", &shapes), ("a.prj", UTM.as_bytes())]).unwrap();
    assert_eq!(table.crs.as_ref().unwrap().name(), "EPSG:25832");
    let areas: Vec<f64> = table.features.iter().map(|feature| feature.geometry.area()).collect();
    assert_eq!(areas, [15.0, 1.0, 16.0, 15.0]);
    assert_eq!((table.empty, table.records), (1, 3));
    let Geometry::Polygon(rings) = &table.features[2].geometry else { panic!("a polygon") };
    assert!(rings.0[0].iter().all(|point| point.z == 7.5) && rings.0[0].len() == 4);
    assert_eq!(table.notes, ["a.shp has no .dbf file, so its features have no attributes"]);
    assert_eq!(table.derived, 3);
}

#[test]
fn lines_points_and_measures_are_read() {
    let line: &[[f64; 2]] = &[[0.0, 0.0], [3.0, 4.0]];
    let shapes = shp(&[
        (3, &[line, AWAY], None),
        (1, &[&[[5.0, 6.0]]], None),
        (11, &[&[[5.0, 6.0]]], Some(2.0)),
        (8, &[line], None),
        (23, &[line], None),
    ]);
    let table = written(&[("a.shp", &shapes), ("a.PRJ", UTM.as_bytes())]).unwrap();
    let kinds: Vec<&str> = table.features.iter().map(|feature| feature.geometry.kind().name()).collect();
    assert_eq!(kinds, ["line", "line", "point", "point", "point", "point", "line"]);
    let multipatch = shp(&[(31, &[SQUARE], None), (1, &[&[[5.0, 6.0]]], None)]);
    let table = written(&[("a.shp", &multipatch), ("a.prj", UTM.as_bytes())]).unwrap();
    insta::assert_snapshot!(table.refused[0].1.to_string(), @r#"
    record 1 of a.shp is a multipatch, a surface in space (31)
      help: points, lines and polygons are read; repair it: ogr2ogr out.gpkg FILE
    "#);
}

#[test]
fn values_have_the_types_of_their_columns_and_the_letters_of_their_code_page() {
    let columns =
        [("name", b'C', 10), ("height", b'N', 8), ("old", b'L', 1), ("built", b'D', 8), ("note", b'M', 10)];
    let rows: [&[&[u8]]; 4] = [
        &[b"Stra\xdfe", b"  12.50", b"T", b"19990131", b""],
        &[b"*deleted", b"1", b"T", b"", b""],
        &[b"", b"********", b"?", b"00000000", b""],
        &[b"b", b"tall", b"n", b"2001", b""],
    ];
    let point: ShapeSketch<'_> = (1, &[&[[5.0, 6.0]]], None);
    let shapes = shp(&[point; 5]);
    let told = |mark: u8, cpg: &str| {
        let table = dbf(mark, &columns, &rows);
        written(&[
            ("a.shp", &shapes),
            ("a.dbf", &table),
            ("a.prj", UTM.as_bytes()),
            ("a.cpg", cpg.as_bytes()),
        ])
    };
    let table = told(0x03, "").unwrap();
    let values = |number: usize| {
        let feature = &table.features[number];
        let of = |(name, value): &(usize, Attribute)| format!("{} = {value:?}", table.names[*name]);
        feature.attributes.iter().map(of).collect::<Vec<_>>().join(", ")
    };
    insta::assert_snapshot!([values(0), values(1), values(2), values(3)].join("\n"), @r#"
    name = Text("Straße"), height = Number(12.5), old = Boolean(true), built = Text("1999-01-31")

    name = Text("b"), old = Boolean(false)
    "#);
    insta::assert_snapshot!(table.notes.join("\n"), @r#"
    a.shp: 1 feature is marked as deleted and was left out
    a.shp: 1 feature has no attributes, since its .dbf file is cut short
    a.shp: 2 values are no numbers and no dates and were left out, such as height = "tall"
    a.shp: the column note was left out, since its values are memos in another file
    "#);
    let text = |table: &FeatureTable| format!("{:?}", table.features[0].attributes[0].1);
    assert_eq!(text(&told(0, "1250").unwrap()), "Text(\"Straße\")");
    assert_eq!(text(&told(0, "ISO-8859-5").unwrap()), "Text(\"Straпe\")");
    let guessed = told(0, "").unwrap();
    assert!(
        text(&guessed) == "Text(\"Straße\")"
            && guessed.notes.iter().any(|note| note.contains("Windows-1252"))
    );
    assert_eq!(
        told(0, "Shift_JIS").unwrap_err().message(),
        "a.dbf has texts in Shift_JIS, which is not read"
    );
}

#[test]
fn a_coordinate_system_is_found_by_its_parameters_and_told_if_it_is_not() {
    let point = shp(&[(1, &[&[[5.0, 6.0]]], None)]);
    let crs = |prj: &str| {
        let table = written(&[("a.shp", &point), ("a.prj", prj.as_bytes())]).unwrap();
        table.crs.map_or_else(|error| error.to_string(), |crs| crs.name())
    };
    let projected = |name: &str, base: &str, method: &str, parameters: &str| {
        format!("PROJCS[\"{name}\",{base},PROJECTION[\"{method}\"],{parameters},UNIT[\"Meter\",1.0]]")
    };
    let etrs = "GEOGCS[\"GCS_ETRS_1989\",DATUM[\"D_ETRS_1989\",SPHEROID[\"GRS_1980\",6378137.0,298.257222101]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]]";
    let wgs = "GEOGCS[\"GCS_WGS_1984\",DATUM[\"D_WGS_1984\",SPHEROID[\"WGS_1984\",6378137.0,298.257223563]],PRIMEM[\"Greenwich\",0.0],UNIT[\"Degree\",0.0174532925199433]]";
    let tm35 = "PARAMETER[\"False_Easting\",500000.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",27.0],PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0]";
    assert_eq!(crs(wgs), "EPSG:4326");
    assert_eq!(crs(&projected("EUREF_FIN_TM35FIN", etrs, "Transverse_Mercator", tm35)), "EPSG:3067");
    let zone = tm35.replace("27.0", "9.0");
    assert_eq!(crs(&projected("WGS_1984_UTM_Zone_32N", wgs, "Transverse_Mercator", &zone)), "EPSG:32632");
    let lambert = "PARAMETER[\"False_Easting\",700000.0],PARAMETER[\"False_Northing\",6600000.0],PARAMETER[\"Central_Meridian\",3.0],PARAMETER[\"Standard_Parallel_1\",44.0],PARAMETER[\"Standard_Parallel_2\",49.0],PARAMETER[\"Latitude_Of_Origin\",46.5]";
    let rgf = etrs.replace("GCS_ETRS_1989", "GCS_RGF_1993").replace("D_ETRS_1989", "D_RGF_1993");
    assert_eq!(crs(&projected("RGF_1993_Lambert_93", &rgf, "Lambert_Conformal_Conic", lambert)), "EPSG:2154");
    let mercator = "PARAMETER[\"False_Easting\",0.0],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",0.0],PARAMETER[\"Standard_Parallel_1\",0.0],PARAMETER[\"Auxiliary_Sphere_Type\",0.0]";
    assert_eq!(
        crs(&projected("WGS_1984_Web_Mercator_Auxiliary_Sphere", wgs, "Mercator_Auxiliary_Sphere", mercator)),
        "EPSG:3857"
    );
    assert_eq!(
        crs("PROJCRS[\"ETRS89 / UTM zone 33N\",BASEGEOGCRS[\"ETRS89\"],ID[\"EPSG\",25833]]"),
        "EPSG:25833"
    );
    let odd = tm35.replace("27.0", "27.3");
    let told = crs(&projected("Odd_Zone", etrs, "Transverse_Mercator", &odd));
    assert!(told.contains("\"Odd_Zone\", which is none of EPSG's that are known"), "{told}");
    assert!(crs("nonsense").contains("which is none of EPSG's"), "{}", crs("nonsense"));
    assert!(written(&[("a.shp", &point)]).unwrap().crs.unwrap_err().message().contains("has no .prj file"));
}

#[test]
fn holes_in_thousands_of_rings_are_found_in_time() {
    let rings: Vec<Vec<[f64; 2]>> = (0..3000)
        .flat_map(|number| {
            let at = |ring: &[[f64; 2]]| {
                ring.iter().map(|[x, y]| [x + f64::from(number) * 10.0, *y]).collect::<Vec<_>>()
            };
            [at(SQUARE), at(HOLE)]
        })
        .collect();
    let parts: Vec<&[[f64; 2]]> = rings.iter().map(Vec::as_slice).collect();
    let table = written(&[("a.shp", &shp(&[(5, &parts, None)])), ("a.prj", UTM.as_bytes())]).unwrap();
    assert_eq!(table.features.len(), 3000);
    assert!(table.features.iter().all(|feature| (feature.geometry.area() - 15.0).abs() < 1e-6));
}
