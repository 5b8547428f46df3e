//! Lineage: the module that made a triangle, and the rules that led to it.

use burgeon::scene::Scene;
use burgeon::trace::{Pick, highlight, pick};

fn script_file(text: &str) -> tempfile::TempPath {
    let file = tempfile::Builder::new().suffix(".lua").tempfile().expect("a file").into_temp_path();
    std::fs::write(&file, text).expect("it can be written");
    file
}

const TOWER: &str = r#"
local Floor, Slab = module("Floor", "n"), module("Slab", "h")
local tower = lsystem({ object = extruder({ sides = 6, smooth = false }) })
tower:axiom(Floor(4))
tower:rule("Floor(n)", function(this, n)
  if n == 0 then return nil end
  return Slab(n), Floor(n - 1)
end)
tower:interpret("Slab(h)", function(this, h)
  this:extrude(h)
end)
tower:derive()
"#;

fn corners(scene: &Scene, mesh: usize, part: usize, triangle: usize) -> [glam::DVec3; 3] {
    let part = &scene.meshes[mesh].parts[part];
    let triangle = part.triangles.get(triangle).expect("it is there");
    triangle.map(|corner| part.positions[corner as usize].as_dvec3())
}

#[test]
fn a_triangle_of_a_solid_of_many_segments_knows_its_own_module() {
    let file = script_file(TOWER);
    let run = burgeon::run(&file, burgeon::options()).expect("the tower stands");
    let [instance] = run.scene.instances.as_slice() else { panic!("one mesh") };
    let triangles = run.scene.meshes[instance.mesh].parts[0].triangles.len();
    let mut seen = 0;
    for triangle in (0..triangles).step_by(5) {
        let asked = Pick { instance: 0, part: 0, triangle };
        let picked = pick(&file, &burgeon::options(), &run.scene, asked).expect("it is known");
        let made = picked.drawn.expect("a module made it");
        assert_eq!(picked.placed, None);
        // The slabs are 4, 3, 2 and 1 m high, and are stacked.
        let slab: f64 = made.module.params[0].1.parse().expect("a number");
        let top: f64 = (0..).map(|i| 4.0 - f64::from(i)).take_while(|height| *height >= slab).sum();
        let [a, b, c] = corners(&run.scene, instance.mesh, 0, triangle);
        for corner in [a, b, c] {
            assert!(corner.z >= top - slab - 1e-6 && corner.z <= top + 1e-6, "{corner} is in slab {slab}");
        }
        let path: Vec<_> = made.path.iter().map(|ancestor| ancestor.module.text.as_str()).collect();
        let floors: Vec<String> = (slab as usize..=4).rev().map(|n| format!("Floor({n})")).collect();
        let mut expected: Vec<&str> = floors.iter().map(String::as_str).collect();
        expected.push(&made.module.text);
        assert_eq!(path, expected);
        assert_eq!(made.path[0].rule, None);
        assert!(made.path[1..].iter().all(|ancestor| {
            let place = ancestor.rule.as_ref().and_then(|rule| rule.place.as_ref());
            place.is_some_and(|place| place.line == 5)
        }));
        let interpretation = made.interpretation.expect("a rule interprets it");
        assert_eq!(
            (interpretation.text.as_str(), interpretation.place.map(|place| place.line)),
            ("Slab(h)", Some(9))
        );
        assert!(made.runs.iter().any(|run| (run.from..run.from + run.count).contains(&triangle)));
        seen += 1;
    }
    assert!(seen > 5);
}

const TREE: &str = r#"
local Apex = module("Apex", "n", "l")
local Leaf = module("Leaf", "model")
local leaves = lsystem({ object = turtle({ width = 0.02 }) })
leaves:axiom(F(0.2), Turn(30), F(0.1))
local leaf = leaves:derive()
local tree = lsystem({ object = turtle({ width = 0.05, sides = 5 }) })
tree:axiom(Apex(5, 1))
tree:rule("Apex(n, l)", function(this, n, l)
  if n == 0 then return Leaf(leaf) end
  return F(l * (0.9 + 0.2 * random())), { Turn(30 + n), Apex(n - 1, l * 0.8) }, Turn(-25), Apex(n - 1, l * 0.7)
end)
tree:interpret("Leaf(model)", function(this, model)
  this:place(model)
end)
tree:derive()
"#;

#[test]
fn a_branch_that_is_bent_or_placed_many_times_knows_its_module() {
    let file = script_file(TREE);
    let run = burgeon::run(&file, burgeon::options()).expect("the tree grows");
    let (mut branches, mut leaves) = (0, 0);
    for (number, instance) in run.scene.instances.iter().enumerate().step_by(7) {
        let part = &run.scene.meshes[instance.mesh].parts[0];
        for triangle in (0..part.triangles.len()).step_by(if number == 0 { 37 } else { 50 }) {
            let asked = Pick { instance: number, part: 0, triangle };
            let picked = pick(&file, &burgeon::options(), &run.scene, asked).expect("it is known");
            let drawn = picked.drawn.expect("a module drew it");
            let length: f64 = drawn.module.params[0].1.parse().expect("a number");
            assert_eq!(drawn.module.symbol, "F");
            let [a, b, c] = corners(&run.scene, instance.mesh, 0, triangle);
            let reach = a.distance(b).max(b.distance(c)).max(c.distance(a));
            // A triangle of a branch connects two rings, or is part of an end.
            assert!(reach < 0.08 || (reach - length).abs() < 0.05, "{reach} {length}");
            match picked.placed {
                Some(placed) => {
                    assert_eq!((placed.module.symbol.as_str(), placed.path.len()), ("Leaf", 7));
                    assert_eq!(drawn.origin.system, 0);
                    leaves += 1;
                }
                None => branches += 1,
            }
        }
    }
    assert!(branches > 10 && leaves > 3, "{branches} {leaves}");
}

#[test]
fn a_line_of_the_script_knows_all_that_it_made() {
    let file = script_file(TREE);
    let run = burgeon::run(&file, burgeon::options()).expect("the tree grows");
    let name = file.display().to_string();
    let at = |line: usize| {
        let systems = run.systems.len();
        highlight(&file, &burgeon::options(), &run.scene, systems, &name, line).expect("it is known")
    };
    let whole: usize = run.scene.meshes[run.scene.instances[0].mesh].triangles();
    let of = |mesh: usize, runs: &[burgeon::trace::TriangleRun]| -> usize {
        runs.iter().filter(|run| run.mesh == mesh).map(|run| run.count).sum()
    };
    let rule = at(11);
    assert_eq!(rule.what, ["Apex(n, l)"]);
    assert_eq!(of(run.scene.instances[0].mesh, &rule.runs), whole);
    assert_eq!(rule.instances.len(), 32);
    let leaves = at(13);
    assert_eq!(
        (leaves.what.as_slice(), leaves.modules, leaves.runs.len()),
        (["Leaf(model)".to_owned()].as_slice(), 32, 0)
    );
    assert_eq!(leaves.instances.len(), 32);
    assert_eq!(at(1), burgeon::trace::LineProducts::default());
    assert_eq!(at(5).what, ["axiom"]);
}
