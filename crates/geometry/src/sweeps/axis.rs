//! Axes of generalised cylinders: smooth curves through control points, with radii and frames.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::{DVec2, DVec3};

use super::control_point::CylinderPoint;
use crate::curves::curve::{Curve, CurveKind};
use crate::curves::frames::rotation_minimizing;
use crate::curves::ramp::{Ramp, RampKind};
use crate::limits::NOTHING;
use burgeon_base::error::Result;

/// Maximum angle (radians) between the tangents of two rings.
const TURN: f64 = 0.18;
/// Number of rings between two control points between which the radius or the contour changes.
const CHANGING: usize = 6;
/// Maximum number of rings between two control points.
const MOST: usize = 64;
/// Angle (radians) below which a twist is a rounding error.
const SLIGHT: f64 = 1e-9;
/// Number of tangents that are compared between two control points.
const PROBES: usize = 8;

/// A ring across the axis.
pub(crate) struct AxisRing {
    /// Position on the axis (m).
    pub(crate) centre: DVec3,
    /// Unit tangent of the axis.
    pub(crate) tangent: DVec3,
    /// Direction of the contour's x, perpendicular to the tangent.
    pub(crate) side: DVec3,
    /// Radius (m).
    pub(crate) radius: f64,
    /// Distance (m) from the start along the axis.
    pub(crate) distance: f64,
    /// Control point before the ring.
    pub(crate) control: usize,
    /// Part of the contour of the next control point, from 0 to 1.
    pub(crate) part: f64,
}

/// Returns the rings of the axis through `points`, of which those at the position of their predecessor are left out;
/// none if fewer than 2 remain. `side` is the direction of the contour's x at the start.
pub(crate) fn rings(points: &mut Vec<CylinderPoint>, side: DVec3) -> Result<Vec<AxisRing>> {
    // The last of several points at one position counts, as the width of a branch does.
    points.dedup_by(|next, kept| {
        let same = next.position.distance(kept.position) <= NOTHING;
        if same {
            kept.clone_from(next);
        }
        same
    });
    if points.len() < 2 {
        return Ok(Vec::new());
    }
    let positions: Vec<DVec3> = points.iter().map(|point| point.position).collect();
    let curve = Curve::new(&positions, CurveKind::Through, false)?;
    let marks = curve.joints();
    let radii: Vec<_> = marks.iter().zip(points.iter()).map(|(mark, it)| (*mark, it.radius).into()).collect();
    let radius = Ramp::new(&radii, RampKind::Monotone)?;
    let mut rings: Vec<AxisRing> = Vec::new();
    for (control, pair) in points.windows(2).enumerate() {
        let (from, to) = (marks[control], marks[control + 1]);
        let at = |step: usize, of: usize| from + (to - from) * (step as f64 / of as f64);
        let tangents: Vec<DVec3> = (0..=PROBES).map(|probe| curve.tangent(at(probe, PROBES))).collect();
        let turn: f64 = tangents.windows(2).map(|pair| pair[0].angle_between(pair[1])).sum();
        // The angle of the twist is at most the sum of this angle and of the turn.
        let twist = pair[0].side.zip(pair[1].side).map_or(0.0, |(from, to)| from.angle_between(to));
        let turn = if twist > SLIGHT { 2.0 * turn + twist } else { turn };
        let same = pair[0].radius.to_bits() == pair[1].radius.to_bits() && same(&pair[0], &pair[1]);
        let steps = ((turn / TURN).ceil() as usize).max(if same { 1 } else { CHANGING }).min(MOST);
        let last = control + 2 == points.len();
        rings.extend((0..steps + usize::from(last)).map(|step| {
            let (t, part) = (at(step, steps), step as f64 / steps as f64);
            let tangent = if t >= 1.0 { tangents[PROBES] } else { curve.tangent(t) };
            AxisRing {
                centre: curve.point(t),
                tangent,
                side: DVec3::ZERO,
                radius: radius.at(t).max(0.0),
                distance: t * curve.length(),
                control,
                // Smooth at the control points, where another change of contour begins.
                part: part * part * (3.0 - 2.0 * part),
            }
        }));
    }
    let centres: Vec<DVec3> = rings.iter().map(|ring| ring.centre).collect();
    let tangents: Vec<DVec3> = rings.iter().map(|ring| ring.tangent).collect();
    let sides = rotation_minimizing(&centres, &tangents, side);
    rings.iter_mut().zip(sides).for_each(|(ring, side)| ring.side = side);
    twist(&mut rings, points, curve.length())?;
    Ok(rings)
}

/// Rotates the sides of `rings` about the axis of this `length` (m), so that they have the directions of the `points` that
/// have one, and change smoothly between these.
fn twist(rings: &mut [AxisRing], points: &[CylinderPoint], length: f64) -> Result<()> {
    let mut angles: Vec<DVec2> = Vec::new();
    for (control, point) in points.iter().enumerate() {
        let Some(side) = point.side else { continue };
        let index = rings.partition_point(|ring| ring.control < control).min(rings.len() - 1);
        let ring = &rings[index];
        let flat = side.reject_from_normalized(ring.tangent);
        if !flat.is_finite() || flat.length_squared() < NOTHING {
            continue;
        }
        let angle = f64::atan2(ring.tangent.dot(ring.side.cross(flat)), ring.side.dot(flat));
        // The shorter way from the angle before.
        let before = angles.last().map_or(angle, |last| last.y);
        angles.push(DVec2::new(ring.distance, angle - TAU * ((angle - before) / TAU).round()));
    }
    if angles.iter().all(|angle| angle.y.abs() < SLIGHT) {
        return Ok(());
    }
    let only = angles.first().map_or(0.0, |first| first.y);
    let ramp = if angles.len() > 1 { Some(Ramp::new(&angles, RampKind::Monotone)?) } else { None };
    for ring in rings {
        let angle = ramp.as_ref().map_or(only, |ramp| ramp.at(ring.distance.min(length)));
        let (sin, cos) = angle.sin_cos();
        ring.side = ring.side * cos + ring.tangent.cross(ring.side) * sin;
    }
    Ok(())
}

/// Returns true if two control points have the same contour.
fn same(one: &CylinderPoint, other: &CylinderPoint) -> bool {
    match (&one.contour, &other.contour) {
        (None, None) => true,
        (Some(one), Some(other)) => Arc::ptr_eq(one, other) || one == other,
        _ => false,
    }
}
