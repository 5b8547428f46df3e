//! Tests of the text. The script `tests/clients.py` reads files with USD itself.

use crate::samples;
use burgeon_picture::Picture;
use burgeon_scene::Scene;

fn written(scene: &Scene) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.usda");
    crate::write(scene, &path, &Picture::default()).unwrap();
    std::fs::read_to_string(path).unwrap()
}

#[test]
fn similar_instances_become_point_instancers_and_others_references() {
    let text = written(&samples::many(60));
    // One of them is of the mirrored instances.
    assert_eq!(text.matches("def PointInstancer").count(), 2);
    assert_eq!(text.matches("float3 xformOp:scale = (-1, 1, 1)").count(), 1);
    assert_eq!(text.matches("def Mesh ").count(), 1, "the mesh is stored once");
    let few = written(&samples::boxes(5));
    assert_eq!(
        (few.matches("def PointInstancer").count(), few.matches("instanceable = true").count()),
        (0, 5)
    );
    // A sheared instance has no rotation and scale of its own.
    assert!(
        written(&samples::twisted_tower())
            .contains("matrix4d xformOp:transform = ((1, 0, 0, 0), (0.6, 1, 0.1, 0)")
    );
}

#[test]
fn the_stage_has_metres_z_up_and_the_origin_of_a_far_model() {
    let text = written(&samples::far_box());
    assert!(text.starts_with("#usda 1.0\n(\n    defaultPrim = \"World\"\n"), "{text}");
    assert!(text.contains("metersPerUnit = 1\n    upAxis = \"Z\""), "{text}");
    assert!(text.contains("double3 xformOp:translate = (531000, 4556000, 0)"), "{text}");
}

#[test]
fn names_and_features_with_quotes_and_line_breaks_stay_inside_their_strings() {
    let mut scene = samples::boxes(1);
    scene.instances[0].name = "Haus „am Ring“ / 家 😀".into();
    scene.instances[0].feature = Some("a \"quoted\"\\id\n".into());
    scene.materials[0].name = "1 <Putz>".into();
    let text = written(&scene);
    assert!(text.contains("displayName = \"Haus „am Ring“ / 家 😀\""), "{text}");
    assert!(text.contains("userProperties:feature = \"a \\\"quoted\\\"\\\\id \""), "{text}");
    assert!(text.contains("def Material \"material_0_1__Putz\""), "{text}");
    assert!(text.contains("rel material:binding = </World/Materials/material_0_1__Putz>"), "{text}");
}

#[test]
fn textures_are_copied_and_connected() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::textured_boxes(folder.path());
    let path = folder.path().join("out.usda");
    crate::write(&scene, &path, &Picture::default()).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert!(
        text.contains("asset inputs:file = @./out_brick.png@") && folder.path().join("out_leaf.jpg").exists()
    );
    assert_eq!(text.matches("inputs:diffuseColor.connect").count(), 3);
    assert!(text.contains("primvars:st"));
}

#[test]
fn normal_maps_are_directions_and_not_colours() {
    let folder = tempfile::tempdir().unwrap();
    let scene = samples::relief_boxes(folder.path());
    let path = folder.path().join("out.usda");
    crate::write(&scene, &path, &Picture::default()).unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    assert_eq!(text.matches("normal3f inputs:normal.connect").count(), 2);
    assert_eq!(text.matches("asset inputs:file = @./out_waves.png@").count(), 2);
    assert_eq!(text.matches("token inputs:sourceColorSpace = \"raw\"").count(), 2);
    assert!(text.contains("float4 inputs:bias = (-0.5, -0.5, -1, 0)"), "{text}");
    assert_eq!(text.matches("def Shader \"Coordinates\"").count(), 3);
    assert_eq!(text.matches("primvars:st").count(), 3);
}
