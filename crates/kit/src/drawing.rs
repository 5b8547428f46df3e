//! What drawing objects share: faces by material, placed models, and which module made them.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec3};

use super::Model;
use super::distance::Nearest;
use super::makers::Makers;
use burgeon_base::error::Result;
use burgeon_scene::{Instance, Material, Mesh, Normal, Part, Scene, SurfaceMeaning};

/// The faces that an object has drawn, by material, and the models that it has placed.
#[derive(Clone, Default)]
pub struct Drawing {
    /// Where it lies in the scene (m).
    origin: DVec3,
    materials: Vec<Material>,
    parts: Vec<Part>,
    /// What was placed, as what, and where; the same thing once.
    placed: Vec<(Arc<Model>, Option<SurfaceMeaning>, Vec<DAffine3>)>,
    /// How many instances that makes.
    instances: usize,
    /// Whether it is not to be emptied.
    kept: bool,
    /// How many triangles are certain to come of what is not finished.
    expected: usize,
    /// Emptied parts, whose memory is used again: fresh pages cost more than drawing.
    spare: Vec<Part>,
    makers: Option<Makers>,
    /// The triangles by place, from the first question about them to the next change.
    nearest: OnceLock<Arc<Nearest>>,
}

impl Drawing {
    /// An empty drawing whose origin is at `origin` (m).
    pub fn at(origin: DVec3) -> Self {
        Self { origin, ..Self::default() }
    }

    /// Where its origin is (m).
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Has [`Drawing::clear`] do nothing, or forget all again: one that several objects draw into is emptied once. Gives what
    /// was the case before.
    pub fn keep(&mut self, kept: bool) -> bool {
        std::mem::replace(&mut self.kept, kept)
    }

    /// Forgets all faces and models.
    pub fn clear(&mut self) {
        if self.kept {
            return;
        }
        self.nearest.take();
        self.materials.clear();
        self.placed.clear();
        (self.instances, self.expected) = (0, 0);
        for mut part in self.parts.drain(..).rev() {
            part.clear();
            self.spare.push(part);
        }
        if let Some(makers) = &mut self.makers {
            makers.clear();
        }
    }

    /// The number of the part with this material.
    pub fn material(&mut self, material: &Material) -> usize {
        // Colours tell most of them apart at once.
        let same = |known: &Material| known.base_color == material.base_color && known == material;
        if let Some(index) = self.materials.iter().position(same) {
            return index;
        }
        self.materials.push(material.clone());
        let spare = self.spare.pop().unwrap_or_default();
        self.parts.push(Part { material: self.materials.len() - 1, ..spare });
        self.materials.len() - 1
    }

    /// The material of the part with this number.
    pub fn material_of(&self, index: usize) -> Material {
        self.materials.get(index).cloned().unwrap_or_default()
    }

    /// The part with this number, as [`Drawing::material`] gave it.
    #[inline]
    pub fn part(&mut self, index: usize) -> &mut Part {
        self.nearest.take();
        &mut self.parts[index]
    }

    /// The same, where what is added next is known to be a surface of this kind.
    #[inline]
    pub fn surface(&mut self, index: usize, meaning: SurfaceMeaning) -> &mut Part {
        let part = self.part(index);
        part.surfaces.mark(part.triangles.len(), Some(meaning));
        part
    }

    /// The parts, in the order of the first use of their materials.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Distance (m) from `place` to the nearest point of the faces; infinite without any. Models are not asked.
    pub fn distance(&self, place: DVec3) -> f64 {
        self.nearest.get_or_init(|| Arc::new(Nearest::new(&self.parts))).distance(place)
    }

    /// Places `model` at `frame`; the same model many times is one mesh with many instances.
    pub fn place(&mut self, model: &Arc<Model>, frame: DAffine3) {
        self.place_as(model, frame, None);
    }

    /// The same, where all of it is known to be a surface of some kind.
    pub fn place_as(&mut self, model: &Arc<Model>, frame: DAffine3, meaning: Option<SurfaceMeaning>) {
        let known = |(known, known_meaning, _): &(Arc<Model>, Option<SurfaceMeaning>, Vec<DAffine3>)| {
            Arc::ptr_eq(known, model) && *known_meaning == meaning
        };
        let index = match self.placed.iter().position(known) {
            Some(index) => index,
            None => {
                self.placed.push((Arc::clone(model), meaning, Vec::new()));
                self.placed.len() - 1
            }
        };
        self.instances += model.instances();
        self.placed[index].2.push(frame);
        if let Some(makers) = &mut self.makers {
            makers.place(index);
        }
    }

    /// Draws the faces of `model` at `frame`, as if they were its own; `meaning` is what all of it is.
    pub fn draw_model(&mut self, model: &Model, frame: &DAffine3, meaning: Option<SurfaceMeaning>) {
        for (mesh, transform) in model.meshes() {
            let frame = *frame * transform;
            let turned = frame.matrix3.inverse().transpose();
            let mirrored = frame.matrix3.determinant() < 0.0;
            for (part, material) in &mesh {
                let index = self.material(material);
                let into = self.part(index);
                let Ok(base) = u32::try_from(into.positions.len()) else { return };
                into.make_room(part.positions.len(), part.triangles.len());
                let first = into.triangles.len();
                for (range, own) in part.surfaces.stretches(part.triangles.len()) {
                    into.surfaces.mark(first + range.start, meaning.or(own));
                }
                into.positions
                    .extend(part.positions.iter().map(|at| frame.transform_point3(at.as_dvec3()).as_vec3()));
                into.normals.extend(
                    part.normals.iter().map(|normal| Normal::from(turned * normal.vector().as_dvec3())),
                );
                into.uvs.extend_from_slice(&part.uvs);
                into.triangles.extend(part.triangles.iter().map(|corners| {
                    let [a, b, c] = corners.map(|corner| corner + base);
                    if mirrored { [a, c, b] } else { [a, b, c] }
                }));
            }
        }
    }

    /// The number of triangles, and of instances, each of which counts as one.
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum::<usize>() + self.instances + self.expected
    }

    /// Takes notice that what is not finished will be `triangles`, in the place of what was told before. They count.
    pub fn expect(&mut self, triangles: usize) {
        self.expected = triangles;
    }

    /// The number of triangles of the part with this number.
    pub fn triangles_of(&self, index: usize) -> usize {
        self.parts.get(index).map_or(0, |part| part.triangles.len())
    }

    /// The symbol of the chain that draws at present, while a chain is traced.
    #[inline]
    pub fn maker(&self) -> u32 {
        self.makers.as_ref().map_or(0, Makers::present)
    }

    /// Draws into part `index` for the symbol `maker`, which may have come before the present one.
    #[inline]
    pub fn draw_for<T>(&mut self, maker: u32, index: usize, draw: impl FnOnce(&mut Part) -> T) -> T {
        self.nearest.take();
        let Some(makers) = &mut self.makers else { return draw(&mut self.parts[index]) };
        let part = &mut self.parts[index];
        makers.settle(index, part.triangles.len(), makers.present());
        let result = draw(part);
        makers.settle(index, part.triangles.len(), maker);
        result
    }

    /// Notes that the triangles of part `index` up to `count`, which nobody is known to have made, are `maker`'s.
    pub fn made(&mut self, maker: u32, index: usize, count: usize) {
        if let Some(makers) = &mut self.makers {
            makers.settle(index, count, maker);
        }
    }

    /// From now on notes which symbol of the chain draws what; the next one is `maker`.
    pub fn trace(&mut self, maker: u32) {
        let makers = self.makers.get_or_insert_default();
        for (index, part) in self.parts.iter().enumerate() {
            makers.settle(index, part.triangles.len(), makers.present());
        }
        makers.follow(maker);
    }

    /// Which symbol made what: for each part that has triangles, and for placed models in their order.
    pub fn take_makers(&mut self) -> Option<Makers> {
        self.trace(0);
        let shown: Vec<bool> = self.parts.iter().map(|part| !part.triangles.is_empty()).collect();
        self.makers.take().map(|makers| makers.shown(&shown))
    }

    /// Adds the drawing to `scene` at its origin: one mesh, unless it is empty, and what was placed. Fails if the run is
    /// stopped.
    pub fn show(self, scene: &mut Scene, name: &str, feature: Option<&str>) -> Result<()> {
        let parts = self.parts.into_iter().filter(|part| !part.triangles.is_empty());
        let parts =
            parts.map(|part| Part { material: scene.material(&self.materials[part.material]), ..part });
        let mesh = Mesh { name: name.to_owned(), parts: parts.collect(), ..Mesh::default() };
        let origin = DAffine3::from_translation(self.origin);
        if !mesh.parts.is_empty() {
            scene.meshes.push(mesh);
            scene.instances.push(Instance {
                mesh: scene.meshes.len() - 1,
                transform: origin,
                name: name.to_owned(),
                feature: feature.map(str::to_owned),
                origin: None,
                placement: None,
                meaning: None,
            });
        }
        let mut first = 0;
        for (model, meaning, frames) in &self.placed {
            let placed: Vec<DAffine3> = frames.iter().map(|frame| origin * *frame).collect();
            model.place(scene, &placed, first, name, feature, *meaning)?;
            first += frames.len();
        }
        Ok(())
    }
}
