//! Scenes for the tests of all formats.

use burgeon_scene::{DirtMap, Instance, Material, Mesh, NormalMap, Part, Scene, Texture};
use glam::{DAffine3, DMat3, DQuat, DVec3, Vec2, Vec3};
use std::path::Path;

/// Returns the box from (-0.5, -0.5, 0) to (0.5, 0.5, 1), with four points for each side.
pub(super) fn cube(name: &str, material: usize) -> Mesh {
    let mut part = Part { material, ..Part::default() };
    for axis in 0..3 {
        for sign in [1.0_f32, -1.0] {
            let normal = Vec3::AXES[axis] * sign;
            let (u, v) = (Vec3::AXES[(axis + 1) % 3] * sign, Vec3::AXES[(axis + 2) % 3]);
            let first = part.positions.len() as u32;
            for (x, y) in [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)] {
                part.positions.push(normal * 0.5 + u * x + v * y + Vec3::Z * 0.5);
                part.normals.push(normal.into());
                part.uvs.push(Vec2::new(x + 0.5, y + 0.5));
            }
            part.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
        }
    }
    Mesh { name: name.into(), parts: vec![part], ..Mesh::default() }
}

fn instance(mesh: usize, name: &str, transform: DAffine3) -> Instance {
    Instance {
        mesh,
        transform,
        name: name.into(),
        feature: None,
        origin: None,
        placement: None,
        meaning: None,
    }
}

fn plaster() -> Material {
    Material { name: "plaster".into(), ..Material::default() }
}

/// Returns a row of `count` boxes, rotated and scaled. Each has a name except the first.
pub(super) fn boxes(count: usize) -> Scene {
    let mut scene = Scene {
        materials: vec![plaster()],
        meshes: vec![cube("box", 0)],
        instances: vec![],
        ..Scene::default()
    };
    for i in 0..count {
        let step = i as f64;
        let transform = DAffine3::from_scale_rotation_translation(
            DVec3::new(1.0 + 0.2 * step, 1.0, 1.0 + step),
            DQuat::from_rotation_z(0.3 * step),
            DVec3::new(3.0 * step, step, 0.0),
        );
        scene.instances.push(instance(0, &format!("box {i}"), transform));
    }
    scene
}

/// Returns `count` boxes on a spiral that differ only in their transforms; every third is mirrored.
pub(super) fn many(count: usize) -> Scene {
    let mut scene = boxes(0);
    for i in 0..count {
        let step = i as f64;
        let x = if i % 3 == 0 { -1.0 } else { 1.0 };
        let transform = DAffine3::from_scale_rotation_translation(
            DVec3::new(x, 1.0 + step * 0.01, 2.0),
            DQuat::from_rotation_z(step) * DQuat::from_rotation_x(0.1),
            DVec3::new(step * step.cos(), step * step.sin(), 0.0),
        );
        scene.instances.push(instance(0, "", transform));
    }
    scene
}

/// Returns a sheared, a mirrored and a sheared mirrored box, and a flattened one.
pub(super) fn twisted_tower() -> Scene {
    let mut scene = boxes(0);
    let shear = DMat3::from_cols(DVec3::X, DVec3::new(0.6, 1.0, 0.1), DVec3::new(0.0, 0.4, 2.0));
    let mirror = DMat3::from_diagonal(DVec3::new(1.0, -2.0, 1.0));
    for (i, matrix) in [shear, mirror, shear * mirror].into_iter().enumerate() {
        let transform = DAffine3::from_mat3_translation(matrix, DVec3::X * 5.0 * i as f64);
        scene.instances.push(instance(0, "twisted", transform));
    }
    scene
}

/// Returns three boxes at coordinates far from the origin.
pub(super) fn far_box() -> Scene {
    let mut scene = boxes(3);
    for instance in &mut scene.instances {
        instance.transform.translation += DVec3::new(530_997.0, 4_555_999.0, 80.0);
    }
    scene
}

/// Returns boxes with two images: one used by two materials, and a second one.
pub(super) fn textured_boxes(folder: &Path) -> Scene {
    let brick = image::RgbImage::from_fn(64, 32, |x, y| {
        if y % 8 == 0 || (x + y / 8 * 8) % 16 == 0 {
            image::Rgb([200, 190, 90])
        } else {
            image::Rgb([170, 60, 40])
        }
    });
    brick.save(folder.join("brick.png")).unwrap();
    image::RgbImage::from_pixel(16, 16, image::Rgb([40, 120, 30])).save(folder.join("leaf.jpg")).unwrap();
    let material = |name: &str, file: &str, size| Material {
        name: name.into(),
        base_color: [1.0; 4],
        texture: Some(Texture { path: folder.join(file), size, content: None }),
        ..Material::default()
    };
    let materials = vec![
        material("brick", "brick.png", [0.5, 0.25]),
        material("leaf", "leaf.jpg", [1.0, 1.0]),
        Material { double_sided: true, ..material("brick 2", "brick.png", [0.5, 2.0 / 3.0]) },
    ];
    let mut scene = Scene { materials, ..Scene::default() };
    for i in 0..3 {
        scene.meshes.push(cube("textured", i));
        scene.instances.push(instance(i, "", DAffine3::from_translation(DVec3::X * 2.0 * i as f64)));
    }
    scene
}

/// Returns boxes with normal maps: one alone, and one with a texture.
pub(super) fn relief_boxes(folder: &Path) -> Scene {
    let mut scene = textured_boxes(folder);
    let waves = |x: u32, _| {
        let slope = (f64::from(x) / 32.0 * std::f64::consts::TAU).cos() * 0.7;
        let part = |value: f64| ((value + 1.0) * 127.5).round() as u8;
        image::Rgb([part(slope), 128, part((1.0 - slope * slope).sqrt())])
    };
    image::RgbImage::from_fn(32, 16, waves).save(folder.join("waves.png")).unwrap();
    for (material, scale) in scene.materials.iter_mut().zip([1.0, 0.5]) {
        let size = material.image_size().unwrap();
        let image = Texture { path: folder.join("waves.png"), size, content: None };
        material.normal_map = Some(NormalMap { image, scale });
    }
    scene.materials[1].texture = None;
    scene
}

/// Returns textured boxes, of which two have dirt maps: one by a second set of texture coordinates, and one without a texture.
pub(super) fn stained_boxes(folder: &Path) -> Scene {
    let mut scene = textured_boxes(folder);
    let stain = image::RgbImage::from_fn(8, 8, |x, y| image::Rgb([(x * 30) as u8, (y * 30) as u8, 90]));
    stain.save(folder.join("stain.png")).unwrap();
    let image = Texture { path: folder.join("stain.png"), size: [4.0, 2.0], content: None };
    let map = |set: &str| Some(DirtMap { image: image.clone(), set: set.into() });
    (scene.materials[0].dirt_map, scene.materials[1].dirt_map) = (map("dirt"), map(""));
    scene.materials[1].texture = None;
    let part = &mut scene.meshes[0].parts[0];
    part.second_uvs = part.positions.iter().map(|at| Vec2::new(at.x * 12.0 + at.z, at.y * 3.0)).collect();
    scene
}

/// Returns materials of all types, on boxes in a row.
fn materials() -> Scene {
    let named = |name: &str| Material { name: name.into(), ..Material::default() };
    let materials = vec![
        Material { base_color: [0.1, 0.2, 0.8, 0.4], ..named("glass") },
        Material { emissive: [9.0, 4.0, 0.5], ..named("lamp") },
        Material { emissive: [0.2, 0.2, 0.2], ..named("lamp") },
        Material { double_sided: true, base_color: [0.1, 0.6, 0.1, 1.0], ..named("") },
        Material { metallic: 1.0, roughness: 0.1, ..named("Stahl „poliert“ 鋼") },
    ];
    let mut scene = Scene { materials, ..Scene::default() };
    for i in 0..5 {
        scene.meshes.push(cube("sample", i));
        scene.instances.push(instance(i, "sample", DAffine3::from_translation(DVec3::Y * 2.0 * i as f64)));
    }
    scene
}

/// Returns a box whose sides have different materials, with one part without triangles, and invalid normals and
/// corners.
fn odd() -> Scene {
    let mut scene = boxes(1);
    scene.materials.push(Material { base_color: [0.7, 0.1, 0.1, 1.0], ..plaster() });
    scene.materials.push(Material { base_color: [0.1, 0.7, 0.1, 1.0], ..plaster() });
    let mesh = &mut scene.meshes[0];
    let mut roof = mesh.parts[0].clone();
    roof.material = 1;
    roof.triangles = mesh.parts[0].triangles.iter().skip(6).collect();
    mesh.parts[0].triangles.truncate(6);
    roof.normals[0] = Vec3::ZERO.into();
    roof.normals[1] = Vec3::NAN.into();
    roof.normals[2] = Vec3::splat(1e-30).into();
    roof.triangles.push([3, 3, 4]);
    mesh.parts.push(roof.clone());
    mesh.parts.push(Part { material: 2, triangles: vec![[1, 1, 1]].into(), ..roof.clone() });
    mesh.parts.push(Part { material: 2, ..Part::default() });
    scene.meshes.push(Mesh { name: "never shown".into(), parts: vec![roof], ..Mesh::default() });
    scene.meshes.push(Mesh::default());
    scene.instances.push(instance(2, "nothing", DAffine3::IDENTITY));
    scene
}

/// Returns a hill of `n` by `n` squares. From `n` = 256 on it has more points than a u16 can index.
pub(super) fn hill(n: u32) -> Scene {
    let mut part = Part::default();
    for i in 0..=n {
        for j in 0..=n {
            let (x, y) = (i as f32 / n as f32 * 100.0, j as f32 / n as f32 * 100.0);
            part.positions.push(Vec3::new(x, y, 8.0 * (x / 15.0).sin() * (y / 20.0).cos()));
            let slope = Vec2::new(
                8.0 / 15.0 * (x / 15.0).cos() * (y / 20.0).cos(),
                -0.4 * (x / 15.0).sin() * (y / 20.0).sin(),
            );
            part.normals.push(Vec3::new(-slope.x, -slope.y, 1.0).into());
            part.uvs.push(Vec2::new(x, y));
            if i < n && j < n {
                let corner = i * (n + 1) + j;
                part.triangles
                    .extend([[corner, corner + n + 1, corner + n + 2], [corner, corner + n + 2, corner + 1]]);
            }
        }
    }
    let material =
        Material { name: "grass".into(), base_color: [0.25, 0.4, 0.15, 1.0], ..Material::default() };
    let meshes = vec![Mesh { name: "hill".into(), parts: vec![part], ..Mesh::default() }];
    let instances = vec![instance(0, "hill", DAffine3::IDENTITY)];
    Scene { materials: vec![material], meshes, instances, ..Scene::default() }
}

/// Returns blocks of gabled houses on the ground.
pub(super) fn town(side: usize) -> Scene {
    let color = |name: &str, color: [f32; 3]| Material {
        name: name.into(),
        base_color: [color[0], color[1], color[2], 1.0],
        ..Material::default()
    };
    let materials = vec![
        color("ground", [0.75, 0.74, 0.7]),
        color("wall", [0.8, 0.7, 0.55]),
        color("tile", [0.55, 0.16, 0.08]),
    ];
    let mut roof = Part { material: 2, ..Part::default() };
    let corners = [(-0.55, -0.5), (0.55, -0.5), (0.55, 0.5), (-0.55, 0.5)].map(|(x, y)| Vec3::new(x, y, 1.0));
    let ridge = [Vec3::new(0.0, -0.5, 1.6), Vec3::new(0.0, 0.5, 1.6)];
    let faces = [
        vec![corners[0], ridge[0], ridge[1], corners[3]],
        vec![ridge[0], corners[1], corners[2], ridge[1]],
        vec![corners[0], corners[1], ridge[0]],
        vec![corners[2], corners[3], ridge[1]],
    ];
    for face in faces {
        let first = roof.positions.len() as u32;
        let normal = (face[1] - face[0]).cross(face[2] - face[0]).normalize();
        for corner in 2..face.len() as u32 {
            roof.triangles.push([first, first + corner - 1, first + corner]);
        }
        for point in face {
            roof.positions.push(point);
            roof.normals.push(normal.into());
            roof.uvs.push(Vec2::ZERO);
        }
    }
    let mut house = cube("house", 1);
    house.parts.push(roof);
    let mut scene =
        Scene { materials, meshes: vec![cube("ground", 0), house], instances: vec![], ..Scene::default() };
    let size = 14.0 * side as f64;
    scene.instances.push(instance(
        0,
        "ground",
        DAffine3::from_scale_rotation_translation(
            DVec3::new(size + 10.0, size + 10.0, 1.0),
            DQuat::IDENTITY,
            DVec3::new(size / 2.0 - 7.0, size / 2.0 - 7.0, -1.0),
        ),
    ));
    for i in 0..side * side {
        let (x, y) = ((i % side) as f64, (i / side) as f64);
        let scale =
            DVec3::new(7.0 + 2.0 * (x * 1.7).sin(), 9.0 + 2.0 * (y * 2.3).sin(), 6.0 + 3.0 * (x + y).sin());
        let rotation = DQuat::from_rotation_z(0.1 * (x * y).sin() + if i % 3 == 0 { 1.57 } else { 0.0 });
        let transform =
            DAffine3::from_scale_rotation_translation(scale, rotation, DVec3::new(x, y, 0.0) * 14.0);
        let mut house = instance(1, "house", transform);
        house.feature = Some(format!("way/{i}"));
        scene.instances.push(house);
    }
    scene
}

/// Returns the levels of a Koch curve as thin bars in the plane y = 0.
pub(super) fn standing() -> Scene {
    let mut scene = Scene {
        materials: vec![plaster()],
        meshes: vec![cube("bar", 0)],
        instances: vec![],
        ..Scene::default()
    };
    let mut turns = vec![0.0_f64];
    for _ in 0..4 {
        turns = turns.iter().flat_map(|turn| [*turn, turn + 60.0, turn - 60.0, *turn]).collect();
    }
    let mut at = DVec3::ZERO;
    for turn in turns {
        let (sin, cos) = turn.to_radians().sin_cos();
        let along = DVec3::new(cos, 0.0, sin) * 0.1;
        let rotation = DQuat::from_rotation_arc(DVec3::Z, along.normalize());
        let transform = DAffine3::from_scale_rotation_translation(DVec3::new(0.02, 0.02, 0.1), rotation, at);
        scene.instances.push(instance(0, "", transform));
        at += along;
    }
    scene
}

/// Returns every sample with its name; images are written to `folder`.
pub(super) fn all(folder: &Path) -> Vec<(&'static str, Scene)> {
    let mut far_forest = many(100);
    for instance in &mut far_forest.instances {
        instance.transform.translation += DVec3::new(-6_000_000.25, 3_000_000.5, 12.0);
    }
    let mut hidden = boxes(2);
    hidden.instances.clear();
    let mut doubles = boxes(4);
    for instance in &mut doubles.instances {
        instance.name = "Haus „am Ring“ / 家".into();
        instance.feature = Some("a \"quoted\"\\id\n".into());
    }
    let mut long = hill(40);
    let part = &mut long.meshes[0].parts[0];
    for i in 0..70_000 {
        part.positions.push(Vec3::new((i % 100) as f32, (i / 100) as f32, -1.0));
        part.normals.push(burgeon_scene::Normal::Z);
        part.uvs.push(Vec2::ZERO);
    }
    let last = part.positions.len() as u32 - 1;
    part.triangles.push([last - 101, last - 1, last]);
    vec![
        ("empty", Scene::default()),
        ("hidden", hidden),
        ("box", boxes(1)),
        ("boxes", boxes(7)),
        ("doubles", doubles),
        ("many", many(500)),
        ("twisted", twisted_tower()),
        ("far", far_box()),
        ("far_forest", far_forest),
        ("textured", textured_boxes(folder)),
        ("relief", relief_boxes(folder)),
        ("materials", materials()),
        ("odd", odd()),
        ("hill", hill(40)),
        ("long", long),
        ("town", town(12)),
        ("standing", standing()),
    ]
}

/// Computes the volume (m³) that the instances enclose. Each instance counts as positive, regardless of its
/// orientation.
pub(super) fn volume(scene: &Scene) -> f64 {
    let mut sum = 0.0;
    for instance in &scene.instances {
        let mut volume = 0.0;
        for part in &scene.meshes[instance.mesh].parts {
            for corners in &part.triangles {
                let [a, b, c] = corners.map(|corner| {
                    instance.transform.transform_vector3(part.positions[corner as usize].as_dvec3())
                });
                volume += a.dot(b.cross(c)) / 6.0;
            }
        }
        sum += volume.abs();
    }
    sum
}
