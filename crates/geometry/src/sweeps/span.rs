//! Spans: the surface between two rings, with its orientation and normals.

use std::f64::consts::FRAC_PI_2;

use glam::{DMat3, DQuat, DVec2, DVec3};
use smallvec::{SmallVec, smallvec};

use super::ring::{Pose, SectionRing};
use crate::cross_section::section::Section;
use crate::cross_section::skin::{Skin, Tangent};
use crate::limits::{FEW, NOTHING};
use burgeon_base::error::{Error, Result};

/// Directions in which normals are smooth over a surface.
#[derive(Debug, Clone, Copy)]
pub(super) struct NormalSpread {
    pub(super) around: bool,
    pub(super) along: bool,
}

/// A normal for each column.
pub(super) type Normals = SmallVec<[DVec3; 2 * FEW]>;

/// The surface between two rings.
#[derive(Debug)]
pub(super) struct Span {
    /// Orientation: 1 if the faces point outwards as constructed, -1 if mirroring or a backward path inverts
    /// them.
    pub(super) sign: f64,
    /// Marks two rings at the same position.
    pub(super) step: bool,
    /// Unit normals of all columns at the first and at the second ring.
    pub(super) normals: [Normals; 2],
}

impl Span {
    /// Creates the span from ring `a` to ring `b`; `None` if the span has no surface.
    ///
    /// `direction` is -1 for a path against its headings. Fails if a scale changes its sign within the span.
    pub(super) fn new(
        section: &Section,
        skin: &Skin,
        [a, b]: [&SectionRing; 2],
        direction: f64,
        shading: NormalSpread,
    ) -> Result<Option<Self>> {
        let (from, to) = (a.after.scale, b.before.scale);
        if from.x * to.x < 0.0 || from.y * to.y < 0.0 {
            let message =
                format!("the scale changes its sign between stations {} and {}", a.station, b.station);
            return Err(Error::geometry(message).help(
                "put a station of scale 0 between them, or twist by 180 degrees instead of scaling by -1",
            ));
        }
        let middle = from + to;
        let turned = middle.x * middle.y;
        if turned == 0.0 && !section.is_open() || middle == DVec2::ZERO {
            return Ok(None);
        }
        let sign = if turned < 0.0 { -direction } else { direction };
        let chord = b.before.frame.position - a.after.frame.position;
        let step = chord.length() <= NOTHING;
        let mut normals = match shading {
            NormalSpread { around: false, along: false } => flat_normals(skin, a, b),
            NormalSpread { along, .. } => smooth(section, skin, [a, b], along),
        };
        if sign < 0.0 {
            normals.iter_mut().flatten().for_each(|normal| *normal = -*normal);
        }
        Ok(Some(Self { sign, step, normals }))
    }
}

/// Computes flat normals: both columns of a face have the normal of the face.
fn flat_normals(skin: &Skin, a: &SectionRing, b: &SectionRing) -> [Normals; 2] {
    let mut normals: Normals = smallvec![DVec3::Z; skin.columns.len()];
    for strip in &skin.strips {
        for column in strip.columns.start..strip.columns.end - 1 {
            let [left, right] = [column, column + 1].map(|column| skin.columns[column].point);
            let diagonals = (b.exact[right] - a.exact[left], b.exact[left] - a.exact[right]);
            let normal = diagonals.0.cross(diagonals.1).normalize_or(a.after.frame.heading);
            (normals[column], normals[column + 1]) = (normal, normal);
        }
    }
    [Normals::from_slice(&normals), normals]
}

/// Computes smooth normals: the cross product of the outline's direction and the motion of each point.
fn smooth(section: &Section, skin: &Skin, [a, b]: [&SectionRing; 2], along: bool) -> [Normals; 2] {
    let points: Vec<DVec2> = section.points().collect();
    let motion = Motion::new(&a.after, &b.before);
    let sides = [SpanEnd::new(&a.after, &b.before), SpanEnd::new(&b.before, &a.after)];
    let normal = |side: usize, point: usize, tangent: Tangent| {
        let outwards = sides[side].offset(points[point]).normalize_or(sides[side].heading);
        let (around, way) = if along {
            (sides[side].around(tangent), motion.way(side, &sides[side], points[point]))
        } else {
            (sides[0].around(tangent) + sides[1].around(tangent), b.exact[point] - a.exact[point])
        };
        around.cross(way).normalize_or(outwards)
    };
    [0, 1].map(|side| skin.columns.iter().map(|column| normal(side, column.point, column.tangent)).collect())
}

/// One end of a span.
struct SpanEnd {
    x: DVec3,
    y: DVec3,
    heading: DVec3,
    scale: DVec2,
    /// Scale for directions around the outline: not 0, so that the tip of a cone has directions.
    least: DVec2,
}

impl SpanEnd {
    fn new(pose: &Pose, other: &Pose) -> Self {
        let (x, y) = pose.axes();
        let inside = pose.scale.lerp(other.scale, 1e-3);
        let pick = |scale: f64, inside: f64| if scale == 0.0 { inside } else { scale };
        let least = DVec2::new(pick(pose.scale.x, inside.x), pick(pose.scale.y, inside.y));
        Self { x, y, heading: pose.frame.heading, scale: pose.scale, least }
    }

    fn offset(&self, point: DVec2) -> DVec3 {
        self.x * (self.least.x * point.x) + self.y * (self.least.y * point.y)
    }

    /// Returns the direction of the outline.
    fn around(&self, tangent: Tangent) -> DVec3 {
        let used = tangent.into_iter().filter(|(_, weight)| *weight > 0.0);
        let mixed: DVec3 = used.map(|(edge, weight)| self.offset(edge).normalize_or_zero() * weight).sum();
        mixed.normalize_or_zero()
    }
}

/// Motion of points along a span: the centre moves on an arc of constant curvature, and twist and scale
/// change linearly.
struct Motion {
    /// Motion of the centre at both ends, over the whole span.
    centre: [DVec3; 2],
    /// Rotation of the section at both ends, over the whole span: axis times angle (radians).
    turn: [DVec3; 2],
    scale: DVec2,
}

impl Motion {
    fn new(from: &Pose, to: &Pose) -> Self {
        let chord = to.frame.position - from.frame.position;
        let turn = turn_between(from, to);
        let bend = turn - turn.project_onto_normalized(chord.normalize_or(from.frame.heading));
        let half = (bend.length() / 2.0).min(FRAC_PI_2);
        let arc = chord * if half < 1e-8 { 1.0 } else { half / half.sin() };
        let centre = [DQuat::from_scaled_axis(-bend / 2.0) * arc, DQuat::from_scaled_axis(bend / 2.0) * arc];
        // A roll goes from the left downwards, which is clockwise about the heading.
        let twist = from.twist - to.twist;
        let turn = [turn + from.frame.heading * twist, turn + to.frame.heading * twist];
        Self { centre, turn, scale: to.scale - from.scale }
    }

    /// Returns the motion of a point of the section at one end.
    fn way(&self, side: usize, ends: &SpanEnd, point: DVec2) -> DVec3 {
        let offset = ends.x * (ends.scale.x * point.x) + ends.y * (ends.scale.y * point.y);
        let growth = ends.x * (self.scale.x * point.x) + ends.y * (self.scale.y * point.y);
        self.centre[side] + self.turn[side].cross(offset) + growth
    }
}

/// Returns the smallest rotation from one frame to another, without their twists: axis times angle (radians).
fn turn_between(from: &Pose, to: &Pose) -> DVec3 {
    let [a, b] = [from, to]
        .map(|pose| DQuat::from_mat3(&DMat3::from_cols(pose.frame.heading, pose.frame.left, pose.frame.up)));
    let turn = b * a.conjugate();
    let turn = if turn.w < 0.0 { -turn } else { turn };
    turn.normalize().to_scaled_axis()
}
