//! What stands on a building whose own roof cannot be made.

use geo::{Coord, LineString, MinimumRotatedRect, Polygon, Simplify};
use glam::DVec2;

use crate::error::Result;
use crate::geometry::Plan;
use crate::geometry::roof::{Cover, Patch, PatchKind, Shape, Surface, floor};

/// A roof, and what it is in place of.
pub(super) struct Made {
    pub cover: Cover,
    /// What was done instead, and why.
    pub replaced: Option<(String, String)>,
}

/// How far (m) the corners of a simplified outline may be from the true one, in turn.
const SIMPLER: [f64; 3] = [0.05, 0.2, 0.5];

/// The roof that `make` makes over `walls`; where it fails, a level deck closes the walls and a roof over a
/// simplified outline, or over the bounding rectangle, stands on it as a solid of its own; or the deck alone.
pub(super) fn cover(
    shape: &Shape,
    kind: &str,
    walls: &[Vec<DVec2>],
    base: f64,
    make: &mut impl FnMut(&Shape, &[Vec<DVec2>]) -> Result<Cover>,
) -> Made {
    let why = match make(shape, walls) {
        Ok(cover) => return Made { cover, replaced: None },
        Err(error) => error.message().to_owned(),
    };
    let level = |walls: &[Vec<DVec2>], upwards: bool| Patch {
        kind: if upwards { PatchKind::Slope } else { PatchKind::Underside },
        edge: 0,
        flap: 0,
        along: DVec2::X,
        rings: if upwards {
            walls.iter().map(|ring| ring.iter().map(|at| at.extend(base)).collect()).collect()
        } else {
            floor(walls, base)
        },
    };
    let flush = Shape { overhang: 0.0, ..*shape };
    let simple = SIMPLER.into_iter().filter_map(|distance| {
        let text = format!("a {kind} roof over an outline simplified to {distance} m");
        Some((simplified(walls, distance)?, text))
    });
    let whole =
        bounding(walls).map(|rectangle| (rectangle, format!("a {kind} roof on the bounding rectangle")));
    for (outline, text) in simple.chain(whole) {
        if let Ok(mut cover) = make(&flush, &outline) {
            cover.patches.extend([level(walls, true), level(&outline, false)]);
            return Made { cover, replaced: Some((text, why)) };
        }
    }
    let deck = Shape { surface: Surface::Flat(None), slab: 0.0, ..flush };
    let cover = make(&deck, walls)
        .unwrap_or_else(|_| Cover { patches: vec![level(walls, true)], ..Cover::default() });
    Made { cover, replaced: Some((format!("a flat roof in place of a {kind} roof"), why)) }
}

fn line(ring: &[DVec2]) -> LineString {
    ring.iter().map(|at| Coord { x: at.x, y: at.y }).collect()
}

fn points(line: &LineString) -> Vec<glam::DVec3> {
    let open = line.0.split_last().map_or(&[][..], |(_, open)| open);
    open.iter().map(|at| glam::DVec3::new(at.x, at.y, 0.0)).collect()
}

/// The outline with fewer corners, if it is still sound; small holes may go.
///
/// Method: D. Douglas and T. Peucker, "Algorithms for the reduction of the number of points required to represent
/// a digitized line or its caricature", 1973.
fn simplified(walls: &[Vec<DVec2>], distance: f64) -> Option<Vec<Vec<DVec2>>> {
    let mut rings: Vec<Vec<glam::DVec3>> = Vec::with_capacity(walls.len());
    for ring in walls {
        let mut line = line(ring);
        line.close();
        let points = points(&line.simplify(distance));
        if points.len() > 2 {
            rings.push(points);
        } else if rings.is_empty() {
            return None;
        }
    }
    let plan = Plan::new(&rings).ok()?;
    (plan.edges() < walls.iter().map(Vec::len).sum()).then(|| plan.flat())
}

/// The smallest rectangle around the walls.
fn bounding(walls: &[Vec<DVec2>]) -> Option<Vec<Vec<DVec2>>> {
    let outer = Polygon::new(line(walls.first()?), Vec::new());
    let rectangle = outer.minimum_rotated_rect()?;
    Plan::new(&[points(rectangle.exterior())]).ok().map(|plan| plan.flat())
}
