//! Heights as PNG and GeoTIFF files.

use std::io;

use png::{BitDepth, ColorType};
use tiff::encoder::{Compression, DeflateLevel, TiffEncoder, colortype};
use tiff::tags::Tag;

use super::super::Out;
use super::height_map::{HeightMap, narrow};
use burgeon_base::error::Result;
use burgeon_spatial::height_files::{png_text, tiff_key};

/// Succeeds, because both formats are available.
pub(super) fn check() -> Result<()> {
    Ok(())
}

#[allow(clippy::cast_sign_loss, reason = "the levels are clamped")]
pub(super) fn write_png(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    let low = map.heights.iter().copied().fold(f64::INFINITY, f64::min);
    let mut high = map.heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    if high <= low {
        // A flat terrain is black.
        high = low + 1.0;
    }
    let mut encoder = png::Encoder::new(out, map.columns as u32, map.rows as u32);
    encoder.set_color(ColorType::Grayscale);
    encoder.set_depth(BitDepth::Sixteen);
    for (keyword, height) in [(png_text::LOW, low), (png_text::HIGH, high)] {
        encoder.add_text_chunk(keyword.to_owned(), height.to_string())?;
    }
    let mut writer = encoder.write_header()?;
    let level = |height: &f64| (((height - low) / (high - low)).clamp(0.0, 1.0) * 65535.0).round() as u16;
    let levels: Vec<u8> = map.heights.iter().flat_map(|height| level(height).to_be_bytes()).collect();
    writer.write_image_data(&levels)?;
    writer.finish()?;
    Ok(())
}

#[allow(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(super) fn write_tiff(map: &HeightMap, out: &mut Out) -> io::Result<()> {
    let heights: Vec<f32> = map.heights.iter().copied().map(narrow).collect();
    let middle = map.frame.as_ref().and_then(|frame| frame.middle);
    let corner = map.projected_corner();
    let north = corner.y + map.step * map.rows as f64;
    let (directory, doubles) = geokeys(map.epsg(), middle);
    let encoded = || {
        let compression = Compression::Deflate(DeflateLevel::Balanced);
        let mut encoder = TiffEncoder::new(out)?.with_compression(compression);
        let mut image = encoder.new_image::<colortype::Gray32Float>(map.columns as u32, map.rows as u32)?;
        let tags = image.encoder();
        tags.write_tag(Tag::ModelPixelScaleTag, &[map.step, map.step, 0.0][..])?;
        tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, corner.x, north, 0.0][..])?;
        tags.write_tag(Tag::GeoKeyDirectoryTag, &directory[..])?;
        if !doubles.is_empty() {
            tags.write_tag(Tag::GeoDoubleParamsTag, &doubles[..])?;
        }
        tags.write_tag(Tag::GdalNodata, "nan")?;
        image.write_data(&heights)
    };
    encoded().map_err(|error| match error {
        tiff::TiffError::IoError(error) => error,
        error => io::Error::other(error),
    })
}

/// Returns the keys of a GeoTIFF in ascending order, and their floating-point values: for an EPSG projection, for a
/// projection around a `middle` (degrees), or for none.
fn geokeys(epsg: Option<u16>, middle: Option<[f64; 2]>) -> (Vec<u16>, Vec<f64>) {
    use tiff_key as key;
    let mut short = vec![(key::RASTER, key::AREA)];
    let mut doubles = Vec::new();
    if epsg.is_some() || middle.is_some() {
        short.insert(0, (key::MODEL, key::IS_PROJECTED));
    }
    match (epsg, middle) {
        (Some(code), _) => short.push((key::PROJECTED, code)),
        (None, Some([longitude, latitude])) => {
            short.extend([
                (key::GEOGRAPHIC, key::WGS_84),
                (key::PROJECTED, key::OWN),
                (key::PROJECTION, key::OWN),
                (key::METHOD, key::TRANSVERSE_MERCATOR),
                (key::LINEAR_UNIT, key::METRE),
            ]);
            doubles.extend([longitude, latitude, 0.0, 0.0, 1.0]);
        }
        (None, None) => {}
    }
    // The header has the version and the number of keys. Each key has its number, the tag of its value, the count and
    // the index.
    let mut directory = vec![1, 1, 0, (short.len() + doubles.len()) as u16];
    directory.extend(short.into_iter().flat_map(|(key, value)| [key, 0, 1, value]));
    let stands = (0..).zip(key::MIDDLE).take(doubles.len());
    directory.extend(stands.flat_map(|(index, key)| [key, Tag::GeoDoubleParamsTag.to_u16(), 1, index]));
    (directory, doubles)
}
