//! Content of a drawing object: faces by material, placed models, and the modules that made them.

use std::sync::{Arc, OnceLock};

use glam::{DAffine3, DVec3};

use crate::Model;
use crate::distance::Nearest;
use crate::makers::Makers;
use burgeon_base::error::Result;
use burgeon_scene::{Instance, Material, Mesh, Normal, Part, Scene, SurfaceMeaning};

/// Faces that an object has drawn, by material, and models that it has placed.
///
/// ```
/// use burgeon_kit::Drawing;
/// use burgeon_scene::{Material, Normal};
/// use glam::{DVec3, Vec2, Vec3};
///
/// let mut drawing = Drawing::default();
/// let plaster = drawing.material(&Material::default());
/// let part = drawing.part(plaster);
/// part.positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
/// (part.normals, part.uvs) = (vec![Normal::Z; 3], vec![Vec2::ZERO; 3]);
/// part.triangles.push([0, 1, 2]);
/// assert_eq!(drawing.distance(DVec3::new(0.2, 0.2, 4.0)), 4.0);
/// drawing.clear();
/// assert_eq!(drawing.distance(DVec3::ZERO), f64::INFINITY);
/// ```
#[derive(Clone, Default)]
pub struct Drawing {
    /// Position in the scene (m).
    origin: DVec3,
    materials: Vec<Arc<Material>>,
    /// Materials and colours of the last requests, and the indices of their parts: a few that alternate.
    recent: Vec<(Arc<Material>, Option<[f32; 4]>, usize)>,
    parts: Vec<Part>,
    /// Placed models with their surface meaning and frames. Each pair of model and meaning occurs once.
    placed: Vec<(Arc<Model>, Option<SurfaceMeaning>, Vec<DAffine3>)>,
    /// Number of instances of the placed models.
    instances: usize,
    /// Set if [`Drawing::clear`] keeps the content.
    kept: bool,
    /// Number of triangles that unfinished content will certainly add.
    expected: usize,
    /// Emptied parts for reuse: allocating fresh pages costs more time than drawing.
    spare: Vec<Part>,
    makers: Option<Makers>,
    /// Spatial index of the triangles, built by the first query and dropped by the next change.
    nearest: OnceLock<Arc<Nearest>>,
}

/// Size of the content of a [`Drawing`] at a moment.
#[derive(Debug, Clone)]
pub struct DrawingMark {
    /// Numbers of vertices and triangles of each part.
    parts: Vec<(usize, usize)>,
    /// Number of instances of each placed model.
    placed: Vec<usize>,
    instances: usize,
    expected: usize,
}

/// Maximum number of materials and colours that a drawing finds without a comparison of materials.
const MOST_RECENT: usize = 8;

impl Drawing {
    /// Creates an empty drawing whose origin is at `origin` (m).
    pub fn at(origin: DVec3) -> Self {
        Self { origin, ..Self::default() }
    }

    /// Returns the position of the origin in the scene (m).
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// Sets whether [`Drawing::clear`] keeps the content, and returns the previous setting. A drawing that several
    /// objects share must be cleared only once.
    pub fn keep(&mut self, kept: bool) -> bool {
        std::mem::replace(&mut self.kept, kept)
    }

    /// Removes all faces and models.
    pub fn clear(&mut self) {
        if self.kept {
            return;
        }
        self.nearest.take();
        self.materials.clear();
        self.recent.clear();
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

    /// Returns the size of the present content, for [`Drawing::rewind`].
    pub fn mark(&self) -> DrawingMark {
        DrawingMark {
            parts: self.parts.iter().map(|part| (part.positions.len(), part.triangles.len())).collect(),
            placed: self.placed.iter().map(|(_, _, frames)| frames.len()).collect(),
            instances: self.instances,
            expected: self.expected,
        }
    }

    /// Removes the content that was added since [`Drawing::mark`] returned `mark`. The drawing must not have been cleared
    /// since, and must not be traced.
    pub fn rewind(&mut self, mark: &DrawingMark) {
        self.nearest.take();
        self.materials.truncate(mark.parts.len());
        self.recent.clear();
        for mut part in self.parts.drain(mark.parts.len()..).rev() {
            part.clear();
            self.spare.push(part);
        }
        for (part, (vertices, triangles)) in self.parts.iter_mut().zip(&mark.parts) {
            part.truncate(*vertices, *triangles);
        }
        self.placed.truncate(mark.placed.len());
        for ((_, _, frames), count) in self.placed.iter_mut().zip(&mark.placed) {
            frames.truncate(*count);
        }
        (self.instances, self.expected) = (mark.instances, mark.expected);
    }

    /// Returns the index of the part with this material, and adds the part if it is missing.
    pub fn material(&mut self, material: &Material) -> usize {
        match self.find_material(material) {
            Some(index) => index,
            None => self.add_material(Arc::new(material.clone())),
        }
    }

    /// Returns the index of the part with this material, if there is one.
    fn find_material(&self, material: &Material) -> Option<usize> {
        // Most materials differ in colour, which is the fastest comparison.
        let same = |known: &Arc<Material>| known.base_color == material.base_color && **known == *material;
        self.materials.iter().position(same)
    }

    /// Adds a part with this material, and returns its index.
    fn add_material(&mut self, material: Arc<Material>) -> usize {
        self.materials.push(material);
        let spare = self.spare.pop().unwrap_or_default();
        self.parts.push(Part { material: self.materials.len() - 1, ..spare });
        self.materials.len() - 1
    }

    /// Returns the index of the part with this material, in another colour if one is given, and adds the part if it is missing.
    /// Faster than [`material`](Self::material) for the same few materials again and again.
    pub fn part_of(&mut self, material: &Arc<Material>, color: Option<[f32; 4]>) -> usize {
        let same =
            |(known, own, _): &&(Arc<Material>, _, usize)| Arc::ptr_eq(known, material) && *own == color;
        if let Some((_, _, index)) = self.recent.iter().find(same) {
            return *index;
        }
        let index = match color {
            Some(color) => self.material_in_color(material, color),
            None => self.find_material(material).unwrap_or_else(|| self.add_material(Arc::clone(material))),
        };
        if self.recent.len() == MOST_RECENT {
            self.recent.clear();
        }
        self.recent.push((Arc::clone(material), color, index));
        index
    }

    /// Returns the index of the part with this material in another colour, and adds the part if it is missing.
    pub fn material_in_color(&mut self, material: &Material, color: [f32; 4]) -> usize {
        let is_wanted = |known: &Arc<Material>| {
            let Material {
                name,
                base_color,
                metallic,
                roughness,
                emissive,
                texture,
                normal_map,
                dirt_map,
                double_sided,
            } = &**known;
            *base_color == color
                && *metallic == material.metallic
                && *roughness == material.roughness
                && *emissive == material.emissive
                && *double_sided == material.double_sided
                && *name == material.name
                && *texture == material.texture
                && *normal_map == material.normal_map
                && *dirt_map == material.dirt_map
        };
        match self.materials.iter().position(is_wanted) {
            Some(index) => index,
            None => self.material(&Material { base_color: color, ..material.clone() }),
        }
    }

    /// Returns the material of the part at `index`; the default material if there is no such part.
    pub fn material_of(&self, index: usize) -> Arc<Material> {
        self.materials.get(index).cloned().unwrap_or_default()
    }

    /// Returns the part at `index`, an index from [`Drawing::material`].
    #[inline]
    pub fn part(&mut self, index: usize) -> &mut Part {
        self.nearest.take();
        &mut self.parts[index]
    }

    /// Returns the part at `index`, and marks the faces that are added to it next as a surface with this meaning.
    #[inline]
    pub fn surface(&mut self, index: usize, meaning: SurfaceMeaning) -> &mut Part {
        let part = self.part(index);
        part.surfaces.mark(part.triangles.len(), Some(meaning));
        part
    }

    /// Returns the parts, in the order of the first use of their materials.
    pub fn parts(&self) -> &[Part] {
        &self.parts
    }

    /// Returns the distance (m) from `place` to the nearest point of the faces; infinite without faces. Ignores placed
    /// models.
    pub fn distance(&self, place: DVec3) -> f64 {
        self.nearest.get_or_init(|| Arc::new(Nearest::new(&self.parts))).distance(place)
    }

    /// Places `model` at `frame`. Repeated models share one mesh with many instances.
    pub fn place(&mut self, model: &Arc<Model>, frame: DAffine3) {
        self.place_as(model, frame, None);
    }

    /// Places `model` at `frame`; `meaning` is the surface meaning of the whole model, if known.
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

    /// Copies the faces of `model` at `frame` into this drawing. `meaning`, if any, replaces the surface meaning of all
    /// faces.
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
                into.extend_uvs(part);
                into.triangles.extend(part.triangles.iter().map(|corners| {
                    let [a, b, c] = corners.map(|corner| corner + base);
                    if mirrored { [a, c, b] } else { [a, b, c] }
                }));
            }
        }
    }

    /// Returns the number of triangles, including expected triangles. An instance counts as one.
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum::<usize>() + self.instances + self.expected
    }

    /// Sets the number of triangles that unfinished content will add. It replaces the previous number, and counts in
    /// [`Drawing::triangles`].
    pub fn expect(&mut self, triangles: usize) {
        self.expected = triangles;
    }

    /// Returns the number of triangles of the part at `index`.
    pub fn triangles_of(&self, index: usize) -> usize {
        self.parts.get(index).map_or(0, |part| part.triangles.len())
    }

    /// Returns the chain symbol that draws at present; 0 if chains are not traced.
    #[inline]
    pub fn maker(&self) -> u32 {
        self.makers.as_ref().map_or(0, Makers::present)
    }

    /// Draws into part `index` and attributes the new triangles to the symbol `maker`, which may be an earlier one than
    /// the present symbol.
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

    /// Attributes the triangles of part `index` up to `count` that have no maker yet to `maker`.
    pub fn made(&mut self, maker: u32, index: usize, count: usize) {
        if let Some(makers) = &mut self.makers {
            makers.settle(index, count, maker);
        }
    }

    /// Starts or continues tracing: attributes triangles drawn from now on to the chain symbol `maker`.
    pub fn trace(&mut self, maker: u32) {
        let makers = self.makers.get_or_insert_default();
        for (index, part) in self.parts.iter().enumerate() {
            makers.settle(index, part.triangles.len(), makers.present());
        }
        makers.follow(maker);
    }

    /// Ends tracing, and returns the symbols that made the triangles of each part that has some, and the placed models
    /// in their order. `None` if nothing was traced.
    pub fn take_makers(&mut self) -> Option<Makers> {
        self.trace(0);
        let shown: Vec<bool> = self.parts.iter().map(|part| !part.triangles.is_empty()).collect();
        self.makers.take().map(|makers| makers.shown(&shown))
    }

    /// Adds the drawing to `scene` at its origin: one mesh, unless it is empty, and the placed models. Fails if the run
    /// is cancelled.
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
