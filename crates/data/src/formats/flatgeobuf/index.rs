//! FlatGeobuf index: a tree of bounding boxes, down to those of the features.
//!
//! Source: the FlatGeobuf specification, "packed Hilbert R-tree".

use std::fs::File;
use std::io::{BufReader, Read, Result, Seek, SeekFrom};

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result as Checked};

/// Size of a box in the index (bytes).
pub(super) const ENTRY: u64 = 40;

/// Bounding box and its target.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BoxEntry {
    /// West, south, east and north.
    pub(super) bounds: [f64; 4],
    /// For a feature, its offset after the index; for an inner node, the index of its first child.
    pub(super) to: u64,
}

impl BoxEntry {
    pub(super) fn read(file: &mut impl Read) -> Result<Self> {
        let mut bytes = [0; 40];
        file.read_exact(&mut bytes)?;
        let (words, _) = bytes.as_chunks::<8>();
        let number = |at: usize| words.get(at).copied().unwrap_or_default();
        Ok(Self {
            bounds: [0, 1, 2, 3].map(|at| f64::from_le_bytes(number(at))),
            to: u64::from_le_bytes(number(4)),
        })
    }
}

/// Begin and end of each level of the index, as box indices: the root first, the features last.
pub(super) struct Levels(Vec<[u64; 2]>);

impl Levels {
    /// Computes the levels of an index of `count` features; `None` if the index is impossible.
    pub(super) fn new(count: u64, fan: u64) -> Option<Self> {
        if fan < 2 || count == 0 {
            return None;
        }
        let mut sizes = vec![count];
        let mut size = count;
        loop {
            size = size.div_ceil(fan);
            sizes.push(size);
            if size == 1 {
                break;
            }
        }
        let mut begin = 0_u64;
        let mut levels = Vec::new();
        for size in sizes.into_iter().rev() {
            let end = begin.checked_add(size)?;
            levels.push([begin, end]);
            begin = end;
        }
        Some(Self(levels))
    }

    /// Returns the number of boxes.
    fn count(&self) -> u64 {
        self.0.last().map_or(0, |[_, end]| *end)
    }

    /// Returns the size of the index (bytes); `None` if it is impossible.
    pub(super) fn size(&self) -> Option<u64> {
        self.count().checked_mul(ENTRY)
    }

    /// Returns the index of the first feature's box.
    pub(super) fn leaves(&self) -> u64 {
        self.0.last().map_or(0, |[begin, _]| *begin)
    }

    /// Returns the indices of the features whose boxes satisfy `touch`, and their offsets, in file order.
    pub(super) fn search(
        &self,
        file: &File,
        (at, fan): (u64, u64),
        touch: impl Fn([f64; 4]) -> bool,
        (budget, damaged): (&Budget, &dyn Fn(&str) -> Error),
    ) -> Checked<Vec<(u64, u64)>> {
        let cannot = |error: std::io::Error| damaged(&error.to_string());
        let mut file = BufReader::with_capacity(4096, file);
        let mut found = Vec::new();
        let mut stack = vec![(0, 0)];
        while let Some((level, first)) = stack.pop() {
            let Some([begin, end]) = self.0.get(level).copied() else { continue };
            if !(begin..end).contains(&first) {
                return Err(damaged("its index refers to missing data"));
            }
            budget.check()?;
            file.seek(SeekFrom::Start(at + first * ENTRY)).map_err(cannot)?;
            for number in first..end.min(first + fan) {
                let entry = BoxEntry::read(&mut file).map_err(cannot)?;
                if !touch(entry.bounds) {
                    continue;
                }
                budget.take(16)?;
                if level + 1 == self.0.len() {
                    found.push((number - begin, entry.to));
                } else {
                    stack.push((level + 1, entry.to));
                }
            }
            if found.len() as u64 > self.count() {
                return Err(damaged("its index refers repeatedly to the same features"));
            }
        }
        found.sort_unstable();
        found.dedup();
        Ok(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_as_large_as_the_format_says() {
        let levels = |count, fan| Levels::new(count, fan).map(|levels| levels.0);
        assert_eq!(levels(1, 16), Some(vec![[0, 1], [1, 2]]));
        assert_eq!(levels(17, 16), Some(vec![[0, 1], [1, 3], [3, 20]]));
        assert_eq!((levels(0, 16), levels(5, 0), levels(5, 1)), (None, None, None));
        assert_eq!(levels(u64::MAX, 2), None);
    }
}
