//! Objects along streets: positions of trees and lamps, behind the kerbs and away from junctions and crossings.

use glam::DVec3;

use crate::kinds::StreetKind;
use crate::marks::piece_ends;
use crate::plan::network::{PieceId, StreetNetwork};
use crate::shape::profile::StreetProfiles;
use crate::shape::shapes::StreetShapes;
use crate::surface::parts::SurfaceOptions;
use crate::surface::rows::{MedianEnd, median_of};

/// Distance (m) of the first object from the end of a segment, and from a crossing.
const MARGIN: f64 = 3.0;
/// Maximum distance (m) of trees and lamps behind the kerb, and the maximum as a fraction of the sidewalk.
const TREE: [f64; 2] = [1.1, 0.4];
const LAMP: [f64; 2] = [0.5, 0.25];
/// Minimum width (m) of a median with trees.
const LEAST_MEDIAN: f64 = 1.5;
/// Minimum distance (m) between a tree and a lamp.
const APART: f64 = 2.0;

/// Object along a street.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VergeKind {
    /// Tree.
    Tree,
    /// Lamp.
    Lamp,
}

/// Position of an object along a street.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct VergePlace {
    /// Position (m), at the height of the carriageway.
    pub place: DVec3,
    /// Direction (degrees counter-clockwise from east) to the centre of the street; on the median, the direction along
    /// the street.
    pub heading: f64,
    /// Street segment.
    pub piece: PieceId,
}

impl StreetNetwork {
    /// Returns the positions of trees or lamps along the streets; `kinds` contains the street types by depth.
    ///
    /// ```
    /// # use burgeon_streets::{Constraints, Obstacles, StreetNetwork};
    /// use burgeon_streets::{StreetKind, StreetProfiles, SurfaceOptions, VergeKind};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let kind = StreetKind { trees: 10.0, ..StreetKind::default() };
    /// let start = network.begin(DVec2::ZERO)?;
    /// network.grow(start, DVec2::new(100.0, 0.0), kind.attributes(0))?;
    /// let (options, profiles) = (SurfaceOptions::default(), StreetProfiles::default());
    /// let trees = network.verge(options, &profiles, &[kind], VergeKind::Tree);
    /// assert!((14..=22).contains(&trees.len()), "both sides have about 10 trees each");
    /// assert!(network.verge(options, &profiles, &[kind], VergeKind::Lamp).is_empty());
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn verge(
        &self,
        options: SurfaceOptions,
        profiles: &StreetProfiles,
        kinds: &[StreetKind],
        thing: VergeKind,
    ) -> Vec<VergePlace> {
        let shapes = StreetShapes::new(self, options.turning);
        let mut places = Vec::new();
        for (piece, known) in self.pieces().filter(|(_, piece)| piece.attributes.level == 0) {
            let kind = StreetKind::of(kinds, known.attributes.depth).adapt_to(known.attributes);
            // No trees are placed on a bridge.
            let carried = self.carried_range(piece).filter(|_| thing == VergeKind::Tree);
            let is_carried = |along: f64| carried.is_some_and(|[from, to]| (from..=to).contains(&along));
            let [start, stop] = self.line(piece);
            let (way, length) = ((stop - start).normalize_or_zero(), start.distance(stop));
            let ends = piece_ends(&shapes, piece);
            let margin = |side: usize| {
                ends[side].clear.max(ends[side].lines) + if ends[side].goes_on { 0.0 } else { MARGIN }
            };
            let stretch = [margin(0), length - margin(1)];
            let mut add = |along: f64, aside: f64, toward: f64| {
                if is_carried(along) {
                    return;
                }
                let at = start + way * along + way.perp() * aside;
                let heading = (way.to_angle() + toward).to_degrees();
                places.push(VergePlace {
                    place: at.extend(profiles.height_along(piece, along)),
                    heading,
                    piece,
                });
            };
            let lamps = even_places(stretch, kind.lamps);
            let right = std::f64::consts::FRAC_PI_2;
            let behind = |[most, part]: [f64; 2]| kind.carriageway() / 2.0 + most.min(part * kind.sidewalk);
            match thing {
                VergeKind::Lamp => {
                    for along in lamps {
                        add(along, behind(LAMP), -right);
                        add(along, -behind(LAMP), right);
                    }
                }
                VergeKind::Tree => {
                    let is_free = |along: &f64| lamps.iter().all(|lamp| (lamp - along).abs() >= APART);
                    for along in even_places(stretch, kind.trees).into_iter().filter(is_free) {
                        add(along, behind(TREE), -right);
                        add(along, -behind(TREE), right);
                    }
                    if let (true, Some(ends)) = (kind.median >= LEAST_MEDIAN, median_of(&shapes, piece)) {
                        let tip = |side: usize, through: f64| match ends[side] {
                            MedianEnd::Through => through,
                            MedianEnd::Round(tip) => tip + if side == 0 { MARGIN } else { -MARGIN },
                        };
                        for along in even_places([tip(0, 0.0), tip(1, length)], kind.trees) {
                            add(along, 0.0, 0.0);
                        }
                    }
                }
            }
        }
        places
    }
}

/// Returns evenly spaced positions between two limits, about `apart` (m) apart, with half of the distance at each end;
/// empty if `apart` is 0.
fn even_places([from, to]: [f64; 2], apart: f64) -> Vec<f64> {
    if apart <= 0.0 || to - from < apart / 2.0 {
        return Vec::new();
    }
    let count = ((to - from) / apart).floor().max(1.0);
    let step = (to - from) / count;
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "pieces are short")]
    let count = count as u32;
    (0..count).map(|index| from + step * (f64::from(index) + 0.5)).collect()
}
