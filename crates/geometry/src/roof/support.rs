//! Support of a roof: the walls and their surroundings.

use glam::DVec3;

use super::outset::Outset;
use super::{Patch, PatchKind, RoofMap};
use crate::planar::{Polygon, Ring};

/// The walls below a roof, with neighbours and projecting parts.
#[derive(Debug, Clone, Copy)]
pub struct Support<'a> {
    /// Outline of the walls.
    pub walls: &'a Polygon,
    /// Height of the top of the walls (m).
    pub base: f64,
    /// Edges along neighbours, which get gables if possible.
    pub party: &'a [usize],
    /// Projection (m) of the parts below over each edge; 0 everywhere if empty. The roof extends beyond it.
    pub juts: &'a [f64],
    /// Maximum distance (m) of the roof from each edge, as next to a neighbour; unlimited if empty.
    pub reach: &'a [f64],
    /// Lines of the roof's surface; if some of them can be used, they replace the surface of the shape.
    pub map: Option<&'a RoofMap>,
}

impl<'a> Support<'a> {
    /// Creates a support of walls that end at `base` (m), without neighbours.
    pub fn new(walls: &'a Polygon, base: f64) -> Self {
        Self { walls, base, party: &[], juts: &[], reach: &[], map: None }
    }

    /// Returns the number of edges of all rings.
    pub(super) fn edges(&self) -> usize {
        self.walls.size()
    }

    /// Returns the requested distance (m), limited by the reach of each edge; limits are rounded down to
    /// whole centimetres.
    pub(super) fn within_reach(&self, distance: f64) -> Vec<f64> {
        let reach = |edge: usize| self.reach.get(edge).copied().unwrap_or(f64::INFINITY).max(0.0);
        let least =
            |reach: f64| if reach < distance { (reach * 100.0 + 1e-6).floor() / 100.0 } else { distance };
        (0..self.edges()).map(|edge| least(reach(edge))).collect()
    }

    /// Returns the outline of the projecting parts below; `None` if no part projects.
    ///
    /// At a reflex corner the roof covers the larger of both projections, unless a neighbour limits it.
    pub(super) fn outermost(&self) -> Option<Outset> {
        if self.juts.iter().all(|jut| *jut <= 0.0) {
            return None;
        }
        let reach = self.within_reach(f64::INFINITY);
        let limited = |(jut, reach): (&f64, &f64)| jut.clamp(0.0, *reach);
        let mut juts: Vec<f64> = self.juts.iter().zip(&reach).map(limited).collect();
        let mut first = 0;
        for ring in self.walls {
            let count = ring.len();
            let at = |index: usize| ring[index % count];
            for index in (0..count).chain((0..count).rev()) {
                let turn = (at(index) - at(index + count - 1)).perp_dot(at(index + 1) - at(index));
                if turn < 0.0 {
                    let pair = [index + count - 1, index].map(|index| first + index % count);
                    let most = pair.iter().map(|&edge| juts[edge]).fold(0.0, f64::max);
                    pair.into_iter().for_each(|edge| juts[edge] = most.min(reach[edge]));
                }
            }
            first += count;
        }
        Some(Outset::new(self.walls, juts, |_| false)).filter(|outset| outset.most() > 0.0)
    }

    /// Adds the undersides between the walls and the outline of the projecting parts, where the roof begins.
    pub(super) fn add_soffit(&self, outer: &Outset, patches: &mut Vec<Patch>) {
        divide_feet(patches, self.walls, &outer.polygon, self.base);
        for (edge, [[left, right], [a, b]]) in feet(self.walls, &outer.polygon, self.base).enumerate() {
            if in_line([left, right], a) {
                continue;
            }
            let along = (right - left).truncate().normalize_or_zero();
            patches.extend(Patch::new(PatchKind::Underside, edge, 0, along, vec![b, a, left, right]));
        }
    }
}

/// Returns each edge of the walls and of the outline around them, at height `base` (m).
fn feet<'a>(walls: &'a Polygon, outer: &'a Polygon, base: f64) -> impl Iterator<Item = [[DVec3; 2]; 2]> + 'a {
    let pairs = walls.edges().zip(outer.edges());
    pairs.map(move |(inner, outer)| [inner, outer].map(|ends| ends.map(|at| at.extend(base))))
}

/// Inserts the corners of a wall into the lower edge of a face that begins on the wall and extends beyond it.
///
/// This occurs if an edge of the outline stays collinear with its wall and becomes longer because its
/// neighbours move.
pub(super) fn divide_feet(patches: &mut [Patch], walls: &Polygon, outer: &Polygon, base: f64) {
    let longer = feet(walls, outer, base).map(|[inner, outer]| {
        let between = inner.into_iter().filter(|at| !outer.contains(at)).collect::<Vec<_>>();
        (in_line(inner, outer[0]) && in_line(inner, outer[1]) && !between.is_empty())
            .then_some((outer, between))
    });
    let longer: Vec<_> = longer.collect();
    for patch in patches {
        let Some((outer, between)) = &longer[patch.edge] else { continue };
        for ring in &mut patch.rings {
            let begin = ring.edges().position(|ends| ends == *outer);
            if let Some(begin) = begin {
                let (before, after) = ring.split_at(begin + 1);
                let points = [before, between, after].concat();
                if let Some(longer) = Ring::without_repeats(points) {
                    *ring = longer;
                }
            }
        }
    }
}

/// Returns true if a point of an edge's outline is collinear with the edge.
fn in_line([left, right]: [DVec3; 2], at: DVec3) -> bool {
    (right - left).truncate().perp_dot((at - left).truncate()).abs() < 1e-9
}
