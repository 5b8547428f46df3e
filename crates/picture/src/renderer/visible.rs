//! Visibility: the triangle that each sample of the camera sees.

use super::camera::Camera;
use super::coverage::Coverage;
use super::detail::RenderDetail;
use super::raster::RasterGrid;
use super::stage::Stage;
use burgeon_base::memory::make_exact_room;
use glam::Vec3A;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Value of a sample that sees no triangle.
const NOTHING: u64 = u64::MAX;

/// Number of covered samples of small triangles that are compared together, so that the waits for memory overlap.
const PENDING: usize = 1024;

/// Samples of some rows of pixels.
pub(super) struct Visible {
    /// First row of pixels.
    pub first: usize,
    /// Depth in the upper half, the triangle's number in the lower half. The minimum is the front triangle; of two
    /// triangles at the same depth, the one with the lower number, independent of the order of threads.
    ///
    /// Pixel by pixel, because the triangles of large models are small: those of a pixel then share a line of the cache.
    samples: Vec<AtomicU64>,
    layout: SampleLayout,
    shifts: Vec<f64>,
}

/// Order of the samples in memory. The numbers of columns and rows of samples in a pixel are powers of two.
#[derive(Debug, Clone, Copy)]
struct SampleLayout {
    /// Number of pixels in a row.
    width: usize,
    columns: usize,
    rows: usize,
}

impl SampleLayout {
    /// Returns the index of the first sample of the pixel at `x`, `y`.
    #[inline]
    fn pixel(&self, x: usize, y: usize) -> usize {
        (y * self.width + x) * self.columns * self.rows
    }

    /// Returns the index of sample 0 in row `y` of samples.
    #[inline]
    fn row(&self, y: usize) -> usize {
        self.pixel(0, y / self.rows) + y % self.rows * self.columns
    }
}

impl Visible {
    /// Draws `stage` in the rows `pixels` of an image that is `width` pixels wide.
    pub(super) fn new(
        stage: &Stage,
        camera: &Camera,
        detail: &RenderDetail,
        width: usize,
        pixels: Range<usize>,
    ) -> Self {
        let (columns, rows) = (detail.columns, detail.rows);
        let layout = SampleLayout { width, columns, rows };
        let height = pixels.len() * rows;
        let mut samples = Vec::new();
        make_exact_room(&mut samples, width * columns * height);
        samples.resize_with(width * columns * height, || AtomicU64::new(NOTHING));
        let shifts = shifts(rows);
        let grid = RasterGrid { width: width * columns, rows: 0..height, shifts: &shifts };
        // The index of a sample within its row: as many bits as a pixel has columns stay, and the others move up.
        let (column_bits, row_bits) = (columns.trailing_zeros(), rows.trailing_zeros());
        let in_row = move |x: usize| ((x >> column_bits) << (column_bits + row_bits)) + (x & (columns - 1));
        let scale = Vec3A::new(columns as f32, rows as f32, 1.0);
        let offset = Vec3A::new(0.0, (pixels.start * rows) as f32, 0.0);
        let flush = |pending: &mut Vec<(usize, u64)>| {
            for (place, key) in pending.drain(..) {
                let sample = &samples[place];
                if key < sample.load(Ordering::Relaxed) {
                    sample.fetch_min(key, Ordering::Relaxed);
                }
            }
        };
        stage.batches().into_par_iter().for_each_init(Vec::new, |pending, numbers| {
            let project = |point| camera.project(point) * scale - offset;
            let near = Some([camera.near_plane(), camera.slope()]);
            stage.each_triangle(numbers, &camera.view, project, near, |draw, triangle| {
                let [a, b, c] = triangle.corners;
                let turn = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
                // Front faces are clockwise in the image, whose y axis points down, unless they are mirrored.
                if ((turn > 0.0) != draw.mirrored) && !draw.double_sided {
                    return;
                }
                let coverage = Coverage::of(draw, &triangle, [columns, rows], !camera.is_parallel());
                let is_full = coverage.is_full();
                grid.cover(triangle.corners, |y, xs, z, growth| {
                    let shift = shifts[y & (rows - 1)];
                    let row = layout.row(y);
                    for (i, x) in xs.enumerate() {
                        let depth = (z + growth * i as f32).max(0.0);
                        let key = u64::from(depth.to_bits()) << 32 | u64::from(triangle.number);
                        let place = row + in_row(x);
                        if is_full {
                            pending.push((place, key));
                            continue;
                        }
                        let sample = &samples[place];
                        if key < sample.load(Ordering::Relaxed) && coverage.covers(x, y, shift) {
                            sample.fetch_min(key, Ordering::Relaxed);
                        }
                    }
                });
                if pending.len() > PENDING {
                    flush(pending);
                }
            });
            flush(pending);
        });
        Self { first: pixels.start, samples, layout, shifts }
    }

    /// Calls `see` for each sample of a pixel, with the triangle's number, if any, and the sample's position (pixels);
    /// `y` counts from the top of the whole image.
    pub(super) fn each_sample(&self, x: usize, y: usize, mut see: impl FnMut(Option<u32>, [f32; 2])) {
        let SampleLayout { columns, rows, .. } = self.layout;
        let start = self.layout.pixel(x, y - self.first);
        let samples = &self.samples[start..start + columns * rows];
        for (row, samples) in samples.chunks_exact(columns).enumerate() {
            let shift = self.shifts[row] as f32 / 256.0;
            for (column, sample) in samples.iter().enumerate() {
                let key = sample.load(Ordering::Relaxed);
                let number = (key != NOTHING).then_some(key as u32);
                let place = [
                    x as f32 + (column as f32 + shift) / columns as f32,
                    y as f32 + (row as f32 + 0.5) / rows as f32,
                ];
                see(number, place);
            }
        }
    }
}

/// Returns the offset (1/256 sample) of each of `rows` rows, chosen so that a steep edge crosses one sample at a time.
/// The order is that of reversed bits, which keeps neighbouring rows apart.
fn shifts(rows: usize) -> Vec<f64> {
    let bits = rows.trailing_zeros();
    let reversed = |row: usize| (row as u32).reverse_bits().checked_shr(32 - bits).unwrap_or(0);
    (0..rows).map(|row| ((f64::from(reversed(row)) + 0.5) * 256.0 / rows as f64).round()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_sample_has_its_own_place_and_those_of_a_pixel_are_together() {
        let layout = SampleLayout { width: 5, columns: 2, rows: 4 };
        let mut places = Vec::new();
        for y in 0..3 * 4 {
            for x in 0..5 * 2 {
                let place = layout.row(y) + (x >> 1) * 8 + (x & 1);
                let first = layout.pixel(x / 2, y / 4);
                assert!((first..first + 8).contains(&place), "{place} of the pixel from {first} on");
                places.push(place);
            }
        }
        places.sort_unstable();
        assert_eq!(places, (0..5 * 3 * 8).collect::<Vec<_>>());
    }

    #[test]
    fn the_rows_of_a_pixel_are_shifted_differently() {
        assert_eq!(shifts(4), [32.0, 160.0, 96.0, 224.0]);
        assert_eq!(shifts(8).len(), 8);
    }
}
