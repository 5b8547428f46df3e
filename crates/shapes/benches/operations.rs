//! Benchmark of splits, facades and set operations of solids.
//!
//! `cargo bench -p burgeon-shapes --bench operations`

#![allow(clippy::print_stdout, clippy::unwrap_used, reason = "a bench tells what it found, and may panic")]

use burgeon_shapes::{PartSize, PartSizes, Selector, Shape, SizedParts, SolidOperation, SplitAxis};
use cpu_time::ProcessTime;
use glam::DVec3;

/// Prints the least CPU time of three runs.
fn measure(name: &str, mut run: impl FnMut() -> String) {
    let mut best: Option<(std::time::Duration, String)> = None;
    for _ in 0..3 {
        let begin = ProcessTime::now();
        let told = run();
        let time = begin.elapsed();
        if best.as_ref().is_none_or(|(least, _)| time < *least) {
            best = Some((time, told));
        }
    }
    let (time, told) = best.unwrap();
    println!("{name}: {told} in {:.3} s of CPU", time.as_secs_f64());
}

fn repeated(size: PartSize) -> PartSizes {
    PartSizes(vec![SizedParts::Repeated(vec![size])])
}

fn main() {
    measure("split into 1,000 by 1,000", || {
        let mass = Shape::cuboid(DVec3::new(1000.0, 1000.0, 10.0));
        let rows = mass.split(SplitAxis::X, &repeated(PartSize::Absolute(1.0))).unwrap().parts;
        let cells: usize = rows
            .iter()
            .map(|(_, row)| row.split(SplitAxis::Y, &repeated(PartSize::Absolute(1.0))).unwrap().parts.len())
            .sum();
        format!("{cells} shapes")
    });
    measure("faces, storeys and windows of 520 towers", || {
        let mut count = 0;
        for tower in 0..520 {
            let mass = Shape::cuboid(DVec3::new(20.0 + f64::from(tower % 7), 24.0, 120.0));
            for face in mass.faces(&Selector::read("side").unwrap()).unwrap() {
                for (_, storey) in face.split(SplitAxis::Y, &repeated(PartSize::Flexible(3.0))).unwrap().parts
                {
                    let bay = [PartSize::Flexible(1.0), PartSize::Absolute(1.2), PartSize::Flexible(1.0)];
                    let bays = PartSizes(vec![SizedParts::Repeated(bay.to_vec())]);
                    count += storey.split(SplitAxis::X, &bays).unwrap().parts.len();
                }
            }
        }
        format!("{count} shapes")
    });
    let ball = Shape::sphere(1.0, 100).unwrap();
    let other = ball.translate(DVec3::new(0.5, 0.3, 0.2));
    let triangles: usize =
        ball.mesh().faces.iter().map(|face| ball.mesh().triangles(face).unwrap().len()).sum();
    for (name, operation) in [
        ("union", SolidOperation::Union),
        ("difference", SolidOperation::Difference),
        ("intersection", SolidOperation::Intersection),
    ] {
        measure(name, || {
            let solid = ball.combine(&other, operation).unwrap().solid.unwrap();
            format!("{triangles} triangles each, volume {:.4} m³", solid.volume())
        });
    }
    for sides in [60, 240, 1000] {
        let column = Shape::cylinder(4.0, 4.0, 2.0, sides).unwrap();
        measure(&format!("fillet of all edges of {sides} sides"), || {
            let round = column.bevel(0.005, 4, None).unwrap();
            format!("{} faces, {} failed", round.solid.body.faces(), round.failed)
        });
    }
}
