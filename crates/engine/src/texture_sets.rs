//! Sets of texture coordinates that materials name and surfaces lack.

use std::sync::Arc;

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_scene::Scene;

use crate::declare::Session;

/// Returns a warning for each set of texture coordinates that the dirt map of a material names, if surfaces with the material
/// cannot have it, because they are no shapes.
pub(crate) fn missing_sets(scene: &Scene, session: &Session) -> Vec<Warning> {
    let mut missing: Vec<&Arc<str>> = Vec::new();
    for part in scene.meshes.iter().flat_map(|mesh| &mesh.parts) {
        let dirt = scene.materials.get(part.material).and_then(|material| material.dirt_map.as_ref());
        let Some(dirt) = dirt.filter(|dirt| !dirt.set.is_empty()) else { continue };
        let is_missing = part.second_uvs.len() < part.positions.len() && !part.triangles.is_empty();
        if is_missing && !missing.contains(&&dirt.set) {
            missing.push(&dirt.set);
        }
    }
    let warning = |set: &Arc<str>| {
        let text = format!(
            "the dirt map of a material uses the set {set:?}, which surfaces that are no shapes lack"
        );
        let help = "only shapes have sets, from shape:project: omit dirt_set, so that the image lies as the texture does";
        Warning::new(WarningKind::NoEffect, text).help(help).at(session.place_of_string(set))
    };
    missing.into_iter().map(warning).collect()
}
