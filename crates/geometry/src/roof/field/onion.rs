//! Onion domes: bulbs that are wider than their foot.

use glam::{DVec2, DVec3};

use super::super::{Patch, PatchKind, Rise, RoofCover, RoofShape, Support};
use super::forms::largest_circle;
use super::radial::Apex;
use crate::planar::{Ring, edges};
use burgeon_base::error::Result;

/// Outline of the bulb: the share of the height and the scale of the foot.
const BULB: [(f64, f64); 13] = [
    (0.0, 1.0),
    (0.04, 0.9),
    (0.09, 0.86),
    (0.16, 0.93),
    (0.25, 1.04),
    (0.34, 1.09),
    (0.43, 1.05),
    (0.53, 0.9),
    (0.62, 0.66),
    (0.71, 0.4),
    (0.8, 0.2),
    (0.9, 0.08),
    (1.0, 0.0),
];
/// Number of sides of a bulb on a deck.
const SIDES: usize = 24;
/// Share of the largest circle in the plan that the widest part of a bulb on a deck may fill.
const FILLED: f64 = 0.88;

/// Creates a bulb over the outline of a support. Over courtyards, or if no place sees all corners of the outline, a round bulb
/// stands on a level deck, in the largest circle of the plan.
pub(super) fn cover(shape: &RoofShape, support: &Support<'_>) -> Result<RoofCover> {
    let &Support { walls, base, .. } = support;
    let apex = Apex::new(walls)?;
    let (mut patches, mut remark) = (Vec::new(), None);
    let (at, foot) = if walls.holes().is_empty() && !apex.is_hull {
        (apex.at, apex.outline)
    } else {
        let (at, radius) = largest_circle(support)?;
        let corner = |side: usize| {
            let angle = std::f64::consts::TAU * side as f64 / SIDES as f64;
            at + DVec2::from_angle(angle) * (FILLED * radius)
        };
        let foot: Vec<DVec2> = (0..SIDES).map(corner).collect();
        remark = Some("it stands on a level deck, in the largest circle of the plan");
        patches.push(level(PatchKind::Slope, walls.at_height(base).to_vec()));
        let below = foot.iter().rev().map(|at| at.extend(base)).collect();
        patches.extend(Ring::without_repeats(below).map(|ring| level(PatchKind::Underside, vec![ring])));
        (at, foot)
    };
    let radius =
        edges(&foot).map(|[a, b]| (b - a).normalize_or_zero().perp_dot(at - a)).fold(f64::INFINITY, f64::min);
    let rise = match shape.rise {
        Rise::Height(height) => height,
        Rise::Slope(slope) => slope * radius,
    };
    let place = |corner: DVec2, (share, scale): (f64, f64)| -> DVec3 {
        let moved = if scale == 1.0 { corner } else { at + (corner - at) * scale };
        moved.extend(base + share * rise)
    };
    for (edge, [a, b]) in edges(&foot).enumerate() {
        let along = (b - a).normalize_or_zero();
        let edge = if patches.is_empty() || remark.is_none() { edge } else { 0 };
        for (flap, pair) in BULB.windows(2).enumerate() {
            let ring = vec![place(a, pair[0]), place(b, pair[0]), place(b, pair[1]), place(a, pair[1])];
            patches.extend(Patch::new(PatchKind::Slope, edge, flap, along, ring));
        }
    }
    Ok(RoofCover { patches, overhangs: vec![0.0; walls.size()], remark, ..RoofCover::default() })
}

fn level(kind: PatchKind, rings: Vec<Ring<DVec3>>) -> Patch {
    Patch { kind, edge: 0, flap: 0, along: DVec2::X, rings }
}
