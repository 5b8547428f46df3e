//! Animated PNG: exact colours, of which each frame stores the changed rectangle.
//!
//! Specification: W3C, "Portable Network Graphics (PNG) Specification (Third Edition)", 2025.

use super::changes::PixelArea;
use super::delay::fraction;
use super::sink::EncodedBytes;
use crate::film_settings::FilmSettings;
use crate::films::encoder::FrameEncoder;
use burgeon_scene::image::Image;
use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, EncodingError, Filter};
use std::io::{self, Write};

struct ApngEncoder {
    writer: png::Writer<EncodedBytes>,
    bytes: EncodedBytes,
    transparent: bool,
    before: Option<Image>,
}

/// Creates an encoder of an animated PNG, which repeats for ever.
pub(in crate::films) fn apng(settings: &FilmSettings) -> io::Result<Box<dyn FrameEncoder>> {
    let bytes = EncodedBytes::default();
    let (width, height) = settings.size;
    let mut encoder = png::Encoder::new(bytes.clone(), width, height);
    encoder.set_color(if settings.transparent { ColorType::Rgba } else { ColorType::Rgb });
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Balanced);
    encoder.set_filter(Filter::Adaptive);
    encoder.set_animated(settings.frames, 0).map_err(failed)?;
    let (above, below) = fraction(settings);
    encoder.set_frame_delay(above, below).map_err(failed)?;
    encoder.set_blend_op(BlendOp::Source).map_err(failed)?;
    encoder.set_dispose_op(DisposeOp::None).map_err(failed)?;
    let writer = encoder.write_header().map_err(failed)?;
    Ok(Box::new(ApngEncoder { writer, bytes, transparent: settings.transparent, before: None }))
}

impl FrameEncoder for ApngEncoder {
    fn add(&mut self, image: &Image, out: &mut dyn Write) -> io::Result<()> {
        let area = match &self.before {
            Some(before) => PixelArea::changed(image, before),
            None => PixelArea::whole(image),
        };
        let channels = if self.transparent { 4 } else { 3 };
        let mut data = Vec::with_capacity(area.width as usize * area.height as usize * channels);
        area.pixels().for_each(|(x, y)| data.extend_from_slice(&image.pixel(x, y)[..channels]));
        self.writer.reset_frame_position().map_err(failed)?;
        self.writer.set_frame_dimension(area.width, area.height).map_err(failed)?;
        self.writer.set_frame_position(area.left, area.top).map_err(failed)?;
        self.writer.write_image_data(&data).map_err(failed)?;
        self.before = Some(image.clone());
        self.bytes.move_to(out)
    }

    fn finish(self: Box<Self>, out: &mut dyn Write) -> io::Result<()> {
        self.writer.finish().map_err(failed)?;
        self.bytes.move_to(out)
    }
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::IoError(error) => error,
        other => io::Error::other(other),
    }
}
