//! Lines of constant parameter on surfaces, and surfaces with other points.

use glam::DVec3;

use super::basis::Basis;
use super::surface::{SplineSurface, SurfaceKind, check_point};
use burgeon_base::error::{Error, Result};

/// Number of pieces between two knots of a line that is not a cubic polynomial there.
const APPROXIMATE: usize = 4;

impl SplineSurface {
    /// Returns the relation of the surface to its points. A B-spline with the knots of Bezier patches is such patches.
    pub fn kind(&self) -> SurfaceKind {
        let is_patches = |direction: usize| {
            let count = self.sizes[direction];
            count % 3 == 1 && self.bases[direction] == Basis::bezier(count)
        };
        match () {
            () if !self.weights.is_empty() => SurfaceKind::Nurbs,
            () if is_patches(0) && is_patches(1) => SurfaceKind::Bezier,
            () => SurfaceKind::BSpline,
        }
    }

    /// Returns the points (m), row after row.
    pub fn points(&self) -> &[DVec3] {
        &self.points
    }

    /// Returns the surface that differs only by its `points` (m), given row after row.
    ///
    /// Fails if their number differs, or if a coordinate is not finite or beyond 1e9.
    pub fn with_points(&self, points: Vec<DVec3>) -> Result<Self> {
        let [columns, rows] = self.sizes;
        if points.len() != columns * rows {
            let message =
                format!("{} points do not make a surface of {rows} rows of {columns} points", points.len());
            return Err(
                Error::argument(message).help(format!("give {} points, row after row", columns * rows))
            );
        }
        points
            .iter()
            .enumerate()
            .try_for_each(|(index, point)| check_point([index % columns, index / columns], *point))?;
        Ok(Self { points, bases: self.bases.clone(), weights: self.weights.clone(), ..*self })
    }

    /// Returns lines of constant v, then lines of constant u, as cubic Bezier pieces: at the ends of the patches and between
    /// them. Lines of rational surfaces and of those with a higher degree are approximate.
    ///
    /// ```
    /// use burgeon_geometry::{SplineSurface, SurfaceGrid, SurfaceKind};
    /// use glam::DVec3;
    ///
    /// let row = |y: f64| vec![DVec3::new(0.0, y, 0.0), DVec3::new(2.0, y, 0.0)];
    /// let grid = SurfaceGrid { points: vec![row(0.0), row(4.0)], ..SurfaceGrid::default() };
    /// let lines = SplineSurface::new(SurfaceKind::BSpline, grid)?.isolines();
    /// // v = 0, 1/4, 1/2, 3/4 and 1, and the same values of u.
    /// assert_eq!((lines.len(), lines[1][0], lines[1][3]), (10, DVec3::Y, DVec3::new(2.0, 1.0, 0.0)));
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn isolines(&self) -> Vec<[DVec3; 4]> {
        let [columns, rows] = [0, 1].map(|direction| self.bases[direction].breaks());
        let mut pieces = Vec::new();
        for v in levels(&rows) {
            self.line(&columns, self.bases[0].degree, |u| self.point(u, v), &mut pieces);
        }
        for u in levels(&columns) {
            self.line(&rows, self.bases[1].degree, |v| self.point(u, v), &mut pieces);
        }
        pieces
    }

    /// Adds the pieces of the line `at` to `pieces`, which is a polynomial of the `degree` between `breaks`.
    fn line(&self, breaks: &[f64], degree: usize, at: impl Fn(f64) -> DVec3, pieces: &mut Vec<[DVec3; 4]>) {
        let count = if degree <= 3 && self.weights.is_empty() { 1 } else { APPROXIMATE };
        for (from, to) in breaks.windows(2).flat_map(|span| {
            let part = move |i: usize| span[0] + (span[1] - span[0]) * i as f64 / count as f64;
            (0..count).map(move |i| (part(i), part(i + 1)))
        }) {
            let [a, b, c, d] = [0.0, 1.0, 2.0, 3.0].map(|third| at(from + (to - from) * third / 3.0));
            // The control points of the cubic polynomial through four points at equal distances.
            let second = (b * 18.0 - c * 9.0 - a * 5.0 + d * 2.0) / 6.0;
            let third = (c * 18.0 - b * 9.0 - d * 5.0 + a * 2.0) / 6.0;
            pieces.push([a, second, third, d]);
        }
    }
}

/// Returns the parameters of the lines across a direction with these `breaks`: at least five, and fewer between breaks if there
/// are many.
fn levels(breaks: &[f64]) -> Vec<f64> {
    let parts = match breaks.len() {
        ..=2 => 4,
        3..=8 => 2,
        _ => 1,
    };
    let inner = |pair: &[f64]| {
        let [from, to] = [pair[0], pair[1]];
        (0..parts).map(move |i| from + (to - from) * f64::from(i) / f64::from(parts))
    };
    breaks.windows(2).flat_map(inner).chain(breaks.last().copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::surface::SurfaceGrid;
    use super::*;

    /// Returns a curved surface of 7 rows of 4 points.
    fn curved_surface(kind: SurfaceKind) -> SplineSurface {
        let point = |i: usize, j: usize| {
            let (x, y) = (i as f64, j as f64);
            DVec3::new(x + 0.2 * (y * 1.7).sin(), y, (x * 1.3 + y * y * 0.4).sin())
        };
        let rows: Vec<Vec<DVec3>> = (0..7).map(|j| (0..4).map(|i| point(i, j)).collect()).collect();
        let weights = rows.iter().enumerate().map(|(j, row)| vec![1.0 + j as f64 * 0.3; row.len()]).collect();
        let weights = (kind == SurfaceKind::Nurbs).then_some(weights);
        SplineSurface::new(kind, SurfaceGrid { points: rows, weights, ..SurfaceGrid::default() }).unwrap()
    }

    fn on_piece(piece: &[DVec3; 4], t: f64) -> DVec3 {
        let s = 1.0 - t;
        piece[0] * (s * s * s)
            + piece[1] * (3.0 * s * s * t)
            + piece[2] * (3.0 * s * t * t)
            + piece[3] * (t * t * t)
    }

    #[test]
    fn isolines_lie_on_the_surface() {
        for (kind, pieces, tolerance) in
            [(SurfaceKind::Bezier, 1, 1e-12), (SurfaceKind::BSpline, 1, 1e-12), (SurfaceKind::Nurbs, 4, 1e-3)]
        {
            let surface = curved_surface(kind);
            assert_eq!(surface.kind(), kind);
            let lines = surface.isolines();
            let [us, vs] = [0, 1].map(|direction| surface.bases[direction].breaks());
            let (across, along) = (levels(&vs), levels(&us));
            assert_eq!(lines.len(), pieces * (across.len() * (us.len() - 1) + along.len() * (vs.len() - 1)));
            let mut lines = lines.iter();
            for v in across {
                for piece in 0..pieces {
                    let line = lines.next().unwrap();
                    for i in 0..=10 {
                        let u = (piece as f64 + f64::from(i) / 10.0) / pieces as f64;
                        let gap = on_piece(line, f64::from(i) / 10.0).distance(surface.point(u, v));
                        assert!(gap < tolerance, "{kind:?} u {u} v {v}: {gap}");
                    }
                }
            }
        }
    }

    #[test]
    fn other_points_keep_the_kind_and_must_be_as_many() {
        let surface = curved_surface(SurfaceKind::Nurbs);
        let moved: Vec<DVec3> = surface.points().iter().map(|point| *point + DVec3::Z).collect();
        let other = surface.with_points(moved.clone()).unwrap();
        assert!((other.point(0.3, 0.6) - surface.point(0.3, 0.6) - DVec3::Z).length() < 1e-12);
        assert_eq!((other.kind(), other.points()), (SurfaceKind::Nurbs, &*moved));
        assert!(surface.with_points(moved[1..].to_vec()).is_err());
        let mut wrong = moved;
        wrong[5].y = f64::INFINITY;
        let error = surface.with_points(wrong).unwrap_err();
        assert!(error.message().contains("point 2 of row 2"), "{error}");
    }
}
