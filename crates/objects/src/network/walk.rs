//! Ways that a network is walked by, as a turtle walks: ahead, aside, and back to where a branch began.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use burgeon_base::error::Result;
use burgeon_streets::{Fate, JunctionId, StreetAttributes, StreetGrowth, StreetNetwork};

use super::walked::{WalkStep, WalkTally};

/// Where a way is, and where its branches began.
#[derive(Debug, Clone, Default)]
pub(super) struct NetworkWalk {
    at: WalkPlace,
    branches: Vec<WalkPlace>,
    /// Where the steps of all passes led to, by junction, heading and length.
    steps: FxHashMap<WalkKey, JunctionId>,
    /// The steps of the present pass.
    of_pass: FxHashSet<WalkKey>,
    /// What became of them.
    tally: WalkTally,
}

/// Where a step begins, its heading and its length.
type WalkKey = (JunctionId, u64, u64);

/// Where a street was proposed: the junction, the heading (degrees), and what became of it.
type WalkProposal = (JunctionId, f64, StreetGrowth);

/// A place on a way.
#[derive(Debug, Clone, Copy, Default)]
struct WalkPlace {
    junction: JunctionId,
    /// Degrees from east, counter-clockwise.
    heading: f64,
    /// How often the way has branched off.
    depth: u32,
    /// Whether a street was refused, so that the way ends here.
    has_ended: bool,
}

impl NetworkWalk {
    /// Begins a pass at the first start.
    pub(super) fn restart(&mut self) {
        self.at = WalkPlace::default();
        self.branches.clear();
        self.of_pass.clear();
        self.tally = WalkTally::default();
    }

    /// What became of the streets of the present pass.
    pub(super) fn tally(&self) -> &WalkTally {
        &self.tally
    }

    /// Goes on from a junction.
    pub(super) fn stand(&mut self, junction: JunctionId, heading: f64) {
        self.at = WalkPlace { junction, heading, depth: self.at.depth, has_ended: false };
    }

    /// Turns by an angle (degrees), counter-clockwise.
    pub(super) fn turn(&mut self, angle: f64) {
        self.at.heading = (self.at.heading + angle).rem_euclid(360.0);
    }

    /// How often the way has branched off.
    pub(super) fn depth(&self) -> u32 {
        self.at.depth
    }

    /// Proposes a street ahead of a length (m), and goes on from where that ends; a refused one ends the way.
    ///
    /// A step that an earlier pass has made leads where it led then. Gives where the street was proposed, and its fate.
    pub(super) fn ahead(
        &mut self,
        network: &mut StreetNetwork,
        length: f64,
        attributes: StreetAttributes,
    ) -> Result<Option<WalkProposal>> {
        let WalkPlace { junction, heading, has_ended, .. } = self.at;
        if has_ended {
            self.tally.count(WalkStep::Behind);
            return Ok(None);
        }
        let step = (junction, heading.to_bits(), length.to_bits());
        if let Some(&end) = self.steps.get(&step) {
            self.at.junction = end;
            let is_new = self.of_pass.insert(step);
            self.tally.count(if is_new { WalkStep::Known } else { WalkStep::Again });
            return Ok(None);
        }
        let from = network.at(junction);
        let to = from + DVec2::from_angle(heading.to_radians()) * length;
        let growth = network.grow(junction, to, attributes)?;
        self.tally.count(WalkStep::Proposed(growth.fate, from, heading));
        self.at.has_ended = matches!(growth.fate, Fate::Refused(_));
        if !self.at.has_ended {
            self.at.junction = growth.end;
            self.steps.insert(step, growth.end);
            self.of_pass.insert(step);
        }
        Ok(Some((junction, heading, growth)))
    }

    /// Remembers where a branch begins, whose depth is one more.
    pub(super) fn open_branch(&mut self) {
        self.branches.push(self.at);
        self.at.depth += 1;
    }

    /// Goes back to where the branch began, with the heading that it had there.
    pub(super) fn close_branch(&mut self) {
        self.at = self.branches.pop().unwrap_or_default();
    }
}
