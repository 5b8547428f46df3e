//! Tests that read the files back with plain readers.

use crate::samples;
use burgeon_picture::Picture;
use burgeon_scene::Scene;
use glam::{DAffine3, DMat3, DVec3};
use std::io::Read;

/// Writes `scene` in the format of `extension`; returns the bytes and the texts of the warnings.
fn written(scene: &Scene, extension: &str) -> (Vec<u8>, Vec<String>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(format!("a.{extension}"));
    let mut files = crate::Files::default();
    files.scene(scene, &path, &Picture::default()).unwrap();
    let warnings = files.take_warnings().iter().map(|it| it.to_string()).collect();
    files.publish().unwrap();
    (std::fs::read(path).unwrap(), warnings)
}

fn float(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()))
}

fn vector(bytes: &[u8], at: usize) -> DVec3 {
    DVec3::new(float(bytes, at), float(bytes, at + 4), float(bytes, at + 8))
}

/// Returns the triangles (mm) of an STL file, and checks that normals agree with the corners.
fn read_stl(bytes: &[u8]) -> Vec<[DVec3; 3]> {
    let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
    assert_eq!(bytes.len(), 84 + 50 * count);
    let read = (0..count).map(|i| {
        let at = 84 + 50 * i;
        let triangle = [1, 2, 3].map(|corner| vector(bytes, at + 12 * corner));
        let normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        assert!(vector(bytes, at).dot(normal) > 0.99 * normal.length() || normal.length() < 1e-3);
        triangle
    });
    read.collect()
}

/// Returns the triangles (m) of a PLY file, and checks that normals point outside.
fn read_ply(bytes: &[u8], flat: bool) -> Vec<[DVec3; 3]> {
    let end = bytes.windows(11).position(|it| it == b"end_header\n").unwrap() + 11;
    let header = String::from_utf8_lossy(&bytes[..end]).into_owned();
    let count = |key: &str| -> usize {
        header.lines().find_map(|line| line.strip_prefix(key)).unwrap().trim().parse().unwrap()
    };
    let (points, faces) = (count("element vertex"), count("element face"));
    assert_eq!(bytes.len(), end + points * 28 + faces * 13);
    let point = |index: usize| vector(bytes, end + index * 28);
    let read = (0..faces).map(|face| {
        let at = end + points * 28 + face * 13;
        assert_eq!(bytes[at], 3);
        let corners =
            [1, 5, 9].map(|i| u32::from_le_bytes(bytes[at + i..at + i + 4].try_into().unwrap()) as usize);
        let triangle = corners.map(point);
        let outside = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]);
        for corner in corners.iter().filter(|_| flat) {
            assert!(vector(bytes, end + corner * 28 + 12).dot(outside) > 0.99 * outside.length());
        }
        triangle
    });
    read.collect()
}

/// Returns the triangles (mm) of a 3MF file.
fn read_three_mf(bytes: &[u8]) -> Vec<[DVec3; 3]> {
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    let mut text = String::new();
    archive.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
    let document = roxmltree::Document::parse(&text).unwrap();
    let object = |id: &str| {
        let mut objects = document.descendants().filter(|it| it.tag_name().name() == "object");
        objects.find(|it| it.attribute("id") == Some(id)).unwrap()
    };
    let named = |name: &'static str| move |it: &roxmltree::Node<'_, '_>| it.tag_name().name() == name;
    let mut triangles = Vec::new();
    for item in document.descendants().filter(named("item")) {
        for component in object(item.attribute("objectid").unwrap()).descendants().filter(named("component"))
        {
            let numbers: Vec<f64> = component
                .attribute("transform")
                .unwrap_or("1 0 0 0 1 0 0 0 1 0 0 0")
                .split(' ')
                .map(|it| it.parse().unwrap())
                .collect();
            let transform = DAffine3::from_cols_slice(&numbers);
            assert!(transform.matrix3.determinant() > 0.0, "readers differ in mirrored transforms");
            let mesh = object(component.attribute("objectid").unwrap());
            let number =
                |it: &roxmltree::Node<'_, '_>, key| it.attribute(key).unwrap().parse::<f64>().unwrap();
            let points: Vec<DVec3> = mesh
                .descendants()
                .filter(named("vertex"))
                .map(|it| DVec3::new(number(&it, "x"), number(&it, "y"), number(&it, "z")))
                .collect();
            for it in mesh.descendants().filter(named("triangle")) {
                let corners =
                    ["v1", "v2", "v3"].map(|key| it.attribute(key).unwrap().parse::<usize>().unwrap());
                triangles.push(corners.map(|corner| transform.transform_point3(points[corner])));
            }
        }
    }
    triangles
}

fn volume(triangles: &[[DVec3; 3]]) -> f64 {
    triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum()
}

#[test]
fn every_format_has_the_triangles_and_the_volume_of_the_scene() {
    let mut count = 0;
    for (name, scene) in
        [("turned", samples::boxes(5)), ("sheared", samples::twisted_tower()), ("many", samples::many(40))]
    {
        let real = samples::volume(&scene);
        let read = [
            (1e9, read_stl(&written(&scene, "stl").0)),
            (1.0, read_ply(&written(&scene, "ply").0, true)),
            (1e9, read_three_mf(&written(&scene, "3mf").0)),
        ];
        for (unit, triangles) in read {
            assert_eq!(triangles.len(), scene.triangles(), "{name}");
            let volume = volume(&triangles) / unit;
            assert!(real > 0.1 && (volume - real).abs() < 1e-4 * real, "{name}: {volume} is not {real}");
            count += 1;
        }
    }
    assert_eq!(count, 9);
}

#[test]
fn closed_shapes_cause_no_warning_and_open_ones_are_named() {
    for extension in ["stl", "ply", "3mf"] {
        assert!(written(&samples::boxes(3), extension).1.is_empty());
        let mut scene = samples::boxes(3);
        // Without its first face, the box has four open edges.
        scene.meshes[0].parts[0].triangles = scene.meshes[0].parts[0].triangles.range(2..12).collect();
        scene.instances[1].feature = Some("way/7".into());
        let (_, warnings) = written(&scene, extension);
        assert_eq!(warnings.len(), 1);
        let begin = format!("a.{extension}: 3 shapes are not closed, with 12 open edges (");
        assert!(warnings[0].starts_with(&begin), "{}", warnings[0]);
        assert!(warnings[0].contains("\"box 1\" of feature \"way/7\": 4"), "{}", warnings[0]);
    }
}

#[test]
fn parts_of_a_mesh_close_each_other() {
    let mut scene = samples::boxes(1);
    scene.materials.push(burgeon_scene::Material::default());
    let mesh = &mut scene.meshes[0];
    let mut lid = mesh.parts[0].clone();
    lid.material = 1;
    lid.triangles = mesh.parts[0].triangles.range(0..5).collect();
    mesh.parts[0].triangles = mesh.parts[0].triangles.range(5..12).collect();
    mesh.parts.push(lid);
    assert_eq!(super::open_edges::open_edges(&scene.meshes[0]), 0);
    scene.meshes[0].parts.pop();
    // Five triangles are missing: two whole sides, next to each other or not, and a half.
    assert!(super::open_edges::open_edges(&scene.meshes[0]) >= 5);
}

#[test]
fn a_flattened_instance_is_stored_flat() {
    let mut scene = samples::boxes(2);
    scene.instances[1].transform.matrix3 = DMat3::from_diagonal(DVec3::new(1.0, 2.0, 0.0));
    let triangles = read_three_mf(&written(&scene, "3mf").0);
    assert_eq!(triangles.len(), 24);
    let low = triangles[12..].iter().flatten().map(|it| it.z.abs()).fold(0.0, f64::max);
    assert!(low < 1e-9, "{low}");
}

#[test]
fn colours_of_materials_are_in_ply_and_3mf() {
    let mut scene = samples::boxes(1);
    scene.materials[0].base_color = [1.0, 0.0, 0.5, 0.25];
    scene.materials[0].name = "Rot <\"&\n".into();
    let (ply, _) = written(&scene, "ply");
    let end = ply.windows(11).position(|it| it == b"end_header\n").unwrap() + 11;
    assert_eq!(ply[end + 24..end + 28], [255, 0, 188, 64]);
    let (bytes, _) = written(&scene, "3mf");
    let mut text = String::new();
    let mut archive = zip::ZipArchive::new(std::io::Cursor::new(&bytes[..])).unwrap();
    archive.by_name("3D/3dmodel.model").unwrap().read_to_string(&mut text).unwrap();
    assert!(
        text.contains("displaycolor=\"#FF00BC40\"") && text.contains("name=\"Rot &lt;&quot;&amp; \""),
        "{text}"
    );
}

#[test]
fn a_file_that_would_be_too_large_is_refused_before_anything_is_written() {
    let mut scene = samples::boxes(1);
    let part = &mut scene.meshes[0].parts[0];
    part.triangles = (0..25_000).map(|_| [0, 1, 2]).collect();
    scene.instances = vec![scene.instances[0].clone(); 1000];
    let folder = tempfile::tempdir().unwrap();
    let error = crate::write(&scene, &folder.path().join("a.stl"), &Picture::default()).unwrap_err();
    insta::assert_snapshot!(error, @r"
    an .stl file with 25,000,000 triangles would have 1.3 GB; the limit is 1.0 GB
      help: write a .glb, which stores repeated models once, reduce the model with --lod, or write parts with --parts N
    ");
    assert!(std::fs::read_dir(folder.path()).unwrap().next().is_none());
}
