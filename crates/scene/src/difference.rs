//! Differences of two scenes: features, materials, numbers and bounds.

use std::collections::BTreeMap;

use glam::DVec3;
use rustc_hash::FxHashMap;

use super::{Instance, Material, Mesh, Scene};

/// Differences between a scene and a later scene, such as before and after a change of a parameter.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SceneDifference {
    /// Features that only the later scene shows, in the order of systems and ids.
    pub added: Vec<ShownFeature>,
    /// Features that only the earlier scene shows.
    pub removed: Vec<ShownFeature>,
    /// Features that both scenes show with different shapes, positions or materials.
    pub changed: Vec<ShownFeature>,
    /// Number of features that both scenes show alike.
    pub unchanged: usize,
    /// Set if the instances without a feature differ.
    pub others_changed: bool,
    /// Differences of the materials.
    pub materials: MaterialDifference,
    /// Numbers of the earlier and of the later scene.
    pub counts: [SceneCounts; 2],
    /// Bounding boxes (m) of the earlier and of the later scene; `None` for an empty scene.
    pub bounds: [Option<(DVec3, DVec3)>; 2],
}

/// Feature that a scene shows.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct ShownFeature {
    /// Index of its system in the script, from 0, if known.
    pub system: Option<usize>,
    /// Id, unique within the system.
    pub id: String,
}

/// Differences of the materials of two scenes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct MaterialDifference {
    /// Materials that only the later scene has, in its order.
    pub added: Vec<Material>,
    /// Materials that only the earlier scene has, in its order.
    pub removed: Vec<Material>,
    /// Materials whose name both scenes use once, with different properties: the earlier and the later one.
    pub changed: Vec<[Material; 2]>,
}

/// Numbers of a scene.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct SceneCounts {
    /// Visible triangles, counted for each instance.
    pub triangles: usize,
    /// Instances.
    pub instances: usize,
    /// Meshes.
    pub meshes: usize,
    /// Materials.
    pub materials: usize,
}

impl SceneDifference {
    /// Returns true if both scenes show the same.
    pub fn is_empty(&self) -> bool {
        let Self { added, removed, changed, others_changed, materials, counts, bounds, .. } = self;
        let features = added.is_empty() && removed.is_empty() && changed.is_empty() && !others_changed;
        features
            && *materials == MaterialDifference::default()
            && counts[0] == counts[1]
            && bounds[0] == bounds[1]
    }
}

impl Scene {
    /// Compares the scene with a later one.
    ///
    /// Features are the same if their ids and the numbers of their systems are. Everything that is drawn is compared exactly:
    /// positions, normals, texture coordinates, triangles, materials and transforms.
    ///
    /// ```
    /// use burgeon_scene::{Material, Scene};
    ///
    /// let (mut before, mut after) = (Scene::default(), Scene::default());
    /// before.material(&Material { name: "plaster".into(), ..Material::default() });
    /// after.material(&Material { name: "plaster".into(), roughness: 0.5, ..Material::default() });
    /// let difference = before.difference(&after);
    /// assert!(!difference.is_empty() && before.difference(&before).is_empty());
    /// let [[old, new]] = &difference.materials.changed[..] else { panic!("one material has changed") };
    /// assert_eq!((old.roughness, new.roughness), (0.8, 0.5));
    /// ```
    #[must_use]
    pub fn difference(&self, after: &Self) -> SceneDifference {
        let mut comparison = Comparison { before: self, after, meshes: FxHashMap::default() };
        let [earlier, later] = [self, after].map(by_feature);
        let mut difference = SceneDifference {
            materials: materials_of(self, after),
            counts: [self, after].map(counts_of),
            bounds: [self, after].map(Self::bounds),
            ..SceneDifference::default()
        };
        for (feature, shown) in &earlier {
            let now = later.get(feature);
            let is_same = now.is_some_and(|now| comparison.are_alike(shown, now));
            match (feature, now) {
                (None, now) => difference.others_changed |= now.is_some() && !is_same,
                (Some(feature), None) => difference.removed.push(feature.clone()),
                (Some(_), Some(_)) if is_same => difference.unchanged += 1,
                (Some(feature), Some(_)) => difference.changed.push(feature.clone()),
            }
        }
        let new = later.keys().filter(|feature| !earlier.contains_key(*feature));
        difference.added.extend(new.flatten().cloned());
        difference.others_changed |= earlier.contains_key(&None) != later.contains_key(&None);
        difference
    }
}

/// Returns the instances of each feature, in order; `None` is the key of those without a feature.
fn by_feature(scene: &Scene) -> BTreeMap<Option<ShownFeature>, Vec<&Instance>> {
    let mut found: BTreeMap<Option<ShownFeature>, Vec<&Instance>> = BTreeMap::new();
    for instance in &scene.instances {
        let feature = instance
            .feature
            .as_ref()
            .map(|id| ShownFeature { system: instance.origin.map(|origin| origin.system), id: id.clone() });
        found.entry(feature).or_default().push(instance);
    }
    found
}

fn counts_of(scene: &Scene) -> SceneCounts {
    SceneCounts {
        triangles: scene.triangles(),
        instances: scene.instances.len(),
        meshes: scene.meshes.len(),
        materials: scene.materials.len(),
    }
}

fn materials_of(before: &Scene, after: &Scene) -> MaterialDifference {
    let missing = |of: &Scene, other: &Scene| -> Vec<Material> {
        of.materials.iter().filter(|material| !other.materials.contains(material)).cloned().collect()
    };
    let (mut removed, mut added) = (missing(before, after), missing(after, before));
    let mut changed = Vec::new();
    let is_only =
        |scene: &Scene, name: &str| scene.materials.iter().filter(|known| known.name == name).count() == 1;
    removed.retain(|old| {
        let name = &old.name;
        let place = added.iter().position(|new| new.name == *name);
        let place = place.filter(|_| !name.is_empty() && is_only(before, name) && is_only(after, name));
        place.map(|place| changed.push([old.clone(), added.remove(place)])).is_none()
    });
    MaterialDifference { added, removed, changed }
}

/// Comparison of the instances of two scenes.
struct Comparison<'a> {
    before: &'a Scene,
    after: &'a Scene,
    /// Results for pairs of meshes.
    meshes: FxHashMap<(usize, usize), bool>,
}

impl Comparison<'_> {
    fn are_alike(&mut self, earlier: &[&Instance], later: &[&Instance]) -> bool {
        earlier.len() == later.len()
            && earlier.iter().zip(later).all(|(one, other)| {
                one.transform == other.transform
                    && one.name == other.name
                    && one.meaning == other.meaning
                    && self.is_same_mesh(one.mesh, other.mesh)
            })
    }

    fn is_same_mesh(&mut self, one: usize, other: usize) -> bool {
        if let Some(known) = self.meshes.get(&(one, other)) {
            return *known;
        }
        let (before, after) = (self.before, self.after);
        let is_same = match (before.meshes.get(one), after.meshes.get(other)) {
            (Some(one), Some(other)) => are_equal(before, one, after, other),
            _ => false,
        };
        self.meshes.insert((one, other), is_same);
        is_same
    }
}

/// Returns true if two meshes are drawn alike. Their materials can have different numbers.
fn are_equal(before: &Scene, one: &Mesh, after: &Scene, other: &Mesh) -> bool {
    one.parts.len() == other.parts.len()
        && one.parts.iter().zip(&other.parts).all(|(a, b)| {
            before.materials.get(a.material) == after.materials.get(b.material)
                && a.positions == b.positions
                && a.triangles == b.triangles
                && a.normals == b.normals
                && a.uvs == b.uvs
                && a.second_uvs == b.second_uvs
                && a.surfaces == b.surfaces
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Origin;
    use glam::{DAffine3, Vec3};

    /// Returns a scene with a triangle for each feature, of this size (m), and one without a feature.
    fn scene(features: &[(&str, f32)], paint: f32) -> Scene {
        let mut scene = Scene::default();
        for (number, (id, size)) in features.iter().chain([&("", 1.0)]).enumerate() {
            let material = Material { name: "paint".into(), roughness: paint, ..Material::default() };
            let mut mesh = Mesh::default();
            let part = mesh.part(scene.material(&material));
            part.positions = [Vec3::ZERO, Vec3::X, Vec3::Y].map(|at| at * *size).to_vec();
            part.triangles.push([0, 1, 2]);
            scene.meshes.push(mesh);
            scene.instances.push(Instance {
                mesh: number,
                transform: DAffine3::IDENTITY,
                name: String::new(),
                feature: (!id.is_empty()).then(|| (*id).to_owned()),
                origin: Some(Origin { system: 0, chain: number, record: None }),
                placement: None,
                meaning: None,
            });
        }
        scene
    }

    fn ids(features: &[ShownFeature]) -> Vec<&str> {
        features.iter().map(|feature| feature.id.as_str()).collect()
    }

    #[test]
    fn features_are_added_removed_and_changed_by_their_ids() {
        let before = scene(&[("a", 1.0), ("b", 1.0), ("c", 1.0)], 0.5);
        let after = scene(&[("d", 1.0), ("c", 2.0), ("a", 1.0)], 0.5);
        let found = before.difference(&after);
        assert_eq!((ids(&found.added), ids(&found.removed)), (vec!["d"], vec!["b"]));
        assert_eq!((ids(&found.changed), found.unchanged), (vec!["c"], 1));
        assert!(!found.others_changed && found.materials == MaterialDifference::default());
        assert_eq!(found.counts[0], found.counts[1]);
        assert_eq!(found.bounds.map(|bounds| bounds.map(|(_, high)| high.x)), [Some(1.0), Some(2.0)]);
        let back = after.difference(&before);
        assert_eq!(
            (ids(&back.added), ids(&back.removed), ids(&back.changed)),
            (vec!["b"], vec!["d"], vec!["c"])
        );
    }

    #[test]
    fn a_changed_material_changes_the_features_that_have_it() {
        let [before, after] = [0.5, 0.6].map(|paint| scene(&[("a", 1.0)], paint));
        let found = before.difference(&after);
        assert!(ids(&found.changed) == ["a"] && found.others_changed && !found.is_empty());
        assert_eq!(found.materials.changed.len(), 1);
        assert!(found.materials.added.is_empty() && found.materials.removed.is_empty());
    }

    #[test]
    fn the_order_of_features_and_of_materials_makes_no_difference() {
        let before = scene(&[("a", 1.0), ("b", 2.0)], 0.5);
        let mut after = scene(&[("b", 2.0), ("a", 1.0)], 0.5);
        assert!(before.difference(&after).is_empty());
        after.instances.pop();
        let found = before.difference(&after);
        assert!(found.others_changed && found.unchanged == 2 && !found.is_empty());
    }
}
