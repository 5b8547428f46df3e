//! Connected pieces of shapes.

use rustc_hash::FxHashMap;

use crate::{Shape, ShapeBody};

impl Shape {
    /// Returns the connected pieces in the order of their first face; faces are connected by a common edge.
    pub fn pieces(&self) -> Vec<Self> {
        let ShapeBody::Mesh(mesh) = &self.body else { return vec![self.clone()] };
        let mut parents: Vec<usize> = (0..mesh.faces.len()).collect();
        let mut owners: FxHashMap<[u32; 2], usize> = FxHashMap::default();
        for (number, face) in mesh.faces.iter().enumerate() {
            for [from, to] in face.edges() {
                let other = *owners.entry([from.min(to), from.max(to)]).or_insert(number);
                let (a, b) = (root(&mut parents, number), root(&mut parents, other));
                parents[a.max(b)] = a.min(b);
            }
        }
        let mut order: Vec<usize> = Vec::new();
        let mut members: FxHashMap<usize, Vec<usize>> = FxHashMap::default();
        for number in 0..mesh.faces.len() {
            let first = root(&mut parents, number);
            let list = members.entry(first).or_default();
            if list.is_empty() {
                order.push(first);
            }
            list.push(number);
        }
        if order.len() < 2 {
            return vec![self.clone()];
        }
        let piece = |first: usize| {
            let faces = members.get(&first).map(Vec::as_slice).unwrap_or_default();
            Self::of_mesh(mesh.selected(faces.iter().copied()), self.scope.axes)
        };
        order.into_iter().map(piece).collect()
    }
}

/// Returns the representative of a set, and shortens the path to it.
fn root(parents: &mut [usize], mut at: usize) -> usize {
    while parents[at] != at {
        parents[at] = parents[parents[at]];
        at = parents[at];
    }
    at
}
