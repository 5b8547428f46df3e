//! Decoders of PNG and JPEG, and an encoder of PNG.

use std::io::Cursor;

use png::{BitDepth, ColorType, Compression, Filter, Transformations};
use zune_core::bytestream::ZCursor;
use zune_core::colorspace::ColorSpace;
use zune_core::options::DecoderOptions;
use zune_jpeg::JpegDecoder;

use super::{Image, ImageKind, PaletteImage};
use burgeon_base::error::{Error, Limit, Result};

/// Maximum memory (bytes) for the pixels of a file.
const MOST: usize = 512 << 20;

/// Succeeds, because images can be decoded and encoded.
pub fn check() -> Result<()> {
    Ok(())
}

/// Decodes a PNG or JPEG file with this content.
///
/// Fails if the content is neither, is damaged, or has more than 512 MB of pixels.
pub fn decode(bytes: &[u8]) -> Result<Image> {
    match ImageKind::of(bytes) {
        Some(ImageKind::Png) => decode_png(bytes),
        Some(ImageKind::Jpeg) => decode_jpeg(bytes),
        None => Err(Error::data("it is neither PNG nor JPEG")),
    }
}

/// Returns true if the pixels of a file have an alpha channel.
///
/// Fails if the content is neither PNG nor JPEG, or is damaged before its pixels.
pub fn has_alpha(bytes: &[u8]) -> Result<bool> {
    match ImageKind::of(bytes) {
        Some(ImageKind::Png) => {
            let form = open_png(bytes)?.output_color_type();
            Ok(matches!(form.0, ColorType::GrayscaleAlpha | ColorType::Rgba))
        }
        Some(ImageKind::Jpeg) => open_jpeg(bytes).map(|_| false),
        None => Err(Error::data("it is neither PNG nor JPEG")),
    }
}

/// Encodes `image` as a PNG file.
///
/// ```
/// use burgeon_scene::image::{Image, decode, encode};
///
/// let ramp = Image::from_fn(4, 2, |x, y| [x as u8 * 60, y as u8 * 200, 0, 255]);
/// assert_eq!(decode(&encode(&ramp)?)?.pixels(), ramp.pixels());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn encode(image: &Image) -> Result<Vec<u8>> {
    write([image.width(), image.height()], ColorType::Rgba, image.bytes())
}

/// Encodes the red, green and blue `channels` of an opaque image as a PNG file.
pub fn encode_opaque(width: u32, height: u32, channels: &[u8]) -> Result<Vec<u8>> {
    write([width, height], ColorType::Rgb, channels)
}

/// Encodes `image` as a small PNG file with at most `most` colours, from 1 to 256, without its opacity.
pub fn encode_indexed(image: &Image, most: usize) -> Result<Vec<u8>> {
    let failed = |error| Error::internal(format!("an image cannot be written as PNG: {error}"));
    let PaletteImage { colors, pixels } = PaletteImage::of(image, most);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, image.width(), image.height());
    encoder.set_color(ColorType::Indexed);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_palette(colors.into_flattened());
    encoder.set_compression(Compression::High);
    encoder.set_filter(Filter::NoFilter);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(&pixels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

fn write([width, height]: [u32; 2], color: ColorType, channels: &[u8]) -> Result<Vec<u8>> {
    let failed = |error| Error::internal(format!("an image cannot be written as PNG: {error}"));
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(color);
    encoder.set_depth(BitDepth::Eight);
    encoder.set_compression(Compression::Fast);
    encoder.set_filter(Filter::Adaptive);
    let mut writer = encoder.write_header().map_err(failed)?;
    writer.write_image_data(channels).map_err(failed)?;
    writer.finish().map_err(failed)?;
    Ok(bytes)
}

type PngReader<'a> = png::Reader<Cursor<&'a [u8]>>;

/// Opens a PNG; its samples will have 8 or 16 bits and no palette.
fn open_png(bytes: &[u8]) -> Result<PngReader<'_>> {
    let mut decoder = png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: MOST });
    decoder.set_transformations(Transformations::EXPAND);
    decoder.read_info().map_err(damaged)
}

fn decode_png(bytes: &[u8]) -> Result<Image> {
    let mut reader = open_png(bytes)?;
    let (width, height) = reader.info().size();
    let room = reader.output_buffer_size().filter(|room| *room <= MOST).ok_or_else(too_large)?;
    let mut samples = vec![0; room];
    reader.next_frame(&mut samples).map_err(damaged)?;
    let (color, depth) = reader.output_color_type();
    if depth == BitDepth::Sixteen {
        samples = samples.as_chunks().0.iter().map(|pair| narrow(u16::from_be_bytes(*pair))).collect();
    }
    image(width, height, color.samples(), &samples)
}

fn open_jpeg(bytes: &[u8]) -> Result<JpegDecoder<ZCursor<&[u8]>>> {
    let options =
        DecoderOptions::default().set_strict_mode(false).set_max_width(usize::MAX).set_max_height(usize::MAX);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(damaged)?;
    let grey = decoder.input_colorspace() == Some(ColorSpace::Luma);
    let color = if grey { ColorSpace::Luma } else { ColorSpace::RGB };
    decoder.set_options(options.jpeg_set_out_colorspace(color));
    Ok(decoder)
}

fn decode_jpeg(bytes: &[u8]) -> Result<Image> {
    let mut decoder = open_jpeg(bytes)?;
    decoder.output_buffer_size().filter(|room| *room <= MOST).ok_or_else(too_large)?;
    let samples = decoder.decode().map_err(damaged)?;
    let [width, height] = decoder.dimensions().map_or([0, 0], |(width, height)| [width, height]);
    let color = decoder.output_colorspace().map_or(0, |color| color.num_components());
    let side = |side: usize| u32::try_from(side).map_err(|_| too_large());
    image(side(width)?, side(height)?, color, &samples)
}

/// Creates an image from pixels with 1 to 4 samples: grey or colour, with or without alpha.
fn image(width: u32, height: u32, each: usize, samples: &[u8]) -> Result<Image> {
    let pixel = |samples: &[u8]| match *samples {
        [grey] => [grey, grey, grey, 255],
        [grey, alpha] => [grey, grey, grey, alpha],
        [red, green, blue] => [red, green, blue, 255],
        [red, green, blue, alpha, ..] => [red, green, blue, alpha],
        [] => [0; 4],
    };
    let pixels = samples.chunks_exact(each.max(1)).map(pixel).collect();
    Image::from_pixels(width, height, pixels).ok_or_else(|| damaged("it has too few pixels"))
}

/// Rounds a sample to 8 bits.
fn narrow(sample: u16) -> u8 {
    let nearest = (u32::from(sample) + 128) / 257;
    u8::try_from(nearest).unwrap_or(u8::MAX)
}

fn damaged(error: impl std::fmt::Display) -> Error {
    Error::data(error)
}

fn too_large() -> Error {
    Error::limit(Limit::Size, format!("it is larger than {} MB of pixels", MOST >> 20))
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::{DynamicImage, ImageFormat};

    /// Returns an image whose colours differ from pixel to pixel.
    fn many(width: u32, height: u32) -> Image {
        let byte = |number: u32| number.wrapping_mul(2_654_435_761).to_be_bytes()[0];
        Image::from_fn(width, height, |x, y| [0, 1, 2, 3].map(|channel| byte(x * 7 + y * 131 + channel * 17)))
    }

    fn theirs(image: &Image) -> image::RgbaImage {
        image::RgbaImage::from_raw(image.width(), image.height(), image.bytes().to_vec()).unwrap()
    }

    #[test]
    fn every_form_of_png_and_jpeg_is_read_as_another_decoder_reads_it() {
        let mut count = 0;
        for (width, height) in [(1, 1), (17, 5), (64, 33)] {
            let plain = DynamicImage::ImageRgba8(theirs(&many(width, height)));
            let png = [
                DynamicImage::ImageLuma8(plain.to_luma8()),
                DynamicImage::ImageLumaA8(plain.to_luma_alpha8()),
                DynamicImage::ImageRgb8(plain.to_rgb8()),
                DynamicImage::ImageLuma16(plain.to_luma16()),
                DynamicImage::ImageLumaA16(plain.to_luma_alpha16()),
                DynamicImage::ImageRgb16(plain.to_rgb16()),
                DynamicImage::ImageRgba16(plain.to_rgba16()),
                plain.clone(),
            ];
            let jpeg = [DynamicImage::ImageLuma8(plain.to_luma8()), DynamicImage::ImageRgb8(plain.to_rgb8())];
            let all = png.map(|image| (image, ImageFormat::Png)).into_iter();
            for (image, format) in all.chain(jpeg.map(|image| (image, ImageFormat::Jpeg))) {
                let mut file = Cursor::new(Vec::new());
                image.write_to(&mut file, format).unwrap();
                let bytes = file.into_inner();
                let expected = image::load_from_memory(&bytes).unwrap().to_rgba8();
                assert!(theirs(&decode(&bytes).unwrap()) == expected, "{:?} {format:?}", image.color());
                assert_eq!(has_alpha(&bytes).unwrap(), image.color().has_alpha(), "{:?}", image.color());
                count += 1;
            }
        }
        assert_eq!(count, 30);
    }

    #[test]
    fn a_palette_and_one_transparent_colour_are_read() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 4, 1);
        encoder.set_color(ColorType::Indexed);
        encoder.set_depth(BitDepth::Two);
        encoder.set_palette([9, 8, 7, 60, 50, 40].as_slice());
        encoder.set_trns([0].as_slice());
        encoder.write_header().unwrap().write_image_data(&[0b00_01_01_00]).unwrap();
        let image = decode(&bytes).unwrap();
        let (none, some) = ([9, 8, 7, 0], [60, 50, 40, 255]);
        assert_eq!(image.pixels(), [none, some, some, none]);
        assert!(has_alpha(&bytes).unwrap());
    }

    #[test]
    fn the_bytes_of_a_written_png_are_those_of_another_encoder_and_are_read_again() {
        let image = many(31, 20);
        let bytes = encode(&image).unwrap();
        let mut expected = Cursor::new(Vec::new());
        theirs(&image).write_to(&mut expected, ImageFormat::Png).unwrap();
        assert!(bytes == expected.into_inner());
        assert_eq!(decode(&bytes).unwrap(), image);
    }

    #[test]
    fn a_file_that_is_cut_short_anywhere_is_refused_or_read_and_never_a_panic() {
        let mut jpeg = Cursor::new(Vec::new());
        DynamicImage::ImageRgba8(theirs(&many(20, 20)))
            .to_rgb8()
            .write_to(&mut jpeg, ImageFormat::Jpeg)
            .unwrap();
        for bytes in [encode(&many(20, 20)).unwrap(), jpeg.into_inner()] {
            for end in 0..bytes.len() {
                let cut = &bytes[..end];
                let _ = has_alpha(cut);
                if let Ok(image) = decode(cut) {
                    assert_eq!(image.pixels().len(), 400);
                }
                let mut odd = bytes.clone();
                odd[end] ^= 0x55;
                let _ = decode(&odd);
            }
            assert!(decode(&bytes[..bytes.len() / 20]).is_err());
        }
    }
}
