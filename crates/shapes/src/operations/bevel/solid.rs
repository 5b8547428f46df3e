//! Solids without wedges along their edges.

use burgeon_base::Stop;
use burgeon_base::error::{Error, ErrorKind, Result};
use glam::DVec3;

use super::room::narrow_edges;
use super::wedge::wedge;
use crate::{CombinedSolid, EdgeKind, FaceStyle, Shape, SharedStyle, SolidOperation};

/// Largest number of edges of one call.
const MOST_EDGES: usize = 20_000;
/// Distance (m) beyond which boxes are apart from each other.
const GAP: f64 = 1e-5;

/// A solid with bevels along its edges, and its differences from the request.
#[derive(Debug, Clone)]
pub struct BeveledSolid {
    /// Solid.
    pub solid: Shape,
    /// Number of edges that could not be cut.
    pub failed: usize,
    /// Number of edges with a face that is too narrow for the bevel, which meets another edge or its bevel.
    pub narrow: usize,
    /// Greatest distance (m) by which what is cut off was moved, because the set operation fails numerically without it.
    pub shift: f64,
}

impl Shape {
    /// Returns a solid whose convex edges are cut off by planes that begin at `distance` (m) from the edge on both faces;
    /// with `segments` above 0, rounded by arcs of as many segments that touch the faces there.
    ///
    /// `kinds` selects edges; all convex edges unless given. Fails if the shape is open.
    pub fn bevel(&self, distance: f64, segments: u32, kinds: Option<&[EdgeKind]>) -> Result<BeveledSolid> {
        if !(distance > 0.0 && distance.is_finite()) || segments > 64 {
            return Err(Error::argument(format!("a bevel of {distance} m with {segments} segments"))
                .help("use a distance above 0, and at most 64 segments"));
        }
        if !self.is_closed() {
            return Err(Error::geometry("only solids have edges to cut off").help("extrude the faces first"));
        }
        let mesh = self.mesh();
        let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
        let edges = Self::edges_of(&mesh, &normals, kinds);
        if edges.len() > MOST_EDGES {
            return Err(Error::argument(format!("the solid has {} edges", edges.len()))
                .help(format!("cut off at most {MOST_EDGES}, such as those of one kind")));
        }
        let (mut wedges, mut cut, mut failed) = (Vec::new(), Vec::new(), 0);
        for (shape, edge) in &edges {
            Stop::check_current()?;
            let [Some(first), Some(second)] = edge.faces else { continue };
            // Several solids touch at an edge of more faces.
            if edge.count > 2 {
                failed += 1;
                continue;
            }
            let Some(wedge) = wedge(shape, [normals[first], normals[second]], distance, segments)? else {
                continue;
            };
            wedges.push(wedge);
            cut.push([edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])]);
        }
        let narrow = narrow_edges(&mesh, &normals, &cut, distance)?;
        let CutSolid { solid, failed: left, shift } =
            cut_off(self, &wedges, |solid, wedge| solid.combine(wedge, SolidOperation::Difference))?;
        failed += left;
        let style = |style: &SharedStyle| FaceStyle::without_tags(style, "bool");
        Ok(BeveledSolid { solid: solid.with_styles(style).recompose()?, failed, narrow, shift })
    }
}

/// A solid without what was cut off.
struct CutSolid {
    solid: Shape,
    /// Number of wedges that could not be cut off.
    failed: usize,
    /// Greatest distance (m) by which a wedge was moved.
    shift: f64,
}

/// Cuts wedges off a solid with the set operation `subtract`.
fn cut_off(
    solid: &Shape,
    wedges: &[Shape],
    subtract: impl Fn(&Shape, &Shape) -> Result<CombinedSolid>,
) -> Result<CutSolid> {
    // Nothing remains, or the operation fails.
    let without = |solid: &Shape, wedge: &Shape| match subtract(solid, wedge) {
        Err(error) if *error.kind() == ErrorKind::Geometry => Ok(None),
        rest => rest.map(|rest| rest.solid.map(|solid| (solid, rest.shift))),
    };
    let mut cut = CutSolid { solid: solid.clone(), failed: 0, shift: 0.0 };
    for group in separate_groups(wedges)? {
        Stop::check_current()?;
        if let [_, _, ..] = group.as_slice()
            && let Some(all) = Shape::join_separate(&group)?
            && let Some((rest, moved)) = without(&cut.solid, &all)?
        {
            (cut.solid, cut.shift) = (rest, cut.shift.max(moved));
            continue;
        }
        for wedge in group {
            match without(&cut.solid, wedge)? {
                Some((rest, moved)) => (cut.solid, cut.shift) = (rest, cut.shift.max(moved)),
                None => cut.failed += 1,
            }
        }
    }
    Ok(cut)
}

/// Divides shapes into groups whose boxes are apart from each other; a shape is in the first group with room for it.
fn separate_groups(shapes: &[Shape]) -> Result<Vec<Vec<&Shape>>> {
    let mut groups: Vec<Vec<(&Shape, [DVec3; 2])>> = Vec::new();
    for shape in shapes {
        Stop::check_current()?;
        let [low, high] = shape.bounds();
        let is_apart =
            |other: &[DVec3; 2]| (low - GAP).cmpgt(other[1]).any() || (high + GAP).cmplt(other[0]).any();
        let room = groups.iter_mut().find(|group| group.iter().all(|(_, other)| is_apart(other)));
        match room {
            Some(group) => group.push((shape, [low, high])),
            None => groups.push(vec![(shape, [low, high])]),
        }
    }
    Ok(groups.into_iter().map(|group| group.into_iter().map(|(shape, _)| shape).collect()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_chamfered_upright_edge_loses_a_triangular_prism() {
        let block = Shape::cuboid(DVec3::new(4.0, 3.0, 5.0));
        let cut = block.bevel(0.5, 0, Some(&[EdgeKind::Corner])).expect("a solid");
        assert_eq!((cut.failed, cut.narrow), (0, 0));
        let volume = cut.solid.volume();
        assert!((volume - (60.0 - 4.0 * 0.125 * 5.0)).abs() < 1e-6, "{volume}");
        assert!(cut.solid.is_closed() && cut.solid.body.faces() == 10, "{}", cut.solid.body.faces());
    }

    #[test]
    fn the_greatest_shift_and_the_failures_of_all_wedges_are_known() {
        let block = Shape::cuboid(DVec3::splat(2.0));
        // Wedges that overlap are cut off one after the other.
        let wedges: Vec<Shape> = [-0.9, -0.8, -0.7, -0.6]
            .map(|x| Shape::cuboid(DVec3::splat(1.0)).translate(DVec3::new(x, -0.5, -0.5)))
            .to_vec();
        let number = std::cell::Cell::new(0);
        let cut = cut_off(&block, &wedges, |solid, wedge| {
            number.set(number.get() + 1);
            if number.get() == 3 {
                return Err(Error::geometry("it fails"));
            }
            let rest = solid.combine(wedge, SolidOperation::Difference)?;
            Ok(CombinedSolid { shift: [0.0, 2e-6, 9e-6, 1e-6][number.get() - 1], ..rest })
        })
        .expect("a solid");
        assert_eq!((cut.failed, cut.shift), (1, 2e-6));
        assert!((cut.solid.volume() - (8.0 - 0.4 * 0.25)).abs() < 1e-9, "{}", cut.solid.volume());
    }

    #[test]
    fn all_edges_of_a_box_can_be_rounded() {
        let block = Shape::cuboid(DVec3::splat(2.0));
        let round = block.bevel(0.3, 4, None).expect("a solid");
        assert_eq!((round.failed, round.narrow), (0, 0));
        let volume = round.solid.volume();
        assert!(round.solid.is_closed() && volume < 8.0 && volume > 7.2, "{volume}");
    }

    #[test]
    fn a_concave_edge_stays() {
        let ring = [(0.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 4.0), (0.0, 4.0)];
        let plan = Shape::plan(&[ring.map(glam::DVec2::from).to_vec()], 0.0).expect("a face");
        let angle = plan.extrude(2.0, None).expect("a solid");
        let cut = angle.bevel(0.2, 0, Some(&[EdgeKind::Corner])).expect("a solid");
        let volume = cut.solid.volume();
        assert_eq!((cut.failed, cut.narrow), (0, 0));
        assert!((volume - (14.0 - 5.0 * 0.02 * 2.0)).abs() < 1e-6, "{volume}");
    }

    #[test]
    fn all_edges_of_a_cylinder_of_many_sides_lose_the_same() {
        for sides in [24, 96] {
            let solid = Shape::cylinder(4.0, 4.0, 2.0, sides).expect("a cylinder");
            let cut = solid.bevel(0.1, 0, None).expect("a solid");
            assert_eq!(cut.failed, 0);
            let lost = solid.volume() - cut.solid.volume();
            // Prisms along the rims and along the upright edges, which overlap at their ends.
            let turn = std::f64::consts::TAU / f64::from(sides);
            let (side, upright) = (8.0 * (turn / 2.0).sin(), 0.005 * turn.sin() * 2.0);
            let prisms = f64::from(sides) * (2.0 * 0.005 * side + upright);
            assert!(
                cut.solid.is_closed() && lost > 0.95 * prisms && lost < prisms,
                "{sides}: {lost} {prisms}"
            );
        }
    }
}
