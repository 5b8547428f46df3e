//! Coordinate systems.

use super::projection::{Projection, find_system, unshifted_datum};
use burgeon_base::error::{Error, Result};

/// Remedy for a coordinate system that cannot be used.
pub const REMEDY: &str =
    "specify the correct one: source(file, { crs = 4326 }), or convert the file to EPSG:4326";

/// Remedy for a datum without a known shift.
const SHIFT_REMEDY: &str =
    "convert the file with a program that has the shift: ogr2ogr -t_srs EPSG:4326 OUT.gpkg IN, or gdalwarp";

/// Coordinate system: from the EPSG registry, or a transverse Mercator projection around a centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Crs {
    /// EPSG code.
    pub code: Option<u16>,
    name: String,
    pub(super) definition: String,
    is_geographic: bool,
    /// Approximate length of one unit (m).
    metres: f64,
}

impl Crs {
    /// Returns the coordinate system with the EPSG code `code`.
    ///
    /// ```
    /// use burgeon_spatial::Crs;
    ///
    /// assert!(Crs::epsg(4326)?.is_geographic() && !Crs::epsg(3067)?.is_geographic());
    /// // A former code of Web Mercator.
    /// assert_eq!(Crs::epsg(900_913)?.name(), "EPSG:3857");
    /// assert_eq!(Crs::epsg(1).map_err(|error| error.kind().code()), Err("not-found"));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn epsg(code: u32) -> Result<Self> {
        // Codes that were in use before EPSG assigned one.
        let code = if matches!(code, 900_913 | 102_100 | 102_113) { 3857 } else { code };
        let (code, definition) = find_system(code)?.ok_or_else(|| {
            let message = format!("unknown coordinate system EPSG:{code}");
            Error::not_found("coordinate system", code, [], message).help(REMEDY)
        })?;
        Ok(Self::of_parts(Some(code), format!("EPSG:{code}"), definition))
    }

    fn of_parts(code: Option<u16>, name: String, definition: String) -> Self {
        let value = |key: &str| definition.split_whitespace().find_map(|part| part.strip_prefix(key));
        let is_geographic = definition.contains("+proj=longlat");
        let factor = value("+to_meter=").and_then(|factor| factor.parse::<f64>().ok());
        let metres = match factor.filter(|factor| *factor > 0.0) {
            _ if is_geographic => 111_320.0,
            Some(factor) => factor,
            None => match value("+units=") {
                Some("us-ft" | "ft") => 0.3048,
                Some("km") => 1000.0,
                _ => 1.0,
            },
        };
        Self { code, name, definition, is_geographic, metres }
    }

    /// Returns a projection without an EPSG code that has a PROJ definition. Fails if the definition is unusable.
    #[cfg(feature = "projections")]
    pub(crate) fn of_definition(name: &str, definition: &str) -> Result<Self> {
        let crs = Self::of_parts(None, name.to_owned(), definition.to_owned());
        crs.projection().map(|_| crs)
    }

    /// Returns a transverse Mercator projection around a centre, given as longitude and latitude (degrees, WGS 84); the
    /// centre is the origin of its coordinates.
    pub fn around([longitude, latitude]: [f64; 2]) -> Self {
        let name = format!("transverse Mercator around {longitude:?}, {latitude:?}");
        let definition = format!(
            "+proj=tmerc +lat_0={latitude:?} +lon_0={longitude:?} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m +no_defs"
        );
        Self::of_parts(None, name, definition)
    }

    /// Returns the name, such as `EPSG:3067`.
    pub fn name(&self) -> String {
        self.name.clone()
    }

    /// Returns true if coordinates are longitude and latitude (degrees).
    pub fn is_geographic(&self) -> bool {
        self.is_geographic
    }

    /// Returns the approximate length of one unit (m).
    pub fn metres(&self) -> f64 {
        self.metres
    }

    /// Returns the factor that converts angles to radians; 1 if coordinates are not angles.
    pub(crate) fn unit(&self) -> f64 {
        if self.is_geographic() { 1f64.to_radians() } else { 1.0 }
    }

    pub(crate) fn projection(&self) -> Result<Projection> {
        let cannot = |why: String| {
            Error::argument(format!("the coordinate system {} cannot be used: {why}", self.name()))
                .help(REMEDY)
        };
        if self.definition.contains("+proj=geocent") {
            return Err(cannot("its origin is the centre of the earth".into()));
        }
        Projection::new(&self.definition, cannot)
    }

    /// Returns the name of its datum if no shift from it to WGS 84 is known.
    pub(crate) fn unshifted_datum(&self) -> Option<String> {
        unshifted_datum(self.code, &self.definition)
    }

    /// Returns the message that positions in longitude and latitude, and in other coordinate systems, are inaccurate, if
    /// no shift from the datum to WGS 84 is known. `shown` is the file with these coordinates.
    pub fn shift_note(&self, shown: &str) -> Option<[String; 2]> {
        let datum = self.unshifted_datum()?;
        let text = format!(
            "{shown} is in {}: no shift from {datum} to WGS 84 is known; positions in longitude and latitude, and in other coordinate systems, may be off by some hundred metres",
            self.name
        );
        Some([text, SHIFT_REMEDY.to_owned()])
    }

    /// Returns true if lengths in its coordinates are true lengths, except for distortions of thousandths in any
    /// projection.
    pub(crate) fn is_true(&self) -> bool {
        !self.is_geographic() && !matches!(self.code, Some(3857 | 3785 | 3395))
    }

    /// Returns the definition with metres as the unit, and with the axes east and north.
    pub(crate) fn in_metres(&self) -> String {
        let kept = self.definition.split_whitespace().filter(|part| {
            !["+units=", "+to_meter=", "+axis="].iter().any(|prefix| part.starts_with(prefix))
        });
        format!("{} +units=m", kept.collect::<Vec<_>>().join(" "))
    }
}
