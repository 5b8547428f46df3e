//! Faces of a subdivision and the planes over them.

use burgeon_base::Stop;
use burgeon_base::error::Result;
use glam::DVec2;

use super::cells::{CellSide, Zone};
use super::heights::HeightField;
use crate::overlay::Subdivision;
use crate::planar::{contains, twice_area};

/// Maximum distance (m) from its longest edge of the place that represents a face.
const BESIDE: f64 = 1e-4;
/// Width (m) below which a face has the plane of a neighbour.
const NARROW: f64 = 1e-4;
/// Number of faces between two checks for cancellation.
const STRETCH: usize = 256;

/// Half-edges of a subdivision: an edge has the half-edge with twice its number, from its left end to its right end, and the
/// next one in the other direction. The face of a half-edge is on its left.
pub(super) struct FaceGraph {
    /// Connected component of each node.
    components: Vec<u32>,
}

/// A border of a face.
struct FaceBorder {
    halves: Vec<usize>,
    /// Twice the area (m²), negative for holes.
    twice_area: f64,
}

impl FaceGraph {
    pub(super) fn new(division: &Subdivision) -> Self {
        Self { components: components(division, |_| true) }
    }

    /// Returns the side of each half-edge: the plane at its face.
    pub(super) fn sides(&self, division: &Subdivision, field: &HeightField) -> Result<Vec<CellSide>> {
        let count = 2 * division.edges.len();
        let zone = |half: usize| {
            let edge = &division.edges[half / 2];
            match (if half.is_multiple_of(2) { edge.above } else { edge.below }).map(|count| count != 0) {
                [true, _] => Zone::Inside,
                [false, true] => Zone::Eaves,
                [false, false] => Zone::Outside,
            }
        };
        let mut sides: Vec<CellSide> =
            (0..count).map(|half| CellSide { zone: zone(half), plane: 0 }).collect();
        let faces = faces(division, &self.components, |_| true)?;
        let mut narrow = Vec::new();
        for (number, face) in faces.iter().enumerate() {
            if number.is_multiple_of(STRETCH) {
                Stop::check_current()?;
            }
            let halves = || face.iter().flat_map(|border| &border.halves).copied();
            let length = |half: usize| way(division, half).length();
            let longest = halves().max_by(|a, b| length(*a).total_cmp(&length(*b)));
            let Some(longest) = longest.filter(|half| sides[*half].zone != Zone::Outside) else { continue };
            let width = face[0].twice_area / length(longest).max(1e-12);
            if width < NARROW {
                narrow.push((longest, face));
                continue;
            }
            let beside = BESIDE.min(0.2 * width);
            let way = way(division, longest);
            let place = start(division, longest) + way / 2.0 + way.perp().normalize_or_zero() * beside;
            let plane = field.plane_at(place);
            halves().for_each(|half| sides[half].plane = plane);
        }
        for (longest, face) in narrow {
            let halves = || face.iter().flat_map(|border| &border.halves).copied();
            let is_beside = |half: &usize| sides[*half ^ 1].zone == sides[longest].zone;
            let length = |half: usize| way(division, half).length();
            let neighbor = halves().filter(is_beside).max_by(|a, b| length(*a).total_cmp(&length(*b)));
            let plane = neighbor.map_or_else(
                || field.plane_at(start(division, longest) + way(division, longest) / 2.0),
                |half| sides[half ^ 1].plane,
            );
            halves().for_each(|half| sides[half].plane = plane);
        }
        Ok(sides)
    }

    /// Returns the rings of nodes of all faces between the edges for which `keeps` returns true, each with a half-edge of the
    /// face.
    pub(super) fn rings(
        &self,
        division: &Subdivision,
        keeps: impl Fn(usize) -> bool,
    ) -> Result<Vec<(usize, Vec<Vec<u32>>)>> {
        let components = components(division, &keeps);
        let faces = faces(division, &components, keeps)?;
        let nodes = |border: &FaceBorder| border.halves.iter().map(|half| first(division, *half)).collect();
        Ok(faces.iter().map(|face| (face[0].halves[0], face.iter().map(nodes).collect())).collect())
    }
}

/// Returns the faces between the edges for which `keeps` returns true, each with its outer border first.
/// Fails if the work of this thread is cancelled.
fn faces(
    division: &Subdivision,
    components: &[u32],
    keeps: impl Fn(usize) -> bool,
) -> Result<Vec<Vec<FaceBorder>>> {
    let mut next = vec![usize::MAX; 2 * division.edges.len()];
    for (_, star) in division.stars() {
        let kept =
            star.iter().map(|&(edge, is_end)| (edge as usize, is_end)).filter(|(edge, _)| keeps(*edge));
        let out: Vec<usize> = kept.map(|(edge, is_end)| 2 * edge + usize::from(is_end)).collect();
        for (index, half) in out.iter().enumerate() {
            next[half ^ 1] = out[(index + out.len() - 1) % out.len()];
        }
    }
    let mut seen = vec![false; next.len()];
    let (mut faces, mut holes): (Vec<Vec<FaceBorder>>, Vec<FaceBorder>) = (Vec::new(), Vec::new());
    for begin in 0..next.len() {
        if seen[begin] || next[begin] == usize::MAX {
            continue;
        }
        let (mut halves, mut half) = (Vec::new(), begin);
        while !seen[half] {
            seen[half] = true;
            halves.push(half);
            half = next[half];
        }
        let from = start(division, begin);
        let twice_area = twice_area(halves.iter().map(|half| start(division, *half) - from));
        let border = FaceBorder { halves, twice_area };
        if twice_area > 0.0 {
            faces.push(vec![border]);
        } else {
            holes.push(border);
        }
    }
    let component = |border: &FaceBorder| components[first(division, border.halves[0]) as usize];
    let corners = |border: &FaceBorder| -> Vec<DVec2> {
        border.halves.iter().map(|half| start(division, *half)).collect()
    };
    for hole in holes {
        Stop::check_current()?;
        let at = start(division, hole.halves[0]);
        let around = (0..faces.len())
            .filter(|&face| component(&faces[face][0]) != component(&hole))
            .filter(|&face| contains(&corners(&faces[face][0]), at))
            .min_by(|&one, &other| faces[one][0].twice_area.total_cmp(&faces[other][0].twice_area));
        if let Some(face) = around {
            faces[face].push(hole);
        }
    }
    Ok(faces)
}

/// Returns the number of the connected component of each node.
#[allow(clippy::cast_possible_truncation, reason = "a subdivision has fewer than 2^32 nodes")]
fn components(division: &Subdivision, keeps: impl Fn(usize) -> bool) -> Vec<u32> {
    fn root(parents: &mut [u32], mut index: u32) -> u32 {
        while parents[index as usize] != index {
            parents[index as usize] = parents[parents[index as usize] as usize];
            index = parents[index as usize];
        }
        index
    }
    let mut parents: Vec<u32> = (0..division.places.len() as u32).collect();
    for (_, edge) in division.edges.iter().enumerate().filter(|(index, _)| keeps(*index)) {
        let [a, b] = edge.ends.map(|node| root(&mut parents, node));
        parents[a.max(b) as usize] = a.min(b);
    }
    (0..parents.len() as u32).map(|index| root(&mut parents, index)).collect()
}

/// Returns the first node of a half-edge.
fn first(division: &Subdivision, half: usize) -> u32 {
    division.edges[half / 2].ends[half % 2]
}

/// Returns the place of the first node of a half-edge.
fn start(division: &Subdivision, half: usize) -> DVec2 {
    division.places[first(division, half) as usize]
}

/// Returns the vector along a half-edge.
fn way(division: &Subdivision, half: usize) -> DVec2 {
    start(division, half ^ 1) - start(division, half)
}
