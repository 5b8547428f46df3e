//! The outcomes of the streets that a pass walked: the number of added streets, and the reasons for the others.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_streets::{Fate, Refusal};
use glam::DVec2;

/// The walked streets of one pass.
#[derive(Debug, Clone, Default)]
pub(super) struct WalkTally {
    asked: usize,
    added: usize,
    /// Number of streets that an earlier step of the pass had already walked.
    again: usize,
    /// Number of streets whose path had ended at a refused street.
    behind: usize,
    /// Refused streets by reason, in the order of [`Refusal::ALL`].
    refused: [RefusedWalks; Refusal::ALL.len()],
}

/// Streets that were refused for one reason.
#[derive(Debug, Clone, Copy, Default)]
struct RefusedWalks {
    count: usize,
    /// Start (m) and heading (degrees) of the first street.
    first: (DVec2, f64),
}

/// A step of a path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WalkStep {
    /// Proposal of a street from a position (m) with a heading (degrees).
    Proposed(Fate, DVec2, f64),
    /// Street that was added in an earlier pass.
    Known,
    /// Street that was already walked in this pass.
    Again,
    /// Step beyond the end of the path.
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

    /// Reports the streets that are missing, or returns `None` if every street was added.
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
            text += &format!(", and {} are after a refused street", self.behind);
        }
        if self.again > 0 {
            text += &format!(", and {} repeat an existing street", self.again);
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

/// Returns the remedy for a reason of refusal.
fn remedy(why: Refusal) -> &'static str {
    match why {
        Refusal::TooShort => "walk farther at once, or set a smaller `min_length` or `snap`",
        Refusal::Angle => "turn by more, or set a smaller `min_angle`",
        Refusal::TooNear => "leave more space between streets, or set a smaller `clearance`",
        Refusal::Corners => {
            "walk farther at once, turn by more, make the `streets` narrower, or set a smaller `corner`"
        }
        Refusal::Obstacle => "walk around the obstacles, or set a greater `bend` or `bridge`",
        Refusal::Outside => "walk less far, or set a greater `limit`",
    }
}
