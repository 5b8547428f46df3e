//! Tests of generated delimited text, KML and GPX.

use crate::{Attribute, FeatureTable, Source, SourceOptions};
use burgeon_base::error::Result;

fn read_as(name: &str, bytes: &[u8], wanted: &SourceOptions) -> Result<FeatureTable> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, bytes).unwrap();
    Source::open_within(&path, name, wanted)?.read(name, wanted)
}

fn read(name: &str, text: &str) -> Result<FeatureTable> {
    read_as(name, text.as_bytes(), &SourceOptions::default())
}

fn told(table: &FeatureTable) -> String {
    let feature = |feature: &crate::Feature| {
        let of = |(name, value): &(usize, Attribute)| format!("{}={value:?}", table.names[*name]);
        let known: Vec<String> = feature.attributes.iter().map(of).collect();
        let wkt = feature.geometry.to_wkt();
        format!("{wkt}; {}", known.join(", "))
    };
    let features = table.features.iter().map(feature);
    let refused = table.refused.iter().map(|(_, error)| format!("refused: {error}"));
    let notes = table.notes.iter().map(|note| format!("note: {note}"));
    features.chain(refused).chain(notes).collect::<Vec<_>>().join("\n")
}

#[test]
fn delimited_text_has_places_in_columns_of_many_names() {
    let table = read("a.csv", "id,Longitude,LATITUDE,ele,name\r\n7,24.5,60.25,3,\"a, \"\"b\"\"\r\nc\"\r\n8,24.6,60.5,,\r\n\r\n9,,,,x\r\n").unwrap();
    insta::assert_snapshot!(told(&table), @r#"
    POINT Z (24.5 60.25 3); id=Number(7.0), Longitude=Number(24.5), LATITUDE=Number(60.25), ele=Number(3.0), name=Text("a, \"b\"\r\nc")
    POINT (24.6 60.5); id=Number(8.0), Longitude=Number(24.6), LATITUDE=Number(60.5)
    "#);
    assert_eq!(table.features.iter().map(|it| it.id.to_string()).collect::<Vec<_>>(), ["7", "8"]);
    assert_eq!((table.empty, table.derived), (1, 0));
    let semicolons = "sep=;\nX;Y;hoch\n3500000,5;5500000,25;1\n1;zwei;2\n3;4\n";
    let wanted = SourceOptions { crs: Some(31467), ..SourceOptions::default() };
    insta::assert_snapshot!(told(&read_as("a.csv", semicolons.as_bytes(), &wanted).unwrap()), @r#"
    POINT (3500000.5 5500000.25); X=Text("3500000,5"), Y=Text("5500000,25"), hoch=Number(1.0)
    POINT (3 4); X=Text("3"), Y=Text("4")
    refused: line 4 of a.csv has "zwei" instead of a coordinate
      help: correct it, or remove it
    note: a.csv: 1 line has a different number of fields from the first line, which has 3
    "#);
    let crs = read("a.csv", semicolons).unwrap().crs.unwrap_err();
    assert!(crs.message().contains("without a coordinate system"), "{crs}");
    let tabs = read("a.tsv", "lng\tlat\tcode\n7\t43\t007\n8\t44\t010\n").unwrap();
    insta::assert_snapshot!(told(&tabs), @r#"
    POINT (7 43); lng=Number(7.0), lat=Number(43.0), code=Text("007")
    POINT (8 44); lng=Number(8.0), lat=Number(44.0), code=Text("010")
    "#);
}

#[test]
fn delimited_text_has_geometries_in_well_known_text_binary_and_geojson() {
    let wkb = crate::Geometry::point([1.0, 2.0, 0.0]).to_wkb();
    let digits: String = wkb.iter().map(|byte| format!("{byte:02X}")).collect();
    let text = format!(
        "WKT,n\n\"SRID=3067;POLYGON ((0 0,4 0,4 4,0 0))\",1\nMULTIPOINT (1 1)|,2\n{digits},3\n\"{{\"\"type\"\":\"\"Point\"\",\"\"coordinates\"\":[5,6]}}\",4\nPOINT EMPTY,5\n,6\n"
    );
    let table = read("a.csv", &text).unwrap();
    assert_eq!(table.crs.as_ref().unwrap().name(), "EPSG:3067");
    insta::assert_snapshot!(told(&table), @r#"
    POLYGON ((0 0, 4 0, 4 4, 0 0)); n=Number(1.0)
    POINT (1 2); n=Number(3.0)
    POINT (5 6); n=Number(4.0)
    refused: line 3 of a.csv has a geometry that cannot be read: invalid well-known text: expected the end at character 17, found "|"
      help: correct it, or remove it
    "#);
    let none = read("a.csv", "name,height\na,3\n").err().unwrap();
    insta::assert_snapshot!(none, @r#"
    a.csv has no columns of positions: it has name, height
      help: name them lon and lat, or x and y with crs, or write well-known text in a column named WKT
    "#);
    let open = read("a.csv", "lon,lat,name\n1,2,\"a\n3,4,b\n").err().unwrap();
    insta::assert_snapshot!(open, @r#"
    a.csv cannot be read: a text in quotes begins in line 2 and does not end
      help: the file is cut short, or has a single quote (") in a text
    "#);
    let latin = read_as("a.csv", b"lon,lat,name\n1,2,H\xe4user\n", &SourceOptions::default()).unwrap();
    insta::assert_snapshot!(told(&latin), @r#"
    POINT (1 2); lon=Number(1.0), lat=Number(2.0), name=Text("Häuser")
    note: a.csv is not UTF-8 and was read as Windows-1252 (Latin-1); if its texts look wrong, convert it: iconv -f ENCODING -t UTF-8 IN > OUT.csv
    "#);
}

#[test]
fn placemarks_of_all_folders_are_features() {
    let text = "<kml xmlns='http://www.opengis.net/kml/2.2' xmlns:gx='g'><Document><Style id='s'/><Folder><name>north</name><Folder><name>old</name>\
        <Placemark id='p1'><name>House</name><styleUrl>#s</styleUrl><ExtendedData><Data name='floors'><value>3</value></Data>\
        <SchemaData schemaUrl='#s'><SimpleData name='kind'>shed &amp; barn</SimpleData></SchemaData></ExtendedData><MultiGeometry>\
        <Polygon><outerBoundaryIs><LinearRing><coordinates>0,0,5 4,0,5 4,4,5 0,0,5</coordinates></LinearRing></outerBoundaryIs>\
        <innerBoundaryIs><LinearRing><coordinates>2,1 3,1 3,2 2,1</coordinates></LinearRing></innerBoundaryIs></Polygon>\
        <Point><coordinates> 9,9 </coordinates></Point></MultiGeometry></Placemark></Folder></Folder>\
        <Placemark><name>Walk</name><TimeSpan><begin>1999</begin></TimeSpan><gx:Track><when>2020</when><gx:coord>1 2 3</gx:coord><gx:coord>2 3 4</gx:coord></gx:Track></Placemark>\
        <Placemark><name>Odd</name><Point><coordinates>north,3</coordinates></Point></Placemark>\
        <Placemark><name>Nowhere</name></Placemark><NetworkLink><Link><href>more.kml</href></Link></NetworkLink></Document></kml>";
    let table = read("a.kml", text).unwrap();
    insta::assert_snapshot!(told(&table), @r#"
    POLYGON Z ((0 0 5, 4 0 5, 4 4 5, 0 0 5), (2 1 0, 3 1 0, 3 2 0, 2 1 0)); folder=Text("north/old"), name=Text("House"), floors=Number(3.0), kind=Text("shed & barn")
    POINT (9 9); folder=Text("north/old"), name=Text("House"), floors=Number(3.0), kind=Text("shed & barn")
    LINESTRING Z (1 2 3, 2 3 4); name=Text("Walk"), begin=Number(1999.0)
    refused: placemark 3 of a.kml has "north,3" instead of coordinates
      help: supported types are points, lines, polygons, tracks and collections of these
    note: a.kml: 1 link to another file is not followed; download these files, and specify them
    "#);
    assert_eq!((table.empty, table.features[0].id.as_str(), table.derived), (1, "p1", 1));
}

#[test]
fn waypoints_routes_and_tracks_are_layers() {
    let text = "<?xml version='1.0'?><gpx xmlns='http://www.topografix.com/GPX/1/1'><metadata><name>m</name></metadata>\
        <wpt lat='43' lon='7'><ele>12.5</ele><name>Peak</name><link href='http://x'><text>t</text></link></wpt>\
        <rte><name>r</name><rtept lat='43' lon='7'/><rtept lat='44' lon='8'><ele>3</ele><name>end</name></rtept></rte>\
        <trk><name>t</name><extensions><x:speed>3</x:speed></extensions><trkseg><trkpt lat='1' lon='2'/><trkpt lat='3' lon='4'/></trkseg>\
        <trkseg><trkpt lat='5' lon='6'/></trkseg></trk></gpx>";
    let of = |layer: &str| {
        let wanted = SourceOptions { layer: Some(layer.to_owned()), ..SourceOptions::default() };
        told(&read_as("a.gpx", text.as_bytes(), &wanted).unwrap())
    };
    insta::assert_snapshot!([of("waypoints"), of("routes"), of("tracks")].join("\n"), @r#"
    POINT Z (7 43 12.5); ele=Number(12.5), name=Text("Peak"), link=Text("http://x")
    LINESTRING Z (7 43 0, 8 44 3); name=Text("r")
    LINESTRING (2 1, 4 3); name=Text("t"), speed=Number(3.0)
    note: a.gpx:tracks: 1 segment has one point and was skipped
    "#);
    insta::assert_snapshot!(read("a.gpx", text).err().unwrap(), @r#"
    a.gpx has several layers
      help: specify one after a colon: "a.gpx:waypoints"; it has waypoints, routes, tracks
    "#);
}

#[test]
fn packed_files_hold_what_they_are_called() {
    use std::io::Write;

    let geojson =
        r#"{"type":"Feature","properties":{"name":"a"},"geometry":{"type":"Point","coordinates":[7,43]}}"#;
    let gz = |text: &[u8]| {
        let mut encoder = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        encoder.write_all(text).unwrap();
        encoder.finish().unwrap()
    };
    let zip = |files: &[(&str, &[u8])]| {
        let mut writer = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
        for (name, bytes) in files {
            writer.start_file(*name, zip::write::SimpleFileOptions::default()).unwrap();
            writer.write_all(bytes).unwrap();
        }
        writer.finish().unwrap().into_inner()
    };
    let read = |name: &str, bytes: &[u8]| read_as(name, bytes, &SourceOptions::default());
    assert_eq!(read("a.geojson.gz", &gz(geojson.as_bytes())).unwrap().layer, "a");
    assert_eq!(read("a.csv.gz", &gz(b"lon,lat\n1,2\n")).unwrap().features.len(), 1);
    assert_eq!(
        read("a.zip", &zip(&[("readme.txt", b"x"), ("b/c.geojson", geojson.as_bytes())])).unwrap().layer,
        "c"
    );
    let kml = b"<kml><Placemark><Point><coordinates>1,2</coordinates></Point></Placemark></kml>";
    assert_eq!(read("a.kmz", &zip(&[("files/x.png", b"x"), ("doc.kml", kml)])).unwrap().features.len(), 1);
    let several = read("a.zip", &zip(&[("a.csv", b"x"), ("b.csv", b"x")])).err().unwrap();
    insta::assert_snapshot!(several, @r#"
    a.zip contains several data files: a.csv, b.csv
      help: unpack it, and specify one of them
    "#);
    insta::assert_snapshot!(read("a.zip", &zip(&[("a.gdb/a.gdbtable", b"x")])).err().unwrap(), @r#"
    a.zip contains a File Geodatabase (.gdb), which is not supported
      help: convert it: ogr2ogr out.gpkg FILE.zip
    "#);
    insta::assert_snapshot!(read("a.xlsx", &zip(&[("xl/workbook.xml", b"x")])).err().unwrap(), @r#"
    a.xlsx is a spreadsheet, which is not supported
      help: save its table as .csv, with columns of longitude and latitude or of well-known text
    "#);
    insta::assert_snapshot!(read("a.gpkg.gz", &gz(b"SQLite format 3\0rest")).err().unwrap(), @r#"
    a.gpkg.gz contains a GeoPackage, which is not supported in an archive
      help: unpack it, and specify the file itself
    "#);
    insta::assert_snapshot!(read("a.gz", &gz(geojson.as_bytes())[..40]).err().unwrap(), @r#"
    a.gz cannot be unpacked
      help: the file is damaged or cut short; download it again
    "#);
}

#[test]
fn latin_geojson_is_read_with_a_note() {
    let text = b"{\"type\":\"Feature\",\"properties\":{\"name\":\"H\xe4user\"},\"geometry\":{\"type\":\"Point\",\"coordinates\":[7,43]}}";
    let table = read_as("a.geojson", text, &SourceOptions::default()).unwrap();
    insta::assert_snapshot!(told(&table), @r#"
    POINT (7 43); name=Text("Häuser")
    note: a.geojson is not UTF-8, which GeoJSON requires, and was read as Windows-1252 (Latin-1); if its texts look wrong, convert it: iconv -f ENCODING -t UTF-8 IN > OUT.geojson
    "#);
    let wide: Vec<u8> = std::str::from_utf8(
        &text[..45].iter().map(|byte| if *byte > 127 { b'x' } else { *byte }).collect::<Vec<_>>(),
    )
    .unwrap()
    .encode_utf16()
    .flat_map(u16::to_le_bytes)
    .collect();
    let error =
        read_as("a.geojson", &[b"\xff\xfe", &wide[..]].concat(), &SourceOptions::default()).err().unwrap();
    assert!(error.message().contains("not GeoJSON"), "{error}");
}
