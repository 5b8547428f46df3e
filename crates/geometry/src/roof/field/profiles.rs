//! Heights across a ridge.

use super::axis::RidgeFrame;
use super::heights::{HeightField, HeightPlane, PlaneRule};

/// Number of faces of an arc.
const ARC_FACES: usize = 12;
/// Maximum number of slopes of a sawtooth roof.
const MOST_TEETH: f64 = 100.0;

/// Corners of a section across the ridge: the share of the width, from the side that water runs to, and the height (m).
/// Two corners at one share form an upright step.
pub(super) type CrossProfile = Vec<(f64, f64)>;

/// Returns the section of a gable roof with bends.
pub(super) fn mirrored(bends: &[(f64, f64)], rise: f64) -> CrossProfile {
    let half: CrossProfile =
        [(0.0, 0.0)].iter().chain(bends).map(|&(share, height)| (0.5 * share, rise * height)).collect();
    let other = half.iter().rev().map(|&(share, height)| (1.0 - share, height));
    half.iter().copied().chain([(0.5, rise)]).chain(other).collect()
}

/// Returns the section of an arc: a part of a circle, or of an ellipse if it is higher than half of its width.
pub(super) fn arc(half: f64, rise: f64) -> CrossProfile {
    let flat = rise.min(half).max(1e-6);
    let radius = (half * half + flat * flat) / (2.0 * flat);
    let most = (half / radius).min(1.0).asin();
    let corner = |index: usize| {
        let angle = most * (2.0 * index as f64 / ARC_FACES as f64 - 1.0);
        let height = (radius * angle.cos() - (radius - flat)) * (rise / flat);
        (0.5 + 0.5 * radius * angle.sin() / half, height.max(0.0))
    };
    let mut profile: CrossProfile = (0..=ARC_FACES).map(corner).collect();
    (profile[0], profile[ARC_FACES]) = ((0.0, 0.0), (1.0, 0.0));
    profile
}

/// Returns the section of slopes of about `width` (m) over a length (m), with the height (m) for the width of one slope.
pub(super) fn teeth(length: f64, width: f64, rise: impl Fn(f64) -> f64) -> CrossProfile {
    let count = (length / width).round().clamp(2.0, MOST_TEETH);
    let high = rise(length / count);
    let mut profile = CrossProfile::new();
    let mut tooth = 0.0;
    while tooth < count {
        profile.extend([(tooth / count, 0.0), ((tooth + 1.0) / count, high)]);
        tooth += 1.0;
    }
    profile
}

/// Returns the heights of a section that is extended along the ridge.
pub(super) fn field(frame: &RidgeFrame, profile: &[(f64, f64)]) -> HeightField {
    let width = 2.0 * frame.half.y;
    let way = -frame.down;
    let (mut planes, mut limits) = (Vec::new(), Vec::new());
    for pair in profile.windows(2) {
        let [(from, low), (to, high)] = [pair[0], pair[1]];
        if to - from < 1e-9 {
            continue;
        }
        if !planes.is_empty() {
            limits.push((from - 0.5) * width);
        }
        planes.push(HeightPlane {
            at: frame.middle + way * ((from - 0.5) * width),
            height: low,
            gradient: way * ((high - low) / ((to - from) * width)),
        });
    }
    HeightField { planes, rule: PlaneRule::Bands { middle: frame.middle, way, limits } }
}
