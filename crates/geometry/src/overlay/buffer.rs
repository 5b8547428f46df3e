//! Buffers: what lies within a distance of areas, lines and points.

use burgeon_base::error::Result;
use glam::DVec2;

use super::areas::{PolygonArea, unite_valid};
use super::noding::{LayerWay, WayKind};
use super::outline::{BufferStyle, ClosedWalk, Outliner};
use super::subdivision::Subdivision;
use crate::planar::Rings;

/// The edges of a piece of a walk, and the short ones with which a walk is divided into pieces.
const PIECE: usize = 32;
const SHORT_EDGES: usize = 64;
/// Edges shorter than this part of the distance are short: the rectangles beside many of them cover each other.
const SHORT: f64 = 0.5;

/// Lines and points to draw a buffer around, with areas.
#[derive(Debug, Clone, Copy, Default)]
pub struct BufferSource<'a> {
    /// Areas that are valid.
    pub areas: &'a [Rings<DVec2>],
    /// The places along lines.
    pub lines: &'a [Vec<DVec2>],
    /// Places.
    pub points: &'a [DVec2],
}

/// Returns the area of all that lies within a distance (m) of areas, lines and points; if it is negative, of areas what lies
/// farther than that from their border. Valid.
///
/// Fails if the work of this thread is to stop.
///
/// Method: the union of what is beside each edge and around each corner. Where that is much, it is computed piece by piece.
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
        match ClosedWalk::along(line) {
            Some(walks) => parts.extend(swept(&walks, &outliner, 0)?),
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

/// A polygon and what lies within the distance of it, as areas that may overlap.
fn outer(rings: &Rings<DVec2>, outliner: &Outliner) -> Result<Vec<PolygonArea>> {
    let walks = walks(rings, false);
    let mut made = swept(&walks, outliner, 0)?;
    if are_dense(&walks, outliner) {
        made.push(vec![rings.clone()]);
    }
    Ok(made)
}

/// What of a polygon lies farther than the distance from its border.
fn inner(rings: &Rings<DVec2>, outliner: &Outliner) -> Result<PolygonArea> {
    let walks = walks(rings, true);
    if !are_dense(&walks, outliner) {
        return Ok(swept(&walks, outliner, -1)?.pop().unwrap_or_default());
    }
    let covered = unite_valid(swept(&walks, outliner, 0)?)?;
    super::overlay(std::slice::from_ref(rings), &covered, |[inside, near]| inside && !near)
}

fn are_dense(walks: &[ClosedWalk], outliner: &Outliner) -> bool {
    walks.iter().map(|walk| walk.count_shorter(SHORT * outliner.distance)).sum::<usize>() > SHORT_EDGES
}

/// What walks sweep over to their right. With few edges that is one area, with what they go around more than `least` times;
/// with many it is several, which may overlap, without what they go around.
fn swept(walks: &[ClosedWalk], outliner: &Outliner, least: i32) -> Result<Vec<PolygonArea>> {
    let ring = |places| LayerWay { layer: 0, kind: WayKind::Ring, places };
    if !are_dense(walks, outliner) {
        let ways: Vec<LayerWay> = walks.iter().map(|walk| ring(outliner.whole(walk))).collect();
        let subdivision = Subdivision::new(&ways)?;
        // Inwards, a polygon that is walked around clockwise counts less than nothing where nothing covers it.
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
