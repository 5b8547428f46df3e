//! Textures and normal maps: image files on surfaces.

use super::tone;
use burgeon_base::error::{Error, Result};
use burgeon_base::srgb_byte;
use burgeon_scene::Material;
use burgeon_scene::image::{self, Image};
use glam::{Vec2, Vec3, Vec4};
use std::io::Read;

/// Maximum number of lookups along an elongated footprint.
const STRETCH: f32 = 8.0;

/// Images of a material.
#[derive(Debug, Default)]
pub(super) struct MaterialImages {
    /// Image that multiplies the base colour.
    pub texture: Option<SampledTexture>,
    /// Normal map, and the factor of its slopes.
    pub normals: Option<(SampledTexture, f32)>,
    /// Dirt map, which multiplies the colour by the second texture coordinates.
    pub dirt: Option<SampledTexture>,
}

/// Meaning of the pixels of an image.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum PixelMeaning {
    /// sRGB and opacity.
    Color,
    /// sRGB of an image on top of the texture.
    Dirt,
    /// Direction, each part from -1 to 1.
    Direction,
}

/// Mipmap: an image in several sizes.
#[derive(Debug)]
pub(super) struct SampledTexture {
    /// Levels, each half as large as the previous one, down to a single pixel, from the top row down.
    levels: Vec<TextureLevel>,
    meaning: PixelMeaning,
    /// Width and height (m) of one repetition.
    size: Vec2,
    /// Set if the texture has transparent pixels.
    holes: bool,
}

#[derive(Debug)]
struct TextureLevel {
    width: usize,
    height: usize,
    pixels: Vec<[u8; 4]>,
}

/// Loads the images of each material. Fails if a file cannot be read or a size is not positive.
pub(super) fn load(materials: &[Material]) -> Result<Vec<MaterialImages>> {
    let images = |material: &Material| {
        let texture = material.texture.as_ref();
        let texture = texture.map(|image| SampledTexture::read(image, PixelMeaning::Color)).transpose()?;
        let normals = material.normal_map.as_ref().map(|map| {
            let scale = if map.scale.is_finite() { map.scale } else { 1.0 };
            Ok((SampledTexture::read(&map.image, PixelMeaning::Direction)?, scale))
        });
        let dirt = material.dirt_map.as_ref();
        let dirt = dirt.map(|dirt| SampledTexture::read(&dirt.image, PixelMeaning::Dirt)).transpose()?;
        Ok(MaterialImages { texture, normals: normals.transpose()?, dirt })
    };
    materials.iter().map(images).collect()
}

impl SampledTexture {
    fn read(texture: &burgeon_scene::Texture, meaning: PixelMeaning) -> Result<Self> {
        let name = texture.path.display();
        let what = match meaning {
            PixelMeaning::Color => "texture",
            PixelMeaning::Dirt => "dirt map",
            PixelMeaning::Direction => "normal map",
        };
        if !texture.size.iter().all(|side| side.is_finite() && *side > 0.0) {
            let [width, height] = texture.size;
            return Err(Error::argument(format!("the {what} {name} measures {width} m by {height} m"))
                .help("give the width and height of one repetition in metres"));
        }
        let image = open(texture).map_err(|error| {
            Error::data(format!("the {what} {name} cannot be read: {}", error.message()))
                .help(format!("check the path; a {what} is a PNG or JPEG file"))
        })?;
        let pixels = image.pixels().to_vec();
        let holes = meaning == PixelMeaning::Color && pixels.iter().any(|pixel| pixel[3] < 255);
        let mut levels =
            vec![TextureLevel { width: image.width() as usize, height: image.height() as usize, pixels }];
        while let Some(next) = levels.last().and_then(|level| level.half(meaning)) {
            levels.push(next);
        }
        Ok(Self { levels, meaning, size: Vec2::new(texture.size[0] as f32, texture.size[1] as f32), holes })
    }

    /// Returns true if the texture has transparent pixels.
    pub(super) fn has_holes(&self) -> bool {
        self.holes
    }

    /// Returns the level whose pixels are as large as the given distances (m) between samples.
    pub(super) fn level_of(&self, beside: [Vec2; 2]) -> usize {
        let pixels = Vec2::new(self.levels[0].width as f32, self.levels[0].height as f32);
        let [across, along] = beside.map(|side| (side / self.size * pixels).length_squared());
        let level = 0.5 * across.min(along).max(1.0).log2();
        (level as usize).min(self.levels.len() - 1)
    }

    /// Returns the opacity at `uv` (m) in the image of this `level`.
    pub(super) fn alpha(&self, uv: Vec2, level: usize) -> f32 {
        self.levels[level].mix(uv / self.size, |pixel| Vec4::splat(f32::from(pixel[3]) / 255.0)).w
    }

    /// Returns the linear colour, or the direction, at `uv` (m), averaged over the footprint with the sides `across` and `along` (m) and
    /// weighted by opacity.
    ///
    /// The shorter side selects the level; several lookups cover the longer side.
    pub(super) fn color(&self, uv: Vec2, across: Vec2, along: Vec2) -> Vec3 {
        let pixels = Vec2::new(self.levels[0].width as f32, self.levels[0].height as f32);
        let (mut long, mut short) = (across / self.size, along / self.size);
        if (long * pixels).length_squared() < (short * pixels).length_squared() {
            (long, short) = (short, long);
        }
        let (length, breadth) = ((long * pixels).length(), (short * pixels).length());
        let lookups = (length / breadth.max(1.0)).ceil().clamp(1.0, STRETCH);
        let level = (length / lookups).max(breadth).max(1.0).log2().min(self.levels.len() as f32 - 1.0);
        let (near, part) = (level.floor() as usize, level.fract());
        let count = lookups as usize;
        let sum: Vec4 = (0..count)
            .map(|i| {
                let at = uv / self.size + long * ((i as f32 + 0.5) / lookups - 0.5);
                let fine = self.levels[near].value(at, self.meaning);
                if part > 0.0 {
                    let coarse = &self.levels[(near + 1).min(self.levels.len() - 1)];
                    fine.lerp(coarse.value(at, self.meaning), part)
                } else {
                    fine
                }
            })
            .sum();
        let last = &self.levels[self.levels.len() - 1];
        let sum = if sum.w > 0.0 { sum } else { last.value(uv, self.meaning) };
        sum.truncate() / sum.w.max(f32::MIN_POSITIVE)
    }
}

/// Decodes the image of a texture, from its content if it has no file.
fn open(texture: &burgeon_scene::Texture) -> Result<Image> {
    match &texture.content {
        Some(content) => image::decode(content),
        None => image::decode(&read(texture).map_err(Error::data)?),
    }
}

fn read(texture: &burgeon_scene::Texture) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    burgeon_base::files::open(&texture.path)?.0.read_to_end(&mut bytes)?;
    Ok(bytes)
}

impl PixelMeaning {
    /// Converts a pixel to a linear colour times its opacity, and the opacity; or to a direction, and 1.
    #[inline]
    fn decode(self, [red, green, blue, alpha]: [u8; 4]) -> Vec4 {
        match self {
            Self::Color | Self::Dirt => {
                let color = [red, green, blue].map(tone::decode);
                let alpha = f32::from(alpha) / 255.0;
                (Vec3::from_array(color) * alpha).extend(alpha)
            }
            // 0 and 255 are the ends, so that the middle is between 127 and 128.
            Self::Direction => {
                Vec3::from([red, green, blue].map(|byte| f32::from(byte) / 127.5 - 1.0)).extend(1.0)
            }
        }
    }

    /// Converts a value of [`decode`](Self::decode) to a pixel.
    fn encode(self, value: Vec4) -> [u8; 4] {
        let whole = value.truncate() / value.w.max(f32::MIN_POSITIVE);
        let [red, green, blue] = match self {
            // Transparent pixels do not contribute to the colour.
            Self::Color | Self::Dirt => whole.to_array().map(srgb_byte),
            Self::Direction => whole.to_array().map(|part| ((part + 1.0) * 127.5 + 0.5) as u8),
        };
        [red, green, blue, (value.w * 255.0 + 0.5) as u8]
    }
}

impl TextureLevel {
    /// Returns the value of the pixels at `at` (repetitions to the right and upwards), interpolated from the four
    /// nearest ones.
    fn value(&self, at: Vec2, meaning: PixelMeaning) -> Vec4 {
        self.mix(at, |pixel| meaning.decode(pixel))
    }

    /// Interpolates the results of `value` for the four pixels nearest to `at`.
    #[inline]
    fn mix(&self, at: Vec2, value: impl Fn([u8; 4]) -> Vec4) -> Vec4 {
        let part = at - at.floor();
        let (left, right, tx) = neighbours(part.x, self.width);
        let (top, bottom, ty) = neighbours(1.0 - part.y, self.height);
        let pixel = |x: usize, y: usize| value(self.pixels[y * self.width + x]);
        let upper = pixel(left, top).lerp(pixel(right, top), tx);
        let lower = pixel(left, bottom).lerp(pixel(right, bottom), tx);
        upper.lerp(lower, ty)
    }

    /// Returns the image at half the size; `None` for a single pixel.
    fn half(&self, meaning: PixelMeaning) -> Option<Self> {
        if self.width <= 1 && self.height <= 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let pixel = |i: usize| {
            let (x, y) = (i % width * 2, i / width * 2);
            let (right, bottom) = ((x + 1).min(self.width - 1), (y + 1).min(self.height - 1));
            let value = |x: usize, y: usize| meaning.decode(self.pixels[y * self.width + x]);
            let sum = value(x, y) + value(right, y) + value(x, bottom) + value(right, bottom);
            meaning.encode(sum / 4.0)
        };
        Some(Self { width, height, pixels: (0..width * height).map(pixel).collect() })
    }
}

/// Returns the two of `count` pixels whose centres are nearest to the fraction `part` of a repeated image, and the position, 0 to 1,
/// between them.
#[inline]
fn neighbours(part: f32, count: usize) -> (usize, usize, f32) {
    // A cast rounds down, since this is not negative.
    let along = part * count as f32 + 0.5;
    let before = (along as i32 as usize).min(count);
    let first = if before == 0 { count - 1 } else { before - 1 };
    let second = if before == count { 0 } else { before };
    (first, second, along - before as f32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    #[test]
    fn a_missing_file_is_an_error_that_names_it() {
        let texture = Some(burgeon_scene::Texture {
            path: PathBuf::from("brick/no such.png"),
            size: [1.0, 1.0],
            content: None,
        });
        let error = load(&[Material { texture, ..Material::default() }]).unwrap_err();
        assert!(error.to_string().contains("brick/no such.png"), "{error}");
    }

    #[test]
    fn neighbours_are_the_pixels_with_the_nearest_centres() {
        for count in [1, 2, 5] {
            for step in 0..=100 {
                let part = step as f32 / 100.0;
                let (first, second, between) = neighbours(part, count);
                let whole = count as f32;
                let exact = (part * whole - 0.5).floor();
                let wrap = |i: f32| i.rem_euclid(whole) as usize;
                assert_eq!((first, second), (wrap(exact), wrap(exact + 1.0)), "{part} of {count}");
                assert!((part * whole - 0.5 - exact - between).abs() < 1e-5);
            }
        }
    }

    #[test]
    fn v_points_up_and_an_image_repeats() {
        let pixels = vec![[255, 0, 0, 255], [255, 0, 0, 255], [0, 0, 255, 255], [0, 0, 255, 255]];
        let levels = vec![TextureLevel { width: 2, height: 2, pixels }];
        let (size, meaning) = (Vec2::new(2.0, 4.0), PixelMeaning::Color);
        let texture = SampledTexture { levels, meaning, size, holes: false };
        let color = |u, v| texture.color(Vec2::new(u, v), Vec2::ZERO, Vec2::ZERO);
        assert!(color(0.5, 3.0).x > 0.99 && color(0.5, 1.0).z > 0.99);
        assert!(color(-7.5, 7.0).x > 0.99 && color(4.5, -3.0).z > 0.99);
    }

    #[test]
    fn slopes_on_both_sides_are_flat_from_afar() {
        let slopes = vec![[255, 128, 128, 255], [0, 128, 128, 255]];
        let level = TextureLevel { width: 2, height: 1, pixels: slopes };
        let half = level.half(PixelMeaning::Direction).unwrap();
        let direction = PixelMeaning::Direction.decode(half.pixels[0]);
        assert!(direction.x.abs() < 0.01 && direction.y.abs() < 0.01, "{direction}");
    }
}
