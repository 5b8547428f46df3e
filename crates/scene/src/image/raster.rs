//! Images of 8 bits a channel, and which kinds of files they come in.

use bytemuck::cast_slice;

/// Pixels in rows from the top, each from the left: sRGB, and straight opacity.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

impl Image {
    /// An image of one colour.
    pub fn filled(width: u32, height: u32, color: [u8; 4]) -> Self {
        Self::from_fn(width, height, |_, _| color)
    }

    /// An image of the colours that `color` gives for each column and row.
    pub fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 4]) -> Self {
        let row = |y: u32| (0..width).map(move |x| (x, y));
        let pixels = (0..height).flat_map(row).map(|(x, y)| color(x, y)).collect();
        Self { width, height, pixels }
    }

    /// An image of `pixels`; `None` if they are not as many as it has places.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<[u8; 4]>) -> Option<Self> {
        let places = (width as usize).checked_mul(height as usize)?;
        (places == pixels.len()).then_some(Self { width, height, pixels })
    }

    /// How many columns it has.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// How many rows it has.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// All pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    /// All channels of all pixels, row by row.
    pub fn bytes(&self) -> &[u8] {
        cast_slice(&self.pixels)
    }

    /// The pixel in column `x` of row `y`, which have to be within the image.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.row(y)[x as usize]
    }

    /// The pixels of row `y`, which has to be within the image.
    pub fn row(&self, y: u32) -> &[[u8; 4]] {
        let width = self.width as usize;
        &self.pixels[y as usize * width..][..width]
    }

    /// The same, to be changed.
    pub fn row_mut(&mut self, y: u32) -> &mut [[u8; 4]] {
        let width = self.width as usize;
        &mut self.pixels[y as usize * width..][..width]
    }

    /// Puts as much of `other` as there is room for over this, with its upper left corner at `left`, `top`.
    pub fn put(&mut self, other: &Self, left: u32, top: u32) {
        for (y, row) in (top..self.height).zip(0..other.height) {
            let from = (left as usize).min(self.width as usize);
            let room = &mut self.row_mut(y)[from..];
            room.iter_mut().zip(other.row(row)).for_each(|(here, there)| *here = *there);
        }
    }
}

/// A format of image files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageKind {
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
}

impl ImageKind {
    /// What a file with this content is by its first bytes; `None` if it is neither PNG nor JPEG.
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            _ => None,
        }
    }

    /// `png` or `jpg`.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
        }
    }

    /// The media type, such as `image/png`.
    pub fn media_type(self) -> &'static str {
        match self {
            Self::Png => "image/png",
            Self::Jpeg => "image/jpeg",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_is_put_over_another_as_far_as_there_is_room() {
        let mut image = Image::filled(4, 3, [0; 4]);
        let red = Image::filled(2, 2, [255, 0, 0, 255]);
        image.put(&red, 3, 2);
        image.put(&red, 9, 0);
        image.put(&red, 0, 9);
        let seen: Vec<usize> = (0..12).filter(|index| image.pixels()[*index] == [255, 0, 0, 255]).collect();
        assert_eq!(seen, [11]);
        assert_eq!(Image::from_pixels(2, 2, vec![[0; 4]; 3]), None);
    }
}
