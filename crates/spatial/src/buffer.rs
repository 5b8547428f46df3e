//! What lies within a distance of a geometry.

use burgeon_base::error::{Error, Result};
use geo::buffer::{Buffer, BufferStyle, LineCap, LineJoin};
use geo::unary_union;
use glam::DVec2;

use super::Geometry;
use super::edges::with_heights;
use super::overlay::{LEAST_EXTENT, dissolved, with_width};
use super::plane::Plane;

/// What a buffer's border does at corners.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BufferJoin {
    /// An arc.
    #[default]
    Round,
    /// A corner, as far as it is no farther than five distances off.
    Mitre,
    /// A straight cut.
    Bevel,
}

/// What a buffer's border does at the ends of lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum BufferCap {
    /// Half a circle.
    #[default]
    Round,
    /// It ends where the line ends.
    Flat,
    /// It goes on as far as the distance.
    Square,
}

/// How a buffer's border runs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BufferOptions {
    /// At corners.
    pub join: BufferJoin,
    /// At the ends of lines.
    pub cap: BufferCap,
    /// How many edges stand for a quarter of a circle, 1 to 1000.
    pub quadrant_segments: u32,
}

impl Default for BufferOptions {
    fn default() -> Self {
        Self { join: BufferJoin::Round, cap: BufferCap::Round, quadrant_segments: 8 }
    }
}

/// How many distances a mitred corner may be off.
const MITRE_LIMIT: f64 = 5.0;

impl Geometry {
    /// The area of all that lies within `distance` (m); of a polygon, a negative one takes as much off. Empty if nothing
    /// is left. Fails if the distance is not finite, no number of segments is given, or it reaches farther than
    /// [`FARTHEST`](super::FARTHEST).
    ///
    /// Method: boolean operations on polygons (i_overlay, through `geo`).
    ///
    /// ```
    /// use burgeon_spatial::{BufferCap, BufferJoin, BufferOptions, Geometry};
    ///
    /// let path = Geometry::from_wkt("LINESTRING (0 0, 10 0, 10 10)")?;
    /// let options = BufferOptions { join: BufferJoin::Mitre, cap: BufferCap::Flat, ..BufferOptions::default() };
    /// assert!((path.buffer(1.0, &options)?.area() - 40.0).abs() < 1e-6);
    /// let disc = Geometry::from_wkt("POINT (0 0)")?.buffer(2.0, &BufferOptions::default())?;
    /// assert!((disc.area() - 12.48).abs() < 0.01);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn buffer(&self, distance: f64, options: &BufferOptions) -> Result<Self> {
        if !distance.is_finite() || distance.abs() > super::FARTHEST {
            let taken = if distance.is_finite() { "a distance of at most 1e9" } else { "a finite distance" };
            return Err(Error::argument(format!("buffer takes {taken}, not {distance:?}"))
                .help("give metres: more to grow, less than 0 to shrink"));
        }
        if !(1..=1000).contains(&options.quadrant_segments) {
            let given = options.quadrant_segments;
            return Err(Error::argument(format!("buffer takes 1 to 1000 quadrant_segments, not {given}"))
                .help("8 are 1 % from a circle's area"));
        }
        let made = self.grown(distance, options);
        made.check().map_err(|error| error.about("buffer")).map(|()| made)
    }

    fn grown(&self, distance: f64, options: &BufferOptions) -> Self {
        if let Some(strip) = self.strip(distance, options.cap) {
            return with_heights(strip, &[self]);
        }
        let plane = Plane::of(&[self]);
        let (areas, thin_rings) = with_width(plane.polygons(self));
        let areas = dissolved(areas);
        if distance.abs() < LEAST_EXTENT {
            return with_heights(plane.areas(&areas), &[self]);
        }
        let style = || {
            let angle = std::f64::consts::FRAC_PI_2 / f64::from(options.quadrant_segments);
            let join = match options.join {
                BufferJoin::Round => LineJoin::Round(angle),
                BufferJoin::Mitre => LineJoin::Miter(2.0 * (1.0 / MITRE_LIMIT).asin()),
                BufferJoin::Bevel => LineJoin::Bevel,
            };
            let cap = match options.cap {
                BufferCap::Round => LineCap::Round(angle),
                BufferCap::Flat => LineCap::Butt,
                BufferCap::Square => LineCap::Square,
            };
            BufferStyle::new(distance).line_join(join).line_cap(cap)
        };
        let mut parts = Vec::new();
        if !areas.0.is_empty() {
            parts.push(areas.buffer_with_style(style()));
        }
        if distance > 0.0 && self.is_sound() {
            parts.extend(thin_rings.iter().map(|ring| ring.buffer_with_style(style())));
            let thin: Vec<Self> = self.parts().into_iter().filter(|part| part.dimension() < 2).collect();
            if options.join == BufferJoin::Round {
                let lines = thin.iter().filter_map(|part| match part {
                    Geometry::Line(line) => Some(plane.string(line)),
                    _ => None,
                });
                let turns = thin_rings.iter().cloned().chain(lines).flat_map(|line| turns_back(&line));
                parts.extend(turns.map(|at| geo::Point(at).buffer_with_style(style())));
            }
            parts.extend(thin.into_iter().map(|part| match part {
                // A line without length is its place.
                Geometry::Line(line) if line.iter().all(|point| point.truncate() == line[0].truncate()) => {
                    geo::Point(plane.coord(line[0])).buffer_with_style(style())
                }
                part => plane.geo(&part).buffer_with_style(style()),
            }));
        }
        let whole = match &parts[..] {
            [only] => only.clone(),
            parts => unary_union(parts),
        };
        with_heights(plane.areas(&whole), &[self])
    }

    /// What lies within `distance` of a line of one edge that does not end round: a rectangle. None of others.
    fn strip(&self, distance: f64, cap: BufferCap) -> Option<Self> {
        let Self::Line(line) = self else { return None };
        let [a, b] = line[..] else { return None };
        let length = (b - a).truncate().length();
        if distance <= 0.0 || cap == BufferCap::Round || length == 0.0 || !self.is_sound() {
            return None;
        }
        let along = (b - a).truncate() * (distance / length);
        let beyond = if cap == BufferCap::Square { along } else { DVec2::ZERO };
        let corner = |place: DVec2| place.extend(0.0);
        let (a, b, left) = (a.truncate() - beyond, b.truncate() + beyond, along.perp());
        let ring = vec![corner(a - left), corner(b - left), corner(b + left), corner(a + left)];
        Self::polygon(vec![ring])
    }
}

/// The corners at which a line goes back the way it came, or nearly so; there the buffers of `geo` have no arc.
fn turns_back(line: &geo::LineString) -> Vec<geo::Coord> {
    let corners = line.0.windows(3).filter(|corner| {
        let place = |at: geo::Coord| DVec2::new(at.x, at.y);
        let [a, b, c] = [corner[0], corner[1], corner[2]].map(place);
        (b - a).angle_to(c - b).abs() > std::f64::consts::PI - 1e-3
    });
    corners.map(|corner| corner[1]).collect()
}
