//! Connected pieces of shapes.

use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, Stop};
use rustc_hash::FxHashMap;

use crate::mesh::FaceSets;
use crate::{Shape, ShapeBody};

impl Shape {
    /// Returns the connected pieces in the order of their first face; faces are connected by a common edge.
    pub fn pieces(&self) -> Result<Vec<Self>> {
        let ShapeBody::Mesh(mesh) = &self.body else { return Ok(vec![self.clone()]) };
        let mut sets = FaceSets::new(mesh.faces.len());
        let mut owners: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        for (number, face) in mesh.faces.iter().enumerate() {
            for [from, to] in face.edges() {
                sets.join(number, *owners.entry([from.min(to), from.max(to)]).or_insert(number));
            }
        }
        let groups = sets.groups();
        if groups.len() < 2 {
            return Ok(vec![self.clone()]);
        }
        MemoryOwner::ensure_room(mesh.memory())?;
        let mut pieces = Vec::with_capacity(groups.len());
        for group in groups {
            Stop::check_current()?;
            pieces.push(Self::of_mesh(mesh.select(group), self.scope().axes).with_trim_of(self));
        }
        Ok(pieces)
    }
}
