//! Tests with a reader of X3D that knows the nodes that are written, according to the schema of X3D 3.3.

use std::collections::{HashMap, HashSet};
use std::path::Path;

use burgeon_scene::Scene;
use glam::{DAffine3, DQuat, DVec3};
use roxmltree::{Document, Node, ParsingOptions};

use super::super::samples;
use burgeon_picture::Picture;

/// Allowed nodes, each with its attributes and its allowed children, in this order.
const NODES: [(&str, &[&str], &[&str]); 23] = [
    ("X3D", &["profile", "version", "noNamespaceSchemaLocation"], &["head", "Scene"]),
    ("head", &[], &["meta"]),
    ("meta", &["name", "content"], &[]),
    ("Scene", &[], &["Transform", "ProtoDeclare", "ProtoInstance"]),
    (
        "Transform",
        &FIELDS,
        &["IS", "MetadataString", "Transform", "ProtoDeclare", "ProtoInstance", "Group", "Shape"],
    ),
    ("Group", &["DEF", "USE"], &["Shape"]),
    ("MetadataString", &["name", "value"], &["IS"]),
    ("Shape", &[], &["Appearance", "IndexedTriangleSet"]),
    ("Appearance", &["DEF", "USE"], &["Material", "ImageTexture"]),
    ("Material", &["diffuseColor", "specularColor", "shininess", "emissiveColor", "transparency"], &[]),
    ("ImageTexture", &["url"], &[]),
    ("IndexedTriangleSet", &["solid", "index"], &["Coordinate", "Normal", "TextureCoordinate"]),
    ("Coordinate", &["point"], &[]),
    ("Normal", &["vector"], &[]),
    ("TextureCoordinate", &["point"], &[]),
    ("ProtoDeclare", &["name"], &["ProtoInterface", "ProtoBody"]),
    ("ProtoInterface", &[], &["field"]),
    ("field", &["name", "type", "accessType", "value"], &[]),
    ("ProtoBody", &[], &["Transform"]),
    ("IS", &[], &["connect"]),
    ("connect", &["nodeField", "protoField"], &[]),
    ("ProtoInstance", &["name"], &["fieldValue"]),
    ("fieldValue", &["name", "value"], &[]),
];

const FIELDS: [&str; 4] = ["translation", "rotation", "scale", "scaleOrientation"];

/// Content of a file.
#[derive(Default)]
struct X3dContent {
    /// Corners of triangles in world coordinates, y up, with their normals.
    triangles: Vec<[(DVec3, DVec3); 3]>,
    shapes: usize,
    features: Vec<String>,
    prototypes: usize,
    instances: usize,
    uses: usize,
}

/// Reader that validates the whole file.
struct X3dReader<'a> {
    text: &'a str,
    named: HashMap<&'a str, Node<'a, 'a>>,
    prototypes: HashMap<&'a str, (Node<'a, 'a>, HashSet<&'a str>)>,
    shown: X3dContent,
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|number| number.parse().unwrap()).collect()
}

fn vectors(text: &str) -> Vec<DVec3> {
    let numbers = numbers(text);
    assert!(numbers.len().is_multiple_of(3) && numbers.iter().all(|number| number.is_finite()));
    numbers.chunks(3).map(DVec3::from_slice).collect()
}

fn place(values: &HashMap<&str, &str>) -> DAffine3 {
    let vector = |name: &str, default: DVec3| values.get(name).map_or(default, |text| vectors(text)[0]);
    let turn = |name: &str| {
        let Some(text) = values.get(name) else { return DQuat::IDENTITY };
        let numbers = numbers(text);
        assert_eq!(numbers.len(), 4, "{text}");
        DQuat::from_axis_angle(DVec3::from_slice(&numbers).normalize(), numbers[3])
    };
    let axes = turn("scaleOrientation");
    DAffine3::from_translation(vector("translation", DVec3::ZERO))
        * DAffine3::from_quat(turn("rotation") * axes)
        * DAffine3::from_scale(vector("scale", DVec3::ONE))
        * DAffine3::from_quat(axes.inverse())
}

impl<'a> X3dReader<'a> {
    /// Checks that all nodes and their attributes are known and in order, and that every reference follows its
    /// definition.
    fn check(&mut self, node: Node<'a, 'a>) {
        let name = node.tag_name().name();
        let (_, attributes, children) =
            NODES.iter().find(|(known, ..)| *known == name).unwrap_or_else(|| panic!("{name}"));
        for attribute in node.attributes() {
            assert!(attributes.contains(&attribute.name()), "{name} has no {}", attribute.name());
            if attribute.name().ends_with("Color") {
                let color = numbers(attribute.value());
                assert!(color.len() == 3 && color.iter().all(|part| (0.0..=1.0).contains(part)));
                assert!(!attribute.value().contains('e'));
            }
        }
        let mut last = 0;
        for child in node.children().filter(Node::is_element) {
            let child = child.tag_name().name();
            let order = children.iter().position(|known| *known == child);
            let order = order.unwrap_or_else(|| panic!("{name} holds {child}"));
            let groups = ["Scene", "Transform"].contains(&name) && order > 1;
            assert!(order >= last || groups, "{child} comes late in {name}");
            last = order;
        }
        if let Some(used) = node.attribute("USE") {
            let known = self.named.get(used).unwrap_or_else(|| panic!("{used} is used and not there"));
            assert_eq!(known.tag_name().name(), name);
            assert!(!node.has_children());
            self.shown.uses += 1;
        }
        if name == "ProtoInstance" {
            let (_, fields) = &self.prototypes[node.attribute("name").unwrap()];
            for value in node.children().filter(Node::is_element) {
                assert!(fields.contains(value.attribute("name").unwrap()));
            }
        }
        node.children().filter(Node::is_element).for_each(|child| self.check(child));
        if let Some(name) = node.attribute("DEF") {
            assert!(
                name.starts_with(|it: char| it.is_ascii_alphabetic())
                    && self.named.insert(name, node).is_none()
            );
        }
        if name == "ProtoDeclare" {
            let of = |name: &str| node.children().find(|child| child.has_tag_name(name)).unwrap();
            let fields: HashSet<&str> =
                of("ProtoInterface").children().filter_map(|field| field.attribute("name")).collect();
            for connect in of("ProtoBody").descendants().filter(|node| node.has_tag_name("connect")) {
                assert!(fields.contains(connect.attribute("protoField").unwrap()));
            }
            let name = node.attribute("name").unwrap();
            assert!(self.prototypes.insert(name, (of("ProtoBody"), fields)).is_none());
            self.shown.prototypes += 1;
        }
    }

    /// Records the content of `node` at `at`; `values` are the parameters of the enclosing prototype.
    fn show(&mut self, node: Node<'a, 'a>, at: DAffine3, values: &HashMap<&'a str, &'a str>) {
        let of = |name: &'static str| node.children().find(move |child| child.has_tag_name(name));
        match node.tag_name().name() {
            "ProtoDeclare" | "head" => {}
            "Transform" => {
                let own: HashMap<&str, &str> =
                    node.attributes().map(|attribute| (attribute.name(), attribute.value())).collect();
                let connected = of("IS").is_some();
                let at = at * place(if connected { values } else { &own });
                let none = HashMap::new();
                for child in node.children().filter(Node::is_element) {
                    self.show(child, at, if connected { values } else { &none });
                }
            }
            "MetadataString" => {
                let value = node.attribute("value").or(values.get("feature").copied());
                self.shown.features.extend(value.map(str::to_owned));
            }
            "ProtoInstance" => {
                let (body, _) = self.prototypes[node.attribute("name").unwrap()];
                let values = node
                    .children()
                    .filter_map(|child| Some((child.attribute("name")?, child.attribute("value")?)));
                let values = values.collect();
                self.shown.instances += 1;
                self.show(body, at, &values);
            }
            "Shape" => self.show_shape(node, at),
            _ => {
                let node = node.attribute("USE").map_or(node, |used| self.named[used]);
                node.children().filter(Node::is_element).for_each(|child| self.show(child, at, values));
            }
        }
    }

    fn show_shape(&mut self, node: Node<'a, 'a>, at: DAffine3) {
        let find =
            |name: &'static str| node.descendants().find(move |child| child.has_tag_name(name)).unwrap();
        let points = vectors(find("Coordinate").attribute("point").unwrap());
        let normals = vectors(find("Normal").attribute("vector").unwrap());
        assert_eq!(points.len(), normals.len());
        if let Some(coordinates) = node.descendants().find(|child| child.has_tag_name("TextureCoordinate")) {
            assert_eq!(numbers(coordinates.attribute("point").unwrap()).len(), points.len() * 2);
        }
        let index: Vec<usize> = find("IndexedTriangleSet")
            .attribute("index")
            .unwrap()
            .split(' ')
            .map(|number| number.parse().unwrap())
            .collect();
        assert!(!index.is_empty() && index.len().is_multiple_of(3), "{}", self.text);
        let turned = at.matrix3.inverse().transpose();
        assert!(at.matrix3.determinant() >= 0.0);
        let corner = |index: usize| (at.transform_point3(points[index]), turned * normals[index]);
        self.shown.triangles.extend(index.chunks(3).map(|it| [corner(it[0]), corner(it[1]), corner(it[2])]));
        self.shown.shapes += 1;
    }
}

fn read(path: &Path) -> (X3dContent, String) {
    let text = std::fs::read_to_string(path).unwrap();
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(&text, options).unwrap();
    let mut reader = X3dReader {
        text: &text,
        named: HashMap::new(),
        prototypes: HashMap::new(),
        shown: X3dContent::default(),
    };
    reader.check(document.root_element());
    reader.show(document.root_element(), DAffine3::IDENTITY, &HashMap::new());
    let shown = reader.shown;
    (shown, text)
}

fn write_and_read(scene: &Scene) -> (X3dContent, String) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.x3d");
    crate::write(scene, &path, &Picture::default()).unwrap();
    read(&path)
}

#[test]
fn every_sample_is_valid_and_shows_all_triangles_with_normals_outside() {
    let folder = tempfile::tempdir().unwrap();
    let mut shapes = 0;
    for (name, scene) in samples::all(folder.path()) {
        let path = folder.path().join(format!("{name}.x3d"));
        crate::write(&scene, &path, &Picture::default()).unwrap();
        let (shown, _) = read(&path);
        shapes += shown.shapes;
        if name == "odd" {
            // This sample has triangles without area, which are not written.
            continue;
        }
        assert_eq!(shown.triangles.len(), scene.triangles(), "{name}");
        if ["twisted", "boxes", "many", "town"].contains(&name) {
            let mut volume = 0.0;
            for corners in &shown.triangles {
                let [a, b, c] = corners.map(|(point, _)| point);
                volume += a.dot(b.cross(c)) / 6.0;
                let outside = (b - a).cross(c - a);
                assert!(
                    corners
                        .iter()
                        .all(|(_, normal)| { normal.normalize().dot(outside) > 0.99 * outside.length() }),
                    "{name}"
                );
            }
            if name != "town" {
                let real = samples::volume(&scene);
                assert!((volume - real).abs() < 1e-3 * real, "{name}: {volume} is not {real}");
            }
        }
    }
    assert!(shapes > 1000, "{shapes}");
}

#[test]
fn placed_models_are_instances_of_prototypes_and_other_shared_meshes_are_used() {
    let mut scene = samples::many(30);
    let (shown, text) = write_and_read(&scene);
    assert_eq!((shown.prototypes, shown.instances, shown.shapes), (0, 0, 30));
    // One group is unchanged and one is mirrored, and each is defined once. The material is referred to from the second
    // use on.
    assert_eq!((text.matches("<IndexedTriangleSet").count(), shown.uses), (2, 29));
    for (number, instance) in scene.instances.iter_mut().enumerate() {
        instance.placement = Some(number);
        instance.feature = (number % 2 == 0).then(|| format!("way/{number}"));
    }
    let (shown, text) = write_and_read(&scene);
    assert_eq!((shown.prototypes, shown.instances, shown.shapes), (2, 30, 30));
    assert_eq!(text.matches("<IndexedTriangleSet").count(), 2);
    assert_eq!(shown.features.len(), 15);
    assert_eq!(shown.features[1], "\"way/2\"");
}

#[test]
fn odd_names_stay_readable_and_what_xml_cannot_hold_is_replaced() {
    let mut scene = samples::boxes(1);
    scene.materials[0].name = "']]><!-- Stahl „poliert“ & more".into();
    scene.meshes[0].name = "\u{0}'\"".into();
    scene.instances[0].feature = Some("a\\\"b\"<&>\u{0}\u{b}\n\t'ü家\u{ffff}".into());
    let (shown, text) = write_and_read(&scene);
    assert_eq!(shown.features, ["\"a\\\\\\\"b\\\"<&>\u{fffd}\u{fffd}\n\t'ü家\u{fffd}\""]);
    assert!(text.contains("DEF='material_0_Stahl__poliert____more'"), "{text}");
}

#[test]
fn a_far_model_is_moved_by_one_transform() {
    let (shown, text) = write_and_read(&samples::far_box());
    assert!(text.contains("<Transform translation='531000 0 -4556000'>"), "{text}");
    assert!(shown.triangles.iter().flatten().all(|(point, _)| point.x > 5e5));
}

#[test]
fn a_material_has_its_colours_its_light_and_how_much_shines_through() {
    let folder = tempfile::tempdir().unwrap();
    let all = samples::all(folder.path());
    let (_, materials) = all.iter().find(|(name, _)| *name == "materials").unwrap();
    let (_, text) = write_and_read(materials);
    assert!(
        text.contains("transparency='0.6000'") && text.contains("emissiveColor='1.0000 1.0000 0.7354'"),
        "{text}"
    );
    assert!(text.contains("solid='false'"));
    let (_, textured) = all.iter().find(|(name, _)| *name == "textured").unwrap();
    let path = folder.path().join("out town.x3d");
    crate::write(textured, &path, &Picture::default()).unwrap();
    let (_, text) = read(&path);
    assert!(text.contains("url='&quot;out%20town_brick.png&quot;'"), "{text}");
    assert!(folder.path().join("out town_brick.png").is_file());
}

#[test]
fn a_normal_map_that_the_file_cannot_have_is_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::relief_boxes(folder.path());
    let path = folder.path().join("out.x3d");
    let mut files = crate::Files::default();
    files.scene(&scene, &path, &Picture::default()).unwrap();
    let warnings: Vec<String> = files.take_warnings().iter().map(ToString::to_string).collect();
    assert!(warnings[0].contains("out.x3d has no normal map of 2 materials"), "{warnings:?}");
}
