//! Triangle meshes at export precision.

use glam::{DVec3, Vec2, Vec3};

use super::{Normal, Origin, SurfaceRuns, Triangles};
use burgeon_base::memory::make_room;

/// Shape: parts that share one coordinate system, one part for each material.
///
/// Vertices are f32, because every format and graphics card uses f32. Objects compute in f64 and place the mesh near
/// its own origin, so no precision is lost far from the world's origin.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Mesh {
    /// Display name; may repeat, may be empty.
    pub name: String,
    /// Chain whose object drew the mesh.
    pub origin: Option<Origin>,
    /// Parts, one for each material, in the order of first use; none is empty.
    pub parts: Vec<Part>,
}

/// Triangles of one material.
///
/// `positions`, `normals` and `uvs` have the same length. Triangles are counter-clockwise seen from outside.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Part {
    /// Index into the scene's materials.
    pub material: usize,
    /// Points (m).
    pub positions: Vec<Vec3>,
    /// Unit vectors.
    pub normals: Vec<Normal>,
    /// Texture coordinates in metres, u to the right and v upwards; an exporter divides by the texture's size.
    pub uvs: Vec<Vec2>,
    /// Second set of texture coordinates (m), for the dirt map of the material. Vertices beyond its end have those of `uvs`, so
    /// that it is empty unless an object gives a second set.
    pub second_uvs: Vec<Vec2>,
    /// Indices of corners.
    pub triangles: Triangles,
    /// Meanings of the surfaces that the triangles belong to, if an object specifies them.
    pub surfaces: SurfaceRuns,
}

impl Part {
    /// Removes all vertices and triangles but keeps their memory.
    pub fn clear(&mut self) {
        self.positions.clear();
        self.normals.clear();
        self.uvs.clear();
        self.second_uvs.clear();
        self.triangles.clear();
        self.surfaces.clear();
    }

    /// Removes all vertices from number `vertices` on, and all triangles from number `triangles` on.
    pub fn truncate(&mut self, vertices: usize, triangles: usize) {
        self.positions.truncate(vertices);
        self.normals.truncate(vertices);
        self.uvs.truncate(vertices);
        self.second_uvs.truncate(vertices);
        self.triangles.truncate(triangles);
        self.surfaces.truncate(triangles);
    }

    /// Reserves memory for more vertices and triangles, on huge pages if they are many.
    #[inline]
    pub fn make_room(&mut self, vertices: usize, triangles: usize) {
        make_room(&mut self.positions, vertices);
        make_room(&mut self.normals, vertices);
        make_room(&mut self.uvs, vertices);
        self.triangles.make_room(triangles);
    }

    /// Returns the second texture coordinates (m) of a vertex; zero if it does not exist.
    ///
    /// ```
    /// use burgeon_scene::Part;
    /// use glam::Vec2;
    ///
    /// let mut part = Part { uvs: vec![Vec2::X, Vec2::Y], ..Part::default() };
    /// part.second_uvs.push(Vec2::ONE);
    /// assert_eq!((part.second_uv(0), part.second_uv(1)), (Vec2::ONE, Vec2::Y));
    /// ```
    #[inline]
    pub fn second_uv(&self, vertex: usize) -> Vec2 {
        self.second_uvs.get(vertex).or_else(|| self.uvs.get(vertex)).copied().unwrap_or_default()
    }

    /// Gives all vertices second texture coordinates, as many as there are `uvs`.
    pub fn fill_second_uvs(&mut self) {
        let filled = self.second_uvs.len().min(self.uvs.len());
        self.second_uvs.extend_from_slice(&self.uvs[filled..]);
    }

    /// Adds the texture coordinates of another part, both sets.
    pub fn extend_uvs(&mut self, from: &Self) {
        if !from.second_uvs.is_empty() {
            self.fill_second_uvs();
            self.second_uvs.extend((0..from.uvs.len()).map(|vertex| from.second_uv(vertex)));
        }
        self.uvs.extend_from_slice(&from.uvs);
    }
}

impl Part {
    /// Returns a part with the triangles in these consecutive ranges and the vertices that they use.
    ///
    /// ```
    /// use burgeon_scene::{Normal, Part};
    /// use glam::{Vec2, Vec3};
    ///
    /// let mut part = Part { positions: [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::NEG_Y].to_vec(), ..Part::default() };
    /// (part.normals, part.uvs) = (vec![Normal::Z; 4], vec![Vec2::ZERO; 4]);
    /// part.triangles.push([0, 1, 2]);
    /// part.triangles.push([0, 3, 1]);
    /// let piece = part.piece([1..2]);
    /// assert_eq!(piece.positions, [Vec3::ZERO, Vec3::NEG_Y, Vec3::X]);
    /// ```
    #[must_use]
    pub fn piece(&self, ranges: impl IntoIterator<Item = std::ops::Range<usize>>) -> Self {
        let mut piece = Self { material: self.material, ..Self::default() };
        let mut numbers = rustc_hash::FxHashMap::<u32, u32>::default();
        for range in ranges {
            for index in range {
                let Some(corners) = self.triangles.get(index) else { continue };
                let meaning = self.surfaces.of(index);
                piece.surfaces.mark(piece.triangles.len(), meaning);
                let corners = corners.map(|corner| {
                    *numbers.entry(corner).or_insert_with(|| {
                        let from = corner as usize;
                        piece.positions.push(self.positions[from]);
                        piece.normals.push(self.normals[from]);
                        piece.uvs.push(self.uvs[from]);
                        if !self.second_uvs.is_empty() {
                            piece.second_uvs.push(self.second_uv(from));
                        }
                        u32::try_from(piece.positions.len() - 1).unwrap_or(u32::MAX)
                    })
                });
                piece.triangles.push(corners);
            }
        }
        piece
    }
}

impl Mesh {
    /// Returns the number of triangles of all parts.
    pub fn triangles(&self) -> usize {
        self.parts.iter().map(|part| part.triangles.len()).sum()
    }

    /// Returns the minimum and maximum corner (m) of the bounding box of all points; `None` if there are no points.
    ///
    /// ```
    /// use burgeon_scene::Mesh;
    /// use glam::{DVec3, Vec3};
    ///
    /// let mut mesh = Mesh::default();
    /// assert_eq!(mesh.bounds(), None);
    /// mesh.part(0).positions.push(Vec3::new(2.0, 0.0, 1.0));
    /// mesh.part(1).positions.push(Vec3::new(0.0, 3.0, 1.0));
    /// assert_eq!(mesh.bounds(), Some((DVec3::new(0.0, 0.0, 1.0), DVec3::new(2.0, 3.0, 1.0))));
    /// ```
    pub fn bounds(&self) -> Option<(DVec3, DVec3)> {
        let mut points = self.parts.iter().flat_map(|part| &part.positions);
        let first = *points.next()?;
        let (low, high) =
            points.fold((first, first), |(low, high), point| (low.min(*point), high.max(*point)));
        Some((low.as_dvec3(), high.as_dvec3()))
    }

    /// Returns the part for `material`, adding it at the end if it does not exist.
    pub fn part(&mut self, material: usize) -> &mut Part {
        let index = match self.parts.iter().position(|part| part.material == material) {
            Some(index) => index,
            None => {
                self.parts.push(Part { material, ..Part::default() });
                self.parts.len() - 1
            }
        };
        &mut self.parts[index]
    }
}
