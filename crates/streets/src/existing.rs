//! Streets that are there before a network grows: those of a survey, whose lines cross, touch and repeat one another.
//!
//! They are laid like streets that are proposed, main streets first, so that all that a network promises holds for them
//! too. Lines that run side by side become one, crossings become junctions, and what keeps no constraint is left out.

use std::collections::BTreeMap;

use glam::DVec2;

use crate::constraints::{Fate, Refusal};
use crate::grid::{GridPlace, foot};
use crate::network::{JunctionId, StreetAttributes, StreetNetwork};
use burgeon_base::error::Result;

/// How far (m) a line may lie from a street that stands for it.
const TOLERANCE: f64 = 2.0;
/// How many streets one piece may cross.
const CROSSINGS: usize = 20;

/// A street that is there.
#[derive(Debug, Clone, PartialEq)]
pub struct ExistingStreet {
    /// Its places (m) one after another.
    pub line: Vec<DVec2>,
    /// What it is.
    pub attributes: StreetAttributes,
    /// Whether it leads over or under others, so that it has no junction where it crosses them.
    pub is_bridge: bool,
}

/// What became of pieces of existing streets that are not in the network, by how many they are.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ExistingLosses {
    /// Those with places that are not finite, or too far away.
    pub outside: usize,
    /// Those of bridges from where they would cross other streets: a network is planar.
    pub over: usize,
    /// Those that keep no constraint, by the reason.
    pub refused: BTreeMap<Refusal, usize>,
}

impl StreetNetwork {
    /// Adds streets that are there; says what was left out.
    ///
    /// Main streets come first, and bridges last. Lines are followed to within 2 m, by pieces of the least length or more.
    /// Fails if the network has as many pieces as it may have.
    pub fn add_existing(&mut self, streets: &[ExistingStreet]) -> Result<ExistingLosses> {
        let mut losses = ExistingLosses::default();
        let mut order: Vec<&ExistingStreet> = streets.iter().collect();
        order.sort_by_key(|street| (street.is_bridge, street.attributes.depth));
        for street in order {
            let known = street.line.iter().copied().filter(|at| GridPlace::nearest(*at).is_some());
            let known: Vec<DVec2> = known.collect();
            losses.outside += street.line.len() - known.len();
            let line = self.simplified(&known);
            if let [first, rest @ ..] = &line[..] {
                self.lay(*first, rest, street, &mut losses)?;
            }
        }
        Ok(losses)
    }

    /// Lays a street along some places.
    fn lay(
        &mut self,
        first: DVec2,
        rest: &[DVec2],
        street: &ExistingStreet,
        losses: &mut ExistingLosses,
    ) -> Result<()> {
        let Some(mut from) = self.anchor(first) else {
            *losses.refused.entry(Refusal::Obstacle).or_default() += 1;
            return Ok(());
        };
        for &to in rest {
            for _ in 0..CROSSINGS {
                if self.at(from).distance(to) <= self.constraints.snap.max(self.constraints.min_length) {
                    // It is there already, or so nearly that no street has room between.
                    break;
                }
                if street.is_bridge && self.crosses(from, to, street.attributes) {
                    losses.over += 1;
                    return Ok(());
                }
                match self.grow(from, to, street.attributes)? {
                    growth if matches!(growth.fate, Fate::Snapped | Fate::Joined) => {
                        // What it met may be on its way; a detour that leads back ends here.
                        let nearer = self.at(growth.end).distance(to) < self.at(from).distance(to);
                        from = growth.end;
                        if !nearer {
                            break;
                        }
                    }
                    growth => {
                        if let Fate::Refused(why) = growth.fate {
                            // Two lines side by side are one street, which goes on where the second does.
                            match self.anchor(to) {
                                Some(beyond) if why == Refusal::TooNear || why == Refusal::Angle => {
                                    from = beyond
                                }
                                _ => {}
                            }
                            if !self.is_along(to) {
                                *losses.refused.entry(why).or_default() += 1;
                            }
                        } else {
                            from = growth.end;
                        }
                        break;
                    }
                }
            }
        }
        Ok(())
    }

    /// Whether a bridge would have to meet a street on its way.
    fn crosses(&self, from: JunctionId, to: DVec2, attributes: StreetAttributes) -> bool {
        let prospect = self.probe(from, to, attributes);
        matches!(prospect.fate, Fate::Joined | Fate::Snapped)
            && prospect.place.distance(to) > self.constraints.snap
    }

    /// Whether a street is so near to a place that it stands for one there.
    fn is_along(&self, place: DVec2) -> bool {
        self.nearest(place).is_some_and(|(_, distance)| distance <= self.constraints.snap)
    }

    /// The junction that a place is meant to be: one within the least length or `snap`, one on a street there, or a new one;
    /// `None` if an obstacle is there.
    fn anchor(&mut self, place: DVec2) -> Option<JunctionId> {
        let reach = self.constraints.snap.max(self.constraints.min_length);
        let near = self
            .junctions_near([place; 2], reach)
            .map(|junction| (self.at(junction).distance(place), junction));
        let near = near.filter(|(distance, _)| *distance <= reach);
        if let Some((_, junction)) = near.min_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1))) {
            return Some(junction);
        }
        if let Some((piece, distance)) = self.nearest(place)
            && distance <= reach
        {
            let line = self.line(piece);
            let on = GridPlace::nearest(line[0].lerp(line[1], foot(place, line).1))?;
            if self.can_divide(piece, on) {
                return Some(self.divide(piece, on));
            }
        }
        self.begin(place).ok()
    }

    /// A line by fewer places (m), which are as far apart as streets are long.
    ///
    /// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points", 1973.
    fn simplified(&self, line: &[DVec2]) -> Vec<DVec2> {
        let (Some(&first), Some(&last)) = (line.first(), line.last()) else { return Vec::new() };
        let mut keeps = vec![false; line.len()];
        let mut due = vec![(0, line.len() - 1)];
        while let Some((from, to)) = due.pop() {
            let aside = |index: &usize| foot(line[*index], [line[from], line[to]]).0;
            let far = (from + 1..to).max_by(|a, b| aside(a).total_cmp(&aside(b)));
            if let Some(far) = far.filter(|far| !(aside(far) <= TOLERANCE)) {
                keeps[far] = true;
                due.extend([(from, far), (far, to)]);
            }
        }
        let least = 2.0 * self.constraints.min_length;
        let mut kept = vec![first];
        for (at, _) in line.iter().zip(keeps).filter(|(_, keeps)| *keeps) {
            let far = kept.last().is_some_and(|before| before.distance(*at) >= least);
            if far && at.distance(last) >= least {
                kept.push(*at);
            }
        }
        kept.push(last);
        kept
    }
}
