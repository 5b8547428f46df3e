//! Return of a turtle to an earlier state of a pass.

use std::any::Any;

use burgeon_kit::{DrawingMark, Rewind};
use glam::DVec3;

use super::Turtle;
use super::joined::{JoinedBranches, JoinedMark};
use super::state::TurtleState;
use crate::frame_stack::FrameStackMark;

/// State of a turtle in a pass, without what it has drawn.
struct TurtleMark {
    state: TurtleState,
    stack: FrameStackMark<TurtleState>,
    polygons: Vec<Vec<DVec3>>,
    joined: Option<JoinedMark>,
    drawing: DrawingMark,
}

impl Rewind for Turtle {
    fn mark_size(&self) -> usize {
        self.polygons.iter().map(Vec::len).sum::<usize>()
    }

    fn mark(&mut self) -> Box<dyn Any + Send + Sync> {
        Box::new(TurtleMark {
            state: self.state.clone(),
            stack: self.stack.mark(),
            polygons: self.polygons.clone(),
            joined: self.joined.as_mut().map(JoinedBranches::mark),
            drawing: self.drawing.mark(),
        })
    }

    fn rewind(&mut self, mark: &(dyn Any + Send + Sync)) -> bool {
        let Some(mark) = mark.downcast_ref::<TurtleMark>() else { return false };
        self.state.clone_from(&mark.state);
        self.stack.rewind(&mark.stack);
        self.polygons.clone_from(&mark.polygons);
        if let (Some(joined), Some(mark)) = (&mut self.joined, &mark.joined) {
            joined.rewind(mark);
        }
        self.drawing.rewind(&mark.drawing);
        true
    }
}
