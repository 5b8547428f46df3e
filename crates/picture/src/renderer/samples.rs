//! Small scenes for the tests of the renderer.

use burgeon_scene::{Instance, Material, Mesh, Normal, Part, Scene};
use glam::{DAffine3, DVec3, Vec2, Vec3};

/// Returns a scene with one mesh at the origin.
pub(super) fn scene_of(part: Part, material: Material) -> Scene {
    let mut scene = Scene::default();
    let index = scene.material(&material);
    scene.meshes.push(Mesh { parts: vec![Part { material: index, ..part }], ..Mesh::default() });
    scene.instances.push(instance(DVec3::ZERO));
    scene
}

/// Returns an instance of mesh 0 at `place`.
pub(super) fn instance(place: DVec3) -> Instance {
    let transform = DAffine3::from_translation(place);
    Instance {
        mesh: 0,
        transform,
        name: String::new(),
        feature: None,
        origin: None,
        placement: None,
        meaning: None,
    }
}

/// Adds a quadrilateral, counter-clockwise seen from outside, with texture coordinates along its first sides.
pub(super) fn quad(part: &mut Part, corners: [Vec3; 4]) {
    let first = part.positions.len() as u32;
    let (u, v) = ((corners[1] - corners[0]).length(), (corners[3] - corners[0]).length());
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
    part.positions.extend(corners);
    part.normals.extend([Normal::from(normal); 4]);
    part.uvs.extend([Vec2::ZERO, Vec2::new(u, 0.0), Vec2::new(u, v), Vec2::new(0.0, v)]);
    part.triangles.extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
}

/// Adds the walls and caps of a prism between two rings with the same number of points, counter-clockwise from above.
pub(super) fn prism(part: &mut Part, low: &[Vec3], high: &[Vec3]) {
    let count = low.len();
    for i in 0..count {
        let j = (i + 1) % count;
        quad(part, [low[i], low[j], high[j], high[i]]);
    }
    for (ring, up) in [(high, true), (low, false)] {
        let first = part.positions.len() as u32;
        part.positions.extend(ring);
        part.normals.extend(vec![Normal::from(if up { Vec3::Z } else { Vec3::NEG_Z }); count]);
        part.uvs.extend(ring.iter().map(|p| p.truncate()));
        for i in 1..count as u32 - 1 {
            part.triangles.push(if up {
                [first, first + i, first + i + 1]
            } else {
                [first, first + i + 1, first + i]
            });
        }
    }
}

/// Returns a ring of `sides` points.
pub(super) fn ring(sides: usize, radius: f32, turn: f32, z: f32) -> Vec<Vec3> {
    (0..sides)
        .map(|i| turn + i as f32 * std::f32::consts::TAU / sides as f32)
        .map(|angle| Vec3::new(radius * angle.cos(), radius * angle.sin(), z))
        .collect()
}

/// Returns boxes with sides of 2 m and centres at `places`.
pub(super) fn boxes(places: &[DVec3]) -> Scene {
    let mut part = Part::default();
    let turn = std::f32::consts::FRAC_PI_4;
    let radius = 2.0_f32.sqrt();
    prism(&mut part, &ring(4, radius, turn, -1.0), &ring(4, radius, turn, 1.0));
    let mut scene = scene_of(part, Material::default());
    scene.instances = places.iter().map(|place| instance(*place)).collect();
    scene
}

/// Returns a stack of `levels` hexagonal slabs of 3 m, each rotated relative to the slab below.
pub(super) fn twisted_tower(levels: usize) -> Scene {
    let mut part = Part::default();
    for level in 0..levels {
        let (turn, z) = (level as f32 * 0.09, level as f32 * 3.0);
        let radius = 9.0 - 0.12 * level as f32;
        prism(&mut part, &ring(6, radius, turn, z), &ring(6, radius, turn, z + 2.6));
    }
    scene_of(part, Material::default())
}
