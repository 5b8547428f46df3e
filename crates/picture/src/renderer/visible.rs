//! Visibility: the triangle that each sample of the camera sees.

use super::camera::Camera;
use super::coverage::Coverage;
use super::detail::RenderDetail;
use super::raster::RasterGrid;
use super::stage::Stage;
use glam::Vec3A;
use rayon::prelude::*;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// Value of a sample that sees no triangle.
const NOTHING: u64 = u64::MAX;

/// Samples of some rows of pixels.
pub(super) struct Visible {
    /// First row of pixels.
    pub first: usize,
    /// Depth in the upper half, the triangle's number in the lower half. The minimum is the front triangle; of two
    /// triangles at the same depth, the one with the lower number, independent of the order of threads.
    samples: Vec<AtomicU64>,
    /// Number of samples in a row.
    stride: usize,
    columns: usize,
    rows: usize,
    shifts: Vec<f64>,
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
        let stride = width * columns;
        let height = pixels.len() * rows;
        let mut samples = Vec::new();
        samples.resize_with(stride * height, || AtomicU64::new(NOTHING));
        let shifts = shifts(rows);
        let grid = RasterGrid { width: stride, rows: 0..height, shifts: &shifts };
        let scale = Vec3A::new(columns as f32, rows as f32, 1.0);
        let offset = Vec3A::new(0.0, (pixels.start * rows) as f32, 0.0);
        stage.batches().into_par_iter().for_each(|numbers| {
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
                grid.cover(triangle.corners, |y, xs, z, growth| {
                    let shift = shifts[y & (rows - 1)];
                    for (i, x) in xs.enumerate() {
                        let depth = (z + growth * i as f32).max(0.0);
                        let key = u64::from(depth.to_bits()) << 32 | u64::from(triangle.number);
                        let sample = &samples[y * stride + x];
                        if key < sample.load(Ordering::Relaxed) && coverage.covers(x, y, shift) {
                            sample.fetch_min(key, Ordering::Relaxed);
                        }
                    }
                });
            });
        });
        Self { first: pixels.start, samples, stride, columns, rows, shifts }
    }

    /// Calls `see` for each sample of a pixel, with the triangle's number, if any, and the sample's position (pixels);
    /// `y` counts from the top of the whole image.
    pub(super) fn each_sample(&self, x: usize, y: usize, mut see: impl FnMut(Option<u32>, [f32; 2])) {
        for row in 0..self.rows {
            let start = ((y - self.first) * self.rows + row) * self.stride + x * self.columns;
            let shift = self.shifts[row] as f32 / 256.0;
            for column in 0..self.columns {
                let key = self.samples[start + column].load(Ordering::Relaxed);
                let number = (key != NOTHING).then_some(key as u32);
                let place = [
                    x as f32 + (column as f32 + shift) / self.columns as f32,
                    y as f32 + (row as f32 + 0.5) / self.rows as f32,
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
    fn the_rows_of_a_pixel_are_shifted_differently() {
        assert_eq!(shifts(4), [32.0, 160.0, 96.0, 224.0]);
        assert_eq!(shifts(8).len(), 8);
    }
}
