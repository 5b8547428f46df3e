//! Paths that walk a network like a turtle: ahead, aside, and back to the start of a branch.

use glam::DVec2;
use rustc_hash::{FxHashMap, FxHashSet};

use burgeon_base::error::Result;
use burgeon_streets::{Fate, JunctionId, StreetAttributes, StreetGrowth, StreetNetwork};

use super::walked::{WalkStep, WalkTally};

/// The position of a path, and the starts of its branches.
#[derive(Debug, Clone, Default)]
pub(super) struct NetworkWalk {
    at: WalkPlace,
    branches: Vec<WalkPlace>,
    /// End junctions of the steps of all passes, by junction, heading and length.
    steps: FxHashMap<WalkKey, JunctionId>,
    /// Steps of the current pass.
    of_pass: FxHashSet<WalkKey>,
    /// Outcomes of the steps.
    tally: WalkTally,
}

/// The start junction of a step, its heading and its length.
type WalkKey = (JunctionId, u64, u64);

/// The junction and the heading (degrees) of a proposed street, and its outcome.
type WalkProposal = (JunctionId, f64, StreetGrowth);

/// A position on a path.
#[derive(Debug, Clone, Copy, Default)]
struct WalkPlace {
    junction: JunctionId,
    /// Heading (degrees) from east, counter-clockwise.
    heading: f64,
    /// Number of times that the path has branched.
    depth: u32,
    /// Set if a street was refused, so that the path ends here.
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

    /// Returns the outcomes of the streets of the current pass.
    pub(super) fn tally(&self) -> &WalkTally {
        &self.tally
    }

    /// Continues from a junction.
    pub(super) fn move_to(&mut self, junction: JunctionId, heading: f64) {
        self.at = WalkPlace { junction, heading, depth: self.at.depth, has_ended: false };
    }

    /// Turns by an angle (degrees), counter-clockwise.
    pub(super) fn turn(&mut self, angle: f64) {
        self.at.heading = (self.at.heading + angle).rem_euclid(360.0);
    }

    /// Returns the number of times that the path has branched.
    pub(super) fn depth(&self) -> u32 {
        self.at.depth
    }

    /// Proposes a street ahead with a length (m), and continues from its end. A refused street ends the path.
    ///
    /// A step that an earlier pass has made leads to the same junction. Returns the start of a newly proposed street,
    /// and its outcome.
    pub(super) fn walk_ahead(
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

    /// Stores the start of a branch, whose depth is one more.
    pub(super) fn open_branch(&mut self) {
        self.branches.push(self.at);
        self.at.depth += 1;
    }

    /// Returns to the start of the branch, with its heading there.
    pub(super) fn close_branch(&mut self) {
        self.at = self.branches.pop().unwrap_or_default();
    }
}
