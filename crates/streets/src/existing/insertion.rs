//! Adding existing streets to a network.

use glam::DVec2;
use rustc_hash::FxHashSet;

use super::noding::node;
use super::snapping::{END, snap};
use super::strand::StreetStrand;
use crate::plan::grid::{GridPlace, foot};
use crate::plan::network::{PieceId, StreetAttributes, StreetNetwork, StreetPiece};
use burgeon_base::error::{Error, Limit, Result};

/// Existing street.
#[derive(Debug, Clone, PartialEq)]
pub struct ExistingStreet {
    /// Positions (m) along the street.
    pub line: Vec<DVec2>,
    /// Width, lanes, level and depth.
    pub attributes: StreetAttributes,
    /// Marks a bridge over water.
    pub is_bridge: bool,
    /// Display name for reports.
    pub name: String,
}

/// Part of an existing street that could not be added.
#[derive(Debug, Clone, PartialEq)]
pub struct ExistingLoss {
    /// Name of the street.
    pub name: String,
    /// Start of the part (m); `None` if the street has no usable position.
    pub at: Option<DVec2>,
    /// Length (m); infinite if the part has no usable end.
    pub length: f64,
    /// Reason for the loss.
    pub why: ExistingLossReason,
}

/// Reason why a part of an existing street could not be added.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ExistingLossReason {
    /// Position not finite, or too far from the origin.
    Outside,
    /// Single position, or shorter than 3 cm.
    NoLength,
    /// Crossing with another street that remains after rounding.
    Unresolved,
}

impl ExistingLossReason {
    /// Returns the name in scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Outside => "outside",
            Self::NoLength => "no length",
            Self::Unresolved => "unresolved crossing",
        }
    }
}

/// Report on the addition of existing streets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExistingReport {
    /// Total length (m) of the lines between usable positions.
    pub asked: f64,
    /// Missing parts, in the order of the streets.
    pub losses: Vec<ExistingLoss>,
}

impl ExistingReport {
    /// Returns the added length (m); lines that overlap are all counted.
    pub fn added_length(&self) -> f64 {
        let lost = self.losses.iter().map(|loss| loss.length).filter(|length| length.is_finite());
        self.asked - lost.sum::<f64>()
    }
}

impl StreetNetwork {
    /// Adds existing streets, and reports each part that could not be added.
    ///
    /// If two streets overlap, the smaller depth takes precedence, then the greater width. A junction without streets
    /// moves onto an existing street within 0.5 m. Fails if the number of segments would exceed the maximum.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, ExistingStreet, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let street = |line: [(f64, f64); 2], level| ExistingStreet {
    ///     line: line.map(DVec2::from).to_vec(),
    ///     attributes: StreetAttributes { width: 10.0, level, ..StreetAttributes::default() },
    ///     is_bridge: false,
    ///     name: "a street".to_owned(),
    /// };
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// // Two streets that cross, and a bridge over one of them.
    /// let streets = [
    ///     street([(0.0, 0.0), (200.0, 0.0)], 0),
    ///     street([(50.0, -90.0), (50.0, 90.0)], 0),
    ///     street([(150.0, -90.0), (150.0, 90.0)], 1),
    /// ];
    /// let report = network.add_existing(&streets)?;
    /// assert!(report.losses.is_empty() && report.added_length() == 560.0);
    /// assert_eq!((network.size(), network.components()), (5, 2));
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn add_existing(&mut self, streets: &[ExistingStreet]) -> Result<ExistingReport> {
        let mut report = ExistingReport::default();
        let mut losses: Vec<(usize, ExistingLoss)> = Vec::new();
        let mut order: Vec<usize> = (0..streets.len()).collect();
        let rank = |street: &usize| {
            let StreetAttributes { level, depth, .. } = streets[*street].attributes;
            (level.abs(), level, depth)
        };
        let width = |street: &usize| streets[*street].attributes.width;
        order.sort_by(|a, b| rank(a).cmp(&rank(b)).then(width(b).total_cmp(&width(a))).then(a.cmp(b)));
        let mut strands = Vec::new();
        for street in order {
            strands.extend(strands_of(street, &streets[street], &mut report.asked, &mut losses));
        }
        // Segments already in the network take precedence.
        let (given, mut all) = self.take_pieces();
        all.extend(
            strands.into_iter().map(|strand| StreetStrand { street: strand.street + given.len(), ..strand }),
        );
        let given: Vec<StrandSource> =
            given.into_iter().chain(streets.iter().map(StrandSource::of)).collect();
        snap(&mut all);
        let unresolved = node(&mut all);
        self.add_strands(&given, &all, &unresolved, &mut losses)?;
        losses.sort_by_key(|(street, _)| *street);
        report.losses = losses.into_iter().map(|(_, loss)| loss).collect();
        Ok(report)
    }

    /// Removes all segments from the network; returns them as streets and strands.
    fn take_pieces(&mut self) -> (Vec<StrandSource<'static>>, Vec<StreetStrand>) {
        let pieces: Vec<PieceId> = self.pieces().map(|(piece, _)| piece).collect();
        let (mut given, mut strands) = (Vec::new(), Vec::new());
        for piece in pieces {
            let StreetPiece { attributes, is_bridge, is_existing, .. } = self.pieces[piece as usize];
            let places = self.grid_line(piece).to_vec();
            let (street, length) = (given.len(), self.length(piece));
            given.push(StrandSource { attributes, is_bridge, is_existing, name: "" });
            strands.push(StreetStrand { street, level: attributes.level, length, places });
        }
        (0..self.pieces.len()).for_each(|piece| self.take_out(piece));
        (given, strands)
    }

    /// Adds the segments of strands that meet only at their vertices.
    fn add_strands(
        &mut self,
        streets: &[StrandSource<'_>],
        strands: &[StreetStrand],
        unresolved: &[(usize, usize)],
        losses: &mut Vec<(usize, ExistingLoss)>,
    ) -> Result<()> {
        let bare: Vec<u32> =
            (0..).zip(&self.junctions).filter(|(_, it)| it.pieces.is_empty()).map(|(id, _)| id).collect();
        let mut known: FxHashSet<(i32, [GridPlace; 2])> = FxHashSet::default();
        for (number, strand) in strands.iter().enumerate() {
            let StrandSource { attributes, is_bridge, is_existing, name } = &streets[strand.street];
            let mut lost = |place: Option<&GridPlace>, length: f64, why: ExistingLossReason| {
                let (name, at) = ((*name).to_owned(), place.map(|place| place.metres()));
                losses.push((strand.street, ExistingLoss { name, at, length, why }));
            };
            if strand.places.len() < 2 {
                lost(strand.places.first(), strand.length, ExistingLossReason::NoLength);
            }
            for (segment, pair) in strand.places.windows(2).enumerate() {
                let (a, b) = (pair[0], pair[1]);
                if unresolved.binary_search(&(number, segment)).is_ok() {
                    lost(Some(&a), a.metres().distance(b.metres()), ExistingLossReason::Unresolved);
                    continue;
                }
                if a == b || !known.insert((strand.level, [a.min(b), a.max(b)])) {
                    continue;
                }
                if self.size() >= self.constraints.max_segments {
                    let most = self.constraints.max_segments;
                    return Err(Error::limit(
                        Limit::Size,
                        format!("the existing streets have more than {most} segments, which is the limit"),
                    )
                    .help("omit some streets, or raise network { max_segments = ... }"));
                }
                let ends = [a, b].map(|end| self.junction(end));
                let piece = self.add(ends, *attributes, *is_bridge);
                self.pieces[piece as usize].is_existing = *is_existing;
                self.has_existing |= *is_existing;
            }
        }
        for junction in &bare {
            self.move_onto_street(*junction, &bare);
        }
        Ok(())
    }

    /// Moves a junction without streets onto the nearest street within [`END`], if there is one.
    fn move_onto_street(&mut self, junction: u32, bare: &[u32]) {
        if !self.junctions[junction as usize].pieces.is_empty() {
            return;
        }
        let at = self.at(junction);
        let Some((piece, _)) = self.nearest_on_ground(at).filter(|(_, distance)| *distance <= END) else {
            return;
        };
        let line = self.line(piece);
        let on = line[0].lerp(line[1], foot(at, line).1);
        let near = self.ends(piece).into_iter().find(|end| self.at(*end).distance(on) <= END);
        if let Some(near) = near {
            if !bare.contains(&near) {
                self.replace_junction(junction, near);
            }
        } else if let Some(place) = GridPlace::nearest(on) {
            self.relocate(junction, place);
            self.divide(piece, place);
        }
    }
}

/// Street that a strand is part of.
struct StrandSource<'a> {
    attributes: StreetAttributes,
    is_bridge: bool,
    is_existing: bool,
    name: &'a str,
}

impl<'a> StrandSource<'a> {
    fn of(street: &'a ExistingStreet) -> Self {
        let ExistingStreet { attributes, is_bridge, name, .. } = street;
        Self { attributes: *attributes, is_bridge: *is_bridge, is_existing: true, name }
    }
}

/// Converts the usable positions of a street to strands on the grid.
fn strands_of(
    number: usize,
    street: &ExistingStreet,
    asked: &mut f64,
    losses: &mut Vec<(usize, ExistingLoss)>,
) -> Vec<StreetStrand> {
    let mut lost = |at: Option<DVec2>, length: f64, why: ExistingLossReason| {
        losses.push((number, ExistingLoss { name: street.name.clone(), at, length, why }));
    };
    let parts = street.line.split(|at| GridPlace::nearest(*at).is_none());
    let parts: Vec<&[DVec2]> = parts.filter(|part| !part.is_empty()).collect();
    if parts.iter().map(|part| part.len()).sum::<usize>() < street.line.len() {
        lost(parts.first().and_then(|part| part.last().copied()), f64::INFINITY, ExistingLossReason::Outside);
    }
    if street.line.is_empty() {
        lost(None, 0.0, ExistingLossReason::NoLength);
    }
    let mut strands = Vec::new();
    for part in parts {
        let length: f64 = part.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        *asked += length;
        let mut places: Vec<GridPlace> = part.iter().filter_map(|at| GridPlace::nearest(*at)).collect();
        places.dedup();
        let low = part.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = part.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        if places.len() < 2 || low.distance(high) < LEAST {
            lost(part.first().copied(), length, ExistingLossReason::NoLength);
        } else {
            strands.push(StreetStrand { street: number, level: street.attributes.level, length, places });
        }
    }
    strands
}

/// Minimum extent (m); a smaller part collapses to a single position.
const LEAST: f64 = 0.04;
