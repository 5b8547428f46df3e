//! Count of the edges at which the surface of a shape ends.

use crate::check::{SceneCheck, triangles};
use crate::stem;
use burgeon_base::text::grouped;
use burgeon_base::{Warning, WarningKind};
use burgeon_scene::{Instance, Mesh};
use glam::Vec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::path::Path;

/// Maximum number of systems and features that a warning names.
const NAMED: usize = 5;

/// Returns the index of each point of the parts of `mesh` among its different positions, and the positions.
pub(super) fn weld(mesh: &Mesh) -> (Vec<Vec<u32>>, Vec<Vec3>) {
    let count = mesh.parts.iter().map(|part| part.positions.len()).sum::<usize>();
    let mut known: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    known.reserve(count / 2);
    let mut points = Vec::new();
    let mut number = |at: &Vec3| {
        // Adding zero turns -0 into 0.
        let at = *at + 0.0;
        *known.entry(at.to_array().map(f32::to_bits)).or_insert_with(|| {
            points.push(at);
            points.len() as u32 - 1
        })
    };
    let numbers = mesh.parts.iter().map(|part| part.positions.iter().map(&mut number).collect()).collect();
    (numbers, points)
}

/// Returns the number of open edges of `mesh`: those with fewer triangles on one side than on the other. Points at the
/// same position are the same point, so the parts of a mesh close each other.
pub(super) fn open_edges(mesh: &Mesh) -> usize {
    count_open(mesh, &weld(mesh).0)
}

/// Counts the open edges of `mesh` as [`open_edges`] does, from the indices of its points.
pub(super) fn count_open(mesh: &Mesh, welded: &[Vec<u32>]) -> usize {
    // An edge as its lower and its higher point, with the direction in the lowest bit.
    let mut edges: Vec<u64> = Vec::with_capacity(mesh.triangles() * 3);
    for (part, welded) in mesh.parts.iter().zip(welded) {
        for corners in triangles(part) {
            let [a, b, c] = corners.map(|corner| welded[corner as usize]);
            if a == b || b == c || c == a {
                continue;
            }
            for (from, to) in [(a, b), (b, c), (c, a)] {
                let (low, high, turned) = if from < to { (from, to, 0) } else { (to, from, 1) };
                edges.push(u64::from(low) << 32 | u64::from(high) << 1 | turned);
            }
        }
    }
    edges.sort_unstable();
    let is_open = |edge: &&[u64]| {
        let turned = edge.iter().filter(|edge| **edge & 1 == 1).count();
        turned * 2 != edge.len()
    };
    edges.chunk_by(|a, b| a | 1 == b | 1).filter(is_open).count()
}

/// Returns the number of open edges of each shown mesh.
pub(super) fn count(checked: &SceneCheck<'_>) -> Vec<usize> {
    let meshes = checked.scene.meshes.par_iter().zip(&checked.meshes);
    meshes.map(|(mesh, shown)| if *shown { open_edges(mesh) } else { 0 }).collect()
}

/// Returns a warning about the open edges of the shapes in the file at `path`, whose meshes have `counts` of them;
/// `None` if all shapes are closed.
pub(super) fn warning(checked: &SceneCheck<'_>, counts: &[usize], path: &Path) -> Option<Warning> {
    let mut names: Vec<(String, usize)> = Vec::new();
    let mut known = FxHashMap::default();
    let (mut total, mut open) = (0_usize, 0_usize);
    for instance in checked.scene.instances.iter().filter(|it| counts[it.mesh] > 0) {
        total += counts[instance.mesh];
        open += 1;
        let index = *known.entry((&instance.name, &instance.feature)).or_insert_with(|| {
            names.push((label(instance, &checked.scene.meshes[instance.mesh]), 0));
            names.len() - 1
        });
        names[index].1 += counts[instance.mesh];
    }
    if total == 0 {
        return None;
    }
    names.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let more = names.len().saturating_sub(NAMED);
    let mut list: Vec<String> =
        names.iter().take(NAMED).map(|(name, count)| format!("{name}: {}", grouped(*count))).collect();
    if more > 0 {
        list.push(format!("and {} more", grouped(more)));
    }
    let file = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let message = format!(
        "{}.{file}: {} shapes are not closed, with {} open edges ({})",
        stem(path),
        grouped(open),
        grouped(total),
        list.join(", ")
    );
    let help =
        "close them before printing: draw surfaces with a thickness and tubes with caps, or repair the file";
    Some(Warning::new(WarningKind::OpenEdges, message).help(help))
}

/// Returns the name of an instance for messages: its system and its feature.
fn label(instance: &Instance, mesh: &Mesh) -> String {
    let name = match (&*instance.name, &*mesh.name) {
        ("", "") => "unnamed",
        ("", mesh) => mesh,
        (name, _) => name,
    };
    match &instance.feature {
        Some(feature) => format!("{name:?} of feature {feature:?}"),
        None => format!("{name:?}"),
    }
}
