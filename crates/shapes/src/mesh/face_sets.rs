//! Sets of faces that are joined pair by pair.

/// Disjoint sets of the faces of a mesh; the first face of a set represents it.
#[derive(Debug)]
pub(crate) struct FaceSets(Vec<usize>);

impl FaceSets {
    /// Creates a set for each of `count` faces.
    pub(crate) fn new(count: usize) -> Self {
        Self((0..count).collect())
    }

    /// Joins the sets of two faces.
    pub(crate) fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.first(one), self.first(other));
        self.0[one.max(other)] = one.min(other);
    }

    /// Returns the first face of the set of a face.
    pub(crate) fn first(&mut self, mut face: usize) -> usize {
        while self.0[face] != face {
            self.0[face] = self.0[self.0[face]];
            face = self.0[face];
        }
        face
    }

    /// Returns the faces of each set, in the order of their first faces.
    pub(crate) fn groups(mut self) -> Vec<Vec<usize>> {
        let mut groups: Vec<Vec<usize>> = vec![Vec::new(); self.0.len()];
        (0..self.0.len()).for_each(|face| groups[self.first(face)].push(face));
        groups.retain(|group| !group.is_empty());
        groups
    }
}
