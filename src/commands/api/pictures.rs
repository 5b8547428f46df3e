//! Pictures of the reference: renders of the examples of types, methods and fields.

use std::fmt::Write as _;
use std::path::Path;

use crate::commands::report;
use burgeon::export::PNG;
use burgeon::kit::ScriptExample;
use burgeon::objects::EXAMPLES;
use burgeon::picture::{Picture, Quality};
use burgeon::scene::{Instance, Material, Mesh, Part, Scene, image};
use burgeon::script::{Print, RunOptions, RunReports};
use burgeon::{Error, Result, Stop, export};
use glam::{DAffine3, DVec3, Vec2};

/// Width and height (pixels).
const SIZE: (u32, u32) = (480, 300);
/// Number of colours of a picture.
const COLORS: usize = 96;
/// File that lists the hash of each picture's script.
const LIST: &str = "pictures.txt";
/// Version of the appearance. Change it to draw all pictures again.
const LOOK: &str = "1";

/// Returns the example that shows the item called `name`.
pub(super) fn example_of(name: &str) -> Option<&'static ScriptExample> {
    EXAMPLES.iter().find(|example| example.shows.contains(&name))
}

/// Returns the path of an example's picture, relative to the folder of the pages.
pub(super) fn file_of(example: &ScriptExample) -> String {
    format!("pictures/{}.{}", example.name.replace('/', "-"), PNG.extension())
}

/// Draws the pictures in `folder`, the folder of the pages, that are missing or whose scripts have changed.
pub(super) fn draw(folder: &Path) -> Result<()> {
    let pictures = folder.join("pictures");
    std::fs::create_dir_all(&pictures)
        .map_err(|error| Error::file(&pictures, format!("cannot create {}: {error}", pictures.display())))?;
    let list = pictures.join(LIST);
    let known = std::fs::read_to_string(&list).unwrap_or_default();
    let mut text = String::new();
    for example in EXAMPLES {
        let file = file_of(example);
        let line = format!("{file} {:016x}", mark(example.script));
        let path = folder.join(&file);
        if !known.lines().any(|known| known == line) || !path.is_file() {
            let bytes = picture(example)?;
            export::write_file(&path, |out| std::io::Write::write_all(out, &bytes))?;
            report::eprint(&format!("drew {}, {} bytes\n", path.display(), bytes.len()));
        }
        // Writing into a string cannot fail.
        let _ = writeln!(text, "{line}");
    }
    // Pictures without an example are deleted.
    for entry in std::fs::read_dir(&pictures).into_iter().flatten().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        if PNG.file.stem(&name).is_some()
            && !EXAMPLES.iter().any(|example| file_of(example).ends_with(&format!("/{name}")))
        {
            std::fs::remove_file(entry.path()).map_err(|error| {
                Error::file(entry.path(), format!("cannot remove {}: {error}", entry.path().display()))
            })?;
        }
    }
    if text != known {
        export::write_file(&list, |out| std::io::Write::write_all(out, text.as_bytes()))?;
    }
    Ok(())
}

/// Returns the hash of a script.
///
/// Method: Fowler, Noll and Vo, FNV-1a, 64 bits.
fn mark(script: &str) -> u64 {
    let bytes = LOOK.bytes().chain(script.bytes());
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

fn picture(example: &ScriptExample) -> Result<Vec<u8>> {
    let folder = std::env::temp_dir().join(format!("burgeon-example-{}", std::process::id()));
    let path = folder.join("example.lua");
    let wrong =
        |error: std::io::Error| Error::file(&path, format!("cannot write {}: {error}", path.display()));
    std::fs::create_dir_all(&folder).map_err(wrong)?;
    std::fs::write(&path, example.script).map_err(wrong)?;
    let reports = RunReports { print: Some(Print::new(|_: &str| ())), ..RunReports::default() };
    let options = RunOptions { reports, ..burgeon::options() };
    let run = burgeon::run(&path, options);
    // An error is ignored, because a remaining folder does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    let mut scene = run?.scene;
    if example.name.starts_with("extruder") || example.name.starts_with("turtle") {
        add_axes(&mut scene);
    }
    let (width, height) = SIZE;
    let picture = Picture { width, height, quality: Quality::Fine, ..Picture::default() };
    let bytes = export::png(&scene, &picture, &Stop::default())?;
    image::encode_indexed(&image::decode(&bytes)?, COLORS)
}

/// Adds the axes at the origin: x red, y green and z blue, each 1 m long.
fn add_axes(scene: &mut Scene) {
    let mut mesh = Mesh { name: "axes".to_owned(), ..Mesh::default() };
    for (along, color) in [
        (DVec3::X, [0.75, 0.05, 0.05, 1.0]),
        (DVec3::Y, [0.05, 0.5, 0.08, 1.0]),
        (DVec3::Z, [0.05, 0.1, 0.75, 1.0]),
    ] {
        let material = Material { base_color: color, ..Material::default() };
        let mut part = Part { material: scene.material(&material), ..Part::default() };
        arrow(&mut part, along);
        mesh.parts.push(part);
    }
    scene.meshes.push(mesh);
    scene.instances.push(Instance {
        mesh: scene.meshes.len() - 1,
        transform: DAffine3::IDENTITY,
        name: "axes".to_owned(),
        feature: None,
        origin: None,
        placement: None,
        meaning: None,
    });
}

/// Adds an arrow of 1 m from the origin in the direction `along`.
fn arrow(part: &mut Part, along: DVec3) {
    let side = DVec3::new(along.y, along.z, along.x);
    let up = along.cross(side);
    let ring = |at: f64, radius: f64| [side, up, -side, -up].map(|out| along * at + out * radius);
    let (foot, neck, head) = (ring(0.0, 0.02), ring(0.82, 0.02), ring(0.82, 0.07));
    let tip = along;
    for number in 0..4 {
        let next = (number + 1) % 4;
        add_face(part, &[foot[number], foot[next], neck[next], neck[number]]);
        add_face(part, &[neck[number], neck[next], head[next], head[number]]);
        add_face(part, &[head[number], head[next], tip]);
    }
    let [a, b, c, d] = foot;
    add_face(part, &[d, c, b, a]);
}

/// Adds a flat convex face, whose normal follows the right-hand rule.
fn add_face(part: &mut Part, corners: &[DVec3]) {
    let base = u32::try_from(part.positions.len()).unwrap_or(u32::MAX);
    let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
    for corner in corners {
        part.positions.push(corner.as_vec3());
        part.normals.push(normal.into());
        part.uvs.push(Vec2::ZERO);
    }
    part.triangles.extend((base + 1..).take(corners.len() - 2).map(|second| [base, second, second + 1]));
}
