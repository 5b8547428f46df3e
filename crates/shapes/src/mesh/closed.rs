//! Open edges of meshes.

use rustc_hash::FxHashMap;

use super::PolygonMesh;

/// Directed edges, of which opposite ones cancel each other, in the order of their first use.
#[derive(Debug, Default)]
pub(crate) struct EdgeSums {
    numbers: FxHashMap<[u32; 2], usize>,
    sums: Vec<([u32; 2], i32)>,
}

impl EdgeSums {
    /// Adds an edge.
    pub(crate) fn add(&mut self, [from, to]: [u32; 2]) {
        if from == to {
            return;
        }
        let (key, sign) = if from < to { ([from, to], 1) } else { ([to, from], -1) };
        let number = *self.numbers.entry(key).or_insert(self.sums.len());
        match self.sums.get_mut(number) {
            Some((_, sum)) => *sum += sign,
            None => self.sums.push((key, sign)),
        }
    }

    /// Returns the edges that nothing cancels, in their direction, as often as they remain.
    pub(crate) fn rest(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.sums.iter().flat_map(|&([from, to], sum)| {
            let edge = if sum > 0 { [from, to] } else { [to, from] };
            std::iter::repeat_n(edge, sum.unsigned_abs() as usize)
        })
    }
}

impl PolygonMesh {
    /// Returns true if every edge has the same number of faces in both directions.
    pub fn is_closed(&self) -> bool {
        *self.closed.get_or_init(|| !self.faces.is_empty() && self.open_edges().next().is_none())
    }

    /// Returns the edges that have a face on one side only, as their ends.
    pub fn open_edges(&self) -> impl Iterator<Item = [u32; 2]> {
        let mut sums = EdgeSums::default();
        self.faces.iter().flat_map(|face| face.edges()).for_each(|edge| sums.add(edge));
        sums.rest().collect::<Vec<_>>().into_iter()
    }
}
