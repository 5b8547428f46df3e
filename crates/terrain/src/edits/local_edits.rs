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
    /// Indices of the edits that affect each square, row by row from the south.
    squares: Vec<Vec<u32>>,
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
        let across = edits.len().isqrt().clamp(1, MOST_ACROSS);
        #[allow(clippy::cast_precision_loss, reason = "few squares")]
        let step = ((high - low) / across as f64).max(DVec2::splat(1e-9));
        let mut squares = vec![Vec::new(); across * across];
        let mut local = Self { edits: Vec::new(), low, step, across, squares: Vec::new() };
        for (number, edit) in (0..).zip(&edits) {
            let ([west, south], [east, north]) = (local.square(edit.bounds.0), local.square(edit.bounds.1));
            for row in south..=north {
                squares[row * across + west..=row * across + east].iter_mut().for_each(|it| it.push(number));
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
        let near = self.squares[row * self.across + column].iter();
        near.map(|number| &self.edits[*number as usize]).fold(height, |height, LocalEdit { edit, bounds }| {
            let (from, to) = *bounds;
            if place.cmpge(from).all() && place.cmple(to).all() { edit.change(place, height) } else { height }
        })
    }

    /// Returns the column and the row of the square at a point, or of the nearest square.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
    fn square(&self, place: DVec2) -> [usize; 2] {
        let at = (place - self.low) / self.step;
        [at.x, at.y].map(|at| (at.max(0.0) as usize).min(self.across - 1))
    }
}
