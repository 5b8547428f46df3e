//! Return of a turtle to an earlier state of a pass.

use std::any::Any;

use burgeon_kit::{DrawingMark, Rewind};
use glam::DVec3;

use super::Turtle;
use super::joined::JoinedBranches;
use super::state::TurtleState;

/// State of a turtle in a pass, without what it has drawn.
struct TurtleMark {
    state: TurtleState,
    stack: Vec<TurtleState>,
    polygons: Vec<Vec<DVec3>>,
    joined: Option<JoinedBranches>,
    drawing: DrawingMark,
}

impl Rewind for Turtle {
    fn mark_size(&self) -> usize {
        let joined = self.joined.as_ref().map_or(0, JoinedBranches::size);
        self.stack.len() + joined + self.polygons.iter().map(Vec::len).sum::<usize>()
    }

    fn mark(&self) -> Box<dyn Any + Send + Sync> {
        Box::new(TurtleMark {
            state: self.state.clone(),
            stack: self.stack.clone(),
            polygons: self.polygons.clone(),
            joined: self.joined.clone(),
            drawing: self.drawing.mark(),
        })
    }

    fn rewind(&mut self, mark: &(dyn Any + Send + Sync)) -> bool {
        let Some(mark) = mark.downcast_ref::<TurtleMark>() else { return false };
        self.state.clone_from(&mark.state);
        self.stack.clone_from(&mark.stack);
        self.polygons.clone_from(&mark.polygons);
        self.joined.clone_from(&mark.joined);
        self.drawing.rewind(&mark.drawing);
        true
    }
}
