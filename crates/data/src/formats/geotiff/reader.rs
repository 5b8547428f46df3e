//! Reader of GeoTIFF: integers or floats in strips or tiles, with tags for their position.

use std::io::Cursor;

use tiff::TiffError;
use tiff::decoder::{ChunkType, Decoder, DecodingResult, Limits};
use tiff::tags::{ByteOrder, Tag};

use super::keys::GeoKeys;
use super::lzw::LZW;
use super::meaning::Meaning;
use super::parts::{Tiff, TiffParts};
use crate::formats::packed::{DEFLATED, can_hold, cannot_hold};
use crate::heights::{RasterHeader, SampleGrid, check_size, count};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_spatial::height_files::tiff_key as keys;

/// Maximum compression ratio of LZW, whose 12-bit codes represent fewer than 4,096 bytes each, and of any other
/// compression.
const LZW_RATIO: usize = 2_800;
const PACKED: usize = 100_000;

/// Maximum memory (bytes) for one strip or tile, and for the values of one tag.
const LARGEST_PART: usize = 1_000_000_000;
const LARGEST_TAG: usize = 64_000_000;

/// Reads a file called `name`.
///
/// Fails if the file is damaged or truncated, has 8-bit samples or several bands instead of heights, or is rotated.
pub(crate) fn read<'a>(bytes: &'a [u8], name: &'a str) -> Result<RasterHeader<'a>> {
    let tiff_error = |error: TiffError| tiff_error(name, &error);
    if !texts_fit(bytes) {
        return Err(tiff_error(TiffError::LimitsExceeded));
    }
    let mut limits = Limits::default();
    limits.decoding_buffer_size = LARGEST_PART.max(bytes.len());
    limits.intermediate_buffer_size = LARGEST_PART;
    limits.ifd_value_size = LARGEST_TAG;
    let mut tiff = Decoder::new(Cursor::new(bytes)).map_err(tiff_error)?.with_limits(limits);
    let (columns, rows) = tiff.dimensions().map_err(tiff_error)?;
    let [columns, rows] = [columns, rows].map(|side| side as usize);
    check_size(name, columns, rows)?;
    let color = tiff.colortype().map_err(tiff_error)?;
    if color.num_samples() != 1 {
        return Err(Error::data(format!(
            "{name} has {} bands, but heights need one band",
            color.num_samples()
        ))
        .help("extract the band of heights: gdal_translate -b 1 IN OUT.tif"));
    }
    check_whole(&mut tiff, bytes, name)?;
    check_parts(&mut tiff, bytes, name, usize::from(color.bit_depth()).div_ceil(8))?;
    let keys = GeoKeys::read(&mut tiff);
    let meaning = Meaning::read(&mut tiff, &keys, name)?;
    let has_unit = meaning.has_unit;
    let mut grid = grid(&mut tiff, name, keys.get(keys::RASTER) == Some(keys::POINT))?;
    let from_south = grid.as_ref().is_some_and(|grid| grid.step[1] < 0.0);
    if let Some(grid) = grid.as_mut().filter(|_| from_south) {
        grid.first[1] -= grid.step[1] * count(rows - 1);
        grid.step[1] = -grid.step[1];
    }
    let heights = move |budget: &Budget| {
        let mut heights = samples(&mut tiff, bytes, name, [columns, rows], &meaning, budget)?;
        take_out_masked(&mut tiff, bytes, name, (columns, &mut heights), budget)?;
        if from_south {
            let _held = budget.hold(heights.len() * size_of::<f32>())?;
            heights = heights.chunks_exact(columns).rev().flatten().copied().collect();
        }
        Ok(heights)
    };
    Ok(RasterHeader {
        columns,
        rows,
        grid,
        crs: keys.crs(name),
        is_told: false,
        has_unit,
        heights: Box::new(heights),
    })
}

/// Returns true if no text in the first directory is longer than the file; otherwise the decoder would print to the
/// terminal.
fn texts_fit(bytes: &[u8]) -> bool {
    const TEXT: usize = 2;
    let number = |at: usize, size: usize| {
        let part = bytes.get(at..at.checked_add(size)?)?;
        let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
        let sum = if bytes[0] == b'M' { part.iter().fold(0, add) } else { part.iter().rev().fold(0, add) };
        usize::try_from(sum).ok()
    };
    // Offset of the directory, and the sizes (bytes) of its entry count, of an entry, and of the count in an entry.
    let (begin, [head, entry, count]) = match number(2, 2) {
        Some(43) => (number(8, 8), [8, 20, 8]),
        _ => (number(4, 4), [2, 12, 4]),
    };
    let Some(begin) = begin else { return true };
    let entries = number(begin, head).unwrap_or(0).min(bytes.len() / entry);
    (0..entries).all(|index| {
        let at = begin + head + index * entry;
        number(at + 2, 2) != Some(TEXT) || number(at + 4, count).is_some_and(|length| length <= bytes.len())
    })
}

/// Fails if the file ends before its last strip or tile.
fn check_whole(tiff: &mut Tiff<'_>, bytes: &[u8], name: &str) -> Result<()> {
    for [offsets, sizes] in
        [[Tag::StripOffsets, Tag::StripByteCounts], [Tag::TileOffsets, Tag::TileByteCounts]]
    {
        let (Ok(offsets), Ok(sizes)) = (tiff.get_tag_u64_vec(offsets), tiff.get_tag_u64_vec(sizes)) else {
            continue;
        };
        let ends = offsets.iter().zip(&sizes).map(|(offset, size)| offset.saturating_add(*size));
        let (end, length) = (ends.max().unwrap_or(0), bytes.len());
        if end > length as u64 {
            return Err(Error::data(format!("{name} is cut short: it has {length} of {end} bytes"))
                .help("download it again"));
        }
    }
    Ok(())
}

/// Fails if strips or tiles declare more samples than their bytes can contain.
fn check_parts(tiff: &mut Tiff<'_>, bytes: &[u8], name: &str, sample: usize) -> Result<()> {
    let (columns, rows) = tiff.dimensions().map_err(|error| tiff_error(name, &error))?;
    let [columns, rows] = [columns, rows].map(|side| side as usize);
    let (width, height) = tiff.chunk_dimensions();
    let [width, height] = [width, height].map(|side| side as usize);
    if width == 0 || height == 0 {
        return Err(
            Error::data(format!("{name} has strips or tiles without extent")).help("download it again")
        );
    }
    let tag = match tiff.get_chunk_type() {
        ChunkType::Strip => Tag::StripByteCounts,
        ChunkType::Tile => Tag::TileByteCounts,
    };
    // Without compression, the sizes may be missing.
    let Ok(sizes) = tiff.get_tag_u64_vec(tag) else { return Ok(()) };
    let most = match tiff.get_tag_u32(Tag::Compression).unwrap_or(1) {
        1 => 1,
        5 => LZW_RATIO,
        8 | 32946 => DEFLATED,
        _ => PACKED,
    };
    let is_strip = matches!(tiff.get_chunk_type(), ChunkType::Strip);
    let parts = columns.div_ceil(width) * rows.div_ceil(height);
    for (part, size) in sizes.into_iter().enumerate().take(parts) {
        // The last strip ends with the image, whereas tiles are complete.
        let down = if is_strip { height.min(rows.saturating_sub(part * height)) } else { height };
        let whole = width.saturating_mul(down).saturating_mul(sample);
        // A part without bytes has no values.
        if size > 0 && !can_hold(usize::try_from(size).unwrap_or(usize::MAX), most, whole) {
            return Err(cannot_hold(name, bytes.len(), columns, rows));
        }
    }
    Ok(())
}

/// Returns all heights, read strip by strip or tile by tile.
fn samples(
    tiff: &mut Tiff<'_>,
    bytes: &[u8],
    name: &str,
    [columns, rows]: [usize; 2],
    meaning: &Meaning,
    budget: &Budget,
) -> Result<Vec<f32>> {
    let (width, height) = tiff.chunk_dimensions();
    let [width, height] = [width, height].map(|side| side as usize);
    let across = columns.div_ceil(width);
    let parts = TiffParts::of(tiff);
    let is_big = matches!(tiff.byte_order(), ByteOrder::BigEndian);
    let mut heights = Vec::new();
    for top in (0..rows).step_by(height) {
        // Memory is allocated only for the rows found so far.
        heights.resize(columns * rows.min(top + height), f32::NAN);
        for column in 0..across {
            budget.check()?;
            // The unpacked bytes, and their heights.
            let _held = budget.hold(width.saturating_mul(height).saturating_mul(12))?;
            let part = top / height * across + column;
            let number =
                u32::try_from(part).map_err(|_| Error::data(format!("{name} has too many strips")))?;
            let left = column * width;
            let (values, stride) = match &parts {
                Some(parts) if parts.is_absent(part) => {
                    let found = [width.min(columns - left), height.min(rows - top)];
                    (vec![meaning.absent_height(); found[0] * found[1]], found[0])
                }
                Some(parts) if parts.compression == LZW && parts.is_supported() => {
                    let samples = parts.samples(bytes, part, is_big).ok_or_else(|| damage_error(name))?;
                    let heights = samples.into_iter().map(|bits| meaning.height(parts.number(bits)));
                    (heights.collect(), width)
                }
                _ => {
                    let (found_width, _) = tiff.chunk_data_dimensions(number);
                    let values = tiff.read_chunk(number).map_err(|error| tiff_error(name, &error))?;
                    (numbers(values, meaning, name)?, (found_width as usize).max(1))
                }
            };
            for (row, values) in (top..rows.min(top + height)).zip(values.chunks(stride)) {
                let line = &mut heights[row * columns + left..row * columns + columns.min(left + width)];
                line.iter_mut().zip(values).for_each(|(height, value)| *height = *value);
            }
        }
    }
    Ok(heights)
}

/// Marks the heights as missing that the mask of the file excludes, if it has one.
fn take_out_masked(
    tiff: &mut Tiff<'_>,
    bytes: &[u8],
    name: &str,
    (columns, heights): (usize, &mut [f32]),
    budget: &Budget,
) -> Result<()> {
    let Some(mask) = TiffParts::mask_of(tiff) else { return Ok(()) };
    let is_read = mask.each_excluded(bytes, budget, |row, column| {
        if let Some(height) = heights.get_mut(row * columns + column) {
            *height = f32::NAN;
        }
    })?;
    if is_read {
        return Ok(());
    }
    Err(Error::data(format!("{name} has a mask that is damaged or has an unsupported compression"))
        .help("write the mask as a value: gdalwarp -dstnodata -9999 IN OUT.tif, or compress it with Deflate"))
}

/// Converts samples to heights (m). Fails for sample types that cannot be heights.
fn numbers(values: DecodingResult, meaning: &Meaning, name: &str) -> Result<Vec<f32>> {
    fn all<T: Copy + Into<f64>>(values: &[T], meaning: &Meaning) -> Vec<f32> {
        values.iter().map(|value| meaning.height((*value).into())).collect()
    }
    Ok(match values {
        DecodingResult::F32(values) => all(&values, meaning),
        DecodingResult::F64(values) => all(&values, meaning),
        DecodingResult::I16(values) => all(&values, meaning),
        DecodingResult::U16(values) => all(&values, meaning),
        DecodingResult::I32(values) => all(&values, meaning),
        DecodingResult::U32(values) => all(&values, meaning),
        DecodingResult::U8(_) | DecodingResult::I8(_) => {
            return Err(Error::data(format!(
                "{name} has samples of 8 bits: 256 levels are too coarse for heights"
            ))
            .help("export it with 16 bits or floats"));
        }
        _ => {
            return Err(Error::data(format!("{name} has samples of an unsupported type"))
                .help("convert it: gdal_translate -ot Float32 IN OUT.tif"));
        }
    })
}

/// Returns the positions of the samples; `None` if no tag contains them. The step is negative if rows are ordered from
/// south to north.
///
/// Fails if the raster is rotated.
fn grid(tiff: &mut Tiff<'_>, name: &str, is_point: bool) -> Result<Option<SampleGrid>> {
    let scale = tiff.get_tag_f64_vec(Tag::ModelPixelScaleTag).unwrap_or_default();
    let tie = tiff.get_tag_f64_vec(Tag::ModelTiepointTag).unwrap_or_default();
    let matrix = tiff.get_tag_f64_vec(Tag::ModelTransformationTag).unwrap_or_default();
    // Corner of the first sample's area, or its centre, and the steps.
    let (corner, step) = match (scale.as_slice(), tie.as_slice(), matrix.as_slice()) {
        ([dx, dy, ..], [column, row, _, x, y, ..], _) => ([x - column * dx, y + row * dy], [*dx, *dy]),
        (_, _, [a, b, _, x, c, d, _, y, ..]) => {
            if *b != 0.0 || *c != 0.0 {
                return Err(Error::data(format!("{name} is rotated: its columns do not point north"))
                    .help("resample it: gdalwarp IN OUT.tif"));
            }
            ([*x, *y], [*a, -*d])
        }
        _ => return Ok(None),
    };
    let half = if is_point { 0.0 } else { 0.5 };
    Ok(Some(SampleGrid { first: [corner[0] + half * step[0], corner[1] - half * step[1]], step }))
}

fn tiff_error(name: &str, error: &TiffError) -> Error {
    match error {
        TiffError::IoError(error) if error.kind() == std::io::ErrorKind::UnexpectedEof => {
            Error::data(format!("{name} is cut short")).help("download it again")
        }
        TiffError::LimitsExceeded => {
            Error::limit(Limit::Size, format!("{name} has a strip or a tag that is too large"))
                .help("write it with tiles: gdal_translate -co TILED=YES IN OUT.tif")
        }
        TiffError::UnsupportedError(_) => Error::data(format!("{name}: unsupported TIFF variant"))
            .help("convert it: gdal_translate -ot Float32 -co COMPRESS=DEFLATE IN OUT.tif"),
        _ => damage_error(name),
    }
}

fn damage_error(name: &str) -> Error {
    Error::data(format!("{name}: damaged TIFF file")).help("download it again")
}
