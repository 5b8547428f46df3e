//! Cameras of the scene: each has a node of its own, whose name is that of the camera.

use super::description::{Description, Node};
use super::place::{rotation, translation};
use crate::check::SceneCheck;
use crate::decompose::y_up;
use burgeon_base::error::Result;
use burgeon_picture::{CameraPose, pose};
use burgeon_scene::image;
use glam::{DAffine3, DMat3, DQuat, DVec3};
use serde_json::json;

/// Ratio of width to height of the pictures to which cameras are fitted.
const ASPECT: f64 = 4.0 / 3.0;
/// Distance (m) up to which a camera sees nothing, at most.
const NEAR: f64 = 0.1;

/// Adds the cameras of a scene, and their nodes to the `roots` of the file. Without a renderer there are none.
pub(super) fn write<'a>(
    checked: &SceneCheck<'a>,
    roots: &mut Vec<usize>,
    description: &mut Description<'a>,
) -> Result<()> {
    if checked.scene.cameras.is_empty() || image::check().is_err() {
        return Ok(());
    }
    let (low, high) = checked.scene.bounds().unwrap_or_default();
    let mut added = Vec::new();
    for camera in &checked.scene.cameras {
        let pose = pose(checked.scene, &camera.view, ASPECT)?;
        let farthest = (pose.eye - low).abs().max((pose.eye - high).abs()).length().max(1.0);
        let mut described = match pose.is_parallel {
            true => json!({ "type": "orthographic", "orthographic": {
                "xmag": pose.shown * 0.5 * ASPECT,
                "ymag": pose.shown * 0.5,
                "zfar": 1.1 * farthest,
                "znear": 0.0,
            } }),
            false => json!({ "type": "perspective", "perspective": {
                "yfov": pose.shown.to_radians(),
                "zfar": 1.1 * farthest + 1000.0,
                "znear": NEAR,
            } }),
        };
        described["name"] = camera.name.as_str().into();
        description.cameras.push(described);
        let place = y_up(&DAffine3::from_translation(pose.eye - checked.origin));
        added.push(description.node(Node {
            camera: Some(description.cameras.len() - 1),
            name: &camera.name,
            rotation: rotation(turn(&pose)),
            translation: translation(place.translation),
            ..Node::default()
        }));
    }
    // With an origin, all nodes are children of its node.
    let origin = roots.first().copied().filter(|_| checked.origin != DVec3::ZERO);
    match origin.and_then(|origin| description.nodes[origin].children.as_mut()) {
        Some(children) => children.extend(added),
        None => roots.extend(added),
    }
    Ok(())
}

/// Returns the rotation of a camera, which looks along -z with y upwards, in the file's coordinates.
fn turn(pose: &CameraPose) -> DQuat {
    let file = |vector: DVec3| DVec3::new(vector.x, vector.z, -vector.y);
    let (back, up) = (-file(pose.forward), file(pose.up));
    DQuat::from_mat3(&DMat3::from_cols(up.cross(back), up, back)).normalize()
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_scene::{CameraView, Instance, Mesh, Scene, SceneCamera};
    use glam::{Vec2, Vec3};

    #[test]
    fn the_cameras_of_a_scene_look_at_their_points() {
        let mut scene = Scene::default();
        let mut mesh = Mesh::default();
        let part = mesh.part(scene.material(&Default::default()));
        part.positions = vec![Vec3::ZERO, Vec3::X * 4.0, Vec3::Y * 3.0];
        (part.normals, part.uvs) = (vec![burgeon_scene::Normal::Z; 3], vec![Vec2::ZERO; 3]);
        part.triangles.push([0, 1, 2]);
        scene.meshes.push(mesh);
        let (transform, name) = (DAffine3::IDENTITY, String::new());
        scene.instances.push(Instance {
            mesh: 0,
            transform,
            name,
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        });
        let (from, to) = (DVec3::new(9.0, -7.0, 5.0), DVec3::new(1.0, 2.0, 0.5));
        for (name, view) in
            [("street", CameraView::Perspective { from, to, fov: 50.0 }), ("map", CameraView::Plan)]
        {
            scene.cameras.push(SceneCamera { name: name.to_owned(), view, place: None });
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        crate::write(&scene, &path, &burgeon_picture::Picture::default()).unwrap();
        let file = gltf::Gltf::open(&path).unwrap();
        let cameras: Vec<_> = file.nodes().filter_map(|node| Some((node.clone(), node.camera()?))).collect();
        assert_eq!(cameras.len(), 2);
        let (node, camera) = &cameras[0];
        assert_eq!((node.name(), camera.name()), (Some("street"), Some("street")));
        let gltf::camera::Projection::Perspective(perspective) = camera.projection() else {
            panic!("parallel")
        };
        assert!((perspective.yfov() - 50_f32.to_radians()).abs() < 1e-4);
        let matrix = glam::Mat4::from_cols_array_2d(&node.transform().matrix());
        let forward = matrix.transform_vector3(Vec3::NEG_Z);
        let expected = (to - from).normalize().as_vec3();
        assert!(forward.distance(Vec3::new(expected.x, expected.z, -expected.y)) < 1e-4, "{forward}");
        assert!(matrix.transform_point3(Vec3::ZERO).distance(Vec3::new(9.0, 5.0, 7.0)) < 1e-5);
        let gltf::camera::Projection::Orthographic(map) = cameras[1].1.projection() else {
            panic!("perspective")
        };
        // The triangle of 4 m by 3 m fills the picture up to its margin.
        assert!((map.ymag() - 0.5 * 3.0 / 0.92).abs() < 0.05 && map.zfar() > map.znear(), "{}", map.ymag());
    }
}
