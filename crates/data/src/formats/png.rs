//! Reader of PNG heights: 16-bit grey between two heights, or colours that encode heights.

use std::io::Cursor;

use ::png::{BitDepth, ColorType, Decoder, DecodingError, Limits, Transformations};

use super::packed::{DEFLATED, can_hold, cannot_hold};
use crate::heights::{HeightOptions, MOST, RasterHeader, check_size, narrow};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_spatial::height_files::png_text as text;

/// PNG in memory that is being read.
type PngDecoder<'a> = Decoder<Cursor<&'a [u8]>>;

/// Reads an image called `name`.
///
/// Fails for 8-bit grey, and for colours unless `wanted` specifies their encoding; if the heights of black and white
/// are neither in the file nor in `wanted`; and if the file is damaged or truncated.
pub(crate) fn read<'a>(
    bytes: &'a [u8],
    name: &'a str,
    wanted: &'a HeightOptions,
) -> Result<RasterHeader<'a>> {
    let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MOST * 8 });
    decoder.set_transformations(Transformations::IDENTITY);
    let info = decoder.read_header_info().map_err(|error| damage_error(name, bytes, &error))?;
    let [columns, rows] = [info.width, info.height].map(|side| side as usize);
    let form = (info.color_type, info.bit_depth);
    check_size(name, columns, rows)?;
    let parts = parts(name, form, wanted)?;
    if !can_hold(bytes.len(), DEFLATED, columns * rows * parts) {
        return Err(cannot_hold(name, bytes.len(), columns, rows));
    }
    let heights = move |budget: &Budget| {
        let samples = Samples { parts, terrain_rgb: wanted.terrain_rgb };
        let (mut heights, scale) = samples.read(decoder, bytes, (name, wanted), columns * rows, budget)?;
        if let Some([low, scale]) = scale {
            heights.iter_mut().for_each(|height| *height = narrow(low + scale * f64::from(*height)));
        }
        Ok(heights)
    };
    Ok(RasterHeader {
        columns,
        rows,
        grid: None,
        crs: Ok(None),
        is_told: true,
        has_unit: true,
        heights: Box::new(heights),
    })
}

/// Layout of the samples.
struct Samples {
    /// Bytes per sample.
    parts: usize,
    terrain_rgb: bool,
}

impl Samples {
    /// Reads all samples; for grey, also returns the height (m) of black and the height of one step.
    fn read(
        &self,
        decoder: PngDecoder<'_>,
        bytes: &[u8],
        (name, wanted): (&str, &HeightOptions),
        count: usize,
        budget: &Budget,
    ) -> Result<(Vec<f32>, Option<[f64; 2]>)> {
        let failed = |error| damage_error(name, bytes, &error);
        let mut reader = decoder.read_info().map_err(failed)?;
        let mut heights = Vec::new();
        if reader.info().interlaced {
            // Interlaced rows are not in order, so all rows are decompressed first.
            let size = count * self.parts;
            let _held = budget.hold(size)?;
            let mut content = vec![0; size];
            reader.next_frame(&mut content).map_err(failed)?;
            heights.extend(content.chunks_exact(self.parts).map(|sample| self.height(sample)));
        } else {
            while let Some(row) = reader.next_row().map_err(failed)? {
                budget.tick()?;
                heights.extend(row.data().chunks_exact(self.parts).map(|sample| self.height(sample)));
            }
        }
        if self.terrain_rgb {
            return Ok((heights, None));
        }
        // Text chunks may follow the image.
        match reader.finish() {
            Ok(()) | Err(DecodingError::Parameter(_)) => {}
            Err(error) => return Err(failed(error)),
        }
        let texts = &reader.info().uncompressed_latin1_text;
        let told = |keyword: &str| {
            let text = texts.iter().find(|text| text.keyword == keyword)?;
            text.text.parse::<f64>().ok()
        };
        let (low, high) = (wanted.low.or_else(|| told(text::LOW)), wanted.high.or_else(|| told(text::HIGH)));
        let (Some(low), Some(high)) = (low, high) else {
            return Err(Error::argument(format!("{name} does not specify the heights of black and white"))
                .help("specify them (m): elevation(file, { low = 0, high = 1200, ... })"));
        };
        if !(low.is_finite() && high.is_finite() && low < high) {
            return Err(Error::argument(format!(
                "{name} cannot be scaled from low = {low} to high = {high}"
            ))
            .help("low is the height (m) of black; high, the height of white, must be greater"));
        }
        Ok((heights, Some([low, (high - low) / 65535.0])))
    }

    /// Returns the height (m) of a sample; for grey, the number of steps above black.
    fn height(&self, sample: &[u8]) -> f32 {
        match sample {
            _ if self.terrain_rgb => rgb(sample),
            [_, _, 0, 0] => f32::NAN,
            [a, b, ..] => f32::from(u16::from_be_bytes([*a, *b])),
            _ => f32::NAN,
        }
    }
}

/// Returns the number of bytes per sample. Fails if the format does not match `wanted`.
fn parts(name: &str, form: (ColorType, BitDepth), wanted: &HeightOptions) -> Result<usize> {
    let colored = matches!(form.0, ColorType::Rgb | ColorType::Rgba | ColorType::Indexed);
    match (wanted.terrain_rgb, form) {
        (true, (ColorType::Rgb, BitDepth::Eight)) => Ok(3),
        (true, (ColorType::Rgba, BitDepth::Eight)) => Ok(4),
        (true, _) => Err(Error::data(format!("{name} has no 8-bit colours to decode as heights"))
            .help("remove encoding if it is grey; download the tile as .pngraw if it has a palette")),
        (false, (ColorType::Grayscale, BitDepth::Sixteen)) => Ok(2),
        (false, (ColorType::GrayscaleAlpha, BitDepth::Sixteen)) => Ok(4),
        (false, _) if colored => Err(Error::data(format!("{name} is a PNG in colour, not in 16-bit grey"))
            .help("if its colours are heights in Mapbox encoding, set encoding = \"terrain-rgb\"")),
        (false, _) => Err(Error::data(format!(
            "{name} is a PNG of at most 8 bits: 256 levels are too coarse for heights"
        ))
        .help("export it with 16 bits, or as a GeoTIFF")),
    }
}

/// Returns the height (m) of a colour, in steps of 0.1 m. Method: Mapbox, "Terrain-RGB v1".
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

fn damage_error(name: &str, bytes: &[u8], error: &DecodingError) -> Error {
    match error {
        DecodingError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            let length = bytes.len();
            Error::data(format!("{name} is cut short: it ends after {length} bytes, but more should follow"))
                .help("download it again")
        }
        DecodingError::LimitsExceeded => {
            Error::limit(Limit::Size, format!("{name} takes too much memory to unpack"))
                .help("cut out a part of it, or re-export it without texts and profiles")
        }
        _ => Error::data(format!("{name}: damaged PNG file")).help("download it again"),
    }
}
