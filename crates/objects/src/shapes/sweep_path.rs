//! Paths of sweeps as scripts write them.

use std::sync::Arc;

use burgeon_base::error::{Error, Result};
use burgeon_base::text::listed;
use burgeon_geometry::{Curve, CurveKind};
use burgeon_kit::{Expectation, Parameter, Value, Vector, fields};
use burgeon_shapes::{ShapeBody, SweepPath};
use glam::DVec3;

use super::object::{ShapeObject, warn};
use crate::CurveObject;

/// Maximum number of segments of a piece of a curve.
const MOST_SEGMENTS: f64 = 256.0;
/// Maximum twist (degrees) between neighbouring points without a warning.
const MOST_TWIST: f64 = 90.0;

/// Path of a sweep: a list of positions (m), a curve, or an edge.
#[derive(Clone)]
pub enum SweepPoints {
    /// Positions (m).
    List(Vec<DVec3>),
    /// Curve.
    Curve(Arc<Curve>),
}

impl Parameter for SweepPoints {
    fn luau() -> String {
        "{ Vector } | Curve | Shape".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        if let Ok(curve) = Arc::<CurveObject>::read_value(&value) {
            return Ok(Self::Curve(Arc::clone(curve.curve())));
        }
        let what = "a list of positions, such as { vec(0, 0, 1), vec(4, 0, 1) }, a curve or an edge";
        if let Ok(shape) = Arc::<ShapeObject>::read_value(&value) {
            let scope = &shape.shape().scope();
            return match &shape.shape().body {
                ShapeBody::Edge(..) => Ok(Self::List(vec![scope.origin, scope.point(scope.size)])),
                _ => Err(Expectation::new(what)),
            };
        }
        let points = Vec::<Vector>::read_value(&value).map_err(|_| Expectation::new(what))?;
        Ok(Self::List(points.into_iter().map(|point| point.0).collect()))
    }

    fn into_value(self) -> Value {
        Value::Nil
    }
}

/// Options of `shape:sweep`.
#[fields("shape:sweep")]
pub struct SweepPathOptions {
    /// Joints of a list of positions: "mitre", straight segments that meet in planes, or "smooth", a curve through the
    /// positions.
    #[default("mitre".into())]
    pub joint: String,
    /// The end is joined to the start.
    pub closed: bool,
    /// Rotation of the profile from the start to the end (degrees), counter-clockwise seen against the path.
    #[default(0.0)]
    pub twist: f64,
    /// Factor of the size of the profile at the end.
    #[default(1.0)]
    pub scale: f64,
    /// Maximum angle between neighbouring segments of a curve (degrees).
    #[default(10.0)]
    pub step: f64,
}

impl ShapeObject {
    /// Sweeps a profile along a path.
    pub(super) fn sweep_along(&self, points: SweepPoints, options: &SweepPathOptions) -> Result<Self> {
        let about = |error: Error| error.about("shape:sweep");
        if !(0.1..=90.0).contains(&options.step) {
            return Err(Error::argument(format!("shape:sweep: step is {} degrees", options.step))
                .help("use an angle from 0.1 to 90 degrees"));
        }
        let curve = match (points, options.joint.as_str()) {
            (SweepPoints::Curve(curve), _) => Ok(curve),
            (SweepPoints::List(points), "mitre") => Err(points),
            (SweepPoints::List(points), "smooth") => {
                Ok(Arc::new(Curve::new(&points, CurveKind::Through, options.closed).map_err(about)?))
            }
            (_, other) => {
                return Err(Error::argument(format!("shape:sweep: unknown joint {other:?}"))
                    .help("use \"mitre\" or \"smooth\""));
            }
        };
        let closed = options.closed || curve.as_ref().is_ok_and(|curve| curve.is_closed());
        let points = match curve {
            Ok(curve) => curve_points(&curve, options.step.to_radians()),
            Err(points) => points,
        };
        let path = SweepPath { points, closed, twist: options.twist.to_radians(), scale: options.scale };
        let (solid, crossing) = self.shape.sweep(&path).map_err(about)?;
        if !crossing.is_empty() {
            let numbers: Vec<String> =
                crossing.iter().take(5).map(|number| format!("{}", number + 1)).collect();
            let (count, what) = (crossing.len(), listed(numbers.iter().map(String::as_str)));
            let which = match count {
                1 => format!("segment {what} of the path is"),
                _ if count > numbers.len() => format!("{count} segments of the path, first {what}, are"),
                _ => format!("segments {what} of the path are"),
            };
            warn(
                "sweep",
                &format!(
                    "{which} too short for {}, so the solid crosses itself{}",
                    if count == 1 { "its joints" } else { "their joints" },
                    tightest(&path)
                ),
                "use a narrower profile, or a path that turns less sharply",
            );
        }
        #[allow(clippy::cast_precision_loss, reason = "a path has fewer than 2^52 points")]
        let turn = options.twist.abs() / (path.points.len().max(2) - 1) as f64;
        if turn > MOST_TWIST {
            let text = format!(
                "the profile twists by about {turn:.0} degrees from one point of the path to the next"
            );
            warn(
                "sweep",
                &text,
                "add points to the path, so that it twists by at most 90 degrees between them",
            );
        }
        Ok(self.with_shape(solid))
    }
}

/// Returns the end of a sentence that names the tightest turn of a path.
fn tightest(path: &SweepPath) -> String {
    path.tightest_turn().map_or_else(String::new, |(at, radius)| {
        let digits = if radius < 1.0 { 3 } else { 2 };
        format!("; its tightest turn, at point {}, has a radius of {radius:.digits$} m", at + 1)
    })
}

/// Returns points (m) of a curve so that its direction turns by at most about `step` (radians) from one segment to the next.
#[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 1 to 256")]
fn curve_points(curve: &Curve, step: f64) -> Vec<DVec3> {
    let mut points = Vec::new();
    for &[from, one, two, to] in curve.pieces() {
        let sides = [one - from, two - one, to - two];
        let sides: Vec<DVec3> = sides.into_iter().filter(|side| side.length_squared() > 0.0).collect();
        let turn: f64 = sides.windows(2).map(|pair| pair[0].angle_between(pair[1])).sum();
        let count = (1.5 * turn / step).ceil().clamp(1.0, MOST_SEGMENTS) as u32;
        if points.is_empty() {
            points.push(from);
        }
        points.extend((1..=count).map(|number| {
            let t = f64::from(number) / f64::from(count);
            let (a, b, c) = (from.lerp(one, t), one.lerp(two, t), two.lerp(to, t));
            a.lerp(b, t).lerp(b.lerp(c, t), t)
        }));
    }
    points
}
