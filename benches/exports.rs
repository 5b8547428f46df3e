//! Measures the CPU time of writing a torus of a million triangles, and a thousand instances of one of a thousand, in
//! each format of scenes. `cargo bench --bench exports`.

#![allow(clippy::unwrap_used, clippy::print_stdout, reason = "a bench prints and stops at what is wrong")]

use std::time::Instant;

use burgeon::export::{FORMATS, Need};
use burgeon::picture::Picture;
use burgeon::scene::{Instance, Mesh, Normal, Part, Scene};
use cpu_time::ProcessTime;
use glam::{DAffine3, DVec3, Vec2, Vec3};

/// Returns a closed torus of `2 * around * across` triangles.
fn torus(around: u32, across: u32) -> Mesh {
    let mut part = Part::default();
    let turn = |step: u32, count: u32| step as f32 / count as f32 * std::f32::consts::TAU;
    for i in 0..around {
        let (sin, cos) = turn(i, around).sin_cos();
        for j in 0..across {
            let (up, out) = turn(j, across).sin_cos();
            let normal = Vec3::new(out * cos, out * sin, up);
            part.positions.push(Vec3::new(cos, sin, 0.0) * 3.0 + normal);
            part.normals.push(Normal::from(normal));
            part.uvs.push(Vec2::ZERO);
            let corner = |i: u32, j: u32| i % around * across + j % across;
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            part.triangles.push([a, b, c]);
            part.triangles.push([a, c, d]);
        }
    }
    Mesh { name: "torus".into(), parts: vec![part], ..Mesh::default() }
}

/// Returns `count` instances of a torus in a row.
fn row(mesh: Mesh, count: u32) -> Scene {
    let mut scene = Scene { meshes: vec![mesh], ..Scene::default() };
    scene.material(&Default::default());
    for number in 0..count {
        scene.instances.push(Instance {
            mesh: 0,
            transform: DAffine3::from_translation(DVec3::X * 9.0 * f64::from(number)),
            name: "torus".into(),
            feature: None,
            origin: None,
            placement: None,
            meaning: None,
        });
    }
    scene
}

fn main() {
    let is_bench = std::env::args().any(|argument| argument == "--bench");
    let (around, across) = if is_bench { (1000, 500) } else { (20, 10) };
    let scenes = [("1 mesh", row(torus(around, across), 1)), ("1,000 instances", row(torus(50, 10), around))];
    println!("| model | triangles | format | size (MB) | CPU (s) | time (s) |\n|---|---|---|---|---|---|");
    let folder = std::env::temp_dir().join(format!("burgeon-exports-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    for (name, scene) in &scenes {
        let is_model = |needs: &[Need]| needs == [Need::Scene];
        for format in FORMATS.iter().filter(|format| is_model(format.needs)) {
            let path = folder.join(format!("torus.{}", format.extension()));
            let (cpu, begin) = (ProcessTime::now(), Instant::now());
            burgeon::export::write(scene, &path, &Picture::default()).unwrap();
            let (cpu, time) = (cpu.elapsed().as_secs_f64(), begin.elapsed().as_secs_f64());
            let size = path.metadata().unwrap().len() as f64 / 1e6;
            let (triangles, extension) = (scene.triangles(), format.extension());
            println!("| {name} | {triangles} | .{extension} | {size:.1} | {cpu:.2} | {time:.2} |");
        }
    }
    std::fs::remove_dir_all(&folder).unwrap();
}
