//! Flat parts with few vertices, for a viewer that takes the normal of a whole triangle from its last corner.
//!
//! A box has 24 vertices if each vertex has the normal of one face, and about 9 if a corner of the box may be shared by
//! all faces. The data to transfer, and the work of a computer without a graphics card, is reduced to a third.

use super::super::check::triangles;
use super::coordinates::y_up;
use burgeon_scene::{Normal, Part};
use bytemuck::cast;
use glam::Vec3;

/// Placeholder for a missing vertex.
const NONE: u32 = u32::MAX;

/// Maximum number of positions in the cache. Vertices at the same position are mostly drawn soon after each other.
const PLACES: usize = 1 << 12;

/// Part whose triangles are flat.
pub(super) struct FlatPart {
    /// Positions in glTF's coordinates.
    pub(super) positions: Vec<Vec3>,
    /// For each vertex, the normal of the triangles whose last corner it is.
    pub(super) normals: Vec<Normal>,
    /// Shown triangles of the part, in their order; they may begin at another corner.
    pub(super) triangles: Vec<[u32; 3]>,
}

impl FlatPart {
    /// Welds `part` into few vertices with a greedy method. Returns `None` if a triangle is not flat.
    pub(super) fn of(part: &Part) -> Option<Self> {
        let normal = |corner: u32| part.normals[corner as usize];
        let is_flat = |[a, b, c]: [u32; 3]| normal(a) == normal(b) && normal(b) == normal(c);
        part.triangles.iter().all(is_flat).then(|| {
            let mut welding = PartWelder::new(part);
            let mut rest = triangles(part).peekable();
            while let Some(corners) = rest.next() {
                welding.add(corners, rest.peek().copied());
            }
            welding.made
        })
    }
}

/// State of a part during welding.
struct PartWelder<'a> {
    part: &'a Part,
    made: FlatPart,
    /// For each vertex, true if it has the normal of a triangle that ends with it.
    taken: Vec<bool>,
    /// New vertex of each vertex of the part.
    moved: Vec<u32>,
    /// Newest vertex for each hash of a position.
    known: Vec<u32>,
}

impl<'a> PartWelder<'a> {
    fn new(part: &'a Part) -> Self {
        let (vertices, room) = (part.positions.len(), part.positions.len() / 2);
        Self {
            part,
            made: FlatPart {
                positions: Vec::with_capacity(room),
                normals: Vec::with_capacity(room),
                triangles: Vec::with_capacity(part.triangles.len()),
            },
            taken: Vec::with_capacity(room),
            moved: vec![NONE; vertices],
            known: vec![NONE; vertices.next_power_of_two().min(PLACES)],
        }
    }

    /// Adds a triangle; `next` is the triangle after it.
    fn add(&mut self, corners: [u32; 3], next: Option<[u32; 3]>) {
        let normal = self.part.normals[corners[0] as usize];
        let mut ends = corners.map(|corner| self.vertex(corner));
        let has_normal = |end: &u32| self.taken[*end as usize] && self.made.normals[*end as usize] == normal;
        let last = ends.iter().position(has_normal).unwrap_or_else(|| {
            // Prefer a corner that the next triangle shares, since the other half of a quad can end at the same corner.
            let order = [2, 1, 0];
            let shared = |corner: &usize| next.is_some_and(|next| next.contains(&corners[*corner]));
            let free = |corner: &usize| !self.taken[ends[*corner] as usize];
            let best = order.into_iter().find(|corner| shared(corner) && free(corner));
            let best = best.or_else(|| order.into_iter().find(free));
            let last = best.or_else(|| order.into_iter().find(shared)).unwrap_or(2);
            if best.is_none() {
                ends[last] = self.push(self.made.positions[ends[last] as usize], normal);
                self.moved[corners[last] as usize] = ends[last];
            }
            self.taken[ends[last] as usize] = true;
            self.made.normals[ends[last] as usize] = normal;
            last
        });
        self.made.triangles.push([ends[(last + 1) % 3], ends[(last + 2) % 3], ends[last]]);
    }

    /// Returns the new vertex for a vertex of the part.
    fn vertex(&mut self, corner: u32) -> u32 {
        let index = corner as usize;
        if self.moved[index] == NONE {
            let at = y_up(self.part.positions[index]);
            let place = self.place(at);
            let known = self.known[place];
            if known == NONE || self.made.positions[known as usize] != at {
                self.known[place] = self.push(at, self.part.normals[index]);
            }
            self.moved[index] = self.known[place];
        }
        self.moved[index]
    }

    fn push(&mut self, at: Vec3, normal: Normal) -> u32 {
        self.made.positions.push(at);
        self.made.normals.push(normal);
        self.taken.push(false);
        (self.taken.len() - 1) as u32
    }

    /// Returns the cache slot of a vertex at `at`.
    fn place(&self, at: Vec3) -> usize {
        // The highest bits of the product depend on all bits of the coordinates.
        let mix = |sum: u64, bits: f32| {
            (sum ^ u64::from(cast::<f32, u32>(bits))).wrapping_mul(0x9E37_79B9_7F4A_7C15)
        };
        let sum = at.to_array().into_iter().fold(0, |sum: u64, bits| mix(sum.rotate_left(23), bits));
        (sum >> 40) as usize & (self.known.len() - 1)
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::samples;
    use super::*;

    #[test]
    fn a_box_keeps_its_faces_with_about_a_vertex_for_each_corner() {
        let scene = samples::boxes(1);
        let part = &scene.meshes[0].parts[0];
        let welded = FlatPart::of(part).unwrap();
        assert_eq!((part.positions.len(), welded.triangles.len()), (24, 12));
        assert!(welded.positions.len() <= 10, "{} vertices", welded.positions.len());
        for (given, made) in part.triangles.iter().zip(&welded.triangles) {
            assert_eq!(welded.normals[made[2] as usize], part.normals[given[0] as usize]);
            let places = made.map(|end| welded.positions[end as usize]);
            let turned = [0, 1, 2].map(|turn| {
                [0, 1, 2].map(|corner| y_up(part.positions[given[(corner + turn) % 3] as usize]))
            });
            assert!(turned.contains(&places), "{places:?} is none of {turned:?}");
        }
    }

    #[test]
    fn a_smooth_part_is_left_alone() {
        assert!(FlatPart::of(&samples::hill(3).meshes[0].parts[0]).is_none());
    }
}
