//! Encoder of the frames of a film.

use burgeon_scene::image::Image;
use std::io::{self, Write};

/// Encoder of an animated image.
pub trait FrameEncoder {
    /// Encodes the next frame and writes its bytes.
    fn add(&mut self, image: &Image, out: &mut dyn Write) -> io::Result<()>;

    /// Writes the end of the file.
    fn finish(self: Box<Self>, out: &mut dyn Write) -> io::Result<()>;
}
