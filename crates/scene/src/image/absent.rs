//! What stands in the place of decoders and encoders where a program is built without pictures.

use super::{Image, ImageKind};
use burgeon_base::error::{Error, Result};

/// Fails: pictures are not there.
pub fn check() -> Result<()> {
    Err(Error::left_out("pictures", "pictures"))
}

/// Fails as [`check`] does.
pub fn decode(_bytes: &[u8]) -> Result<Image> {
    check().map(|()| Image::filled(0, 0, [0; 4]))
}

/// Fails as [`check`] does.
pub fn encode(_image: &Image) -> Result<Vec<u8>> {
    check().map(|()| Vec::new())
}

/// Fails as [`check`] does.
pub fn encode_opaque(_width: u32, _height: u32, _channels: &[u8]) -> Result<Vec<u8>> {
    check().map(|()| Vec::new())
}

/// Fails as [`check`] does.
pub fn encode_indexed(_image: &Image, _most: usize) -> Result<Vec<u8>> {
    check().map(|()| Vec::new())
}

/// Whether the pixels of a file have an opacity, as the chunks before a PNG's pixels say.
///
/// Fails if the content is neither PNG nor JPEG, or ends before that is told.
pub fn has_alpha(bytes: &[u8]) -> Result<bool> {
    match ImageKind::of(bytes) {
        Some(ImageKind::Png) => {
            png_has_alpha(&bytes[8..]).ok_or_else(|| Error::data("it ends before its pixels"))
        }
        Some(ImageKind::Jpeg) => Ok(false),
        None => Err(Error::data("it is neither PNG nor JPEG")),
    }
}

/// The same of a PNG behind its signature; `None` if it ends before its pixels.
fn png_has_alpha(mut chunks: &[u8]) -> Option<bool> {
    // A channel for opacity; grey and colours without one may say in a chunk which of them are not there.
    const OPACITY: u8 = 4;
    loop {
        let (length, rest) = chunks.split_first_chunk::<4>()?;
        let (name, rest) = rest.split_first_chunk::<4>()?;
        let length = usize::try_from(u32::from_be_bytes(*length)).ok()?;
        let content = rest.get(..length)?;
        match name {
            b"IHDR" if content.get(9)? & OPACITY != 0 => return Some(true),
            b"tRNS" => return Some(true),
            b"IDAT" => return Some(false),
            _ => {}
        }
        // Behind the content stands a checksum.
        chunks = rest.get(length + 4..)?;
    }
}
