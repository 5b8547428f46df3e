//! The corners of a mesh's flat faces, each stored once.
//!
//! In the scene every face has vertices of its own, for the sake of its normal, and those of neighbours lie at the same
//! places. Where a glTF file gives no normals, faces are flat ("glTF 2.0 Specification", 3.7.2.1), so a corner is its
//! place, and its texture coordinates if there are any. Of a city with facades that is a third of what the faces have.

use super::super::check::triangles;
use super::body::{tex_coord, y_up};
use crate::scene::Part;
use bytemuck::cast;
use glam::Vec3;
use std::sync::{Arc, Mutex, PoisonError};

/// No corner.
const NONE: u32 = u32::MAX;

/// The most vertices of parts that are looked through at a time, which bounds the memory.
pub(super) const MOST: usize = 1 << 22;

/// Thinner triangles (m) have no normal that could be relied on, and are not seen.
const THIN: f32 = 1e-3;

/// The cosine of the angle (a degree) that a normal may be off its face.
const FLAT: f32 = 0.999_85;

/// The corners of some parts of a mesh whose triangles are all flat.
pub(super) struct Corners<'a> {
    /// The parts, and the width and height (m) of the textures of those that have texture coordinates, which come first.
    parts: Vec<(&'a Part, Option<[f64; 2]>)>,
    textured: CornerRange,
    all: CornerRange,
    /// They themselves, while they are needed: what a city has is too much to be kept.
    list: Mutex<Option<Arc<CornerList>>>,
}

/// How many corners there are from the first one on, and the box around them, in glTF's coordinates.
#[derive(Debug, Clone, Copy)]
pub(super) struct CornerRange {
    pub(super) count: usize,
    pub(super) low: Vec3,
    pub(super) high: Vec3,
}

/// Corners, and where those of the parts have come to.
#[derive(Default)]
pub(super) struct CornerList {
    /// In glTF's coordinates.
    pub(super) positions: Vec<Vec3>,
    /// Of the first ones.
    pub(super) tex_coords: Vec<[f32; 2]>,
    /// For each part, the corner that each of its vertices has become.
    pub(super) of: Vec<Vec<u32>>,
}

/// Whether all triangles of `part` are flat, and look where their corners say.
pub(super) fn is_flat(part: &Part) -> bool {
    triangles(part).all(|corners| {
        let [normal, b, c] = corners.map(|corner| part.normals[corner as usize]);
        normal == b && normal == c && {
            let [a, b, c] = corners.map(|corner| part.positions[corner as usize]);
            let (ab, ac) = (b - a, c - a);
            let across = ab.cross(ac);
            let area = across.length();
            let longest = ab.length_squared().max(ac.length_squared()).max((c - b).length_squared()).sqrt();
            across.dot(normal.vector()) >= FLAT * area || area < THIN * longest
        }
    })
}

impl<'a> Corners<'a> {
    /// Those of `parts`, of which those with texture coordinates come first.
    pub(super) fn of(parts: Vec<(&'a Part, Option<[f64; 2]>)>) -> Self {
        let list = CornerList::of(&parts);
        let range = |positions: &[Vec3]| CornerRange {
            count: positions.len(),
            low: positions.iter().fold(Vec3::INFINITY, |low, at| low.min(*at)),
            high: positions.iter().fold(Vec3::NEG_INFINITY, |high, at| high.max(*at)),
        };
        let textured = range(&list.positions[..list.tex_coords.len()]);
        Self { parts, textured, all: range(&list.positions), list: Mutex::default() }
    }

    /// Those that a part refers to: one with texture coordinates to the first ones, the others to all.
    pub(super) fn range(&self, textured: bool) -> CornerRange {
        if textured { self.textured } else { self.all }
    }

    /// Whether there are parts with texture coordinates, or without.
    pub(super) fn has_parts(&self, textured: bool) -> bool {
        self.parts.iter().any(|(_, texture)| texture.is_some() == textured)
    }

    /// A part, by its number among those that were given.
    pub(super) fn part(&self, number: usize) -> &'a Part {
        self.parts[number].0
    }

    /// They themselves.
    pub(super) fn list(&self) -> Arc<CornerList> {
        let mut list = self.list.lock().unwrap_or_else(PoisonError::into_inner);
        Arc::clone(list.get_or_insert_with(|| Arc::new(CornerList::of(&self.parts))))
    }

    /// Gives up the memory that they take.
    pub(super) fn release(&self) {
        self.list.lock().unwrap_or_else(PoisonError::into_inner).take();
    }
}

impl CornerList {
    fn of(parts: &[(&Part, Option<[f64; 2]>)]) -> Self {
        let vertices: usize = parts.iter().map(|(part, _)| part.positions.len()).sum();
        // Corners by place; at most two thirds of it are taken.
        let mut places = vec![NONE; (vertices + vertices / 2 + 1).next_power_of_two()];
        let mut list = Self::default();
        for (part, texture) in parts {
            let mut of = vec![NONE; part.positions.len()];
            for corner in triangles(part).flatten() {
                let vertex = corner as usize;
                if of[vertex] == NONE {
                    let uv = texture.map(|size| tex_coord(part.uvs[vertex], size));
                    of[vertex] = list.corner(y_up(part.positions[vertex]), uv, &mut places);
                }
            }
            list.of.push(of);
        }
        list
    }

    /// The corner at `at` with these texture coordinates, or with any; added if there is none.
    #[inline]
    fn corner(&mut self, at: Vec3, uv: Option<[f32; 2]>, places: &mut [u32]) -> u32 {
        // The highest bits of the product depend on all bits of the coordinates.
        let mix = |sum: u64, number: f32| {
            (sum.rotate_left(23) ^ u64::from(cast::<f32, u32>(number))).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        };
        let mut place = (at.to_array().into_iter().fold(0, mix) >> 32) as usize & (places.len() - 1);
        while places[place] != NONE {
            let known = places[place] as usize;
            let alike = |uv: [f32; 2]| self.tex_coords[known].map(f32::to_bits) == uv.map(f32::to_bits);
            if self.positions[known] == at && uv.is_none_or(alike) {
                return places[place];
            }
            place = (place + 1) & (places.len() - 1);
        }
        places[place] = self.positions.len() as u32;
        self.positions.push(at);
        self.tex_coords.extend(uv);
        places[place]
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::samples;
    use super::*;
    use crate::scene::Normal;
    use glam::Vec2;
    use proptest::prelude::*;

    #[test]
    fn a_box_has_eight_corners() {
        let scene = samples::boxes(1);
        let part = &scene.meshes[0].parts[0];
        assert!(is_flat(part) && part.positions.len() == 24);
        assert_eq!(Corners::of(vec![(part, None)]).range(false).count, 8);
        assert!(!is_flat(&samples::hill(3).meshes[0].parts[0]));
    }

    #[test]
    fn a_face_whose_normal_says_otherwise_is_not_flat() {
        let mut part = samples::boxes(1).meshes[0].parts[0].clone();
        for normal in &mut part.normals[..4] {
            *normal = Normal::from(normal.vector() + Vec3::splat(0.1));
        }
        assert!(!is_flat(&part));
    }

    /// A part of faces between the points of a small grid, with texture coordinates that hardly differ.
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
            let size = [2.0, 4.0];
            let parts: Vec<_> = textured.iter().map(|part| (part, Some(size)))
                .chain(plain.iter().map(|part| (part, None))).collect();
            let corners = Corners::of(parts.clone());
            let list = corners.list();
            prop_assert_eq!(corners.range(true).count, list.tex_coords.len());
            for ((part, texture), of) in parts.iter().zip(&list.of) {
                for (vertex, corner) in of.iter().enumerate() {
                    prop_assert_eq!(list.positions[*corner as usize], y_up(part.positions[vertex]));
                    if texture.is_some() {
                        prop_assert_eq!(list.tex_coords[*corner as usize], tex_coord(part.uvs[vertex], size));
                    }
                }
            }
            let bits = |at: &Vec3| at.to_array().map(f32::to_bits);
            let places: Vec<_> = list.positions.iter().map(bits).collect();
            for (index, place) in places.iter().enumerate() {
                for other in 0..index {
                    let same_uv = list.tex_coords.get(index).is_none_or(|uv| *uv == list.tex_coords[other]);
                    prop_assert!(places[other] != *place || !same_uv, "{place:?} is there twice");
                }
            }
        }
    }
}
