//! Position of a model on Earth, for files and summaries.

use std::fmt;

use serde_json::{Value, json};

use super::frame::ReferenceFrame;
use super::prj::IN_METRES;
use super::projection::definition;
use super::system::Crs;

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
    /// use burgeon_spatial::{Crs, ReferenceFrame};
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

    /// Returns the projection in well-known text, in metres, as `.prj` files have it; `None` if it has no such text.
    ///
    /// A projection whose unit was changed to metres is called `... in metres`, and has its PROJ definition as well.
    pub fn well_known_text(&self) -> Option<String> {
        if let (None, Some([longitude, latitude])) = (self.epsg, self.middle) {
            let name = &self.name;
            return Some(format!(
                "PROJCS[\"{name}\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],\
                 PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],PROJECTION[\"Transverse_Mercator\"],\
                 PARAMETER[\"latitude_of_origin\",{latitude}],PARAMETER[\"central_meridian\",{longitude}],\
                 PARAMETER[\"scale_factor\",1],PARAMETER[\"false_easting\",0],PARAMETER[\"false_northing\",0],\
                 UNIT[\"metre\",1]]"
            ));
        }
        let code = self.epsg.or_else(|| self.name.strip_prefix("EPSG:")?.parse().ok())?;
        let text = definition(code).ok().flatten()?;
        if self.epsg.is_some() { Some(text) } else { in_metres(&text, self.definition()) }
    }
}

/// Returns the well-known text of a projection with metres as its unit, and with its PROJ definition.
fn in_metres(text: &str, proj: &str) -> Option<String> {
    let (name, rest) = text.strip_prefix("PROJCS[\"")?.split_once('"')?;
    // The unit of the projection follows that of the angles.
    let (rest, unit) = rest.rsplit_once(",UNIT[")?;
    let factor: f64 = unit.split([',', ']']).nth(1)?.trim().parse().ok()?;
    let mut parts: Vec<String> = rest.split("PARAMETER[").map(str::to_owned).collect();
    for part in &mut parts {
        let false_origin = ["\"false_easting\",", "\"false_northing\","];
        let Some(key) = false_origin.into_iter().find(|key| part.starts_with(key)) else { continue };
        let (number, rest) = part[key.len()..].split_once(']')?;
        *part = format!("{key}{}]{rest}", number.trim().parse::<f64>().ok()? * factor);
    }
    let rest = parts.join("PARAMETER[");
    Some(format!("PROJCS[\"{name}{IN_METRES}\"{rest},UNIT[\"metre\",1],EXTENSION[\"PROJ4\",\"{proj}\"]]"))
}

impl WorldPlace {
    /// Returns the position as JSON: `crs`, `origin`, `longitude`, `latitude`.
    ///
    /// ```
    /// use burgeon_spatial::{Crs, ReferenceFrame};
    ///
    /// let frame = ReferenceFrame::around(&Crs::epsg(3067)?, [385_420.0, 6_671_480.0], "the town")?;
    /// let place = frame.world_place().to_json();
    /// assert_eq!((&place["crs"], &place["origin"][0]), (&"EPSG:3067".into(), &385_400.0.into()));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
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
