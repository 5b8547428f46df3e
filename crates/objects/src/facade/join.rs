//! The union of a frontage's faces: adjacent faces of one material become one surface, and faces share corners where
//! they meet.

use std::cell;

use glam::DVec3;

use super::lay::FacadeFace;
use burgeon_geometry::{Crossing, Union, UnionCell};
use burgeon_scene::SurfaceMeaning;

/// Distance (m) below which two coordinates are equal.
const SAME: f64 = 1e-9;

/// A corner of a face, by the numbers of its coordinates.
type CornerNumbers = [u32; 3];

/// A corner as a sort key: the corners of a line along one axis have consecutive keys.
type CornerKey = u128;

/// A face between two numbered corners.
#[derive(Clone, Copy)]
struct CornerBounds {
    /// Lower left corner and the opposite corner.
    ends: [CornerNumbers; 2],
    /// Axes of the face's right and up directions.
    axes: [usize; 2],
}

/// The surfaces of a frontage, with corners (m) and triangles. Reuses its memory for the next frontage.
#[derive(Default)]
pub struct Joiner {
    /// Coordinates (m) of all corners, sorted, for each axis.
    places: [Vec<f64>; 3],
    bounds: Vec<CornerBounds>,
    /// Corners of all surfaces that other surfaces may have to share, in three orders. In each order, the corners of a
    /// line along one axis are contiguous.
    corners: [Vec<CornerKey>; 3],
    /// Faces that may be joined, with their group and their numbers.
    fronts: Vec<(SurfaceGroup, UnionCell, usize)>,
    union: Union,
    cells: Vec<UnionCell>,
    others: Vec<Crossing>,
    mesh: FaceMesh,
}

/// The properties that the faces of one surface share.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct SurfaceGroup {
    /// Number of the drawing's part.
    part: usize,
    /// Number of the depth coordinate.
    depth: u32,
    meaning: SurfaceMeaning,
}

/// A mesh of one or several faces.
#[derive(Debug, Default)]
pub struct FaceMesh {
    /// Corners (m).
    pub corners: Vec<DVec3>,
    /// Triangles by corner number, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

thread_local! {
    /// Last joiner of the thread, whose memory is reused: a city has a hundred thousand frontages.
    static SPARE: cell::Cell<Option<Box<Joiner>>> = const { cell::Cell::new(None) };
}

impl Joiner {
    /// Returns the spare joiner of this thread, or a new one.
    pub fn take_spare() -> Box<Self> {
        SPARE.take().unwrap_or_default()
    }

    /// Keeps this joiner as the spare of this thread.
    pub fn retire(self: Box<Self>) {
        SPARE.set(Some(self));
    }

    /// Joins `faces`, each of which belongs to one of `parts`. Calls `draw` with each surface and the number of a
    /// representative face.
    pub fn join(
        &mut self,
        faces: &[FacadeFace<'_>],
        parts: &[usize],
        mut draw: impl FnMut(usize, &FaceMesh),
    ) {
        if let [face] = faces {
            self.mesh.cover(face);
            return draw(0, &self.mesh);
        }
        self.measure(faces);
        self.gather(faces, parts);
        self.draw_fronts(&mut draw);
        for (number, face) in faces.iter().enumerate() {
            let bounds = self.bounds[number];
            if !bounds.is_empty() && (face.stretched || bounds.as_front().is_none()) {
                self.draw_face(&bounds);
                draw(number, &self.mesh);
            }
        }
    }

    /// Collects the faces that may be joined, and the corners of all surfaces.
    fn gather(&mut self, faces: &[FacadeFace<'_>], parts: &[usize]) {
        self.fronts.clear();
        self.corners.iter_mut().for_each(Vec::clear);
        let [all, ..] = &mut self.corners;
        // Set if a single face may have corners of other faces on its edges.
        let mut is_wide = false;
        for (number, (face, bounds)) in faces.iter().zip(&self.bounds).enumerate() {
            match bounds.as_front().filter(|_| !face.stretched) {
                Some(cell) => {
                    let depth = bounds.ends[0][2];
                    let front = SurfaceGroup { part: parts[number], depth, meaning: face.meaning };
                    self.fronts.push((front, cell, number));
                }
                None => {
                    all.extend(bounds.corners().map(|corner| key(corner, 0)));
                    is_wide |= bounds.axes.iter().any(|axis| bounds.is_wide(*axis));
                }
            }
        }
        self.fronts.sort_unstable();
        let is_one = self.fronts.first().map(|front| front.0) == self.fronts.last().map(|front| front.0);
        let groups = self.fronts.chunk_by(|a, b| a.0 == b.0);
        for group in groups.filter(|_| is_wide || !is_one) {
            self.cells.clear();
            self.cells.extend(group.iter().map(|(_, cell, _)| *cell));
            self.union.corners(&self.cells, |[x, y]| all.push(key([x, y, group[0].0.depth], 0)));
        }
        all.sort_unstable();
        all.dedup();
        if is_wide {
            let [x, y, z] = &mut self.corners;
            for (axis, corners) in [(1, y), (2, z)] {
                corners.extend(x.iter().map(|known| key(corner(*known, 0), axis)));
                corners.sort_unstable();
            }
        }
    }

    /// Numbers the coordinates of the faces.
    fn measure(&mut self, faces: &[FacadeFace<'_>]) {
        self.places.iter_mut().for_each(Vec::clear);
        let ends = |face: &FacadeFace<'_>| [face.at, face.at + face.right + face.up];
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
            CornerBounds { ends, axes: [axis(face.right), axis(face.up)] }
        }));
    }

    /// Draws the surfaces of faces that may be joined.
    fn draw_fronts(&mut self, draw: &mut impl FnMut(usize, &FaceMesh)) {
        let Self { places, corners: [corners, ..], fronts, union, cells, others, mesh, .. } = self;
        for group in fronts.chunk_by(|a, b| a.0 == b.0) {
            let (SurfaceGroup { depth, .. }, _, number) = group[0];
            cells.clear();
            cells.extend(group.iter().map(|(_, cell, _)| *cell));
            let from = corners.partition_point(|known| *known < key([0, 0, depth], 0));
            let plane = corners[from..].iter().map(|known| corner(*known, 0));
            others.clear();
            others.extend(plane.take_while(|corner| corner[2] == depth).map(|[x, y, _]| [x, y]));
            union.triangulate(cells, others, [&places[0], &places[1]]);
            mesh.take(union, false, |[x, y]| place(places, [x, y, depth]));
            draw(number, mesh);
        }
    }

    /// Builds the surface of a single face.
    fn draw_face(&mut self, bounds: &CornerBounds) {
        let Self { places, corners, union, others, mesh, .. } = self;
        let ring = bounds.corners();
        others.clear();
        for (side, &from) in ring.iter().enumerate() {
            let axis = bounds.axes[side % 2];
            if bounds.is_wide(axis) {
                let to = ring[(side + 1) % 4];
                let [low, high] = [from.min(to), from.max(to)].map(|end| key(end, axis));
                let line = &corners[axis];
                let begin = line.partition_point(|known| *known <= low);
                let between = line[begin..].iter().take_while(|known| **known < high);
                let between = between.map(|known| corner(*known, axis));
                others.extend(between.map(|corner| bounds.axes.map(|axis| corner[axis])));
            }
        }
        if others.is_empty() {
            mesh.set(ring.map(|corner| place(places, corner)));
            return;
        }
        others.sort_unstable_by_key(|[x, y]| [*y, *x]);
        let [right, up] = bounds.axes;
        let [x, y] = bounds.axes.map(|axis| bounds.ends.map(|end| end[axis]));
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let cell = UnionCell { x: sorted(x), y: sorted(y) };
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

impl CornerBounds {
    fn is_empty(&self) -> bool {
        let [low, high] = self.ends;
        self.axes.iter().any(|axis| low[*axis] == high[*axis])
    }

    /// Reports whether a coordinate lies between the ends along `axis`.
    fn is_wide(&self, axis: usize) -> bool {
        self.ends[0][axis].abs_diff(self.ends[1][axis]) > 1
    }

    /// Returns the four corners, counter-clockwise from outside.
    fn corners(&self) -> [CornerNumbers; 4] {
        let [low, high] = self.ends;
        let [right, up] = self.axes;
        let mut corners = [low, low, high, low];
        corners[1][right] = high[right];
        corners[3][up] = high[up];
        corners
    }

    /// Returns the cell of the face in the grid of coordinates, if the face is a front that faces out of the building.
    fn as_front(&self) -> Option<UnionCell> {
        let [low, high] = self.ends;
        let is_front = self.axes == [0, 1] && low[0] < high[0] && low[1] < high[1];
        is_front.then_some(UnionCell { x: [low[0], high[0]], y: [low[1], high[1]] })
    }
}

impl FaceMesh {
    /// Creates the mesh of a single face.
    pub fn of(face: &FacadeFace<'_>) -> Self {
        let mut mesh = Self::default();
        mesh.cover(face);
        mesh
    }

    /// Replaces the mesh with the mesh of a single face.
    fn cover(&mut self, face: &FacadeFace<'_>) {
        let FacadeFace { at, right, up, .. } = *face;
        self.set([at, at + right, at + right + up, at + up]);
    }

    /// Replaces the mesh with the mesh of a face with these corners (m).
    fn set(&mut self, corners: [DVec3; 4]) {
        self.corners.clear();
        self.corners.extend(corners);
        self.triangles.clear();
        self.triangles.extend([[0, 1, 2], [0, 2, 3]]);
    }

    /// Replaces the mesh with the result of `union`. Reverses the triangles if the face is `mirrored`.
    fn take(&mut self, union: &Union, mirrored: bool, place: impl Fn(Crossing) -> DVec3) {
        self.corners.clear();
        self.corners.extend(union.vertices.iter().map(|crossing| place(*crossing)));
        self.triangles.clear();
        let turned = |[a, b, c]: [u32; 3]| if mirrored { [a, c, b] } else { [a, b, c] };
        self.triangles.extend(union.triangles.iter().map(|triangle| turned(*triangle)));
    }
}

/// Returns the index of a coordinate (m) among `places`, or its insertion index.
fn number(places: &[f64], place: f64) -> usize {
    places.partition_point(|known| *known < place - SAME)
}

fn place(places: &[Vec<f64>; 3], corner: CornerNumbers) -> DVec3 {
    DVec3::from(std::array::from_fn(|axis| places[axis][corner[axis] as usize]))
}

/// Returns the key of a corner in the order in which corners of a line along `axis` are contiguous.
fn key([x, y, z]: CornerNumbers, axis: usize) -> CornerKey {
    let in_order = match axis {
        0 => [z, y, x],
        1 => [z, x, y],
        _ => [x, y, z],
    };
    in_order.into_iter().fold(0, |key, number| key << 32 | CornerKey::from(number))
}

/// Returns the corner of a key.
fn corner(key: CornerKey, axis: usize) -> CornerNumbers {
    let [a, b, c] = [64, 32, 0].map(|bits| (key >> bits) as u32);
    match axis {
        0 => [c, b, a],
        1 => [b, c, a],
        _ => [a, b, c],
    }
}
