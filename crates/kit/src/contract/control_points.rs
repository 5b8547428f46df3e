//! Values that users draw by their control points, such as functions, curves and surfaces.

use std::fmt;
use std::sync::Arc;

use crate::Object;
use burgeon_base::error::Result;

/// Capability of values that control points define, so that users can draw them.
pub trait HasControlPoints {
    /// Returns the control points and their meaning; `None` if the value has none of its own, as a function between two
    /// others.
    fn control_points(&self) -> Option<ControlPoints>;

    /// Creates the value that differs from this one only by its control points. Fails if they do not define one.
    fn with_control_points(&self, points: &PointRows) -> Result<Arc<dyn Object>>;

    /// Returns the value as cubic Bezier pieces, for display: four points each. A function has x and y, and z is 0; a
    /// surface is lines of constant u and v.
    fn bezier_pieces(&self) -> Vec<[[f64; 3]; 4]>;
}

/// Control points of a value, and their relation to it.
#[derive(Debug, Clone, PartialEq)]
pub struct ControlPoints {
    /// Points that define the value.
    pub points: PointRows,
    /// Meaning of the coordinates.
    pub space: PointSpace,
    /// Name of the relation, such as "linear", as scripts write it.
    pub kind: &'static str,
    /// Set if the last point is joined to the first.
    pub closed: bool,
    /// Number of points in a row of a surface, whose points are given row after row; their number cannot change.
    pub columns: Option<usize>,
}

/// Meaning of the coordinates of control points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointSpace {
    /// Points of a function of one variable, `x, y`, with increasing x.
    Function,
    /// Positions in the plane z = 0, `x, y` (m).
    Plane,
    /// Positions in space, `x, y, z` (m).
    Space,
}

impl PointSpace {
    /// Returns the names of the coordinates.
    pub fn axes(self) -> &'static [&'static str] {
        match self {
            Self::Function | Self::Plane => &["x", "y"],
            Self::Space => &["x", "y", "z"],
        }
    }

    /// Returns the name for programs: `function`, `plane` or `space`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Function => "function",
            Self::Plane => "plane",
            Self::Space => "space",
        }
    }
}

/// Control points as plain lists of coordinates, as files and pages contain them.
///
/// ```
/// use burgeon_kit::PointRows;
///
/// let points = PointRows(vec![vec![0.0, 1.0], vec![1.0, 0.25]]);
/// assert_eq!(points.to_string(), "[[0,1],[1,0.25]]");
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct PointRows(pub Vec<Vec<f64>>);

impl PointRows {
    /// Returns the points as JSON, integers without a decimal point.
    pub fn to_json(&self) -> serde_json::Value {
        let row = |row: &Vec<f64>| row.iter().map(|number| json(*number)).collect::<serde_json::Value>();
        self.0.iter().map(row).collect()
    }
}

impl fmt::Display for PointRows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.to_json())
    }
}

/// Converts a number to JSON; numbers that are not finite are null.
fn json(number: f64) -> serde_json::Value {
    #[allow(clippy::cast_possible_truncation, reason = "whole and small enough to be exact")]
    if number.fract() == 0.0 && number.abs() < 9e15 { (number as i64).into() } else { number.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_of_points_gives_the_same_points() {
        let rows = vec![vec![0.1, -3.0, 1e20], vec![1.0 / 3.0, 9e15, -2.5e-9], vec![]];
        let text = PointRows(rows.clone()).to_string();
        assert_eq!(text, "[[0.1,-3,1e+20],[0.3333333333333333,9000000000000000.0,-2.5e-9],[]]");
        assert_eq!(serde_json::from_str::<Vec<Vec<f64>>>(&text).unwrap(), rows);
    }
}
