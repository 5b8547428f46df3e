//! Solids without wedges along their edges.

use burgeon_base::Stop;
use burgeon_base::error::{Error, ErrorKind, Result};
use glam::DVec3;

use super::room::narrow_edges;
use super::wedge::wedge;
use crate::{EdgeKind, FaceStyle, Shape, SharedStyle, SolidOperation};

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
        let (mut solid, mut shift) = (self.clone(), 0.0_f64);
        for group in separate_groups(&wedges)? {
            Stop::check_current()?;
            if let [_, _, ..] = group.as_slice()
                && let Some(all) = Self::join(&group)?
                && let Some((rest, moved)) = without(&solid, &all)?
            {
                (solid, shift) = (rest, shift.max(moved));
                continue;
            }
            for wedge in group {
                match without(&solid, wedge)? {
                    Some((rest, moved)) => (solid, shift) = (rest, shift.max(moved)),
                    None => failed += 1,
                }
            }
        }
        let style = |style: &SharedStyle| FaceStyle::without_tags(style, "bool");
        Ok(BeveledSolid { solid: solid.with_styles(style).recompose()?, failed, narrow, shift })
    }
}

/// Returns the rest of a solid, and the distance (m) by which the wedge was moved; `None` if nothing remains or the operation fails.
fn without(solid: &Shape, wedge: &Shape) -> Result<Option<(Shape, f64)>> {
    match solid.combine(wedge, SolidOperation::Difference) {
        Err(error) if *error.kind() == ErrorKind::Geometry => Ok(None),
        other => other.map(|rest| rest.solid.map(|solid| (solid, rest.shift))),
    }
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
