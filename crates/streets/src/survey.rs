//! Surveys: networks of unchanged lines, to compare with grown networks.

use glam::DVec2;
use rstar::primitives::{GeomWithData, Line as IndexLine};
use rstar::{AABB, RTree};
use rustc_hash::FxHashSet;

use crate::plan::constraints::Constraints;
use crate::plan::grid::{GridPlace, crossing, foot};
use crate::plan::network::{StreetAttributes, StreetNetwork};
use crate::plan::obstacles::Obstacles;
use burgeon_base::error::Result;

/// Maximum distance (m) between the end of a line and another line that it joins.
const TOUCH: f64 = 0.05;

impl StreetNetwork {
    /// Creates a network of lines (m) without width: junctions are the points where lines meet or cross, and no line is
    /// refused or moved.
    ///
    /// Intended for measures of real streets. Lines that are not finite or too far away are skipped.
    ///
    /// ```
    /// use burgeon_streets::StreetNetwork;
    /// use glam::DVec2;
    ///
    /// let line = |points: [(f64, f64); 2]| points.map(DVec2::from).to_vec();
    /// let network = StreetNetwork::survey(&[line([(-90.0, 0.0), (90.0, 0.0)]), line([(0.0, -90.0), (0.0, 90.0)])])?;
    /// assert_eq!((network.size(), network.dead_ends().count()), (4, 4));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn survey(lines: &[Vec<DVec2>]) -> Result<Self> {
        let mut network = Self::new(Constraints::default(), Obstacles::default())?;
        let pieces: Vec<[DVec2; 2]> = lines
            .iter()
            .flat_map(|line| line.windows(2))
            .filter_map(|pair| {
                Some([GridPlace::nearest(pair[0])?.metres(), GridPlace::nearest(pair[1])?.metres()])
            })
            .filter(|[a, b]| a != b)
            .collect();
        let items = pieces
            .iter()
            .enumerate()
            .map(|(index, [a, b])| GeomWithData::new(IndexLine::new(a.to_array(), b.to_array()), index));
        let index = RTree::bulk_load(items.collect::<Vec<_>>());
        let mut known = FxHashSet::default();
        for (own, &[a, b]) in pieces.iter().enumerate() {
            let around = AABB::from_corners((a.min(b) - TOUCH).to_array(), (a.max(b) + TOUCH).to_array());
            let mut stops = vec![0.0, 1.0];
            for other in index.locate_in_envelope_intersecting(&around).filter(|other| other.data != own) {
                let other = pieces[other.data];
                for end in other {
                    let (aside, along) = foot(end, [a, b]);
                    if aside < TOUCH {
                        stops.push(along);
                    }
                }
                let along = crossing([a, b], other).filter(|on| (0.0..=1.0).contains(on));
                let is_met = crossing(other, [a, b]).is_some_and(|on| (0.0..=1.0).contains(&on));
                stops.extend(along.filter(|_| is_met));
            }
            stops.sort_by(f64::total_cmp);
            let places = stops.iter().filter_map(|along| GridPlace::nearest(a + (b - a) * *along));
            let mut ends: Vec<_> = places.map(|place| network.corner_near(place)).collect();
            ends.dedup();
            for pair in ends.windows(2) {
                let key = [pair[0].min(pair[1]), pair[0].max(pair[1])];
                if key[0] != key[1] && known.insert(key) {
                    network.add(key, StreetAttributes::default(), false);
                }
            }
        }
        Ok(network)
    }

    /// Returns the junction within [`TOUCH`] of a position, or a new one.
    fn corner_near(&mut self, place: GridPlace) -> u32 {
        let at = place.metres();
        let near = self.junctions_near([at; 2], TOUCH);
        let nearest = near.min_by(|a, b| {
            let far = |junction: &u32| self.at(*junction).distance_squared(at);
            far(a).total_cmp(&far(b)).then(a.cmp(b))
        });
        nearest.unwrap_or_else(|| self.junction(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_joined_where_they_cross_touch_and_lie_on_one_another() {
        let line = |points: &[(f64, f64)]| points.iter().map(|point| DVec2::from(*point)).collect::<Vec<_>>();
        let network = StreetNetwork::survey(&[
            line(&[(0.0, 0.0), (100.0, 0.0), (100.0, 100.0)]),
            // A line that ends on the first, one that overlaps a part of it, and one that occurs twice.
            line(&[(50.0, 80.0), (50.0, 0.01)]),
            line(&[(20.0, 0.0), (100.0, 0.0)]),
            line(&[(0.0, 60.0), (100.0, 60.0)]),
            line(&[(100.0, 60.0), (0.0, 60.0)]),
        ])
        .unwrap();
        let length: f64 = network.pieces().map(|(piece, _)| network.length(piece)).sum();
        assert!((length - (200.0 + 80.0 + 100.0)).abs() < 0.1, "{length}");
        assert_eq!((network.components(), network.faces().len(), network.dead_ends().count()), (1, 1, 4));
    }
}
