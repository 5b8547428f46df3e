//! What a roof is to be like.

use glam::DVec2;

/// What stands over the short edges at the ends of wings.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ends {
    /// Slopes, as over all other edges.
    Hips,
    /// Upright gables.
    Gables,
    /// Gables up to half the height of the ridge, hips above.
    DutchHips,
}

/// How the roof juts out over the walls.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Eaves {
    /// A level underside at the top of the walls; the slopes begin at its outer edge. Gables are flush.
    Closed,
    /// As closed, with upright faces along the outline on which the slopes stand.
    Slab,
    /// The slopes run on beyond the walls as a plate with an underside along them, over gables too.
    Open,
}

/// How high a roof is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rise {
    /// The highest ridge stands so far (m) above the eaves.
    Height(f64),
    /// The tangent of the slope from the eaves to the highest ridge.
    Slope(f64),
}

/// The upright edge of a flat roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Border {
    /// Its height (m) above the roof.
    pub height: f64,
    /// Its width (m).
    pub width: f64,
}

/// The faces of a roof.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RoofSurface {
    /// Level, with a border or without.
    Flat(Option<Border>),
    /// One slope, highest over the longest edge.
    Shed,
    /// A slope over each edge; its profile has bends, as parts of the width and of the height, from the eaves up.
    Sloped(Ends, &'static [(f64, f64)]),
}

/// What a roof is to be like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoofShape {
    /// Its surface.
    pub surface: RoofSurface,
    /// How high it is.
    pub rise: Rise,
    /// How far (m) it juts out over the walls.
    pub overhang: f64,
    /// How it does so.
    pub eaves: Eaves,
    /// The height (m) of the upright faces along the outline, and how thick a plate is.
    pub slab: f64,
}

/// The steepest slope (a tangent) of a plate beyond the walls, so that the eaves of steep flaps stay high.
pub const STEEPEST_EAVES: f64 = 0.7;

/// The height of a roof (m) above the top of the walls over the distance (m) from the outline.
#[derive(Debug, Clone)]
pub(super) struct Profile {
    /// Its corners, by their distance; two at one distance make an upright step.
    pub corners: Vec<DVec2>,
    /// The height (m) of the underside at the outline.
    pub bottom: f64,
    /// The first interval of the slopes themselves: what is before is beyond the walls, or a border.
    pub first: usize,
}

impl Profile {
    /// The profile of a roof whose ridge is at most `wide` (m) from the outline, of which `overhang` (m) is beyond
    /// the walls.
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
            RoofSurface::Shed | RoofSurface::Sloped(..) => {
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

    /// How far (m) the slopes run on beyond the walls, as a plate.
    pub(super) fn beyond(&self) -> f64 {
        if self.first == 1 { self.corners[self.first].x } else { 0.0 }
    }

    /// The height (m) at a distance (m) from the outline, on the higher side of a step.
    pub(super) fn height(&self, distance: f64) -> f64 {
        let last = self.corners.len().saturating_sub(2);
        let intervals = self.corners.windows(2).enumerate();
        let mut spans = intervals.filter(|(_, pair)| pair[1].x > pair[0].x);
        let span = spans.find(|(index, pair)| *index == last || distance <= pair[1].x);
        span.map_or(0.0, |(_, pair)| between(pair[0], pair[1], distance))
    }
}

/// The height at `distance` on the line between two corners; exact at both, so that neighbours agree.
#[allow(clippy::float_cmp, reason = "exact at the end")]
pub(super) fn between(from: DVec2, to: DVec2, distance: f64) -> f64 {
    if distance == to.x {
        return to.y;
    }
    from.y + (to.y - from.y) * ((distance - from.x) / (to.x - from.x))
}
