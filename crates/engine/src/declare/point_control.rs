//! Parameters whose values are drawn: functions, curves and surfaces with control points.

use burgeon_base::error::{Error, Result};
use burgeon_kit::{ControlPoints, HasControlPoints, PointRows, PointSpace, Value};

/// Maximum number of control points of a drawn value.
const MOST_POINTS: usize = 1000;

/// Control of a parameter that is a function, a curve or a surface.
#[derive(Debug, Clone, PartialEq)]
pub struct PointControl {
    /// Value of the script, which drawn values are like.
    like: Value,
    /// Control points of that value, and their meaning.
    form: ControlPoints,
}

/// Error about control points.
pub(crate) struct PointProblem {
    /// Index of the point, if the error is about one.
    pub point: Option<usize>,
    /// Error without a location.
    pub error: Error,
}

impl PointControl {
    /// Creates the control of values like `like`; `None` if users cannot draw such values.
    pub(crate) fn new(like: &Value) -> Option<Self> {
        let form = drawable(like)?.control_points()?;
        Some(Self { like: like.clone(), form })
    }

    /// Returns the script's control points, and their meaning.
    pub fn form(&self) -> &ControlPoints {
        &self.form
    }

    /// Returns the value of these points. Fails if they do not define one.
    pub fn value(&self, points: &PointRows) -> Result<Value> {
        self.check(points).map_err(|problem| problem.error)
    }

    /// Returns the value of these points as cubic Bezier pieces, for display. Fails as [`value`](Self::value) does.
    pub fn pieces(&self, points: &PointRows) -> Result<Vec<[[f64; 3]; 4]>> {
        let value = self.value(points)?;
        Ok(drawable(&value).map(HasControlPoints::bezier_pieces).unwrap_or_default())
    }

    /// Returns the value of these points, or the error with the index of its point.
    pub(crate) fn check(&self, points: &PointRows) -> std::result::Result<Value, PointProblem> {
        if *points == self.form.points {
            return Ok(self.like.clone());
        }
        let refuse = |point: Option<usize>, message: String, help: &str| {
            Err(PointProblem { point, error: Error::argument(message).help(help) })
        };
        let count = points.0.len();
        if count > MOST_POINTS {
            let message = format!("{count} points are too many to draw");
            return refuse(None, message, &format!("give at most {MOST_POINTS} points"));
        }
        let axes = self.form.space.axes();
        for (index, row) in points.0.iter().enumerate() {
            let number = index + 1;
            if row.len() != axes.len() {
                let numbers = if row.len() == 1 { "number" } else { "numbers" };
                let message = format!("point {number} has {} {numbers}, not {}", row.len(), axes.len());
                return refuse(Some(index), message, &format!("write [{}]", axes.join(", ")));
            }
            if row.iter().any(|number| !number.is_finite()) {
                let message = format!("point {number} is not finite");
                return refuse(Some(index), message, "give finite numbers");
            }
            let before = index.checked_sub(1).map(|before| points.0[before][0]);
            if self.form.space == PointSpace::Function
                && let Some(before) = before.filter(|before| row[0] <= *before)
            {
                let message = format!(
                    "the x of point {number} is {}, which is not above {before}, the x before",
                    row[0]
                );
                let help = "a function has one y for each x: order the points by x, and remove repeated x";
                return refuse(Some(index), message, help);
            }
        }
        let made = drawable(&self.like).map(|like| like.with_control_points(points));
        match made {
            Some(Ok(object)) => Ok(Value::Object(object)),
            Some(Err(error)) => Err(PointProblem { point: None, error }),
            None => Ok(self.like.clone()),
        }
    }
}

/// Returns the value as one with control points, if it has that capability.
fn drawable(value: &Value) -> Option<&dyn HasControlPoints> {
    match value {
        Value::Object(object) => object.capability::<dyn HasControlPoints>(),
        _ => None,
    }
}
