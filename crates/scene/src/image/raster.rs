//! Images with 8 bits per channel, and the formats of image files.

use bytemuck::cast_slice;

/// Pixels in rows from the top, each from the left: sRGB and straight alpha.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Image {
    width: u32,
    height: u32,
    pixels: Vec<[u8; 4]>,
}

impl Image {
    /// Creates an image of one colour.
    pub fn filled(width: u32, height: u32, color: [u8; 4]) -> Self {
        Self::from_fn(width, height, |_, _| color)
    }

    /// Creates an image from a function that returns the colour for each column and row.
    pub fn from_fn(width: u32, height: u32, color: impl Fn(u32, u32) -> [u8; 4]) -> Self {
        let row = |y: u32| (0..width).map(move |x| (x, y));
        let pixels = (0..height).flat_map(row).map(|(x, y)| color(x, y)).collect();
        Self { width, height, pixels }
    }

    /// Creates an image from `pixels`; `None` if their number does not match the size.
    pub fn from_pixels(width: u32, height: u32, pixels: Vec<[u8; 4]>) -> Option<Self> {
        let places = (width as usize).checked_mul(height as usize)?;
        (places == pixels.len()).then_some(Self { width, height, pixels })
    }

    /// Returns the number of columns.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Returns the number of rows.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// Returns all pixels, row by row.
    pub fn pixels(&self) -> &[[u8; 4]] {
        &self.pixels
    }

    /// Returns all channels of all pixels, row by row.
    pub fn bytes(&self) -> &[u8] {
        cast_slice(&self.pixels)
    }

    /// Returns the pixel in column `x` of row `y`. Panics if they are outside the image.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        self.row(y)[x as usize]
    }

    /// Returns the pixels of row `y`. Panics if the row is outside the image.
    pub fn row(&self, y: u32) -> &[[u8; 4]] {
        let width = self.width as usize;
        &self.pixels[y as usize * width..][..width]
    }

    /// Returns the pixels of row `y` for modification. Panics if the row is outside the image.
    pub fn row_mut(&mut self, y: u32) -> &mut [[u8; 4]] {
        let width = self.width as usize;
        &mut self.pixels[y as usize * width..][..width]
    }

    /// Copies `other` over this image with its upper left corner at `left`, `top`, as far as it fits.
    ///
    /// ```
    /// use burgeon_scene::image::Image;
    ///
    /// let mut sheet = Image::filled(4, 4, [0, 0, 0, 255]);
    /// sheet.put(&Image::filled(2, 2, [255, 0, 0, 255]), 3, 3);
    /// assert_eq!(sheet.pixel(3, 3), [255, 0, 0, 255]);
    /// assert_eq!(sheet.pixels().iter().filter(|pixel| pixel[0] > 0).count(), 1);
    /// ```
    pub fn put(&mut self, other: &Self, left: u32, top: u32) {
        for (y, row) in (top..self.height).zip(0..other.height) {
            let from = (left as usize).min(self.width as usize);
            let room = &mut self.row_mut(y)[from..];
            room.iter_mut().zip(other.row(row)).for_each(|(here, there)| *here = *there);
        }
    }
}

/// Format of image files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ImageKind {
    /// PNG.
    Png,
    /// JPEG.
    Jpeg,
}

impl ImageKind {
    /// Detects the format of a file with this content by its first bytes; `None` if it is neither PNG nor JPEG.
    ///
    /// ```
    /// use burgeon_scene::image::ImageKind;
    ///
    /// assert_eq!(ImageKind::of(b"\x89PNG\r\n\x1a\n...").map(ImageKind::extension), Some("png"));
    /// assert!(ImageKind::of(b"GIF89a").is_none());
    /// ```
    pub fn of(bytes: &[u8]) -> Option<Self> {
        match bytes {
            [0x89, b'P', b'N', b'G', b'\r', b'\n', 0x1a, b'\n', ..] => Some(Self::Png),
            [0xff, 0xd8, 0xff, ..] => Some(Self::Jpeg),
            _ => None,
        }
    }

    /// Returns `png` or `jpg`.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Png => "png",
            Self::Jpeg => "jpg",
        }
    }

    /// Returns the media type, such as `image/png`.
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
