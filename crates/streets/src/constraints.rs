//! What a network asks of its streets, and what it answers to those that are proposed.

use std::fmt;

use burgeon_base::error::{Error, Result};

/// What every street of a network keeps to.
#[derive(Debug, Clone, PartialEq)]
pub struct Constraints {
    /// How near (m) the end of a street comes to a junction or another street before it joins that.
    pub snap: f64,
    /// The least angle (degrees) between streets at a junction, to within [0.06 degrees](Self::least_angle).
    pub min_angle: f64,
    /// The least length (m) of a street between two junctions.
    pub min_length: f64,
    /// The least distance (m) between the edges of streets that do not meet.
    pub clearance: f64,
    /// The radius (m) of kerbs at corners.
    pub corner: f64,
    /// How far (degrees) a street may turn to pass an obstacle.
    pub bend: f64,
    /// The longest way (m) over an obstacle that a street may bridge.
    pub bridge: f64,
    /// Whether a street may end before an obstacle.
    pub shorten: bool,
    /// Whether dead ends without a circle are cut off square, in place of round.
    pub square_ends: bool,
    /// The most pieces of streets.
    pub most: usize,
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
            most: 1_000_000,
        }
    }
}

/// By how much (degrees) an angle may come out below the least one: places are rounded to the grid, and a street that is
/// divided turns a little.
const ANGLE_TOLERANCE: f64 = 0.06;

impl Constraints {
    /// The angle (degrees) below which no two streets meet: `min_angle` but for what rounding takes.
    ///
    /// A street that is proposed at exactly `min_angle` to another is built.
    pub fn least_angle(&self) -> f64 {
        self.min_angle - ANGLE_TOLERANCE
    }

    /// Fails where they contradict one another, and says how.
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
                "snap ({snap} m) is less than clearance ({clearance} m), so a street that ends between the two \
                 could neither join nor stay"
            ))
            .help("give a greater snap, or a smaller clearance"));
        }
        Ok(())
    }
}

/// What became of a street that was proposed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It lies as it was proposed.
    Built,
    /// It ends at a junction that was there.
    Snapped,
    /// It ends on another street, which has a junction there now.
    Joined,
    /// It turned to pass an obstacle.
    Bent,
    /// It ends before an obstacle.
    Shortened,
    /// It was refused.
    Refused(Refusal),
}

/// Why a street was refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Refusal {
    /// It has no length, or less than the least.
    TooShort,
    /// It makes too small an angle with another at one of its ends.
    Angle,
    /// It runs too near a street or a junction that it does not join.
    TooNear,
    /// The corners of a junction would take more than its length, or that of a street there.
    Corners,
    /// An obstacle is in its way.
    Obstacle,
    /// It leads out of the ground that may be built on.
    Outside,
}

impl Refusal {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::TooShort, Self::Angle, Self::TooNear, Self::Corners, Self::Obstacle, Self::Outside];

    /// Its name in scripts.
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
    /// Its name in scripts.
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
