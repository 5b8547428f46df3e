//! Terrain edits: level areas, cuttings, ditches, and the beds of objects.

use std::ops::Range;

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

    /// Returns the corners (m) of the bounding box of the extent of each segment of a path, in their order; of an area, of
    /// the whole extent.
    pub(crate) fn extents(&self) -> Vec<(DVec2, DVec2)> {
        let of = |points: &mut dyn Iterator<Item = DVec2>, reach: f64| {
            let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
            let (low, high) = points.fold(start, |(low, high), at| (low.min(at), high.max(at)));
            (low - reach, high + reach)
        };
        fn flat<const N: usize>(points: &[[f64; N]]) -> impl Iterator<Item = DVec2> {
            points.iter().map(|at| DVec2::new(at[0], at[1]))
        }
        fn pairs<const N: usize>(path: &[[f64; N]], reach: f64) -> Vec<(DVec2, DVec2)> {
            let of = |pair: &[[f64; N]]| {
                let [from, to] = [pair[0], pair[1]].map(|at| DVec2::new(at[0], at[1]));
                (from.min(to) - reach, from.max(to) + reach)
            };
            path.windows(2).map(of).collect()
        }
        match self {
            Self::Flatten { outline, margin, .. } => vec![of(&mut flat(outline), *margin)],
            Self::Cut { path, width, margin } | Self::Carve { path, width, margin } => {
                pairs(path, width / 2.0 + margin)
            }
            Self::Dig { path, width, .. } => pairs(path, width / 2.0),
            Self::Embank { bed } | Self::Excavate { bed } if bed.is_area => {
                vec![of(&mut flat(&bed.line), bed.reach())]
            }
            Self::Embank { bed } | Self::Excavate { bed } => pairs(&bed.line, bed.reach()),
        }
    }

    /// Returns the corners (m) of the bounding box of the edit's extent.
    pub(crate) fn bounds(&self) -> (DVec2, DVec2) {
        let start = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.extents()
            .into_iter()
            .fold(start, |(low, high), (south_west, north_east)| (low.min(south_west), high.max(north_east)))
    }

    /// Returns the new height (m) at `place` (m), given the previous height (m). The point must be outside the extents of
    /// the other segments of a path than `segments`.
    pub(crate) fn change(&self, place: DVec2, height: f64, segments: Range<usize>) -> f64 {
        match self {
            Self::Flatten { outline, height: level, margin } => {
                let distance =
                    if contains(outline, place) { 0.0 } else { to_line(outline, place, 0..outline.len()).0 };
                mix(height, *level, fade(distance, *margin))
            }
            Self::Cut { path, width, margin } => {
                along_path(path, (*width, *margin), (place, segments), height)
            }
            Self::Carve { path, width, margin } => {
                height.min(along_path(path, (*width, *margin), (place, segments), height))
            }
            Self::Dig { path, width, depth } => {
                let (distance, ..) = to_line(path, place, segments);
                let across = (1.0 - distance / (width / 2.0)).clamp(0.0, 1.0);
                height - depth * across * across * (3.0 - 2.0 * across)
            }
            Self::Embank { bed } => bed
                .distance_beside(place, bed.segments(segments))
                .map_or(height, |(beyond, level)| height.max(level - beyond * bed.slope)),
            Self::Excavate { bed } => bed
                .distance_beside(place, bed.segments(segments))
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

/// Returns the height (m) at a place (m) after adapting the ground to segments of a path of a width (m) with a margin (m), given
/// the previous height (m).
fn along_path(
    path: &[[f64; 3]],
    (width, margin): (f64, f64),
    (place, segments): (DVec2, Range<usize>),
    height: f64,
) -> f64 {
    let (distance, piece, along) = to_line(path, place, segments);
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
