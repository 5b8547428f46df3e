//! Interpretation of GeoTIFF samples: scale, offset, unit, and the marker of missing values.

use tiff::tags::Tag;

use super::keys::GeoKeys;
use super::parts::Tiff;
use crate::heights::marks::is_negative_mark;
use crate::heights::narrow;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::crs::unit_of_system;
use burgeon_spatial::height_files::tiff_key as keys;

/// GDAL metadata of a file and its bands, as XML.
const METADATA: Tag = Tag::Unknown(42112);

/// Conversion of samples to heights.
pub(super) struct Meaning {
    missing: Option<f64>,
    /// Factor of the samples, and offset added to the result (m).
    scale: f64,
    offset: f64,
    /// Set if the file declares the unit of its heights.
    pub(super) has_unit: bool,
}

impl Meaning {
    /// Reads the conversion from the tags of a file called `name`. Fails if the unit is unknown, or if the scale is
    /// unusable.
    pub(super) fn read(tiff: &mut Tiff<'_>, keys: &GeoKeys, name: &str) -> Result<Self> {
        let missing = tiff.get_tag_ascii_string(Tag::GdalNodata).ok();
        let missing = missing.and_then(|text| text.trim_matches(['\0', ' ']).parse::<f64>().ok());
        let metadata = tiff.get_tag_ascii_string(METADATA).unwrap_or_default();
        let told = |role: &str| item(&metadata, role).and_then(|text| text.parse::<f64>().ok());
        let (scale, offset) = match (told("scale"), told("offset")) {
            (None, None) => vertical(tiff, keys),
            (scale, offset) => (scale.unwrap_or(1.0), offset.unwrap_or(0.0)),
        };
        if !(scale.is_finite() && scale != 0.0 && offset.is_finite()) {
            return Err(Error::data(format!(
                "{name} has heights with the scale {scale} and the offset {offset}"
            ))
            .help("convert them to metres: gdal_translate -unscale IN OUT.tif"));
        }
        let unit = match keys.get(keys::VERTICAL_UNIT).filter(|unit| !matches!(*unit, 0 | keys::OWN)) {
            None => match item(&metadata, "unittype").filter(|unit| !unit.is_empty()) {
                Some(unit) => Some(unit_named(unit, name)?),
                None => keys.get(keys::VERTICAL).map(unit_of_system),
            },
            Some(unit) => Some(unit_coded(unit, name)?),
        };
        let (has_unit, unit) = (unit.is_some(), unit.unwrap_or(1.0));
        Ok(Self { missing, scale: scale * unit, offset: offset * unit, has_unit })
    }

    /// Returns true if heights differ from samples.
    fn is_scaled(&self) -> bool {
        self.scale.to_bits() != 1.0_f64.to_bits() || self.offset != 0.0
    }

    /// Returns the height (m) in strips and tiles that the file leaves out: missing, or that of the sample 0 if the file
    /// declares no marker of missing values.
    pub(super) fn absent_height(&self) -> f32 {
        if self.missing.is_some() { f32::NAN } else { self.height(0.0) }
    }

    /// Returns the height (m) of a sample; NaN if it is declared missing, and the minimum number if it is an undeclared
    /// marker.
    #[inline]
    pub(super) fn height(&self, sample: f64) -> f32 {
        // Files of floats mark missing values with the nearest float.
        if self.missing.is_some_and(|mark| narrow(sample) == narrow(mark)) {
            return f32::NAN;
        }
        if self.is_scaled() && is_negative_mark(sample) {
            return f32::MIN;
        }
        narrow(sample * self.scale + self.offset)
    }
}

/// Returns the scale and the offset of heights from the georeferencing tags, but only if the file declares vertical
/// coordinates, because other files contain arbitrary values there.
fn vertical(tiff: &mut Tiff<'_>, keys: &GeoKeys) -> (f64, f64) {
    let plain = (1.0, 0.0);
    if keys.get(keys::VERTICAL).or_else(|| keys.get(keys::VERTICAL_UNIT)).is_none() {
        return plain;
    }
    let scale = tiff.get_tag_f64_vec(Tag::ModelPixelScaleTag).unwrap_or_default();
    let tie = tiff.get_tag_f64_vec(Tag::ModelTiepointTag).unwrap_or_default();
    let matrix = tiff.get_tag_f64_vec(Tag::ModelTransformationTag).unwrap_or_default();
    match (scale.as_slice(), tie.as_slice(), matrix.as_slice()) {
        ([_, _, dz, ..], [_, _, sample, _, _, z, ..], _) if *dz != 0.0 => (*dz, z - sample * dz),
        (_, _, [_, _, _, _, _, _, _, _, _, _, dz, z, ..]) if *dz != 0.0 => (*dz, *z),
        _ => plain,
    }
}

/// Returns the text of the metadata item with this role, for the first band or for the file.
fn item<'a>(metadata: &'a str, role: &str) -> Option<&'a str> {
    metadata.split("<Item").skip(1).find_map(|rest| {
        let (tag, rest) = rest.split_once('>')?;
        let (text, _) = rest.split_once('<')?;
        let is_first = attribute(tag, "sample").is_none_or(|sample| sample == "0");
        (is_first && attribute(tag, "role") == Some(role)).then_some(text.trim())
    })
}

/// Returns the value of an attribute in a tag.
fn attribute<'a>(tag: &'a str, name: &str) -> Option<&'a str> {
    tag.split_whitespace().find_map(|part| {
        let value = part.strip_prefix(name)?.strip_prefix('=')?;
        Some(value.trim_end_matches('/').trim_matches(['"', '\'']))
    })
}

/// Returns the length (m) of a unit with an EPSG code.
fn unit_coded(unit: u16, name: &str) -> Result<f64> {
    match unit {
        keys::METRE => Ok(1.0),
        9002 => Ok(0.3048),
        9003 => Ok(1200.0 / 3937.0),
        unit => Err(unit_error(&format!("EPSG:{unit}"), name)),
    }
}

/// Returns the length (m) of a unit with a GDAL name.
fn unit_named(unit: &str, name: &str) -> Result<f64> {
    match unit.to_ascii_lowercase().as_str() {
        "" | "m" | "metre" | "metres" | "meter" | "meters" => Ok(1.0),
        "ft" | "foot" | "feet" => Ok(0.3048),
        "us-ft" | "ftus" | "us survey foot" | "us survey feet" => Ok(1200.0 / 3937.0),
        "cm" | "centimetre" | "centimeter" => Ok(0.01),
        "mm" | "millimetre" | "millimeter" => Ok(0.001),
        _ => Err(unit_error(&format!("{unit:?}"), name)),
    }
}

fn unit_error(unit: &str, name: &str) -> Error {
    Error::data(format!("{name} has heights in an unknown unit ({unit})")).help("convert it to metres")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_are_found_by_their_role_in_the_first_band() {
        let text = "<GDALMetadata>\n  <Item name=\"AREA\">x</Item>\n  <Item name='SCALE' sample='1' role='scale'>7</Item>\n  \
            <Item name=\"SCALE\" sample=\"0\" role=\"scale\"> 0.1 </Item><Item role=\"offset\" name=\"OFFSET\" sample=\"0\">5</Item>";
        assert_eq!((item(text, "scale"), item(text, "offset")), (Some("0.1"), Some("5")));
        assert_eq!(
            (item(text, "unittype"), item("<Item", "scale"), item("<Item role=scale>", "scale")),
            (None, None, None)
        );
    }
}
