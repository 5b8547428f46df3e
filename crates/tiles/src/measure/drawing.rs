//! Drawings of the features of a scene, and their distances in another level of detail.

use std::collections::{BTreeMap, BTreeSet};

use burgeon_base::error::Result;
use burgeon_scene::{Instance, Scene};
use rayon::prelude::*;

use super::hausdorff::{NEAR, PART, hausdorff};
use super::tree::{TreeBounds, TriangleCorners, TriangleTree};

/// Number of features that are measured at the same time.
const GROUP: usize = 16;

/// System and id of a feature.
type FeatureKey<'a> = (usize, &'a str);

/// Drawings of the features of a scene.
pub struct FeatureDrawings<'a> {
    scene: &'a Scene,
    instances: BTreeMap<FeatureKey<'a>, Vec<&'a Instance>>,
}

impl<'a> FeatureDrawings<'a> {
    /// Finds the instances of each feature of a scene. Instances without a feature count as one feature of their system.
    pub fn new(scene: &'a Scene) -> Self {
        let mut instances: BTreeMap<FeatureKey<'a>, Vec<&'a Instance>> = BTreeMap::new();
        for instance in &scene.instances {
            let system = instance.origin.map_or(usize::MAX, |origin| origin.system);
            let feature = instance.feature.as_deref().unwrap_or_default();
            instances.entry((system, feature)).or_default().push(instance);
        }
        Self { scene, instances }
    }

    /// Returns the largest Hausdorff distances (m) between the drawings of a feature in this scene and in each of others.
    ///
    /// If only one of the scenes draws a feature, its distance is the diagonal of its drawing. A result is at least the distance,
    /// and exceeds it by at most a twentieth and 20 cm. Fails as soon as `proceed` fails, which is called before each feature.
    pub fn errors(&self, others: &[Self], proceed: &(impl Fn() -> Result<()> + Sync)) -> Result<Vec<f64>> {
        let all = others.iter().chain([self]).flat_map(|drawings| drawings.instances.keys());
        let keys: Vec<&FeatureKey<'a>> = all.collect::<BTreeSet<_>>().into_iter().collect();
        // A large distance that is known from the start spares most of the work for the features with smaller ones.
        let least = |other: &Self| {
            let differences =
                keys.par_iter().map(|key| proceed().map(|()| bounds_difference(self, other, key)));
            differences.try_reduce(|| 0.0, |a: f64, b| Ok(a.max(b)))
        };
        let mut largest = others.iter().map(least).collect::<Result<Vec<f64>>>()?;
        // A group has the same known distances for any number of threads.
        for group in keys.chunks(GROUP) {
            let measured = group.par_iter().map(|key| {
                proceed()?;
                let own = self.tree(key);
                let of = |(other, known): (&Self, &f64)| hausdorff(&own, &other.tree(key), *known);
                Ok(others.iter().zip(&largest).map(of).collect::<Vec<f64>>())
            });
            for errors in measured.collect::<Result<Vec<_>>>()? {
                largest.iter_mut().zip(errors).for_each(|(largest, error)| *largest = error.max(*largest));
            }
        }
        Ok(largest.into_iter().map(|error| error * (1.0 + PART) + NEAR).collect())
    }

    /// Returns the tree of the triangles of a feature.
    fn tree(&self, key: &FeatureKey<'a>) -> TriangleTree {
        TriangleTree::new(self.triangles(key).collect())
    }

    /// Returns the triangles of a feature.
    fn triangles(&self, key: &FeatureKey<'a>) -> impl Iterator<Item = TriangleCorners> {
        let placed = self.instances.get(key).into_iter().flatten();
        let parts = placed.filter_map(|instance| Some((instance, self.scene.meshes.get(instance.mesh)?)));
        let parts = parts.flat_map(|(instance, mesh)| mesh.parts.iter().map(move |part| (instance, part)));
        parts.flat_map(|(instance, part)| {
            let place = |corner: u32| {
                let position = part.positions.get(corner as usize).copied().unwrap_or_default();
                instance.transform.transform_point3(position.as_dvec3())
            };
            part.triangles.iter().map(move |corners| corners.map(place))
        })
    }
}

/// Returns the largest difference (m) between the bounds of two drawings of a feature; 0 if one of them has no triangles.
fn bounds_difference<'a>(a: &FeatureDrawings<'a>, b: &FeatureDrawings<'a>, key: &FeatureKey<'a>) -> f64 {
    let bounds = [a, b].map(|drawings| TreeBounds::of(drawings.triangles(key).flatten()));
    let [Some(a), Some(b)] = bounds else { return 0.0 };
    a.difference(&b)
}

/// Returns true if two scenes have the same shapes at the same places. Materials may differ.
pub fn draws_the_same(a: &Scene, b: &Scene) -> bool {
    let is_same = |a_instance: &Instance, b_instance: &Instance| {
        let meshes = a.meshes.get(a_instance.mesh).zip(b.meshes.get(b_instance.mesh));
        a_instance.transform == b_instance.transform
            && meshes.is_some_and(|(a, b)| {
                let parts = a.parts.iter().zip(&b.parts);
                a.parts.len() == b.parts.len()
                    && parts
                        .into_iter()
                        .all(|(a, b)| a.positions == b.positions && a.triangles == b.triangles)
            })
    };
    a.instances.len() == b.instances.len() && a.instances.iter().zip(&b.instances).all(|(a, b)| is_same(a, b))
}

#[cfg(test)]
mod tests {
    use super::*;
    use burgeon_scene::{Mesh, Origin};
    use glam::{DAffine3, DVec3, Vec3};

    /// Returns a scene with a square of 10 m at a height for each feature.
    fn scene(features: &[(&str, f64)]) -> Scene {
        let mut scene = Scene::default();
        let material = scene.material(&Default::default());
        let mut mesh = Mesh::default();
        let part = mesh.part(material);
        part.positions =
            [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec();
        part.triangles.push([0, 1, 2]);
        part.triangles.push([0, 2, 3]);
        scene.meshes.push(mesh);
        scene.instances.extend(features.iter().map(|(id, height)| Instance {
            mesh: 0,
            transform: DAffine3::from_translation(DVec3::new(50.0, 70.0, *height)),
            name: String::new(),
            feature: Some((*id).to_owned()),
            origin: Some(Origin { system: 0, chain: 0, record: None }),
            placement: None,
            meaning: None,
        }));
        scene
    }

    #[test]
    fn the_error_is_the_largest_distance_of_a_feature_from_itself() {
        let fine = scene(&[("a", 3.0), ("b", 9.0), ("c", 4.0)]);
        let error = |other: &[(&str, f64)]| {
            let coarse = scene(other);
            let drawings = |scene| FeatureDrawings::new(scene);
            let errors = drawings(&fine).errors(&[drawings(&coarse), drawings(&fine)], &|| Ok(())).unwrap();
            assert!((errors[1] - NEAR).abs() < 1e-9);
            errors[0]
        };
        let is_nearly = |error: f64, distance: f64| (distance..distance * 1.1001 + 0.2001).contains(&error);
        // Feature "b" is where "c" was, but it is 5 m away from itself.
        assert!(is_nearly(error(&[("a", 3.0), ("b", 4.0), ("c", 4.0)]), 5.0));
        assert!(is_nearly(error(&[("a", 3.0), ("b", 9.0), ("c", 4.0)]), 0.0));
        // A feature that is not drawn has its diagonal as error.
        assert!(is_nearly(error(&[("a", 3.0), ("b", 9.0)]), 200.0_f64.sqrt()));
        // Nothing is measured after a limit.
        let stopped = || Err(burgeon_base::error::Error::cancellation("stopped"));
        let stopped = FeatureDrawings::new(&fine).errors(&[FeatureDrawings::new(&fine)], &stopped);
        assert_eq!(stopped.unwrap_err().message(), "stopped");
        assert!(draws_the_same(&fine, &fine.clone()));
        assert!(!draws_the_same(&fine, &scene(&[("a", 3.0), ("b", 9.0), ("c", 4.5)])));
    }
}
