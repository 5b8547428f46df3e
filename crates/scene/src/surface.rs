//! Meanings of surfaces, for formats that distinguish walls from roofs.

use std::ops::Range;

/// Meaning of a surface of a building.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum SurfaceMeaning {
    /// Bottom of the building.
    Ground,
    /// Side of the building, including gables and plinths.
    Wall,
    /// Roof, including eaves and undersides.
    Roof,
    /// Window.
    Window,
    /// Door.
    Door,
}

/// Meanings of the triangles of a part, run-length encoded; unknown before the first entry.
///
/// It is empty unless an object specifies meanings, and has one entry for each change instead of each triangle.
///
/// ```
/// use burgeon_scene::{SurfaceMeaning, SurfaceRuns};
///
/// let mut runs = SurfaceRuns::default();
/// runs.mark(2, Some(SurfaceMeaning::Wall));
/// runs.mark(6, Some(SurfaceMeaning::Roof));
/// assert_eq!((runs.of(1), runs.of(2)), (None, Some(SurfaceMeaning::Wall)));
/// assert_eq!(runs.stretches(8).map(|(range, _)| range).collect::<Vec<_>>(), [0..2, 2..6, 6..8]);
/// ```
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct SurfaceRuns(Vec<(usize, Option<SurfaceMeaning>)>);

impl SurfaceRuns {
    /// Sets the meaning of all triangles from number `first` on, which must not decrease between calls.
    #[inline]
    pub fn mark(&mut self, first: usize, meaning: Option<SurfaceMeaning>) {
        if self.0.last().and_then(|(_, known)| *known) == meaning {
            return;
        }
        match self.0.last_mut() {
            Some((known, last)) if *known == first => *last = meaning,
            _ => self.0.push((first, meaning)),
        }
    }

    /// Returns true if no triangle has a meaning.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Removes the meanings of all triangles from number `count` on.
    pub fn truncate(&mut self, count: usize) {
        self.0.truncate(self.0.partition_point(|(first, _)| *first < count));
    }

    /// Removes all meanings.
    pub fn clear(&mut self) {
        self.0.clear();
    }

    /// Returns the meaning of triangle number `index`, if known.
    pub fn of(&self, index: usize) -> Option<SurfaceMeaning> {
        let behind = self.0.partition_point(|(first, _)| *first <= index);
        self.0[..behind].last().and_then(|(_, meaning)| *meaning)
    }

    /// Divides a number of `triangles` into ranges with the same meaning.
    pub fn stretches(
        &self,
        triangles: usize,
    ) -> impl Iterator<Item = (Range<usize>, Option<SurfaceMeaning>)> {
        let before = self.0.first().map_or(triangles, |(first, _)| *first).min(triangles);
        let ends = self.0.iter().skip(1).map(|(first, _)| *first).chain([triangles]);
        let known = self
            .0
            .iter()
            .zip(ends)
            .map(move |((first, meaning), end)| ((*first).min(triangles)..end.min(triangles), *meaning));
        std::iter::once((0..before, None)).chain(known).filter(|(range, _)| !range.is_empty())
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn meaning() -> impl Strategy<Value = Option<SurfaceMeaning>> {
        use SurfaceMeaning::{Door, Roof, Wall};
        prop::sample::select(vec![None, Some(Wall), Some(Roof), Some(Door)])
    }

    proptest! {
        #[test]
        fn each_triangle_is_what_it_was_marked_last(marks in prop::collection::vec((0usize..4, meaning()), 0..12)) {
            let (mut runs, mut plain) = (SurfaceRuns::default(), Vec::new());
            for (more, meaning) in &marks {
                runs.mark(plain.len(), *meaning);
                plain.extend(std::iter::repeat_n(*meaning, *more));
            }
            for (index, meaning) in plain.iter().enumerate() {
                prop_assert_eq!(runs.of(index), *meaning);
            }
            let told: Vec<_> = runs.stretches(plain.len()).flat_map(|(range, meaning)| range.map(move |_| meaning)).collect();
            prop_assert_eq!(told, plain);
        }
    }
}
