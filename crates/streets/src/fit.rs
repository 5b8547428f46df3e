//! Fitting of street heights to the terrain, with a maximum slope.
//!
//! Junctions are level, and segments are level across, so only the longitudinal slope must be bounded. Two height
//! functions keep the slope: the highest that is nowhere above the reachable terrain, and the lowest that is nowhere
//! below it. Their mean also keeps the slope, and cuts as much as it fills.
//!
//! Method: the two Lipschitz extensions of E. J. McShane, "Extension of range of functions", 1934, by Dijkstra's
//! shortest paths.

use std::cmp::Ordering;
use std::collections::BinaryHeap;

use glam::DVec2;
use smallvec::SmallVec;

use crate::plan::grid::{crossing, touch};
use crate::plan::network::{PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::{ArmShape, StreetShapes};
use crate::surface::parts::SurfaceOptions;

/// Distance (m) between height samples along a segment.
const STEP: f64 = 20.0;
/// Number of smoothing rounds before the slope is bounded.
const ROUNDS: usize = 4;
/// Terrain samples across a street, as fractions of its width.
const ACROSS: [f64; 3] = [-0.5, 0.0, 0.5];

/// Height difference (m) between a street and the ground per level.
const CLEARANCE: f64 = 5.5;

/// Options for fitting streets to the terrain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeOptions {
    /// Maximum slope (m/m).
    pub max_slope: f64,
    /// Minimum height (m) of streets on dry land, and of bridges.
    pub least: [Option<f64>; 2],
}

/// Street heights fitted to the terrain.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct StreetFit {
    /// Heights of the streets.
    pub profiles: StreetProfiles,
    /// Maximum distance (m) above or below the terrain, by segment.
    pub depths: Vec<f64>,
}

/// Sample whose height is computed.
struct FitPlace {
    /// Height (m) of the terrain.
    ground: f64,
    least: f64,
    /// Adjacent samples, with their distances (m) over which the street may slope.
    beside: SmallVec<[(u32, f64); 2]>,
}

impl StreetNetwork {
    /// Computes the heights of the streets on a terrain; `ground` returns the terrain height (m) at a position (m).
    /// Returns the first position without terrain as the error.
    /// ```
    /// use burgeon_streets::{Constraints, Obstacles, SlopeOptions, StreetAttributes, StreetNetwork, SurfaceOptions};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let start = network.begin(DVec2::ZERO)?;
    /// let end = network.grow(start, DVec2::new(200.0, 0.0), StreetAttributes::default())?.end;
    /// let slopes = SlopeOptions { max_slope: 0.1, least: [None; 2] };
    /// let rise = |slope: f64| {
    ///     let fit = network.lay(SurfaceOptions::default(), slopes, |at| Some(slope * at.x)).expect("ground");
    ///     fit.profiles.junction(end) - fit.profiles.junction(start)
    /// };
    /// // On a slope of 30 % the street rises by 10 % but for its ends, which are level; on level ground not at all.
    /// assert!((18.0..=20.0).contains(&rise(0.3)));
    /// assert_eq!(rise(0.0), 0.0);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn lay(
        &self,
        options: SurfaceOptions,
        slopes: SlopeOptions,
        ground: impl Fn(DVec2) -> Option<f64>,
    ) -> Result<StreetFit, DVec2> {
        let shapes = StreetShapes::new(self, options.turning);
        let mut places: Vec<FitPlace> = Vec::with_capacity(self.junctions.len());
        for junction in &self.junctions {
            let ground = if junction.pieces.is_empty() { Some(0.0) } else { ground(junction.place()) };
            let ground = ground.ok_or_else(|| junction.place())?;
            places.push(FitPlace { ground, least: f64::NEG_INFINITY, beside: SmallVec::new() });
        }
        let mut chains: Vec<(u32, Vec<f64>)> = vec![(0, Vec::new()); self.pieces.len()];
        for (piece, known) in self.pieces() {
            let [start, stop] = self.line(piece);
            let way = (stop - start).normalize_or_zero();
            let is_merged = self.has_existing();
            let clear = known.ends.map(|end| shapes.arm(end, piece).map_or(0.0, ArmShape::clear));
            // Where streets overlap, the level part of a junction may cover the whole segment.
            let (clear, room) =
                if is_merged { ([0.0; 2], self.length(piece)) } else { (clear, shapes.room(piece)) };
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
            let inner = (room / STEP).floor() as u32;
            let step = room / f64::from(inner + 1);
            #[allow(clippy::cast_possible_truncation, reason = "limited by the number of pieces")]
            let first = places.len() as u32;
            let least = slopes.least[usize::from(known.is_bridge)].unwrap_or(f64::NEG_INFINITY);
            for end in known.ends {
                let place = &mut places[end as usize];
                place.least = place.least.max(least);
            }
            let mut alongs = vec![clear[0]];
            let mut before = known.ends[0];
            for index in 0..=inner {
                let along = clear[0] + step * f64::from(index + 1);
                let next = if index == inner { known.ends[1] } else { first + index };
                if index < inner {
                    let at = start + way * along;
                    let across = ACROSS.map(|part| at + way.perp() * (part * known.attributes.width));
                    let found = across.into_iter().filter_map(&ground);
                    let (sum, count) =
                        found.fold((0.0, 0.0), |(sum, count), height| (sum + height, count + 1.0));
                    if count == 0.0 {
                        return Err(at);
                    }
                    let ground = sum / count;
                    places.push(FitPlace { ground, least, beside: SmallVec::new() });
                }
                places[before as usize].beside.push((next, step));
                places[next as usize].beside.push((before, step));
                alongs.push(along);
                before = next;
            }
            for (along, height) in self.passed_over(piece, &ground) {
                // Both adjacent samples are raised, so the whole stretch between them is as high.
                let after = alongs.partition_point(|at| *at <= along).clamp(1, alongs.len() - 1);
                for index in [after - 1, after] {
                    let place = match index {
                        0 => known.ends[0],
                        _ if index == alongs.len() - 1 => known.ends[1],
                        #[allow(clippy::cast_possible_truncation, reason = "pieces have few places")]
                        _ => first + index as u32 - 1,
                    };
                    let least = &mut places[place as usize].least;
                    *least = least.max(height);
                }
            }
            chains[piece as usize] = (first, alongs);
        }
        let heights = bounded(&places, slopes.max_slope);
        let mut fit = StreetFit::default();
        fit.profiles.junctions = heights[..self.junctions.len()].to_vec();
        for (piece, (known, (first, alongs))) in self.pieces.iter().zip(chains).enumerate() {
            let mut deepest = 0.0_f64;
            let last = alongs.len().saturating_sub(1);
            let profile = alongs.iter().zip(0_u32..).map(|(along, index)| {
                let place = match index as usize {
                    0 => known.ends[0],
                    index if index == last => known.ends[1],
                    _ => first + index - 1,
                } as usize;
                deepest = deepest.max((heights[place] - places[place].ground).abs());
                [*along, heights[place]]
            });
            fit.profiles.pieces.push(profile.collect());
            debug_assert_eq!(fit.profiles.pieces.len(), piece + 1);
            fit.depths.push(deepest);
        }
        Ok(fit)
    }
}

impl StreetNetwork {
    /// Returns the positions (m) along a segment at which it passes over segments of a lower level, and its minimum
    /// heights (m) there.
    fn passed_over(&self, piece: PieceId, ground: &impl Fn(DVec2) -> Option<f64>) -> Vec<(f64, f64)> {
        let level = self.attributes(piece).level;
        if level <= 0 {
            return Vec::new();
        }
        let line = self.line(piece);
        let lower = self.pieces_near(line, 0.0).filter_map(|other| {
            let below = self.attributes(other).level.max(0);
            let shares = self.ends(other).iter().any(|end| self.ends(piece).contains(end));
            if below >= level || shares || !touch(self.grid_line(piece), self.grid_line(other)) {
                return None;
            }
            let along = crossing(line, self.line(other))?.clamp(0.0, 1.0);
            let height = ground(line[0].lerp(line[1], along))? + CLEARANCE * f64::from(level - below);
            Some((along * self.length(piece), height))
        });
        let mut passed: Vec<(f64, f64)> = lower.collect();
        passed.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        passed
    }
}

/// Computes heights of `places` with a slope of at most `slope` (m/m).
fn bounded(places: &[FitPlace], slope: f64) -> Vec<f64> {
    let mut heights: Vec<f64> = places.iter().map(|place| place.ground.max(place.least)).collect();
    for _ in 0..ROUNDS {
        heights = places
            .iter()
            .zip(&heights)
            .map(|(place, height)| {
                if place.beside.is_empty() {
                    return *height;
                }
                #[allow(clippy::cast_precision_loss, reason = "few streets meet")]
                let count = place.beside.len() as f64;
                let around =
                    place.beside.iter().map(|(beside, _)| heights[*beside as usize]).sum::<f64>() / count;
                (height + around) / 2.0
            })
            .collect();
    }
    let below = spread(places, &heights, slope);
    let turned: Vec<f64> = heights.iter().map(|height| -height).collect();
    let above = spread(places, &turned, slope);
    let mean: Vec<f64> = below.iter().zip(&above).map(|(below, above)| (below - above) / 2.0).collect();
    // Minimum heights are kept: the maximum of two functions that keep the slope also keeps it.
    let least: Vec<f64> = places.iter().map(|place| -place.least).collect();
    let least = spread(places, &least, slope);
    mean.iter().zip(&least).map(|(mean, least)| mean.max(-least)).collect()
}

/// Computes for each sample the minimum over all `heights`, each raised by `slope` times the path length (m).
fn spread(places: &[FitPlace], heights: &[f64], slope: f64) -> Vec<f64> {
    let mut best = heights.to_vec();
    let mut due: BinaryHeap<SpreadItem> =
        (0..).zip(heights).map(|(place, height)| SpreadItem(*height, place)).collect();
    while let Some(SpreadItem(height, place)) = due.pop() {
        if height > best[place as usize] || height == f64::INFINITY {
            continue;
        }
        for (beside, length) in &places[place as usize].beside {
            let raised = height + slope * length;
            if raised < best[*beside as usize] {
                best[*beside as usize] = raised;
                due.push(SpreadItem(raised, *beside));
            }
        }
    }
    best
}

/// Sample reached at a height (m); the lowest is the greatest item.
struct SpreadItem(f64, u32);

impl PartialEq for SpreadItem {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other) == Ordering::Equal
    }
}

impl Eq for SpreadItem {}

impl PartialOrd for SpreadItem {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for SpreadItem {
    fn cmp(&self, other: &Self) -> Ordering {
        other.0.total_cmp(&self.0).then(other.1.cmp(&self.1))
    }
}
