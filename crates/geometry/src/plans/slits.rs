//! Slits in plans: openings that are too narrow for a roof to follow.
//!
//! An opening is a slit if it is nowhere wider than the distance within which points are merged. Slits are
//! filled, and the plan reports them. A roof over a wider opening follows its walls. An opening that becomes
//! narrow only towards its end, such as a sharp notch, is kept.

use glam::DVec2;

use crate::cross_section::outline::OutlineOptions;

/// Minimum ratio of the depth of a slit to its maximum width.
const DEEP: f64 = 2.0;
/// Cosine of the minimum angle between the directions of the sides of a slit.
const OPPOSITE: f64 = -0.95;
/// Overlap (m) of the filled area with the walls around it.
const OVERLAP: f64 = 1e-4;

/// A part of a slit between two straight walls.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slit {
    /// Corners (m) of the area that fills it.
    pub corners: [DVec2; 4],
    /// Ends (m) on the centreline.
    pub ends: [DVec2; 2],
    /// Maximum width (m).
    pub width: f64,
}

impl Slit {
    /// Returns a description for a report entry.
    pub(super) fn describe(&self) -> String {
        let [from, to] = self.ends;
        format!(
            "a slit {:.1} mm wide from ({:.3}, {:.3}) to ({:.3}, {:.3})",
            self.width * 1e3,
            from.x,
            from.y,
            to.x,
            to.y
        )
    }
}

/// Finds the slits of valid rings: the first ring is counter-clockwise, the others are clockwise.
pub(super) fn find<R: AsRef<[DVec2]>>(rings: &[R], manner: &OutlineOptions) -> Vec<Slit> {
    let edges = rings.iter().map(AsRef::as_ref).flat_map(crate::planar::edges);
    let mut edges: Vec<[DVec2; 2]> = edges.collect();
    edges.sort_by(|a, b| a[0].x.min(a[1].x).total_cmp(&b[0].x.min(b[1].x)));
    let mut slits = Vec::new();
    for (index, a) in edges.iter().enumerate() {
        let [low, high] = [a[0].min(a[1]) - manner.near, a[0].max(a[1]) + manner.near];
        let way = a[1] - a[0];
        for b in &edges[index + 1..] {
            if b[0].x.min(b[1].x) > high.x {
                break;
            }
            if way.dot(b[1] - b[0]) < 0.0 && b[0].y.max(b[1].y) >= low.y && b[0].y.min(b[1].y) <= high.y {
                slits.extend(slit_between(*a, *b, manner.near));
            }
        }
    }
    slits
}

/// Returns the slit between two edges with the area on their left, if it is nowhere wider than `widest` (m).
fn slit_between([a, b]: [DVec2; 2], [c, d]: [DVec2; 2], widest: f64) -> Option<Slit> {
    let (length, along) = (a.distance(b), (b - a).try_normalize()?);
    if along.dot((d - c).try_normalize()?) > OPPOSITE {
        return None;
    }
    let out = -along.perp();
    // The other edge is reversed, so that both edges have the same direction.
    let [from, to] = [d - a, c - a].map(|at| DVec2::new(at.dot(along), at.dot(out)));
    let [begin, end] = [from.x.max(0.0), to.x.min(length)];
    let slope = (to.y - from.y) / (to.x - from.x);
    let widths = [begin, end].map(|at| from.y + (at - from.x) * slope);
    let [least, width] = [widths[0].min(widths[1]), widths[0].max(widths[1])];
    if least < -1e-9 || !(width > 0.0 && width <= widest) || end - begin < DEEP * width.max(widest) {
        return None;
    }
    // If the walls at the ends of a slit are oblique, the slit is filled up to their corners.
    let near = 2.0 * widest;
    let corner = |place: f64, own: f64, at: DVec2, between: DVec2| {
        if (place - own).abs() <= near { at } else { between }
    };
    let here = |at: f64| a + along * at;
    let there = |at: f64, width: f64| here(at) + out * width;
    let [own, other] = [
        [corner(begin, 0.0, a, here(begin)), corner(end, length, b, here(end))],
        [corner(begin, from.x, d, there(begin, widths[0])), corner(end, to.x, c, there(end, widths[1]))],
    ];
    let (back, aside) = (along * OVERLAP, out * OVERLAP);
    let corners =
        [own[0] - back - aside, other[0] - back + aside, other[1] + back + aside, own[1] + back - aside];
    let middle = |at: f64, width: f64| a + along * at + out * (width / 2.0);
    Some(Slit { corners, ends: [middle(begin, widths[0]), middle(end, widths[1])], width })
}
