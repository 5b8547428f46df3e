//! Images: pixels in memory, and the PNG and JPEG files that store them.
//!
//! File types are detected by the first bytes ([`ImageKind::of`]). Decoding and encoding require the feature
//! `pictures`; without it, these functions fail.

#[cfg_attr(feature = "pictures", path = "codec.rs")]
#[cfg_attr(not(feature = "pictures"), path = "absent.rs")]
mod codec;
mod palette;
mod raster;

pub use codec::{check, decode, encode, encode_indexed, encode_opaque, has_alpha};
pub use palette::PaletteImage;
pub use raster::{Image, ImageKind};
