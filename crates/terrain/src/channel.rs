//! River channels: the path of a river, lowered until the ground on both banks is above the water.

use glam::{DVec2, DVec3};

/// Positions across a channel at which heights are sampled, as multiples of half of its width: up to a little
/// beyond both banks.
const ACROSS: [f64; 7] = [-1.15, -0.8, -0.4, 0.0, 0.4, 0.8, 1.15];

/// Maximum number of points of a channel.
const MOST_POINTS: usize = 20_000;

/// A river's path, lowered into the ground.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Path (m) from the source downstream, with heights that never rise and are never above the ground.
    pub path: Vec<DVec3>,
    /// Point (m) of the maximum depth below the ground, and that depth (m).
    pub deepest: (DVec2, f64),
}

impl Channel {
    /// Computes the channel of `width` (m) along `path` (m) in ground with the heights (m) `height`.
    ///
    /// Points are added so that the ground between them cannot be much lower than the water.
    ///
    /// ```
    /// use burgeon_terrain::Channel;
    /// use glam::DVec3;
    ///
    /// // The path crosses a ridge 3 m high at x = 50 m.
    /// let ground = |at: glam::DVec2| Some(if (at.x - 50.0).abs() < 10.0 { 13.0 } else { 10.0 });
    /// let path = [DVec3::new(0.0, 0.0, 10.0), DVec3::new(100.0, 0.0, 10.0)];
    /// let channel = Channel::new(&path, 4.0, ground);
    /// assert!(channel.path.iter().all(|at| (at.z - 10.0).abs() < 1e-9));
    /// assert!((channel.deepest.1 - 3.0).abs() < 1e-9);
    /// ```
    pub fn new(path: &[DVec3], width: f64, height: impl Fn(DVec2) -> Option<f64>) -> Self {
        let path = dense(path, width / 2.0);
        let last = path.len().saturating_sub(1);
        let mut level = f64::INFINITY;
        let mut sunk = Vec::with_capacity(path.len());
        let mut deepest = (DVec2::ZERO, 0.0);
        for (index, at) in path.iter().enumerate() {
            let place = at.truncate();
            let along = path[(index + 1).min(last)].truncate() - path[index.saturating_sub(1)].truncate();
            let aside = along.normalize_or_zero().perp() * (width / 2.0);
            let bank = |part: &f64| height(place + aside * *part);
            level = ACROSS.iter().filter_map(bank).fold(level.min(at.z), f64::min);
            sunk.push(place.extend(level));
            let depth = height(place).map_or(0.0, |ground| ground - level);
            if depth > deepest.1 {
                deepest = (place, depth);
            }
        }
        Self { path: sunk, deepest }
    }
}

/// Adds points to a path so that they are at most `step` (m) apart, or as close as their maximum number
/// allows.
fn dense(path: &[DVec3], step: f64) -> Vec<DVec3> {
    let length: f64 = path.windows(2).map(|pair| pair[0].truncate().distance(pair[1].truncate())).sum();
    #[allow(clippy::cast_precision_loss, reason = "a small number")]
    let step = step.max(length / MOST_POINTS as f64).max(1e-9);
    let mut points: Vec<DVec3> = path.first().copied().into_iter().collect();
    for pair in path.windows(2) {
        let parts = (pair[0].truncate().distance(pair[1].truncate()) / step).ceil().max(1.0);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the number of points"
        )]
        let parts = parts as usize;
        #[allow(clippy::cast_precision_loss, reason = "few parts")]
        points.extend((1..=parts).map(|part| pair[0].lerp(pair[1], part as f64 / parts as f64)));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn water_on_a_slope_lies_below_both_banks() {
        // Along the contour of a slope, and through a ridge.
        let ground = |at: DVec2| Some(0.5 * at.y + 30.0 * (-((at.x - 200.0) / 20.0).powi(2)).exp());
        let path = [DVec3::new(0.0, 0.0, 9.0), DVec3::new(400.0, 0.0, 9.0)];
        let channel = Channel::new(&path, 12.0, ground);
        assert!(channel.path.len() > 60);
        for pair in channel.path.windows(2) {
            assert!(pair[1].z <= pair[0].z);
            for aside in [-6.0, 0.0, 6.0] {
                let bank = ground(pair[0].truncate() + DVec2::new(0.0, aside)).unwrap();
                assert!(pair[0].z <= bank, "{} above {bank}", pair[0]);
            }
        }
        // Points are half a width apart.
        let (place, depth) = channel.deepest;
        assert!((place.x - 200.0).abs() < 3.0 && (depth - 33.5).abs() < 1.0, "{place} {depth}");
    }
}
