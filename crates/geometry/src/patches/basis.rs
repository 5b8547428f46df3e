//! B-spline basis functions over one direction of a surface.

use burgeon_base::error::{Error, Result};

/// Maximum degree.
pub(super) const MOST_DEGREE: usize = 7;

/// Values and derivatives of the basis functions that are not zero at one parameter.
pub(super) struct BasisValues {
    /// Index of the first function that is not zero.
    pub(super) first: usize,
    /// Values of `degree` + 1 functions.
    pub(super) values: [f64; MOST_DEGREE + 1],
    /// First derivatives of these functions.
    pub(super) slopes: [f64; MOST_DEGREE + 1],
}

/// Degree and knots of one direction.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Basis {
    pub(super) degree: usize,
    knots: Vec<f64>,
}

impl Basis {
    /// Creates the uniform basis for `count` control points, which begins at the first point and ends at the last. A
    /// spline of few points has a lower degree.
    pub(super) fn uniform(count: usize, degree: usize) -> Self {
        let degree = degree.min(count - 1);
        let last = (count - degree) as f64;
        let knots = (0..count + degree + 1).map(|i| (i as f64 - degree as f64).clamp(0.0, last));
        Self { degree, knots: knots.collect() }
    }

    /// Creates the basis of cubic Bezier patches for `count` control points: 4, 7, 10 and so on.
    pub(super) fn bezier(count: usize) -> Self {
        let last = ((count - 1) / 3) as f64;
        let knots = (0..count + 4).map(|i| ((i as f64 - 1.0) / 3.0).floor().clamp(0.0, last));
        Self { degree: 3, knots: knots.collect() }
    }

    /// Creates the basis with these `knots` for `count` control points. `name` is that of the knots in messages.
    pub(super) fn with_knots(name: &str, knots: &[f64], count: usize, degree: usize) -> Result<Self> {
        let wanted = count + degree + 1;
        if knots.len() != wanted {
            let message = format!("{name} has {} numbers, not {wanted}", knots.len());
            return Err(Error::argument(message).help(format!(
                "give the number of points ({count}) plus the degree ({degree}) plus 1, or omit {name}"
            )));
        }
        if knots.iter().any(|knot| !knot.is_finite()) || knots.windows(2).any(|pair| pair[0] > pair[1]) {
            return Err(Error::argument(format!("{name} must be finite numbers that do not decrease"))
                .help("such as { 0, 0, 0, 0, 1, 2, 2, 2, 2 }"));
        }
        let repeated = knots.windows(degree + 2).find(|run| run[0] >= run[degree + 1]);
        if let Some(run) = repeated {
            let message = format!("{name} repeats {} more than {} times", run[0], degree + 1);
            return Err(Error::argument(message).help("remove repetitions, or raise the degree"));
        }
        let basis = Self { degree, knots: knots.to_vec() };
        let [from, to] = basis.domain();
        if from >= to {
            return Err(Error::argument(format!("{name} spans no interval"))
                .help("the knots before and after the inner ones must differ"));
        }
        Ok(basis)
    }

    /// Returns the approximate memory (bytes).
    pub(super) fn memory(&self) -> usize {
        self.knots.len() * size_of::<f64>()
    }

    /// Returns the knots.
    pub(super) fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Returns the first and the last parameter.
    pub(super) fn domain(&self) -> [f64; 2] {
        [self.knots[self.degree], self.knots[self.knots.len() - 1 - self.degree]]
    }

    /// Returns the different knots of the domain, mapped to 0 to 1: the ends of the patches.
    pub(super) fn breaks(&self) -> Vec<f64> {
        let [from, to] = self.domain();
        let inner = &self.knots[self.degree..self.knots.len() - self.degree];
        let mut breaks: Vec<f64> = inner.iter().map(|knot| (knot - from) / (to - from)).collect();
        breaks.dedup_by(|next, kept| *next <= *kept);
        breaks
    }

    /// Returns the basis functions at `t`, from 0 to 1, by the recurrence of Cox and de Boor.
    pub(super) fn at(&self, t: f64) -> BasisValues {
        let (degree, knots) = (self.degree, &self.knots);
        let [from, to] = self.domain();
        let t = if t.is_nan() { 0.0 } else { t.clamp(0.0, 1.0) };
        let at = (from + (to - from) * t).min(to);
        // The last span is closed at its end.
        let inner = &knots[degree..knots.len() - degree];
        let before = inner.partition_point(|knot| *knot <= at);
        let before = if at >= to { inner.partition_point(|knot| *knot < to) } else { before };
        let span = degree + before.max(1) - 1;
        let mut values = [0.0; MOST_DEGREE + 1];
        let mut lower = values;
        values[0] = 1.0;
        for level in 1..=degree {
            lower = values;
            values = [0.0; MOST_DEGREE + 1];
            for index in 0..level {
                let (low, high) = (knots[span + 1 + index - level], knots[span + 1 + index]);
                let part = if high > low { lower[index] / (high - low) } else { 0.0 };
                values[index] += part * (high - at);
                values[index + 1] += part * (at - low);
            }
        }
        let mut slopes = [0.0; MOST_DEGREE + 1];
        for index in 0..degree {
            let (low, high) = (knots[span + 1 + index - degree], knots[span + 1 + index]);
            let part = if high > low { degree as f64 * lower[index] / (high - low) } else { 0.0 };
            slopes[index] -= part * (to - from);
            slopes[index + 1] += part * (to - from);
        }
        BasisValues { first: span - degree, values, slopes }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_functions_sum_to_one_and_their_slopes_to_zero() {
        let knots = [0.0, 0.0, 0.0, 1.0, 1.5, 1.5, 4.0, 4.0, 4.0];
        let given = Basis::with_knots("u_knots", &knots, 6, 2).expect("a basis");
        for basis in
            [Basis::uniform(2, 3), Basis::uniform(9, 3), Basis::bezier(10), Basis::uniform(8, 7), given]
        {
            for i in 0..=40 {
                let t = f64::from(i) / 40.0;
                let found = basis.at(t);
                assert!((found.values.iter().sum::<f64>() - 1.0).abs() < 1e-12, "{basis:?} {t}");
                assert!(found.slopes.iter().sum::<f64>().abs() < 1e-9);
                assert!(found.first + basis.degree + basis.degree + 1 < basis.knots.len());
                let h = 1e-7;
                let (a, b) = (basis.at(t), basis.at(t + h));
                // Differences are taken only within one span.
                if a.first == b.first && t < 1.0 {
                    for index in 0..=basis.degree {
                        let difference = (b.values[index] - a.values[index]) / h;
                        assert!(
                            (difference - a.slopes[index]).abs() < 1e-4 * (1.0 + difference.abs()),
                            "{t}"
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn bezier_patches_meet_at_every_third_point() {
        let basis = Basis::bezier(10);
        assert_eq!(basis.knots, [0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 2.0, 2.0, 2.0, 3.0, 3.0, 3.0, 3.0]);
        assert_eq!(basis.breaks(), [0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0]);
        let joint = basis.at(1.0 / 3.0 + 1e-15);
        assert!((joint.values[0] - 1.0).abs() < 1e-9 && joint.first == 3);
        let middle = basis.at(0.5);
        assert_eq!((middle.first, &middle.values[..4]), (3, &[0.125, 0.375, 0.375, 0.125][..]));
    }

    #[test]
    fn knots_that_do_not_fit_are_refused() {
        let refuse =
            |knots: &[f64]| Basis::with_knots("u_knots", knots, 3, 2).expect_err("refused").to_string();
        insta::assert_snapshot!(refuse(&[0.0, 1.0]), @r"
        u_knots has 2 numbers, not 6
          help: give the number of points (3) plus the degree (2) plus 1, or omit u_knots
        ");
        insta::assert_snapshot!(refuse(&[0.0, 0.0, 2.0, 1.0, 3.0, 3.0]), @r"
        u_knots must be finite numbers that do not decrease
          help: such as { 0, 0, 0, 0, 1, 2, 2, 2, 2 }
        ");
        insta::assert_snapshot!(refuse(&[0.0, 0.0, 0.0, 0.0, 1.0, 1.0]), @r"
        u_knots repeats 0 more than 3 times
          help: remove repetitions, or raise the degree
        ");
    }
}
