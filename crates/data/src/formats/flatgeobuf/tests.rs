//! Tests of files written by another library, and of damaged files.

use std::path::Path;

use flatgeobuf::{ColumnType, FgbCrs, FgbWriter, FgbWriterOptions, GeometryType};
use geozero::wkb::Wkb;
use geozero::{ColumnValue, PropertyProcessor};

use crate::{FeatureTable, Geometry, Layer, Listing, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_base::random::Stream;
use std::sync::Arc;
use std::time::Duration;

/// Returns a file of geometries in well-known text, each with a number and a name.
fn made(kind: GeometryType, texts: &[&str], options: FgbWriterOptions<'_>) -> Vec<u8> {
    let mut writer = FgbWriter::create_with_options("town", kind, options).unwrap();
    writer.add_column("height", ColumnType::Double, |_, _| {});
    writer.add_column("name", ColumnType::String, |_, _| {});
    writer.add_column("levels", ColumnType::Int, |_, _| {});
    writer.add_column("open", ColumnType::Bool, |_, _| {});
    writer.add_column("more", ColumnType::Json, |_, _| {});
    for (text, number) in texts.iter().zip(1i32..) {
        let bytes = Geometry::from_wkt(text).unwrap().to_wkb();
        writer
            .add_feature_geom(Wkb(bytes), |feature| {
                let name = format!("house {number}");
                let values = [
                    ("height", ColumnValue::Double(f64::from(number) * 1.5)),
                    ("name", ColumnValue::String(&name)),
                    ("levels", ColumnValue::Int(number)),
                    ("open", ColumnValue::Bool(number % 2 == 0)),
                    ("more", ColumnValue::Json("[1, 2]")),
                ];
                for (index, (column, value)) in values.iter().enumerate() {
                    feature.property(index, column, value).unwrap();
                }
            })
            .unwrap();
    }
    let mut bytes = Vec::new();
    writer.write(&mut bytes).unwrap();
    bytes
}

fn options<'a>(code: i32) -> FgbWriterOptions<'a> {
    FgbWriterOptions {
        crs: FgbCrs { code, ..FgbCrs::default() },
        promote_to_multi: false,
        ..FgbWriterOptions::default()
    }
}

thread_local! {
    /// Folder for the files of a test.
    static FOLDER: tempfile::TempDir = tempfile::tempdir().unwrap();
}

fn read(bytes: &[u8], wanted: &SourceOptions) -> Result<FeatureTable> {
    let path = FOLDER.with(|folder| folder.path().join("town.fgb"));
    std::fs::write(&path, bytes).unwrap();
    Source::open_within(&path, "town.fgb", wanted)?.read("town.fgb", wanted)
}

fn plain(bytes: &[u8]) -> Result<FeatureTable> {
    read(bytes, &SourceOptions::default())
}

const MIXED: [&str; 6] = [
    "POINT(385400 6671500)",
    "LINESTRING(385400 6671500, 385410 6671500, 385420 6671510)",
    "POLYGON((385400 6671500, 385440 6671500, 385440 6671540, 385400 6671540, 385400 6671500), (385410 6671510, 385410 6671520, 385420 6671520, 385410 6671510))",
    "MULTIPOINT((385401 6671501), (385402 6671502))",
    "MULTILINESTRING((385400 6671500, 385410 6671500), (385430 6671500, 385440 6671500))",
    "MULTIPOLYGON(((385400 6671500, 385440 6671500, 385440 6671540, 385400 6671500)), ((385500 6671500, 385540 6671500, 385540 6671540, 385500 6671500)))",
];

/// Returns a file of geometries of all types; the header leaves the type open, and each geometry contains its own.
fn mixed(options: FgbWriterOptions<'_>) -> Vec<u8> {
    made(GeometryType::Unknown, &MIXED, FgbWriterOptions { detect_type: false, ..options })
}

/// Returns the geometries sorted, because an index changes their order.
fn shapes(table: &FeatureTable) -> Vec<String> {
    let mut shapes: Vec<String> = table.features.iter().map(|feature| feature.geometry.to_wkt()).collect();
    shapes.sort();
    shapes
}

#[test]
fn geometries_of_every_kind_are_read_with_and_without_an_index() {
    let mut expected: Vec<String> = MIXED
        .iter()
        .flat_map(|text| Geometry::from_wkt(text).unwrap().into_parts())
        .map(|part| part.to_wkt())
        .collect();
    expected.sort();
    for write_index in [true, false] {
        let table = plain(&mixed(FgbWriterOptions { write_index, ..options(3067) })).unwrap();
        assert_eq!((shapes(&table), table.records, table.refused.len()), (expected.clone(), 6, 0));
        assert_eq!((table.layer.as_str(), table.crs.as_ref().unwrap().code), ("town", Some(3067)));
        assert_eq!(table.names, ["height", "name", "levels", "open", "more"]);
    }
    let single = made(GeometryType::Polygon, &[MIXED[2]], options(3067));
    let table = plain(&single).unwrap();
    let told: Vec<String> =
        table.features[0].attributes.iter().map(|(_, value)| format!("{value:?}")).collect();
    insta::assert_snapshot!(told.join(" "), @r#"Number(1.5) Text("house 1") Number(1.0) Boolean(false) Nested(Array [Number(1), Number(2)])"#);
}

#[test]
fn only_what_touches_a_box_is_read_and_the_same_with_and_without_an_index() {
    let texts: Vec<String> = (0..500).map(|at| format!("POINT({} {})", at % 25, at / 25)).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    for bounds in [[3.0, 4.0, 7.5, 9.0], [-5.0, -5.0, 0.0, 0.0], [0.0, 0.0, 30.0, 30.0]] {
        let wanted = SourceOptions { within: Some(bounds), ..SourceOptions::default() };
        let [with, without] = [true, false].map(|write_index| {
            let bytes = made(GeometryType::Point, &texts, FgbWriterOptions { write_index, ..options(3067) });
            read(&bytes, &wanted).unwrap()
        });
        let expected = texts.iter().filter(|text| {
            let place = *Geometry::from_wkt(text).unwrap().points().next().unwrap();
            place.x >= bounds[0] && place.x <= bounds[2] && place.y >= bounds[1] && place.y <= bounds[3]
        });
        assert_eq!((with.features.len(), shapes(&with)), (expected.count(), shapes(&without)));
        // Ids are those from reading all features.
        let all = plain(&made(GeometryType::Point, &texts, options(3067))).unwrap();
        for feature in &with.features {
            assert!(
                all.features.iter().any(|other| other.id == feature.id && other.geometry == feature.geometry)
            );
        }
    }
    // Their boxes intersect that of the options; the first line touches a corner of it, the second line misses it.
    let lines = ["LINESTRING(0 0, 10 10)", "LINESTRING(0 1, 9 10)"];
    for write_index in [true, false] {
        let wanted = SourceOptions { within: Some([6.0, 0.0, 10.0, 6.0]), ..SourceOptions::default() };
        let made = made(GeometryType::LineString, &lines, FgbWriterOptions { write_index, ..options(3067) });
        assert_eq!(shapes(&read(&made, &wanted).unwrap()), ["LINESTRING (0 0, 10 10)"]);
    }
    let limited = SourceOptions { limit: Some(3), ..SourceOptions::default() };
    assert_eq!(read(&made(GeometryType::Point, &texts, options(3067)), &limited).unwrap().features.len(), 3);
}

#[test]
fn systems_that_are_missing_or_not_known_and_empty_layers_are_told() {
    let told =
        |bytes: &[u8]| plain(bytes).and_then(|table| Layer::new(table, &mut None)).unwrap_err().to_string();
    let named = FgbCrs { name: Some("local grid"), ..FgbCrs::default() };
    let all = [
        told(&made(GeometryType::Point, &["POINT(1 2)"], options(0))),
        told(&made(GeometryType::Point, &["POINT(1 2)"], FgbWriterOptions { crs: named, ..options(0) })),
        told(&made(GeometryType::Point, &["POINT(1 2)"], options(12))),
        told(&made(GeometryType::Point, &[], options(3067))),
        told(b"fgb\x02fgb\0\0\0\0\0\0\0\0\0\0"),
        told(&made(GeometryType::Point, &["POINT(1 2)"], options(3067))[..200]),
    ];
    insta::assert_snapshot!(all.join("\n\n"), @r#"
    the layer has no coordinate system
      help: specify its EPSG code: source(file, { crs = 3067 })

    the layer's coordinate system "local grid" is not an EPSG system
      help: specify its EPSG code: source(file, { crs = 3067 })

    unknown coordinate system EPSG:12
      help: specify the correct one: source(file, { crs = 4326 }), or convert the file to EPSG:4326

    town.fgb has no features
      help: check the file: burgeon sources FILE

    town.fgb is a FlatGeobuf of unsupported version 2
      help: re-export it: ogr2ogr out.fgb FILE

    town.fgb cannot be read: it has a header of 292 bytes
      help: the file is damaged or cut short; download it again
    "#);
    let crs = SourceOptions { crs: Some(3067), ..SourceOptions::default() };
    let table = read(&made(GeometryType::Point, &["POINT(385400 6671500)"], options(0)), &crs).unwrap();
    assert_eq!(table.crs.unwrap().code, Some(3067));
    // Two positions on both sides of the date line are close to each other.
    let date_line = made(GeometryType::Point, &["POINT(179.99 -16)", "POINT(-179.99 -16)"], options(4326));
    let layer = Layer::new(plain(&date_line).unwrap(), &mut None).unwrap();
    assert!(layer.bounds[1][0] - layer.bounds[0][0] < 3000.0, "{:?}", layer.bounds);
}

#[test]
fn changed_bytes_never_panic_and_changed_places_are_seen() {
    let good = mixed(options(3067));
    let whole = shapes(&plain(&good).unwrap());
    let (mut same, mut refused, mut other, mut errors) = (0, 0, 0, 0);
    for at in (0..good.len()).step_by(2) {
        for byte in [0x41, 0xff] {
            let mut changed = good.clone();
            changed[at] = byte;
            let wanted = SourceOptions {
                budget: Budget::within(Duration::from_secs(10), 50_000_000),
                ..SourceOptions::default()
            };
            let within = SourceOptions {
                within: Some([385_400.0, 6_671_500.0, 385_410.0, 6_671_600.0]),
                ..wanted.clone()
            };
            let _ = read(&changed, &within);
            match read(&changed, &wanted) {
                Ok(table) if shapes(&table) == whole => same += 1,
                Ok(table) if !table.refused.is_empty() => refused += 1,
                Ok(_) => other += 1,
                Err(_) => errors += 1,
            }
        }
        assert!(plain(&good[..at]).is_err());
    }
    // Changes that remain undetected are positions within their boxes, and types.
    assert!(
        other * 4 < refused + errors,
        "{same} same, {refused} refused, {other} otherwise, {errors} errors"
    );
}

#[test]
fn counts_that_cannot_be_ask_for_no_memory() {
    let good = made(GeometryType::Polygon, &[MIXED[2]; 3], options(3067));
    let (mut stream, mut read_ones) = (Stream::new(9), 0);
    for _ in 0..800 {
        let mut changed = good.clone();
        let at = stream.below(good.len() - 4);
        let word = [u32::MAX, 0x7fff_ffff, 0x1000_0000, 1 << 20, 0][stream.below(5)];
        changed[at..at + 4].copy_from_slice(&word.to_le_bytes());
        let budget = Budget::within(Duration::from_secs(10), 10_000_000);
        let wanted = SourceOptions { budget, ..SourceOptions::default() };
        read_ones += usize::from(read(&changed, &wanted).is_ok());
    }
    assert!(read_ones > 5, "{read_ones}");
}

#[test]
fn what_a_file_holds_is_listed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("town.fgb");
    std::fs::write(&path, mixed(options(3067))).unwrap();
    let text = Listing::read(Path::new(&path), &Arc::default()).unwrap().text();
    let text = text.replace(&path.display().to_string(), "town.fgb");
    insta::assert_snapshot!(text, @r#"
    town.fgb: FlatGeobuf
      town: 3 points, 3 lines, 3 polygons in 6 records; EPSG:3067
        from 385400, 6671500 to 385540, 6671540
        height  number of 9, 1.5 to 9
        name    text of 9, such as "house 3", "house 6", "house 5"
        levels  number of 9, 1 to 6
        open    boolean of 9
        more    table of 9
    "#);
}
