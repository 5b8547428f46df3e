//! The drawn result of a derived system, or the content of a file, as one object that systems can place.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use crate::{ObjectParameter, Show};
use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};
use burgeon_macros::{methods, object};
use burgeon_scene::{Instance, Material, Part, Scene, SurfaceMeaning};

/// Minimum number of instances for which memory is requested in advance.
const MANY: usize = 4096;

/// A model to place: the drawn result of a derived system, or a glTF file.
///
/// It never changes. The way in which files are read is no part of its kind here.
#[object("model", given, can(Show))]
pub struct Model {
    scene: Arc<Scene>,
    /// Bounding box (m).
    bounds: (DVec3, DVec3),
}

#[methods("model")]
impl Model {
    /// Returns the lowest corner of the bounding box (m).
    pub fn low(&self) -> DVec3 {
        self.bounds.0
    }

    /// Returns the highest corner of the bounding box (m).
    pub fn high(&self) -> DVec3 {
        self.bounds.1
    }
}

impl Model {
    /// Creates a model of the whole `scene`.
    pub fn new(scene: Scene) -> Self {
        let bounds = scene.bounds().unwrap_or_default();
        Self { scene: Arc::new(scene), bounds }
    }

    /// Returns the number of triangles.
    pub fn size(&self) -> usize {
        self.scene.triangles()
    }

    /// Returns the approximate memory use (bytes).
    pub fn memory(&self) -> usize {
        let parts = self.scene.meshes.iter().flat_map(|mesh| &mesh.parts);
        let images = self.scene.materials.iter().flat_map(|material| material.images());
        let images = images.filter_map(|image| image.content.as_ref());
        parts.map(|part| part.positions.len() * 32 + part.triangles.len() * 12).sum::<usize>()
            + self.scene.instances.len() * 300
            + images.map(|image| image.len()).sum::<usize>()
    }

    /// Returns the number of instances. A mesh counts once for each instance.
    pub fn instances(&self) -> usize {
        self.scene.instances.len()
    }

    /// Returns the mesh of each instance as parts with their materials, and the instance's transform.
    pub fn meshes(&self) -> impl Iterator<Item = (Vec<(&Part, &Material)>, DAffine3)> {
        self.scene.instances.iter().map(|instance| {
            let parts = self.scene.meshes[instance.mesh].parts.iter();
            (parts.map(|part| (part, &self.scene.materials[part.material])).collect(), instance.transform)
        })
    }

    /// Adds an instance of the whole model to `scene` at each of `frames`; the meshes are added once.
    ///
    /// The frames are numbered from `first` on, see [`Instance::placement`]. `meaning`, if any, is the surface meaning
    /// of the whole model. Fails if the run is cancelled or has too little memory.
    ///
    /// ```
    /// use burgeon_kit::Model;
    /// use burgeon_scene::{Instance, Mesh, Scene};
    /// use glam::{DAffine3, DVec3};
    ///
    /// # let (transform, name, feature) = (DAffine3::IDENTITY, String::from("lamp"), None);
    /// # let instance = Instance { mesh: 0, transform, name, feature, origin: None, placement: None, meaning: None };
    /// let lamp = Model::new(Scene { meshes: vec![Mesh::default()], instances: vec![instance], ..Scene::default() });
    /// let mut street = Scene::default();
    /// let frames = [0.0, 20.0, 40.0].map(|x| DAffine3::from_translation(DVec3::new(x, 0.0, 0.0)));
    /// lamp.place(&mut street, &frames, 0, "lamps", None, None)?;
    /// assert_eq!((street.meshes.len(), street.instances.len()), (1, 3));
    /// assert_eq!(street.instances[2].placement, Some(2));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn place(
        &self,
        scene: &mut Scene,
        frames: &[DAffine3],
        first: usize,
        name: &str,
        feature: Option<&str>,
        meaning: Option<SurfaceMeaning>,
    ) -> Result<()> {
        let stop = Stop::current();
        let more = frames.len().saturating_mul(self.scene.instances.len());
        if more > MANY {
            // Models that place each other can double in size at each step, so too many instances are refused before
            // allocation.
            MemoryOwner::ensure_room(more.saturating_mul(size_of::<Instance>() + name.len()))?;
            scene.instances.reserve_exact(more);
        }
        for (number, frame) in (first..).zip(frames) {
            for (index, instance) in self.scene.instances.iter().enumerate() {
                // Models that place each other multiply, so cancellation is checked often.
                if (number + index).is_multiple_of(256) {
                    stop.as_ref().map_or(Ok(()), |stop| stop.check())?;
                }
                let mesh = scene.share(&self.scene, instance.mesh);
                scene.instances.push(Instance {
                    mesh,
                    transform: *frame * instance.transform,
                    name: name.to_owned(),
                    feature: feature.map(str::to_owned),
                    origin: None,
                    placement: Some(number),
                    meaning: meaning.or(instance.meaning),
                });
            }
        }
        Ok(())
    }
}

impl ObjectParameter for Model {
    const LUAU: &str = "Model";
    const EXPECTED: &str = "what derive returned, or model(\"window.glb\")";
}

impl std::fmt::Debug for Model {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Model").field(&self.bounds).finish()
    }
}

impl Show for Model {
    fn triangles(&self) -> usize {
        self.size()
    }

    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.place(scene, &[DAffine3::IDENTITY], 0, name, feature, None)
    }
}
