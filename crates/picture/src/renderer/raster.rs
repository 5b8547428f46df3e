//! Rasterisation: the samples that a triangle covers.
//!
//! Corners are rounded to 1/256 of a sample, after which the computation is exact: triangles that share an edge leave
//! no gap and cover no sample twice.

use glam::Vec3A;
use std::ops::{Range, RangeInclusive};

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
        let rows = first as usize..=last as usize;
        let plane = DepthPlane { triangle, corners: [[ax, ay], [bx, by], [cx, cy]], area };
        if rightmost - leftmost < SMALL * FINE && highest - lowest < SMALL {
            return self.cover_small(&plane, [leftmost, rightmost], rows, row);
        }
        let edges = [
            RasterEdge::new(ax, ay, bx, by, turn),
            RasterEdge::new(bx, by, cx, cy, turn),
            RasterEdge::new(cx, cy, ax, ay, turn),
        ];

        let slope = plane.slope();
        let end = self.width as f64 - 1.0;
        let mut at = first * FINE + half;
        for y in rows {
            let shift = self.shifts[y & (self.shifts.len() - 1)];
            let (mut left, mut right) = (0.0_f64, end);
            for edge in &edges {
                edge.bound(at, shift, &mut left, &mut right);
            }
            let left = ceil(left);
            if left <= right {
                let z = plane.depth(slope, left * FINE + shift, at);
                row(y, left as usize..right as usize + 1, z, (slope[0] * FINE) as f32);
            }
            at += FINE;
        }
    }

    /// Calls `row` as [`cover`](Self::cover) does, for a triangle between two columns (1/256 sample) that is a few samples wide
    /// and high. Most triangles of large models are, and to test each sample is faster than to compute the bounds of rows.
    #[inline]
    fn cover_small(
        &self,
        plane: &DepthPlane,
        [leftmost, rightmost]: [f64; 2],
        rows: RangeInclusive<usize>,
        mut row: impl FnMut(usize, Range<usize>, f32, f32),
    ) {
        // Relative to the first corner, all numbers are small.
        let [[ax, ay], b, c] = plane.corners;
        let [bx, by, cx, cy] = [b[0] - ax, b[1] - ay, c[0] - ax, c[1] - ay].map(|offset| offset as i32);
        let turn = if plane.area > 0.0 { 1 } else { -1 };
        let edges = [[0, 0, bx, by], [bx, by, cx, cy], [cx, cy, 0, 0]].map(|edge| SmallEdge::new(edge, turn));
        let (leftmost, rightmost, end) = (leftmost as i64, rightmost as i64, self.width as i64 - 1);
        let (ax, ay) = (ax as i64, ay as i64);
        let mut slope = None;
        for y in rows {
            let shift = self.shifts[y & (self.shifts.len() - 1)];
            let whole = shift as i64;
            let left = ((leftmost - whole + 255) >> 8).max(0);
            let right = ((rightmost - whole) >> 8).min(end);
            let down = (((y as i64) << 8) + 128 - ay) as i32;
            let is_inside = |x: i64| {
                let along = ((x << 8) + whole - ax) as i32;
                edges.iter().all(|edge| edge.slope * along + edge.rise * down + edge.offset >= 0)
            };
            let Some(first) = (left..=right).find(|x| is_inside(*x)) else { continue };
            let mut last = first;
            while last < right && is_inside(last + 1) {
                last += 1;
            }
            let slope = *slope.get_or_insert_with(|| plane.slope());
            let z = plane.depth(slope, first as f64 * FINE + shift, y as f64 * FINE + FINE / 2.0);
            row(y, first as usize..last as usize + 1, z, (slope[0] * FINE) as f32);
        }
    }
}

/// Width and height (samples) below which a triangle is small.
const SMALL: f64 = 4.0;

/// Plane through the corners of a triangle.
struct DepthPlane {
    /// Corners with their third coordinate.
    triangle: [Vec3A; 3],
    /// First two coordinates (1/256 sample) of the corners.
    corners: [[f64; 2]; 3],
    /// Twice the area, negative if the corners are counter-clockwise.
    area: f64,
}

impl DepthPlane {
    /// Returns the increments of the third coordinate along the first two (1/256 sample).
    #[inline]
    fn slope(&self) -> [f64; 2] {
        let [a, b, c] = self.triangle;
        let [[ax, ay], [bx, by], [cx, cy]] = self.corners;
        let (dz1, dz2, part) = (f64::from(b.z - a.z), f64::from(c.z - a.z), 1.0 / self.area);
        let along = (dz1 * (cy - ay) - dz2 * (by - ay)) * part;
        [along, (dz2 * (bx - ax) - dz1 * (cx - ax)) * part]
    }

    /// Returns the third coordinate at `x`, `y` (1/256 sample), if it has this `slope`.
    #[inline]
    fn depth(&self, slope: [f64; 2], x: f64, y: f64) -> f32 {
        let [ax, ay] = self.corners[0];
        (f64::from(self.triangle[0].z) + slope[0] * (x - ax) + slope[1] * (y - ay)) as f32
    }
}

/// Line through two corners of a small triangle, as a [`RasterEdge`] relative to the first corner of the triangle.
struct SmallEdge {
    slope: i32,
    rise: i32,
    offset: i32,
}

impl SmallEdge {
    /// Creates the edge from the first to the second point of a triangle whose area has the sign `turn`.
    #[inline]
    fn new([x0, y0, x1, y1]: [i32; 4], turn: i32) -> Self {
        let (dx, dy) = ((x1 - x0) * turn, (y1 - y0) * turn);
        let own = i32::from(!(dy > 0 || (dy == 0 && dx > 0)));
        Self { slope: -dy, rise: dx, offset: dy * x0 - dx * y0 - own }
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
    use proptest::prelude::*;

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

    proptest! {
        #[test]
        fn a_small_triangle_covers_the_samples_inside(
            corners in proptest::array::uniform3([-1000_i64..6000, -1000_i64..6000]),
            near in proptest::array::uniform3([0_i64..1023, 0_i64..1023]),
            is_near in any::<bool>(),
        ) {
            // Corners in 1/256 samples, of which those near the first are a small triangle.
            let corners = if is_near { near.map(|[x, y]| [corners[0][0] + x, corners[0][1] + y]) } else { corners };
            let triangle = corners.map(|[x, y]| Vec3A::new(x as f32 / 256.0, y as f32 / 256.0, (x + y) as f32));
            let shifts = [32.0, 160.0, 96.0, 224.0];
            let grid = RasterGrid { width: 20, rows: 3..20, shifts: &shifts };
            let mut covered = Vec::new();
            grid.cover(triangle, |y, xs, z, growth| {
                for (i, x) in xs.enumerate() {
                    covered.push([x, y]);
                    let expected = x as f64 * 256.0 + shifts[y % 4] + y as f64 * 256.0 + 128.0;
                    assert!((f64::from(z + growth * i as f32) - expected).abs() < 0.1);
                }
            });
            let [a, b, c] = corners;
            let turn = |a: [i64; 2], b: [i64; 2], c: [i64; 2]| {
                (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
            };
            let area = turn(a, b, c);
            let mut expected = Vec::new();
            for (y, x) in (3..20_usize).flat_map(|y| (0..20_usize).map(move |x| (y, x))) {
                let at = [x as i64 * 256 + shifts[y % 4] as i64, y as i64 * 256 + 128];
                let is_inside = [(a, b), (b, c), (c, a)].iter().all(|(from, to)| {
                    let (side, up, along) = (turn(*from, *to, at) * area.signum(), to[1] - from[1], to[0] - from[0]);
                    let (up, along) = (up * area.signum(), along * area.signum());
                    side > 0 || (side == 0 && (up > 0 || (up == 0 && along > 0)))
                });
                if area != 0 && is_inside {
                    expected.push([x, y]);
                }
            }
            prop_assert_eq!(covered, expected);
        }
    }
}
