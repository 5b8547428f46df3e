//! Contact sheet: renders in a grid, each with its label.

use super::letters::{LINE, draw, fitted, width, wrapped};
use burgeon_base::error::{Error, Limit, Result};
use burgeon_picture::{Background, Picture};
use burgeon_scene::image::Image;

/// Preferred ratio of a sheet's width to its height.
const ASPECT: f64 = 1.5;

/// Division of a sheet into cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SheetLayout {
    /// Number of cells in a row.
    pub columns: usize,
    /// Number of rows.
    pub rows: usize,
    /// Width and height of a cell's render (pixels).
    pub cell: [u32; 2],
    /// Width and height of the sheet (pixels).
    pub size: [u32; 2],
    margin: u32,
    letters: f32,
}

impl SheetLayout {
    /// Divides a sheet for `count` cells with the size of `picture` into `columns`, or into a suitable number of
    /// columns.
    ///
    /// Fails if the sheet would exceed the maximum size of an image.
    ///
    /// ```
    /// use burgeon_live::variations::SheetLayout;
    /// use burgeon_picture::Picture;
    ///
    /// let picture = Picture { width: 320, height: 240, ..Picture::default() };
    /// let layout = SheetLayout::new(7, Some(3), &picture)?;
    /// assert_eq!((layout.columns, layout.rows, layout.cell), (3, 3, [320, 240]));
    /// assert!(layout.size[0] >= 3 * 320);
    /// assert!(SheetLayout::new(100_000, None, &picture).is_err(), "the sheet is too large");
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(count: usize, columns: Option<usize>, picture: &Picture) -> Result<Self> {
        let cell = [picture.width, picture.height];
        let margin = (cell[0].min(cell[1]) / 24).clamp(4, 40);
        let letters = (f64::from(cell[0].min(cell[1])) / 22.0).clamp(8.0, 40.0) as f32;
        let divided = |columns: usize| {
            let columns = columns.clamp(1, count.max(1));
            let rows = count.div_ceil(columns);
            let label = (letters * (LINE + 1.5)).ceil() as u64;
            let wide = columns as u64 * u64::from(cell[0] + margin) + u64::from(margin);
            let high = rows as u64 * (u64::from(cell[1]) + label) + 2 * u64::from(margin);
            (columns, rows, wide, high)
        };
        let (columns, rows, wide, high) = match columns {
            Some(columns) => divided(columns),
            None => {
                let cost = |columns: &usize| {
                    let (columns, rows, wide, high) = divided(*columns);
                    let empty = (columns * rows - count) as f64 / count.max(1) as f64;
                    (wide as f64 / high as f64 / ASPECT).ln().abs() + 3.0 * empty
                };
                let best = (1..=count.max(1)).min_by(|a, b| cost(a).total_cmp(&cost(b)));
                divided(best.unwrap_or(1))
            }
        };
        let size = [wide, high].map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        if size.iter().any(|side| *side > Picture::LARGEST) {
            return Err(Error::limit(
                Limit::Size,
                format!(
                    "the sheet would be {wide} x {high} pixels, more than {} on a side",
                    Picture::LARGEST
                ),
            )
            .help("use smaller cells, --size WIDTHxHEIGHT, or fewer of them"));
        }
        Ok(Self { columns, rows, cell, size, margin, letters })
    }

    /// Returns the upper left corner of cell `number`.
    fn corner(&self, number: usize) -> [u32; 2] {
        let (column, row) = ((number % self.columns) as u32, (number / self.columns) as u32);
        let high = (self.size[1] - 2 * self.margin) / self.rows.max(1) as u32;
        [self.margin + column * (self.cell[0] + self.margin), self.margin + row * high]
    }
}

/// Combines the `cells` in one sheet: labels, and renders or error messages.
pub fn sheet<'a>(
    layout: &SheetLayout,
    background: Background,
    cells: impl IntoIterator<Item = (&'a str, Result<&'a Image, &'a str>)>,
) -> Image {
    let (paper, ink, wrong) = match background {
        Background::Light | Background::Sky => ([246, 245, 243, 255], [58, 56, 54], [168, 44, 30]),
        Background::Dark => ([22, 23, 25, 255], [204, 206, 210], [240, 128, 108]),
        Background::Clear => ([0, 0, 0, 0], [120, 120, 120], [200, 80, 60]),
    };
    let mut image = Image::filled(layout.size[0], layout.size[1], paper);
    let letters = layout.letters;
    let [wide, high] = layout.cell.map(|side| side as f32);
    for (number, (label, content)) in cells.into_iter().enumerate() {
        let [left, top] = layout.corner(number);
        let (x, y) = (left as f32, top as f32);
        match content {
            Ok(picture) => image.put(picture, left, top),
            Err(message) => {
                let small = (letters * 0.85).max(7.0);
                let lines = wrapped(message, small, wide - 2.0 * letters);
                let fit = ((high - letters) / (small * 1.75)).max(1.0) as usize;
                let first =
                    y + ((high - small * 1.75 * lines.len().min(fit) as f32) / 2.0).max(letters / 2.0);
                for (line, text) in lines.iter().take(fit).enumerate() {
                    draw(&mut image, text, [x + letters, first + small * 1.75 * line as f32], small, wrong);
                }
            }
        }
        let label = fitted(label, letters, wide);
        let from = x + (wide - width(&label, letters)) / 2.0;
        draw(&mut image, &label, [from.round(), (y + high + letters * 0.6).round()], letters, ink);
    }
    image
}

#[cfg(test)]
mod tests {
    use super::*;

    fn picture(width: u32, height: u32) -> Picture {
        Picture { width, height, ..Picture::default() }
    }

    #[test]
    fn columns_make_a_sheet_that_is_full_and_not_too_long() {
        let columns = |count| SheetLayout::new(count, None, &picture(320, 320)).unwrap().columns;
        assert_eq!([1, 2, 4, 6, 9, 10, 12, 16].map(columns), [1, 2, 2, 3, 3, 5, 4, 4]);
        let given = SheetLayout::new(10, Some(4), &picture(100, 50)).unwrap();
        assert_eq!((given.columns, given.rows), (4, 3));
        assert_eq!(SheetLayout::new(2, Some(9), &picture(100, 50)).unwrap().columns, 2);
    }

    #[test]
    fn a_sheet_beyond_the_largest_picture_is_refused() {
        let error = SheetLayout::new(256, Some(256), &picture(320, 320)).unwrap_err();
        assert!(error.message().starts_with("the sheet would be "), "{error}");
        assert!(SheetLayout::new(256, None, &picture(16384, 16384)).is_err());
        assert!(SheetLayout::new(256, None, &picture(1, 1)).is_ok());
    }

    #[test]
    fn every_cell_is_within_the_sheet_and_touches_no_other() {
        let layout = SheetLayout::new(7, Some(3), &picture(60, 40)).unwrap();
        let red = Image::filled(60, 40, [255, 0, 0, 255]);
        let cells = (0..7).map(|_| ("", Ok(&red)));
        let image = sheet(&layout, Background::Light, cells);
        assert_eq!([image.width(), image.height()], layout.size);
        assert_eq!(image.pixels().iter().filter(|pixel| **pixel == [255, 0, 0, 255]).count(), 7 * 60 * 40);
    }

    #[test]
    fn a_cell_without_a_picture_says_why() {
        let layout = SheetLayout::new(1, None, &picture(120, 90)).unwrap();
        let long = "a very long reason ".repeat(60);
        for message in ["s.lua:3: no", &long] {
            let image = sheet(&layout, Background::Clear, [("seed 1", Err(message))]);
            assert!(image.pixels().iter().any(|pixel| pixel[0] > 190 && pixel[3] > 200));
        }
    }
}
