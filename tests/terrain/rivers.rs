//! Checks of rivers over random ground: they raise no ground, and no plants grow in their beds.

use burgeon::script::RunOptions;
use glam::DVec3;

/// Script with trees everywhere, on ground that a river crosses unless `RIVER` is false.
const SCRIPT: &str = r#"
local Look = module("Look")
local any = { -1, 1 }
local rules = { A = { "A", "A", "A", "A", change = { any, any, any, any }, decay = DECAY } }
local tree = lsystem({ object = extruder() })
tree:axiom(Look())
tree:interpret("Look", function(this) this:extrude(1) end)
local trees = { models = { tree:derive() }, density = 900, size = { 1, 1 } }
local land = lsystem({ object = terrain({ size = 1000, levels = 7, rules = rules, decay = 60, plants = { trees } }) })
land:axiom(Look())
land:interpret("Look", function(this)
  if RIVER then
    this:river({ 20, 30 }, WIDTH)
  end
end)
land:derive(0)
"#;

/// Checks one river; returns the number of points that it lowers, and the number of plants that it removes.
pub(crate) fn check(seed: u64, width: f64, decay: f64) -> (usize, usize) {
    let scene = |river: bool| {
        let script = SCRIPT
            .replace("RIVER", &river.to_string())
            .replace("WIDTH", &width.to_string())
            .replace("DECAY", &decay.to_string());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("river.lua");
        std::fs::write(&path, script).unwrap();
        let options = RunOptions { seed, threads: Some(1), ..burgeon::options() };
        burgeon::run(&path, options).unwrap_or_else(|error| panic!("seed {seed}: {error}")).scene
    };
    let (dry, wet) = (scene(false), scene(true));
    let plants = |scene: &burgeon::scene::Scene| -> Vec<DVec3> {
        let placed = scene.instances.iter().filter(|instance| instance.placement.is_some());
        placed.map(|instance| instance.transform.translation).collect()
    };
    let (before, after) = (plants(&dry), plants(&wet));
    // Plants are on the ground, so they measure its height, at equal positions in both scenes.
    let mut old = before.iter();
    let mut lowered = 0;
    for at in &after {
        let was =
            old.find(|was| was.truncate() == at.truncate()).unwrap_or_else(|| panic!("a new plant at {at}"));
        assert!(at.z <= was.z + 1e-9, "seed {seed}: the ground at {at} was at {}", was.z);
        lowered += usize::from(at.z < was.z - 0.05);
    }
    // The water is drawn as a ribbon of pairs of corners, one on each bank.
    let mut banks = 0;
    for instance in wet.instances.iter().filter(|instance| instance.placement.is_none()) {
        for part in &wet.meshes[instance.mesh].parts {
            if !wet.materials[part.material].name.is_empty()
                || part.normals.iter().any(|it| it.vector() != glam::Vec3::Z)
            {
                continue;
            }
            let corner = |at: &glam::Vec3| instance.transform.transform_point3(at.as_dvec3()).truncate();
            for pair in part.positions.chunks_exact(2) {
                let (left, right) = (corner(&pair[0]), corner(&pair[1]));
                banks += 1;
                let half = left.distance(right) / 2.0;
                let near = after.iter().find(|at| at.truncate().distance((left + right) / 2.0) < half - 1e-6);
                assert!(near.is_none(), "seed {seed}: a plant grows in the river at {near:?}");
            }
        }
    }
    if banks == 0 { (0, 0) } else { (lowered, before.len() - after.len()) }
}
