//! Raster of heights in the coordinates of its file.

use super::missing::UndeclaredMarks;
use crate::heights::{SampleGrid, count};
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_spatial::Crs;

/// Heights without holes, in rows from north to south.
#[derive(Debug, Clone)]
pub struct Raster {
    /// Name in messages.
    pub name: String,
    /// Number of samples from west to east.
    pub columns: usize,
    /// Number of samples from north to south.
    pub rows: usize,
    /// Heights (m), row by row, each from west to east.
    pub heights: Vec<f32>,
    /// Positions of the samples.
    pub grid: SampleGrid,
    /// Coordinate system; without one, the coordinates are metres of the run.
    pub crs: Option<Crs>,
    /// Number of missing heights that were filled from the boundaries of their holes.
    pub filled: usize,
    /// Number of heights beyond the number in the header; they are ignored.
    pub surplus: usize,
    /// Heights treated as markers of missing values although the file does not declare them. They are included in
    /// `filled`.
    pub marks: UndeclaredMarks,
    /// Parts with heights, if the raster was joined from several files with gaps: first column and row, end column and
    /// row.
    pub parts: Vec<[usize; 4]>,
    /// Maximum difference (m) between files at the same position.
    pub seam: f32,
}

impl Raster {
    /// Creates a raster without holes from `heights` on `grid`.
    pub fn new(
        name: &str,
        [columns, rows]: [usize; 2],
        heights: Vec<f32>,
        grid: SampleGrid,
        crs: Option<Crs>,
    ) -> Self {
        let marks = UndeclaredMarks::default();
        let name = name.to_owned();
        Self {
            name,
            columns,
            rows,
            heights,
            grid,
            crs,
            filled: 0,
            surplus: 0,
            marks,
            parts: Vec::new(),
            seam: 0.0,
        }
    }

    /// Returns the outer edges: west, south, east and north. A sample represents the area up to half a step around it.
    pub fn bounds(&self) -> [f64; 4] {
        let SampleGrid { first, step } = self.grid;
        let (west, north) = (first[0] - step[0] / 2.0, first[1] + step[1] / 2.0);
        [west, north - step[1] * count(self.rows), west + step[0] * count(self.columns), north]
    }

    /// Returns the warnings about reading the raster.
    pub fn warnings(&self) -> Vec<Warning> {
        let Self { name, columns, rows, surplus, seam, .. } = self;
        let warning = |text: String, help: &str| Warning::new(WarningKind::Data, text).help(help);
        let what = if *surplus == 1 { "number" } else { "numbers" };
        let surplus = (*surplus > 0).then(|| {
            let text =
                format!("{name} has {surplus} {what} more than the {columns} x {rows} heights of its header");
            warning(text, "they were skipped; correct ncols and nrows")
        });
        let seam = (*seam > 0.0).then(|| {
            let text = format!("{name}: files differ by up to {seam} m in their common heights");
            warning(text, "the mean is used; download all files from one edition of one survey")
        });
        let shift = self.crs.as_ref().and_then(|crs| crs.shift_note(name));
        let shift = shift.map(|[text, help]| warning(text, &help));
        surplus.into_iter().chain(seam).chain(shift).collect()
    }

    /// Returns the warnings about missing heights, if any.
    pub fn missing_warnings(&self) -> Vec<Warning> {
        let Self { name, columns, rows, filled, marks, .. } = self;
        let warning = |text: String, help: &str| Warning::new(WarningKind::Data, text).help(help);
        let all = columns * rows;
        let filled = (*filled > 0).then(|| {
            let text = format!("{name}: filled {filled} of {all} missing heights from their surroundings");
            warning(text, "allow it with { fill = true }, or fill them in the file")
        });
        let marks = (marks.count > 0).then(|| {
            let (count, values) = (grouped(marks.count), marks.text());
            let (heights, counts) =
                if marks.count == 1 { ("height is", "counts") } else { ("heights are", "count") };
            let text = format!(
                "{name}: {count} {heights} {values} and {counts} as missing, though the file does not declare it"
            );
            warning(text, "declare the no-data value in the file: gdal_translate -a_nodata VALUE IN OUT.tif")
        });
        filled.into_iter().chain(marks).collect()
    }

    /// Returns true if the raster has heights at a column and a row, counted from the centre of the first sample. The
    /// areas outside the samples and the gaps between joined files have no heights. Positions up to `margin` (samples)
    /// outside also count.
    pub(super) fn covers(&self, column: f64, row: f64, margin: f64) -> bool {
        let covers = |[left, top, right, bottom]: [usize; 4]| {
            let margin = 0.5 + margin;
            column >= count(left) - margin
                && row >= count(top) - margin
                && column <= count(right) - 1.0 + margin
                && row <= count(bottom) - 1.0 + margin
        };
        match &*self.parts {
            [] => covers([0, 0, self.columns, self.rows]),
            parts => parts.iter().copied().any(covers),
        }
    }

    /// Returns the lowest and the highest height (m).
    pub fn range(&self) -> [f32; 2] {
        let low = self.heights.iter().copied().fold(f32::INFINITY, f32::min);
        [low, self.heights.iter().copied().fold(f32::NEG_INFINITY, f32::max)]
    }
}
