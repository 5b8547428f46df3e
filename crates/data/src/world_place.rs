//! Position of a model on Earth, for files and summaries.

use std::fmt;

use serde_json::{Value, json};

use super::{Crs, ReferenceFrame};

/// Axes of a run's coordinates.
pub const WORLD_AXES: &str = "x east, y north, z up (m)";

/// Georeference of a run's coordinates: the origin in a coordinate system.
#[derive(Debug, Clone, PartialEq)]
pub struct WorldPlace {
    /// Coordinate system: `EPSG:3067`, or a PROJ definition of a system without an EPSG code.
    pub crs: String,
    /// East and north (m) of the origin in the coordinate system.
    pub origin: [f64; 2],
    /// Longitude and latitude (degrees) of the origin; `None` if they cannot be computed.
    pub degrees: Option<[f64; 2]>,
}

impl ReferenceFrame {
    /// Returns the position of the origin.
    ///
    /// ```
    /// use burgeon_data::{Crs, ReferenceFrame};
    ///
    /// let place = ReferenceFrame::around(&Crs::epsg(3067)?, [385_423.0, 6_671_463.0], "a town")?.world_place();
    /// assert_eq!((&*place.crs, place.origin), ("EPSG:3067", [385_400.0, 6_671_500.0]));
    /// assert_eq!(place.to_string(), "385400, 6671500 in EPSG:3067 (longitude 24.9349427, latitude 60.1642919)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn world_place(&self) -> WorldPlace {
        let crs = match self.epsg {
            Some(code) => format!("EPSG:{code}"),
            None => self.definition().to_owned(),
        };
        let degrees = || -> Option<[f64; 2]> {
            let degrees = Crs::epsg(4326).ok()?;
            let place = self.passage(&degrees).ok()?.leave([0.0; 2]);
            // A ten-millionth of a degree is about a centimetre.
            let rounded = place.map(|angle| (angle * 1e7).round() / 1e7);
            rounded.iter().all(|angle| angle.is_finite()).then_some(rounded)
        };
        WorldPlace { crs, origin: self.origin, degrees: degrees() }
    }
}

impl WorldPlace {
    /// Returns the position as JSON: `crs`, `origin`, `longitude`, `latitude`.
    pub fn to_json(&self) -> Value {
        let mut place = json!({ "crs": self.crs, "origin": self.origin });
        if let Some([longitude, latitude]) = self.degrees {
            place["longitude"] = longitude.into();
            place["latitude"] = latitude.into();
        }
        place
    }
}

impl fmt::Display for WorldPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [east, north] = self.origin;
        write!(f, "{east}, {north} in {}", self.crs)?;
        match self.degrees {
            Some([longitude, latitude]) => write!(f, " (longitude {longitude}, latitude {latitude})"),
            None => Ok(()),
        }
    }
}
