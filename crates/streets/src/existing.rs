//! Streets that are there before a network grows: those of a survey, whose lines cross, touch and repeat one another.
//!
//! They are laid like streets that are proposed, main streets first, so that all that a network promises holds for them
//! too. Lines that run side by side become one, crossings become junctions, and what keeps no constraint is left out.

use std::collections::BTreeMap;

use glam::DVec2;
use rustc_hash::FxHashMap;

use crate::constraints::{Fate, Refusal};
use crate::grid::{GridPlace, foot};
use crate::grow::StreetEnd;
use crate::network::{JunctionId, StreetAttributes, StreetNetwork};
use burgeon_base::error::Result;

/// How far (m) a line may lie from a street that stands for it.
const TOLERANCE: f64 = 2.0;
/// How much longer than a piece the way along the streets may be that stands for it.
const DETOUR: f64 = 2.0;
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
    /// Those of a single place, or none.
    pub short: usize,
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
        let mut known = Vec::new();
        for street in streets {
            let places = street.line.iter().copied().filter(|at| GridPlace::nearest(*at).is_some());
            let line: Vec<DVec2> = places.collect();
            losses.outside += street.line.len() - line.len();
            losses.short += usize::from(street.line.len() < 2);
            if line.len() > 1 {
                known.push(ExistingStreet { line, ..street.clone() });
            }
        }
        let mut order = joined(known);
        order.sort_by_key(|street| (street.is_bridge, street.attributes.depth));
        for street in &order {
            let line = self.simplified(&street.line);
            if let [first, rest @ ..] = &line[..] {
                self.lay_existing(*first, rest, street, &mut losses)?;
            }
        }
        Ok(losses)
    }

    /// Lays a street along some places.
    fn lay_existing(
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
        let mut missed = 0;
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
                            // Two lines side by side are one street, which goes on where the second does. What has
                            // no room up to here may have it up to the next place.
                            let beyond = self.anchor(to).filter(|beyond| {
                                let least = self.at(from).distance(to) * DETOUR + self.constraints.snap;
                                !self.is_detour(from, StreetEnd::Junction(*beyond), least)
                            });
                            match beyond {
                                Some(beyond) => from = beyond,
                                None => {
                                    *losses.refused.entry(why).or_default() += 1;
                                    missed += 1;
                                    if missed > 1 {
                                        from = self.anchor(to).unwrap_or(from);
                                    }
                                }
                            }
                        } else {
                            from = growth.end;
                            missed = 0;
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
            // Of places that are equally far aside the last one stays, unlike with `planar::simplified`: the streets that are
            // laid depend on it.
            let aside = |index: &usize| foot(line[*index], [line[from], line[to]]).0;
            let far = (from + 1..to).max_by(|a, b| aside(a).total_cmp(&aside(b)));
            if let Some(far) = far.filter(|far| aside(far) > TOLERANCE) {
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

/// The streets, where those that go on in one another are one: surveys divide them wherever a name or a surface changes.
fn joined(streets: Vec<ExistingStreet>) -> Vec<ExistingStreet> {
    let ends_of = |street: &ExistingStreet| {
        [street.line[0], street.line[street.line.len() - 1]].map(GridPlace::nearest)
    };
    // Every place that a street begins, ends or leads through, and the streets that end there.
    let mut ends: FxHashMap<Option<GridPlace>, Vec<usize>> = FxHashMap::default();
    let mut through: FxHashMap<Option<GridPlace>, usize> = FxHashMap::default();
    for (index, street) in streets.iter().enumerate() {
        for end in ends_of(street) {
            ends.entry(end).or_default().push(index);
        }
        for at in &street.line {
            *through.entry(GridPlace::nearest(*at)).or_default() += 1;
        }
    }
    let next = |of: &ExistingStreet, index: usize, end: Option<GridPlace>| -> Option<usize> {
        let [a, b] = ends.get(&end)?[..] else { return None };
        let other = if a == index { b } else { a };
        let same = streets[other].attributes == of.attributes && streets[other].is_bridge == of.is_bridge;
        (a != b && same && through.get(&end) == Some(&2)).then_some(other)
    };
    let mut is_used = vec![false; streets.len()];
    let mut all = Vec::new();
    for (index, street) in streets.iter().enumerate() {
        if std::mem::replace(&mut is_used[index], true) {
            continue;
        }
        let mut line = street.line.clone();
        for _ in 0..2 {
            let mut at = index;
            loop {
                let end = line.last().and_then(|end| GridPlace::nearest(*end));
                let Some(other) = next(street, at, end).filter(|other| !is_used[*other]) else { break };
                is_used[other] = true;
                let more = &streets[other].line;
                if ends_of(&streets[other])[0] == end {
                    line.extend(&more[1..]);
                } else {
                    line.extend(more.iter().rev().skip(1));
                }
                at = other;
            }
            line.reverse();
        }
        all.push(ExistingStreet { line, ..street.clone() });
    }
    all
}
