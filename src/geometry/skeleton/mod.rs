//! Straight skeletons: the faces of a roof over a polygon with holes.
//!
//! Comes in: rings and the speed of each edge. Goes out: one face for each edge. Every result is verified.

mod faces;
#[cfg(test)]
mod tests;
mod wavefront;

use glam::DVec2;

use crate::error::{Error, Result};

/// A place where faces meet: on the plan (m), and when the wavefront reached it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Peak {
    /// The place (m).
    pub at: DVec2,
    /// How far an edge of speed 1 had moved (m).
    pub time: f64,
}

/// The faces over a polygon, one for each edge, in the order of the edges.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// The corners of all faces; first those of the polygon, in their order.
    pub peaks: Vec<Peak>,
    /// Indices into `peaks`, counter-clockwise; each begins with the edge itself.
    pub faces: Vec<Vec<usize>>,
    /// Whether the polygon had to be moved a little (at most 5 mm) for it.
    pub moved: bool,
}

/// How far (m) the corners are moved, in turn, where the skeleton fails its checks.
const MOVES: [f64; 6] = [0.0, 1e-5, 1e-4, 5e-4, 2e-3, 5e-3];

impl Skeleton {
    /// The weighted straight skeleton of the area inside the first of `rings` and outside the others.
    ///
    /// The first ring is counter-clockwise, the holes are clockwise; none crosses or touches another. `speeds`
    /// has a number for each edge of all rings: how far it moves while an edge of speed 1 moves 1 m. An edge of
    /// speed 0 stands still, as under a gable, and its face has no area on the plan.
    ///
    /// Method: wavefront propagation (O. Aichholzer and F. Aurenhammer, "Straight skeletons for general
    /// polygonal figures in the plane", 1996). What happens at one time and place is resolved at once: the
    /// edges that meet there are sorted around it and paired anew, whatever the kind of the events. Fails if no
    /// result passes the checks: one closed face for each edge, every corner in the plane of its faces, no
    /// negative area, areas that add up to the polygon's (to 1e-6), faces monotone along their edge.
    pub fn new(rings: &[Vec<DVec2>], speeds: &[f64]) -> Result<Self> {
        let mut failure = None;
        for (attempt, by) in MOVES.into_iter().enumerate() {
            let moved: Vec<Vec<DVec2>> = if by > 0.0 { shaken(rings, by, attempt) } else { rings.to_vec() };
            match wavefront::propagate(&moved, speeds)
                .and_then(|traced| faces::assemble(&moved, speeds, traced))
            {
                Ok(mut skeleton) => {
                    for (peak, &at) in skeleton.peaks.iter_mut().zip(rings.iter().flatten()) {
                        peak.at = at;
                    }
                    skeleton.moved = by > 0.0;
                    return Ok(skeleton);
                }
                Err(error) => failure = Some(error),
            }
        }
        Err(failure.unwrap_or_else(|| Error::new("the roof has no faces")))
    }

    /// The greatest time: the height of the highest ridge at a slope of 1.
    pub fn duration(&self) -> f64 {
        self.peaks.iter().map(|peak| peak.time).fold(0.0, f64::max)
    }
}

/// The rings with each corner moved by up to `by` (m) in each direction, always the same.
fn shaken(rings: &[Vec<DVec2>], by: f64, attempt: usize) -> Vec<Vec<DVec2>> {
    let mut state = 0x9e37_79b9_7f4a_7c15_u64.wrapping_mul(attempt as u64 + 1);
    let mut next = || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        #[allow(clippy::cast_precision_loss, reason = "a random number needs no more")]
        let fraction = (state >> 11) as f64 / (1u64 << 53) as f64;
        (fraction * 2.0 - 1.0) * by
    };
    rings.iter().map(|ring| ring.iter().map(|&at| at + DVec2::new(next(), next())).collect()).collect()
}
