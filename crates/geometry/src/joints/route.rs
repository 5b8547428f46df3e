//! Routes of tubes: axes as stations with frames and radii, which can be cut at any length.

use std::sync::Arc;

use glam::DVec3;

use super::outline::Outlines;
use crate::sweeps::axis::rings;
use crate::sweeps::control_point::CylinderPoint;
use burgeon_base::error::Result;

/// A place on an axis with the frame of its ring.
#[derive(Debug, Clone, Copy)]
pub(super) struct RouteFrame {
    /// Length (m) along the axis from its start.
    pub(super) at: f64,
    /// Position (m).
    pub(super) centre: DVec3,
    /// Unit normal of the ring.
    pub(super) tangent: DVec3,
    /// Direction of the outline's x, perpendicular to the tangent.
    pub(super) side: DVec3,
    /// Radius (m).
    pub(super) radius: f64,
    /// Control point before the ring.
    pub(super) control: usize,
    /// Part of the outline of the next control point, from 0 to 1.
    pub(super) part: f64,
    /// Direction in which a mitre stretches the ring.
    bend: DVec3,
    /// Factor of the stretch, minus 1.
    stretch: f64,
    /// Tangent of half the angle of the bend.
    slant: f64,
}

impl RouteFrame {
    /// Returns a point of the ring (m) from its place in the outline.
    #[inline]
    pub(super) fn point(&self, flat: glam::DVec2) -> DVec3 {
        let up = self.tangent.cross(self.side);
        let away = (self.side * flat.x + up * flat.y) * self.radius;
        self.centre + away + self.bend * (self.stretch * self.bend.dot(away))
    }

    /// Returns the length (m) of the axis on each side of the ring that the ring reaches.
    fn reach(&self) -> f64 {
        self.radius * self.slant
    }
}

/// An axis as a list of frames.
#[derive(Debug)]
pub(super) struct Route {
    /// Frames in ascending order; none if the axis has no length.
    pub(super) frames: Vec<RouteFrame>,
    /// Direction and side of the straight segment after each frame; none if the axis is smooth.
    segments: Vec<[DVec3; 2]>,
    /// Length (m) from the start to each control point.
    pub(super) marks: Vec<f64>,
    pub(super) outlines: Arc<Outlines>,
}

impl Route {
    /// Creates the route through `points`, no two of which are at one position in sequence.
    ///
    /// `circle` is the outline without contours, `side` the direction of the outline's x at the start.
    pub(super) fn new(
        points: &[CylinderPoint],
        side: DVec3,
        smooth: bool,
        sides: usize,
        circle: &Arc<Outlines>,
    ) -> Result<Self> {
        let round = points.iter().all(|point| point.contour.is_none());
        let outlines = if round { Arc::clone(circle) } else { Arc::new(Outlines::of(points, sides)) };
        let mut route = Self { frames: Vec::new(), segments: Vec::new(), marks: Vec::new(), outlines };
        if points.len() < 2 {
            route.marks = vec![0.0; points.len()];
        } else if smooth {
            route.add_smooth(points, side)?;
        } else {
            route.add_straight(points, side);
        }
        Ok(route)
    }

    /// Adds the frames of a smooth axis.
    fn add_smooth(&mut self, points: &[CylinderPoint], side: DVec3) -> Result<()> {
        let mut kept = points.to_vec();
        let rings = rings(&mut kept, side)?;
        self.marks = vec![0.0; points.len()];
        for (index, ring) in rings.iter().enumerate() {
            let first = index == 0 || rings[index - 1].control != ring.control;
            if first {
                self.marks[ring.control] = ring.distance;
            }
            self.marks[points.len() - 1] = ring.distance;
            self.frames.push(RouteFrame {
                at: ring.distance,
                centre: ring.centre,
                tangent: ring.tangent,
                side: ring.side,
                radius: ring.radius,
                control: ring.control,
                part: ring.part,
                bend: DVec3::ZERO,
                stretch: 0.0,
                slant: 0.0,
            });
        }
        Ok(())
    }

    /// Adds the frames of a polyline: a mitre at each bend.
    fn add_straight(&mut self, points: &[CylinderPoint], side: DVec3) {
        let direction = |index: usize| {
            let way = points[index + 1].position - points[index].position;
            way.try_normalize().unwrap_or(DVec3::Z)
        };
        let last = points.len() - 1;
        let mut before = direction(0);
        let mut side = perpendicular(side, before);
        let mut at = 0.0;
        for (index, point) in points.iter().enumerate() {
            let next = if index < last { direction(index) } else { before };
            let (mut tangent, mut bend, mut stretch, mut slant) = (before, DVec3::ZERO, 0.0, 0.0);
            let (sum, turn) = (before + next, next - before);
            // Beyond 120 degrees the ring is perpendicular to the last segment, because a mitre would be too long.
            if sum.length_squared() > 1.0 && turn.length_squared() > 1e-12 {
                let length = sum.length();
                tangent = sum / length;
                bend = turn.normalize();
                (stretch, slant) = (2.0 / length - 1.0, turn.length() / length);
            }
            side = carry(side, before, tangent);
            self.marks.push(at);
            self.frames.push(RouteFrame {
                at,
                centre: point.position,
                tangent,
                side,
                radius: point.radius,
                control: index,
                part: 0.0,
                bend,
                stretch,
                slant,
            });
            side = carry(side, tangent, next);
            self.segments.push([next, side]);
            before = next;
            if index < last {
                at += point.position.distance(points[index + 1].position);
            }
        }
    }

    /// Returns the frame at a length (m) along the axis; `None` if the axis has no length.
    pub(super) fn frame(&self, at: f64) -> Option<RouteFrame> {
        let last = self.frames.len().checked_sub(2)?;
        let index = self.frames.partition_point(|frame| frame.at <= at).saturating_sub(1).min(last);
        let (from, to) = (&self.frames[index], &self.frames[index + 1]);
        let span = to.at - from.at;
        let t = if span > 0.0 { ((at - from.at) / span).clamp(0.0, 1.0) } else { 0.0 };
        let (tangent, side) = match self.segments.get(index) {
            Some([tangent, side]) => (*tangent, *side),
            None => {
                let tangent = from.tangent.lerp(to.tangent, t).normalize_or(from.tangent);
                (tangent, perpendicular(from.side.lerp(to.side, t), tangent))
            }
        };
        let same = from.control == to.control;
        let end = if same { to.part } else { 1.0 };
        Some(RouteFrame {
            at: from.at + span * t,
            centre: from.centre.lerp(to.centre, t),
            tangent,
            side,
            radius: from.radius + (to.radius - from.radius) * t,
            control: from.control,
            part: from.part + (end - from.part) * t,
            bend: DVec3::ZERO,
            stretch: 0.0,
            slant: 0.0,
        })
    }

    /// Returns the frames between two lengths (m) along the axis, without those whose ring would reach the ends.
    pub(super) fn between(&self, from: f64, to: f64) -> impl Iterator<Item = &RouteFrame> {
        let first = self.frames.partition_point(|frame| frame.at <= from);
        let gap = 1e-6 + (to - from) * 1e-3;
        self.frames[first..].iter().take_while(move |frame| frame.at < to).filter(move |frame| {
            let reach = frame.reach() + gap;
            frame.at - from > reach && to - frame.at > reach
        })
    }
}

/// Returns the unit vector closest to `side` that is perpendicular to `tangent`.
pub(super) fn perpendicular(side: DVec3, tangent: DVec3) -> DVec3 {
    let side = side.reject_from_normalized(tangent);
    let sound = side.is_finite() && side.length_squared() > 1e-12;
    if sound { side.normalize() } else { tangent.any_orthonormal_vector() }
}

/// Rotates `side` by the smallest rotation from `before` to `after`; all are unit vectors.
fn carry(side: DVec3, before: DVec3, after: DVec3) -> DVec3 {
    let cosine = 1.0 + before.dot(after);
    if cosine <= 1e-6 {
        return perpendicular(side, after);
    }
    perpendicular(side - (before + after) * (side.dot(after) / cosine), after)
}
