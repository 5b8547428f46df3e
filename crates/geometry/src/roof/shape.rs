//! Parameters of a roof's shape.

use super::field::{FieldRoof, RidgeAxis};
use glam::DVec2;

/// Type of the roof's ends over the short edges of wings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Slopes, as over all other edges.
    Hips,
    /// Upright gables.
    Gables,
    /// Gables up to half the height of the ridge, hips above.
    DutchHips,
}

/// Type of the roof's overhang.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Eaves {
    /// A level underside at the top of the walls, with slopes that begin at its outer edge and flush gables.
    Closed,
    /// A closed overhang with upright faces along the outline below the slopes.
    Slab,
    /// Slopes that continue beyond the walls as a plate with a parallel underside, also over gables.
    Open,
}

/// Height of a roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rise {
    /// Height (m) of the highest ridge above the eaves.
    Height(f64),
    /// Tangent of the slope from the eaves to the highest ridge.
    Slope(f64),
}

/// The upright border of a flat roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// Height (m) above the roof.
    pub height: f64,
    /// Width (m).
    pub width: f64,
}

/// Surface of a roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RoofSurface {
    /// A level surface, with or without a border.
    Flat(Option<Border>),
    /// One slope, highest over the longest edge.
    Shed,
    /// A slope over each edge, with bends of its profile as fractions of the width and of the height, from
    /// the eaves up.
    Sloped(Ends, &'static [(f64, f64)]),
    /// Heights that are a function of the place, over any plan, with the direction of the ridge.
    Field(FieldRoof, RidgeAxis),
}

/// Shape of a roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoofShape {
    /// Surface.
    pub surface: RoofSurface,
    /// Height or slope.
    pub rise: Rise,
    /// Overhang beyond the walls (m).
    pub overhang: f64,
    /// Type of the overhang.
    pub eaves: Eaves,
    /// Height (m) of the upright faces along the outline, and thickness of a plate.
    pub slab: f64,
}

/// Maximum slope (a tangent) of a plate beyond the walls, so that the eaves of steep roofs stay high.
pub const STEEPEST_EAVES: f64 = 0.7;

/// Height of a roof (m) above the top of the walls, as a function of the distance (m) from the outline.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    /// Corners, by distance; two at one distance form an upright step.
    pub corners: Vec<DVec2>,
    /// Height (m) of the underside at the outline.
    pub bottom: f64,
    /// Index of the first interval of the slopes: earlier intervals are beyond the walls or part of a border.
    pub first: usize,
}

impl Profile {
    /// Creates the profile of a roof whose ridge is at most `wide` (m) from the outline, of which `overhang`
    /// (m) is beyond the walls.
    pub(super) fn new(shape: &RoofShape, wide: f64, overhang: f64) -> Self {
        let (mut corners, mut bottom, mut first) = (Vec::new(), 0.0, 0);
        match shape.surface {
            RoofSurface::Flat(border) => {
                if let Some(Border { height, width }) = border {
                    let (width, high) = (width.min(wide * 0.5), shape.slab + height);
                    first = 2;
                    corners.extend([(0.0, high), (width, high), (width, shape.slab)].map(DVec2::from));
                } else {
                    corners.push(DVec2::new(0.0, shape.slab));
                }
                corners.push(DVec2::new(wide, shape.slab));
            }
            RoofSurface::Shed | RoofSurface::Sloped(..) | RoofSurface::Field(..) => {
                let bends: &[(f64, f64)] =
                    if let RoofSurface::Sloped(_, bends) = shape.surface { bends } else { &[] };
                let plate = shape.eaves == Eaves::Open && overhang > 0.0;
                let from = if plate { overhang } else { 0.0 };
                let width = (wide - from).max(1e-3);
                let rise = match shape.rise {
                    Rise::Height(height) => height,
                    Rise::Slope(slope) => slope * width,
                };
                let flaps = bends.iter().chain([&(1.0, 1.0)]);
                let mut flaps = flaps.map(|&(w, h)| DVec2::new(from + w * width, shape.slab + h * rise));
                let start = DVec2::new(from, shape.slab);
                if plate {
                    first = 1;
                    let lowest = flaps.clone().next().unwrap_or(start);
                    let slope = ((lowest.y - start.y) / (lowest.x - start.x)).min(STEEPEST_EAVES);
                    bottom = -slope * overhang;
                    corners.push(DVec2::new(0.0, shape.slab + bottom));
                }
                corners.push(start);
                corners.extend(flaps.by_ref());
            }
        }
        Self { corners, bottom, first }
    }

    /// Returns the distance (m) by which the slopes continue beyond the walls, as a plate.
    pub(super) fn plate_overhang(&self) -> f64 {
        if self.first == 1 { self.corners[self.first].x } else { 0.0 }
    }

    /// Returns the height (m) at a distance (m) from the outline, on the upper side of a step.
    pub(super) fn height(&self, distance: f64) -> f64 {
        let last = self.corners.len().saturating_sub(2);
        let intervals = self.corners.windows(2).enumerate();
        let mut spans = intervals.filter(|(_, pair)| pair[1].x > pair[0].x);
        let span = spans.find(|(index, pair)| *index == last || distance <= pair[1].x);
        span.map_or(0.0, |(_, pair)| interpolate(pair[0], pair[1], distance))
    }
}

/// Interpolates the height at `distance` between two corners; exact at both, so that neighbours agree.
#[allow(clippy::float_cmp, reason = "exact at the end")]
pub(super) fn interpolate(from: DVec2, to: DVec2, distance: f64) -> f64 {
    if distance == to.x {
        return to.y;
    }
    from.y + (to.y - from.y) * ((distance - from.x) / (to.x - from.x))
}
