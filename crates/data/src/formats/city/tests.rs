//! Tests with generated cities: the same buildings in several versions of CityGML and in CityJSON.

use glam::DVec3;

use super::shape::{CityShape, CitySurface, SurfaceRole};
use crate::{Attribute, FeatureTable, Geometry, Listing, Source, SourceOptions};
use burgeon_base::budget::Budget;

/// Returns the outward faces of a box, each with its role.
fn faces([x, y, z]: [f64; 3], [a, b, h]: [f64; 3]) -> Vec<(&'static str, Vec<DVec3>)> {
    let at = |corner: [f64; 2], z: f64| DVec3::new(corner[0], corner[1], z);
    let corners = [[x, y], [x + a, y], [x + a, y + b], [x, y + b]];
    let (low, high): (Vec<DVec3>, Vec<DVec3>) =
        corners.iter().map(|corner| (at(*corner, z), at(*corner, z + h))).unzip();
    let mut all = vec![("GroundSurface", low.iter().rev().copied().collect()), ("RoofSurface", high.clone())];
    all.extend((0..4).map(|side| {
        let next = (side + 1) % 4;
        ("WallSurface", vec![low[side], low[next], high[next], high[side]])
    }));
    all
}

fn polygon(ring: &[DVec3]) -> String {
    let places: Vec<String> =
        ring.iter().chain(ring.first()).map(|at| format!("{} {} {}", at.x, at.y, at.z)).collect();
    format!(
        "<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>{}</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>",
        places.join(" ")
    )
}

fn solid(lod: u32, faces: &[(&str, Vec<DVec3>)]) -> String {
    let faces: String = faces.iter().map(|(_, ring)| polygon(ring)).collect();
    format!(
        "<bldg:lod{lod}Solid><gml:Solid><gml:exterior><gml:CompositeSurface>{faces}</gml:CompositeSurface></gml:exterior></gml:Solid></bldg:lod{lod}Solid>"
    )
}

fn bounded(property: &str, lod: u32, faces: &[(&str, Vec<DVec3>)]) -> String {
    let surface = |(role, ring): &(&str, Vec<DVec3>)| {
        format!(
            "<{property}><bldg:{role}><bldg:lod{lod}MultiSurface><gml:MultiSurface>{}</gml:MultiSurface></bldg:lod{lod}MultiSurface></bldg:{role}></{property}>",
            polygon(ring)
        )
    };
    faces.iter().map(surface).collect()
}

fn model(members: &[String]) -> String {
    let members: String = members
        .iter()
        .map(|member| format!("<core:cityObjectMember>{member}</core:cityObjectMember>"))
        .collect();
    format!(
        "<?xml version='1.0'?><core:CityModel xmlns:core='c' xmlns:gml='g' xmlns:bldg='b' xmlns:gen='n' xmlns:con='o'><gml:boundedBy>\
         <gml:Envelope srsName='urn:ogc:def:crs,crs:EPSG::25832,crs:EPSG::7837' srsDimension='3'><gml:lowerCorner>0 0 0</gml:lowerCorner>\
         </gml:Envelope></gml:boundedBy>{members}</core:CityModel>"
    )
}

fn read(name: &str, text: &str, layer: Option<&str>) -> FeatureTable {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    std::fs::write(&path, text).unwrap();
    let wanted = SourceOptions { layer: layer.map(str::to_owned), ..SourceOptions::default() };
    Source::open_within(&path, name, &wanted).unwrap().read(name, &wanted).unwrap()
}

fn told(table: &FeatureTable) -> String {
    let feature = |feature: &crate::Feature| {
        let of = |(name, value): &(usize, Attribute)| match value {
            Attribute::Text(text) => format!("{}={text}", table.names[*name]),
            Attribute::Number(number) => format!("{}={number}", table.names[*name]),
            other => format!("{}={other:?}", table.names[*name]),
        };
        let known: Vec<String> = feature.attributes.iter().map(of).collect();
        format!("{}: {} m2; {}", feature.id, feature.geometry.area(), known.join(", "))
    };
    table.features.iter().map(feature).collect::<Vec<_>>().join("\n")
}

const HALL: ([f64; 3], [f64; 3]) = ([565_000.0, 5_930_000.0, 12.0], [10.0, 8.0, 9.0]);

#[test]
fn footprints_heights_and_attributes_come_from_citygml_of_each_level_and_version() {
    let hall = faces(HALL.0, HALL.1);
    let known = "<gen:stringAttribute name='owner'><gen:value>town</gen:value></gen:stringAttribute>\
        <gen:measureAttribute name='volume'><gen:value uom='m3'>720</gen:value></gen:measureAttribute><bldg:function>1000</bldg:function>";
    let foot = format!(
        "<bldg:lod0FootPrint><gml:MultiSurface>{}</gml:MultiSurface></bldg:lod0FootPrint>",
        polygon(&hall[0].1)
    );
    let of = |id: &str, content: &str| format!("<bldg:Building gml:id='{id}'>{content}</bldg:Building>");
    let text = model(&[
        of("lod0", &format!("{known}<bldg:measuredHeight uom='m'>9.5</bldg:measuredHeight>{foot}")),
        of("lod1", &format!("{known}{}", solid(1, &hall))),
        of(
            "lod2",
            &format!(
                "<bldg:storeysAboveGround>3</bldg:storeysAboveGround>{}",
                bounded("bldg:boundedBy", 2, &hall)
            ),
        ),
        of(
            "both",
            &format!("{}{}", solid(1, &faces(HALL.0, [10.0, 8.0, 5.0])), bounded("bldg:boundedBy", 2, &hall)),
        ),
        // Version 3 has heights in objects, generic attributes in capitalised elements, and boundaries.
        of(
            "three",
            &format!(
                "<gen:genericAttribute><gen:StringAttribute><gen:name>owner</gen:name><gen:value>duke</gen:value></gen:StringAttribute></gen:genericAttribute>\
                 <con:height><con:Height><con:value uom='m'>9</con:value><con:status>measured</con:status></con:Height></con:height>{}",
                bounded("boundary", 2, &hall)
            ),
        ),
    ]);
    let table = read("town.gml", &text, None);
    assert_eq!(table.crs.as_ref().unwrap().name(), "EPSG:25832");
    insta::assert_snapshot!(told(&table), @r#"
    lod0: 80 m2; owner=town, volume=720, function=1000, measuredHeight=9.5, height=9.5
    lod1: 80 m2; owner=town, volume=720, function=1000, height=9, ground=12
    lod2: 80 m2; storeysAboveGround=3, height=9, ground=12, levels=3
    both: 80 m2; height=9, ground=12
    three: 80 m2; owner=duke, height=9, height.status=measured, ground=12
    "#);
    assert!(table.refused.is_empty() && table.empty == 0, "{:?}", table.refused);
}

#[test]
fn parts_of_a_building_are_features_with_what_the_whole_knows() {
    let part = |id: &str, x: f64, h: f64| {
        let faces = faces([HALL.0[0] + x, HALL.0[1], 12.0], [10.0, 8.0, h]);
        format!(
            "<bldg:consistsOfBuildingPart><bldg:BuildingPart gml:id='{id}'><bldg:roofType>3100</bldg:roofType>{}</bldg:BuildingPart></bldg:consistsOfBuildingPart>",
            bounded("bldg:boundedBy", 2, &faces)
        )
    };
    let parts = [part("p.1", 0.0, 6.0), part("p.2", 10.0, 9.0)].concat();
    let text = model(&[format!(
        "<bldg:Building gml:id='b'><bldg:function>31001_1000</bldg:function>{parts}</bldg:Building>"
    )]);
    insta::assert_snapshot!(told(&read("town.gml", &text, None)), @r#"
    p.1: 80 m2; roofType=3100, function=31001_1000, parent=b, height=6, ground=12
    p.2: 80 m2; roofType=3100, function=31001_1000, parent=b, height=9, ground=12
    "#);
}

#[test]
fn listings_tell_attributes_of_objects_without_a_geometry_as_set() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("town.gml");
    let text =
        model(&["<bldg:Building gml:id='b'><bldg:function>1000</bldg:function></bldg:Building>".to_owned()]);
    std::fs::write(&path, text).unwrap();
    let listed = Listing::read(&path, &std::sync::Arc::default()).unwrap().text();
    assert!(listed.contains("function  set in 1 feature without geometry"), "{listed}");
}

#[test]
fn cityjson_gives_the_same_as_citygml() {
    let hall = faces(HALL.0, HALL.1);
    let text = model(&[format!(
        "<bldg:Building gml:id='b'><bldg:storeysAboveGround>3</bldg:storeysAboveGround>{}</bldg:Building>",
        bounded("bldg:boundedBy", 2, &hall)
    )]);
    let vertices: Vec<[f64; 3]> =
        hall.iter().flat_map(|(_, ring)| ring).map(|at| (*at - DVec3::from(HALL.0)).to_array()).collect();
    let mut next = 0;
    let boundaries: Vec<Vec<Vec<usize>>> = hall
        .iter()
        .map(|(_, ring)| {
            next += ring.len();
            vec![(next - ring.len()..next).collect()]
        })
        .collect();
    let roles: Vec<_> = hall.iter().map(|(role, _)| serde_json::json!({ "type": role })).collect();
    let values: Vec<usize> = (0..hall.len()).collect();
    let geometry = |kind: &str, roles: serde_json::Value| {
        let boundaries =
            if kind == "Solid" { serde_json::json!([boundaries]) } else { serde_json::json!(boundaries) };
        serde_json::json!({ "type": kind, "lod": "2.2", "boundaries": boundaries, "semantics": roles })
    };
    let document = |geometry: serde_json::Value| {
        serde_json::json!({
            "type": "CityJSON", "version": "2.0",
            "transform": { "scale": [1.0, 1.0, 1.0], "translate": HALL.0 },
            "metadata": { "referenceSystem": "https://www.opengis.net/def/crs/EPSG/0/25832" },
            "CityObjects": { "b": { "type": "Building", "attributes": { "storeysAboveGround": 3 }, "geometry": [geometry] } },
            "vertices": vertices,
        })
        .to_string()
    };
    let expected = told(&read("town.gml", &text, None));
    let surfaces = serde_json::json!({ "surfaces": roles, "values": values });
    assert_eq!(told(&read("town.city.json", &document(geometry("MultiSurface", surfaces)), None)), expected);
    assert_eq!(
        told(&read("town.json", &document(geometry("Solid", serde_json::Value::Null)), None)),
        expected
    );
}

#[test]
fn a_building_with_a_footprint_alone_is_high_as_its_parts_are() {
    let vertices =
        [[0, 0, 0], [10, 0, 0], [10, 8, 0], [0, 8, 0], [0, 0, 9], [10, 0, 9], [10, 8, 9], [0, 8, 9]];
    let shell =
        [[[0, 3, 2, 1]], [[4, 5, 6, 7]], [[0, 1, 5, 4]], [[1, 2, 6, 5]], [[2, 3, 7, 6]], [[3, 0, 4, 7]]];
    let text = serde_json::json!({
        "type": "CityJSON", "version": "2.0", "vertices": vertices,
        "metadata": { "referenceSystem": "urn:ogc:def:crs:EPSG::7415" },
        "CityObjects": {
            "b": { "type": "Building", "children": ["b-0"], "attributes": { "name": "a" },
                   "geometry": [{ "type": "MultiSurface", "lod": "0", "boundaries": [[[0, 1, 2, 3]]] }] },
            "b-0": { "type": "BuildingPart", "parents": ["b"],
                     "geometry": [{ "type": "Solid", "lod": "1.2", "boundaries": [shell] }] },
        },
    })
    .to_string();
    insta::assert_snapshot!(told(&read("a.city.json", &text, Some("Building"))), @"b: 80 m2; name=a, height=9, ground=0");
    insta::assert_snapshot!(told(&read("a.city.json", &text, Some("BuildingPart"))), @"b-0: 80 m2; parent=b, height=9, ground=0");
}

#[test]
fn grounds_of_many_faces_become_one_footprint_far_from_the_origin() {
    for scale in 0..300_u32 {
        let (columns, rows) = (1 + scale % 7, 1 + scale % 5);
        let side = 0.37 + f64::from(scale) * 0.013;
        let origin = DVec3::new(385_000.123 + f64::from(scale), 6_672_000.456, 3.0);
        let mut shape = CityShape::default();
        for cell in 0..columns * rows {
            let low =
                origin + DVec3::new(f64::from(cell % columns) * side, f64::from(cell / columns) * side, 0.0);
            let [a, b, c, d] = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| {
                // Corners shared by faces are bitwise equal, as in files.
                let round = |value: f64| (value * 1000.0).round() / 1000.0;
                DVec3::new(round(low.x + x * side), round(low.y + y * side), 3.0)
            });
            for rings in [vec![vec![a, c, b]], vec![vec![a, d, c]]] {
                shape.surfaces.push(CitySurface {
                    rings,
                    role: SurfaceRole::Ground,
                    level: 20,
                    is_solid: true,
                });
            }
        }
        let made = shape.footprint(&Budget::default()).unwrap();
        let area: f64 = made.iter().map(Geometry::area).sum();
        let expected: f64 =
            shape.surfaces.iter().map(|face| Geometry::polygon(face.rings.clone()).unwrap().area()).sum();
        assert_eq!(made.len(), 1, "{scale}");
        assert!((area - expected).abs() < 1e-6 * expected, "{scale}: {area} of {expected}");
    }
}
