//! Tubes along the edges of a tree, with the rings that joints connect.

use glam::{DVec2, DVec3, Vec2};

use super::axis::JoinedTubes;
use super::placement::{add_points, least_radius};
use super::route::{Route, RouteFrame};
use super::tree::{TubeEdge, TubeTree};
use burgeon_base::error::Result;
use burgeon_scene::Part;

/// A ring at the end of a tube, for a joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct EndRing {
    /// Index of the first point among those of all rings.
    pub(super) first: usize,
    pub(super) count: usize,
    pub(super) frame: RouteFrame,
    /// Perimeter (m).
    pub(super) around: f64,
}

/// The rings of all joints.
#[derive(Default)]
pub(super) struct EndRings {
    /// Points (m).
    pub(super) points: Vec<DVec3>,
    /// Outward normals of the tubes.
    pub(super) normals: Vec<DVec3>,
    /// Texture coordinates u (m).
    pub(super) us: Vec<f64>,
    /// Ring of the start and the end of each edge.
    pub(super) of: Vec<[Option<EndRing>; 2]>,
}

/// A ring of a tube.
#[derive(Clone, Copy)]
struct TubeRing {
    frame: RouteFrame,
    is_tip: bool,
}

/// A tube under construction: a grid of points, a row for each ring and a column for each place of the outline.
#[derive(Default)]
pub(super) struct Tube {
    rings: Vec<TubeRing>,
    grid: Vec<DVec3>,
    columns: Vec<(usize, bool)>,
    around: Vec<f64>,
}

impl Tube {
    /// Adds the tube along edge number `index`, with flat ends or tips where it has no joint, and stores the rings of
    /// its joints.
    pub(super) fn add(
        &mut self,
        part: &mut Part,
        tree: &TubeTree,
        index: usize,
        found: &mut JoinedTubes,
        ends: &mut EndRings,
    ) -> Result<()> {
        let edge = &tree.edges[index];
        let route = &tree.routes[edge.axis];
        self.gather(route, edge);
        let count = route.outlines.count();
        let given = |control: usize| tree.given(edge.axis, control);
        let last = self.rings.len() - 1;
        let caps = [0, last].map(|ring| match edge.cuts[usize::from(ring == last)] {
            None if !self.rings[ring].is_tip => {
                let RouteFrame { control, part, .. } = self.rings[ring].frame;
                route.outlines.end(control, part).map(Some)
            }
            _ => Ok(None),
        });
        let [start, end] = caps;
        let (start, end) = (start?, end?);
        part.make_room((self.rings.len() + 2) * (count + 1), 2 * (self.rings.len() + 1) * count);
        let before = part.triangles.len();
        let first = part.positions.len() as u32;
        self.columns(route);
        let width = self.columns.len() as u32;
        for row in 0..self.rings.len() {
            self.add_row(part, route, row);
        }
        let mut ring_ends = [None; 2];
        for ((ring_end, cut), row) in ring_ends.iter_mut().zip(&edge.cuts).zip([0, last]) {
            if cut.is_some() {
                *ring_end = Some(self.store(route, row, ends));
            }
        }
        ends.of.push(ring_ends);
        if let Some(triangles) = start {
            self.cap(part, route, 0, &triangles, true);
        }
        found.add_run(given(edge.controls[0] + 1), part.triangles.len() - before);
        for row in 0..last {
            let before = part.triangles.len();
            let (below, above) = (first + row as u32 * width, first + (row as u32 + 1) * width);
            self.band(part, row, below, above);
            let control = self.rings[row].frame.control;
            found.add_run(given(control + 1), part.triangles.len() - before);
        }
        let before = part.triangles.len();
        if let Some(triangles) = end {
            self.cap(part, route, last, &triangles, false);
        }
        found.add_run(given(edge.controls[1]), part.triangles.len() - before);
        Ok(())
    }

    /// Gathers the rings of an edge, and their points.
    fn gather(&mut self, route: &Route, edge: &TubeEdge) {
        self.rings.clear();
        self.grid.clear();
        let [start, end] = [0, 1].map(|end| {
            edge.cuts[end].or_else(|| {
                // Within the edge, so that an end at a bend is perpendicular to its last segment.
                let frame = route.frame(edge.span[end]);
                let inner = route.frame(edge.span[end] + (edge.span[1 - end] - edge.span[end]) * 1e-6);
                frame.zip(inner).map(|(frame, mut inner)| {
                    (inner.at, inner.centre, inner.radius) = (frame.at, frame.centre, frame.radius);
                    inner
                })
            })
        });
        let (Some(start), Some(end)) = (start, end) else { return };
        let outlines = &route.outlines;
        let mut push = |mut frame: RouteFrame, may_end: bool| {
            let least = least_radius(frame.centre, outlines);
            let is_tip = may_end && frame.radius <= least;
            frame.radius = if is_tip { 0.0 } else { frame.radius.max(least) };
            self.rings.push(TubeRing { frame, is_tip });
        };
        push(start, edge.cuts[0].is_none());
        for frame in route.between(start.at, end.at) {
            push(*frame, false);
        }
        push(end, edge.cuts[1].is_none());
        // Two tips without a ring between them would have no surface.
        if let [first, last] = &mut self.rings[..]
            && first.is_tip
            && last.is_tip
        {
            last.is_tip = false;
            last.frame.radius = least_radius(last.frame.centre, outlines);
        }
        for ring in &self.rings {
            add_points(route, &ring.frame, &mut self.grid);
        }
    }

    /// Sets the columns of vertices: the number of the place, and whether the normal is that before a corner. Corners
    /// have two columns. The last column repeats the first place with another texture coordinate.
    fn columns(&mut self, route: &Route) {
        self.columns.clear();
        let places = &route.outlines.places;
        for (number, place) in places.iter().enumerate() {
            if place.sharp && number > 0 {
                self.columns.push((number, true));
            }
            self.columns.push((number, false));
        }
        self.columns.push((places.len(), true));
    }

    /// Sets the lengths (m) around a ring up to each place, and returns the whole length.
    fn measure(&mut self, row: usize, count: usize) -> f64 {
        self.around.clear();
        let ring = &self.grid[row * count..(row + 1) * count];
        let mut sum = 0.0;
        for (index, point) in ring.iter().enumerate() {
            self.around.push(sum);
            sum += point.distance(ring[(index + 1) % count]);
        }
        self.around.push(sum);
        sum
    }

    fn add_row(&mut self, part: &mut Part, route: &Route, row: usize) {
        let count = route.outlines.count();
        let whole = self.measure(row, count);
        let v = self.rings[row].frame.at as f32;
        for &(place, before) in &self.columns {
            let column = place % count;
            part.positions.push(self.grid[row * count + column].as_vec3());
            part.normals.push(self.normal(route, row, column, before).as_vec3().into());
            part.uvs.push(Vec2::new((self.around[place] - whole / 2.0) as f32, v));
        }
    }

    /// Stores a ring for a joint.
    fn store(&mut self, route: &Route, row: usize, ends: &mut EndRings) -> EndRing {
        let count = route.outlines.count();
        let around = self.measure(row, count);
        let first = ends.points.len();
        for column in 0..count {
            ends.points.push(self.grid[row * count + column]);
            let sum = self.normal(route, row, column, true) + self.normal(route, row, column, false);
            ends.normals.push(sum.normalize_or(self.rings[row].frame.side));
            ends.us.push(self.around[column] - around / 2.0);
        }
        EndRing { first, count, frame: self.rings[row].frame, around }
    }

    /// Returns the outward normal at a point of the grid; at a corner that of the face `before` or after it.
    fn normal(&self, route: &Route, row: usize, column: usize, before: bool) -> DVec3 {
        let count = route.outlines.count();
        let (mut left, mut right) = ((column + count - 1) % count, (column + 1) % count);
        if route.outlines.places[column].sharp {
            *if before { &mut right } else { &mut left } = column;
        }
        let (below, above) = (row.saturating_sub(1), (row + 1).min(self.rings.len() - 1));
        // A tip has no extent around, so it takes that of the ring beside it.
        let beside = match self.rings[row].is_tip {
            true if row == 0 => above,
            true => below,
            false => row,
        };
        let at = |row: usize, column: usize| self.grid[row * count + column];
        let across = at(beside, right) - at(beside, left);
        let along = at(above, column) - at(below, column);
        across.cross(along).try_normalize().unwrap_or_else(|| {
            let from = at(beside, column) - self.rings[beside].frame.centre;
            from.try_normalize().unwrap_or(self.rings[row].frame.side)
        })
    }

    /// Adds the faces between a row and the next, whose first vertices are `below` and `above`.
    fn band(&self, part: &mut Part, row: usize, below: u32, above: u32) {
        let [start, end] = [row, row + 1].map(|row| self.rings[row].is_tip);
        for (column, pair) in (0..).zip(self.columns.windows(2)) {
            if pair[0].0 == pair[1].0 {
                continue;
            }
            let [a, b, c, d] = [below + column, below + column + 1, above + column + 1, above + column];
            let length =
                |p: u32, q: u32| part.positions[p as usize].distance_squared(part.positions[q as usize]);
            if start {
                part.triangles.push([a, c, d]);
            } else if end {
                part.triangles.push([a, b, d]);
            // The shorter diagonal follows a twisted surface more closely.
            } else if length(a, c) <= length(b, d) {
                part.triangles.extend([[a, b, c], [a, c, d]]);
            } else {
                part.triangles.extend([[a, b, d], [b, c, d]]);
            }
        }
    }

    /// Closes an end with `triangles`, which face along the axis; with `start`, against it.
    fn cap(&self, part: &mut Part, route: &Route, row: usize, triangles: &[[usize; 3]], start: bool) {
        let count = route.outlines.count();
        let frame = &self.rings[row].frame;
        let first = part.positions.len() as u32;
        let (normal, mirror) = if start { (-frame.tangent, -1.0) } else { (frame.tangent, 1.0) };
        for (index, point) in self.grid[row * count..(row + 1) * count].iter().enumerate() {
            let flat = route.outlines.point(frame.control, frame.part, index) * frame.radius;
            part.positions.push(point.as_vec3());
            part.normals.push(normal.as_vec3().into());
            part.uvs.push((flat * DVec2::new(mirror, 1.0)).as_vec2());
        }
        part.triangles.extend(triangles.iter().map(|&[a, b, c]| {
            let [a, b, c] = [a, b, c].map(|corner| first + corner as u32);
            if start { [a, c, b] } else { [a, b, c] }
        }));
    }
}
