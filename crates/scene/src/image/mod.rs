//! Images: pixels in memory, and the PNG and JPEG files that hold them.
//!
//! Files are told apart by their first bytes ([`ImageKind::of`]). They are decoded and encoded where the feature
//! `pictures` is on; without it, what needs that says so.

#[cfg_attr(feature = "pictures", path = "codec.rs")]
#[cfg_attr(not(feature = "pictures"), path = "absent.rs")]
mod codec;
mod palette;
mod raster;

pub use codec::{check, decode, encode, encode_indexed, encode_opaque, has_alpha};
pub use palette::PaletteImage;
pub use raster::{Image, ImageKind};
