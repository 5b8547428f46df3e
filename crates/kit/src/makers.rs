//! Makers of a drawing's content: the chain symbols that drew it. Recorded only while a chain is traced.

/// Makers of a drawing's triangles and placed models. A maker is the index of a symbol in the chain.
#[derive(Debug, Clone, Default)]
pub struct Makers {
    present: u32,
    /// Runs of triangles for each part: the end index and the maker of each run.
    parts: Vec<Vec<(usize, u32)>>,
    /// Makers of the frames of each placed model.
    placed: Vec<Vec<u32>>,
}

impl Makers {
    /// Returns the symbol that draws at present.
    pub(super) fn present(&self) -> u32 {
        self.present
    }

    /// Sets `maker` as the symbol that draws from now on.
    pub(super) fn follow(&mut self, maker: u32) {
        self.present = maker;
    }

    /// Attributes the triangles of part `index` up to `count` that have no maker yet to `maker`.
    pub(super) fn settle(&mut self, index: usize, count: usize, maker: u32) {
        if self.parts.len() <= index {
            self.parts.resize(index + 1, Vec::new());
        }
        let runs = &mut self.parts[index];
        match runs.last_mut() {
            Some((end, _)) if count <= *end => {}
            Some((end, last)) if *last == maker => *end = count,
            None if count == 0 => {}
            _ => runs.push((count, maker)),
        }
    }

    /// Records another placement of the model at `index` by the present symbol.
    pub(super) fn place(&mut self, index: usize) {
        if self.placed.len() <= index {
            self.placed.resize(index + 1, Vec::new());
        }
        self.placed[index].push(self.present);
    }

    pub(super) fn clear(&mut self) {
        self.parts.clear();
        self.placed.clear();
    }

    /// Keeps only the parts that are set in `shown`.
    pub(super) fn shown(mut self, shown: &[bool]) -> Self {
        self.parts.resize(shown.len(), Vec::new());
        let mut shown = shown.iter();
        self.parts.retain(|_| shown.next().copied().unwrap_or(false));
        self
    }

    /// Returns the maker of a triangle of a part.
    pub fn of_triangle(&self, part: usize, triangle: usize) -> Option<usize> {
        let runs = self.parts.get(part)?;
        let run = runs.partition_point(|(end, _)| *end <= triangle);
        runs.get(run).map(|(_, maker)| *maker as usize)
    }

    /// Returns the maker of a placement; placements are numbered across all models.
    pub fn of_placement(&self, placement: usize) -> Option<usize> {
        self.placed.iter().flatten().nth(placement).map(|maker| *maker as usize)
    }

    /// Returns the runs of triangles whose maker satisfies `wanted`: part, first triangle and number of triangles.
    pub fn runs(&self, wanted: impl Fn(usize) -> bool) -> Vec<(usize, usize, usize)> {
        let mut found: Vec<(usize, usize, usize)> = Vec::new();
        for (part, runs) in self.parts.iter().enumerate() {
            let mut start = 0;
            for (end, maker) in runs {
                if wanted(*maker as usize) {
                    match found.last_mut() {
                        Some((last, first, count)) if *last == part && *first + *count == start => {
                            *count += end - start;
                        }
                        _ => found.push((part, start, end - start)),
                    }
                }
                start = *end;
            }
        }
        found
    }

    /// Returns all runs of triangles: part, range of triangles and maker.
    pub fn all_runs(&self) -> impl Iterator<Item = (usize, std::ops::Range<usize>, usize)> + '_ {
        self.parts.iter().enumerate().flat_map(|(part, runs)| {
            let mut start = 0;
            runs.iter().map(move |(end, maker)| {
                let range = start..*end;
                start = *end;
                (part, range, *maker as usize)
            })
        })
    }

    /// Returns the makers of all placements, in order.
    pub fn all_placements(&self) -> impl Iterator<Item = usize> + '_ {
        self.placed.iter().flatten().map(|maker| *maker as usize)
    }

    /// Returns the numbers of the placements whose maker satisfies `wanted`.
    pub fn placements(&self, wanted: impl Fn(usize) -> bool) -> Vec<usize> {
        let all = self.placed.iter().flatten().enumerate();
        all.filter(|(_, maker)| wanted(**maker as usize)).map(|(number, _)| number).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_triangle_has_the_maker_that_was_noted_for_it() {
        let mut makers = Makers::default();
        makers.follow(3);
        for (count, maker) in [(0, 3), (4, 3), (4, 9), (6, 5), (9, 5), (10, 3)] {
            makers.settle(1, count, maker);
        }
        let of: Vec<_> = (0..11).map(|triangle| makers.of_triangle(1, triangle)).collect();
        let expected = [[Some(3); 4].as_slice(), &[Some(5); 5], &[Some(3), None]].concat();
        assert_eq!(of, expected);
        assert_eq!(makers.of_triangle(0, 0), None);
        assert_eq!(makers.runs(|maker| maker == 3), [(1, 0, 4), (1, 9, 1)]);
        assert_eq!(makers.runs(|_| true), [(1, 0, 10)]);
        let shown = makers.shown(&[false, true]);
        assert_eq!(shown.of_triangle(0, 4), Some(5));
    }
}
