//! Cubic polynomials by their Bezier points, and their integrals.

use std::ops::{Add, Mul, Sub};

/// A value that can be interpolated.
pub(super) trait Blend:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<f64, Output = Self>
{
}

impl<T: Copy + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>> Blend for T {}

/// Positions and weights of the Gauss-Legendre quadrature with 3 points on [0, 1], exact up to degree 5.
pub(super) const GAUSS_3: [(f64, f64); 3] =
    [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Positions and weights of the Gauss-Legendre quadrature with 5 points on [0, 1].
pub(super) const GAUSS_5: [(f64, f64); 5] = [
    (0.046_910_077_030_668, 0.118_463_442_528_094_55),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_23),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_6, 0.239_314_335_249_683_23),
    (0.953_089_922_969_332, 0.118_463_442_528_094_55),
];

/// Returns the point of a cubic at `t`, from 0 to 1; the first and the last Bezier point exactly at the ends.
#[inline]
pub(super) fn point<T: Blend>(bezier: &[T; 4], t: f64) -> T {
    let s = 1.0 - t;
    let [a, b, c, d] = *bezier;
    a * (s * s * s) + b * (3.0 * s * s * t) + c * (3.0 * s * t * t) + d * (t * t * t)
}

/// Returns the first derivative of a cubic at `t`.
#[inline]
pub(super) fn velocity<T: Blend>(bezier: &[T; 4], t: f64) -> T {
    let s = 1.0 - t;
    let [a, b, c, d] = *bezier;
    (b - a) * (3.0 * s * s) + (c - b) * (6.0 * s * t) + (d - c) * (3.0 * t * t)
}

/// Returns the Bezier points of the straight line from `a` to `b`.
pub(super) fn line<T: Blend>(a: T, b: T) -> [T; 4] {
    [a, a + (b - a) * (1.0 / 3.0), a + (b - a) * (2.0 / 3.0), b]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_quadratures_are_exact_up_to_their_degree() {
        for degree in 0..=9 {
            let exact = 1.0 / f64::from(degree + 1);
            let five: f64 = GAUSS_5.iter().map(|(t, weight)| weight * t.powi(degree)).sum();
            assert!((five - exact).abs() < 1e-15, "{degree}");
            let three: f64 = GAUSS_3.iter().map(|(t, weight)| weight * t.powi(degree)).sum();
            assert_eq!((three - exact).abs() < 1e-15, degree <= 5, "{degree}");
        }
    }

    #[test]
    fn a_line_is_walked_at_constant_speed() {
        let line = line(2.0, 8.0);
        assert_eq!([point(&line, 0.0), point(&line, 1.0)], [2.0, 8.0]);
        assert!([0.1, 0.5, 0.9].iter().all(|t| (point(&line, *t) - 2.0 - 6.0 * t).abs() < 1e-12));
        assert!([0.0, 0.3, 1.0].iter().all(|t| (velocity(&line, *t) - 6.0).abs() < 1e-12));
    }
}
