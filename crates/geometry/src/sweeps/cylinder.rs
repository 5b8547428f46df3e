//! Generalised cylinders: closed surfaces around smooth axes, with contours that change along them.

use glam::{DVec2, DVec3, Vec2, Vec3};

use super::axis::{AxisRing, rings};
use super::contour::{ContourPlace, places, sample};
use super::control_point::CylinderPoint;
use crate::limits::MOST;
use crate::planar::triangulate;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::{MemoryOwner, Stop};
use burgeon_scene::Part;

/// Number of rings between two checks for cancellation.
const STRETCH: usize = 256;

/// Adds a generalised cylinder: one closed surface around the smooth axis through `points`.
///
/// Contours blend between the control points, and the radius changes smoothly and without overshoot. The contour's x
/// points to `side` at the start, and the frames do not rotate about the axis, except between points that have sides of
/// their own. Ends are flat, or tips where the radius is 0. `sides` is the minimum number of faces around. Texture coordinates are in metres: u around, to both sides of
/// the middle of the contour, and v along the axis. Fewer than 2 distinct points add nothing.
///
/// Fails, and adds nothing, if a number is not finite or if an end cannot be filled. The contours are as
/// [`check_contour`](crate::check_contour) requires them.
///
/// ```
/// use burgeon_geometry::{CylinderPoint, generalized_cylinder, solid};
/// use burgeon_scene::Part;
/// use glam::DVec3;
///
/// let point = |z: f64, radius| CylinderPoint { position: DVec3::Z * z, radius, contour: None, side: None };
/// let mut pod = Part::default();
/// generalized_cylinder(&mut pod, vec![point(0.0, 0.0), point(1.0, 0.4), point(2.0, 0.1)], DVec3::X, 12)?;
/// assert!(solid::check([&pod]).is_solid());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn generalized_cylinder(
    part: &mut Part,
    mut points: Vec<CylinderPoint>,
    side: DVec3,
    sides: usize,
) -> Result<()> {
    for point in &mut points {
        point.radius = point.radius.abs();
        let CylinderPoint { position, radius, .. } = &*point;
        if !position.is_finite() || position.abs().max_element() > MOST || !(0.0..=MOST).contains(radius) {
            let DVec3 { x, y, z } = position;
            let message = format!("a cylinder has a point at ({x}, {y}, {z}) with a radius of {radius}");
            return Err(Error::geometry(message)
                .help("give a position and a radius in metres, within 1e9 of the origin"));
        }
    }
    let side = if side.is_finite() { side } else { DVec3::X };
    let rings = rings(&mut points, side)?;
    if rings.is_empty() || points.iter().all(|point| point.radius == 0.0) {
        return Ok(());
    }
    let places = places(points.iter().filter_map(|point| point.contour.as_deref()), sides);
    let contours: Vec<Vec<DVec2>> =
        points.iter().map(|point| sample(point.contour.as_deref(), &places)).collect();
    let count = rings.len() * places.len();
    MemoryOwner::ensure_room(count * (size_of::<DVec3>() + 3 * size_of::<Vec3>()))?;
    if part.positions.len() + 3 * count > u32::MAX as usize {
        return Err(Error::limit(Limit::Size, "a mesh has too many vertices").help("draw with fewer sides"));
    }
    Cylinder::new(&rings, &contours, &places)?.add_to(part)
}

/// A cylinder under construction: a grid of points, a row for each ring and a column for each place.
struct Cylinder<'a> {
    rings: &'a [AxisRing],
    places: &'a [ContourPlace],
    /// Contour of each ring, scaled by its radius (m).
    flat: Vec<Vec<DVec2>>,
    grid: Vec<Vec<DVec3>>,
}

impl<'a> Cylinder<'a> {
    fn new(rings: &'a [AxisRing], contours: &[Vec<DVec2>], places: &'a [ContourPlace]) -> Result<Self> {
        let (mut flat, mut grid) = (Vec::with_capacity(rings.len()), Vec::with_capacity(rings.len()));
        let last = rings.len() - 1;
        for (index, ring) in rings.iter().enumerate() {
            if index % STRETCH == STRETCH - 1 {
                Stop::check_current()?;
            }
            // A thin ring between others keeps a radius, so that its points differ at export precision.
            let least = (1e-6 + ring.centre.abs().max_element() * 5e-7) * places.len() as f64;
            let is_tip = (index == 0 || index == last) && ring.radius <= least;
            let radius = if is_tip { 0.0 } else { ring.radius.max(least) };
            let next = contours.get(ring.control + 1).unwrap_or(&contours[ring.control]);
            let pairs = contours[ring.control].iter().zip(next);
            let outline: Vec<DVec2> = pairs.map(|(a, b)| a.lerp(*b, ring.part) * radius).collect();
            let up = ring.tangent.cross(ring.side);
            grid.push(outline.iter().map(|at| ring.centre + ring.side * at.x + up * at.y).collect());
            flat.push(outline);
        }
        Ok(Self { rings, places, flat, grid })
    }

    fn add_to(&self, part: &mut Part) -> Result<()> {
        let caps = [0, self.rings.len() - 1].map(|ring| match self.is_tip(ring) {
            true => Ok(Vec::new()),
            false => triangulate(std::slice::from_ref(&self.flat[ring]))
                .map_err(|error| error.about("the end of a cylinder")),
        });
        let [start, end] = caps;
        let (start, end) = (start?, end?);
        self.sides(part);
        self.cap(part, 0, &start, true);
        self.cap(part, self.rings.len() - 1, &end, false);
        Ok(())
    }

    fn is_tip(&self, ring: usize) -> bool {
        self.flat[ring].iter().all(|point| *point == DVec2::ZERO)
    }

    /// Adds the surface around the axis.
    fn sides(&self, part: &mut Part) {
        let columns = self.columns();
        let first = part.positions.len() as u32;
        let width = columns.len() as u32;
        part.make_room(self.rings.len() * columns.len(), 2 * self.rings.len() * self.places.len());
        for (row, ring) in self.rings.iter().enumerate() {
            let around = self.around(row);
            let whole = around[self.places.len()];
            for &(place, before) in &columns {
                let column = place % self.places.len();
                part.positions.push(self.grid[row][column].as_vec3());
                part.normals.push(self.normal(row, column, before).as_vec3().into());
                let u = if place == self.places.len() { whole } else { around[column] } - whole / 2.0;
                part.uvs.push(Vec2::new(u as f32, ring.distance as f32));
            }
        }
        for row in 0..self.rings.len() as u32 - 1 {
            let (below, above) = (first + row * width, first + (row + 1) * width);
            for (column, pair) in (0..).zip(columns.windows(2)) {
                if pair[0].0 == pair[1].0 {
                    continue;
                }
                let [a, b, c, d] = [below + column, below + column + 1, above + column + 1, above + column];
                let length =
                    |p: u32, q: u32| part.positions[p as usize].distance_squared(part.positions[q as usize]);
                // The shorter diagonal follows a twisted surface more closely.
                let split = if length(a, c) <= length(b, d) {
                    [[a, b, c], [a, c, d]]
                } else {
                    [[a, b, d], [b, c, d]]
                };
                for corners in split {
                    let [p, q, r] = corners.map(|corner| part.positions[corner as usize]);
                    if p != q && q != r && r != p {
                        part.triangles.push(corners);
                    }
                }
            }
        }
    }

    /// Returns the columns of vertices: the number of the place, and whether the normal is that before a corner. Corners
    /// have two columns. The last column repeats the first place with another texture coordinate.
    fn columns(&self) -> Vec<(usize, bool)> {
        let mut columns = Vec::with_capacity(self.places.len() + 8);
        for (number, place) in self.places.iter().enumerate() {
            if place.sharp && number > 0 {
                columns.push((number, true));
            }
            columns.push((number, false));
        }
        columns.push((self.places.len(), true));
        columns
    }

    /// Returns the length (m) around a ring up to each place, and of the whole ring.
    fn around(&self, row: usize) -> Vec<f64> {
        let ring = &self.flat[row];
        let mut sum = 0.0;
        let mut lengths = vec![0.0];
        for (index, point) in ring.iter().enumerate() {
            sum += point.distance(ring[(index + 1) % ring.len()]);
            lengths.push(sum);
        }
        lengths
    }

    /// Returns the outward normal at a point of the grid; at a corner that of the face `before` or after it.
    fn normal(&self, row: usize, column: usize, before: bool) -> DVec3 {
        let count = self.places.len();
        let sharp = self.places[column].sharp;
        let (left, right) = match (sharp, before) {
            (true, true) => ((column + count - 1) % count, column),
            (true, false) => (column, (column + 1) % count),
            (false, _) => ((column + count - 1) % count, (column + 1) % count),
        };
        let (below, above) = (row.saturating_sub(1), (row + 1).min(self.rings.len() - 1));
        // A tip has no extent around, so it takes that of the ring beside it.
        let beside = match self.is_tip(row) {
            true if row == 0 => above,
            true => below,
            false => row,
        };
        let across = self.grid[beside][right] - self.grid[beside][left];
        let along = self.grid[above][column] - self.grid[below][column];
        let outward = across.cross(along);
        outward.try_normalize().unwrap_or_else(|| {
            let from = self.grid[beside][column] - self.rings[beside].centre;
            from.try_normalize().unwrap_or(self.rings[row].side)
        })
    }

    /// Closes an end with `triangles`, which face along the axis; with `start`, against it.
    fn cap(&self, part: &mut Part, ring: usize, triangles: &[[usize; 3]], start: bool) {
        if triangles.is_empty() {
            return;
        }
        let first = part.positions.len() as u32;
        let (normal, mirror) =
            if start { (-self.rings[ring].tangent, -1.0) } else { (self.rings[ring].tangent, 1.0) };
        for (point, at) in self.grid[ring].iter().zip(&self.flat[ring]) {
            part.positions.push(point.as_vec3());
            part.normals.push(normal.into());
            part.uvs.push(Vec2::new((at.x * mirror) as f32, at.y as f32));
        }
        for &[a, b, c] in triangles {
            let [a, b, c] = [a, b, c].map(|corner| first + corner as u32);
            part.triangles.push(if start { [a, c, b] } else { [a, b, c] });
        }
    }
}
