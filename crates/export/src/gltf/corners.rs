//! Corners of a mesh's flat faces, each stored once.
//!
//! In the scene every face has separate vertices, because each has a normal, so adjacent faces repeat the same
//! positions. A glTF file without normals has flat faces ("glTF 2.0 Specification", 3.7.2.1), so a corner consists of
//! its position, and its texture coordinates if there are any. For a city with facades this leaves a third of the
//! vertices. The few faces of such parts whose normals differ from their planes are written separately, with normals.

use super::super::check::{proper_triangles, triangles};
use super::coordinates::{TexCoordMap, y_up};
use burgeon_base::locks::LockRecovery;
use burgeon_scene::{Normal, Part};
use bytemuck::cast;
use glam::Vec3;
use std::ops::Range;
use std::sync::{Arc, Mutex};

/// Placeholder for a missing corner.
const NONE: u32 = u32::MAX;

/// Maximum number of vertices of parts that are processed at a time; bounds the memory.
pub(super) const MOST: usize = 1 << 22;

/// Number of triangles whose corners are looked up together.
const TOGETHER: usize = 64;

/// Minimum thickness (m) of a triangle with a reliable normal. Thinner triangles are not visible.
const THIN: f64 = 1e-3;

/// Minimum cosine of the angle between a normal and the normal of its face (1 degree).
const FLAT: f64 = 0.999_85;

/// Selected faces of a part.
#[derive(Debug, Clone, Copy)]
pub(super) struct PartFaces<'a> {
    pub(super) part: &'a Part,
    /// Map of the part's texture coordinates, if it has any.
    pub(super) texture: Option<TexCoordMap>,
    pub(super) which: FaceChoice,
}

/// Selection of faces of a part.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FaceChoice {
    /// Every face; all of them are flat.
    All,
    /// Only flat faces.
    Flat,
    /// Only faces that are not flat.
    Shaded,
}

/// Corners of selected faces of some parts of a mesh.
pub(super) struct FaceCorners<'a> {
    /// Selected faces; faces with texture coordinates come first.
    faces: Vec<PartFaces<'a>>,
    textured: CornerRange,
    all: CornerRange,
    /// Computed corners while they are needed. The corners of a whole city would take too much memory.
    list: Mutex<Option<Arc<CornerList>>>,
}

/// Number of corners from the first one on, and their bounding box, in glTF's coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerRange {
    pub(super) count: usize,
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

/// Corners, and the mapping from the vertices of parts to corners.
#[derive(Default)]
pub(super) struct CornerList {
    /// Positions in glTF's coordinates.
    pub(super) positions: Vec<Vec3>,
    /// Texture coordinates of the first corners.
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// Normals, if the faces are shaded.
    pub(super) normals: Vec<Normal>,
    /// For each part, the corner of each of its vertices.
    pub(super) of: Vec<Vec<u32>>,
}

/// Counts the flat triangles of `part`.
pub(super) fn flat_faces(part: &Part) -> usize {
    triangles(part).filter(|corners| is_flat(part, *corners)).count()
}

/// Returns true if the normals of a triangle of `part` equal the normal of its plane.
fn is_flat(part: &Part, corners: [u32; 3]) -> bool {
    let [normal, other, third] = corners.map(|corner| part.normals[corner as usize]);
    if normal != other || normal != third {
        return false;
    }
    let [a, b, c] = corners.map(|corner| part.positions[corner as usize]);
    let (ab, ac) = (b - a, c - a);
    let across = ab.cross(ac).as_dvec3();
    let longest = ab.length_squared().max(ac.length_squared()).max((c - b).length_squared());
    // Squares instead of lengths, since this is asked of each triangle.
    let (along, area) = (across.dot(normal.vector().as_dvec3()), across.length_squared());
    (along >= 0.0 && along * along >= FLAT * FLAT * area) || area < THIN * THIN * f64::from(longest)
}

impl<'a> PartFaces<'a> {
    /// Returns the selected triangles within a range of the part's triangles.
    pub(super) fn triangles(self, places: Range<usize>) -> impl Iterator<Item = [u32; 3]> {
        let Self { part, which, .. } = self;
        proper_triangles(part.triangles.range(places)).filter(move |corners| match which {
            FaceChoice::All => true,
            FaceChoice::Flat => is_flat(part, *corners),
            FaceChoice::Shaded => !is_flat(part, *corners),
        })
    }
}

impl<'a> FaceCorners<'a> {
    /// Computes the corners of `faces`, in which faces with texture coordinates come first. All of them are shaded, or
    /// none is. The corners stay in memory until [`release`](Self::release).
    ///
    /// Returns `None` if there are more than `most` corners.
    pub(super) fn of(faces: Vec<PartFaces<'a>>, most: usize) -> Option<Self> {
        let list = CornerList::of(&faces, most)?;
        let range = |positions: &[Vec3]| CornerRange {
            count: positions.len(),
            low: positions.iter().fold(Vec3::INFINITY, |low, at| low.min(*at)),
            high: positions.iter().fold(Vec3::NEG_INFINITY, |high, at| high.max(*at)),
        };
        let textured = range(&list.positions[..list.tex_coords.len()]);
        let all = range(&list.positions);
        Some(Self { faces, textured, all, list: Mutex::new(Some(Arc::new(list))) })
    }

    /// Returns true if the corners have normals.
    pub(super) fn are_shaded(&self) -> bool {
        self.faces.iter().any(|faces| faces.which == FaceChoice::Shaded)
    }

    /// Returns the range of corners that a part refers to: the first ones if the part is `textured`, otherwise all.
    pub(super) fn range(&self, textured: bool) -> CornerRange {
        if textured { self.textured } else { self.all }
    }

    /// Returns true if all texture coordinates are multiples of 1/65535.
    pub(super) fn are_tex_coords_rounded(&self) -> bool {
        self.faces.iter().filter_map(|faces| faces.texture).all(|map| map.is_rounded)
    }

    /// Returns true if there are parts with texture coordinates (`textured`), or without.
    pub(super) fn has_parts(&self, textured: bool) -> bool {
        self.faces.iter().any(|faces| faces.texture.is_some() == textured)
    }

    /// Returns the faces of a part, by their index in the list given to [`of`](Self::of).
    pub(super) fn faces(&self, number: usize) -> PartFaces<'a> {
        self.faces[number]
    }

    /// Returns the corners, computing them if necessary.
    pub(super) fn list(&self) -> Arc<CornerList> {
        let mut list = self.list.lock().recover();
        let compute = || Arc::new(CornerList::of(&self.faces, usize::MAX).unwrap_or_default());
        Arc::clone(list.get_or_insert_with(compute))
    }

    /// Frees the memory of the corners.
    pub(super) fn release(&self) {
        self.list.lock().recover().take();
    }
}

impl CornerList {
    /// Computes the corners of the faces; `None` if there are more than `most`.
    fn of(all: &[PartFaces<'_>], most: usize) -> Option<Self> {
        let vertices: usize = all.iter().map(|faces| faces.part.positions.len()).sum();
        // Hash table of corners by position; at most two thirds of it are used.
        let mut places = vec![NONE; (vertices + vertices / 2 + 1).next_power_of_two()];
        let mut list = Self::default();
        for faces in all {
            let PartFaces { part, texture, which } = *faces;
            let mut of = vec![NONE; part.positions.len()];
            let mut triangles = faces.triangles(0..usize::MAX);
            let mut next: Vec<(usize, usize)> = Vec::with_capacity(3 * TOGETHER);
            loop {
                next.clear();
                for vertex in triangles.by_ref().take(TOGETHER).flatten().map(|corner| corner as usize) {
                    next.push((vertex, place_of(y_up(part.positions[vertex]), places.len())));
                }
                if next.is_empty() {
                    break;
                }
                list.load(&next, &places);
                for (vertex, place) in &next {
                    if of[*vertex] == NONE {
                        let uv = texture.map(|map| map.of(part.uvs[*vertex]));
                        let normal = (which == FaceChoice::Shaded).then(|| part.normals[*vertex]);
                        of[*vertex] =
                            list.corner((y_up(part.positions[*vertex]), *place), uv, normal, &mut places);
                    }
                }
                if list.positions.len() > most {
                    return None;
                }
            }
            list.of.push(of);
        }
        Some(list)
    }

    /// Reads the table at these places and the corners there, so that they are in the processor's cache. It waits for many
    /// of them at a time; the search for a corner waits for each.
    fn load(&self, next: &[(usize, usize)], places: &[u32]) {
        let mut known = [NONE; 3 * TOGETHER];
        for ((_, place), known) in next.iter().zip(&mut known) {
            *known = places[*place];
        }
        let read = |sum: f32, known: &u32| sum + self.positions.get(*known as usize).map_or(0.0, |at| at.x);
        std::hint::black_box(known.iter().fold(0.0, read));
    }

    /// Returns the corner at a position, whose first place in the table is given, with these texture coordinates, or with any
    /// if `None`, and with this normal. Adds the corner if it does not exist.
    #[inline]
    fn corner(
        &mut self,
        (at, mut place): (Vec3, usize),
        uv: Option<[f32; 2]>,
        normal: Option<Normal>,
        places: &mut [u32],
    ) -> u32 {
        while places[place] != NONE {
            let known = places[place] as usize;
            let alike = |uv: [f32; 2]| self.tex_coords[known].map(f32::to_bits) == uv.map(f32::to_bits);
            if self.positions[known] == at
                && uv.is_none_or(alike)
                && normal.is_none_or(|normal| self.normals[known] == normal)
            {
                return places[place];
            }
            place = (place + 1) & (places.len() - 1);
        }
        places[place] = self.positions.len() as u32;
        self.positions.push(at);
        self.tex_coords.extend(uv);
        self.normals.extend(normal);
        places[place]
    }
}

/// Returns the first place of a position in a table of this length, a power of two.
fn place_of(at: Vec3, length: usize) -> usize {
    // The highest bits of the product depend on all bits of the coordinates.
    let mix = |sum: u64, number: f32| {
        (sum.rotate_left(23) ^ u64::from(cast::<f32, u32>(number))).wrapping_mul(0x9E37_79B9_7F4A_7C15)
    };
    (at.to_array().into_iter().fold(0, mix) >> 32) as usize & (length - 1)
}

#[cfg(test)]
mod tests {
    use super::super::super::samples;
    use super::*;
    use burgeon_scene::Normal;
    use glam::Vec2;
    use proptest::prelude::*;

    fn faces(part: &Part, which: FaceChoice) -> PartFaces<'_> {
        PartFaces { part, texture: None, which }
    }

    #[test]
    fn a_box_has_eight_corners() {
        let scene = samples::boxes(1);
        let part = &scene.meshes[0].parts[0];
        assert_eq!((flat_faces(part), part.positions.len()), (12, 24));
        assert_eq!(FaceCorners::of(vec![faces(part, FaceChoice::All)], 8).unwrap().range(false).count, 8);
        assert!(FaceCorners::of(vec![faces(part, FaceChoice::All)], 7).is_none());
        assert_eq!(flat_faces(&samples::hill(3).meshes[0].parts[0]), 0);
    }

    #[test]
    fn a_face_that_is_shaded_otherwise_than_it_lies_keeps_its_normal() {
        let mut part = samples::boxes(1).meshes[0].parts[0].clone();
        for normal in &mut part.normals[..4] {
            *normal = Normal::from(normal.vector() + Vec3::splat(0.1));
        }
        assert_eq!(flat_faces(&part), 10);
        let (flat, shaded) = (faces(&part, FaceChoice::Flat), faces(&part, FaceChoice::Shaded));
        assert_eq!((flat.triangles(0..99).count(), shaded.triangles(0..99).count()), (10, 2));
        let corners = FaceCorners::of(vec![shaded], 9).unwrap();
        let list = corners.list();
        assert!(corners.are_shaded() && list.positions.len() == 4);
        assert!(list.normals.iter().all(|normal| *normal == part.normals[0]));
    }

    /// Generates a part with faces between the points of a small grid and texture coordinates that hardly differ.
    fn part() -> impl Strategy<Value = Part> {
        let corner = (prop::array::uniform3(0u8..3), prop::array::uniform2(0u8..2));
        prop::collection::vec(prop::array::uniform3(corner), 0..20).prop_map(|faces| {
            let mut part = Part::default();
            for (face, first) in faces.iter().zip((0u32..).step_by(3)) {
                for (at, uv) in face {
                    part.positions.push(Vec3::from(at.map(f32::from)));
                    part.normals.push(Normal::Z);
                    part.uvs.push(Vec2::from(uv.map(f32::from)));
                }
                part.triangles.push([first, first + 1, first + 2]);
            }
            part
        })
    }

    proptest! {
        #[test]
        fn each_corner_is_there_once_and_is_what_the_vertices_were(
            textured in prop::collection::vec(part(), 0..3), plain in prop::collection::vec(part(), 0..3)
        ) {
            let map = TexCoordMap::exact([2.0, 4.0]);
            let parts: Vec<_> = textured.iter().map(|part| (part, Some(map)))
                .chain(plain.iter().map(|part| (part, None))).collect();
            let which = FaceChoice::All;
            let corners = FaceCorners::of(parts.iter().map(|(part, texture)| {
                PartFaces { part, texture: *texture, which }
            }).collect(), usize::MAX).unwrap();
            let list = corners.list();
            prop_assert_eq!(corners.range(true).count, list.tex_coords.len());
            for ((part, texture), of) in parts.iter().zip(&list.of) {
                for (vertex, corner) in of.iter().enumerate() {
                    prop_assert_eq!(list.positions[*corner as usize], y_up(part.positions[vertex]));
                    if texture.is_some() {
                        prop_assert_eq!(list.tex_coords[*corner as usize], map.of(part.uvs[vertex]));
                    }
                }
            }
            let bits = |at: &Vec3| at.to_array().map(f32::to_bits);
            let places: Vec<_> = list.positions.iter().map(bits).collect();
            for (index, place) in places.iter().enumerate() {
                for (other, known) in places[..index].iter().enumerate() {
                    let same_uv = list.tex_coords.get(index).is_none_or(|uv| *uv == list.tex_coords[other]);
                    prop_assert!(known != place || !same_uv, "{place:?} is there twice");
                }
            }
        }
    }
}
