//! What a derived system has drawn, or a file holds, as one thing that systems can place.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{Kind, Object, Table};
use crate::error::{Error, Result};
use crate::scene::{Instance, Scene};

/// The drawing of a derived system, or the content of a file. It never changes.
#[derive(Clone)]
pub struct Model {
    scene: Arc<Scene>,
}

methods! {
    Model = "model" {
        /// The lowest corner of the box around it (m).
        pub fn low(&self) -> DVec3 {
            self.scene.bounds().map_or(DVec3::ZERO, |(low, _)| low)
        }

        /// The highest corner of the box around it (m).
        pub fn high(&self) -> DVec3 {
            self.scene.bounds().map_or(DVec3::ZERO, |(_, high)| high)
        }
    }
}

impl Model {
    /// The type, as scripts see it.
    pub const KIND: Kind = Kind {
        name: "model",
        doc: "What a derived system has drawn, or a glTF file holds, for placing elsewhere.",
        fields: &[],
        first: None,
        methods: Self::METHODS,
        construct: |_: &Table| {
            Err(Error::new("a model is what derive returns, or a file")
                .help("write local model = system:derive(), or model(\"window.glb\")"))
        },
    };

    /// A model of all that `scene` shows.
    pub fn new(scene: Scene) -> Self {
        Self { scene: Arc::new(scene) }
    }

    /// The number of its triangles.
    pub fn size(&self) -> usize {
        self.scene.triangles()
    }

    /// Adds an instance of everything to `scene` at each of `frames`; its meshes are added once.
    ///
    /// The frames are numbered from `first` on, as [`Instance::placement`] tells.
    pub fn place(
        &self,
        scene: &mut Scene,
        frames: &[DAffine3],
        first: usize,
        name: &str,
        feature: Option<&str>,
    ) {
        let mut meshes = vec![None; self.scene.meshes.len()];
        for (number, frame) in (first..).zip(frames) {
            for instance in &self.scene.instances {
                let mesh = *meshes[instance.mesh].get_or_insert_with(|| {
                    let mut mesh = self.scene.meshes[instance.mesh].clone();
                    for part in &mut mesh.parts {
                        part.material = scene.material(&self.scene.materials[part.material]);
                    }
                    scene.meshes.push(mesh);
                    scene.meshes.len() - 1
                });
                scene.instances.push(Instance {
                    mesh,
                    transform: *frame * instance.transform,
                    name: name.to_owned(),
                    feature: feature.map(str::to_owned),
                    origin: None,
                    placement: Some(number),
                });
            }
        }
    }
}

impl Object for Model {
    fn kind(&self) -> &'static Kind {
        const { &Self::KIND }
    }

    fn boxed(&self) -> Box<dyn Object> {
        Box::new(self.clone())
    }

    fn triangles(&self) -> usize {
        self.size()
    }

    fn show(&self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        self.place(scene, &[DAffine3::IDENTITY], 0, name, feature);
        Ok(())
    }
}
