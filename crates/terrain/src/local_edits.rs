//! The changes of a part of the ground, found by place.

use glam::DVec2;

use super::edits::Edit;

/// Changes in order, and by square of the part that they change.
#[derive(Debug, Clone, Default)]
pub(super) struct LocalEdits {
    edits: Vec<LocalEdit>,
    low: DVec2,
    /// The length (m) of the sides of a square, and how many there are along a side of the part.
    step: DVec2,
    across: usize,
    /// By square, row by row from the south: the numbers of what reaches it.
    squares: Vec<Vec<u32>>,
}

#[derive(Debug, Clone)]
struct LocalEdit {
    edit: Edit,
    bounds: (DVec2, DVec2),
}

/// The most squares along a side.
const MOST_ACROSS: usize = 128;

impl LocalEdits {
    /// Those of `edits` for the box from `low` to `high` (m).
    pub(super) fn new(edits: impl IntoIterator<Item = Edit>, low: DVec2, high: DVec2) -> Self {
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

    /// Whether nothing is changed.
    pub(super) fn is_empty(&self) -> bool {
        self.edits.is_empty()
    }

    /// The height (m) that a place gets where it was `height` (m).
    pub(super) fn at(&self, place: DVec2, height: f64) -> f64 {
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

    /// The column and the row of the square at a place; of the nearest one outside of the part.
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a cast saturates")]
    fn square(&self, place: DVec2) -> [usize; 2] {
        let at = (place - self.low) / self.step;
        [at.x, at.y].map(|at| (at.max(0.0) as usize).min(self.across - 1))
    }
}
