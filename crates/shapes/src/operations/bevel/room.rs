//! Room for bevels on the faces of a solid.

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DVec3;
use rustc_hash::FxHashMap;

use crate::mesh::PolygonMesh;

/// Share of a distance that is a rounding error.
const ROUNDING: f64 = 1e-6;

/// Returns the number of edges of `cut`, which have their smaller point first, with a face that is too narrow there for bevels
/// of `distance` (m): a bevel reaches another edge, or the bevel of another edge.
///
/// The middle of each edge is examined. Near corners, bevels always meet.
pub(super) fn narrow_edges(
    mesh: &PolygonMesh,
    normals: &[DVec3],
    cut: &[[u32; 2]],
    distance: f64,
) -> Result<usize> {
    let numbers: FxHashMap<[u32; 2], usize> =
        cut.iter().enumerate().map(|(number, edge)| (*edge, number)).collect();
    let number = |[from, to]: [u32; 2]| numbers.get(&[from.min(to), from.max(to)]).copied();
    let mut narrow = vec![false; cut.len()];
    for (face, normal) in mesh.faces.iter().zip(normals) {
        let edges: Vec<[u32; 2]> = face.edges().collect();
        for own in &edges {
            let Some(own_number) = number(*own) else { continue };
            Stop::check_current()?;
            let [a, b] = own.map(|point| mesh.at(point));
            let (middle, along) = (a.midpoint(b), (b - a).normalize_or_zero());
            let inward = normal.cross(along);
            narrow[own_number] |= edges.iter().filter(|other| *other != own).any(|other| {
                let [c, d] = other.map(|point| mesh.at(point));
                let [from, to] = [c, d].map(|at| (at - middle).dot(along));
                if from * to > 0.0 || from.total_cmp(&to).is_eq() {
                    return false;
                }
                // Where the line across the edge meets the other one.
                let way = (c.lerp(d, from / (from - to)) - middle).dot(inward);
                if way <= 0.0 {
                    return false;
                }
                let slant = (d - c).normalize_or_zero().dot(along).abs();
                let rest = if number(*other).is_some() { (way - distance) * slant } else { way };
                rest < distance * (1.0 - ROUNDING)
            });
        }
    }
    Ok(narrow.into_iter().filter(|narrow| *narrow).count())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Shape;

    fn narrow(shape: &Shape, distance: f64) -> usize {
        let mesh = shape.mesh();
        let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
        let all = Shape::edges_of(&mesh, &normals, None);
        let cut: Vec<[u32; 2]> = all
            .iter()
            .map(|(_, edge)| [edge.ends[0].min(edge.ends[1]), edge.ends[0].max(edge.ends[1])])
            .collect();
        narrow_edges(&mesh, &normals, &cut, distance).expect("a count")
    }

    #[test]
    fn bevels_of_opposite_edges_have_room_up_to_half_of_the_face() {
        let block = Shape::cuboid(DVec3::new(4.0, 3.0, 1.0));
        assert_eq!([0.1, 0.5, 0.51, 1.4].map(|distance| narrow(&block, distance)), [0, 0, 8, 8]);
        assert_eq!(narrow(&block, 2.5), 12);
    }

    #[test]
    fn a_bevel_alone_has_room_up_to_the_opposite_edge() {
        let block = Shape::cuboid(DVec3::new(4.0, 3.0, 1.0));
        let mesh = block.mesh();
        let normals: Vec<DVec3> = mesh.faces.iter().map(|face| mesh.normal(face)).collect();
        let edge = Shape::edges_of(&mesh, &normals, None)[0].1.ends;
        let count = |distance: f64| {
            let cut = [[edge[0].min(edge[1]), edge[0].max(edge[1])]];
            narrow_edges(&mesh, &normals, &cut, distance).expect("a count")
        };
        assert_eq!([0.9, 1.0, 1.1].map(count), [0, 0, 1]);
    }
}
