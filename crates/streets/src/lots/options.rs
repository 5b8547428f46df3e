//! What lots are to be like.

use burgeon_base::error::{Error, Result};

/// How a block is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LotPattern {
    /// By cuts across the smallest box, again and again.
    #[default]
    Boxes,
    /// By strips of lots along the streets, around a court.
    Strips,
    /// By strips of lots along the streets, which meet behind.
    Skeleton,
}

impl LotPattern {
    /// All of them with their names in scripts.
    pub const ALL: [(&str, Self); 3] =
        [("boxes", Self::Boxes), ("strips", Self::Strips), ("skeleton", Self::Skeleton)];
}

/// What lots are to be like.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LotOptions {
    /// How a block is divided.
    pub pattern: LotPattern,
    /// How wide (m) lots usually are along the street.
    pub width: f64,
    /// The least front (m).
    pub min_width: f64,
    /// How deep (m) they usually are.
    pub depth: f64,
    /// The area (m²) above which a lot is divided.
    pub area: f64,
    /// The least area (m²).
    pub min_area: f64,
    /// How many times a lot may be as long as wide.
    pub elongation: f64,
    /// How much sizes vary: 0 for not at all, up to 1.
    pub jitter: f64,
    /// The share of the blocks that are parks.
    pub parks: f64,
}

impl LotOptions {
    /// Lots that are usually `width` (m) by `depth` (m).
    pub fn new(width: f64, depth: f64) -> Self {
        Self {
            pattern: LotPattern::Boxes,
            width,
            min_width: width * 0.5,
            depth,
            area: width * depth * 1.4,
            min_area: width * depth * 0.3,
            elongation: 4.0,
            jitter: 0.3,
            parks: 0.0,
        }
    }

    /// Fails if no lot could be like that, and says why.
    pub fn check(&self) -> Result<()> {
        let ranges = [
            ("width", self.width, 1.0, 500.0, "m"),
            ("min_width", self.min_width, 0.5, 500.0, "m"),
            ("depth", self.depth, 1.0, 1000.0, "m"),
            ("area", self.area, 1.0, 1e6, "m²"),
            ("min_area", self.min_area, 0.0, 1e6, "m²"),
            ("elongation", self.elongation, 1.5, 100.0, "times"),
            ("jitter", self.jitter, 0.0, 1.0, ""),
            ("parks", self.parks, 0.0, 1.0, ""),
        ];
        for (name, value, low, high, unit) in ranges {
            if !(low..=high).contains(&value) {
                let unit = if unit.is_empty() { String::new() } else { format!(" {unit}") };
                return Err(Error::argument(format!(
                    "{name} must be from {low} to {high}{unit}, not {value}"
                )));
            }
        }
        if self.min_area * 2.0 > self.area {
            let text = format!(
                "area ({} m²) is less than twice min_area ({} m²), so a lot above it could not be divided",
                self.area, self.min_area
            );
            return Err(Error::argument(text).help("give a greater area, or a smaller min_area"));
        }
        if self.min_width > self.width {
            let text = format!("min_width ({} m) is more than width ({} m)", self.min_width, self.width);
            return Err(Error::argument(text).help("give a greater width, or a smaller min_width"));
        }
        Ok(())
    }
}
