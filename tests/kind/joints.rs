//! Branches of a turtle that are one surface in the exported file.

use std::collections::BTreeMap;

use burgeon::trace::{Pick, pick};

use super::options;

const TREE: &str = r#"
local Apex, Leaf = module("Apex", "length", "width"), module("Leaf")
local tree = lsystem({ object = turtle({ joints = JOINTS, angle = 35 }) })
tree:axiom(Apex(1, 0.1))
tree:rule("Apex(length, width)", function(this, length, width)
  local next = Apex(length * 0.9, width * 0.7)
  return Width(width), F(length), { Turn(), next }, { Turn(-40), Pitch(20), next }, Roll(70), F(length), next
end)
tree:interpret("Apex(length, width)", function(this, length, width)
  this:width(width):forward(length)
end)
tree:derive(3)
"#;

/// Returns the number of bodies, of edges without a triangle in each direction, and the Euler characteristic of the
/// model in a .glb file.
fn surface(bytes: &[u8]) -> (usize, usize, i64) {
    let (document, buffers, _) = gltf::import_slice(bytes).unwrap();
    let (mut known, mut above) = (BTreeMap::new(), Vec::new());
    let mut edges: BTreeMap<(usize, usize), [usize; 2]> = BTreeMap::new();
    let mut triangles = 0;
    fn top(above: &[usize], mut at: usize) -> usize {
        while above[at] != at {
            at = above[at];
        }
        at
    }
    for primitive in document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
        let positions: Vec<[f32; 3]> = reader.read_positions().unwrap().collect();
        let indices: Vec<u32> = reader.read_indices().unwrap().into_u32().collect();
        for corners in indices.chunks_exact(3) {
            let corners: Vec<usize> = corners
                .iter()
                .map(|corner| {
                    let at = positions[*corner as usize].map(|it| (it + 0.0).to_bits());
                    *known.entry(at).or_insert_with(|| {
                        above.push(above.len());
                        above.len() - 1
                    })
                })
                .collect();
            for side in 0..3 {
                let (from, to) = (corners[side], corners[(side + 1) % 3]);
                edges.entry((from.min(to), from.max(to))).or_default()[usize::from(from < to)] += 1;
                let (a, b) = (top(&above, from), top(&above, to));
                above[b] = a;
            }
            triangles += 1;
        }
    }
    let bodies = (0..above.len()).filter(|&at| above[at] == at).count();
    let bad = edges.values().filter(|sides| **sides != [1, 1]).count();
    (bodies, bad, above.len() as i64 - edges.len() as i64 + triangles)
}

#[test]
fn with_smooth_joints_the_exported_file_of_a_tree_is_one_closed_manifold_body() {
    let folder = tempfile::tempdir().unwrap();
    let found = ["\"separate\"", "\"smooth\""].map(|joints| {
        let script = folder.path().join("tree.lua");
        std::fs::write(&script, TREE.replace("JOINTS", joints)).unwrap();
        let models = [1, 2].map(|threads| {
            let run = burgeon::run(&script, options(threads)).unwrap();
            burgeon::export::gltf::glb(&run.scene).unwrap()
        });
        assert!(models[0] == models[1], "it depends on the number of threads");
        surface(&models[0])
    });
    // Tubes that share corners count as one body.
    assert!(found[0].0 > 5, "{found:?}");
    assert_eq!(found[1], (1, 0, 2));
}

#[test]
fn a_triangle_of_a_joint_names_the_module_that_drew_it() {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("tree.lua");
    std::fs::write(&script, TREE.replace("JOINTS", "\"smooth\"")).unwrap();
    let run = burgeon::run(&script, options(1)).unwrap();
    let count = run.scene.meshes[0].parts[0].triangles.len();
    let mut names: BTreeMap<String, usize> = BTreeMap::new();
    for triangle in (0..count).step_by(count / 50) {
        let picked = pick(&script, &options(1), &run.scene, Pick { instance: 0, part: 0, triangle }).unwrap();
        let path = picked.drawn.map(|drawn| drawn.path).unwrap_or_default();
        let name = path.last().map(|it| it.module.text.split('(').next().unwrap_or_default().to_owned());
        *names.entry(name.unwrap_or_default()).or_default() += 1;
    }
    assert!(names.contains_key("F") && names.contains_key("Apex") && !names.contains_key(""), "{names:?}");
}
