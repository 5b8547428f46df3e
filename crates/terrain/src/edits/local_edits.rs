//! Terrain edits of a part of the ground, with a spatial index.

use glam::DVec2;

use super::edit::Edit;

/// Edits in order, with the squares that they affect.
#[derive(Debug, Clone, Default)]
pub(crate) struct LocalEdits {
    edits: Vec<LocalEdit>,
    low: DVec2,
    /// Side lengths (m) of a square, and the number of squares per side of the part.
    step: DVec2,
    across: usize,
    /// Edits that affect each square, row by row from the south.
    squares: Vec<Vec<NearEdit>>,
}

/// Edit that affects a square.
#[derive(Debug, Clone)]
struct NearEdit {
    /// Index of the edit.
    edit: u32,
    /// First segment of its path whose extent meets the square, and the end of the last one.
    segments: [u32; 2],
}

#[derive(Debug, Clone)]
struct LocalEdit {
    edit: Edit,
    bounds: (DVec2, DVec2),
}

/// Maximum number of squares per side.
const MOST_ACROSS: usize = 128;

impl LocalEdits {
    /// Creates an index of `edits` for the box from `low` to `high` (m).
    pub(crate) fn new(edits: impl IntoIterator<Item = Edit>, low: DVec2, high: DVec2) -> Self {
        let edits: Vec<LocalEdit> =
            edits.into_iter().map(|edit| LocalEdit { bounds: edit.bounds(), edit }).collect();
        if edits.is_empty() {
            return Self::default();
        }
        let extents: Vec<Vec<(DVec2, DVec2)>> = edits.iter().map(|local| local.edit.extents()).collect();
        let count: usize = extents.iter().map(Vec::len).sum();
        let across = count.isqrt().clamp(1, MOST_ACROSS);
        #[allow(clippy::cast_precision_loss, reason = "few squares")]
        let step = ((high - low) / across as f64).max(DVec2::splat(1e-9));
        let mut squares: Vec<Vec<NearEdit>> = vec![Vec::new(); across * across];
        let mut local = Self { edits: Vec::new(), low, step, across, squares: Vec::new() };
        for (edit, extents) in (0..).zip(&extents) {
            for (segment, (from, to)) in (0..).zip(extents) {
                let ([west, south], [east, north]) = (local.square(*from), local.square(*to));
                for square in (south..=north).flat_map(|row| row * across + west..=row * across + east) {
                    match squares[square].last_mut() {
                        Some(near) if near.edit == edit => near.segments[1] = segment + 1,
                        _ => squares[square].push(NearEdit { edit, segments: [segment, segment + 1] }),
                    }
                }
            }
        }
        (local.edits, local.squares) = (edits, squares);
        local
    }

    /// Returns true if there are no edits.
    pub(crate) fn is_empty(&self) -> bool {
        self.edits.is_empty()
    }

    /// Returns the new height (m) of a point, given the previous height (m).
    pub(crate) fn at(&self, place: DVec2, height: f64) -> f64 {
        if self.squares.is_empty() {
            return height;
        }
        let [column, row] = self.square(place);
        self.squares[row * self.across + column].iter().fold(height, |height, near| {
            let LocalEdit { edit, bounds: (from, to) } = &self.edits[near.edit as usize];
            if place.cmpge(*from).all() && place.cmple(*to).all() {
                edit.change(place, height, near.segments[0] as usize..near.segments[1] as usize)
            } else {
                height
            }
        })
    }

    /// Returns the column and the row of the square at a point, or of the nearest square.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
    fn square(&self, place: DVec2) -> [usize; 2] {
        let at = (place - self.low) / self.step;
        [at.x, at.y].map(|at| (at.max(0.0) as usize).min(self.across - 1))
    }
}

#[cfg(test)]
mod tests {
    use burgeon_base::random::Stream;

    use super::*;

    #[test]
    fn edits_of_long_paths_change_the_ground_as_without_the_index() {
        let mut stream = Stream::new(5);
        let mut changed = 0;
        for round in 0..30 {
            let mut edits = Vec::new();
            for kind in 0..6 {
                let mut number = |reach: f64| (stream.uniform() * 2.0 - 1.0) * reach;
                let mut at = [number(200.0), number(200.0), number(9.0)];
                let mut path = Vec::new();
                for _ in 0..2 + 13 * round {
                    path.push(at);
                    at = [at[0] + number(25.0), at[1] + number(25.0), at[2] + number(1.0)];
                }
                let (width, margin) = (2.0 + number(1.9), 9.0 + number(8.0));
                edits.push(match kind % 3 {
                    0 => Edit::Cut { path, width, margin },
                    1 => Edit::Carve { path, width, margin },
                    _ => {
                        Edit::Dig { path: path.iter().map(|[x, y, _]| [*x, *y]).collect(), width, depth: 3.0 }
                    }
                });
            }
            let local = LocalEdits::new(edits.clone(), DVec2::splat(-250.0), DVec2::splat(250.0));
            for _ in 0..500 {
                let place = DVec2::new(stream.uniform() - 0.5, stream.uniform() - 0.5) * 520.0;
                let ground = 12.0 * (place.x / 40.0).sin();
                let all = |height, edit: &Edit| edit.change(place, height, 0..edit.extents().len());
                let expected = edits.iter().fold(ground, all);
                assert_eq!(local.at(place, ground).to_bits(), expected.to_bits(), "at {place}");
                changed += usize::from(expected.to_bits() != ground.to_bits());
            }
        }
        assert!(changed > 1000, "{changed} places");
    }
}
