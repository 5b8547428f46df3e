//! Merges repeated instances into meshes, for programs that read neither instances nor many nodes.

use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_scene::{Instance, Mesh, Origin, Part, Scene};
use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use crate::decompose::normal_matrix;

/// Maximum number of triangles and of points of the merged meshes.
const LIMIT: usize = 50_000_000;

/// Properties of an instance that its merged mesh keeps.
type InstanceOwner<'a> = (&'a str, Option<&'a str>, Option<Origin>);

/// Returns `scene` with a mesh for each system and feature in place of its instances of repeated meshes. Other instances
/// are unchanged.
///
/// Fails if the merged meshes would have more than 50 million triangles or points.
pub(super) fn expand(scene: &Scene) -> Result<Scene> {
    let mut uses = vec![0_usize; scene.meshes.len()];
    for instance in &scene.instances {
        if let Some(uses) = uses.get_mut(instance.mesh) {
            *uses += 1;
        }
    }
    let is_repeated = |instance: &Instance| uses.get(instance.mesh).is_some_and(|uses| *uses > 1);
    let repeated = || scene.instances.iter().filter(|instance| is_repeated(instance));
    let points = |mesh: &Mesh| mesh.parts.iter().map(|part| part.positions.len()).sum::<usize>();
    let sizes: Vec<usize> = scene.meshes.iter().map(|mesh| mesh.triangles().max(points(mesh))).collect();
    let size = repeated().fold(0_usize, |sum, instance| sum.saturating_add(sizes[instance.mesh]));
    if size > LIMIT {
        let message = format!(
            "--instances expanded would merge {} triangles or points; the limit is {}",
            grouped(size),
            grouped(LIMIT)
        );
        return Err(Error::limit(Limit::Size, message).help("use --instances nodes or --instances extension"));
    }
    let mut expanded = Scene {
        materials: scene.materials.clone(),
        meshes: scene.meshes.clone(),
        upright: scene.upright,
        cameras: scene.cameras.clone(),
        packages: scene.packages.clone(),
        ..Scene::default()
    };
    let mut known: FxHashMap<InstanceOwner<'_>, usize> = FxHashMap::default();
    for instance in &scene.instances {
        if !is_repeated(instance) {
            expanded.instances.push(instance.clone());
            continue;
        }
        let owner = (&*instance.name, instance.feature.as_deref(), instance.origin);
        let index = *known.entry(owner).or_insert_with(|| {
            let mesh = Mesh { name: instance.name.clone(), origin: instance.origin, parts: Vec::new() };
            expanded.meshes.push(mesh);
            // The mesh counts from its first instance, so that points have the precision of near ones.
            let transform = DAffine3::from_translation(instance.transform.translation.round());
            let mesh = expanded.meshes.len() - 1;
            let merged = Instance { mesh, transform, placement: None, meaning: None, ..instance.clone() };
            expanded.instances.push(merged);
            expanded.instances.len() - 1
        });
        let Instance { mesh, transform, .. } = &expanded.instances[index];
        let origin = transform.translation;
        merge(&scene.meshes[instance.mesh], instance, origin, &mut expanded.meshes[*mesh]);
    }
    Ok(expanded)
}

/// Adds `mesh` to `merged`, with the transform of `instance` relative to `origin` (m).
fn merge(mesh: &Mesh, instance: &Instance, origin: DVec3, merged: &mut Mesh) {
    let mut transform = instance.transform;
    transform.translation -= origin;
    let turned = normal_matrix(&transform.matrix3);
    let mirrored = transform.matrix3.determinant() < 0.0;
    for part in &mesh.parts {
        let into: &mut Part = merged.part(part.material);
        let first = into.positions.len() as u32;
        let world = |point: &glam::Vec3| transform.transform_point3(point.as_dvec3()).as_vec3();
        into.positions.extend(part.positions.iter().map(world));
        into.normals.extend(part.normals.iter().map(|normal| {
            let turned = turned * normal.vector().as_dvec3();
            burgeon_scene::Normal::from(turned.try_normalize().unwrap_or(DVec3::Z))
        }));
        into.extend_uvs(part);
        for (index, [a, b, c]) in part.triangles.iter().enumerate() {
            into.surfaces.mark(into.triangles.len(), part.surfaces.of(index));
            let corners = if mirrored { [a, c, b] } else { [a, b, c] };
            // The check of the scene reports a corner that does not exist.
            into.triangles.push(corners.map(|corner| corner.saturating_add(first)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;

    #[test]
    fn repeated_instances_of_a_name_become_one_mesh_of_the_same_volume_and_others_stay() {
        let mut scene = samples::many(40);
        scene.meshes.push(samples::cube("alone", 0));
        scene.instances.push(Instance { mesh: 1, name: "alone".into(), ..scene.instances[3].clone() });
        scene.instances[7].feature = Some("way/7".into());
        let expanded = expand(&scene).unwrap();
        let names: Vec<_> = expanded.instances.iter().map(|it| (&*it.name, it.feature.as_deref())).collect();
        assert_eq!(names, [("", None), ("", Some("way/7")), ("alone", None)]);
        assert_eq!(expanded.triangles(), scene.triangles());
        let (volume, real) = (samples::volume(&expanded), samples::volume(&scene));
        assert!((volume - real).abs() < 1e-4 * real, "{volume} is not {real}");
    }

    #[test]
    fn a_model_that_grows_too_much_is_refused_before_it_grows() {
        let mut scene = samples::boxes(1);
        scene.meshes[0].parts[0].triangles = (0..60_000).map(|_| [0, 1, 2]).collect();
        scene.instances = vec![scene.instances[0].clone(); 1000];
        insta::assert_snapshot!(expand(&scene).unwrap_err(), @r"
        --instances expanded would merge 60,000,000 triangles or points; the limit is 50,000,000
          help: use --instances nodes or --instances extension
        ");
    }
}
