//! PNG: grey of 16 bits between two heights, or colours that are heights.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};

use super::raster::Found;
use super::raw::narrow;
use super::{MOST, Wanted};
use crate::error::{Error, Result};

/// The names of the texts in a PNG that tell heights (m).
pub(crate) mod text {
    /// That of black.
    pub(crate) const LOW: &str = "low";
    /// That of white.
    pub(crate) const HIGH: &str = "high";
}

/// Reads a picture called `name`.
///
/// Fails on 8 bits of grey, and on colours unless `wanted` says what they mean; if the heights of black and white are
/// neither in the file nor in `wanted`; if it is damaged or cut short.
pub(super) fn read(bytes: &[u8], name: &str, wanted: &Wanted) -> Result<Found> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MOST * 8 });
    decoder.set_transformations(Transformations::IDENTITY);
    let info = decoder.read_header_info().map_err(|error| damaged(name, bytes, &error))?;
    let [columns, rows] = [info.width, info.height].map(|side| side as usize);
    let form = (info.color_type, info.bit_depth);
    Found::check_size(name, columns, rows)?;
    let parts = parts(name, form, wanted)?;
    let mut reader = decoder.read_info().map_err(|error| damaged(name, bytes, &error))?;
    let size = reader.output_buffer_size().unwrap_or(usize::MAX);
    // At most four channels of two bytes for each sample.
    if size > MOST * 8 {
        return Err(Error::new(format!("{name} is too large to be unpacked")).help("cut out a part of it"));
    }
    let mut content = vec![0; size];
    reader.next_frame(&mut content).map_err(|error| damaged(name, bytes, &error))?;
    let heights = if wanted.terrain_rgb {
        content.chunks_exact(parts).map(rgb).collect()
    } else {
        // Texts may stand behind the picture.
        reader.finish().map_err(|error| damaged(name, bytes, &error))?;
        let texts = &reader.info().uncompressed_latin1_text;
        let told = |keyword: &str| {
            let text = texts.iter().find(|text| text.keyword == keyword)?;
            text.text.parse::<f64>().ok()
        };
        let (low, high) = (wanted.low.or_else(|| told(text::LOW)), wanted.high.or_else(|| told(text::HIGH)));
        let (Some(low), Some(high)) = (low, high) else {
            return Err(Error::new(format!("{name} does not tell the heights of black and white"))
                .help("name them (m): elevation(file, { low = 0, high = 1200, ... })"));
        };
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(Error::new(format!("{name} cannot lie between low = {low} and high = {high}"))
                .help("low is the height (m) of black, high the greater one of white"));
        }
        let scale = (high - low) / 65535.0;
        let grey = |sample: &[u8]| match sample {
            [_, _, 0, 0] => f32::NAN,
            [a, b, ..] => narrow(low + scale * f64::from(u16::from_be_bytes([*a, *b]))),
            _ => f32::NAN,
        };
        content.chunks_exact(parts).map(grey).collect()
    };
    Ok(Found { columns, rows, heights, grid: None, crs: Ok(None) })
}

/// The number of bytes of a sample. Fails if they are not as `wanted` needs them.
fn parts(name: &str, form: (ColorType, BitDepth), wanted: &Wanted) -> Result<usize> {
    let colored = matches!(form.0, ColorType::Rgb | ColorType::Rgba | ColorType::Indexed);
    match (wanted.terrain_rgb, form) {
        (true, (ColorType::Rgb, BitDepth::Eight)) => Ok(3),
        (true, (ColorType::Rgba, BitDepth::Eight)) => Ok(4),
        (true, _) => Err(Error::new(format!("{name} has no colours of 8 bits that could be heights"))
            .help("leave encoding out, if it is grey; get the tile as .pngraw, if it has a palette")),
        (false, (ColorType::Grayscale, BitDepth::Sixteen)) => Ok(2),
        (false, (ColorType::GrayscaleAlpha, BitDepth::Sixteen)) => Ok(4),
        (false, _) if colored => {
            Err(Error::new(format!("{name} is a PNG in colours, not in grey of 16 bits"))
                .help("if its colours are heights as Mapbox encodes them, say encoding = \"terrain-rgb\""))
        }
        (false, _) => {
            Err(Error::new(format!("{name} is a PNG of 8 bits or less, whose 256 levels would make steps"))
                .help("export it with 16 bits, or as a GeoTIFF"))
        }
    }
}

/// The height (m) of a colour: a tenth of a metre for each step. Method: Mapbox, "Terrain-RGB v1".
fn rgb(sample: &[u8]) -> f32 {
    match *sample {
        [_, _, _, 0] => f32::NAN,
        [r, g, b, ..] => {
            let steps = u32::from_be_bytes([0, r, g, b]);
            narrow(-10_000.0 + f64::from(steps) * 0.1)
        }
        _ => f32::NAN,
    }
}

fn damaged(name: &str, bytes: &[u8], error: &DecodingError) -> Error {
    match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            let length = bytes.len();
            Error::new(format!("{name} is cut short: it ends after {length} bytes, where more should follow"))
                .help("get it again")
        }
        DecodingError::LimitsExceeded => Error::new(format!("{name} takes too much memory to unpack"))
            .help("cut out a part of it, or write it without texts and profiles"),
        _ => Error::new(format!("{name} is a damaged PNG")).help("get it again"),
    }
}
