//! GeoTIFF keys, and the coordinate system that they name.

use tiff::tags::Tag;

use super::parts::Tiff;
use burgeon_base::error::{Error, Result};
use burgeon_spatial::Crs;
use burgeon_spatial::height_files::tiff_key as keys;

/// Remedy for a coordinate system that cannot be used.
const NAME_IT: &str = "specify its EPSG code: elevation(file, { crs = 3067 }), or convert the file: gdalwarp -t_srs EPSG:4326 IN OUT.tif";

/// Numeric GeoTIFF keys.
pub(super) struct GeoKeys {
    short: Vec<(u16, u16)>,
    double: Vec<(u16, f64)>,
}

impl GeoKeys {
    /// Reads the keys; there are none in a plain TIFF.
    pub(super) fn read(tiff: &mut Tiff<'_>) -> Self {
        let directory = tiff.get_tag_u16_vec(Tag::GeoKeyDirectoryTag).unwrap_or_default();
        let doubles = tiff.get_tag_f64_vec(Tag::GeoDoubleParamsTag).unwrap_or_default();
        let mut keys = Self { short: Vec::new(), double: Vec::new() };
        // The directory has four header numbers, then four numbers per key: key, location of the value, count, and
        // index or value.
        for key in directory.chunks_exact(4).skip(1) {
            if key[1] == 0 {
                keys.short.push((key[0], key[3]));
            } else if key[1] == Tag::GeoDoubleParamsTag.to_u16() {
                keys.double.extend(doubles.get(usize::from(key[3])).map(|value| (key[0], *value)));
            }
        }
        keys
    }

    pub(super) fn get(&self, key: u16) -> Option<u16> {
        self.short.iter().find(|(known, _)| *known == key).map(|(_, value)| *value)
    }

    /// Returns the coordinate system, if the file has one.
    pub(super) fn crs(&self, name: &str) -> Result<Option<Crs>> {
        let code = self.get(keys::PROJECTED).or_else(|| self.get(keys::GEOGRAPHIC)).filter(|code| *code != 0);
        match (code, self.middle()) {
            (None, _) if self.get(keys::MODEL).is_none_or(|model| model == 0) => Ok(None),
            (Some(keys::OWN), Some(middle)) => Ok(Some(Crs::around(middle))),
            (Some(code), _) if code != keys::OWN => Crs::epsg(code.into())
                .map(Some)
                .map_err(|error| Error::data(format!("{name}: {}", error.message())).help(NAME_IT)),
            _ => {
                Err(Error::data(format!("{name} has a coordinate system without an EPSG code")).help(NAME_IT))
            }
        }
    }

    /// Returns the centre (longitude and latitude in degrees) of a run's transverse Mercator projection, if the file
    /// uses one.
    fn middle(&self) -> Option<[f64; 2]> {
        let double = |key: u16| self.double.iter().find(|(known, _)| *known == key).map(|(_, value)| *value);
        let [longitude, latitude, x, y, scale] = keys::MIDDLE.map(double);
        let is_ours = self.get(keys::METHOD) == Some(keys::TRANSVERSE_MERCATOR)
            && self.get(keys::GEOGRAPHIC) == Some(keys::WGS_84)
            && self.get(keys::LINEAR_UNIT) == Some(keys::METRE)
            && [x, y, scale] == [Some(0.0), Some(0.0), Some(1.0)];
        let middle = [longitude?, latitude?];
        (is_ours && middle[0].abs() <= 180.0 && middle[1].abs() <= 90.0).then_some(middle)
    }
}
