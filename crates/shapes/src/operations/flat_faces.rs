//! Removal of triangles without area.

use rustc_hash::FxHashMap;

use crate::mesh::PolygonMesh;

/// Largest thickness of a triangle without area, as a fraction of its longest edge.
const FLAT: f64 = 1e-9;

/// Removes triangles without area from a mesh of triangles: the corner on the longest edge becomes a corner of the
/// neighbour there, so that a closed mesh stays closed.
pub(crate) fn remove_flat_triangles(mesh: &mut PolygonMesh) {
    let corners = |mesh: &PolygonMesh, face: usize| -> Option<[u32; 3]> {
        let [ring] = mesh.faces[face].rings.as_slice() else { return None };
        <[u32; 3]>::try_from(ring.as_slice()).ok()
    };
    let is_flat = |mesh: &PolygonMesh, ring: [u32; 3]| {
        let [a, b, c] = ring.map(|point| mesh.at(point));
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
        (b - a).cross(c - a).length() <= longest * FLAT
    };
    let flat: Vec<usize> = (0..mesh.faces.len())
        .filter(|&face| corners(mesh, face).is_some_and(|ring| is_flat(mesh, ring)))
        .collect();
    if flat.is_empty() {
        return;
    }
    let mut sides: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    for (number, face) in mesh.faces.iter().enumerate() {
        face.edges().for_each(|edge| {
            sides.insert(edge, number);
        });
    }
    for number in flat {
        // An earlier removal may have added a corner.
        let Some(ring) = corners(mesh, number) else { continue };
        let length = |side: usize| mesh.at(ring[side]).distance_squared(mesh.at(ring[(side + 1) % 3]));
        let longest = (0..3).max_by(|a, b| length(*a).total_cmp(&length(*b))).unwrap_or(0);
        let (from, to, middle) = (ring[longest], ring[(longest + 1) % 3], ring[(longest + 2) % 3]);
        let Some(&neighbor) = sides.get(&[to, from]).filter(|neighbor| **neighbor != number) else {
            continue;
        };
        let place = mesh.faces[neighbor].rings.iter_mut().find_map(|ring| {
            let at = (0..ring.len()).find(|&at| ring[at] == to && ring[(at + 1) % ring.len()] == from)?;
            Some((ring, at))
        });
        let Some((ring, at)) = place else { continue };
        ring.insert(at + 1, middle);
        sides.insert([to, middle], neighbor);
        sides.insert([middle, from], neighbor);
        mesh.faces[number].rings.clear();
    }
    mesh.faces.retain(|face| !face.rings.is_empty());
}
