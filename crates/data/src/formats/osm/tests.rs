//! Tests of generated extracts, damaged extracts, and real extracts with results from another program.

mod extract;

use std::path::{Path, PathBuf};
use std::time::Duration;

use extract::{Extract, blob, deflated, header, message, number};

use crate::tags::{TagFilter, TagTest};
use crate::{Attribute, FeatureTable, Geometry, GeometryKind, Layer, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_base::random::Stream;

thread_local! {
    /// Folder for the files of a test.
    static FOLDER: tempfile::TempDir = tempfile::tempdir().unwrap();
}

fn read(bytes: &[u8], wanted: SourceOptions) -> Result<FeatureTable> {
    let path = FOLDER.with(|folder| folder.path().join("town.osm.pbf"));
    std::fs::write(&path, bytes).unwrap();
    Source::open_within(&path, "town.osm.pbf", &wanted)?.read("town.osm.pbf", &wanted)
}

fn layer(name: &str) -> SourceOptions {
    SourceOptions { layer: Some(name.to_owned()), ..SourceOptions::default() }
}

fn tags(tests: &[(&str, TagTest)]) -> SourceOptions {
    let tests = tests.iter().map(|(key, test)| ((*key).into(), test.clone())).collect();
    SourceOptions { tags: Some(TagFilter { alternatives: vec![tests] }), ..SourceOptions::default() }
}

fn ids(table: &FeatureTable) -> String {
    table.features.iter().map(|feature| feature.id.to_string()).collect::<Vec<_>>().join(" ")
}

/// Returns a square of nodes around a position, with ids from `first`.
fn square(first: i64, [x, y]: [i64; 2], half: i64) -> Vec<(i64, i64, i64)> {
    let corners = [(-1, -1), (1, -1), (1, 1), (-1, 1)];
    corners.iter().zip(first..).map(|((dx, dy), id)| (id, x + dx * half, y + dy * half)).collect()
}

fn ring(first: i64) -> Vec<i64> {
    vec![first, first + 1, first + 2, first + 3, first]
}

const TOWN: [i64; 2] = [250_000_000, 600_000_000];

/// Returns an extract with a few buildings, a road, a tree, and a building with a courtyard as a relation.
fn town() -> Extract {
    let mut nodes = square(1, TOWN, 1000);
    nodes.extend(square(11, [TOWN[0] + 5000, TOWN[1]], 1000));
    nodes.extend(square(21, [TOWN[0] + 5000, TOWN[1]], 300));
    nodes.push((30, TOWN[0], TOWN[1] + 3000));
    Extract::default()
        .nodes(&nodes, &[("natural", "tree"), ("species", "Tilia")])
        .way(
            -7,
            &ring(1),
            &[
                ("building", "house"),
                ("height", "40'"),
                ("building:levels", "3;4"),
                ("building:colour", "red"),
            ],
        )
        .way(8, &ring(11), &[])
        .way(9, &ring(21), &[])
        .way(10, &[1, 11, 99, 13, 14], &[("highway", "residential"), ("width", "wide")])
        .way(11, &ring(1), &[("highway", "footway")])
        .way(12, &[1, 2, 99, 3, 1], &[("building", "yes")])
        .relation(
            5,
            &[(1, 9), (0, 30), (1, 8)],
            &[("type", "multipolygon"), ("building", "yes"), ("building:part", "no")],
        )
        .relation(6, &[(1, 8), (1, 77)], &[("type", "multipolygon"), ("building", "yes")])
        .relation(7, &[(2, 7)], &[("type", "multipolygon"), ("building", "yes")])
}

#[test]
fn layers_have_what_their_tags_say_under_plain_names() {
    let table = town().read(layer("buildings")).unwrap();
    assert_eq!((table.layer.as_str(), table.shown.as_str()), ("buildings", "town.osm.pbf:buildings"));
    assert_eq!(ids(&table), "way/-7 relation/5");
    let told = |index: usize| {
        let feature = &table.features[index];
        let of = |(name, value): &(usize, Attribute)| format!("{} = {value:?}", table.names[*name]);
        feature.attributes.iter().map(of).collect::<Vec<_>>().join("\n")
    };
    insta::assert_snapshot!(told(0), @r#"
    building = Text("house")
    building:levels = Text("3;4")
    building:colour = Text("red")
    height = Number(12.192)
    levels = Number(3.0)
    colour = Text("red")
    kind = Text("house")
    part = Boolean(false)
    "#);
    let Geometry::Polygon(rings) = &table.features[1].geometry else { panic!("a polygon") };
    assert_eq!(rings.len(), 2);
    let refused: Vec<&str> = table.refused.iter().map(|(_, error)| error.message()).collect();
    insta::assert_snapshot!(refused.join("\n"), @r"
    way/12 of town.osm.pbf:buildings lacks 1 of its 5 nodes
    relation/6 of town.osm.pbf:buildings lacks its part way/77
    relation/7 of town.osm.pbf:buildings has no area
    ");
    let roads = town().read(layer("roads")).unwrap();
    assert_eq!(ids(&roads), "way/10 way/10.2 way/11");
    insta::assert_snapshot!(roads.notes.join("\n"), @r#"
    town.osm.pbf:roads: 1 line ends at the boundary of the extract
    town.osm.pbf:roads: 1 tag is not a number and was skipped, e.g. width = "wide" of way/10
    "#);
    let trees = town().read(layer("trees")).unwrap();
    assert_eq!(
        (ids(&trees).as_str(), trees.names.as_slice()),
        ("node/30", &["natural", "species", "kind"].map(str::to_owned)[..])
    );
}

#[test]
fn tags_choose_and_kind_decides_what_closed_ways_are() {
    let set = |key| (key, TagTest::Set);
    let chosen = |wanted: SourceOptions| town().read(wanted).map(|table| ids(&table));
    assert_eq!(chosen(tags(&[set("building"), set("height")])).unwrap(), "way/-7");
    assert_eq!(chosen(tags(&[("building", TagTest::OneOf(vec!["yes".into()]))])).unwrap(), "relation/5");
    assert_eq!(chosen(tags(&[set("highway")])).unwrap(), "way/10 way/10.2 way/11");
    let kind = |kind| SourceOptions { kind: Some(kind), ..tags(&[set("highway")]) };
    assert_eq!(chosen(kind(GeometryKind::Polygon)).unwrap(), "way/11");
    assert_eq!(chosen(kind(GeometryKind::Line)).unwrap(), "way/10 way/10.2 way/11");
    let both = SourceOptions { layer: Some("buildings".into()), ..tags(&[set("building:levels")]) };
    assert_eq!(chosen(both).unwrap(), "way/-7");
    assert_eq!(
        chosen(tags(&[("building", TagTest::Unset), ("highway", TagTest::Unset)])).unwrap(),
        "node/30 way/8 way/9"
    );
    let within = SourceOptions { within: Some([25.0, 60.0, 25.0, 60.0]), ..layer("buildings") };
    assert_eq!(chosen(within).unwrap(), "way/-7");
    let far = SourceOptions { within: Some([26.0, 60.0, 27.0, 61.0]), ..layer("roads") };
    let met_by =
        |condition: &str, limit| SourceOptions { condition: Some(condition.into()), limit, ..layer("roads") };
    assert_eq!(chosen(met_by("highway = 'residential'", None)).unwrap(), "way/10 way/10.2");
    assert_eq!(chosen(met_by("id = 'way/11' or kind like 'resi%'", Some(1))).unwrap(), "way/10");
    let errors = [
        chosen(SourceOptions::default()),
        chosen(layer("building")),
        chosen(tags(&[set("aeroway")])),
        chosen(SourceOptions { condition: Some("a > 1".into()), ..layer("roads") }),
        chosen(SourceOptions { kind: Some(GeometryKind::Point), ..layer("roads") }),
        chosen(layer("water")),
        chosen(far),
    ];
    let told: Vec<String> = errors.into_iter().map(|error| error.unwrap_err().to_string()).collect();
    insta::assert_snapshot!(told.join("\n\n"), @r#"
    town.osm.pbf is an OpenStreetMap extract, which needs a layer
      help: specify a layer: "town.osm.pbf:buildings"; it has buildings, building_parts, roads, railways, squares, water, waterways, coastlines, green, landuse, trees, tree_rows, barriers, furniture; or select by tags: source("town.osm.pbf", { tags = { building = true } })

    town.osm.pbf: no layer named `building`
      help: did you mean buildings?

    no feature of town.osm.pbf has these tags
      help: look up the tags: https://wiki.openstreetmap.org/wiki/Map_features

    where "a > 1" of town.osm.pbf:roads: no such column: a
      help: write an SQL condition on the layer's columns, such as where = "height > 10"

    town.osm.pbf:roads has only geometries of kind line, not of kind point
      help: specify another layer, or remove kind

    town.osm.pbf:water has no features
      help: check the file: burgeon sources FILE

    no feature of town.osm.pbf:roads touches within = { 26, 60, 27, 61 }
      help: within is { west, south, east, north } in the coordinates of the file; run burgeon sources FILE to list them
    "#);
}

#[test]
fn what_is_damaged_is_an_error_with_its_place_and_never_a_panic() {
    let good = town().bytes();
    let (mut kept, mut refused) = (0, 0);
    for at in 0..good.len() {
        let mut changed = good.clone();
        for byte in [1, 255] {
            changed[at] = byte;
            match read(&changed, layer("buildings")) {
                Ok(_) => kept += 1,
                Err(_) => refused += 1,
            }
        }
        assert!(read(&good[..at], layer("buildings")).is_err(), "{at}");
    }
    assert!(kept > 2 && refused > 300, "{kept} {refused}");
    // Invalid bytes in a valid compression.
    let block = town().block();
    let (mut stream, mut kept) = (Stream::new(3), 0);
    for _ in 0..700 {
        let mut changed = block.clone();
        for _ in 0..=stream.below(3) {
            let at = stream.below(changed.len());
            changed[at] = stream.below(256) as u8;
        }
        let bytes = [header(&[]), blob("OSMData", message(1, &changed))].concat();
        for name in ["buildings", "roads", "trees"] {
            let read = read(&bytes, layer(name)).and_then(|table| Layer::new(table, &mut None));
            kept += usize::from(read.is_ok());
        }
    }
    assert!(kept > 100, "{kept}");
}

#[test]
fn bombs_and_what_is_not_known_are_refused_with_the_remedy() {
    let told = |bytes: &[u8]| read(bytes, layer("buildings")).unwrap_err().to_string();
    let zeros = vec![0; 20 << 20];
    let data = |content: Vec<u8>| [header(&[]), blob("OSMData", content)].concat();
    let huge = [&header(&[])[..], &u32::MAX.to_be_bytes()].concat();
    let head = [message(1, b"OSMData"), number(3, u64::MAX)].concat();
    let endless = [&header(&[])[..], &(head.len() as u32).to_be_bytes(), &head].concat();
    let all = [
        told(&data(deflated(&zeros, 1000))),
        told(&data(deflated(&zeros[..1000], 30 << 20))),
        told(&data(deflated(&zeros, 200 << 20))),
        told(&huge),
        told(&endless),
        told(&data(message(7, b"zstd"))),
        told(&header(&["HistoricalInformation"])),
        told(&header(&["Locations\u{1b}"])),
        told(&blob("OSMHeader", message(1, &[0xff]))),
        told(&town().bytes()[header(&[]).len()..]),
    ];
    insta::assert_snapshot!(all.join("\n\n"), @r#"
    town.osm.pbf cannot be read: the blob at byte 64 cannot be unpacked
      help: the file is damaged or cut short; download it again

    town.osm.pbf cannot be read: the blob at byte 62 declares more than the maximum size
      help: the file is damaged or cut short; download it again

    town.osm.pbf cannot be read: the blob at byte 64 declares more than the maximum size
      help: the file is damaged or cut short; download it again

    town.osm.pbf cannot be read: the blob at byte 47 has a header of 4294967295 bytes
      help: the file is damaged or cut short; download it again

    town.osm.pbf cannot be read: the blob at byte 47 has an invalid size
      help: the file is damaged or cut short; download it again

    town.osm.pbf is compressed with Zstandard, which is not supported
      help: re-export it: osmium cat IN.osm.pbf -o OUT.osm.pbf -f pbf,pbf_compression=zlib

    town.osm.pbf contains the history of its features
      help: extract the present state: osmium time-filter IN.osh.pbf -o OUT.osm.pbf

    town.osm.pbf needs "Locations\u{1b}", which is not supported
      help: re-export it: osmium cat IN.osm.pbf -o OUT.osm.pbf

    town.osm.pbf cannot be read: its header ends too early
      help: the file is damaged or cut short; download it again

    town.osm.pbf is a binary file of unknown format
      help: supported formats are GeoJSON, GeoPackage, FlatGeobuf, Shapefile, CSV, GML, CityGML, CityJSON, KML, GPX, .osm and .osm.pbf; convert it: ogr2ogr out.gpkg FILE
    "#);
    let wanted =
        SourceOptions { budget: Budget::within(Duration::from_secs(60), 1 << 20), ..layer("buildings") };
    let error = read(&data(deflated(&zeros, zeros.len())), wanted).unwrap_err();
    assert!(error.message().contains("memory"), "{error}");
    let late = SourceOptions { budget: Budget::within(Duration::ZERO, 1 << 30), ..layer("buildings") };
    assert!(read(&town().bytes(), late).unwrap_err().message().contains("time limit"));
}

#[test]
fn places_that_cannot_be_and_ways_of_one_node_are_refused_or_left_out() {
    let mut nodes = square(1, TOWN, 1000);
    nodes.extend(square(11, [i64::MAX / 200, 0], 5));
    nodes.extend(square(21, [2_500_000_000_000, 0], 5));
    nodes.extend(square(31, TOWN, 0));
    let extract = Extract::default()
        .nodes(&nodes, &[])
        .way(1, &ring(1), &[("building", "yes")])
        .way(2, &ring(11), &[("building", "yes")])
        .way(3, &ring(21), &[("building", "yes")])
        .way(4, &ring(31), &[("building", "yes")])
        .way(5, &[1], &[("highway", "path"), ("building", "yes")])
        .way(6, &[1, 1, 1, 1], &[("highway", "path"), ("building", "yes")])
        .way(7, &[], &[("highway", "path")])
        .way(1, &ring(1), &[("building", "yes")]);
    let table = extract.read(layer("buildings")).unwrap();
    assert_eq!((ids(&table).as_str(), table.refused.len()), ("way/1 way/1.2", 4));
    let roads = extract.read(layer("roads")).unwrap_err();
    assert_eq!(roads.message(), "way/5 of town.osm.pbf:roads has fewer than two positions");
}

#[test]
fn a_road_over_the_date_line_stays_together() {
    let nodes = [(1, 1_799_900_000, -160_000_000), (2, -1_799_900_000, -160_000_000)];
    let table =
        Extract::default().nodes(&nodes, &[]).way(1, &[1, 2], &[("highway", "road")]).read(layer("roads"));
    let layer = Layer::new(table.unwrap(), &mut None).unwrap();
    assert!((layer.bounds[1][0] - layer.bounds[0][0] - 2140.0).abs() < 10.0, "{:?}", layer.bounds);
}

/// Returns the path of a file in the folder of shared data; prints that the test is skipped if the file is missing.
fn shared(name: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data").join(name);
    let found = path.is_file().then_some(path);
    if found.is_none() {
        eprintln!("skipped: there is no ../shared/data/{name}");
    }
    found
}

/// Returns the area of a polygon in squared coordinate units.
fn area(geometry: &Geometry) -> f64 {
    let Geometry::Polygon(rings) = geometry else { return 0.0 };
    let ring = |ring: &Vec<glam::DVec3>| {
        let of =
            |pair: &[glam::DVec3]| (pair[0] - ring[0]).truncate().perp_dot((pair[1] - ring[0]).truncate());
        ring.windows(2).map(of).sum::<f64>().abs() / 2.0
    };
    rings.iter().map(ring).fold(0.0, |sum, area| if sum == 0.0 { area } else { sum - area })
}

#[test]
fn the_building_areas_of_real_extracts_are_those_of_another_program() {
    // Layer; numbers of areas, areas of relations, parts and holes; total area, and sum of areas multiplied by ids
    // modulo 1009 (1e-10 square degrees), all from libosmium's areas.
    let expected = [
        ("Helsinki.osm.pbf", "buildings", [446, 61, 446, 72], 831_333.06, 441_096_665.4),
        ("Helsinki.osm.pbf", "building_parts", [133, 12, 133, 16], 229_170.71, 106_939_563.8),
        ("monaco-latest.osm.pbf", "buildings", [1207, 24, 1207, 28], 804_370.63, 433_582_487.2),
        ("monaco-latest.osm.pbf", "building_parts", [14, 0, 14, 0], 11_638.07, 4_430_269.8),
    ];
    for (file, name, counts, total, weighted) in expected {
        let Some(path) = shared(file) else { return };
        let table = Source::open(&path, file).unwrap().read(file, &layer(name)).unwrap();
        let rings = |feature: &crate::Feature| match &feature.geometry {
            Geometry::Polygon(rings) => rings.len() - 1,
            _ => 0,
        };
        let holes: usize = table.features.iter().map(rings).sum();
        let of_relations =
            table.features.iter().filter(|feature| feature.id.starts_with("relation/")).count();
        assert_eq!([table.records, of_relations, table.features.len(), holes], counts, "{file}:{name}");
        let of = |feature: &crate::Feature| area(&feature.geometry) * 1e10;
        let sum: f64 = table.features.iter().map(of).sum();
        let id = |feature: &crate::Feature| {
            let (_, id) = feature.id.split_once('/').unwrap();
            f64::from(id.split('.').next().unwrap().parse::<u32>().unwrap() % 1009)
        };
        let checked: f64 = table.features.iter().map(|feature| of(feature) * id(feature)).sum();
        assert!(
            (sum - total).abs() < 0.1 && (checked - weighted).abs() < 60.0,
            "{file}:{name}: {sum} {checked}"
        );
    }
}

#[test]
fn real_layers_have_as_many_features_as_those_that_were_made_of_them_elsewhere() {
    // The numbers of trees and furniture equal those in the corresponding GeoPackages, except for a shelter. The roads
    // include those that leave the extract, and the greens include more types.
    for (file, counts) in
        [("Helsinki.osm.pbf", [649, 2046, 2577, 166]), ("monaco-latest.osm.pbf", [415, 981, 2379, 55])]
    {
        let Some(path) = shared(file) else { return };
        let count = |name: &str| {
            let table = Source::open(&path, file).unwrap().read(file, &layer(name)).unwrap();
            table.records
        };
        assert_eq!(["trees", "furniture", "roads", "green"].map(count), counts, "{file}");
    }
}

#[test]
fn an_extract_that_is_xml_gives_the_same_layers_as_the_packed_one() {
    let degrees = |count: i64| {
        format!(
            "{}{}.{:07}",
            if count < 0 { "-" } else { "" },
            count.abs() / 10_000_000,
            count.abs() % 10_000_000
        )
    };
    let tags = |tags: &[(&str, &str)]| -> String {
        let text = |text: &str| text.replace('&', "&amp;").replace('"', "&quot;");
        tags.iter().map(|(key, value)| format!("<tag k=\"{}\" v=\"{}\"/>", text(key), text(value))).collect()
    };
    let mut nodes = square(1, TOWN, 1000);
    nodes.extend(square(11, [TOWN[0] + 5000, TOWN[1]], 1000));
    nodes.extend(square(21, [TOWN[0] + 5000, TOWN[1]], 300));
    nodes.push((30, TOWN[0], TOWN[1] + 3000));
    let mut text =
        "<?xml version='1.0' encoding='UTF-8'?>\n<osm version='0.6'><bounds minlat='1'/>".to_owned();
    for (id, x, y) in &nodes {
        let known =
            if *id == 30 { tags(&[("natural", "tree"), ("species", "Tilia")]) } else { String::new() };
        text += &format!("<node id='{id}' lat='{}' lon='{}'>{known}</node>", degrees(*y), degrees(*x));
    }
    let way = |id: i64, nodes: &[i64], known: &[(&str, &str)]| {
        let nodes: String = nodes.iter().map(|node| format!("<nd ref='{node}'/>")).collect();
        format!("<way id='{id}'>{nodes}{}</way>", tags(known))
    };
    let house =
        [("building", "house"), ("height", "40'"), ("building:levels", "3;4"), ("building:colour", "red")];
    text += &way(-7, &ring(1), &house);
    text += &way(8, &ring(11), &[]);
    text += &way(9, &ring(21), &[]);
    text += &way(10, &[1, 11, 99, 13, 14], &[("highway", "residential"), ("width", "wide")]);
    text += &way(11, &ring(1), &[("highway", "footway")]);
    text += &way(12, &[1, 2, 99, 3, 1], &[("building", "yes")]);
    text += "<way id='13' visible='false'><nd ref='1'/><nd ref='2'/><tag k='highway' v='path'/></way>";
    let relation = |id: i64, members: &[(&str, i64)], known: &[(&str, &str)]| {
        let members: String =
            members.iter().map(|(kind, id)| format!("<member type='{kind}' ref='{id}' role=''/>")).collect();
        format!("<relation id='{id}'>{members}{}</relation>", tags(known))
    };
    let area = [("type", "multipolygon"), ("building", "yes"), ("building:part", "no")];
    text += &relation(5, &[("way", 9), ("node", 30), ("way", 8)], &area);
    text += &relation(6, &[("way", 8), ("way", 77)], &area[..2]);
    text += &relation(7, &[("relation", 7)], &area[..2]);
    text += "</osm>";
    let read_xml = |wanted: &SourceOptions| {
        let path = FOLDER.with(|folder| folder.path().join("town.osm"));
        std::fs::write(&path, &text).unwrap();
        Source::open_within(&path, "town.osm.pbf", wanted)?.read("town.osm.pbf", wanted)
    };
    let mut compared = 0;
    for name in ["buildings", "roads", "trees", "landuse"] {
        let told = |table: Result<FeatureTable>| match table {
            Ok(table) => {
                let features =
                    table.features.iter().map(|feature| format!("{feature:?}")).collect::<Vec<_>>();
                let refused: Vec<String> = table.refused.iter().map(|(_, error)| error.to_string()).collect();
                (features, table.names.clone(), refused, table.notes.clone())
            }
            Err(error) => (vec![error.to_string()], Vec::new(), Vec::new(), Vec::new()),
        };
        let (packed, plain) = (told(town().read(layer(name))), told(read_xml(&layer(name))));
        compared += packed.0.len();
        assert_eq!(packed, plain, "{name}");
    }
    assert!(compared > 5);
}

#[test]
fn where_a_box_is_wanted_only_what_lies_in_it_is_reported() {
    let degrees = |[x, y]: [i64; 2]| [x, y].map(|count| count as f64 / 1e7);
    let around = |[x, y]: [f64; 2], half: f64| Some([x - half, y - half, x + half, y + half]);
    let told = |within: Option<[f64; 4]>, name: &str| {
        let table = town().read(SourceOptions { within, ..layer(name) }).unwrap();
        (table.refused.len(), table.notes.len())
    };
    assert_eq!((told(None, "buildings"), told(None, "roads")), ((3, 0), (0, 2)));
    // The relation in the east is not built, because a way is missing; it is within the box. way/12 is not.
    let east = around(degrees([TOWN[0] + 5000, TOWN[1]]), 0.0002);
    assert_eq!(told(east, "buildings"), (1, 0));
    let west = around(degrees(TOWN), 0.0002);
    assert_eq!(told(west, "buildings"), (1, 0));
}
