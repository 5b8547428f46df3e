//! Growth: what becomes of a street that is proposed.
//!
//! In order: obstacles, the first street or junction in its way, a junction near its end, a street near its end, and
//! its end as proposed. Whatever of these comes first and keeps all constraints is built.
//!
//! After: Y. Parish and P. Müller, "Procedural modeling of cities", 2001.

use glam::DVec2;
use smallvec::SmallVec;

use crate::constraints::{Constraints, Fate, Refusal};
use crate::corner::{Arm, turn};
use crate::grid::{GridPlace, crossing, foot, meet};
use crate::network::{JunctionId, PieceId, StreetAttributes, StreetNetwork};
use burgeon_base::error::{Error, Limit, Result};

/// Junctions may come out nearer by this angle (degrees) than was asked, for a piece that is divided turns a little.
const TURN_OF_DIVISION: f64 = 0.05;
/// By how much (degrees) a street turns more at each try to pass an obstacle.
const BEND_STEP: f64 = 5.0;

/// What became of a proposal, and the junction that its street ends at.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct StreetGrowth {
    /// What became of it.
    pub fate: Fate,
    /// Where it ends; where it would have begun if it was refused.
    pub end: JunctionId,
}

/// Where a street could end.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StreetEnd {
    /// At a junction that is there.
    Junction(JunctionId),
    /// On a piece, at this place.
    On(PieceId, GridPlace),
    /// At a place where nothing is.
    Free(GridPlace),
}

impl StreetNetwork {
    /// A place for a street to begin: a junction that is there, one on a street within half a metre, or a new one.
    ///
    /// Fails if the place is not finite, too far away, or lies in an obstacle.
    pub fn begin(&mut self, place: DVec2) -> Result<JunctionId> {
        let Some(on_grid) = GridPlace::nearest(place) else {
            return Err(Error::argument(format!("{place} is no place for a street"))
                .help("places are finite, and within 500 km of the origin"));
        };
        if self.obstacles.at(place).is_some() {
            return Err(Error::argument(format!(
                "a street cannot begin at {place}, for an obstacle is there"
            ))
            .help("begin elsewhere, or leave the obstacle out"));
        }
        if let Some(found) = self.junction_at(on_grid) {
            return Ok(found);
        }
        match self.nearest(place) {
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

    /// Proposes a street from a junction to a place, and builds what the constraints leave of it.
    ///
    /// Fails if the network has as many pieces as it may have.
    pub fn grow(
        &mut self,
        from: JunctionId,
        to: DVec2,
        attributes: StreetAttributes,
    ) -> Result<StreetGrowth> {
        if self.size() >= self.constraints.most {
            let most = self.constraints.most;
            return Err(Error::limit(Limit::Size, format!("the network has {most} pieces of streets"))
                .help("let fewer streets grow, or raise the limit: network { most = ... }"));
        }
        let refused = |refusal| StreetGrowth { fate: Fate::Refused(refusal), end: from };
        if GridPlace::nearest(to).is_none() {
            return Ok(refused(Refusal::Outside));
        }
        let start = self.at(from);
        let mut first = None;
        for (target, fate, is_bridge) in self.around_obstacles(start, to, attributes.width) {
            let candidates = match target {
                Ok(target) => self.candidates(from, target, attributes),
                Err(refusal) => {
                    first.get_or_insert(refusal);
                    continue;
                }
            };
            for (end, of_end) in candidates {
                match self.test(from, end, attributes) {
                    Ok(()) => {
                        let end = self.build(from, end, attributes, is_bridge);
                        let fate = if of_end == Fate::Built { fate } else { of_end };
                        return Ok(StreetGrowth { fate, end });
                    }
                    Err(refusal) => {
                        first.get_or_insert(refusal);
                    }
                }
            }
        }
        Ok(refused(first.unwrap_or(Refusal::TooShort)))
    }

    /// Joins two ends without looking for others; tells why not if a constraint is broken.
    pub(crate) fn connect(
        &mut self,
        from: JunctionId,
        end: StreetEnd,
        attributes: StreetAttributes,
    ) -> std::result::Result<JunctionId, Refusal> {
        let line = [self.at(from), self.place_of(end).metres()];
        if self.obstacles.first_on(line, attributes.width).is_some() {
            return Err(Refusal::Obstacle);
        }
        self.test(from, end, attributes)?;
        Ok(self.build(from, end, attributes, false))
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

    /// Where a street may lead that obstacles let through: straight, over a bridge, beside them, or up to them.
    fn around_obstacles(&self, from: DVec2, to: DVec2, width: f64) -> SmallVec<[ProposedWay; 4]> {
        let mut ways = SmallVec::new();
        let Some((along, obstacle)) = self.obstacles.first_on([from, to], width) else {
            ways.push((Ok(to), Fate::Built, false));
            return ways;
        };
        let refusal = if obstacle.is_limit { Refusal::Outside } else { Refusal::Obstacle };
        let Constraints { bend, bridge, min_length, .. } = self.constraints;
        let (way, length) = (to - from, from.distance(to));
        if bridge > 0.0 && obstacle.can_be_bridged && length > 0.0 {
            let far = from + way / length * (along * length + bridge + min_length);
            if let Some(beyond) = self.obstacles.beyond([from, far], width) {
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
        if short >= min_length {
            ways.push((Ok(from + way * (short / length)), Fate::Shortened, false));
        }
        ways.push((Err(refusal), Fate::Refused(refusal), false));
        ways
    }

    /// Where a street to `to` could end, the best first.
    fn candidates(
        &mut self,
        from: JunctionId,
        to: DVec2,
        attributes: StreetAttributes,
    ) -> SmallVec<[(StreetEnd, Fate); 8]> {
        let start = self.at(from);
        let snap = self.constraints.snap;
        let mut ends: SmallVec<[(StreetEnd, Fate); 8]> = SmallVec::new();
        let (way, length) = (to - start, start.distance(to));
        if length.is_nan() || length == 0.0 {
            return ends;
        }
        let ahead = to + way / length * snap;
        let near: SmallVec<[PieceId; 16]> = self.pieces_near([start, ahead], snap).collect();
        // The first street in the way, and a little beyond the end.
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
        // Junctions that it would pass too near, or that are near its end.
        let half = attributes.width / 2.0;
        let until = start + way * reach.min(1.0);
        let mut junctions: SmallVec<[(f64, JunctionId); 8]> = SmallVec::new();
        let mut looked_at = near.len() as u64;
        for junction in self.junctions_near([start, until], snap) {
            looked_at += 1;
            if junction == from || self.junctions[junction as usize].pieces.is_empty() {
                continue;
            }
            let place = self.at(junction);
            let (aside, along) = foot(place, [start, until]);
            let too_near = aside < self.constraints.clearance + half + self.widest_at(junction) / 2.0;
            let end = place.distance(until);
            if end <= snap {
                junctions.push((along + end / snap * 0.25, junction));
            } else if too_near {
                junctions.push((along, junction));
            }
        }
        self.looked_at += looked_at;
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

    /// The width (m) of the widest street at a junction.
    pub(crate) fn widest_at(&self, junction: JunctionId) -> f64 {
        let pieces = &self.junctions[junction as usize].pieces;
        pieces.iter().map(|piece| self.pieces[*piece as usize].attributes.width).fold(0.0, f64::max)
    }

    pub(crate) fn place_of(&self, end: StreetEnd) -> GridPlace {
        match end {
            StreetEnd::Junction(junction) => self.junctions[junction as usize].place,
            StreetEnd::On(_, place) | StreetEnd::Free(place) => place,
        }
    }

    /// Whether a street from a junction to an end keeps all constraints.
    pub(crate) fn test(
        &self,
        from: JunctionId,
        end: StreetEnd,
        attributes: StreetAttributes,
    ) -> std::result::Result<(), Refusal> {
        let places = [self.junctions[from as usize].place, self.place_of(end)];
        let line = places.map(GridPlace::metres);
        let length = line[0].distance(line[1]);
        if length < self.constraints.min_length {
            return Err(Refusal::TooShort);
        }
        let divided = match end {
            StreetEnd::On(piece, place) => {
                if self.ends(piece).contains(&from) {
                    return Err(Refusal::Angle);
                }
                if !self.can_divide(piece, place) {
                    return Err(Refusal::TooShort);
                }
                Some(piece)
            }
            StreetEnd::Junction(junction) => {
                if junction == from {
                    return Err(Refusal::TooShort);
                }
                None
            }
            StreetEnd::Free(_) => None,
        };
        self.test_distances(from, end, divided, places, attributes.width)?;
        let way = (line[1] - line[0]) / length;
        let here = self.measured_arms(from);
        let there = match end {
            StreetEnd::Junction(junction) => self.measured_arms(junction),
            StreetEnd::On(piece, place) => {
                let at = place.metres();
                let halves = self.ends(piece).map(|far| {
                    let to = self.at(far);
                    let arm = self.attributes(piece).arm((to - at).normalize_or_zero());
                    MeasuredArm { arm, length: at.distance(to), far: self.reach_at(far, piece) }
                });
                halves.into_iter().collect()
            }
            StreetEnd::Free(_) => Arms::new(),
        };
        let here_reach = self.test_corners(here, attributes.arm(way))?;
        let there_reach = self.test_corners(there, attributes.arm(-way))?;
        if here_reach + there_reach > length { Err(Refusal::Corners) } else { Ok(()) }
    }

    /// Whether nothing that the street does not join is too near it.
    fn test_distances(
        &self,
        from: JunctionId,
        end: StreetEnd,
        divided: Option<PieceId>,
        places: [GridPlace; 2],
        width: f64,
    ) -> std::result::Result<(), Refusal> {
        let line = places.map(GridPlace::metres);
        let to = if let StreetEnd::Junction(junction) = end { Some(junction) } else { None };
        let most = self.constraints.clearance + width / 2.0 + self.widest() / 2.0;
        for piece in self.pieces_near(line, most) {
            let ends = self.ends(piece);
            let of_end = to.is_some_and(|to| ends.contains(&to));
            if ends.contains(&from) || of_end {
                // Streets of one junction part by their angle; two do not lead to the same two junctions.
                if ends.contains(&from) && of_end {
                    return Err(Refusal::Angle);
                }
                continue;
            }
            if divided == Some(piece) {
                continue;
            }
            if meet(places, self.grid_line(piece)) {
                return Err(Refusal::TooNear);
            }
            let apart =
                self.constraints.clearance + (width + self.pieces[piece as usize].attributes.width) / 2.0;
            let other = self.line(piece);
            let nearest = [
                foot(line[0], other).0,
                foot(line[1], other).0,
                foot(other[0], line).0,
                foot(other[1], line).0,
            ];
            if nearest.into_iter().any(|distance| distance < apart) {
                return Err(Refusal::TooNear);
            }
        }
        Ok(())
    }

    /// The streets at a junction.
    fn measured_arms(&self, junction: JunctionId) -> Arms {
        let arms = self.corner_arms(junction).into_iter();
        let measured = arms.map(|(piece, arm)| {
            let far = self.reach_at(self.across(piece, junction), piece);
            MeasuredArm { arm, length: self.length(piece), far }
        });
        measured.collect()
    }

    /// How much of a piece (m) the corners of one of its junctions take.
    pub(crate) fn reach_at(&self, junction: JunctionId, piece: PieceId) -> f64 {
        let arms = self.corner_arms(junction);
        let index = arms.iter().position(|(arm, _)| *arm == piece);
        let arms: SmallVec<[Arm; 6]> = arms.into_iter().map(|(_, arm)| arm).collect();
        index.map_or(0.0, |index| self.reaches(&arms)[index])
    }

    /// Tests the angles and the corners of a junction to which an arm comes; gives how much of that its corners take.
    fn test_corners(&self, mut arms: Arms, new: Arm) -> std::result::Result<f64, Refusal> {
        let least = (self.constraints.min_angle + TURN_OF_DIVISION).to_radians();
        let too_sharp = |known: &MeasuredArm| {
            let angle = turn(new.way, known.arm.way);
            angle.min(std::f64::consts::TAU - angle) < least
        };
        if arms.iter().any(too_sharp) {
            return Err(Refusal::Angle);
        }
        arms.push(MeasuredArm { arm: new, length: f64::INFINITY, far: 0.0 });
        arms.sort_by(|a, b| a.arm.way.to_angle().total_cmp(&b.arm.way.to_angle()));
        let bare: SmallVec<[Arm; 6]> = arms.iter().map(|known| known.arm).collect();
        let mut own = 0.0;
        for (known, reach) in arms.iter().zip(self.reaches(&bare)) {
            if known.length.is_infinite() {
                own = reach;
            } else if reach + known.far > known.length {
                return Err(Refusal::Corners);
            }
        }
        Ok(own)
    }

    /// Whether both halves of a piece that is divided there are long enough, and turn so little that all angles at its
    /// ends stay, and nothing comes to lie on them.
    pub(crate) fn can_divide(&self, piece: PieceId, place: GridPlace) -> bool {
        let ends = self.ends(piece);
        if self.junction_at(place).is_some() {
            return false;
        }
        let at = place.metres();
        let least = self.constraints.min_angle.to_radians();
        ends.into_iter().all(|end| {
            let to = self.at(end);
            let way = (at - to).normalize_or_zero();
            let angles = self.junctions[end as usize].pieces.iter().filter(|arm| **arm != piece).map(|arm| {
                let angle = turn(way, self.leaves(*arm, end));
                angle.min(std::f64::consts::TAU - angle)
            });
            let half = [place, self.junctions[end as usize].place];
            let crosses = || {
                self.pieces_near(half.map(GridPlace::metres), 0.01).any(|other| {
                    other != piece && !self.ends(other).contains(&end) && meet(half, self.grid_line(other))
                })
            };
            at.distance(to) >= self.constraints.min_length
                && angles.fold(4.0, f64::min) >= least
                && !crosses()
        })
    }
}

/// Where a street may lead, what that makes of it, and whether it is a bridge.
type ProposedWay = (std::result::Result<DVec2, Refusal>, Fate, bool);

type Arms = SmallVec<[MeasuredArm; 6]>;

/// A street at a junction.
#[derive(Debug, Clone, Copy)]
struct MeasuredArm {
    arm: Arm,
    /// Its length (m) to the next junction.
    length: f64,
    /// How much of that (m) the corners at the other end take.
    far: f64,
}
