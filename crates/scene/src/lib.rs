//! The scene: what a run has made, ready for an exporter or the renderer.
//!
//! Comes in: meshes and instances from objects, in chain order. Goes out: the same, unchanged.
//! It never builds geometry and never looks at rules.

mod city;
pub mod image;
mod material;
mod mesh;
mod normal;
mod shared;
mod surface;
mod triangles;
mod upright;

pub use city::CityClass;
pub use material::{Material, Texture};
pub use mesh::{Mesh, Part};
pub use normal::Normal;
pub use shared::SharedMeshes;
pub use surface::{SurfaceMeaning, SurfaceRuns};
pub use triangles::{Iter, Triangles};
pub use upright::Upright;

use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// Everything a run has made, in an order that depends only on the scripts, inputs and seed.
///
/// Metres, z up, right-handed.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scene {
    /// Materials without duplicates, in the order of their first use.
    pub materials: Vec<Material>,
    /// Shapes, each in its own coordinates; [`Part::material`] is an index into `materials`.
    pub meshes: Vec<Mesh>,
    /// Where the meshes stand. A mesh that no instance names is not shown.
    pub instances: Vec<Instance>,
    /// Which meshes are those of placed models; leave it to [`Default`].
    pub shared: SharedMeshes,
    /// Up and north for the default camera; z and y if an object does not set them.
    pub upright: Option<Upright>,
    /// The packages that it was made with, for files that tell what is needed to make it again.
    pub packages: Vec<ScenePackage>,
}

/// A package of scripts that a scene was made with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ScenePackage {
    /// Its name.
    pub name: String,
    /// Its version, of three numbers.
    pub version: String,
    /// The hash of its files, with the name of the method before it.
    pub hash: String,
}

/// A mesh put somewhere.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// From the mesh's coordinates to the world's.
    pub transform: DAffine3,
    /// A name for people, such as the system's; may repeat, may be empty.
    pub name: String,
    /// The id of the data record that it came from, if it came from one.
    pub feature: Option<String>,
    /// The chain whose object put it there.
    pub origin: Option<Origin>,
    /// Which of the models that the object placed it belongs to, from 0; `None` for what the object drew itself.
    pub placement: Option<usize>,
    /// What all of it is, if that is known: a model stands in one wall as a window and in another as a door.
    pub meaning: Option<SurfaceMeaning>,
}

/// A chain, among all that a run has derived.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Origin {
    /// The system's place in the script, from 0.
    pub system: usize,
    /// The chain's number in the system, from 0.
    pub chain: usize,
    /// The number of its feature among those that the system's chains or modules came from, from 0.
    pub record: Option<usize>,
}

impl Scene {
    /// The index of `material`, added if it is new.
    pub fn material(&mut self, material: &Material) -> usize {
        // Colours tell most of them apart at once.
        let same = |known: &Material| known.base_color == material.base_color && known == material;
        match self.materials.iter().position(same) {
            Some(index) => index,
            None => {
                self.materials.push(material.clone());
                self.materials.len() - 1
            }
        }
    }

    /// The scene with those instances alone that are to be kept, and what they need.
    #[must_use]
    pub fn only(&self, keep: impl Fn(&Instance) -> bool) -> Self {
        let mut scene = Self { upright: self.upright, ..Self::default() };
        let mut meshes = vec![None; self.meshes.len()];
        for instance in self.instances.iter().filter(|instance| keep(instance)) {
            let mesh = *meshes[instance.mesh].get_or_insert_with(|| {
                let mut mesh = self.meshes[instance.mesh].clone();
                for part in &mut mesh.parts {
                    part.material = scene.material(&self.materials[part.material]);
                }
                scene.meshes.push(mesh);
                scene.meshes.len() - 1
            });
            scene.instances.push(Instance { mesh, ..instance.clone() });
        }
        scene
    }

    /// Divides instance number `instance`, whose mesh no other instance shows, into one instance for each owner.
    ///
    /// `stretches` are parts, ranges of their triangles and owners. `set` gives an instance its owner. The first instance takes
    /// the place of the old one. Does nothing unless the stretches hold each triangle once.
    pub fn divide<K: Ord + Copy>(
        &mut self,
        instance: usize,
        mut stretches: Vec<(usize, std::ops::Range<usize>, K)>,
        mut set: impl FnMut(&mut Instance, K),
    ) {
        let mesh = self.instances[instance].mesh;
        let mut counts = vec![0; self.meshes[mesh].parts.len()];
        for (part, range, _) in &stretches {
            if let Some(count) = counts.get_mut(*part) {
                *count += range.len();
            }
        }
        let is_whole = |(count, part): (&usize, &Part)| *count == part.triangles.len();
        if stretches.is_empty() || !counts.iter().zip(&self.meshes[mesh].parts).all(is_whole) {
            return;
        }
        let whole = std::mem::take(&mut self.meshes[mesh]);
        stretches.sort_by_key(|(part, range, owner)| (*owner, *part, range.start));
        for (number, of_owner) in stretches.chunk_by(|a, b| a.2 == b.2).enumerate() {
            let parts = of_owner.chunk_by(|a, b| a.0 == b.0).filter_map(|of_part| {
                let piece =
                    whole.parts[of_part[0].0].piece(of_part.iter().map(|(_, range, _)| range.clone()));
                (!piece.triangles.is_empty()).then_some(piece)
            });
            let piece = Mesh { name: whole.name.clone(), origin: whole.origin, parts: parts.collect() };
            if number == 0 {
                self.meshes[mesh] = piece;
                set(&mut self.instances[instance], of_owner[0].2);
            } else {
                self.meshes.push(piece);
                let mut added = Instance { mesh: self.meshes.len() - 1, ..self.instances[instance].clone() };
                set(&mut added, of_owner[0].2);
                self.instances.push(added);
            }
        }
    }

    /// The number of triangles that are seen, instances counted each.
    pub fn triangles(&self) -> usize {
        self.instances.iter().map(|instance| self.meshes[instance.mesh].triangles()).sum()
    }

    /// The least box (m) around all that is seen, as its lowest and highest corner; `None` if nothing is.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.bounds_of(&self.meshes.par_iter().map(Mesh::bounds).collect::<Vec<_>>())
    }

    /// The same where the boxes (m) around the meshes are known.
    pub fn bounds_of(&self, boxes: &[Option<(DVec3, DVec3)>]) -> Option<(DVec3, DVec3)> {
        let mut bounds: Option<(DVec3, DVec3)> = None;
        for instance in &self.instances {
            let Some((low, high)) = boxes[instance.mesh] else { continue };
            for corner in 0..8 {
                let pick = |axis: usize| if corner >> axis & 1 == 0 { low[axis] } else { high[axis] };
                let point = instance.transform.transform_point3(DVec3::new(pick(0), pick(1), pick(2)));
                bounds = Some(match bounds {
                    None => (point, point),
                    Some((a, b)) => (a.min(point), b.max(point)),
                });
            }
        }
        bounds
    }
}
