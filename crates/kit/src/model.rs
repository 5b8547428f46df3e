//! What a derived system has drawn, or a file holds, as one thing that systems can place.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{ObjectParameter, Show};
use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};
use burgeon_macros::{methods, object};
use burgeon_scene::{Instance, Material, Part, Scene, SurfaceMeaning};

/// From so many instances on, the memory for them is asked for at once.
const MANY: usize = 4096;

/// What a derived system has drawn, or a glTF file holds, for placing elsewhere.
///
/// It never changes. The way in which files are read is no part of its kind here.
#[object("model", given, can(Show))]
pub struct Model {
    scene: Arc<Scene>,
    /// The box around it (m).
    bounds: (DVec3, DVec3),
}

#[methods("model")]
impl Model {
    /// The lowest corner of the box around it (m).
    pub fn low(&self) -> DVec3 {
        self.bounds.0
    }

    /// The highest corner of the box around it (m).
    pub fn high(&self) -> DVec3 {
        self.bounds.1
    }
}

impl Model {
    /// A model of all that `scene` shows.
    pub fn new(scene: Scene) -> Self {
        let bounds = scene.bounds().unwrap_or_default();
        Self { scene: Arc::new(scene), bounds }
    }

    /// The number of its triangles.
    pub fn size(&self) -> usize {
        self.scene.triangles()
    }

    /// About how much memory (bytes) it takes.
    pub fn memory(&self) -> usize {
        let parts = self.scene.meshes.iter().flat_map(|mesh| &mesh.parts);
        let images =
            self.scene.materials.iter().filter_map(|material| material.texture.as_ref()?.content.as_ref());
        parts.map(|part| part.positions.len() * 32 + part.triangles.len() * 12).sum::<usize>()
            + self.scene.instances.len() * 300
            + images.map(|image| image.len()).sum::<usize>()
    }

    /// The number of meshes that it shows, each as often as it is seen.
    pub fn instances(&self) -> usize {
        self.scene.instances.len()
    }

    /// Its meshes as often as they are seen, each as parts with their materials, and where it stands.
    pub fn meshes(&self) -> impl Iterator<Item = (Vec<(&Part, &Material)>, DAffine3)> {
        self.scene.instances.iter().map(|instance| {
            let parts = self.scene.meshes[instance.mesh].parts.iter();
            (parts.map(|part| (part, &self.scene.materials[part.material])).collect(), instance.transform)
        })
    }

    /// Adds an instance of everything to `scene` at each of `frames`; its meshes are added once.
    ///
    /// The frames are numbered from `first` on, as [`Instance::placement`] tells; `meaning` is what all of it is. Fails if the
    /// run is stopped, or has no memory left for them.
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
            // Models that place each other double; so much more is refused before it is made.
            MemoryOwner::ensure_room(more.saturating_mul(size_of::<Instance>() + name.len()))?;
            scene.instances.reserve_exact(more);
        }
        for (number, frame) in (first..).zip(frames) {
            for (index, instance) in self.scene.instances.iter().enumerate() {
                // Models that place each other multiply.
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
