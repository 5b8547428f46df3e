//! Models that repeat often.

use glam::DAffine3;

use super::super::metadata::Metadata;
use super::super::place::{InstanceGroup, InstanceKind};
use crate::check::SceneCheck;
use crate::decompose::y_up;

/// Number of vertices that instances must save to be worth draw calls of their own.
const WORTH: usize = 4096;

/// Instances of one mesh.
pub(super) struct RepeatedModel<'a> {
    pub(super) kind: InstanceKind<'a>,
    pub(super) group: InstanceGroup,
    /// Number of instances.
    pub(super) count: usize,
}

/// Returns the models that repeat often enough to be instances, and the indices of the other instances.
pub(super) fn divide_repeated<'a>(
    checked: &SceneCheck<'a>,
    metadata: Option<&Metadata>,
    expand: bool,
) -> (Vec<RepeatedModel<'a>>, Vec<usize>) {
    let scene = checked.scene;
    let shown = || scene.instances.iter().enumerate().filter(|(_, instance)| checked.meshes[instance.mesh]);
    if expand {
        return (Vec::new(), shown().map(|(index, _)| index).collect());
    }
    let kind_of = |index: usize| InstanceKind::in_tile(&scene.instances[index], metadata);
    let mut counts = rustc_hash::FxHashMap::default();
    for (index, _) in shown() {
        *counts.entry(kind_of(index)).or_insert(0_usize) += 1;
    }
    let vertices =
        |mesh: usize| scene.meshes[mesh].parts.iter().map(|part| part.positions.len()).sum::<usize>();
    let (mut models, mut others): (Vec<RepeatedModel<'a>>, Vec<usize>) = (Vec::new(), Vec::new());
    let mut places = rustc_hash::FxHashMap::default();
    for (index, instance) in shown() {
        let kind = kind_of(index);
        let count = counts.get(&kind).copied().unwrap_or(1);
        let mut transform = instance.transform;
        transform.translation -= checked.origin;
        let transform: DAffine3 = kind.mirror(y_up(&transform));
        if (count - 1) * vertices(instance.mesh) < WORTH {
            others.push(index);
            continue;
        }
        let place = *places.entry(kind).or_insert_with(|| {
            models.push(RepeatedModel { kind, group: InstanceGroup::default(), count: 0 });
            models.len() - 1
        });
        // A sheared instance cannot be one of a group.
        match models[place].group.take(&transform) {
            true => {
                let number = metadata.map_or(-1.0, |metadata| metadata.number_of(instance));
                models[place].group.features.push(number);
                models[place].count += 1;
            }
            false => others.push(index),
        }
    }
    models.retain(|model| model.count > 0);
    (models, others)
}
