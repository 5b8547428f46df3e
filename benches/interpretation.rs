//! A turtle draws a tree of a million branches: segments per second of one thread's CPU time. Also a tower of a
//! thousand steps, drawn once, compared with one whose rules may query the object after each step.
//! `cargo bench --bench interpretation`.

#![allow(clippy::print_stdout, reason = "a bench prints its figures")]

use std::time::Duration;

use burgeon::script::RunOptions;
use cpu_time::ThreadTime;

const SCRIPT: &str = r#"
local Apex, Branch = module("Apex", "l", "w"), module("Branch", "l", "w")
local tree = lsystem({ object = turtle({ sides = 5 }), interpret = "last" })
tree:axiom(Apex(1, 0.2))
tree:rule("Apex(l, w)", function(this, l, w)
  return Branch(l, w), { Turn(45), Apex(l * 0.7, w * 0.6) }, Roll(137.5), Apex(l * 0.9, w * 0.8)
end)
tree:interpret("Branch(l, w)", function(this, l, w)
  this:width(w):forward(l)
end)
tree:derive(20)
"#;

const TOWER: &str = r#"
local Floor, Slab = module("Floor", "n", "r"), module("Slab", "h", "r")
local tower = lsystem({ object = extruder({ sides = 24 }) })
tower:axiom(Floor(1000, 6))
tower:rule("Floor(n, r)", function(this, n, r)
  if n == 0 then return nil end
  return Slab(3, r), Floor(n - 1, r * 0.999)
end)
tower:interpret("Slab(h, r)", function(this, h, r)
  this:scale(r):roll(2):extrude(h)
end)
tower:derive()
"#;

fn main() {
    tree();
    let path = std::env::temp_dir().join(format!("burgeon bench tower {}.lua", std::process::id()));
    let time = |script: &str| {
        std::fs::write(&path, script).expect("the temporary folder can be written to");
        let begin = ThreadTime::now();
        let run = burgeon::run(&path, RunOptions { threads: Some(1), ..burgeon::options() });
        (begin.elapsed().as_secs_f64(), run.expect("the tower grows").scene.triangles())
    };
    let unseen = time(TOWER);
    let seen = time(&TOWER.replace("if n == 0", "if n == 0 and this:position()"));
    std::fs::remove_file(&path).ok();
    assert_eq!(unseen.1, seen.1);
    println!(
        "1,000 steps of an extruder: {:.3} s of CPU time; {:.2} s where a rule asks it after each step",
        unseen.0, seen.0
    );
}

fn tree() {
    let path = std::env::temp_dir().join(format!("burgeon bench {}.lua", std::process::id()));
    let (mut with, mut without, mut triangles) = (Duration::MAX, Duration::MAX, 0);
    for _ in 0..6 {
        let cpu = |interpret: bool| -> (Duration, usize) {
            let script = if interpret {
                SCRIPT.to_owned()
            } else {
                SCRIPT.replace("object = turtle({ sides = 5 }), interpret = \"last\"", "")
            };
            std::fs::write(&path, script).expect("the temporary folder can be written to");
            let begin = ThreadTime::now();
            let run = burgeon::run(&path, RunOptions { threads: Some(1), ..burgeon::options() });
            let run = run.expect("the tree grows");
            (begin.elapsed(), run.scene.triangles())
        };
        let drawn = cpu(true);
        (with, triangles) = (with.min(drawn.0), drawn.1);
        without = without.min(cpu(false).0);
    }
    std::fs::remove_file(path).ok();
    // The minimum of each run: disturbances make a run longer, but can change the difference of two runs either way.
    let (time, segments) = (with.saturating_sub(without).as_secs_f64(), f64::from((1u32 << 20) - 1));
    println!("Interpretation: {segments} segments, {triangles} triangles in {time:.3} s of CPU time");
    println!("{:.2} M segments a second and core, mesh and scene included", segments / time / 1e6);
}
