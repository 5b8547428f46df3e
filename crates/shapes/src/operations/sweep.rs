//! Faces swept along a path.

use burgeon_base::error::{Error, Result};
use burgeon_base::{MemoryOwner, Stop};
use glam::{DAffine3, DMat3, DVec2, DVec3};

use crate::mesh::PolygonMeshBuilder;
use crate::style::FaceStyle;
use crate::{Scope, Shape};

/// Least cosine of half the angle by which a path turns at a point: a mitre is at most 10 times as long as the profile.
const SHARPEST: f64 = 0.1;
/// Distance (m) within which neighbouring points are equal.
const SAME_POINT: f64 = 1e-6;

/// Path and changes of a sweep.
#[derive(Debug, Clone)]
pub struct SweepPath {
    /// Points (m).
    pub points: Vec<DVec3>,
    /// Set if the last point is joined to the first.
    pub closed: bool,
    /// Rotation (radians) from the start to the end, counter-clockwise seen against the path.
    pub twist: f64,
    /// Scale of the profile at the end.
    pub scale: f64,
}

impl Default for SweepPath {
    /// Returns a path without points, twist and scaling.
    fn default() -> Self {
        Self { points: Vec::new(), closed: false, twist: 0.0, scale: 1.0 }
    }
}

impl SweepPath {
    /// Returns the number of the point (from 0) at which the path turns most tightly, and the radius (m) of an arc between the
    /// middles of the shorter segment and its neighbour there; `None` for a straight path.
    ///
    /// ```
    /// use burgeon_shapes::SweepPath;
    /// use glam::DVec3;
    ///
    /// let points = vec![DVec3::ZERO, DVec3::X * 4.0, DVec3::new(4.0, 1.0, 0.0), DVec3::new(4.0, 9.0, 9.0)];
    /// assert_eq!(SweepPath { points, ..SweepPath::default() }.tightest_turn().map(|(at, _)| at), Some(1));
    /// ```
    pub fn tightest_turn(&self) -> Option<(usize, f64)> {
        let count = self.points.len();
        let turns = if self.closed { 0..count } else { 1..count.saturating_sub(1) };
        let radius = |at: usize| {
            let [before, after] = [self.points[(at + count - 1) % count], self.points[(at + 1) % count]];
            let (from, to) = (self.points[at] - before, after - self.points[at]);
            let tangent = (from.angle_between(to) / 2.0).tan();
            (tangent > 1e-9).then(|| (at, from.length().min(to.length()) / 2.0 / tangent))
        };
        turns.filter_map(radius).min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Directions of the profile along a segment of a path.
#[derive(Debug, Clone, Copy)]
struct SegmentFrame {
    along: DVec3,
    up: DVec3,
}

impl Shape {
    /// Returns the solid that a horizontal face sweeps along a path with mitred joints, and the numbers (from 0) of the
    /// segments that are too short for their joints, so that the solid crosses itself.
    ///
    /// The origin of the world is the point of the profile that follows the path; x is to the right and y upwards, seen
    /// along the path. Projections of the profile move to both ends, and the sides have none. At the start, up is the
    /// world's z axis, or its y axis if the path begins upright; each joint turns it by the shortest rotation. What remains
    /// at the end of a closed path is distributed over it. Faces have the tags "sweep.start", "sweep.side" and "sweep.end".
    /// Fails unless the shape is one horizontal face, and if the path has fewer than two points or turns back.
    pub fn sweep(&self, path: &SweepPath) -> Result<(Self, Vec<usize>)> {
        let rings = self.profile()?;
        let points = path_points(path)?;
        let (frames, rest) = frames(&points, path.closed)?;
        let corners: usize = rings.iter().map(Vec::len).sum();
        let count = points.len();
        MemoryOwner::ensure_room(corners.saturating_mul(count).saturating_mul(400))?;
        let lengths: Vec<f64> = distances(&points, path.closed);
        let whole = lengths[lengths.len() - 1];
        // Positions of the profile's corners at each point of the path.
        let mut sections: Vec<Vec<Vec<DVec3>>> = Vec::with_capacity(count);
        // Movements of the profile to both ends, for its projections.
        let mut moved = [DAffine3::IDENTITY; 2];
        let level = self.mesh().points.first().map_or(0.0, |at| at.z);
        for (number, at) in points.iter().enumerate() {
            Stop::check_current()?;
            let before = if number > 0 { Some(number - 1) } else { path.closed.then(|| frames.len() - 1) };
            let after = (number < frames.len()).then_some(number);
            let frame = frames[after.or(before).unwrap_or(0)];
            let tangent = match (before, after) {
                (Some(before), Some(after)) => {
                    (frames[before].along + frames[after].along).normalize_or_zero()
                }
                _ => frame.along,
            };
            let share = lengths[number] / whole;
            let (turn, scale) = ((path.twist + rest) * share, 1.0 + (path.scale - 1.0) * share);
            let right = frame.along.cross(frame.up);
            let axes = [DVec2::X, DVec2::Y].map(|axis| {
                let axis = DVec2::from_angle(turn).rotate(axis * scale);
                right * axis.x + frame.up * axis.y
            });
            let axes = DMat3::from_cols(axes[0], axes[1], right.cross(frame.up));
            moved[usize::from(number > 0)] = DAffine3::from_mat3_translation(axes, *at - axes.z_axis * level);
            let place = |corner: &DVec2| {
                let corner = DVec2::from_angle(turn).rotate(*corner * scale);
                let offset = right * corner.x + frame.up * corner.y;
                // Along the segment to the plane that bisects the joint.
                *at + offset - frame.along * (offset.dot(tangent) / frame.along.dot(tangent))
            };
            sections.push(rings.iter().map(|ring| ring.iter().map(place).collect()).collect());
        }
        let own = self.styles().into_iter().next().flatten();
        let style = |tag: &'static str| FaceStyle::with_automatic_tag(&own, tag);
        let [start, side, end] = ["sweep.start", "sweep.side", "sweep.end"].map(style);
        let [start, end] = [(start, moved[0]), (end, moved[1])]
            .map(|(style, frame)| FaceStyle::with_projections_moved(&style, &frame));
        // A projection on the plane of the profile has no place on its way.
        let side = FaceStyle::with_projections_of(&side, &None);
        let mut builder = PolygonMeshBuilder::default();
        if !path.closed {
            builder.face(sections[0].iter().map(Vec::as_slice), &start);
        }
        let mut crossing = Vec::new();
        for (number, frame) in frames.iter().enumerate() {
            Stop::check_current()?;
            let (from, to) = (&sections[number], &sections[(number + 1) % count]);
            let mut is_short = false;
            for (from, to) in from.iter().zip(to) {
                let is_back = |corner: usize| (to[corner] - from[corner]).dot(frame.along) <= 0.0;
                for corner in 0..from.len() {
                    let next = (corner + 1) % from.len();
                    is_short |= is_back(corner);
                    let [a, b, c, d] = [from[next], from[corner], to[corner], to[next]];
                    let is_flat = (b - a).cross(c - a).dot(d - a).abs() <= 1e-9 * (c - a).length().powi(3);
                    // The outline of a side between corners that go back crosses itself.
                    if is_flat && !is_back(corner) && !is_back(next) {
                        builder.face([[a, b, c, d].as_slice()], &side);
                    } else {
                        builder.face([[a, b, c].as_slice()], &side);
                        builder.face([[a, c, d].as_slice()], &side);
                    }
                }
            }
            if is_short {
                crossing.push(number);
            }
        }
        if !path.closed {
            let last: Vec<Vec<DVec3>> =
                sections[count - 1].iter().map(|ring| ring.iter().rev().copied().collect()).collect();
            builder.face(last.iter().map(Vec::as_slice), &end);
        }
        Ok((Self::of_mesh(builder.build(), DMat3::IDENTITY), crossing))
    }

    /// Returns the rings of a horizontal face around the world's origin, the outer one counter-clockwise.
    fn profile(&self) -> Result<Vec<Vec<DVec2>>> {
        let (_, frame) = self.single_face("sweep")?;
        if frame.axes.z_axis.z.abs() < 1.0 - 1e-6 {
            return Err(Error::argument("the profile of a sweep is not horizontal").help(
                "draw it around the origin: disk(0.1), or shape({ { 0, 0 }, { 0.2, 0 }, { 0, 0.1 } })",
            ));
        }
        let mesh = self.mesh();
        let upright = Scope::default();
        let face = &mesh.faces[0];
        let mut rings = mesh.flat_rings(face, upright.axes, upright.origin).0;
        if frame.axes.z_axis.z < 0.0 {
            rings.iter_mut().for_each(|ring| ring.reverse());
        }
        Ok(rings)
    }
}

/// Returns the different points of a path.
fn path_points(path: &SweepPath) -> Result<Vec<DVec3>> {
    if let Some(number) = path.points.iter().position(|at| !at.is_finite() || at.abs().max_element() > 1e9) {
        return Err(Error::argument(format!("point {} of the path is not finite", number + 1))
            .help("use numbers below 1e9"));
    }
    if !(path.scale > 0.0 && path.scale <= 1e3 && path.twist.is_finite()) {
        return Err(Error::argument(format!("the scale at the end of the path is {}", path.scale))
            .help("use a scale above 0 and at most 1000"));
    }
    if path.closed && (path.scale != 1.0) {
        return Err(
            Error::argument("a closed path has no end that could have another scale").help("leave out scale")
        );
    }
    if path.closed && (path.twist / std::f64::consts::TAU).fract().abs() > 1e-9 {
        return Err(Error::argument("a closed path begins and ends with the same section")
            .help("use a twist of 0, 360 or -360 degrees and so on"));
    }
    let mut points = path.points.clone();
    points.dedup_by(|b, a| a.distance(*b) <= SAME_POINT);
    while path.closed && points.len() > 1 && points[0].distance(points[points.len() - 1]) <= SAME_POINT {
        points.pop();
    }
    let least = if path.closed { 3 } else { 2 };
    if points.len() < least {
        return Err(Error::argument(format!("the path of a sweep has {} different points", points.len()))
            .help(format!("give at least {least}")));
    }
    Ok(points)
}

/// Returns the frame of each segment, and the angle (radians) that a closed path leaves at its end.
fn frames(points: &[DVec3], closed: bool) -> Result<(Vec<SegmentFrame>, f64)> {
    let count = if closed { points.len() } else { points.len() - 1 };
    let along = |segment: usize| (points[(segment + 1) % points.len()] - points[segment]).normalize_or_zero();
    let first = along(0);
    let up = if first.z.abs() > 0.999 { DVec3::Y } else { DVec3::Z };
    let mut frame = SegmentFrame { along: first, up: (up - first * up.dot(first)).normalize_or_zero() };
    let mut frames = Vec::with_capacity(count);
    for segment in 0..count {
        frames.push(frame);
        let last = segment + 1 == count;
        if last && !closed {
            break;
        }
        let next = along((segment + 1) % count);
        let sum = frame.along + next;
        if sum.length() < 2.0 * SHARPEST {
            let number = (segment + 1) % points.len() + 1;
            return Err(Error::geometry(format!("the path of a sweep turns back at point {number}"))
                .help("add points around the turn, or divide the path"));
        }
        // The mirror image in the bisecting plane, then against the direction: the shortest rotation.
        let up = frame.up - sum * (2.0 * sum.dot(frame.up) / (2.0 * sum.dot(frame.along)));
        frame = SegmentFrame { along: next, up: (up - next * up.dot(next)).normalize_or_zero() };
    }
    // Counter-clockwise from the transported direction to the first one, seen against the path.
    let rest = if closed {
        let back = -first;
        frame.up.cross(frames[0].up).dot(back).atan2(frame.up.dot(frames[0].up))
    } else {
        0.0
    };
    Ok((frames, rest))
}

/// Returns the distance (m) of each point along the path, and the length of the whole path.
fn distances(points: &[DVec3], closed: bool) -> Vec<f64> {
    let mut sum = 0.0;
    let mut distances = vec![0.0];
    for ends in points.windows(2) {
        sum += ends[0].distance(ends[1]);
        distances.push(sum);
    }
    if closed {
        distances.push(sum + points[points.len() - 1].distance(points[0]));
    }
    distances
}

#[cfg(test)]
mod tests {
    use super::*;

    fn path(points: &[(f64, f64, f64)]) -> SweepPath {
        SweepPath { points: points.iter().map(|at| DVec3::from(*at)).collect(), ..SweepPath::default() }
    }

    /// Returns a square of 0.2 m around the origin, with or without a hole of 0.1 m.
    fn square(hole: bool) -> Shape {
        let ring = |half: f64| {
            [(-half, -half), (half, -half), (half, half), (-half, half)].map(DVec2::from).to_vec()
        };
        let mut rings = vec![ring(0.1)];
        if hole {
            rings.push(ring(0.05));
        }
        Shape::plan(&rings, 0.0).expect("a face")
    }

    #[test]
    fn a_profile_along_a_straight_path_is_a_prism() {
        for hole in [false, true] {
            let (bar, crossing) =
                square(hole).sweep(&path(&[(1.0, 0.0, 0.0), (1.0, 5.0, 0.0)])).expect("a bar");
            assert!(crossing.is_empty() && bar.is_closed());
            assert!((bar.volume() - 5.0 * square(hole).area()).abs() < 1e-9, "{}", bar.volume());
            let [low, high] = bar.bounds();
            assert!(
                (low - DVec3::new(0.9, 0.0, -0.1)).length() + (high - DVec3::new(1.1, 5.0, 0.1)).length()
                    < 1e-9
            );
        }
    }

    #[test]
    fn the_x_axis_of_the_profile_is_to_the_right_of_the_path() {
        let profile = Shape::plan(&[[(0.0, 0.0), (0.3, 0.0), (0.0, 0.1)].map(DVec2::from).to_vec()], 0.0)
            .expect("a face");
        let (bar, _) = profile.sweep(&path(&[(0.0, 0.0, 0.0), (0.0, 4.0, 0.0)])).expect("a bar");
        assert!(bar.volume() > 0.0);
        let [low, high] = bar.bounds();
        assert!(
            (low - DVec3::ZERO).length() < 1e-9 && (high - DVec3::new(0.3, 4.0, 0.1)).length() < 1e-9,
            "{low} {high}"
        );
    }

    #[test]
    fn a_frame_around_a_rectangle_has_the_volume_of_its_mitred_bars() {
        let corners = [(0.0, 0.0, 0.0), (4.0, 0.0, 0.0), (4.0, 3.0, 0.0), (0.0, 3.0, 0.0)];
        let (frame, crossing) =
            square(false).sweep(&SweepPath { closed: true, ..path(&corners) }).expect("a frame");
        assert!(frame.is_closed() && crossing.is_empty() && frame.body.faces() == 16);
        assert!((frame.volume() - (4.2 * 3.2 - 3.8 * 2.8) * 0.2).abs() < 1e-9, "{}", frame.volume());
    }

    #[test]
    fn a_path_in_space_gives_a_closed_solid_without_gaps_at_its_end() {
        let knot: Vec<DVec3> = (0..240)
            .map(|number| {
                let t = std::f64::consts::TAU * f64::from(number) / 240.0;
                DVec3::new(t.sin() + 2.0 * (2.0 * t).sin(), t.cos() - 2.0 * (2.0 * t).cos(), -(3.0 * t).sin())
                    * 3.0
            })
            .collect();
        let knot = SweepPath { points: knot, closed: true, ..SweepPath::default() };
        let (solid, crossing) = square(false).sweep(&knot).expect("a knot");
        assert!(solid.is_closed() && crossing.is_empty());
        let length = distances(&knot.points, true)[240];
        assert!((solid.volume() / (length * 0.04) - 1.0).abs() < 0.01, "{} {length}", solid.volume());
        // The profile turns by less than a right angle from one section to the next: no face is twisted by its seam.
        let mesh = solid.mesh();
        let edges = mesh.faces.iter().flat_map(|face| face.edges());
        let longest = edges.map(|[from, to]| mesh.at(from).distance(mesh.at(to)));
        assert!(longest.fold(0.0, f64::max) < 0.6);
    }

    #[test]
    fn a_twisted_and_tapered_sweep_is_closed() {
        let points: Vec<(f64, f64, f64)> = (0..=200).map(|step| (0.0, 0.0, 0.02 * f64::from(step))).collect();
        let twisted = SweepPath { twist: 1.5, scale: 0.5, ..path(&points) };
        let (column, crossing) = square(false).sweep(&twisted).expect("a column");
        assert!(column.is_closed() && crossing.is_empty());
        // A frustum: the mean of the squares of the scale.
        assert!(
            (column.volume() - 0.04 * 4.0 * (1.0 + 0.5 + 0.25) / 3.0).abs() < 0.0005,
            "{}",
            column.volume()
        );
    }

    #[test]
    fn a_sweep_with_turns_tighter_than_the_profile_can_be_drawn_and_names_its_tightest_turn() {
        let arc: Vec<(f64, f64, f64)> = (0..=40)
            .map(|step| std::f64::consts::PI * f64::from(step) / 40.0)
            .map(|angle| (angle.cos() / 20.0, angle.sin() / 20.0, 0.0))
            .collect();
        let arc = path(&arc);
        let (solid, crossing) = square(false).sweep(&arc).expect("a bar");
        assert_eq!(crossing.len(), 40);
        let mesh = solid.mesh();
        assert!(solid.is_closed() && mesh.faces.iter().all(|face| mesh.triangles(face).is_ok()));
        let (_, radius) = arc.tightest_turn().expect("a turn");
        assert!((radius - 0.05).abs() < 1e-4, "{radius}");
        assert_eq!(path(&[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (3.0, 0.0, 0.0)]).tightest_turn(), None);
    }

    #[test]
    fn segments_that_are_too_short_for_their_joints_are_reported() {
        let sharp = path(&[(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (3.0, 0.1, 0.0), (0.0, 0.1, 0.0)]);
        let (_, crossing) = square(false).sweep(&sharp).expect("a bar");
        assert_eq!(crossing, [1]);
        assert!(square(false).sweep(&path(&[(0.0, 0.0, 0.0), (3.0, 0.0, 0.0), (0.0, 0.0, 0.0)])).is_err());
        assert!(square(false).sweep(&path(&[(0.0, 0.0, 0.0), (0.0, 0.0, 0.0)])).is_err());
        let upright = square(false).rotate(DVec3::ZERO, DVec3::X, 1.0);
        assert!(upright.sweep(&path(&[(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)])).is_err());
    }
}
