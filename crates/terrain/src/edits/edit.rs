//! Terrain edits: level areas, cuttings, ditches, and the beds of objects.

use glam::DVec2;
use serde::{Deserialize, Serialize};

use super::bed::{GroundBed, mix, to_line};
use burgeon_geometry::planar::contains;

/// A terrain edit.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "lowercase", deny_unknown_fields)]
pub enum Edit {
    /// Levels the ground within an outline.
    Flatten {
        /// Outline (m).
        outline: Vec<[f64; 2]>,
        /// New height (m).
        height: f64,
        /// Distance (m) around the outline over which the effect fades.
        margin: f64,
    },
    /// Sets the ground along a path to the height of the path.
    Cut {
        /// Path (m) with heights.
        path: Vec<[f64; 3]>,
        /// Width (m).
        width: f64,
        /// Distance (m) on each side over which the effect fades.
        margin: f64,
    },
    /// Lowers the ground along a path to at most the height of the path.
    Carve {
        /// Path (m) with heights.
        path: Vec<[f64; 3]>,
        /// Width (m) of the bed.
        width: f64,
        /// Width (m) of the slope on each side, over which the effect fades.
        margin: f64,
    },
    /// Lowers the ground along a path, or raises it if the depth is negative.
    Dig {
        /// Path (m).
        path: Vec<[f64; 2]>,
        /// Width (m).
        width: f64,
        /// Depth (m) at the centreline.
        depth: f64,
    },
    /// Raises the ground to at least the height of a bed, with slopes next to it.
    Embank {
        /// Bed on the embankment.
        bed: GroundBed,
    },
    /// Lowers the ground to at most the height of a bed, with slopes next to it.
    Excavate {
        /// Bed in the excavation.
        bed: GroundBed,
    },
}

impl Edit {
    /// Raises the edit by `lift` (m).
    #[must_use]
    pub fn raise(mut self, lift: f64) -> Self {
        match &mut self {
            Self::Flatten { height, .. } => *height += lift,
            Self::Cut { path: line, .. }
            | Self::Carve { path: line, .. }
            | Self::Embank { bed: GroundBed { line, .. } }
            | Self::Excavate { bed: GroundBed { line, .. } } => line.iter_mut().for_each(|at| at[2] += lift),
            Self::Dig { .. } => {}
        }
        self
    }

    /// Returns the corners (m) of the bounding box of the edit's extent.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        let (points, reach): (Vec<DVec2>, f64) = match self {
            Self::Flatten { outline, margin, .. } => {
                (outline.iter().map(|at| DVec2::from(*at)).collect(), *margin)
            }
            Self::Cut { path, width, margin } | Self::Carve { path, width, margin } => {
                (path.iter().map(|[x, y, _]| DVec2::new(*x, *y)).collect(), width / 2.0 + margin)
            }
            Self::Dig { path, width, .. } => (path.iter().map(|at| DVec2::from(*at)).collect(), width / 2.0),
            Self::Embank { bed } | Self::Excavate { bed } => {
                (bed.line.iter().map(|[x, y, _]| DVec2::new(*x, *y)).collect(), bed.reach())
            }
        };
        let low = points.iter().fold(DVec2::INFINITY, |low, at| low.min(*at));
        let high = points.iter().fold(DVec2::NEG_INFINITY, |high, at| high.max(*at));
        (low - reach, high + reach)
    }

    /// Returns the new height (m) at `place` (m), given the previous height (m).
    pub(crate) fn change(&self, place: DVec2, height: f64) -> f64 {
        match self {
            Self::Flatten { outline, height: level, margin } => {
                let distance = if contains(outline, place) { 0.0 } else { to_line(outline, place, true).0 };
                mix(height, *level, fade(distance, *margin))
            }
            Self::Cut { path, width, margin } => along_path(path, *width, *margin, place, height),
            Self::Carve { path, width, margin } => {
                height.min(along_path(path, *width, *margin, place, height))
            }
            Self::Dig { path, width, depth } => {
                let (distance, ..) = to_line(path, place, false);
                let across = (1.0 - distance / (width / 2.0)).clamp(0.0, 1.0);
                height - depth * across * across * (3.0 - 2.0 * across)
            }
            Self::Embank { bed } => bed
                .distance_beside(place)
                .map_or(height, |(beyond, level)| height.max(level - beyond * bed.slope)),
            Self::Excavate { bed } => bed
                .distance_beside(place)
                .map_or(height, |(beyond, level)| height.min(level + beyond * bed.slope)),
        }
    }

    /// Returns the reason why the edit is invalid, if it is.
    pub(crate) fn fault(&self) -> Option<&'static str> {
        let (points, least, sizes): (Vec<f64>, usize, Vec<f64>) = match self {
            Self::Flatten { outline, height, margin } => {
                (outline.iter().flatten().copied().chain([*height]).collect(), 2 * 3 + 1, vec![*margin])
            }
            Self::Cut { path, width, margin } | Self::Carve { path, width, margin } => {
                (path.iter().flatten().copied().collect(), 2 * 3, vec![*width, *margin])
            }
            Self::Dig { path, width, depth } => {
                (path.iter().flatten().copied().chain([*depth]).collect(), 2 * 2 + 1, vec![*width])
            }
            Self::Embank { bed } | Self::Excavate { bed } => {
                let least = if bed.is_area { 3 * 3 } else { 2 * 3 };
                let numbers = bed.line.iter().flatten().copied().collect();
                (numbers, least, vec![bed.width, bed.slope, bed.margin])
            }
        };
        if points.iter().chain(&sizes).any(|number| !number.is_finite()) {
            return Some("a number is not finite");
        }
        if points.len() < least {
            return Some(match self {
                Self::Flatten { .. } => "the outline has fewer than three points",
                Self::Embank { bed } | Self::Excavate { bed } if bed.is_area => {
                    "the outline has fewer than three points"
                }
                _ => "the path has fewer than two points",
            });
        }
        if sizes.iter().any(|size| *size < 0.0) {
            return Some("the width, margin or slope is below 0");
        }
        if matches!(self, Self::Dig { width, .. } if *width == 0.0) {
            return Some("the width is 0");
        }
        None
    }
}

/// Returns the height (m) at `place` (m) after adapting the ground to a path of `width` (m), given the
/// previous height (m).
fn along_path(path: &[[f64; 3]], width: f64, margin: f64, place: DVec2, height: f64) -> f64 {
    let flat: Vec<[f64; 2]> = path.iter().map(|[x, y, _]| [*x, *y]).collect();
    let (distance, piece, along) = to_line(&flat, place, false);
    let level = match path.get(piece + 1) {
        Some(next) => mix(path[piece][2], next[2], along),
        None => path[piece][2],
    };
    mix(height, level, fade(distance - width / 2.0, margin))
}

/// Returns the strength (1 to 0) of an edit at a distance (m) from its full effect.
fn fade(distance: f64, margin: f64) -> f64 {
    if distance <= 0.0 {
        return 1.0;
    }
    if distance >= margin {
        return 0.0;
    }
    let part = 1.0 - distance / margin;
    part * part * (3.0 - 2.0 * part)
}
