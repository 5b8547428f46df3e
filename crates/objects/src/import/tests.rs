//! Tests of import: exported files can be read, and damaged files fail without a panic.

use glam::{DAffine3, DVec3, Vec2, Vec3};

use super::gltf_file::read;
use super::options::ImportOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::Error;
use burgeon_base::error::Result;
use burgeon_base::random::Stream;
use burgeon_export::{Export, Files, InstanceStorage, SceneFacts};
use burgeon_picture::Picture;
use burgeon_scene::{Instance, Mesh, Scene};
use burgeon_scene::{Material, NormalMap, Part, Texture, image};

/// Returns a scene with two instances of a box of 2 m by 3 m by 4 m, one of them rotated and at half its size, with a
/// texture.
fn sample() -> Scene {
    let png = image::encode_opaque(4, 2, &[200, 80, 40].repeat(8)).unwrap();
    let mut scene = Scene::default();
    let waves = image::encode_opaque(2, 2, &[128, 128, 255].repeat(4)).unwrap();
    let waves = Texture { path: "waves".into(), size: [0.5, 0.25], content: Some(waves.into()) };
    let brick = Material {
        name: "brick".into(),
        base_color: [0.5, 0.25, 0.125, 1.0],
        roughness: 0.75,
        emissive: [3.0, 0.0, 0.0],
        texture: Some(Texture { path: "brick".into(), size: [0.5, 0.25], content: Some(png.into()) }),
        normal_map: Some(NormalMap { image: waves, scale: 0.5 }),
        ..Material::default()
    };
    let mut mesh = Mesh { name: "box".into(), ..Mesh::default() };
    for (index, material) in [brick, Material { metallic: 1.0, ..Material::default() }].iter().enumerate() {
        let material = scene.material(material);
        let mut part = Part { material, ..Part::default() };
        for axis in 0..3 {
            let side = if index == 0 { 1.0 } else { -1.0 };
            let size = Vec3::new(2.0, 3.0, 4.0);
            let normal = Vec3::AXES[axis] * side;
            let (u, v) = (Vec3::AXES[(axis + 1) % 3] * size * side, Vec3::AXES[(axis + 2) % 3] * size);
            let from = if side > 0.0 { normal * size } else { -u };
            let first = u32::try_from(part.positions.len()).unwrap();
            for (a, b) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)] {
                part.positions.push(from + u * a + v * b);
                part.normals.push(normal.into());
                part.uvs.push(Vec2::new(a, b) * 2.0);
            }
            part.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|corners| corners.map(|corner| corner + first)));
        }
        mesh.parts.push(part);
    }
    scene.meshes.push(mesh);
    for (scale, angle, at) in [(1.0, 0.0, DVec3::ZERO), (0.5, 0.7, DVec3::new(10.0, 5.0, 1.0))] {
        let turn = glam::DQuat::from_rotation_z(angle);
        scene.instances.push(Instance {
            mesh: 0,
            transform: DAffine3::from_scale_rotation_translation(DVec3::splat(scale), turn, at),
            name: "a".into(),
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        });
    }
    scene
}

fn written(name: &str) -> (tempfile::TempDir, Vec<u8>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(name);
    burgeon_export::write(&sample(), &path, &Picture::default()).unwrap();
    let content = std::fs::read(&path).unwrap();
    (folder, content)
}

fn read_in(folder: &std::path::Path, content: &[u8], triangles: usize) -> Result<Scene> {
    let mut beside = |name: &str| {
        std::fs::read(folder.join(name)).map_err(|error| Error::other(format!("{name}: {error}")))
    };
    let budget = &Budget::default();
    read(content, &mut ImportOptions { name: "box.glb", triangles, budget, beside: &mut beside })
}

#[test]
fn what_was_written_is_read_again() {
    for name in ["box.glb", "box.gltf"] {
        let (folder, content) = written(name);
        let (scene, known) = (read_in(folder.path(), &content, 1000).unwrap(), sample());
        assert_eq!((scene.triangles(), scene.meshes.len()), (known.triangles(), 1), "{name}");
        let ((low, high), (least, most)) = (scene.bounds().unwrap(), known.bounds().unwrap());
        assert!(low.distance(least) < 1e-5 && high.distance(most) < 1e-5, "{name}: {low} {high}");
        let [brick, metal] = &scene.materials[..] else { panic!("two materials") };
        assert_eq!((brick.base_color, brick.roughness, metal.metallic), ([0.5, 0.25, 0.125, 1.0], 0.75, 1.0));
        assert_eq!((brick.name.as_str(), brick.emissive), ("brick", [3.0, 0.0, 0.0]));
        let (texture, source) =
            (brick.texture.as_ref().unwrap(), known.materials[0].texture.as_ref().unwrap());
        assert_eq!(texture.content, source.content);
        let (relief, waves) =
            (brick.normal_map.as_ref().unwrap(), known.materials[0].normal_map.as_ref().unwrap());
        assert_eq!((relief.scale, &relief.image.content), (0.5, &waves.image.content));
        let part = &scene.meshes[0].parts[0];
        // The coordinates are repetitions of the image, which was 0.5 m by 0.25 m.
        assert_eq!(part.uvs[2], Vec2::new(4.0, 8.0));
        for [a, b, c] in &part.triangles {
            let [a, b, c] = [a, b, c].map(|corner| part.positions[corner as usize]);
            assert!((b - a).cross(c - a).dot(part.normals[0].vector()) >= 0.0);
        }
        // The scene that was read can be exported again.
        burgeon_export::write(&scene, &folder.path().join("again.glb"), &Picture::default()).unwrap();
    }
}

#[test]
fn a_file_that_is_none_or_needs_too_much_is_refused_with_the_reason() {
    let (folder, content) = written("box.glb");
    let refused = |content: &[u8]| read_in(folder.path(), content, 1000).map(|_| ()).unwrap_err().to_string();
    insta::assert_snapshot!(refused(b"solid box"), @r"
    the model box.glb cannot be read: it is not a glTF file
      help: export it again as glTF 2.0 (.glb), and check that the copy is complete
    ");
    assert!(refused(&content[..content.len() - 8]).contains("it ends too early"));
    let draco = br#"{"asset":{"version":"2.0"},"extensionsRequired":["KHR_draco_mesh_compression"]}"#;
    insta::assert_snapshot!(refused(draco), @r"
    the model box.glb needs the extension KHR_draco_mesh_compression, which is not supported
      help: export it without compression of meshes and textures, and without required extensions
    ");
    assert!(refused(br#"{"asset":{"version":"2.0"}}"#).contains("has no triangles"));
    let many = read_in(folder.path(), &content, 20).unwrap_err().to_string();
    assert!(many.contains("more than 20 triangles") && many.contains("--triangle-limit"), "{many}");
}

/// Returns a glTF file with a triangle of these points and indices.
fn triangle(points: [f32; 9], indices: [u16; 3], rest: &str) -> Vec<u8> {
    use base64::Engine;
    let mut bytes: Vec<u8> = points.iter().flat_map(|number| number.to_le_bytes()).collect();
    bytes.extend(indices.iter().flat_map(|number| number.to_le_bytes()));
    let data = base64::engine::general_purpose::STANDARD.encode(bytes);
    format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":42,"uri":"data:application/octet-stream;base64,{data}"}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}},{{"buffer":0,"byteOffset":36,"byteLength":6}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}},
        {{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],{rest}}}"#
    )
    .into_bytes()
}

const POINTS: [f32; 9] = [0., 0., 0., 2., 0., 0., 0., 2., 0.];
const NODES: &str = r#""nodes":[{"mesh":0,"translation":[0,0,5]}],"scenes":[{"nodes":[0]}]"#;

#[test]
fn what_a_file_leaves_out_is_computed() {
    let scene = read_in(std::path::Path::new("."), &triangle(POINTS, [0, 1, 2], NODES), 10).unwrap();
    let part = &scene.meshes[0].parts[0];
    // The triangle is upright, seen from the south; 5 m towards the viewer of a file is 5 m south.
    assert_eq!(part.positions, [Vec3::ZERO, Vec3::new(2., 0., 0.), Vec3::new(0., 0., 2.)]);
    assert_eq!((part.normals[0].vector(), part.uvs[1]), (Vec3::NEG_Y, Vec2::new(2.0, 0.0)));
    assert_eq!(scene.instances[0].transform.translation, DVec3::new(0.0, -5.0, 0.0));
    assert_eq!((scene.materials[0].base_color, scene.materials[0].metallic), ([1.0; 4], 1.0));
}

#[test]
fn numbers_that_cannot_be_are_refused() {
    let refused = |content: Vec<u8>| {
        read_in(std::path::Path::new("."), &content, 10).map(|_| ()).unwrap_err().message().to_owned()
    };
    let mut points = POINTS;
    points[4] = f32::NAN;
    assert!(refused(triangle(points, [0, 1, 2], NODES)).contains("a point has the position"));
    assert!(refused(triangle(POINTS, [0, 1, 3], NODES)).contains("a triangle refers to point 3 of 3"));
    let circle = r#""nodes":[{"children":[1]},{"children":[1]}],"scenes":[{"nodes":[0]}]"#;
    assert!(refused(triangle(POINTS, [0, 1, 2], circle)).contains("nested more than 64 deep"));
    let none = r#""nodes":[{"mesh":7}],"scenes":[{"nodes":[0]}]"#;
    assert!(refused(triangle(POINTS, [0, 1, 2], none)).contains("missing mesh 7"));
    let text = String::from_utf8(triangle(POINTS, [0, 1, 2], NODES)).unwrap();
    let long =
        text.replace(r#""componentType":5126,"count":3"#, r#""componentType":5126,"count":4000000000"#);
    assert!(refused(long.into_bytes()).contains("outside its view"));
    let other = text.replace(r#""componentType":5123"#, r#""componentType":5126"#);
    assert!(refused(other.into_bytes()).contains("accessor 1"));
}

#[test]
fn flipped_bytes_never_make_it_panic() {
    let (folder, content) = written("box.glb");
    let (mut read, mut refused) = (0, 0);
    let json = 20..20 + u32::from_le_bytes(content[12..16].try_into().unwrap()) as usize;
    for at in (0..content.len()).filter(|at| *at < 20 || json.contains(at) || at % 7 == 0) {
        for flip in [1u8, 0x10, 0x80, 0xff] {
            let mut damaged = content.clone();
            damaged[at] ^= flip;
            match read_in(folder.path(), &damaged, 1000) {
                Ok(scene) => {
                    assert!(scene.triangles() <= 1000);
                    read += 1;
                }
                Err(_) => refused += 1,
            }
        }
    }
    for length in 0..content.len() {
        assert!(read_in(folder.path(), &content[..length], 1000).is_err());
    }
    assert!(read > 500 && refused > 500, "{read} {refused}");
}

/// Returns a `.glb` file with a description and a body; the description is padded to multiples of 4 bytes if `filled`.
fn glb(json: &str, body: &[u8], filled: bool) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    while filled && !json.len().is_multiple_of(4) {
        json.push(b' ');
    }
    let word = |number: usize| u32::try_from(number).unwrap().to_le_bytes();
    let whole = 12 + 8 + json.len() + 8 + body.len();
    let parts: [&[u8]; 9] = [
        b"glTF",
        &word(2),
        &word(whole),
        &word(json.len()),
        b"JSON",
        &json,
        &word(body.len()),
        b"BIN\0",
        body,
    ];
    parts.concat()
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

#[test]
fn instances_that_share_a_node_are_read_where_they_were_written() {
    let folder = tempfile::tempdir().unwrap();
    for mirrored in [1.0, -1.0] {
        let mut known = sample();
        known.instances = (0..40)
            .map(|at| {
                let at = f64::from(at);
                let turn = glam::DQuat::from_rotation_z(at * 0.3) * glam::DQuat::from_rotation_x(at * 0.1);
                let scale = DVec3::new(mirrored, 1.0, 1.0 + at * 0.1);
                let place = DVec3::new(at * 7.0, at * at, -at);
                Instance {
                    transform: DAffine3::from_scale_rotation_translation(scale, turn, place),
                    ..known.instances[0].clone()
                }
            })
            .collect();
        let path = folder.path().join("many.glb");
        let facts = SceneFacts { instances: InstanceStorage::Extension, ..SceneFacts::default() };
        let mut files = Files::default();
        files.export(&Export { scene: &known, picture: &Picture::default(), facts }, &path).unwrap();
        files.publish().unwrap();
        let content = std::fs::read(&path).unwrap();
        assert!(content.windows(23).any(|it| it == b"EXT_mesh_gpu_instancing"));
        let read = read_in(folder.path(), &content, 10_000).unwrap();
        assert_eq!((read.triangles(), read.instances.len()), (known.triangles(), 40));
        let corners = |scene: &Scene| -> Vec<DVec3> {
            let part = &scene.meshes[0].parts[0];
            let corner = part.positions[part.triangles.iter().next().unwrap()[1] as usize].as_dvec3();
            let mut corners: Vec<DVec3> =
                scene.instances.iter().map(|it| it.transform.transform_point3(corner)).collect();
            corners.sort_by(|a, b| a.x.total_cmp(&b.x));
            corners
        };
        for (a, b) in corners(&read).into_iter().zip(corners(&known)) {
            assert!(a.distance(b) < 1e-3, "{a} {b}");
        }
        let few = read_in(folder.path(), &content, 39 * known.meshes[0].triangles()).unwrap_err().to_string();
        assert!(few.contains("--triangle-limit"), "{few}");
    }
}

#[test]
fn a_description_that_is_not_filled_up_is_read() {
    let body = floats(&POINTS);
    for gap in 0..8 {
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":36}}],"bufferViews":[{{"buffer":0,"byteLength":36}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],{NODES}}}{}"#,
            " ".repeat(gap)
        );
        for filled in [false, true] {
            let scene = read_in(std::path::Path::new("."), &glb(&json, &body, filled), 10).unwrap();
            assert_eq!(scene.triangles(), 1);
        }
    }
}

#[test]
fn colours_of_points_become_materials() {
    let points: Vec<f32> = (0..6u8).flat_map(|at| [f32::from(at % 2), f32::from(at / 2), 0.0]).collect();
    let colors: Vec<f32> =
        [[1.0, 0.0, 0.0]; 3].iter().chain(&[[0.0, 0.25, 1.0]; 3]).flatten().copied().collect();
    let json = format!(
        r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":144}}],"bufferViews":[{{"buffer":0,"byteLength":144}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":6,"type":"VEC3"}},
        {{"bufferView":0,"byteOffset":72,"componentType":5126,"count":6,"type":"VEC3"}}],
        "materials":[{{"pbrMetallicRoughness":{{"baseColorFactor":[0.5,1,1,1]}}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"COLOR_0":1}},"material":0}}]}}],{NODES}}}"#
    );
    let body = [floats(&points), floats(&colors)].concat();
    let scene = read_in(std::path::Path::new("."), &glb(&json, &body, true), 10).unwrap();
    let mut seen: Vec<[i32; 3]> = scene
        .materials
        .iter()
        .map(|it| [0, 1, 2].map(|channel| (it.base_color[channel] * 1000.0).round() as i32))
        .collect();
    seen.sort_unstable();
    assert_eq!((scene.triangles(), seen), (2, vec![[0, 252, 1000], [500, 0, 0]]));
}

/// Reproducible random numbers.
struct Dice(Stream);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0.below(sides)
    }
}

/// Changes a random value in a description: a number, a list, a name, or a whole part.
fn mutate(value: &mut serde_json::Value, dice: &mut Dice) {
    use serde_json::{Value, json};
    let inner = match value {
        Value::Array(items) => items.len(),
        Value::Object(fields) => fields.len(),
        _ => 0,
    };
    if inner > 0 && dice.roll(8) > 0 {
        let at = dice.roll(inner);
        match value {
            Value::Array(items) if dice.roll(12) == 0 => {
                let copy = items[at].clone();
                items.extend(std::iter::repeat_n(copy, dice.roll(300)));
            }
            Value::Array(items) => mutate(&mut items[at], dice),
            Value::Object(fields) if dice.roll(10) == 0 => {
                let name = fields.keys().nth(at).cloned().unwrap_or_default();
                fields.shift_remove(&name);
            }
            Value::Object(fields) => {
                if let Some(inner) = fields.values_mut().nth(at) {
                    mutate(inner, dice);
                }
            }
            _ => {}
        }
        return;
    }
    *value = match dice.roll(9) {
        0 => json!(4_000_000_000u64),
        1 => json!(-1),
        2 => json!(dice.roll(40)),
        3 => json!(1e300),
        4 => json!(null),
        5 => json!("VEC3"),
        6 => json!([]),
        7 => json!(5120 + dice.roll(7)),
        _ => json!({}),
    };
}

#[test]
fn changed_descriptions_neither_panic_nor_take_more_than_they_may() {
    let folder = tempfile::tempdir().unwrap();
    let mut scene = sample();
    scene.instances = vec![scene.instances[1].clone(); 20];
    let path = folder.path().join("many.glb");
    burgeon_export::write(&scene, &path, &Picture::default()).unwrap();
    let content = std::fs::read(&path).unwrap();
    let length = u32::from_le_bytes(content[12..16].try_into().unwrap()) as usize;
    let whole: serde_json::Value = serde_json::from_slice(&content[20..20 + length]).unwrap();
    let body = &content[20 + length + 8..];
    let (mut dice, mut good, mut bad) = (Dice(Stream::new(7)), 0, 0);
    for _ in 0..3000 {
        let mut changed = whole.clone();
        (0..=dice.roll(4)).for_each(|_| mutate(&mut changed, &mut dice));
        let budget = Budget::within(std::time::Duration::from_secs(20), 20_000_000);
        let mut beside = |name: &str| Err(Error::other(format!("there is no {name}")));
        let mut wanted = ImportOptions { name: "a", triangles: 2000, budget: &budget, beside: &mut beside };
        let begin = std::time::Instant::now();
        match read(&glb(&changed.to_string(), body, true), &mut wanted) {
            Ok(scene) => {
                assert!(scene.triangles() <= 2000 && budget.used_bytes() <= 20_000_000);
                good += 1;
            }
            Err(_) => bad += 1,
        }
        assert!(begin.elapsed().as_secs() < 10, "{changed}");
    }
    assert!(good > 100 && bad > 1000, "{good} {bad}");
}

#[test]
fn many_primitives_over_one_list_of_points_keep_to_the_limits() {
    let count = 30_000;
    let points: Vec<f32> =
        (0..count).flat_map(|at| [at as f32, (at * at % 97) as f32, (at % 13) as f32]).collect();
    let model = |primitives: usize, indices: bool| {
        let index = if indices { r#","indices":1"# } else { "" };
        let primitive = format!(r#"{{"attributes":{{"POSITION":0,"NORMAL":0}}{index}}}"#);
        let json = format!(
            r#"{{"asset":{{"version":"2.0"}},"buffers":[{{"byteLength":{0}}}],"bufferViews":[{{"buffer":0,"byteLength":{0}}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":{count},"type":"VEC3"}},
            {{"bufferView":0,"componentType":5121,"count":3,"type":"SCALAR","byteOffset":14}}],
            "meshes":[{{"primitives":[{1}]}}],{NODES}}}"#,
            count * 12,
            vec![primitive; primitives].join(",")
        );
        glb(&json, &floats(&points), true)
    };
    let told = |content: &[u8], seconds: f64, memory: usize, triangles: usize| {
        let budget = Budget::within(std::time::Duration::from_secs_f64(seconds), memory);
        let mut beside = |name: &str| Err(Error::other(name));
        let begin = std::time::Instant::now();
        let read =
            read(content, &mut ImportOptions { name: "a", triangles, budget: &budget, beside: &mut beside });
        assert!(begin.elapsed().as_secs_f64() < seconds + 5.0, "{:?}", begin.elapsed());
        read.map_or_else(|error| error.message().to_owned(), |scene| scene.triangles().to_string())
    };
    // One small triangle per primitive is little work, regardless of the length of the shared list.
    assert_eq!(told(&model(3000, true), 10.0, 100_000_000, 5000), "3000");
    // A few primitives become one part, without spare capacity.
    let budget = Budget::default();
    let mut beside = |name: &str| Err(Error::other(name));
    let mut wanted = ImportOptions { name: "a", triangles: usize::MAX, budget: &budget, beside: &mut beside };
    let [mesh] = &read(&model(5, false), &mut wanted).unwrap().meshes[..] else { panic!("one mesh") };
    let [part] = &mesh.parts[..] else { panic!("one part") };
    assert_eq!(part.triangles.len() % 5, 0);
    assert!(part.triangles.iter().flatten().all(|corner| (corner as usize) < part.positions.len()));
    let room = [part.positions.capacity(), part.normals.capacity(), part.uvs.capacity()];
    assert_eq!(room, [part.positions.len(); 3]);
    let all = model(3000, false);
    assert!(told(&all, 60.0, 100_000_000, usize::MAX).contains("memory limit of 100 MB"));
    assert!(told(&all, 60.0, usize::MAX, 20_000).contains("more than 20000 triangles"));
    assert!(told(&all, 0.05, usize::MAX, usize::MAX).contains("time limit of 0.05 s"));
}
