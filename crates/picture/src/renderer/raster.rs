//! Rasterisation: the samples that a triangle covers.
//!
//! Corners are rounded to 1/256 of a sample, after which the computation is exact: triangles that share an edge leave
//! no gap and cover no sample twice.

use glam::Vec3A;
use std::ops::Range;

/// Subdivisions of a sample to which coordinates are rounded.
const FINE: f64 = 256.0;

/// Positions of the samples.
#[derive(Debug, Clone)]
pub(super) struct RasterGrid<'a> {
    /// Number of samples in a row.
    pub width: usize,
    /// Range of rows to cover.
    pub rows: Range<usize>,
    /// Horizontal offsets (1/256 sample) of the samples of a row, used by the rows in turn. Their number is a power of
    /// two.
    pub shifts: &'a [f64],
}

impl RasterGrid<'_> {
    /// Calls `row` for each row that `triangle` covers: with the row, the range of samples in it, the third coordinate
    /// at the first sample and its increment per sample. The first two coordinates of a corner are in samples.
    ///
    /// The orientation of the triangle is ignored.
    #[inline]
    pub(super) fn cover(&self, triangle: [Vec3A; 3], mut row: impl FnMut(usize, Range<usize>, f32, f32)) {
        let [a, b, c] = triangle;
        let snap = |x: f32| round(f64::from(x) * FINE);
        let (ay, by, cy) = (snap(a.y), snap(b.y), snap(c.y));
        let half = FINE / 2.0;
        let lowest = ((ay.min(by).min(cy) - half) / FINE).max(self.rows.start as f64);
        let highest = ((ay.max(by).max(cy) - half) / FINE).min(self.rows.end as f64 - 1.0);
        if lowest > highest {
            return;
        }
        let (first, last) = (ceil(lowest), highest as i64);
        if first > highest {
            return;
        }
        let (ax, bx, cx) = (snap(a.x), snap(b.x), snap(c.x));
        // Most triangles of large models cover no sample.
        let (leftmost, rightmost) = (ax.min(bx).min(cx), ax.max(bx).max(cx));
        if let [shift] = self.shifts
            && ceil(((leftmost - shift) / FINE).max(0.0)) > (rightmost - shift) / FINE
        {
            return;
        }
        let area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        if area == 0.0 {
            return;
        }
        let turn = area.signum();
        let edges = [
            RasterEdge::new(ax, ay, bx, by, turn),
            RasterEdge::new(bx, by, cx, cy, turn),
            RasterEdge::new(cx, cy, ax, ay, turn),
        ];

        let (dz1, dz2, part) = (f64::from(b.z - a.z), f64::from(c.z - a.z), 1.0 / area);
        let along = (dz1 * (cy - ay) - dz2 * (by - ay)) * part;
        let down = (dz2 * (bx - ax) - dz1 * (cx - ax)) * part;
        let end = self.width as f64 - 1.0;
        let mut at = first * FINE + half;
        for y in first as usize..=last as usize {
            let shift = self.shifts[y & (self.shifts.len() - 1)];
            let (mut left, mut right) = (0.0_f64, end);
            for edge in &edges {
                edge.bound(at, shift, &mut left, &mut right);
            }
            let left = ceil(left);
            if left <= right {
                let x = left * FINE + shift;
                let z = f64::from(a.z) + along * (x - ax) + down * (at - ay);
                row(y, left as usize..right as usize + 1, z as f32, (along * FINE) as f32);
            }
            at += FINE;
        }
    }
}

/// Line through two corners. A point is inside if `slope * x + rise * y + offset >= 0`; all numbers are integers.
struct RasterEdge {
    slope: f64,
    rise: f64,
    offset: f64,
    /// -1 / (slope * FINE); for a horizontal edge [`ACROSS`].
    cut: f64,
    /// Offsets of the bounds of a row to the left and to the right, of which one is [`UNBOUNDED`].
    margins: [f64; 2],
}

/// Tolerance that makes `ceil` and `floor` exact. The quotients of the integers in question either are integers or
/// differ from integers by more than this value, and are computed with a smaller error.
const SLACK: f64 = 1e-10;
/// Margin of a bound that does not count.
const UNBOUNDED: f64 = 1e300;
/// Factor that makes a negative integer a bound to the left of all samples, even with the margin [`BEYOND`].
const ACROSS: f64 = 1e30;
/// Margin that makes zero a bound to the right of all samples.
const BEYOND: f64 = 1e20;

impl RasterEdge {
    /// Creates the edge from the first to the second point of a triangle whose area has the sign `turn`.
    #[inline]
    fn new(x0: f64, y0: f64, x1: f64, y1: f64, turn: f64) -> Self {
        let (dx, dy) = ((x1 - x0) * turn, (y1 - y0) * turn);
        // A sample on an edge belongs to only one of its two triangles, which traverse the edge in opposite directions.
        let own = if dy > 0.0 || (dy == 0.0 && dx > 0.0) { 0.0 } else { 1.0 };
        let (cut, margins) = if dy == 0.0 {
            (ACROSS, [-UNBOUNDED, BEYOND])
        } else if dy < 0.0 {
            (1.0 / (dy * FINE), [-SLACK, UNBOUNDED])
        } else {
            (1.0 / (dy * FINE), [-UNBOUNDED, SLACK])
        };
        Self { slope: -dy, rise: dx, offset: dy * x0 - dx * y0 - own, cut, margins }
    }

    /// Narrows the interval `left` to `right`, not rounded, of samples in the row at `y` to the samples inside.
    #[inline]
    fn bound(&self, y: f64, shift: f64, left: &mut f64, right: &mut f64) {
        let place = (self.rise * y + self.offset + self.slope * shift) * self.cut;
        let (least, most) = (place + self.margins[0], place + self.margins[1]);
        // Rows are short, so comparisons that are single instructions are faster than branches.
        *left = if least > *left { least } else { *left };
        *right = if most < *right { most } else { *right };
    }
}

/// Rounds to the nearest integer; `x` must be less than 2^51.
#[inline]
fn round(x: f64) -> f64 {
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    (x + WHOLE) - WHOLE
}

/// Rounds `x` up to an integer; `x` must not be negative, and be less than 2^51 or greater than all samples.
#[inline]
fn ceil(x: f64) -> f64 {
    let near = round(x);
    if near < x { near + 1.0 } else { near }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn counts(triangles: &[[Vec3A; 3]], shifts: &[f64]) -> Vec<u32> {
        let grid = RasterGrid { width: 40, rows: 0..40, shifts };
        let mut counts = vec![0; 1600];
        for triangle in triangles {
            grid.cover(*triangle, |y, xs, _, _| xs.for_each(|x| counts[y * 40 + x] += 1));
        }
        counts
    }

    #[test]
    fn a_fan_of_triangles_covers_each_sample_once() {
        let rim: Vec<Vec3A> = (0..37)
            .map(|i| (f64::from(i) * std::f64::consts::TAU / 37.0).sin_cos())
            .map(|(sin, cos)| Vec3A::new(20.0 + 18.0 * cos as f32, 20.0 + 18.0 * sin as f32, 0.0))
            .collect();
        let center = Vec3A::new(20.5, 20.5, 0.0);
        let fan: Vec<_> = (0..37).map(|i| [center, rim[i], rim[(i + 1) % 37]]).collect();
        for shifts in [&[128.0][..], &[16.0, 144.0, 80.0, 208.0][..]] {
            let counts = counts(&fan, shifts);
            assert!(counts.iter().all(|count| *count <= 1));
            let covered: u32 = counts.iter().sum();
            assert!((f64::from(covered) - 1013.0).abs() < 12.0, "{covered} samples for 1013 of area");
        }
    }

    #[test]
    fn the_third_coordinate_follows_the_plane() {
        let plane = |x: f32, y: f32| Vec3A::new(x, y, 0.25 * x - 0.5 * y + 3.0);
        let grid = RasterGrid { width: 40, rows: 0..40, shifts: &[128.0] };
        let mut seen = 0;
        grid.cover([plane(1.0, 2.0), plane(35.0, 7.0), plane(11.0, 38.0)], |y, xs, z, growth| {
            for (i, x) in xs.enumerate() {
                let expected = plane(x as f32 + 0.5, y as f32 + 0.5).z;
                assert!((z + growth * i as f32 - expected).abs() < 1e-3);
                seen += 1;
            }
        });
        assert!(seen > 500);
    }
}
