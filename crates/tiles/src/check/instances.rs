//! Instances of a mesh in a `.glb` file (`EXT_mesh_gpu_instancing`).

use std::borrow::Cow;

use glam::{DAffine3, DQuat, DVec3};
use serde_json::Value;

use super::glb::GlbFile;

/// Returns the transforms of the instances that `attributes` describe; one that changes nothing without attributes. Fails with
/// the reason if they are invalid.
pub(super) fn instance_transforms(
    file: &GlbFile<'_>,
    attributes: &Value,
) -> Result<Vec<DAffine3>, Cow<'static, str>> {
    if attributes.is_null() {
        return Ok(vec![DAffine3::IDENTITY]);
    }
    let array = |key: &str| match &attributes[key] {
        Value::Null => Ok(None),
        accessor => file.array(accessor).map(Some),
    };
    let (translations, rotations, scales) = (array("TRANSLATION")?, array("ROTATION")?, array("SCALE")?);
    let count = [&translations, &rotations, &scales].into_iter().flatten().map(|array| array.count).min();
    let instance = |index: usize| {
        let rotation = rotations.as_ref().map_or(DQuat::IDENTITY, |array| {
            let [x, y, z, w] = array.item(index);
            DQuat::from_xyzw(x, y, z, w).normalize()
        });
        let scale = scales.as_ref().map_or(DVec3::ONE, |array| array.point(index));
        let translation = translations.as_ref().map_or(DVec3::ZERO, |array| array.point(index));
        DAffine3::from_scale_rotation_translation(scale, rotation, translation)
    };
    Ok((0..count.unwrap_or(0)).map(instance).collect())
}
