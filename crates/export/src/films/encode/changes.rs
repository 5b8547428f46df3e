//! Pixels that change from one frame to the next.

use burgeon_scene::image::Image;

/// Rectangle of pixels.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct PixelArea {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl PixelArea {
    /// Returns the area of all pixels of `image`.
    pub(super) fn whole(image: &Image) -> Self {
        Self { left: 0, top: 0, width: image.width(), height: image.height() }
    }

    /// Returns the smallest area that contains all pixels of `image` that differ from `before`; one pixel if none
    /// does, because a frame cannot be empty. Both images have the same size.
    pub(super) fn changed(image: &Image, before: &Image) -> Self {
        let (mut left, mut right) = (image.width(), 0);
        let (mut top, mut bottom) = (image.height(), 0);
        for y in 0..image.height() {
            let (row, old) = (image.row(y), before.row(y));
            if row == old {
                continue;
            }
            let differs = |(new, old): (&[u8; 4], &[u8; 4])| new != old;
            let first = row.iter().zip(old).position(differs).unwrap_or(0) as u32;
            let last = row.iter().zip(old).rposition(differs).unwrap_or(0) as u32;
            (left, right) = (left.min(first), right.max(last));
            (top, bottom) = (top.min(y), y);
        }
        if top > bottom || left > right {
            return Self { left: 0, top: 0, width: 1, height: 1 };
        }
        Self { left, top, width: right - left + 1, height: bottom - top + 1 }
    }

    /// Returns the columns and rows of the area, row by row.
    pub(super) fn pixels(self) -> impl Iterator<Item = (u32, u32)> {
        let row = move |y: u32| (self.left..self.left + self.width).map(move |x| (x, y));
        (self.top..self.top + self.height).flat_map(row)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_area_of_changes_is_as_small_as_possible() {
        let before = Image::filled(9, 7, [1, 2, 3, 255]);
        let with = |places: &[(u32, u32)]| {
            Image::from_fn(9, 7, |x, y| [if places.contains(&(x, y)) { 9 } else { 1 }, 2, 3, 255])
        };
        let area = |places: &[(u32, u32)]| {
            let PixelArea { left, top, width, height } = PixelArea::changed(&with(places), &before);
            [left, top, width, height]
        };
        assert_eq!(area(&[(2, 1), (6, 4)]), [2, 1, 5, 4]);
        assert_eq!(area(&[(8, 6)]), [8, 6, 1, 1]);
        assert_eq!(area(&[(0, 3), (8, 3)]), [0, 3, 9, 1]);
        assert_eq!(area(&[]), [0, 0, 1, 1]);
        assert_eq!(PixelArea::changed(&with(&[(2, 1), (6, 4)]), &before).pixels().count(), 20);
    }
}
