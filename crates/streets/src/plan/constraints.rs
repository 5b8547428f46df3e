//! Constraints on the streets of a network, and outcomes of proposed streets.

use std::fmt;

use burgeon_base::error::{Error, Result};

/// Constraints on all streets of a network.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraints {
    /// Snap distance (m): a street that ends closer to a junction or another street joins it.
    pub snap: f64,
    /// Minimum angle (degrees) between streets at a junction, to within [0.06 degrees](Self::least_angle).
    pub min_angle: f64,
    /// Minimum length (m) of a street between two junctions.
    pub min_length: f64,
    /// Minimum distance (m) between the edges of streets that do not meet.
    pub clearance: f64,
    /// Radius (m) of kerbs at corners.
    pub corner: f64,
    /// Maximum turn (degrees) to avoid an obstacle.
    pub bend: f64,
    /// Maximum length (m) of a bridge over an obstacle.
    pub bridge: f64,
    /// Set if streets may end before an obstacle.
    pub shorten: bool,
    /// Set if dead ends without a turning circle have square ends instead of round ones.
    pub square_ends: bool,
    /// Maximum number of street segments.
    pub max_segments: usize,
}

impl Default for Constraints {
    fn default() -> Self {
        Self {
            snap: 25.0,
            min_angle: 45.0,
            min_length: 12.0,
            clearance: 6.0,
            corner: 4.0,
            bend: 40.0,
            bridge: 0.0,
            shorten: true,
            square_ends: false,
            max_segments: 1_000_000,
        }
    }
}

/// Tolerance (degrees) below the minimum angle: positions are rounded to the grid, and a street turns slightly when it
/// is divided.
const ANGLE_TOLERANCE: f64 = 0.06;

impl Constraints {
    /// Returns the angle (degrees) below which no two streets meet: `min_angle` minus the rounding tolerance.
    ///
    /// A street proposed at exactly `min_angle` to another street is built.
    pub fn least_angle(&self) -> f64 {
        self.min_angle - ANGLE_TOLERANCE
    }

    /// Checks that the values are in range and consistent; the error names the field.
    ///
    /// ```
    /// use burgeon_streets::Constraints;
    ///
    /// assert!(Constraints::default().check().is_ok());
    /// let error = Constraints { min_angle: 5.0, ..Constraints::default() }.check().expect_err("too small");
    /// assert!(error.message().starts_with("min_angle"));
    /// ```
    pub fn check(&self) -> Result<()> {
        let Self { snap, min_angle, min_length, clearance, corner, bend, bridge, .. } = *self;
        let named = [
            ("snap", snap, 0.0, 10_000.0),
            ("min_angle", min_angle, 10.0, 90.0),
            ("min_length", min_length, 1.0, 10_000.0),
            ("clearance", clearance, 0.1, 1_000.0),
            ("corner", corner, 0.0, 100.0),
            ("bend", bend, 0.0, 90.0),
            ("bridge", bridge, 0.0, 10_000.0),
        ];
        for (name, value, least, greatest) in named {
            if !(least..=greatest).contains(&value) {
                return Err(Error::argument(format!(
                    "{name} must be from {least} to {greatest}, not {value}"
                )));
            }
        }
        if snap > 0.0 && snap < clearance {
            return Err(Error::argument(format!(
                "snap ({snap} m) is less than clearance ({clearance} m), so a street that ends between the two can neither join nor remain"
            ))
            .help("use a greater snap, or a smaller clearance"));
        }
        Ok(())
    }
}

/// Outcome of a proposed street.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Built as proposed.
    Built,
    /// Ends at an existing junction.
    Snapped,
    /// Ends at a new junction on another street.
    Joined,
    /// Turned to avoid an obstacle.
    Bent,
    /// Ends before an obstacle.
    Shortened,
    /// Refused.
    Refused(Refusal),
}

/// Reason why a street was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// Shorter than the minimum length.
    TooShort,
    /// Angle to another street too small at one of its ends.
    Angle,
    /// Too close to a street or junction that it does not join.
    TooNear,
    /// Corners of a junction longer than the street itself or another street there.
    Corners,
    /// Obstacle in the street's path.
    Obstacle,
    /// Outside the area where streets are allowed.
    Outside,
}

impl Refusal {
    /// All reasons.
    pub const ALL: [Self; 6] =
        [Self::TooShort, Self::Angle, Self::TooNear, Self::Corners, Self::Obstacle, Self::Outside];

    /// Returns the name in scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::TooShort => "too short",
            Self::Angle => "angle",
            Self::TooNear => "too near",
            Self::Corners => "corners",
            Self::Obstacle => "obstacle",
            Self::Outside => "outside",
        }
    }
}

impl Fate {
    /// Returns the name in scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Built => "built",
            Self::Snapped => "snapped",
            Self::Joined => "joined",
            Self::Bent => "bent",
            Self::Shortened => "shortened",
            Self::Refused(_) => "refused",
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
