//! Strips and tiles of a TIFF, as bytes: which of them are absent, and the content of LZW parts and of masks.
//!
//! The decoder of the crate `tiff` reads no masks.

use std::io::{Cursor, Read};

use flate2::read::ZlibDecoder;
use tiff::decoder::{Decoder, IfdDecoder};
use tiff::tags::Tag;

use super::lzw::{LZW, unpack_lzw};
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;

/// TIFF in memory that is being read.
pub(super) type Tiff<'a> = Decoder<Cursor<&'a [u8]>>;

/// TIFF compressions besides LZW.
const PLAIN: u32 = 1;
const DEFLATE: [u32; 2] = [8, 32946];

/// Bit of `NewSubfileType` that marks the mask of another image.
const IS_MASK: u32 = 4;
/// Maximum number of images that are searched for the mask.
const MOST_IMAGES: usize = 256;

/// Strips or tiles of one image.
pub(super) struct TiffParts {
    /// TIFF compression.
    pub(super) compression: u32,
    /// Bits of a sample, its format (1 for natural numbers, 2 for integers, 3 for floats), and the predictor.
    pub(super) bits: u32,
    pub(super) format: u32,
    pub(super) predictor: u32,
    offsets: Vec<u64>,
    sizes: Vec<u64>,
    /// Columns and rows of the image and of a part.
    image: [usize; 2],
    part: [usize; 2],
    is_strip: bool,
}

impl TiffParts {
    /// Reads the tags of the current image; `None` if they are incomplete.
    pub(super) fn of(tiff: &mut Tiff<'_>) -> Option<Self> {
        Self::read(tiff.image_ifd())
    }

    /// Returns the mask of the current image, which is the first one of the file.
    pub(super) fn mask_of(tiff: &mut Tiff<'_>) -> Option<Self> {
        let size = tiff.dimensions().ok()?;
        let mut next = tiff.image_ifd().directory().next();
        for _ in 0..MOST_IMAGES {
            let directory = tiff.read_directory(next?).ok()?;
            next = directory.next();
            let mut number = |tag| {
                let found = tiff.read_directory_tags(&directory).find_tag_unsigned::<u32>(tag);
                found.ok().flatten()
            };
            let kind = number(Tag::NewSubfileType).unwrap_or(0);
            let found = number(Tag::ImageWidth).zip(number(Tag::ImageLength));
            if kind & IS_MASK != 0 && found == Some(size) {
                return Self::read(tiff.read_directory_tags(&directory));
            }
        }
        None
    }

    fn read(mut tags: IfdDecoder<'_>) -> Option<Self> {
        let mut number = |tag| tags.find_tag_unsigned::<u32>(tag).ok().flatten();
        let side = |side: u32| usize::try_from(side).ok().filter(|side| *side > 0);
        let image = [side(number(Tag::ImageWidth)?)?, side(number(Tag::ImageLength)?)?];
        let is_strip = number(Tag::TileWidth).is_none();
        let part = if is_strip {
            let rows = number(Tag::RowsPerStrip).and_then(side).unwrap_or(image[1]);
            [image[0], rows.min(image[1])]
        } else {
            [side(number(Tag::TileWidth)?)?, side(number(Tag::TileLength)?)?]
        };
        let [compression, predictor] =
            [Tag::Compression, Tag::Predictor].map(|tag| number(tag).unwrap_or(PLAIN));
        let mut first = |tag| tags.find_tag_unsigned_vec::<u64>(tag).ok().flatten();
        let small = |values: Option<Vec<u64>>| {
            values.and_then(|values| u32::try_from(*values.first()?).ok()).unwrap_or(1)
        };
        let [bits, format] = [Tag::BitsPerSample, Tag::SampleFormat].map(|tag| small(first(tag)));
        let [offsets, sizes] = if is_strip {
            [Tag::StripOffsets, Tag::StripByteCounts]
        } else {
            [Tag::TileOffsets, Tag::TileByteCounts]
        }
        .map(first);
        let (offsets, sizes) = (offsets?, sizes?);
        Some(Self { compression, bits, format, predictor, offsets, sizes, image, part, is_strip })
    }

    /// Returns true if a part is not in the file, so its samples have no value.
    pub(super) fn is_absent(&self, number: usize) -> bool {
        self.sizes.get(number) == Some(&0)
    }

    /// Returns the columns and rows that are stored in a part: the last strip ends with the image, tiles are padded.
    pub(super) fn stored_size(&self, number: usize) -> [usize; 2] {
        let [width, height] = self.part;
        let down = self.image[1].saturating_sub(number.saturating_mul(height));
        [width, if self.is_strip { height.min(down) } else { height }]
    }

    /// Returns the first `length` bytes of a part without compression; `None` if it has fewer, is damaged, or has
    /// another compression than LZW and Deflate.
    pub(super) fn unpack(&self, bytes: &[u8], number: usize, length: usize) -> Option<Vec<u8>> {
        let [start, size] = [&self.offsets, &self.sizes].map(|all| usize::try_from(*all.get(number)?).ok());
        let packed = bytes.get(start?..start?.checked_add(size?)?)?;
        let mut unpacked = Vec::new();
        match self.compression {
            PLAIN => unpacked.extend(packed.get(..length)?),
            LZW => unpacked = unpack_lzw(packed, length)?,
            compression if DEFLATE.contains(&compression) => {
                ZlibDecoder::new(packed).take(length as u64).read_to_end(&mut unpacked).ok()?;
            }
            _ => return None,
        }
        (unpacked.len() == length).then_some(unpacked)
    }

    /// Returns the bits of all stored samples of a part, row by row; `None` if the part cannot be unpacked.
    pub(super) fn samples(&self, bytes: &[u8], number: usize, is_big: bool) -> Option<Vec<u64>> {
        let size = (self.bits / 8) as usize;
        let [width, height] = self.stored_size(number);
        let row = width.checked_mul(size)?;
        let mut unpacked = self.unpack(bytes, number, row.checked_mul(height)?)?;
        let mut samples = Vec::with_capacity(width * height);
        for row in unpacked.chunks_exact_mut(row) {
            let start = samples.len();
            if self.predictor == 3 {
                (1..row.len()).for_each(|at| row[at] = row[at].wrapping_add(row[at - 1]));
                // The first bytes of all samples, from the most significant one, then the second bytes.
                let sample =
                    |at: usize| (0..size).fold(0, |sum, byte| sum << 8 | u64::from(row[byte * width + at]));
                samples.extend((0..width).map(sample));
                continue;
            }
            let add = |sum: u64, byte: &u8| sum << 8 | u64::from(*byte);
            let sample = |part: &[u8]| match is_big {
                true => part.iter().fold(0, add),
                false => part.iter().rev().fold(0, add),
            };
            samples.extend(row.chunks_exact(size).map(sample));
            if self.predictor == 2 {
                let most = u64::MAX >> (64 - self.bits);
                (start + 1..samples.len())
                    .for_each(|at| samples[at] = samples[at].wrapping_add(samples[at - 1]) & most);
            }
        }
        Some(samples)
    }

    /// Returns true if [`Self::samples`] supports the samples.
    pub(super) fn is_supported(&self) -> bool {
        let is_known = matches!((self.format, self.bits), (1 | 2, 16 | 32) | (3, 32 | 64));
        is_known && (self.predictor <= 2 || self.predictor == 3 && self.format == 3)
    }

    /// Converts the bits of a sample to a number.
    #[allow(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "samples have these bits")]
    pub(super) fn number(&self, bits: u64) -> f64 {
        match (self.format, self.bits) {
            (3, 32) => f64::from(f32::from_bits(bits as u32)),
            (3, _) => f64::from_bits(bits),
            (2, 16) => f64::from(bits as u16 as i16),
            (2, _) => f64::from(bits as u32 as i32),
            _ => f64::from(bits as u32),
        }
    }

    /// Calls `each` with the row and the column of each sample that the mask excludes. Returns `false` if the mask
    /// cannot be read. Fails if that exceeds the `budget`.
    pub(super) fn each_excluded(
        &self,
        bytes: &[u8],
        budget: &Budget,
        mut each: impl FnMut(usize, usize),
    ) -> Result<bool> {
        if !matches!(self.bits, 1 | 8) {
            return Ok(false);
        }
        let [columns, rows] = self.image;
        let [width, height] = self.part;
        let across = columns.div_ceil(width);
        let length = if self.bits == 1 { width.div_ceil(8) } else { width };
        for number in 0..across * rows.div_ceil(height) {
            let [left, top] = [number % across * width, number / across * height];
            budget.check()?;
            // Tiles are as large as the file says, however small the image is.
            let Some(whole) = length.checked_mul(self.stored_size(number)[1]) else { return Ok(false) };
            let _held = budget.hold(whole)?;
            let unpacked = match self.is_absent(number) {
                true => None,
                false => match self.unpack(bytes, number, whole) {
                    Some(unpacked) => Some(unpacked),
                    None => return Ok(false),
                },
            };
            for row in 0..height.min(rows - top) {
                for column in 0..width.min(columns - left) {
                    let is_kept = unpacked.as_ref().is_some_and(|bytes| match self.bits {
                        1 => bytes[row * length + column / 8] >> (7 - column % 8) & 1 == 1,
                        _ => bytes[row * length + column] != 0,
                    });
                    if !is_kept {
                        each(top + row, left + column);
                    }
                }
            }
        }
        Ok(true)
    }
}
