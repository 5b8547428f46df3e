//! The tree of tubes: edges between joints, and the ends of edges that meet at each joint.

use std::sync::Arc;

use glam::DVec3;

use super::axis::{AxisPoint, AxisPoints, JointAxis, rounding};
use super::outline::Outlines;
use super::route::{Route, RouteFrame};
use burgeon_base::Stop;
use burgeon_base::error::Result;

/// Number of axes between two checks for cancellation.
const STRETCH: usize = 1024;

/// A part of an axis between two joints, or between a joint and an end of the axis.
#[derive(Debug)]
pub(super) struct TubeEdge {
    pub(super) axis: usize,
    /// First and last control point.
    pub(super) controls: [usize; 2],
    /// Lengths (m) along the axis of its start and end.
    pub(super) span: [f64; 2],
    /// Joints at its start and end.
    pub(super) joints: [Option<usize>; 2],
    /// Rings at which a joint ends the tube; none at an end that is closed.
    pub(super) cuts: [Option<RouteFrame>; 2],
}

impl TubeEdge {
    /// Returns the length (m).
    pub(super) fn length(&self) -> f64 {
        self.span[1] - self.span[0]
    }
}

/// An end of an edge: 0 for the start, 1 for the end.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct EdgeEnd {
    pub(super) edge: usize,
    pub(super) end: usize,
}

/// A point at which edges meet.
#[derive(Debug)]
pub(super) struct JointPlace {
    /// Position (m).
    pub(super) centre: DVec3,
    /// Control point of the first axis there.
    pub(super) at: AxisPoint,
    /// Ends of the edges, in the order of the axes.
    pub(super) ends: Vec<EdgeEnd>,
    /// Triangles that connect the rings, as numbers of ring points: the rings follow one another in the order of
    /// `ends`.
    pub(super) faces: Vec<[u32; 3]>,
}

/// Axes, edges and joints of a tree of tubes.
pub(super) struct TubeTree {
    pub(super) routes: Vec<Route>,
    /// Index of the last given point of each control point of each axis.
    given: Vec<Vec<usize>>,
    pub(super) edges: Vec<TubeEdge>,
    pub(super) joints: Vec<JointPlace>,
    /// Ends of edges that do not fit into their joint.
    pub(super) separate: Vec<EdgeEnd>,
}

impl TubeTree {
    /// Creates the tree of `axes`; fails if a number is not finite.
    pub(super) fn new(axes: &[JointAxis], sides: usize) -> Result<Self> {
        let circle = Arc::new(Outlines::circle(sides));
        let mut routes = Vec::with_capacity(axes.len());
        let mut all: Vec<AxisPoints> = Vec::with_capacity(axes.len());
        for (index, axis) in axes.iter().enumerate() {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            let points = AxisPoints::new(&axis.points)?;
            let side = if axis.side.is_finite() { axis.side } else { DVec3::X };
            let drawn: &[_] = if points.is_drawn() { &points.points } else { &[] };
            routes.push(Route::new(drawn, side, axis.smooth, sides, &circle)?);
            all.push(points);
        }
        let places = Places::new(axes, &all, &routes);
        let given = all.iter_mut().map(|points| std::mem::take(&mut points.given)).collect();
        let mut tree = Self { routes, given, edges: Vec::new(), joints: Vec::new(), separate: Vec::new() };
        tree.add_edges(&all, &places);
        Ok(tree)
    }

    /// Returns a control point of an axis as a given point.
    pub(super) fn given(&self, axis: usize, control: usize) -> AxisPoint {
        AxisPoint { axis, point: self.given[axis].get(control).copied().unwrap_or(0) }
    }

    fn add_edges(&mut self, all: &[AxisPoints], places: &Places) {
        let mut joint_of: Vec<Option<usize>> = vec![None; places.counts.len()];
        for (axis, points) in all.iter().enumerate() {
            if self.routes[axis].frames.is_empty() {
                continue;
            }
            let last = points.points.len() - 1;
            let mut begin: (usize, Option<usize>) = (0, None);
            for control in 0..=last {
                let own = if control == 0 || control == last { 1 } else { 2 };
                let place = places.place(axis, control);
                let meets = places.counts[place] > own;
                if !meets && own == 2 {
                    continue;
                }
                let joint = meets.then(|| {
                    *joint_of[place].get_or_insert_with(|| {
                        let centre = points.points[control].position;
                        let at = AxisPoint { axis, point: control };
                        let (ends, faces) = (Vec::new(), Vec::new());
                        self.joints.push(JointPlace { centre, at, ends, faces });
                        self.joints.len() - 1
                    })
                });
                if control > 0 {
                    self.add_edge(axis, [begin, (control, joint)]);
                }
                begin = (control, joint);
            }
        }
    }

    fn add_edge(&mut self, axis: usize, [from, to]: [(usize, Option<usize>); 2]) {
        let joints = [from.1, to.1];
        for (end, joint) in joints.iter().enumerate() {
            if let Some(joint) = joint {
                self.joints[*joint].ends.push(EdgeEnd { edge: self.edges.len(), end });
            }
        }
        let marks = &self.routes[axis].marks;
        let span = [marks[from.0], marks[to.0]];
        self.edges.push(TubeEdge { axis, controls: [from.0, to.0], span, joints, cuts: [None; 2] });
    }
}

/// Control points that are at one place, because one axis begins at the other.
struct Places {
    /// Number of the first control point of each axis.
    first: Vec<usize>,
    /// For each control point an earlier one at its place, or itself.
    same: Vec<usize>,
    /// Number of edges at each place.
    counts: Vec<usize>,
}

impl Places {
    fn new(axes: &[JointAxis], all: &[AxisPoints], routes: &[Route]) -> Self {
        let mut first = Vec::with_capacity(all.len());
        let mut sum = 0;
        for points in all {
            first.push(sum);
            sum += points.points.len();
        }
        let mut places = Self { first, same: (0..sum).collect(), counts: vec![0; sum] };
        for (index, axis) in axes.iter().enumerate() {
            let Some(AxisPoint { axis: parent, point }) = axis.parent.filter(|at| at.axis < index) else {
                continue;
            };
            let Some(&control) = all[parent].kept.get(point) else { continue };
            let (Some(begin), at) = (all[index].points.first(), &all[parent].points[control]) else {
                continue;
            };
            if begin.position.distance(at.position) <= 2.0 * rounding(at.position) {
                let place = places.place(parent, control);
                places.same[places.first[index]] = place;
            }
        }
        for (axis, points) in all.iter().enumerate() {
            if routes[axis].frames.is_empty() {
                continue;
            }
            let last = points.points.len() - 1;
            for control in 0..=last {
                let place = places.place(axis, control);
                places.counts[place] += if control == 0 || control == last { 1 } else { 2 };
            }
        }
        places
    }

    /// Returns the number of the place of a control point.
    fn place(&self, axis: usize, control: usize) -> usize {
        let mut place = self.first[axis] + control;
        // A parent is earlier, so the numbers fall.
        while self.same[place] != place {
            place = self.same[place];
        }
        place
    }
}
