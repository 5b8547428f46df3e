//! Scene: the result of a run, ready for an exporter or the renderer.
//!
//! Input: meshes and instances from objects, in chain order. Output: the same, unchanged. The crate never builds
//! geometry and never uses rules.

mod camera;
mod city;
mod difference;
pub mod image;
mod material;
mod mesh;
mod nearest;
mod normal;
mod recipe;
mod shared;
mod surface;
mod triangles;
mod upright;

pub use camera::{CameraView, FittedView, SceneCamera};
pub use city::CityClass;
pub use difference::{MaterialDifference, SceneCounts, SceneDifference, ShownFeature};
pub use material::{DirtMap, Material, NormalMap, Texture};
pub use mesh::{Mesh, Part};
pub use nearest::nearest_on_triangle;
pub use normal::Normal;
pub use recipe::{Recipe, RecipeData, RecipeFile, RecipeValue, ScenePackage};
pub use shared::SharedMeshes;
pub use surface::{SurfaceMeaning, SurfaceRuns};
pub use triangles::{Iter, Triangles};
pub use upright::Upright;

use glam::{DAffine3, DVec3};
use rayon::prelude::*;

/// Result of a run, in an order that depends only on the scripts, inputs and seed.
///
/// Coordinates are in metres, z up, right-handed.
///
/// ```
/// use burgeon_scene::{Instance, Mesh, Scene};
/// use glam::{DAffine3, DVec3, Vec3};
///
/// let mut scene = Scene::default();
/// let mut mesh = Mesh::default();
/// let part = mesh.part(scene.material(&Default::default()));
/// part.positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
/// part.triangles.push([0, 1, 2]);
/// scene.meshes.push(mesh);
/// for x in [0.0, 10.0] {
///     let transform = DAffine3::from_translation(DVec3::new(x, 0.0, 0.0));
///     let (name, feature, origin) = (String::from("tile"), None, None);
///     let instance = Instance { mesh: 0, transform, name, feature, origin, placement: None, meaning: None };
///     scene.instances.push(instance);
/// }
/// assert_eq!(scene.triangles(), 2);
/// assert_eq!(scene.bounds(), Some((DVec3::ZERO, DVec3::new(11.0, 1.0, 0.0))));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Scene {
    /// Materials without duplicates, in the order of their first use.
    pub materials: Vec<Material>,
    /// Shapes, each in its own coordinates; [`Part::material`] is an index into `materials`.
    pub meshes: Vec<Mesh>,
    /// Positions of the meshes. A mesh without an instance is not shown.
    pub instances: Vec<Instance>,
    /// Meshes of placed models. Initialise the field with [`Default`].
    pub shared: SharedMeshes,
    /// Up and north for the default camera; z and y if no object sets them.
    pub upright: Option<Upright>,
    /// Cameras, in the order of their declarations. The first is that of a picture without another.
    pub cameras: Vec<SceneCamera>,
    /// Packages that the scene was made with, for files that list the requirements for reproducing it.
    pub packages: Vec<ScenePackage>,
}

/// Placed mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Instance {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Transform from the mesh's coordinates to the world's.
    pub transform: DAffine3,
    /// Display name, such as the system's; may repeat, may be empty.
    pub name: String,
    /// Id of the data record that it was made from, if any.
    pub feature: Option<String>,
    /// Chain whose object created the instance.
    pub origin: Option<Origin>,
    /// Index of the placed model that it belongs to, from 0, among those that the object placed. `None` for the
    /// object's own drawing.
    pub placement: Option<usize>,
    /// Meaning of the whole instance, if known. The same model can be a window in one wall and a door in another.
    pub meaning: Option<SurfaceMeaning>,
}

/// Chain of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Origin {
    /// Index of the system in the script, from 0.
    pub system: usize,
    /// Index of the chain in the system, from 0.
    pub chain: usize,
    /// Index of its feature among the features of the system's chains or modules, from 0.
    pub record: Option<usize>,
}

impl Scene {
    /// Returns the index of `material`, adding it if it is new.
    ///
    /// ```
    /// use burgeon_scene::{Material, Scene};
    ///
    /// let mut scene = Scene::default();
    /// let plaster = Material::default();
    /// let glass = Material { roughness: 0.1, ..Material::default() };
    /// assert_eq!([&plaster, &glass, &plaster].map(|material| scene.material(material)), [0, 1, 0]);
    /// assert_eq!(scene.materials.len(), 2);
    /// ```
    pub fn material(&mut self, material: &Material) -> usize {
        // Comparing the colour first distinguishes most materials quickly.
        let same = |known: &Material| known.base_color == material.base_color && known == material;
        match self.materials.iter().position(same) {
            Some(index) => index,
            None => {
                self.materials.push(material.clone());
                self.materials.len() - 1
            }
        }
    }

    /// Returns a scene with only the instances that `keep` accepts, and the meshes and materials that they need.
    #[must_use]
    pub fn only(&self, keep: impl Fn(&Instance) -> bool) -> Self {
        let mut scene = Self { upright: self.upright, cameras: self.cameras.clone(), ..Self::default() };
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
    /// `stretches` are parts, ranges of their triangles and owners. `set` assigns an owner to an instance. The first
    /// instance replaces the original. Does nothing unless the stretches contain each triangle exactly once.
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

    /// Returns the number of visible triangles, counted for each instance.
    pub fn triangles(&self) -> usize {
        self.instances.iter().map(|instance| self.meshes[instance.mesh].triangles()).sum()
    }

    /// Returns the minimum and maximum corner (m) of the bounding box of the visible meshes; `None` if nothing is
    /// visible.
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        self.bounds_of(&self.meshes.par_iter().map(Mesh::bounds).collect::<Vec<_>>())
    }

    /// Computes the bounding box as [`bounds`](Self::bounds) does, from the boxes (m) of the meshes.
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
