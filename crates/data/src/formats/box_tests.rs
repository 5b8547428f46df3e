//! Tests of the box that selects features: each format keeps those whose geometry touches it.

use crate::{Geometry, Source, SourceOptions};
use burgeon_base::stop::Stop;
use burgeon_spatial::{Record, RecordTable};

/// Geometries whose bounding boxes intersect [`BOX`]: two that touch it, then three that do not.
const TEXTS: [&str; 5] = [
    "LINESTRING (24 60, 26 62)",
    "POLYGON ((23 59, 27 59, 27 63, 23 63, 23 59))",
    "LINESTRING (24 60.5, 25.5 62)",
    "POLYGON ((23 59, 27 59, 27 63, 23 63, 23 59), (24.5 60, 24.5 61.5, 26 61.5, 26 60, 24.5 60))",
    "POLYGON ((24 60, 24.5 60, 24.5 61.5, 26 61.5, 26 62, 24 62, 24 60))",
];
/// West, south, east and north; the first line touches a corner.
const BOX: [f64; 4] = [25.0, 60.5, 25.5, 61.0];

/// Returns the ids that a file has in the box, and in the whole.
fn read(name: &str, bytes: &[u8]) -> [String; 2] {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    [Some(BOX), None].map(|within| {
        let wanted = SourceOptions { within, id: Some("id".to_owned()), ..SourceOptions::default() };
        let table = Source::open_within(&path, name, &wanted).unwrap().read(name, &wanted).unwrap();
        table.features.iter().map(|feature| feature.id.to_string()).collect::<Vec<_>>().join(" ")
    })
}

/// Returns a text of each geometry, made by `each` from the id, the kind, and the rings as pairs of coordinates.
fn written(each: impl Fn(usize, &str, &[Vec<String>]) -> String) -> String {
    let all = TEXTS.iter().enumerate().map(|(number, text)| {
        let (kind, rings) = text.split_once(" (").unwrap();
        let rings = rings.trim_matches(['(', ')']).split("), (");
        let rings: Vec<Vec<String>> =
            rings.map(|ring| ring.split(", ").map(str::to_owned).collect()).collect();
        each(number + 1, kind, &rings)
    });
    all.collect::<Vec<_>>().join("\n")
}

#[test]
fn only_geometries_that_touch_the_box_are_read_in_each_format() {
    let csv = written(|id, _, _| format!("{id},\"{}\"", TEXTS[id - 1]));
    let geojson = written(|id, kind, rings| {
        let ring = |ring: &Vec<String>| {
            let points: Vec<String> =
                ring.iter().map(|point| format!("[{}]", point.replace(' ', ","))).collect();
            format!("[{}]", points.join(","))
        };
        let rings: Vec<String> = rings.iter().map(ring).collect();
        let (kind, coordinates) = match kind {
            "POLYGON" => ("Polygon", format!("[{}]", rings.join(","))),
            _ => ("LineString", rings[0].clone()),
        };
        format!(
            r#"{{"type":"Feature","properties":{{"id":{id}}},"geometry":{{"type":"{kind}","coordinates":{coordinates}}}}}"#
        )
    });
    let kml = written(|id, kind, rings| {
        let ring = |ring: &Vec<String>| {
            let points: Vec<String> = ring.iter().map(|point| point.replace(' ', ",")).collect();
            format!("<coordinates>{}</coordinates>", points.join(" "))
        };
        let geometry = match kind {
            "POLYGON" => {
                let boundary = |(number, it): (usize, &Vec<String>)| {
                    let name = if number == 0 { "outerBoundaryIs" } else { "innerBoundaryIs" };
                    format!("<{name}><LinearRing>{}</LinearRing></{name}>", ring(it))
                };
                let all: String = rings.iter().enumerate().map(boundary).collect();
                format!("<Polygon>{all}</Polygon>")
            }
            _ => format!("<LineString>{}</LineString>", ring(&rings[0])),
        };
        let data = format!("<ExtendedData><Data name='id'><value>{id}</value></Data></ExtendedData>");
        format!("<Placemark>{data}{geometry}</Placemark>")
    });
    let gml = written(|id, kind, rings| {
        let list = |ring: &Vec<String>| format!("<gml:posList>{}</gml:posList>", ring.join(" "));
        let geometry = match kind {
            "POLYGON" => {
                let boundary = |(number, it): (usize, &Vec<String>)| {
                    let name = if number == 0 { "exterior" } else { "interior" };
                    format!("<gml:{name}><gml:LinearRing>{}</gml:LinearRing></gml:{name}>", list(it))
                };
                let all: String = rings.iter().enumerate().map(boundary).collect();
                format!("<gml:Polygon>{all}</gml:Polygon>")
            }
            _ => format!("<gml:LineString>{}</gml:LineString>", list(&rings[0])),
        };
        format!("<gml:featureMember><Lot><id>{id}</id><place>{geometry}</place></Lot></gml:featureMember>")
    });
    let records = TEXTS.iter().enumerate().map(|(number, text)| Record {
        id: (number + 1).to_string(),
        geometry: Some(Geometry::from_wkt(text).unwrap()),
        values: Vec::new(),
    });
    let table = RecordTable { name: "Lot".into(), columns: Vec::new(), records: records.collect() };
    let package = burgeon_export::layers::write_geopackage(&[table], None, &Stop::default()).unwrap();
    let collection = |text: &str| {
        format!(
            "<gml:FeatureCollection xmlns:gml='http://www.opengis.net/gml'>{text}</gml:FeatureCollection>"
        )
    };
    for (name, bytes) in [
        ("a.csv", format!("id,WKT\n{csv}\n").into_bytes()),
        ("a.geojsonl", geojson.into_bytes()),
        ("a.kml", format!("<kml><Document>{kml}</Document></kml>").into_bytes()),
        ("a.gml", collection(&gml).into_bytes()),
        ("a.gpkg", package),
    ] {
        assert_eq!(read(name, &bytes), ["1 2", "1 2 3 4 5"], "{name}");
    }
}
