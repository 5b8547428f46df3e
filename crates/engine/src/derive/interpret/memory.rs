//! Memory of a pass, from which the next pass continues where the chain has changed.

use std::any::Any;
use std::sync::Arc;

use burgeon_kit::ObjectPlace;
use burgeon_rewriting::{Chain, Mark};

/// State of the object of a chain at a position of the chain.
pub(super) struct PassMark {
    pub at: Mark,
    pub object: Box<dyn Any + Send + Sync>,
    /// Number of triangles of the object.
    pub triangles: usize,
}

/// A pass over one chain.
#[derive(Default)]
pub(crate) struct PassMemory {
    /// Chain of the last complete pass.
    chain: Option<Arc<Chain>>,
    pub(super) marks: Vec<PassMark>,
    /// Places of the object at modules whose rules read them.
    pub(super) places: Vec<(u32, ObjectPlace)>,
}

impl PassMemory {
    /// Prepares a pass over `chain`: forgets the marks and places after the first change of the chain.
    pub(super) fn begin(&mut self, chain: &Arc<Chain>) {
        let Some(last) = self.chain.replace(Arc::clone(chain)) else { return self.forget_from(0) };
        if Arc::ptr_eq(&last, chain) {
            return self.forget_from(self.end().module);
        }
        let symbols = equal_items(&last.symbols, &chain.symbols);
        let params = equal_items_by(&last.params, &chain.params, |a, b| a.to_bits() == b.to_bits());
        let keys = match chain.keys.is_empty() {
            true => symbols,
            false => equal_items(&last.keys, &chain.keys),
        };
        let is_same = |mark: &PassMark| mark.at.module <= symbols.min(keys) && mark.at.param <= params;
        let kept = self.marks.partition_point(is_same);
        self.marks.truncate(kept);
        self.forget_from(self.end().module);
    }

    /// Returns true if the last pass was complete, so that the next can continue it.
    pub(crate) fn is_complete(&self) -> bool {
        self.chain.is_some()
    }

    /// Returns the position from which the next pass continues.
    pub(super) fn end(&self) -> Mark {
        self.marks.last().map_or_else(Mark::default, |mark| mark.at)
    }

    /// Forgets what belongs to another chain than one of which the first `unchanged` symbols are the same.
    pub(crate) fn keep(&mut self, unchanged: usize) {
        let kept = self.marks.partition_point(|mark| mark.at.module <= unchanged);
        self.marks.truncate(kept);
        self.forget_from(self.end().module);
    }

    /// Sets the chain to which the marks belong.
    pub(crate) fn set_chain(&mut self, chain: &Arc<Chain>) {
        if self.is_complete() {
            self.chain = Some(Arc::clone(chain));
        }
    }

    /// Forgets the places at modules from number `module` on.
    fn forget_from(&mut self, module: usize) {
        let kept = self.places.partition_point(|(known, _)| (*known as usize) < module);
        self.places.truncate(kept);
    }

    /// Returns true if the state at `at` is worth a mark, which has `size` frames: at least `interval` symbols after the
    /// last mark.
    pub(super) fn needs_mark(&self, at: Mark, interval: usize, size: usize) -> bool {
        let last = self.marks.last().map_or(0, |mark| mark.at.module);
        at.module >= last + interval + size / 4
    }
}

/// Returns the number of equal items at the beginning of both lists.
fn equal_items<T: PartialEq>(one: &[T], two: &[T]) -> usize {
    equal_items_by(one, two, T::eq)
}

fn equal_items_by<T>(one: &[T], two: &[T], is_equal: impl Fn(&T, &T) -> bool) -> usize {
    const STRETCH: usize = 64;
    let is_same = |(a, b): (&T, &T)| is_equal(a, b);
    let stretches = one.chunks(STRETCH).zip(two.chunks(STRETCH));
    let whole = stretches.take_while(|(a, b)| a.len() == b.len() && a.iter().zip(*b).all(is_same)).count();
    let begin = (whole * STRETCH).min(one.len()).min(two.len());
    begin + one[begin..].iter().zip(&two[begin..]).take_while(|pair| is_same(*pair)).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_equal_items_at_the_beginning_are_counted_for_any_length() {
        for length in [0, 1, 63, 64, 65, 200] {
            let one: Vec<usize> = (0..length).collect();
            assert_eq!(equal_items(&one, &one), length);
            for changed in 0..length {
                let mut two = one.clone();
                two[changed] = 1000;
                assert_eq!(equal_items(&one, &two), changed);
                assert_eq!(equal_items(&one, &one[..changed]), changed);
            }
        }
    }
}
