//! Queue of the wavefront's predicted events.

use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

use super::edge::short;
use super::lines::EventTime;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum WavefrontEventKind {
    /// Collapse of the edge between two corners to a point.
    Collapse(u32, u32),
    /// Arrival of a reflex corner at the line of an edge.
    Split(u32, u32),
    /// Start of an edge that stood still.
    Start(u32),
}

#[derive(Debug, Clone, Copy)]
pub(super) struct WavefrontEvent {
    /// Lower bound of the time.
    pub low: f64,
    pub when: EventTime,
    pub what: WavefrontEventKind,
    /// Set if the corner's next possible events have not been added yet.
    pub leads: bool,
}

impl WavefrontEvent {
    fn rank(&self) -> (u8, u32, u32) {
        match self.what {
            WavefrontEventKind::Collapse(a, b) => (1, a, b),
            WavefrontEventKind::Split(corner, edge) => (2, corner, edge),
            WavefrontEventKind::Start(edge) => (3, edge, 0),
        }
    }

    /// Orders events of the same time.
    pub(super) fn compare(&self, other: &Self) -> Ordering {
        self.low.total_cmp(&other.low).then_with(|| self.rank().cmp(&other.rank()))
    }
}

/// Queue of predicted events, the earliest first.
///
/// The heap moves only small keys, not the events.
#[derive(Debug, Default)]
pub(super) struct EventQueue {
    pub events: Vec<WavefrontEvent>,
    /// Keys: the time of each event as an integer with the same order, then its index.
    pub order: BinaryHeap<Reverse<u128>>,
}

impl EventQueue {
    pub(super) fn clear(&mut self) {
        self.events.clear();
        self.order.clear();
    }

    #[inline]
    pub(super) fn push(&mut self, event: WavefrontEvent) {
        self.events.push(event);
        self.put_back(short(self.events.len() - 1));
    }

    /// Inserts an event again after it was removed.
    pub(super) fn put_back(&mut self, number: u32) {
        let bits = self.events[number as usize].low.to_bits();
        // The order of the bits of negative numbers is reversed.
        let sorted = if bits >> 63 == 0 { bits | 1 << 63 } else { !bits };
        self.order.push(Reverse(u128::from(sorted) << 32 | u128::from(number)));
    }

    /// Returns the index of the earliest event.
    #[allow(clippy::cast_possible_truncation, reason = "it stands in the last 32 bits")]
    pub(super) fn first(&self) -> Option<u32> {
        self.order.peek().map(|&Reverse(key)| key as u32)
    }
}
