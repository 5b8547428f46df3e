//! Construction of meshes from faces with positions.

use glam::DVec3;
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use super::{PolygonFace, PolygonMesh};
use crate::style::SharedStyle;

/// Points, welded if they are equal to the last bit, and faces.
#[derive(Debug, Default)]
pub(crate) struct PolygonMeshBuilder {
    mesh: PolygonMesh,
    known: FxHashMap<[u64; 3], u32>,
}

impl PolygonMeshBuilder {
    /// Returns the number of a point (m).
    pub(crate) fn point(&mut self, at: DVec3) -> u32 {
        // Turns -0 into 0.
        let at = at + DVec3::ZERO;
        let points = &mut self.mesh.points;
        *self.known.entry(at.to_array().map(f64::to_bits)).or_insert_with(|| {
            points.push(at);
            u32::try_from(points.len() - 1).unwrap_or(u32::MAX)
        })
    }

    /// Adds a face; consecutive equal points count once, and rings with fewer than three points are dropped.
    pub(crate) fn face<'a>(&mut self, rings: impl IntoIterator<Item = &'a [DVec3]>, style: &SharedStyle) {
        let mut numbers: SmallVec<[Vec<u32>; 1]> = SmallVec::new();
        for (index, ring) in rings.into_iter().enumerate() {
            let mut ring: Vec<u32> = ring.iter().map(|at| self.point(*at)).collect();
            ring.dedup();
            while ring.len() > 1 && ring.first() == ring.last() {
                ring.pop();
            }
            if ring.len() > 2 {
                numbers.push(ring);
            } else if index == 0 {
                return;
            }
        }
        if !numbers.is_empty() {
            self.mesh.faces.push(PolygonFace { rings: numbers, style: style.clone() });
        }
    }

    /// Returns the mesh.
    pub(crate) fn build(self) -> PolygonMesh {
        self.mesh
    }
}
