//! Buffers: the area within a distance of areas, lines and points.

use burgeon_base::error::Result;
use glam::DVec2;

use super::areas::{PolygonArea, unite_valid};
use super::noding::{LayerWay, WayKind};
use super::outline::{BufferStyle, ClosedWalk, Outliner};
use super::subdivision::Subdivision;
use crate::planar::Rings;

/// Number of edges per piece of a walk, and the number of short edges above which a walk is divided into
/// pieces.
const PIECE: usize = 32;
const SHORT_EDGES: usize = 64;
/// Edges shorter than this fraction of the distance are short: the rectangles next to many such edges overlap
/// each other.
const SHORT: f64 = 0.5;

/// Areas, lines and points to buffer.
#[derive(Debug, Clone, Copy, Default)]
pub struct BufferSource<'a> {
    /// Valid areas.
    pub areas: &'a [Rings<DVec2>],
    /// Lines, each as its points.
    pub lines: &'a [Vec<DVec2>],
    /// Points.
    pub points: &'a [DVec2],
}

/// Computes the valid area within a distance (m) of areas, lines and points.
///
/// A negative distance returns the part of the areas that is farther than that distance from their border.
///
/// Fails if the work of this thread is cancelled.
///
/// Method: the union of the areas next to each edge and around each corner, computed piecewise if there are
/// many short edges.
///
/// ```
/// use burgeon_geometry::Polygon;
/// use burgeon_geometry::overlay::{BufferSource, BufferStyle, Cap, Join, buffer};
/// use glam::DVec2;
///
/// let street = [vec![DVec2::ZERO, DVec2::new(10.0, 0.0)]];
/// let source = BufferSource { lines: &street, ..BufferSource::default() };
/// let style = BufferStyle { join: Join::Round, cap: Cap::Square, quadrant_segments: 8 };
/// let area = buffer(source, 2.0, style)?;
/// assert_eq!(Polygon::new(area[0].clone())?.area(), 14.0 * 4.0);
/// # Ok::<(), burgeon_base::error::Error>(())
/// ```
pub fn buffer(source: BufferSource<'_>, distance: f64, style: BufferStyle) -> Result<PolygonArea> {
    let outliner = Outliner { distance: distance.abs(), style };
    if distance <= 0.0 {
        let mut made = PolygonArea::new();
        for rings in source.areas {
            made.extend(inner(rings, &outliner)?);
        }
        return Ok(made);
    }
    let mut parts: Vec<PolygonArea> = Vec::new();
    for rings in source.areas {
        parts.extend(outer(rings, &outliner)?);
    }
    for line in source.lines {
        match ClosedWalk::of_line(line) {
            Some(walks) => parts.extend(sweep_walks(&walks, &outliner, 0)?),
            None => parts.extend(line.first().and_then(|at| outliner.around(*at)).map(polygon)),
        }
    }
    parts.extend(source.points.iter().filter_map(|at| outliner.around(*at)).map(polygon));
    unite_valid(parts)
}

fn polygon(ring: Vec<DVec2>) -> PolygonArea {
    vec![Rings(vec![ring])]
}

fn walks(rings: &Rings<DVec2>, is_inwards: bool) -> Vec<ClosedWalk> {
    let around = |ring: &Vec<DVec2>| {
        if is_inwards {
            ClosedWalk::around(ring.iter().rev().copied())
        } else {
            ClosedWalk::around(ring.iter().copied())
        }
    };
    rings.iter().filter_map(around).collect()
}

/// Returns areas that together cover a polygon and its surroundings within the distance; they may overlap.
fn outer(rings: &Rings<DVec2>, outliner: &Outliner) -> Result<Vec<PolygonArea>> {
    let walks = walks(rings, false);
    let mut made = sweep_walks(&walks, outliner, 0)?;
    if are_dense(&walks, outliner) {
        made.push(vec![rings.clone()]);
    }
    Ok(made)
}

/// Returns the part of a polygon that is farther than the distance from its border.
fn inner(rings: &Rings<DVec2>, outliner: &Outliner) -> Result<PolygonArea> {
    let walks = walks(rings, true);
    if !are_dense(&walks, outliner) {
        return Ok(sweep_walks(&walks, outliner, -1)?.pop().unwrap_or_default());
    }
    let covered = unite_valid(sweep_walks(&walks, outliner, 0)?)?;
    super::overlay(std::slice::from_ref(rings), &covered, |[inside, near]| inside && !near)
}

fn are_dense(walks: &[ClosedWalk], outliner: &Outliner) -> bool {
    walks.iter().map(|walk| walk.count_shorter(SHORT * outliner.distance)).sum::<usize>() > SHORT_EDGES
}

/// Computes the area that walks sweep on their right.
///
/// With few short edges, the result is one area, including the parts with a winding number greater than
/// `least`. With many, it is several areas, which may overlap, without the enclosed parts.
fn sweep_walks(walks: &[ClosedWalk], outliner: &Outliner, least: i32) -> Result<Vec<PolygonArea>> {
    let ring = |places| LayerWay { layer: 0, kind: WayKind::Ring, places };
    if !are_dense(walks, outliner) {
        let ways: Vec<LayerWay> = walks.iter().map(|walk| ring(outliner.whole(walk))).collect();
        let subdivision = Subdivision::new(&ways)?;
        // Inwards, a polygon walked clockwise has a negative winding number where the sweep does not cover
        // it.
        let area = subdivision.areas(|[around, _]| if least < 0 { around < 0 } else { around > 0 });
        return Ok(vec![area]);
    }
    let mut made = Vec::new();
    for walk in walks {
        for begin in (0..walk.len()).step_by(PIECE) {
            let piece = outliner.piece(walk, begin..walk.len().min(begin + PIECE));
            made.push(Subdivision::new(&[ring(piece)])?.areas(|[around, _]| around > 0));
        }
    }
    Ok(made)
}
