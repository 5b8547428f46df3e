//! What became of the streets that a pass walked: how many were added, and why the others were not.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_streets::{Fate, Refusal};
use glam::DVec2;

/// The walked streets of one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct WalkTally {
    asked: usize,
    added: usize,
    /// Streets that an earlier step of the pass had walked already.
    again: usize,
    /// Streets whose path had ended at a refused street.
    behind: usize,
    /// By reason, in the order of [`Refusal::ALL`].
    refused: [RefusedWalks; Refusal::ALL.len()],
}

/// Streets that were refused for one reason.
#[derive(Debug, Clone, Copy, Default)]
struct RefusedWalks {
    count: usize,
    /// Start (m) and heading (degrees) of the first one.
    first: (DVec2, f64),
}

/// One step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WalkStep {
    /// A street was proposed from a position (m) with a heading (degrees).
    Proposed(Fate, DVec2, f64),
    /// The street was added in an earlier pass.
    Known,
    /// The street was walked before in this pass.
    Again,
    /// The path had ended.
    Behind,
}

impl WalkTally {
    /// Counts a step.
    pub(super) fn count(&mut self, step: WalkStep) {
        self.asked += 1;
        match step {
            WalkStep::Proposed(Fate::Refused(why), at, heading) => {
                let refused = &mut self.refused[why as usize];
                if refused.count == 0 {
                    refused.first = (at, heading);
                }
                refused.count += 1;
            }
            WalkStep::Proposed(..) | WalkStep::Known => self.added += 1,
            WalkStep::Again => self.again += 1,
            WalkStep::Behind => self.behind += 1,
        }
    }

    /// Reports the streets that are missing; `None` if every street was added.
    pub(super) fn warning(&self) -> Option<Warning> {
        let mut reasons: Vec<(Refusal, RefusedWalks)> =
            Refusal::ALL.into_iter().zip(self.refused).filter(|(_, refused)| refused.count > 0).collect();
        if reasons.is_empty() {
            return None;
        }
        reasons.sort_by_key(|(why, refused)| (usize::MAX - refused.count, why.name()));
        let refused: usize = reasons.iter().map(|(_, refused)| refused.count).sum();
        let mut text = format!(
            "network:walk: {} of {} streets were added, {refused} {} refused",
            self.added,
            self.asked,
            if refused == 1 { "was" } else { "were" }
        );
        if self.behind > 0 {
            text += &format!(", and {} lie beyond a refused street", self.behind);
        }
        if self.again > 0 {
            text += &format!(", and {} repeat a street that is already there", self.again);
        }
        let each = reasons.iter().map(|(why, RefusedWalks { count, first: (at, heading) })| {
            let first = if *count == 1 { "at" } else { "first at" };
            format!("{} ({count}, {first} {:.1}, {:.1} towards {heading:.0} degrees)", why.name(), at.x, at.y)
        });
        text += &format!(": {}", each.collect::<Vec<_>>().join(", "));
        let remedies: Vec<&str> = reasons.iter().map(|(why, _)| remedy(*why)).collect();
        let help = format!("{}: {}", reasons[0].0.name(), remedies[0]);
        let help = reasons
            .iter()
            .zip(&remedies)
            .skip(1)
            .fold(help, |help, ((why, _), remedy)| format!("{help}; {}: {remedy}", why.name()));
        Some(Warning::new(WarningKind::DrawsNothing, text).help(help).of_pass())
    }
}

/// What would let such streets be added.
fn remedy(why: Refusal) -> &'static str {
    match why {
        Refusal::TooShort => "walk farther at once, or give the network a smaller `min_length` or `snap`",
        Refusal::Angle => "turn by more, or give the network a smaller `min_angle`",
        Refusal::TooNear => "leave more room between streets, or give the network a smaller `clearance`",
        Refusal::Corners => {
            "walk farther at once, turn by more, make the `streets` narrower, or give the network a smaller `corner`"
        }
        Refusal::Obstacle => "walk around the obstacles, or give the network a greater `bend` or `bridge`",
        Refusal::Outside => "walk less far, or give the network a greater `limit`",
    }
}
