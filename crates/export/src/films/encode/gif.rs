//! GIF with a palette for each frame, of the colours of the pixels that change.
//!
//! Specification: CompuServe, "Graphics Interchange Format, version 89a", 1990.

use super::changes::PixelArea;
use super::delay::centiseconds;
use super::palette::FramePalette;
use super::sink::EncodedBytes;
use crate::film_settings::FilmSettings;
use crate::films::encoder::FrameEncoder;
use burgeon_scene::image::Image;
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::borrow::Cow;
use std::io::{self, Write};

/// Maximum number of colours of a frame. One more index marks pixels that stay as they are.
const COLORS: usize = 255;

/// Opacity from which on a pixel is opaque, because a pixel of a GIF is opaque or transparent.
const OPAQUE: u8 = 128;

struct GifEncoder {
    encoder: Encoder<EncodedBytes>,
    bytes: EncodedBytes,
    settings: FilmSettings,
    number: u32,
    before: Option<Image>,
}

/// Creates an encoder of a GIF, which repeats for ever.
pub(in crate::films) fn gif(settings: &FilmSettings) -> io::Result<Box<dyn FrameEncoder>> {
    let bytes = EncodedBytes::default();
    let side = |side: u32| u16::try_from(side).map_err(io::Error::other);
    let (width, height) = (side(settings.size.0)?, side(settings.size.1)?);
    let mut encoder = Encoder::new(bytes.clone(), width, height, &[]).map_err(failed)?;
    encoder.set_repeat(Repeat::Infinite).map_err(failed)?;
    Ok(Box::new(GifEncoder { encoder, bytes, settings: *settings, number: 0, before: None }))
}

impl FrameEncoder for GifEncoder {
    fn add(&mut self, image: &Image, out: &mut dyn Write) -> io::Result<()> {
        // A transparent pixel cannot erase an earlier one, so a film with transparent pixels consists of whole frames.
        let before = self.before.take().filter(|_| !self.settings.transparent);
        let area =
            before.as_ref().map_or(PixelArea::whole(image), |before| PixelArea::changed(image, before));
        let shown = |(x, y): (u32, u32)| {
            let [red, green, blue, opacity] = image.pixel(x, y);
            let stays = before.as_ref().is_some_and(|before| before.pixel(x, y) == image.pixel(x, y));
            (!stays && opacity >= OPAQUE).then_some([red, green, blue])
        };
        let palette = FramePalette::of(area.pixels().filter_map(shown), COLORS);
        let clear = palette.colors.len() as u8;
        let pixels: Vec<u8> =
            area.pixels().map(|at| shown(at).map_or(clear, |color| palette.index(color))).collect();
        let mut colors = palette.colors.into_flattened();
        colors.extend([0; 3]);
        let keeps = if self.settings.transparent { DisposalMethod::Background } else { DisposalMethod::Keep };
        let frame = Frame {
            delay: centiseconds(&self.settings, self.number),
            dispose: keeps,
            transparent: Some(clear),
            left: area.left as u16,
            top: area.top as u16,
            width: area.width as u16,
            height: area.height as u16,
            palette: Some(colors),
            buffer: Cow::Owned(pixels),
            ..Frame::default()
        };
        self.encoder.write_frame(&frame).map_err(failed)?;
        self.number += 1;
        self.before = Some(image.clone());
        self.bytes.move_to(out)
    }

    fn finish(self: Box<Self>, out: &mut dyn Write) -> io::Result<()> {
        let Self { encoder, bytes, .. } = *self;
        // Dropping the encoder writes the end of the file.
        drop(encoder);
        bytes.move_to(out)
    }
}

fn failed(error: EncodingError) -> io::Error {
    match error {
        EncodingError::Io(error) => error,
        other => io::Error::other(other),
    }
}
