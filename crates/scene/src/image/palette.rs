//! Reduction of an image's colours, so that its file is small.

use super::Image;

/// Image with a palette.
pub struct PaletteImage {
    /// Palette of at most 256 colours: red, green and blue.
    pub colors: Vec<[u8; 3]>,
    /// Index into `colors` for each pixel, row by row.
    pub pixels: Vec<u8>,
}

impl PaletteImage {
    /// Reduces `image` to at most `most` colours, from 1 to 256; the opacity is dropped.
    ///
    /// Method: Heckbert, "Color image quantization for frame buffer display", 1982. Each box of colours is cut at the
    /// median of its pixels, along its longest side.
    ///
    /// ```
    /// use burgeon_scene::image::{Image, PaletteImage};
    ///
    /// let shades = Image::from_fn(16, 1, |x, _| [x as u8, 100, 200, 255]);
    /// let reduced = PaletteImage::of(&shades, 4);
    /// assert_eq!((reduced.colors.len(), reduced.pixels.len()), (4, 16));
    /// assert_eq!(reduced.pixels[0], reduced.pixels[1]);
    /// ```
    pub fn of(image: &Image, most: usize) -> Self {
        let mut pixels: Vec<(usize, [u8; 3])> =
            image.pixels().iter().map(|pixel| [pixel[0], pixel[1], pixel[2]]).enumerate().collect();
        let mut boxes: Vec<std::ops::Range<usize>> = std::iter::once(0..pixels.len()).collect();
        while boxes.len() < most.clamp(1, 256) {
            let longest =
                boxes.iter().enumerate().map(|(number, range)| (side(&pixels[range.clone()]), number));
            // Cut the box with the longest side, weighted by its number of pixels.
            let cut = longest.filter(|((length, _), _)| *length > 0).max_by_key(|((length, _), number)| {
                let range = &boxes[*number];
                (usize::from(*length) * (range.len().ilog2() as usize + 1), usize::MAX - number)
            });
            let Some(((_, channel), number)) = cut else { break };
            let std::ops::Range { start, end } = boxes[number];
            let inner = &mut pixels[start..end];
            inner.sort_by_key(|(place, color)| (color[channel], *place));
            // Equal values stay together.
            let middle = inner[inner.len() / 2].1[channel];
            let below = inner.partition_point(|(_, color)| color[channel] < middle);
            let cut =
                if below > 0 { below } else { inner.partition_point(|(_, color)| color[channel] <= middle) };
            boxes[number] = start..start + cut;
            boxes.push(start + cut..end);
        }
        let mut found = Self { colors: Vec::new(), pixels: vec![0; pixels.len()] };
        for range in boxes.into_iter().filter(|range| !range.is_empty()) {
            let inner = &pixels[range];
            let mean = |channel: usize| {
                let sum: usize = inner.iter().map(|(_, color)| usize::from(color[channel])).sum();
                u8::try_from((sum + inner.len() / 2) / inner.len()).unwrap_or(u8::MAX)
            };
            let number = u8::try_from(found.colors.len()).unwrap_or(u8::MAX);
            found.colors.push([mean(0), mean(1), mean(2)]);
            inner.iter().for_each(|(place, _)| found.pixels[*place] = number);
        }
        found
    }
}

/// Returns the length of the longest side of the bounding box of some colours, and its channel.
fn side(pixels: &[(usize, [u8; 3])]) -> (u8, usize) {
    let length = |channel: usize| {
        let values = || pixels.iter().map(|(_, color)| color[channel]);
        values().max().unwrap_or(0) - values().min().unwrap_or(0)
    };
    (0..3)
        .map(|channel| (length(channel), channel))
        .max_by_key(|(length, channel)| (*length, 3 - channel))
        .unwrap_or((0, 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_image_of_few_colours_keeps_them_and_one_of_many_comes_near() {
        let few =
            Image::from_fn(8, 8, |x, y| [u8::try_from(x % 3).unwrap() * 100, 7, u8::from(y > 3) * 9, 255]);
        let found = PaletteImage::of(&few, 64);
        assert_eq!(found.colors.len(), 6);
        for (pixel, number) in few.pixels().iter().zip(&found.pixels) {
            assert_eq!(found.colors[usize::from(*number)], pixel[..3]);
        }
        let many = Image::from_fn(64, 64, |x, y| {
            [u8::try_from(x * 4).unwrap(), u8::try_from(y * 4).unwrap(), 90, 255]
        });
        let found = PaletteImage::of(&many, 256);
        assert_eq!(found.colors.len(), 256);
        let farthest = many.pixels().iter().zip(&found.pixels).flat_map(|(pixel, number)| {
            let color = found.colors[usize::from(*number)];
            [0, 1, 2].map(|channel| pixel[channel].abs_diff(color[channel]))
        });
        assert!(farthest.max().unwrap() <= 12);
        assert_eq!(PaletteImage::of(&many, 1).colors.len(), 1);
        assert!(PaletteImage::of(&Image::filled(0, 0, [0; 4]), 8).colors.is_empty());
    }
}
