//! Stubs of decoders and encoders, for builds without the feature `pictures`.

use super::{Image, ImageKind};
use burgeon_base::error::{Error, Result};

/// Fails, because images cannot be decoded or encoded.
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

/// Returns true if the pixels of a file have an alpha channel, according to the chunks before a PNG's pixels.
///
/// Fails if the content is neither PNG nor JPEG, or if it ends before the pixels.
pub fn has_alpha(bytes: &[u8]) -> Result<bool> {
    match ImageKind::of(bytes) {
        Some(ImageKind::Png) => {
            png_has_alpha(&bytes[8..]).ok_or_else(|| Error::data("it ends before its pixels"))
        }
        Some(ImageKind::Jpeg) => Ok(false),
        None => Err(Error::data("it is neither PNG nor JPEG")),
    }
}

/// Returns the same for a PNG after its signature; `None` if it ends before its pixels.
fn png_has_alpha(mut chunks: &[u8]) -> Option<bool> {
    // Flag of an alpha channel. Grey and colour images without one may declare transparent values in a chunk.
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
        // A checksum follows the content.
        chunks = rest.get(length + 4..)?;
    }
}
