//! The surface of a tree of tubes.

use super::axis::{JoinedTubes, JointAxis};
use super::body::{EndRings, Tube};
use super::patch::JointPatch;
use super::placement::place_rings;
use super::tree::TubeTree;
use crate::sweeps::strand::MOST_SIDES;
use burgeon_base::Stop;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_scene::{Part, Triangles};

/// Number of edges or joints between two checks for cancellation.
const STRETCH: usize = 1024;
/// Maximum number of vertices that one edge or one joint adds, which is checked before it is drawn.
const MOST_ADDED: usize = 1 << 22;

/// Adds a tree of tubes as one closed surface: rings along each axis, and a smooth patch at each joint.
///
/// An axis whose parent is a point of an earlier axis forms a joint there, also at the start or the end of its parent.
/// Axes without a parent, or that begin elsewhere, are bodies of their own. At a joint, the rings stop where the tubes
/// do not overlap. If that is further out than the next joint or the end of an axis, or if two tubes leave in nearly the
/// same direction, the later one begins in the joint as a closed body ([`JoinedTubes::separate`]).
///
/// `sides` (3 to 64) is the minimum number of faces around. Ends are flat, or tips where the radius is 0. Texture
/// coordinates are in metres: u around, to both sides of the middle of the outline, and v along the axis. A joint has
/// those of its first axis. Fails if a number is not finite, if the outline of an end is too narrow or if the part is
/// full; then the part may contain some of the tubes.
///
/// ```
/// use burgeon_geometry::{AxisPoint, CylinderPoint, JointAxis, joined_tubes, solid};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// let point = |x: f64, z: f64| CylinderPoint {
///     position: DVec3::new(x, 0.0, z),
///     radius: 0.1,
///     contour: None,
///     side: None,
/// };
/// let trunk = JointAxis { points: vec![point(0.0, 0.0), point(0.0, 1.0), point(0.0, 2.0)], ..Default::default() };
/// let branch = JointAxis {
///     points: vec![point(0.0, 1.0), point(1.0, 1.0)],
///     parent: Some(AxisPoint { axis: 0, point: 1 }),
///     ..Default::default()
/// };
/// let mut part = Part::default();
/// let found = joined_tubes(&mut part, &[trunk, branch], 8)?;
/// assert!(solid::check([&part]).is_solid());
/// assert_eq!((found.joints, found.separate.len()), (1, 0));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn joined_tubes(part: &mut Part, axes: &[JointAxis], sides: usize) -> Result<JoinedTubes> {
    if !(3..=MOST_SIDES).contains(&sides) {
        return Err(Error::argument(format!("a round tube cannot have {sides} sides"))
            .help(format!("give 3 to {MOST_SIDES} sides")));
    }
    let mut tree = TubeTree::new(axes, sides)?;
    place_rings(&mut tree)?;
    let mut found = JoinedTubes::default();
    for end in &tree.separate {
        let edge = &tree.edges[end.edge];
        found.separate.push(tree.given(edge.axis, edge.controls[end.end]));
    }
    let mut ends = EndRings::default();
    let mut tube = Tube::default();
    for index in 0..tree.edges.len() {
        check(part, index)?;
        tube.add(part, &tree, index, &mut found, &mut ends)?;
    }
    let mut patch = JointPatch::default();
    let steps = piece_count(sides);
    for (index, joint) in tree.joints.iter().enumerate() {
        check(part, index)?;
        let before = part.triangles.len();
        patch.add(part, &tree, joint, &ends, steps);
        let at = tree.given(joint.at.axis, joint.at.point);
        found.add_run(at, part.triangles.len() - before);
        found.joints += usize::from(!joint.faces.is_empty());
    }
    Ok(found)
}

/// Returns the number of pieces of each curve between two rings with this number of `sides`.
fn piece_count(sides: usize) -> u32 {
    match sides {
        0..=8 => 2,
        9..=16 => 3,
        _ => 4,
    }
}

/// Fails if the run is cancelled or if the part is full.
fn check(part: &Part, index: usize) -> Result<()> {
    if index % STRETCH == STRETCH - 1 {
        Stop::check_current()?;
    }
    if part.positions.len().max(part.triangles.len()) > Triangles::MOST_BEFORE - MOST_ADDED {
        return Err(Error::limit(
            Limit::Size,
            format!("a mesh can have at most {} vertices or triangles", u32::MAX),
        )
        .help("draw fewer branches or fewer sides, or begin another mesh"));
    }
    Ok(())
}
