//! The number of streets proposed to a network, and the warning if few have room.

use burgeon_base::warning::{Warning, WarningKind};
use burgeon_streets::{Fate, Refusal};

/// Minimum number of streets that are representative.
const ENOUGH: usize = 8;

/// The outcomes of the proposed streets.
#[derive(Debug, Clone, Default)]
pub(super) struct ProposalTally {
    proposed: usize,
    /// Number of refused streets by reason, in the order of [`Refusal::ALL`].
    refused: [usize; Refusal::ALL.len()],
    /// Number of streets proposed in this pass, and number of them that were not refused.
    of_pass: [usize; 2],
}

impl ProposalTally {
    /// Begins a pass.
    pub(super) fn begin(&mut self) {
        self.of_pass = [0; 2];
    }

    pub(super) fn count(&mut self, fate: Fate) {
        self.proposed += 1;
        self.of_pass[0] += 1;
        match fate {
            Fate::Refused(why) => self.refused[why as usize] += 1,
            _ => self.of_pass[1] += 1,
        }
    }

    /// Returns the warning after a pass that proposed streets and built none, with `size` street segments in total:
    /// either there are no streets, or most proposed streets are too short for their widths, so that growth ends early.
    pub(super) fn warning(&self, size: usize) -> Option<Warning> {
        if self.of_pass[0] == 0 || self.of_pass[1] > 0 {
            return None;
        }
        let proposed = self.proposed;
        let narrow = self.refused[Refusal::Corners as usize] + self.refused[Refusal::TooShort as usize];
        let (text, help) = if size == 0 {
            let reasons: Vec<&str> = self.reasons().map(|(why, _)| why.name()).collect();
            let text =
                format!("network: none of {proposed} proposed streets was built: {}", reasons.join(", "));
            (text, "network:outcome returns the outcome of each")
        } else if proposed >= ENOUGH && 2 * narrow > proposed {
            let refused: usize = self.refused.iter().sum();
            let reasons: Vec<String> =
                self.reasons().map(|(why, count)| format!("{} ({count})", why.name())).collect();
            let text = format!(
                "network: {refused} of {proposed} proposed streets were refused, so growth ended with {size} segments: {}",
                reasons.join(", ")
            );
            (text, "propose longer or narrower streets, or set a smaller `corner`")
        } else {
            return None;
        };
        Some(Warning::new(WarningKind::DrawsNothing, text).help(help))
    }

    /// Returns the reasons for refusals, each with its number of refused streets, sorted by name.
    fn reasons(&self) -> impl Iterator<Item = (Refusal, usize)> {
        let mut reasons: Vec<(Refusal, usize)> =
            Refusal::ALL.into_iter().zip(self.refused).filter(|(_, count)| *count > 0).collect();
        reasons.sort_unstable_by_key(|(why, _)| why.name());
        reasons.into_iter()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_that_ends_for_want_of_room_is_told_and_growth_that_goes_on_is_not() {
        let mut tally = ProposalTally::default();
        (0..4).for_each(|_| tally.count(Fate::Built));
        assert!(tally.warning(4).is_none());
        tally.begin();
        assert!(tally.warning(4).is_none(), "nothing was proposed");
        (0..5).for_each(|_| tally.count(Fate::Refused(Refusal::Corners)));
        tally.count(Fate::Refused(Refusal::Angle));
        tally.count(Fate::Built);
        assert!(tally.warning(5).is_none(), "one was built");
        tally.begin();
        (0..3).for_each(|_| tally.count(Fate::Refused(Refusal::TooShort)));
        let told = tally.warning(5).expect("a warning");
        assert_eq!(
            told.message(),
            "network: 9 of 14 proposed streets were refused, so growth ended with 5 segments: angle (1), \
             corners (5), too short (3)"
        );
        let mut crowded = ProposalTally::default();
        (0..3).for_each(|_| crowded.count(Fate::Built));
        crowded.begin();
        (0..90).for_each(|_| crowded.count(Fate::Refused(Refusal::TooNear)));
        assert!(crowded.warning(3).is_none(), "streets that are near others have had their room");
    }
}
