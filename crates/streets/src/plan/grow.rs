//! Growth: decides the outcome of a proposed street.
//!
//! Candidates are tried in this order: obstacles, the first street or junction in the path, a junction near the end, a
//! street near the end, and the end as proposed. The first candidate that meets all constraints is built.
//!
//! Source: Y. Parish and P. Müller, "Procedural modeling of cities", 2001.

use glam::DVec2;
use smallvec::SmallVec;

use super::constraints::{Constraints, Fate, Refusal};
use super::grid::{GridPlace, crossing, foot};
use super::keeps::StreetEnd;
use super::network::{JunctionId, PieceId, StreetAttributes, StreetNetwork};
use burgeon_base::error::{Error, Limit, Result};

/// Increment (degrees) of the turn at each attempt to avoid an obstacle.
const BEND_STEP: f64 = 5.0;

/// Outcome of a proposal, and the end junction of the street.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StreetGrowth {
    /// Outcome of the proposal.
    pub fate: Fate,
    /// End junction; the start junction if the street was refused.
    pub end: JunctionId,
}

/// Predicted outcome of a street that is not built.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StreetProspect {
    /// Outcome that a proposal would have.
    pub fate: Fate,
    /// End position (m); the start position if the street would be refused.
    pub place: DVec2,
    /// End junction, if it already exists.
    pub junction: Option<JunctionId>,
}

impl StreetNetwork {
    /// Returns a junction to start a street from: an existing junction, a junction on a street within 0.5 m, or a new
    /// one.
    ///
    /// Fails if the position is not finite, too far from the origin, or in an obstacle.
    pub fn begin(&mut self, place: DVec2) -> Result<JunctionId> {
        let Some(on_grid) = GridPlace::nearest(place) else {
            return Err(Error::argument(format!("invalid street position {place}"))
                .help("use finite positions within 500 km of the origin"));
        };
        match self.obstacles.at(place) {
            Some(area) if area.is_limit => {
                let text = format!("street start {place} is outside the limit");
                return Err(Error::argument(text).help("start inside the limit, or enlarge it"));
            }
            Some(area) => {
                let (what, remedy) = if area.can_be_bridged {
                    ("in water", "start next to the water: bridges cross it")
                } else {
                    ("in an obstacle", "start elsewhere, or remove the obstacle")
                };
                let text = format!("street start {place} is {what}");
                return Err(Error::argument(text).help(remedy));
            }
            None => {}
        }
        if let Some(found) = self.junction_at(on_grid) {
            return Ok(found);
        }
        match self.nearest_on_ground(place) {
            Some((piece, distance)) if distance < 0.5 => {
                let (_, along) = foot(place, self.line(piece));
                let [a, b] = self.line(piece);
                let on = a + (b - a) * along;
                Ok(match GridPlace::nearest(on) {
                    Some(on) if self.can_divide(piece, on) => self.divide(piece, on),
                    _ => {
                        let ends = self.ends(piece);
                        let [near, far] = ends.map(|end| self.at(end).distance(place));
                        if near <= far { ends[0] } else { ends[1] }
                    }
                })
            }
            _ => Ok(self.junction(on_grid)),
        }
    }

    /// Proposes a street from a junction to a position, and builds it as far as the constraints allow.
    ///
    /// Fails if the network already has the maximum number of segments.
    pub fn grow(
        &mut self,
        from: JunctionId,
        to: DVec2,
        attributes: StreetAttributes,
    ) -> Result<StreetGrowth> {
        if self.size() >= self.constraints.max_segments {
            let most = self.constraints.max_segments;
            return Err(Error::limit(
                Limit::Size,
                format!("the network has {most} street segments, which is the limit"),
            )
            .help("grow fewer streets, or raise network { max_segments = ... }"));
        }
        let mut looked_at = 0;
        let planned = self.plan(from, to, attributes, &mut looked_at);
        self.looked_at += looked_at;
        Ok(match planned {
            Ok(PlannedStreet { end, fate, is_bridge }) => {
                StreetGrowth { fate, end: self.build(from, end, attributes, is_bridge) }
            }
            Err(refusal) => StreetGrowth { fate: Fate::Refused(refusal), end: from },
        })
    }

    /// Predicts the outcome of a street from a junction to a position, without building it.
    ///
    /// ```
    /// use burgeon_streets::{Constraints, Fate, Obstacles, StreetAttributes, StreetNetwork};
    /// use glam::DVec2;
    ///
    /// let mut network = StreetNetwork::new(Constraints::default(), Obstacles::default())?;
    /// let street = StreetAttributes { width: 10.0, ..StreetAttributes::default() };
    /// let start = network.begin(DVec2::ZERO)?;
    /// network.grow(start, DVec2::new(200.0, 0.0), street)?;
    /// let aside = network.begin(DVec2::new(100.0, 80.0))?;
    /// // The street would end 5 m before the other street.
    /// let prospect = network.probe(aside, DVec2::new(100.0, 5.0), street);
    /// assert_eq!((prospect.fate, prospect.place), (Fate::Joined, DVec2::new(100.0, 0.0)));
    /// assert_eq!(network.size(), 1);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn probe(&self, from: JunctionId, to: DVec2, attributes: StreetAttributes) -> StreetProspect {
        match self.plan(from, to, attributes, &mut 0) {
            Ok(PlannedStreet { end, fate, .. }) => {
                let junction = if let StreetEnd::Junction(junction) = end { Some(junction) } else { None };
                StreetProspect { fate, place: self.place_of(end).metres(), junction }
            }
            Err(refusal) => {
                StreetProspect { fate: Fate::Refused(refusal), place: self.at(from), junction: None }
            }
        }
    }

    /// Plans a street within the constraints; adds the number of examined neighbours to `looked_at`.
    fn plan(
        &self,
        from: JunctionId,
        to: DVec2,
        attributes: StreetAttributes,
        looked_at: &mut u64,
    ) -> std::result::Result<PlannedStreet, Refusal> {
        if GridPlace::nearest(to).is_none() {
            return Err(Refusal::Outside);
        }
        let start = self.at(from);
        let mut first = None;
        for (target, of_way, may_bridge) in self.around_obstacles(start, to, attributes.width) {
            let candidates = match target {
                Ok(target) => self.candidates(from, target, attributes, looked_at),
                Err(refusal) => {
                    first.get_or_insert(refusal);
                    continue;
                }
            };
            for (end, of_end) in candidates {
                // The snap target may be behind an obstacle even if the proposed path is free.
                let planned =
                    self.passes_obstacles(from, end, attributes.width, may_bridge).and_then(|is_bridge| {
                        self.test(from, end, attributes, looked_at)?;
                        let fate = if of_end == Fate::Built { of_way } else { of_end };
                        Ok(PlannedStreet { end, fate, is_bridge })
                    });
                match planned {
                    Ok(planned) => return Ok(planned),
                    Err(refusal) => {
                        first.get_or_insert(refusal);
                    }
                }
            }
        }
        Err(first.unwrap_or(Refusal::TooShort))
    }

    /// Returns `false` if a street avoids all obstacles and `true` if it must bridge one; fails if neither is possible.
    fn passes_obstacles(
        &self,
        from: JunctionId,
        end: StreetEnd,
        width: f64,
        may_bridge: bool,
    ) -> std::result::Result<bool, Refusal> {
        let line = [self.at(from), self.place_of(end).metres()];
        let Some((along, obstacle)) = self.obstacles.first_on(line, width) else { return Ok(false) };
        let length = line[0].distance(line[1]);
        let bridges = |beyond: f64| (beyond - along) * length <= self.constraints.bridge;
        if may_bridge && along > 0.0 && self.obstacles.bridged_until(line, width).is_some_and(bridges) {
            return Ok(true);
        }
        Err(if obstacle.is_limit { Refusal::Outside } else { Refusal::Obstacle })
    }

    /// Builds a street between two ends without searching for other ends; returns the refusal if a constraint is
    /// violated.
    pub(crate) fn connect(
        &mut self,
        from: JunctionId,
        end: StreetEnd,
        attributes: StreetAttributes,
    ) -> std::result::Result<JunctionId, Refusal> {
        self.passes_obstacles(from, end, attributes.width, false)?;
        let mut looked_at = 0;
        let tested = self.test(from, end, attributes, &mut looked_at);
        self.looked_at += looked_at;
        tested.map(|()| self.build(from, end, attributes, false))
    }

    fn build(
        &mut self,
        from: JunctionId,
        end: StreetEnd,
        attributes: StreetAttributes,
        is_bridge: bool,
    ) -> JunctionId {
        let end = match end {
            StreetEnd::Junction(junction) => junction,
            StreetEnd::On(piece, place) => self.divide(piece, place),
            StreetEnd::Free(place) => self.junction(place),
        };
        self.add([from, end], attributes, is_bridge);
        end
    }

    /// Returns possible targets with respect to obstacles: straight ahead, over a bridge, past the obstacle, or up to
    /// it.
    fn around_obstacles(&self, from: DVec2, to: DVec2, width: f64) -> SmallVec<[ProposedWay; 4]> {
        let mut ways = SmallVec::new();
        let Some((along, obstacle)) = self.obstacles.first_on([from, to], width) else {
            ways.push((Ok(to), Fate::Built, false));
            return ways;
        };
        let refusal = if obstacle.is_limit { Refusal::Outside } else { Refusal::Obstacle };
        let Constraints { bend, bridge, min_length, shorten, .. } = self.constraints;
        let (way, length) = (to - from, from.distance(to));
        if bridge > 0.0 && obstacle.can_be_bridged && length > 0.0 {
            let far = from + way / length * (along * length + bridge + min_length);
            if let Some(beyond) = self.obstacles.bridged_until([from, far], width) {
                let over = from + (far - from) * beyond + way / length * min_length;
                if (beyond * from.distance(far) - along * length) <= bridge
                    && self.obstacles.at(over).is_none()
                {
                    ways.push((Ok(over), Fate::Built, true));
                }
            }
        }
        let mut angle = BEND_STEP;
        while angle <= bend {
            for turned in [angle, -angle] {
                let beside = from + DVec2::from_angle(turned.to_radians()).rotate(way);
                if self.obstacles.first_on([from, beside], width).is_none() {
                    ways.push((Ok(beside), Fate::Bent, false));
                }
            }
            angle += BEND_STEP;
        }
        let short = along * length - 1.0;
        if shorten && short >= min_length {
            ways.push((Ok(from + way * (short / length)), Fate::Shortened, false));
        }
        ways.push((Err(refusal), Fate::Refused(refusal), false));
        ways
    }

    /// Returns possible ends of a street to `to`, best first.
    fn candidates(
        &self,
        from: JunctionId,
        to: DVec2,
        attributes: StreetAttributes,
        looked_at: &mut u64,
    ) -> SmallVec<[(StreetEnd, Fate); 8]> {
        let start = self.at(from);
        let snap = self.constraints.snap;
        let mut ends: SmallVec<[(StreetEnd, Fate); 8]> = SmallVec::new();
        let (way, length) = (to - start, start.distance(to));
        if length.is_nan() || length == 0.0 {
            return ends;
        }
        let ahead = to + way / length * snap;
        let near: SmallVec<[PieceId; 16]> = self.ground_near([start, ahead], snap).collect();
        // The first street in the path, up to a short distance beyond the end.
        let crossed = near.iter().filter_map(|&piece| {
            let ends = self.ends(piece);
            if ends.contains(&from) {
                return None;
            }
            let line = self.line(piece);
            let along = crossing([start, ahead], line)?;
            let on = crossing(line, [start, ahead])?;
            let hits = (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&on);
            hits.then_some((along, piece))
        });
        let crossed = crossed.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let reach = crossed.map_or(1.0, |(along, _)| along * (length + snap) / length);
        // Junctions that the street would pass too closely, or that are near its end.
        let half = attributes.width / 2.0;
        let until = start + way * reach.min(1.0);
        let mut junctions: SmallVec<[(f64, JunctionId); 8]> = SmallVec::new();
        *looked_at += near.len() as u64;
        for junction in self.junctions_near([start, until], snap) {
            *looked_at += 1;
            if junction == from || !self.has_ground(junction) {
                continue;
            }
            let place = self.at(junction);
            let (aside, along) = foot(place, [start, until]);
            let too_near = aside < self.constraints.clearance + half + self.widest_at(junction) / 2.0;
            let end = place.distance(until);
            if end < snap {
                junctions.push((along + end / snap * 0.25, junction));
            } else if too_near {
                junctions.push((along, junction));
            }
        }
        junctions.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        ends.extend(
            junctions.iter().take(6).map(|(_, junction)| (StreetEnd::Junction(*junction), Fate::Snapped)),
        );
        if let Some((along, piece)) = crossed {
            if let Some(place) = GridPlace::nearest(start + (ahead - start) * along) {
                ends.push((StreetEnd::On(piece, place), Fate::Joined));
            }
        } else {
            let mut feet: SmallVec<[(f64, PieceId, DVec2); 8]> = SmallVec::new();
            for &piece in &near {
                if self.ends(piece).contains(&from) {
                    continue;
                }
                let line = self.line(piece);
                let (aside, on) = foot(to, line);
                if aside <= snap {
                    feet.push((aside, piece, line[0] + (line[1] - line[0]) * on));
                }
            }
            feet.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
            for (_, piece, place) in feet.into_iter().take(3) {
                ends.extend(
                    GridPlace::nearest(place).map(|place| (StreetEnd::On(piece, place), Fate::Joined)),
                );
            }
        }
        if crossed.is_none_or(|_| reach > 1.0) {
            ends.extend(GridPlace::nearest(to).map(|place| (StreetEnd::Free(place), Fate::Built)));
        }
        ends
    }

    /// Returns the width (m) of the widest street at a junction.
    pub(crate) fn widest_at(&self, junction: JunctionId) -> f64 {
        let pieces = &self.junctions[junction as usize].pieces;
        pieces.iter().map(|piece| self.pieces[*piece as usize].attributes.width).fold(0.0, f64::max)
    }
}

/// Street that meets all constraints.
#[derive(Debug, Clone, Copy)]
struct PlannedStreet {
    end: StreetEnd,
    fate: Fate,
    is_bridge: bool,
}

/// Target of a proposed street, its outcome, and whether a bridge is allowed.
type ProposedWay = (std::result::Result<DVec2, Refusal>, Fate, bool);
