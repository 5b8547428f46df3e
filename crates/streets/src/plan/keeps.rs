//! Constraint checks for a street between two positions: distances, angles, space for corners.

use smallvec::SmallVec;

use super::constraints::Refusal;
use super::corner::{Arm, turn};
use super::grid::{GridPlace, foot, touch};
use super::network::{JunctionId, PieceId, StreetAttributes, StreetNetwork};

/// Tolerance (degrees) of the minimum angle for a new street: both ends are rounded to the grid.
const ROUNDING: f64 = 0.01;
/// Tolerance (m) for corners that take more of a street than before a new street was added.
const EVEN: f64 = 1e-6;

/// Possible end of a street.
#[derive(Debug, Clone, Copy)]
pub(crate) enum StreetEnd {
    /// Existing junction.
    Junction(JunctionId),
    /// Position on a segment.
    On(PieceId, GridPlace),
    /// Position without a junction or street.
    Free(GridPlace),
}

impl StreetNetwork {
    /// Returns the position of the end of a street.
    pub(crate) fn place_of(&self, end: StreetEnd) -> GridPlace {
        match end {
            StreetEnd::Junction(junction) => self.junctions[junction as usize].place,
            StreetEnd::On(_, place) | StreetEnd::Free(place) => place,
        }
    }

    /// Tests whether a street from a junction to an end meets all constraints; counts the examined neighbours.
    pub(crate) fn test(
        &self,
        from: JunctionId,
        end: StreetEnd,
        attributes: StreetAttributes,
        looked_at: &mut u64,
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
        self.test_distances(from, end, divided, places, attributes.width, looked_at)?;
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

    /// Fails if a street that is not joined is too close.
    fn test_distances(
        &self,
        from: JunctionId,
        end: StreetEnd,
        divided: Option<PieceId>,
        places: [GridPlace; 2],
        width: f64,
        looked_at: &mut u64,
    ) -> std::result::Result<(), Refusal> {
        let line = places.map(GridPlace::metres);
        let to = if let StreetEnd::Junction(junction) = end { Some(junction) } else { None };
        let most = self.constraints.clearance + width / 2.0 + self.widest() / 2.0;
        for piece in self.ground_near(line, most) {
            *looked_at += 1;
            let ends = self.ends(piece);
            let of_end = to.is_some_and(|to| ends.contains(&to));
            if ends.contains(&from) || of_end {
                // Streets at one junction are separated by their angle; no two streets join the same two junctions.
                if ends.contains(&from) && of_end {
                    return Err(Refusal::Angle);
                }
                continue;
            }
            if divided == Some(piece) {
                continue;
            }
            if touch(places, self.grid_line(piece)) {
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

    /// Returns the streets at a junction, with their lengths and the space taken at their far ends.
    fn measured_arms(&self, junction: JunctionId) -> Arms {
        let arms = self.corner_arms(junction).into_iter();
        let measured = arms.map(|(piece, arm)| {
            let far = self.reach_at(self.across(piece, junction), piece);
            MeasuredArm { arm, length: self.length(piece), far }
        });
        measured.collect()
    }

    /// Returns the length (m) of a segment that the corners at one of its junctions take.
    pub(crate) fn reach_at(&self, junction: JunctionId, piece: PieceId) -> f64 {
        let arms = self.corner_arms(junction);
        let index = arms.iter().position(|(arm, _)| *arm == piece);
        let arms: SmallVec<[Arm; 6]> = arms.into_iter().map(|(_, arm)| arm).collect();
        index.map_or(0.0, |index| self.reaches(&arms)[index])
    }

    /// Tests the angles and corners of a junction after adding an arm; returns the length (m) of that arm that its
    /// corners take.
    fn test_corners(&self, mut arms: Arms, new: Arm) -> std::result::Result<f64, Refusal> {
        let least = (self.constraints.min_angle - ROUNDING).to_radians();
        let too_sharp = |known: &MeasuredArm| {
            let angle = turn(new.way, known.arm.way);
            angle.min(std::f64::consts::TAU - angle) < least
        };
        if arms.iter().any(too_sharp) {
            return Err(Refusal::Angle);
        }
        let bare = |arms: &Arms| -> SmallVec<[Arm; 6]> { arms.iter().map(|known| known.arm).collect() };
        arms.sort_by(|a, b| a.arm.way.to_angle().total_cmp(&b.arm.way.to_angle()));
        let before = self.reaches(&bare(&arms));
        let place = arms.partition_point(|known| known.arm.way.to_angle() < new.way.to_angle());
        arms.insert(place, MeasuredArm { arm: new, length: f64::INFINITY, far: 0.0 });
        let after = self.reaches(&bare(&arms));
        arms.remove(place);
        let of_others =
            after.iter().enumerate().filter(|(index, _)| *index != place).map(|(_, reach)| *reach);
        for ((known, before), after) in arms.iter().zip(before).zip(of_others) {
            // An existing street without space for its corners may not lose more than before.
            if after + known.far > known.length && after > before + EVEN {
                return Err(Refusal::Corners);
            }
        }
        Ok(after[place])
    }

    /// Returns true if a segment can be divided at a position: both halves are long enough, including the corners at
    /// their ends; all angles at the ends are kept; and no other street crosses the halves.
    pub(crate) fn can_divide(&self, piece: PieceId, place: GridPlace) -> bool {
        let ends = self.ends(piece);
        if self.junction_at(place).is_some() {
            return false;
        }
        let at = place.metres();
        let least = self.constraints.least_angle().to_radians();
        ends.into_iter().all(|end| {
            let to = self.at(end);
            let way = (at - to).normalize_or_zero();
            let angles = self.junctions[end as usize].pieces.iter().filter(|arm| **arm != piece).map(|arm| {
                let angle = turn(way, self.leaves(*arm, end));
                angle.min(std::f64::consts::TAU - angle)
            });
            let half = [place, self.junctions[end as usize].place];
            let crosses = || {
                self.ground_near(half.map(GridPlace::metres), 0.01).any(|other| {
                    other != piece && !self.ends(other).contains(&end) && touch(half, self.grid_line(other))
                })
            };
            at.distance(to) >= self.constraints.min_length.max(self.reach_at(end, piece))
                && angles.fold(4.0, f64::min) >= least
                && !crosses()
        })
    }
}

type Arms = SmallVec<[MeasuredArm; 6]>;

/// Street at a junction.
#[derive(Debug, Clone, Copy)]
struct MeasuredArm {
    arm: Arm,
    /// Length (m) to the next junction.
    length: f64,
    /// Length (m) that the corners at the far end take.
    far: f64,
}
