//! Stubs of the encoders of animated images, for builds without the feature `pictures`.

use super::encoder::FrameEncoder;
use crate::film_settings::FilmSettings;
use std::io;

/// Fails, because images cannot be encoded.
pub(super) fn apng(_settings: &FilmSettings) -> io::Result<Box<dyn FrameEncoder>> {
    Err(io::ErrorKind::Unsupported.into())
}

/// Fails, because images cannot be encoded.
pub(super) fn gif(_settings: &FilmSettings) -> io::Result<Box<dyn FrameEncoder>> {
    Err(io::ErrorKind::Unsupported.into())
}
