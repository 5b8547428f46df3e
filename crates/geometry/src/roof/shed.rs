//! Roofs of one slope.

use glam::{DVec2, DVec3};

use super::shape::{Eaves, Rise, RoofShape};
use super::{Patch, PatchKind};
use crate::planar::{Polygon, Ring};

/// Heights (m) below this are 0.
const LOWEST: f64 = 2e-3;
/// Minimum cosine of the angle between an eaves edge's outward normal and the fall (60 degrees).
const DOWNWARDS: f64 = 0.5;
/// Maximum sine of the turn (30 degrees) between eaves and edges that join them, so that no corner moves far.
const IN_LINE: f64 = 0.5;

/// Direction of drainage: from the longest edge to the point farthest from it.
pub(super) struct Fall {
    from: DVec2,
    way: DVec2,
    /// Minimum and maximum position of the walls along the fall (m).
    near: f64,
    far: f64,
}

impl Fall {
    pub(super) fn new(walls: &Polygon) -> Self {
        let outer = walls.outer().into_iter().flat_map(Ring::edges);
        let longest = outer.fold([DVec2::ZERO; 2], |best, edge| {
            let [a, b] = [best, edge].map(|[from, to]| from.distance(to));
            if b > a + 1e-6 { edge } else { best }
        });
        let (from, way) = (longest[0], (longest[1] - longest[0]).normalize_or_zero().perp());
        let mut fall = Self { from, way, near: f64::INFINITY, far: f64::NEG_INFINITY };
        for at in walls.points() {
            let depth = fall.depth(at);
            (fall.near, fall.far) = (fall.near.min(depth), fall.far.max(depth));
        }
        fall
    }

    fn depth(&self, at: DVec2) -> f64 {
        self.way.dot(at - self.from)
    }

    /// Returns the extent of the walls along the fall (m).
    pub(super) fn length(&self) -> f64 {
        (self.far - self.near).max(1e-9)
    }

    /// Returns true for each edge that belongs to the eaves, where level undersides begin; over other edges
    /// gables are flush.
    pub(super) fn eaves(&self, walls: &Polygon) -> Vec<bool> {
        let mut eaves = Vec::new();
        for ring in walls {
            let ways: Vec<DVec2> = ring.edges().map(|[a, b]| (b - a).normalize_or_zero()).collect();
            let mut down: Vec<bool> =
                ways.iter().map(|along| -along.perp().dot(self.way) > DOWNWARDS).collect();
            let count = ring.len();
            // Two rounds forwards and two backwards spread the eaves along the ring from any start.
            let forwards = (0..2 * count).map(|step| (step % count, (step + 1) % count));
            let backwards = (0..2 * count).rev().map(|step| ((step + 1) % count, step % count));
            for (known, next) in forwards.chain(backwards) {
                down[next] |= down[known] && ways[known].perp_dot(ways[next]).abs() < IN_LINE;
            }
            eaves.extend(down);
        }
        eaves
    }
}

/// Creates the patches of a roof of one slope, highest over the longest edge, over walls that end at `base`
/// (m).
///
/// `outer` is the outline of the roof with as many edges as the walls, and with `overhang` (m) beyond some of
/// them. `high` (m) is the rise over the walls from the point farthest from the longest edge, or from the
/// outline there if the eaves are not open.
pub(super) fn patches(
    shape: &RoofShape,
    fall: &Fall,
    walls: &Polygon,
    outer: &Polygon,
    base: f64,
    overhang: f64,
    high: f64,
) -> Vec<Patch> {
    // Distance by which the slope continues beyond the tops of the walls.
    let beyond = if shape.eaves == Eaves::Open { 0.0 } else { overhang };
    let slope = match shape.rise {
        Rise::Height(height) => height / (fall.length() + beyond),
        Rise::Slope(_) => high / fall.length(),
    };
    let raised = |at: DVec2, by: f64| {
        let height = slope * (fall.far - fall.depth(at)) + by;
        at.extend(base + if height.abs() < LOWEST { 0.0 } else { height })
    };
    let wall_top = |at: DVec2| raised(at, 0.0);
    let under = |at: DVec2| raised(at, slope * beyond);
    let top = |at: DVec2| raised(at, slope * beyond + shape.slab);

    let rings = outer.iter().map(|ring| ring.raised(|at| top(at).z)).collect();
    let mut patches = vec![Patch { kind: PatchKind::Slope, edge: 0, flap: 0, along: fall.way.perp(), rings }];
    for (edge, ([a, b], [c, d])) in walls.edges().zip(outer.edges()).enumerate() {
        let along = (b - a).normalize_or_zero();
        let mut push = |kind, corners: Vec<DVec3>| {
            patches.extend(Patch::new(kind, edge, 0, along, corners));
        };
        let mut wall = vec![a.extend(base), b.extend(base)];
        if along.perp_dot(c - a).abs().max(along.perp_dot(d - a).abs()) < LOWEST {
            // Next to eaves, a flush gable ends where the eaves do.
            let moved =
                |from: DVec2, to: DVec2| if from == to { None } else { Some([wall_top(from), under(to)]) };
            wall.extend(moved(b, d).into_iter().flatten());
            wall.extend([top(d), top(c)]);
            wall.extend(moved(a, c).into_iter().flat_map(|[wall, under]| [under, wall]));
        } else {
            wall.extend([wall_top(b), wall_top(a)]);
            push(PatchKind::Underside, vec![under(d), under(c), wall_top(a), wall_top(b)]);
            push(PatchKind::Fascia, vec![under(c), under(d), top(d), top(c)]);
        }
        push(PatchKind::Gable, wall);
    }
    patches
}
