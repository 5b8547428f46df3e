//! Options for lots.

use burgeon_base::error::{Error, Result};

/// Method of dividing a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum LotPattern {
    /// Repeated cuts across the smallest bounding box.
    #[default]
    Boxes,
    /// Strips of lots along the streets, around a court.
    Strips,
    /// Strips of lots along the streets that meet at the back.
    Skeleton,
}

impl LotPattern {
    /// All patterns with their names in scripts.
    pub const ALL: [(&str, Self); 3] =
        [("boxes", Self::Boxes), ("strips", Self::Strips), ("skeleton", Self::Skeleton)];
}

/// Options for lots.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LotOptions {
    /// Method of dividing a block.
    pub pattern: LotPattern,
    /// Usual width (m) along the street.
    pub width: f64,
    /// Minimum front length (m).
    pub min_width: f64,
    /// Usual depth (m).
    pub depth: f64,
    /// Area (m²) above which a lot is divided.
    pub area: f64,
    /// Minimum area (m²).
    pub min_area: f64,
    /// Maximum ratio of length to width.
    pub elongation: f64,
    /// Variation of sizes, from 0 for none to 1.
    pub jitter: f64,
    /// Fraction of the blocks that are parks.
    pub parks: f64,
}

impl LotOptions {
    /// Creates options for lots that are usually `width` (m) by `depth` (m).
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

    /// Checks that the values are in range and consistent; the error names the field.
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
            return Err(Error::argument(text).help("use a greater area, or a smaller min_area"));
        }
        if self.min_width > self.width {
            let text = format!("min_width ({} m) is more than width ({} m)", self.min_width, self.width);
            return Err(Error::argument(text).help("use a greater width, or a smaller min_width"));
        }
        Ok(())
    }
}
