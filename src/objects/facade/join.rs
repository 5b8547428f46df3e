//! Joins the faces of a frontage: those of one material that lie beside one another become one surface, and where
//! faces meet they have the same corners.

use glam::DVec3;

use super::lay::Face;
use crate::geometry::{Cell, Crossing, Union};

/// Coordinates (m) that differ by less are one.
const SAME: f64 = 1e-9;

/// A corner of a face, by the numbers of its coordinates.
type Corner = [u32; 3];

/// A face between such corners.
#[derive(Clone, Copy)]
struct Bounds {
    /// The lowest left corner, and the one across.
    ends: [Corner; 2],
    /// The axes along which it goes to the right and upwards.
    axes: [usize; 2],
}

/// Surfaces with their corners (m) and triangles. It keeps its memory from one frontage to the next.
#[derive(Default)]
pub struct Joiner {
    /// The coordinates (m) of all corners, along each axis and in order.
    places: [Vec<f64>; 3],
    bounds: Vec<Bounds>,
    /// The corners of all surfaces: in three orders, of which each has those of a line along an axis in a row.
    corners: [Vec<Corner>; 3],
    /// Faces that others may join, with what they need to have in common and their numbers.
    fronts: Vec<(Front, Cell, usize)>,
    union: Union,
    cells: Vec<Cell>,
    others: Vec<Crossing>,
    mesh: FaceMesh,
}

/// What faces of one surface have in common.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Front {
    /// The number of the part of the drawing.
    part: usize,
    /// The number of how far it stands out.
    depth: u32,
}

/// Some faces as one.
#[derive(Debug, Default)]
pub struct FaceMesh {
    /// Its corners (m).
    pub corners: Vec<DVec3>,
    /// Counter-clockwise from outside, by the numbers of corners.
    pub triangles: Vec<[u32; 3]>,
}

impl Joiner {
    /// Joins `faces`, each of which belongs to one of `parts`. Gives each surface to `draw` with the number of a face
    /// that it is like.
    pub fn join(&mut self, faces: &[Face<'_>], parts: &[usize], mut draw: impl FnMut(usize, &FaceMesh)) {
        self.measure(faces);
        self.fronts.clear();
        self.corners.iter_mut().for_each(Vec::clear);
        let [all, ..] = &mut self.corners;
        for (number, (face, bounds)) in faces.iter().zip(&self.bounds).enumerate() {
            match bounds.as_front().filter(|_| !face.stretched) {
                Some(cell) => {
                    let front = Front { part: parts[number], depth: bounds.ends[0][2] };
                    self.fronts.push((front, cell, number));
                }
                None => all.extend(bounds.corners()),
            }
        }
        self.fronts.sort_unstable();
        for group in self.fronts.chunk_by(|a, b| a.0 == b.0) {
            self.cells.clear();
            self.cells.extend(group.iter().map(|(_, cell, _)| *cell));
            self.union.corners(&self.cells, |[x, y]| all.push([x, y, group[0].0.depth]));
        }
        self.sort_corners();
        self.draw_fronts(&mut draw);
        for (number, face) in faces.iter().enumerate() {
            let bounds = self.bounds[number];
            if !bounds.is_empty() && (face.stretched || bounds.as_front().is_none()) {
                self.draw_face(&bounds);
                draw(number, &self.mesh);
            }
        }
    }

    /// Numbers the coordinates of the faces.
    fn measure(&mut self, faces: &[Face<'_>]) {
        self.places.iter_mut().for_each(Vec::clear);
        let ends = |face: &Face<'_>| [face.at, face.at + face.right + face.up];
        for end in faces.iter().flat_map(ends) {
            for (places, place) in self.places.iter_mut().zip(end.to_array()) {
                let number = number(places, place);
                if places.get(number).is_none_or(|known| *known > place + SAME) {
                    places.insert(number, place);
                }
            }
        }
        let places = &self.places;
        self.bounds.clear();
        self.bounds.extend(faces.iter().map(|face| {
            let ends = ends(face).map(|end| {
                let end = end.to_array();
                std::array::from_fn(|axis| number(&places[axis], end[axis]) as u32)
            });
            let axis = |way: DVec3| way.abs().max_position();
            Bounds { ends, axes: [axis(face.right), axis(face.up)] }
        }));
    }

    /// Puts the corners into their three orders.
    fn sort_corners(&mut self) {
        let [x, y, z] = &mut self.corners;
        x.sort_unstable_by_key(|corner| in_order(*corner, 0));
        x.dedup();
        for (axis, corners) in [(1, y), (2, z)] {
            corners.extend_from_slice(x);
            corners.sort_unstable_by_key(|corner| in_order(*corner, axis));
        }
    }

    /// Draws the surfaces of faces that others may join.
    fn draw_fronts(&mut self, draw: &mut impl FnMut(usize, &FaceMesh)) {
        let Self { places, corners: [corners, ..], fronts, union, cells, others, mesh, .. } = self;
        for group in fronts.chunk_by(|a, b| a.0 == b.0) {
            let (Front { depth, .. }, _, number) = group[0];
            cells.clear();
            cells.extend(group.iter().map(|(_, cell, _)| *cell));
            let from = corners.partition_point(|corner| corner[2] < depth);
            let plane = corners[from..].iter().take_while(|corner| corner[2] == depth);
            others.clear();
            others.extend(plane.map(|&[x, y, _]| [x, y]));
            union.triangulate(cells, others, [&places[0], &places[1]]);
            mesh.take(union, false, |[x, y]| place(places, [x, y, depth]));
            draw(number, mesh);
        }
    }

    /// Makes a surface of a single face.
    fn draw_face(&mut self, bounds: &Bounds) {
        let Self { places, corners, union, others, mesh, .. } = self;
        let ring = bounds.corners();
        others.clear();
        for (side, &from) in ring.iter().enumerate() {
            let axis = bounds.axes[side % 2];
            let to = ring[(side + 1) % 4];
            let [low, high] = [from.min(to), from.max(to)].map(|end| in_order(end, axis));
            let line = &corners[axis];
            let begin = line.partition_point(|corner| in_order(*corner, axis) <= low);
            let between = line[begin..].iter().take_while(|corner| in_order(**corner, axis) < high);
            others.extend(between.map(|corner| bounds.axes.map(|axis| corner[axis])));
        }
        if others.is_empty() {
            mesh.corners.clear();
            mesh.corners.extend(ring.map(|corner| place(places, corner)));
            mesh.triangles.clear();
            mesh.triangles.extend([[0, 1, 2], [0, 2, 3]]);
            return;
        }
        others.sort_unstable_by_key(|[x, y]| [*y, *x]);
        let [right, up] = bounds.axes;
        let [x, y] = bounds.axes.map(|axis| bounds.ends.map(|end| end[axis]));
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let cell = Cell { x: sorted(x), y: sorted(y) };
        union.triangulate(&[cell], others, [&places[right], &places[up]]);
        let mirrored = (x[0] > x[1]) != (y[0] > y[1]);
        mesh.take(union, mirrored, |[x, y]| {
            let mut corner = bounds.ends[0];
            corner[right] = x;
            corner[up] = y;
            place(places, corner)
        });
    }
}

impl Bounds {
    fn is_empty(&self) -> bool {
        let [low, high] = self.ends;
        self.axes.iter().any(|axis| low[*axis] == high[*axis])
    }

    /// The four corners, counter-clockwise from outside.
    fn corners(&self) -> [Corner; 4] {
        let [low, high] = self.ends;
        let [right, up] = self.axes;
        let mut corners = [low, low, high, low];
        corners[1][right] = high[right];
        corners[3][up] = high[up];
        corners
    }

    /// Where it is among the lines, if it looks out of the building.
    fn as_front(&self) -> Option<Cell> {
        let [low, high] = self.ends;
        let is_front = self.axes == [0, 1] && low[0] < high[0] && low[1] < high[1];
        is_front.then_some(Cell { x: [low[0], high[0]], y: [low[1], high[1]] })
    }
}

impl FaceMesh {
    /// That of a face by itself.
    pub fn of(face: &Face<'_>) -> Self {
        let Face { at, right, up, .. } = *face;
        Self {
            corners: vec![at, at + right, at + right + up, at + up],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
        }
    }

    /// Takes over what `union` has found. It is seen from behind if it is `mirrored`.
    fn take(&mut self, union: &Union, mirrored: bool, place: impl Fn(Crossing) -> DVec3) {
        self.corners.clear();
        self.corners.extend(union.vertices.iter().map(|crossing| place(*crossing)));
        self.triangles.clear();
        let turned = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        self.triangles.extend(union.triangles.iter().map(|triangle| turned(*triangle)));
    }
}

/// The number of a coordinate (m) among `places`, or that which it would have.
fn number(places: &[f64], place: f64) -> usize {
    places.partition_point(|known| *known < place - SAME)
}

fn place(places: &[Vec<f64>; 3], corner: Corner) -> DVec3 {
    DVec3::from(std::array::from_fn(|axis| places[axis][corner[axis] as usize]))
}

/// What `corner` is sorted by so that those of a line along `axis` are in a row.
fn in_order([x, y, z]: Corner, axis: usize) -> Corner {
    match axis {
        0 => [z, y, x],
        1 => [z, x, y],
        _ => [x, y, z],
    }
}
