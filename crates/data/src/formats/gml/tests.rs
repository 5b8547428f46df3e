//! Tests of files of all versions, and of damaged files.

use std::sync::Arc;
use std::time::Duration;

use crate::{FeatureTable, Layer, Listing, Source, SourceOptions};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

thread_local! {
    /// Folder for the files of a test.
    static FOLDER: tempfile::TempDir = tempfile::tempdir().unwrap();
}

fn read(text: &[u8], wanted: &SourceOptions) -> Result<FeatureTable> {
    let path = FOLDER.with(|folder| folder.path().join("town.gml"));
    std::fs::write(&path, text).unwrap();
    Source::open_within(&path, "town.gml", wanted)?.read("town.gml", wanted)
}

fn plain(text: &str) -> Result<FeatureTable> {
    read(text.as_bytes(), &SourceOptions::default())
}

/// Returns a version 3.2 collection with these members.
fn collection(members: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="UTF-8"?>
<wfs:FeatureCollection xmlns:wfs="http://www.opengis.net/wfs/2.0" xmlns:gml="http://www.opengis.net/gml/3.2" xmlns:t="urn:t" numberReturned="1">
{members}
</wfs:FeatureCollection>"#
    )
}

/// Returns a member with this geometry.
fn house(geometry: &str) -> String {
    format!(r#"<wfs:member><t:House gml:id="h.1"><t:shape>{geometry}</t:shape></t:House></wfs:member>"#)
}

/// Returns the geometries of a collection with one such house as well-known text.
fn shapes(geometry: &str) -> String {
    match plain(&collection(&house(geometry))) {
        Ok(table) => {
            let shapes: Vec<String> =
                table.features.iter().map(|feature| feature.geometry.to_wkt()).collect();
            shapes.join(" ")
        }
        Err(error) => error.message().to_owned(),
    }
}

const SRS: &str = r#"srsName="urn:ogc:def:crs:EPSG::25832""#;

#[test]
fn geometries_of_every_kind_are_read() {
    let line = "<gml:posList>0 0 4 0 4 4</gml:posList>";
    let ring = "<gml:LinearRing><gml:posList>0 0 4 0 4 4 0 0</gml:posList></gml:LinearRing>";
    let hole = "<gml:LinearRing><gml:pos>1 1</gml:pos><gml:pos>2 1</gml:pos><gml:pos>2 2</gml:pos><gml:pos>1 1</gml:pos></gml:LinearRing>";
    let polygon = format!("<gml:exterior>{ring}</gml:exterior><gml:interior>{hole}</gml:interior>");
    let curve = "<gml:Curve><gml:segments><gml:LineStringSegment><gml:posList>0 0 4 0</gml:posList></gml:LineStringSegment><gml:LineStringSegment><gml:posList>4 0 4 4 0 0</gml:posList></gml:LineStringSegment></gml:segments></gml:Curve>";
    let all = [
        format!("<gml:Point {SRS}><gml:pos>1 2</gml:pos></gml:Point>"),
        format!("<gml:Point {SRS} srsDimension='3'><gml:pos>1 2 3</gml:pos></gml:Point>"),
        format!("<gml:LineString {SRS}>{line}</gml:LineString>"),
        format!("<gml:Polygon {SRS}>{polygon}</gml:Polygon>"),
        format!(
            "<gml:Surface {SRS}><gml:patches><gml:PolygonPatch>{polygon}</gml:PolygonPatch></gml:patches></gml:Surface>"
        ),
        format!(
            "<gml:MultiSurface {SRS}><gml:surfaceMember><gml:Polygon>{polygon}</gml:Polygon></gml:surfaceMember><gml:surfaceMembers><gml:Polygon><gml:exterior>{hole}</gml:exterior></gml:Polygon></gml:surfaceMembers></gml:MultiSurface>"
        ),
        format!(
            "<gml:MultiCurve {SRS}><gml:curveMember>{curve}</gml:curveMember><gml:curveMember><gml:LineString>{line}</gml:LineString></gml:curveMember></gml:MultiCurve>"
        ),
        format!(
            "<gml:MultiPoint {SRS}><gml:pointMember><gml:Point><gml:pos>1 2</gml:pos></gml:Point></gml:pointMember><gml:pointMembers><gml:Point><gml:pos>3 4</gml:pos></gml:Point></gml:pointMembers></gml:MultiPoint>"
        ),
        format!(
            "<gml:MultiGeometry {SRS}><gml:geometryMember><gml:Point><gml:pos>1 2</gml:pos></gml:Point></gml:geometryMember><gml:geometryMember><gml:LineString>{line}</gml:LineString></gml:geometryMember></gml:MultiGeometry>"
        ),
        format!(
            "<gml:Polygon {SRS}><gml:exterior><gml:Ring><gml:curveMember>{curve}</gml:curveMember></gml:Ring></gml:exterior></gml:Polygon>"
        ),
        format!(
            "<gml:OrientableCurve {SRS} orientation='-'><gml:baseCurve><gml:LineString>{line}</gml:LineString></gml:baseCurve></gml:OrientableCurve>"
        ),
        format!(
            "<gml:Polygon {SRS}><gml:exterior><gml:LinearRing><gml:posList>0 0 1 4 0 2 4 4 3 0 0 1</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>"
        ),
        format!(
            "<gml:LineString {SRS}><gml:posList srsDimension='3'>0 0 1 4 0 2</gml:posList></gml:LineString>"
        ),
        format!(
            "<gml:LineString {SRS}><gml:coordinates decimal=',' cs=' ' ts=';'>0,5 0;4 0,25</gml:coordinates></gml:LineString>"
        ),
        format!(
            "<gml:LineString {SRS}><gml:coord><gml:X>1</gml:X><gml:Y>2</gml:Y></gml:coord><gml:coord><gml:X>3</gml:X><gml:Y>4</gml:Y><gml:Z>5</gml:Z></gml:coord></gml:LineString>"
        ),
        format!(
            "<gml:Polygon {SRS}><gml:outerBoundaryIs><gml:LinearRing><gml:coordinates>0,0 4,0\n 4,4 0,0</gml:coordinates></gml:LinearRing></gml:outerBoundaryIs></gml:Polygon>"
        ),
    ];
    let read: Vec<String> = all.iter().map(|geometry| shapes(geometry)).collect();
    insta::assert_snapshot!(read.join("\n"), @r#"
    POINT (1 2)
    POINT Z (1 2 3)
    LINESTRING (0 0, 4 0, 4 4)
    POLYGON ((0 0, 4 0, 4 4, 0 0), (1 1, 2 1, 2 2, 1 1))
    POLYGON ((0 0, 4 0, 4 4, 0 0), (1 1, 2 1, 2 2, 1 1))
    POLYGON ((0 0, 4 0, 4 4, 0 0), (1 1, 2 1, 2 2, 1 1)) POLYGON ((1 1, 2 1, 2 2, 1 1))
    LINESTRING (0 0, 4 0, 4 4, 0 0) LINESTRING (0 0, 4 0, 4 4)
    POINT (1 2) POINT (3 4)
    POINT (1 2) LINESTRING (0 0, 4 0, 4 4)
    POLYGON ((0 0, 4 0, 4 4, 0 0))
    LINESTRING (4 4, 4 0, 0 0)
    POLYGON Z ((0 0 1, 4 0 2, 4 4 3, 0 0 1))
    LINESTRING Z (0 0 1, 4 0 2)
    LINESTRING (0.5 0, 4 0.25)
    LINESTRING Z (1 2 0, 3 4 5)
    POLYGON ((0 0, 4 0, 4 4, 0 0))
    "#);
    let arc = format!(
        "<gml:Curve {SRS}><gml:segments><gml:Arc><gml:posList>10 0 0 10 -10 0</gml:posList></gml:Arc></gml:segments></gml:Curve>"
    );
    let circle = arc.replace("Arc", "Circle");
    for (curve, length) in [(arc, 31.4), (circle, 62.8)] {
        let table = plain(&collection(&house(&curve))).unwrap();
        let points: Vec<_> = table.features[0].geometry.points().copied().collect();
        assert!(points.iter().all(|at| (at.length() - 10.0).abs() < 1e-9));
        let told: f64 = points.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        assert!((told - length).abs() < 0.1, "{told}");
    }
}

#[test]
fn coordinates_are_in_the_order_that_their_system_says() {
    let point =
        |srs: &str| shapes(&format!("<gml:Point srsName='{srs}'><gml:pos>60.17 24.94</gml:pos></gml:Point>"));
    assert_eq!(point("urn:ogc:def:crs:EPSG::4326"), "POINT (24.94 60.17)");
    assert_eq!(point("http://www.opengis.net/def/crs/EPSG/0/4326"), "POINT (24.94 60.17)");
    assert_eq!(point("EPSG:4326"), "POINT (60.17 24.94)");
    assert_eq!(point("http://www.opengis.net/gml/srs/epsg.xml#4326"), "POINT (60.17 24.94)");
    // The name of the system comes from around the collection, the feature or the geometry.
    let bounds = |name: &str| {
        format!(
            "<gml:boundedBy><gml:Envelope srsName='{name}'><gml:lowerCorner>60 24</gml:lowerCorner></gml:Envelope></gml:boundedBy>"
        )
    };
    let pos = "<gml:Point><gml:pos>60.17 24.94</gml:pos></gml:Point>";
    let around = format!("{}{}", bounds("urn:ogc:def:crs:EPSG::4258"), house(pos));
    let table = plain(&collection(&around)).unwrap();
    assert_eq!(
        (table.features[0].geometry.to_wkt().as_str(), table.crs.unwrap().code),
        ("POINT (24.94 60.17)", Some(4258))
    );
    let own = house(pos).replace("<t:shape>", &format!("{}<t:shape>", bounds("urn:ogc:def:crs:EPSG::3035")));
    let table = plain(&collection(&own)).unwrap();
    assert_eq!(
        (table.features[0].geometry.to_wkt().as_str(), table.crs.unwrap().code),
        ("POINT (24.94 60.17)", Some(3035))
    );
}

#[test]
fn attributes_are_simple_elements_and_ids_are_those_of_the_file() {
    let text = collection(
        r#"<gml:boundedBy/><wfs:member><t:Tree gml:id="t1"><t:species>Tilia &amp; <![CDATA[co <x>]]></t:species><t:height uom="m">12.5</t:height><t:code>007</t:code><t:number>12</t:number><t:old>true</t:old><t:use xlink:href="http://x/y"/><t:none xsi:nil="true"/><t:address><t:street>High</t:street><t:city><t:zip>1</t:zip></t:city></t:address><t:tag>a</t:tag><t:tag>b</t:tag><t:place><gml:Point srsName="EPSG:3067"><gml:pos>385400 6671500</gml:pos></gml:Point></t:place></t:Tree></wfs:member>
<wfs:member><t:Road gml:id="r1"/></wfs:member>
<gml:featureMembers><t:Tree fid="t2"><t:number>12a</t:number><t:height>3</t:height><t:old>false</t:old><t:where><gml:Point srsName="EPSG:3067"><gml:pos>385410 6671500</gml:pos></gml:Point></t:where></t:Tree><t:Tree><t:where xlink:href='#a'/></t:Tree></gml:featureMembers>"#,
    );
    let error = plain(&text).unwrap_err();
    assert_eq!(
        error.to_string(),
        "town.gml has several layers\n  help: specify one after a colon: \"town.gml:Tree\"; it has Tree, Road"
    );
    let table =
        read(text.as_bytes(), &SourceOptions { layer: Some("Tree".into()), ..SourceOptions::default() })
            .unwrap();
    assert_eq!((table.features.len(), table.empty), (2, 1));
    let told: Vec<String> = table
        .features
        .iter()
        .map(|feature| {
            let of =
                |(name, value): &(usize, crate::Attribute)| format!("{} = {value:?}", table.names[*name]);
            let attributes: Vec<String> = feature.attributes.iter().map(of).collect();
            format!("{}: {}", feature.id, attributes.join(", "))
        })
        .collect();
    insta::assert_snapshot!(told.join("\n"), @r#"
    t1: species = Text("Tilia & co <x>"), height = Number(12.5), code = Text("007"), number = Text("12"), old = Boolean(true), use = Text("http://x/y"), address.street = Text("High"), address.city.zip = Number(1.0), tag = Text("a;b")
    t2: number = Text("12a"), height = Number(3.0), old = Boolean(false)
    "#);
    let latin = "<?xml version='1.0' encoding='ISO-8859-1'?>".as_bytes().iter().copied();
    let body = collection(&house(&format!(
        "<gml:Point {SRS}><gml:pos>1 2</gml:pos></gml:Point></t:shape><t:name>M@nchen</t:name><t:shape>"
    )));
    let body = body.split_once("?>").unwrap().1.bytes().map(|byte| if byte == b'@' { 0xfc } else { byte });
    let table = read(&latin.chain(body).collect::<Vec<u8>>(), &SourceOptions::default()).unwrap();
    assert!(format!("{:?}", table.features[0].attributes).contains("München"));
}

#[test]
fn what_is_wrong_is_said_of_its_feature_or_of_the_file() {
    let point = |inner: &str| house(&format!("<gml:Point {SRS}>{inner}</gml:Point>"));
    let good = point("<gml:pos>1 2</gml:pos>");
    let members = [
        good.clone(),
        point("<gml:pos>1 x</gml:pos>"),
        point("<gml:pos>1</gml:pos>"),
        point("<gml:pos>1<b/></gml:pos>"),
        point("<gml:coordinates>1</gml:coordinates>"),
        house(&format!(
            "<gml:Polygon {SRS}><gml:interior><gml:LinearRing><gml:posList>0 0 1 0 1 1 0 0</gml:posList></gml:LinearRing></gml:interior></gml:Polygon>"
        )),
        house(&format!(
            "<gml:Curve {SRS}><gml:segments><gml:Clothoid><gml:posList>0 0 1 0</gml:posList></gml:Clothoid></gml:segments></gml:Curve>"
        )),
        house(&format!("<gml:Solid {SRS}><gml:exterior/></gml:Solid>")),
        house("<gml:Point srsName='EPSG:3067'><gml:pos>1 2</gml:pos></gml:Point>"),
        house(&format!(
            "<gml:LineString {SRS}><gml:posList srsDimension='3'>1 2 3 4</gml:posList></gml:LineString>"
        )),
        good.clone(),
    ];
    let table = plain(&collection(&members.concat())).unwrap();
    assert_eq!(table.features.len(), 2);
    let told: Vec<&str> = table.refused.iter().map(|(_, error)| error.message()).collect();
    insta::assert_snapshot!(told.join("\n"), @r#"
    feature h.1 of town.gml has "x" instead of a number
    feature h.1 of town.gml has a position of fewer than two numbers
    feature h.1 of town.gml has an element instead of numbers
    feature h.1 of town.gml has a position of fewer than two numbers
    feature h.1 of town.gml has a polygon without an outer ring
    feature h.1 of town.gml has a curve of unsupported type Clothoid
    feature h.1 of town.gml is a solid without a footprint
    feature h.1 of town.gml is in EPSG:3067, and others are in EPSG:25832
    feature h.1 of town.gml has a list of 4 numbers, which is not a multiple of the dimension 3
    "#);
    let told =
        |text: &str| plain(text).and_then(|table| Layer::new(table, &mut None)).unwrap_err().to_string();
    let whole = collection(&good);
    let bomb = whole.replace("<wfs:F", "<!DOCTYPE a [<!ENTITY a 'aaa'><!ENTITY b '&a;&a;'>]>\n<wfs:F");
    let deep = collection(&house(&format!("{}{}", "<a>".repeat(200), "</a>".repeat(200))));
    let all = [
        told(&whole[..whole.len() - 10]),
        told(&whole[..whole.len() / 2]),
        told(&whole.replace("</t:shape>", "</t:form>")),
        told(&bomb),
        told(&whole.replace("1 2", "&a;")),
        told(&deep),
        told(&whole.replace("UTF-8", "Shift_JIS")),
        told("<?xml version='1.0'?><svg/>"),
        told(&collection("")),
        told(&collection(&house("<gml:Point><gml:pos>1 2</gml:pos></gml:Point>"))),
        told(&collection(&house("<gml:Point srsName='#mine'><gml:pos>1 2</gml:pos></gml:Point>"))),
        told(&collection("<wfs:member><t:House/></wfs:member>")),
    ];
    insta::assert_snapshot!(all.join("\n\n"), @r##"
    town.gml cannot be read: at byte 358: syntax error: tag not closed: `>` not found before end of input
      help: the file is damaged or cut short; download it again

    town.gml cannot be read: it ends within an element
      help: the file is damaged or cut short; download it again

    town.gml cannot be read: at byte 319: ill-formed document: expected `</t:shape>`, but `</t:form>` was found
      help: the file is damaged or cut short; download it again

    town.gml cannot be read: it declares its own entities, which are not supported
      help: the file is damaged or cut short; download it again

    town.gml cannot be read: it uses the unknown entity a
      help: the file is damaged or cut short; download it again

    town.gml cannot be read: its elements are nested more than 100 deep
      help: the file is damaged or cut short; download it again

    town.gml has the encoding shift_jis, which is not supported
      help: convert it: iconv -f ENCODING -t UTF-8 IN > OUT.gml, and correct its first line

    town.gml is XML (svg), but contains no GML features
      help: features are in elements named featureMember, featureMembers, member or cityObjectMember; convert another format: ogr2ogr out.gpkg FILE

    town.gml is XML (FeatureCollection), but contains no GML features
      help: features are in elements named featureMember, featureMembers, member or cityObjectMember; convert another format: ogr2ogr out.gpkg FILE

    the layer has no coordinate system
      help: specify its EPSG code: source(file, { crs = 3067 })

    unknown coordinate system "#mine"
      help: specify its EPSG code: source(file, { crs = 3067 })

    town.gml has no features with a geometry
      help: check the file: burgeon sources FILE
    "##);
    let crs = SourceOptions { crs: Some(3067), ..SourceOptions::default() };
    let table =
        read(collection(&house("<gml:Point><gml:pos>385400 6671500</gml:pos></gml:Point>")).as_bytes(), &crs)
            .unwrap();
    assert_eq!((table.features.len(), table.crs.unwrap().code), (1, Some(3067)));
}

#[test]
fn changed_bytes_never_panic_and_take_no_time_and_no_memory() {
    let point = format!(
        "<gml:MultiGeometry {SRS}><gml:geometryMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 4 0 4 4 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:geometryMember></gml:MultiGeometry>"
    );
    let good = collection(&house(&point)).into_bytes();
    let (mut kept, mut refused) = (0, 0);
    for at in 0..good.len() {
        for byte in *b"<>& x" {
            let mut changed = good.clone();
            changed[at] = byte;
            match read(&changed, &SourceOptions::default()) {
                Ok(_) => kept += 1,
                Err(_) => refused += 1,
            }
        }
    }
    assert!(kept > 200 && refused > 200, "{kept} {refused}");
    let long = collection(&house(&format!(
        "<gml:Point {SRS}><gml:pos>{}</gml:pos></gml:Point>",
        "1 ".repeat(3_000_000)
    )));
    let budget = Budget::within(Duration::from_secs(60), 4_000_000);
    let error = read(long.as_bytes(), &SourceOptions { budget, ..SourceOptions::default() }).unwrap_err();
    assert!(error.message().contains("too long"), "{error}");
    let late = SourceOptions { budget: Budget::within(Duration::ZERO, 1 << 30), ..SourceOptions::default() };
    assert!(read(&good, &late).unwrap_err().message().contains("time limit"));
}

#[test]
fn the_date_line_and_listings() {
    let over = house(
        "<gml:LineString srsName='urn:ogc:def:crs:EPSG::4326'><gml:posList>-16 179.99 -16 -179.99</gml:posList></gml:LineString>",
    );
    let text = collection(&format!("{over}<wfs:member><t:Tree/></wfs:member>"));
    let wanted = SourceOptions { layer: Some("House".into()), ..SourceOptions::default() };
    let layer = Layer::new(read(text.as_bytes(), &wanted).unwrap(), &mut None).unwrap();
    assert!(layer.bounds[1][0] - layer.bounds[0][0] < 3000.0, "{:?}", layer.bounds);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("town.gml");
    std::fs::write(&path, text).unwrap();
    let listed = Listing::read(&path, &Arc::default()).unwrap().text();
    insta::assert_snapshot!(listed.replace(&path.display().to_string(), "town.gml"), @r#"
    town.gml: GML
      House: 1 line; EPSG:4326
        from -179.99, -16 to 179.99, -16
      Tree: no features, 1 without geometry; the layer has no coordinate system
    "#);
}
