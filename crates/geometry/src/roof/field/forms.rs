//! Forms of roofs whose height is a function of the place.

use glam::DVec2;

use super::super::{Rise, RoofCover, RoofShape, Support};
use super::axis::{RidgeAxis, RidgeFrame};
use super::heights::{HeightField, HeightPlane, PlaneRule};
use super::radial::{Apex, RadialGauge};
use super::{onion, profiles, raise};
use crate::skeleton::{Pace, Skeleton};
use burgeon_base::error::Result;

/// Form of a roof whose height is a function of the place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldRoof {
    /// Two slopes and one ridge, with bends of the slopes as fractions of the width and of the height, from the eaves up.
    Gable(&'static [(f64, f64)]),
    /// One slope.
    Shed,
    /// Two slopes of different lengths with eaves at one height.
    Saltbox,
    /// An arc over the ridge.
    Round,
    /// Two slopes down to a valley in the middle.
    Butterfly,
    /// Two slopes at different heights, with an upright face between them.
    Clerestory,
    /// Several slopes of one direction with upright faces between them.
    Sawtooth {
        /// Slope (a tangent) that selects the number of slopes, if the height is given.
        slope: f64,
    },
    /// Two gable roofs that cross.
    CrossGable,
    /// A gable roof with a hip at the end that water runs towards.
    SideHip,
    /// A gable roof with a hip above half of the height at the end that water runs towards.
    SideHalfHip,
    /// A hip roof with small gables at both ends of the ridge.
    Gablet,
    /// Slopes from each edge to one apex.
    Pyramid,
    /// A quarter of an ellipse from each edge to the top.
    Dome,
    /// A bulb that tapers to a point.
    Onion,
}

/// Fraction of the height at which half hips begin and gablets stand.
const HALF: f64 = 0.5;
/// Share of the height by which the upper slope of a clerestory roof is moved.
const STEP: f64 = 0.3;
/// Number of rings of a dome.
const DOME_RINGS: usize = 10;
/// Width (m) of the slopes of a sawtooth roof, if its height is not given.
const TOOTH: f64 = 6.0;

impl FieldRoof {
    /// Returns true if water runs in one direction that can be given.
    pub fn has_axis(self) -> bool {
        !matches!(self, Self::Pyramid | Self::Dome | Self::Onion)
    }

    /// Creates the roof over a support.
    pub(in super::super) fn cover(
        self,
        shape: &RoofShape,
        axis: RidgeAxis,
        support: &Support<'_>,
    ) -> Result<RoofCover> {
        if self == Self::Onion {
            return onion::cover(shape, support);
        }
        let mut remark = None;
        let field = if self.has_axis() {
            self.ridged(shape, axis, support)
        } else {
            let apex = Apex::new(support.walls)?;
            if apex.is_hull {
                remark =
                    Some("its slopes begin at the convex hull, as no place sees all corners of the outline");
            }
            self.radial(shape, &apex)
        };
        let cover = raise::cover(shape, &field, support)?;
        Ok(RoofCover { remark, ..cover })
    }

    /// Returns the heights of a roof around an apex.
    fn radial(self, shape: &RoofShape, apex: &Apex) -> HeightField {
        let rise = match shape.rise {
            Rise::Height(height) => height,
            Rise::Slope(slope) => slope * apex.radius(),
        };
        let profile: Vec<(f64, f64)> = if self == Self::Dome {
            let angle = |ring: usize| std::f64::consts::FRAC_PI_2 * ring as f64 / DOME_RINGS as f64;
            (0..=DOME_RINGS).map(|ring| (angle(ring).sin(), rise * angle(ring).cos())).collect()
        } else {
            vec![(0.0, rise), (1.0, 0.0)]
        };
        let gauge = RadialGauge::new(apex, profile.iter().map(|(share, _)| *share).collect());
        HeightField { planes: gauge.planes(&profile), rule: PlaneRule::Radial(gauge) }
    }

    /// Returns the heights of a roof along a ridge.
    fn ridged(self, shape: &RoofShape, axis: RidgeAxis, support: &Support<'_>) -> HeightField {
        let is_end = matches!(self, Self::SideHip | Self::SideHalfHip);
        let frame = RidgeFrame::new(support.walls, axis, is_end);
        let RidgeFrame { half, .. } = frame;
        let rise = |run: f64| match shape.rise {
            Rise::Height(height) => height,
            Rise::Slope(slope) => slope * run,
        };
        let profile = match self {
            Self::Shed => vec![(0.0, 0.0), (1.0, rise(2.0 * half.y))],
            Self::Saltbox => {
                let rise = rise(1.4 * half.y);
                vec![(0.0, 0.0), (0.7, rise), (1.0, 0.0)]
            }
            Self::Butterfly => {
                let rise = rise(half.y);
                vec![(0.0, rise), (0.5, 0.0), (1.0, rise)]
            }
            Self::Clerestory => {
                let rise = rise(half.y / (1.0 - STEP));
                vec![(0.0, 0.0), (0.5, (1.0 - STEP) * rise), (0.5, rise), (1.0, STEP * rise)]
            }
            Self::Round => profiles::arc(half.y, rise(half.y)),
            Self::Sawtooth { slope } => {
                let (width, high) = match shape.rise {
                    Rise::Height(height) => (height / slope.max(1e-3), Some(height)),
                    Rise::Slope(_) => (TOOTH, None),
                };
                profiles::teeth(2.0 * half.y, width, |tooth| high.unwrap_or_else(|| rise(tooth)))
            }
            Self::Gable(bends) => profiles::mirrored(bends, rise(half.y)),
            _ => {
                return self.planes(
                    &frame,
                    rise(if self == Self::CrossGable { half.min_element() } else { half.y }),
                );
            }
        };
        profiles::field(&frame, &profile)
    }

    /// Returns the heights of a roof that is the lowest or the highest of several planes.
    fn planes(self, frame: &RidgeFrame, rise: f64) -> HeightField {
        let &RidgeFrame { middle, along, down, half } = frame;
        let end = |out: DVec2, reach: f64, foot: f64, run: f64| HeightPlane {
            at: middle + out * reach,
            height: foot * rise,
            gradient: -out * ((1.0 - foot) * rise / run),
        };
        let mut planes = vec![end(down, half.y, 0.0, half.y), end(-down, half.y, 0.0, half.y)];
        // Hips are as steep as the other slopes, but leave a ridge.
        let run = half.y.min(0.8 * half.x);
        let rule = match self {
            Self::CrossGable => {
                planes.extend([along, -along].map(|out| end(out, half.x, 0.0, half.x)));
                PlaneRule::Crossed
            }
            Self::SideHip => {
                planes.push(end(along, half.x, 0.0, run));
                PlaneRule::Lowest
            }
            Self::SideHalfHip => {
                planes.push(end(along, half.x, HALF, run * (1.0 - HALF)));
                PlaneRule::Lowest
            }
            _ => {
                planes.extend([along, -along].map(|out| end(out, half.x, 0.0, run)));
                PlaneRule::Gablets { height: HALF * rise }
            }
        };
        HeightField { planes, rule }
    }
}

/// Returns the centre and the radius (m) of the largest circle in a plan.
pub(super) fn largest_circle(support: &Support<'_>) -> Result<(DVec2, f64)> {
    let skeleton = Skeleton::for_mesh(support.walls, &vec![Pace::default(); support.walls.size()])?;
    let highest = skeleton.peaks.iter().max_by(|a, b| a.time.total_cmp(&b.time));
    Ok(highest.map_or((DVec2::ZERO, 0.0), |peak| (peak.at, peak.time)))
}
