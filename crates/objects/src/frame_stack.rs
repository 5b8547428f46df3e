//! Stack of the states that branches restore, of which marks share what is below them.

use std::sync::Arc;

/// Stack whose marks cost no copies: a mark makes the present states constant, and shares them.
#[derive(Debug, Clone)]
pub(crate) struct FrameStack<T> {
    shared: FrameStackMark<T>,
    /// States that were pushed since the last mark.
    own: Vec<T>,
}

/// Content of a [`FrameStack`] at a moment.
#[derive(Debug)]
pub(crate) struct FrameStackMark<T> {
    frames: Option<Arc<SharedFrames<T>>>,
    /// Number of states of `frames` that are on the stack.
    count: usize,
}

/// Constant states, above those of `below`.
#[derive(Debug)]
struct SharedFrames<T> {
    below: FrameStackMark<T>,
    states: Vec<T>,
}

impl<T> Clone for FrameStackMark<T> {
    fn clone(&self) -> Self {
        Self { frames: self.frames.clone(), count: self.count }
    }
}

impl<T> Default for FrameStackMark<T> {
    fn default() -> Self {
        Self { frames: None, count: 0 }
    }
}

impl<T> Drop for FrameStackMark<T> {
    fn drop(&mut self) {
        // A loop, since a recursion could be as deep as the branches.
        let mut next = self.frames.take();
        while let Some(mut frames) = next.and_then(Arc::into_inner) {
            next = frames.below.frames.take();
        }
    }
}

impl<T> Default for FrameStack<T> {
    fn default() -> Self {
        Self { shared: FrameStackMark::default(), own: Vec::new() }
    }
}

impl<T: Clone> FrameStack<T> {
    /// Removes all states.
    pub(crate) fn clear(&mut self) {
        self.shared = FrameStackMark::default();
        self.own.clear();
    }

    #[inline]
    pub(crate) fn push(&mut self, state: T) {
        self.own.push(state);
    }

    /// Removes the last state, and passes it to `take`. Returns false if the stack is empty.
    #[inline]
    pub(crate) fn pop_with(&mut self, take: impl FnOnce(&mut T)) -> bool {
        if let Some(state) = self.own.last_mut() {
            take(state);
            self.own.truncate(self.own.len() - 1);
            return true;
        }
        match self.pop_shared() {
            Some(mut state) => {
                take(&mut state);
                true
            }
            None => false,
        }
    }

    #[cold]
    fn pop_shared(&mut self) -> Option<T> {
        let frames = self.shared.frames.as_ref()?;
        let count = self.shared.count - 1;
        let state = frames.states[count].clone();
        self.shared = match count {
            0 => frames.below.clone(),
            _ => FrameStackMark { frames: Some(Arc::clone(frames)), count },
        };
        Some(state)
    }

    /// Returns a mark of the present content.
    pub(crate) fn mark(&mut self) -> FrameStackMark<T> {
        if !self.own.is_empty() {
            let (below, states) = (std::mem::take(&mut self.shared), std::mem::take(&mut self.own));
            let count = states.len();
            self.shared = FrameStackMark { frames: Some(Arc::new(SharedFrames { below, states })), count };
        }
        self.shared.clone()
    }

    /// Returns to the content of a mark.
    pub(crate) fn rewind(&mut self, mark: &FrameStackMark<T>) {
        self.shared = mark.clone();
        self.own.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn popped(stack: &mut FrameStack<u32>) -> Option<u32> {
        let mut found = None;
        stack.pop_with(|state| found = Some(*state));
        found
    }

    proptest! {
        #[test]
        fn a_stack_returns_to_its_marks_as_a_copied_list_does(actions in prop::collection::vec((0..6, any::<u32>()), 0..400)) {
            let (mut stack, mut plain) = (FrameStack::default(), Vec::new());
            let mut marks: Vec<(FrameStackMark<u32>, Vec<u32>)> = Vec::new();
            for (action, value) in actions {
                match action {
                    0..=2 => {
                        stack.push(value);
                        plain.push(value);
                    }
                    3 => prop_assert_eq!(popped(&mut stack), plain.pop()),
                    4 => marks.push((stack.mark(), plain.clone())),
                    _ if marks.is_empty() => {}
                    _ => {
                        let (mark, copy) = &marks[value as usize % marks.len()];
                        stack.rewind(mark);
                        plain.clone_from(copy);
                    }
                }
            }
            while let Some(value) = plain.pop() {
                prop_assert_eq!(popped(&mut stack), Some(value));
            }
            prop_assert_eq!(popped(&mut stack), None);
        }
    }

    #[test]
    fn a_deep_stack_of_marks_is_dropped_without_recursion() {
        let mut stack = FrameStack::default();
        let mut marks: Vec<_> = (0..1_000_000)
            .map(|depth: u32| {
                stack.push(depth);
                stack.mark()
            })
            .collect();
        drop(stack);
        let last = marks.pop();
        drop(marks);
        drop(last);
    }
}
