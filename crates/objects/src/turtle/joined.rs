//! Branches that are drawn as one surface with smooth joints.

use burgeon_base::error::Result;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::{AxisPoint, CylinderPoint, JointAxis, joined_tubes};
use burgeon_kit::Drawing;
use std::borrow::Cow;

use super::state::TurtleState;

/// The place of a turtle among the branches that are not yet drawn.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct BranchPlace {
    /// Point of a branch at which the turtle is.
    at: Option<AxisPoint>,
    /// Branch that grows with each step.
    growing: Option<usize>,
    /// Set while the growing branch is a generalised cylinder.
    pub(super) in_cylinder: bool,
    /// Set if the generalised cylinder twists with the turtle.
    twists: bool,
}

impl BranchPlace {
    /// Leaves the branch, because the turtle moves without drawing. A generalised cylinder continues after that.
    pub(super) fn leave(&mut self) {
        self.at = None;
        if !self.in_cylinder {
            self.growing = None;
        }
    }

    /// Completes the generalised cylinder.
    pub(super) fn end_cylinder(&mut self) {
        (self.growing, self.in_cylinder, self.twists) = (None, false, false);
    }
}

/// Branches that the end of the pass draws.
#[derive(Debug, Clone, Default)]
pub(super) struct JoinedBranches {
    axes: Vec<JointAxis>,
    /// Part of the drawing of each axis, and the modules that drew to its points.
    drawn: Vec<(usize, Vec<u32>)>,
    /// Axis of each point, in the order in which the points were added.
    added: Vec<usize>,
    /// Set if a mark needs the branches after they are drawn.
    is_marked: bool,
}

/// Content of [`JoinedBranches`] at a moment.
#[derive(Debug)]
pub(super) struct JoinedMark {
    axes: usize,
    points: usize,
}

impl JoinedBranches {
    /// Returns a mark of the present content.
    pub(super) fn mark(&mut self) -> JoinedMark {
        self.is_marked = true;
        JoinedMark { axes: self.axes.len(), points: self.added.len() }
    }

    /// Returns to the content of a mark.
    pub(super) fn rewind(&mut self, mark: &JoinedMark) {
        for axis in self.added.drain(mark.points..).rev() {
            self.axes[axis].points.pop();
            self.drawn[axis].1.pop();
        }
        self.axes.truncate(mark.axes);
        self.drawn.truncate(mark.axes);
    }

    /// Removes all branches.
    pub(super) fn clear(&mut self) {
        *self = Self::default();
    }

    /// Begins a branch at the turtle's position. It is joined to the branch there, if that has the same material.
    fn begin(&mut self, state: &mut TurtleState, maker: u32, in_cylinder: bool) {
        let parent = state.joined.at.filter(|at| self.drawn[at.axis].0 == state.part);
        // The x direction of a cylinder's contour is to the right, the seam of a straight branch to the left.
        let side = if in_cylinder { -state.frame.left } else { state.frame.left };
        self.axes.push(JointAxis { points: Vec::new(), side, parent, smooth: in_cylinder });
        self.drawn.push((state.part, Vec::new()));
        let twists = in_cylinder && state.joined.twists;
        state.joined = BranchPlace { at: None, growing: Some(self.axes.len() - 1), in_cylinder, twists };
        self.add_point(state, maker);
    }

    /// Begins a generalised cylinder at the turtle's position, which twists with the turtle if `twists` is set.
    pub(super) fn begin_cylinder(&mut self, state: &mut TurtleState, maker: u32, twists: bool) {
        state.joined.twists = twists;
        self.begin(state, maker, true);
    }

    /// Begins branches in brackets: without a branch at the turtle's position, its branches join there.
    pub(super) fn open(&mut self, state: &mut TurtleState, maker: u32) {
        if state.joined.at.is_none() && !state.joined.in_cylinder {
            self.begin(state, maker, false);
            state.joined.growing = None;
        }
    }

    /// Prepares a step of the turtle: begins a branch, unless one with the same material is growing.
    pub(super) fn prepare(&mut self, state: &mut TurtleState, maker: u32) {
        let BranchPlace { growing, in_cylinder, .. } = state.joined;
        if growing.is_none_or(|axis| !in_cylinder && self.drawn[axis].0 != state.part) {
            self.begin(state, maker, false);
        }
    }

    /// Adds the turtle's position to the growing branch.
    pub(super) fn add_point(&mut self, state: &mut TurtleState, maker: u32) {
        let Some(axis) = state.joined.growing else { return };
        let contour = if state.joined.in_cylinder { state.contour.clone() } else { None };
        let side = state.joined.twists.then_some(-state.frame.left);
        let (position, radius) = (state.frame.position, state.width / 2.0);
        self.axes[axis].points.push(CylinderPoint { position, radius, contour, side });
        self.drawn[axis].1.push(maker);
        self.added.push(axis);
        state.joined.at = Some(AxisPoint { axis, point: self.axes[axis].points.len() - 1 });
    }

    /// Draws all branches with at least this number of `sides`, a surface for each tree of one material, and removes
    /// them, unless a mark needs them. Returns a warning if some have no smooth joint.
    pub(super) fn draw(&mut self, drawing: &mut Drawing, sides: u32) -> Result<Option<Warning>> {
        let Self { axes, drawn, .. } = if self.is_marked { self.clone() } else { std::mem::take(self) };
        let mut parts: Vec<usize> = drawn.iter().map(|(part, _)| *part).collect();
        parts.sort_unstable();
        parts.dedup();
        // A branch and its parent have the same part.
        let mut numbers = vec![0; axes.len()];
        let mut trees: Vec<(Vec<JointAxis>, Vec<usize>)> = vec![Default::default(); parts.len()];
        for (index, mut axis) in axes.into_iter().enumerate() {
            let Ok(tree) = parts.binary_search(&drawn[index].0) else { continue };
            let (axes, indices) = &mut trees[tree];
            axis.parent = axis.parent.map(|at| AxisPoint { axis: numbers[at.axis], ..at });
            numbers[index] = axes.len();
            axes.push(axis);
            indices.push(index);
        }
        let (mut joints, mut separate) = (0, 0);
        for (part, (axes, indices)) in parts.into_iter().zip(trees) {
            let maker = drawing.maker();
            let mut count = drawing.part(part).triangles.len();
            drawing.made(maker, part, count);
            let found = joined_tubes(drawing.part(part), &axes, sides as usize)?;
            joints += found.joints;
            separate += found.separate.len();
            for (to, triangles) in found.runs {
                count += triangles;
                let makers = &drawn[indices[to.axis]].1;
                drawing.made(makers.get(to.point).copied().unwrap_or(maker), part, count);
            }
        }
        Ok((separate > 0).then(|| without_joint(separate, joints)))
    }
}

/// Returns the warning for branches that do not fit into their joints.
fn without_joint(separate: usize, joints: usize) -> Warning {
    let branches: Cow<'_, str> = match separate {
        1 => "1 branch does not fit into its joint, so it is a closed tube of its own".into(),
        count => {
            format!("{count} branches do not fit into their joints, so they are closed tubes of their own")
                .into()
        }
    };
    let text = format!("{branches}; smooth joints: {joints}");
    Warning::new(WarningKind::Doubtful, text)
        .help("make these branches longer than the radius of their parent, or their angles larger, or branches thinner")
}
