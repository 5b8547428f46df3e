//! Heights over a plan, as planes with the lines between them.

use glam::DVec2;

use super::radial::RadialGauge;
use crate::roof::mapped::MappedSurface;

/// Height (m) above the walls as a linear function of the place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::roof) struct HeightPlane {
    /// A place.
    pub at: DVec2,
    /// Height (m) at the place.
    pub height: f64,
    /// Change of the height with the place.
    pub gradient: DVec2,
}

impl HeightPlane {
    /// Returns the height (m) at a place.
    pub(in crate::roof) fn height_at(&self, place: DVec2) -> f64 {
        self.height + self.gradient.dot(place - self.at)
    }
}

/// Rule that selects the plane at a place.
#[derive(Debug, Clone)]
pub(in crate::roof) enum PlaneRule {
    /// Bands across a direction, divided at distances (m) from the middle.
    Bands { middle: DVec2, way: DVec2, limits: Vec<f64> },
    /// The lowest plane.
    Lowest,
    /// The higher one of two roofs, each the lower one of two planes.
    Crossed,
    /// The lowest of four planes; above `height` (m) only of the first two.
    Gablets { height: f64 },
    /// Sectors around an apex, divided into rings.
    Radial(RadialGauge),
    /// Facets between the lines of a map.
    Mapped(MappedSurface),
}

/// Heights over a plan.
#[derive(Debug, Clone)]
pub(in crate::roof) struct HeightField {
    /// Planes.
    pub planes: Vec<HeightPlane>,
    /// Rule that selects a plane.
    pub rule: PlaneRule,
}

impl HeightField {
    /// Returns the index of the plane at a place.
    pub(super) fn plane_at(&self, place: DVec2) -> usize {
        let lowest = |from: usize, to: usize| {
            let heights = (from..to).map(|index| (index, self.planes[index].height_at(place)));
            heights.min_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
        };
        match &self.rule {
            PlaneRule::Bands { middle, way, limits } => {
                let at = way.dot(place - *middle);
                limits.partition_point(|limit| *limit < at)
            }
            PlaneRule::Lowest => lowest(0, self.planes.len()).0,
            PlaneRule::Crossed => {
                let (one, other) = (lowest(0, 2), lowest(2, 4));
                if one.1 >= other.1 { one.0 } else { other.0 }
            }
            PlaneRule::Gablets { height } => {
                if lowest(2, 4).1 < *height {
                    lowest(0, 4).0
                } else {
                    lowest(0, 2).0
                }
            }
            PlaneRule::Radial(gauge) => gauge.index(place),
            PlaneRule::Mapped(surface) => surface.index(place),
        }
    }

    /// Returns lines that contain all borders between planes, within a distance (m) of a place.
    pub(super) fn breaks(&self, around: DVec2, reach: f64) -> Vec<Vec<DVec2>> {
        let across = |at: DVec2, way: DVec2| {
            let foot = at + way * way.dot(around - at);
            vec![foot - way * reach, foot + way * reach]
        };
        // Line at which a linear function is 0.
        let zero = |at: DVec2, value: f64, gradient: DVec2| {
            let steep = gradient.length_squared();
            (steep > 1e-12).then(|| across(at - gradient * (value / steep), gradient.perp() / steep.sqrt()))
        };
        match &self.rule {
            PlaneRule::Bands { middle, way, limits } => {
                limits.iter().map(|limit| across(*middle + *way * *limit, way.perp())).collect()
            }
            PlaneRule::Radial(gauge) => gauge.lines(reach),
            PlaneRule::Mapped(surface) => surface.lines(reach),
            PlaneRule::Lowest | PlaneRule::Crossed | PlaneRule::Gablets { .. } => {
                let mut lines = Vec::new();
                for (index, one) in self.planes.iter().enumerate() {
                    for other in &self.planes[..index] {
                        let off = one.height_at(around) - other.height_at(around);
                        lines.extend(zero(around, off, one.gradient - other.gradient));
                    }
                    if let (PlaneRule::Gablets { height }, true) = (&self.rule, index >= 2) {
                        lines.extend(zero(around, one.height_at(around) - height, one.gradient));
                    }
                }
                lines
            }
        }
    }

    /// Returns the maximum slope (a tangent).
    pub(super) fn steepest(&self) -> f64 {
        self.planes.iter().map(|plane| plane.gradient.length()).fold(0.0, f64::max)
    }
}
