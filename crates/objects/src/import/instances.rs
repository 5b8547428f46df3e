//! Multiple instances of one node.
//!
//! Source: Khronos Group, glTF extension `EXT_mesh_gpu_instancing`, 2021.

use glam::{DAffine3, DQuat, DVec3};
use gltf_json::scene::Node;
use gltf_json::{Accessor, Index};

use super::bytes::NumberColumns;
use super::options::OBJECT;
use burgeon_base::error::{Error, Result};

/// Name of the extension.
pub(super) const EXTENSION: &str = "EXT_mesh_gpu_instancing";

/// Returns the transforms of the instances of a node, or `None` if it does not have the extension.
pub(super) fn places(columns: &mut NumberColumns<'_>, node: &Node) -> Result<Option<Vec<DAffine3>>> {
    let extension = node.extensions.as_ref().and_then(|known| known.others.get(EXTENSION));
    let Some(attributes) = extension.and_then(|extension| extension.get("attributes")) else {
        return Ok(None);
    };
    let column = |name: &str| -> Option<Index<Accessor>> {
        attributes.get(name)?.as_u64().and_then(|index| u32::try_from(index).ok()).map(Index::new)
    };
    let translations = column("TRANSLATION").map(|index| columns.triples(index)).transpose()?;
    let rotations = column("ROTATION").map(|index| columns.fours(index)).transpose()?;
    let scales = column("SCALE").map(|index| columns.triples(index)).transpose()?;
    let lengths = [
        translations.as_ref().map(|it| it.len()),
        rotations.as_ref().map(|it| it.len()),
        scales.as_ref().map(|it| it.len()),
    ];
    let mut known = lengths.into_iter().flatten();
    let Some(count) = known.next() else { return Ok(None) };
    if known.any(|other| other != count) {
        return Err(Error::data("its instances have columns of different lengths"));
    }
    let _held = columns.budget.hold(count.saturating_mul(OBJECT))?;
    let vector = |values: [f32; 3]| DVec3::from(values.map(f64::from));
    let place = |at: usize| {
        let turn = rotations.as_ref().map_or(DQuat::IDENTITY, |it| DQuat::from_array(it[at].map(f64::from)));
        let turn = if turn.length_squared() > 0.0 { turn.normalize() } else { DQuat::IDENTITY };
        DAffine3::from_scale_rotation_translation(
            scales.as_ref().map_or(DVec3::ONE, |it| vector(it[at])),
            turn,
            translations.as_ref().map_or(DVec3::ZERO, |it| vector(it[at])),
        )
    };
    Ok(Some((0..count).map(place).collect()))
}
