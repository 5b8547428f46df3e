//! Surfaces of control points.

use glam::{DVec3, DVec4};

use super::basis::{Basis, MOST_DEGREE};
use crate::limits::MOST;
use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Result};

/// Distance between parameters at which a normal is taken if there is none at the wanted place.
const BESIDE: f64 = 1e-4;

/// Relation of a [`SplineSurface`] to its control points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum SurfaceKind {
    /// Joined bicubic Bezier patches, which share their border points.
    #[default]
    Bezier,
    /// A B-spline.
    BSpline,
    /// A rational B-spline, with a weight for each point.
    Nurbs,
}

/// Control points of a [`SplineSurface`] with weights, degree and knots.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SurfaceGrid {
    /// Rows of points (m), all of one length. Along a row the parameter u increases, from row to row v.
    pub points: Vec<Vec<DVec3>>,
    /// Weight of each point, above 0; only for NURBS.
    pub weights: Option<Vec<Vec<f64>>>,
    /// Degree of B-splines and NURBS in both directions, 3 if omitted; less with few points.
    pub degree: Option<usize>,
    /// Knots along u and along v of B-splines and NURBS; uniform if omitted.
    pub knots: [Option<Vec<f64>>; 2],
}

/// A surface over the parameters u and v from 0 to 1: Bezier patches, a B-spline or NURBS.
///
/// ```
/// use burgeon_geometry::{SplineSurface, SurfaceGrid, SurfaceKind};
/// use glam::DVec3;
///
/// let row = |y: f64| vec![DVec3::new(0.0, y, 0.0), DVec3::new(2.0, y, 0.0)];
/// let grid = SurfaceGrid { points: vec![row(0.0), row(4.0)], ..SurfaceGrid::default() };
/// let flat = SplineSurface::new(SurfaceKind::BSpline, grid)?;
/// assert_eq!((flat.point(0.5, 0.25), flat.normal(0.5, 0.25)), (DVec3::new(1.0, 1.0, 0.0), DVec3::Z));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct SplineSurface {
    /// Number of points along u, and of rows.
    pub(super) sizes: [usize; 2],
    /// Points (m), row after row.
    pub(super) points: Vec<DVec3>,
    /// Weights of the points; empty if all are 1.
    pub(super) weights: Vec<f64>,
    pub(super) bases: [Basis; 2],
}

impl SplineSurface {
    /// Creates the surface of control points.
    ///
    /// Fails if the rows differ in length or are too few, if a coordinate is not finite or beyond 1e9, or if weights,
    /// degree or knots do not fit the points and the kind.
    pub fn new(kind: SurfaceKind, grid: SurfaceGrid) -> Result<Self> {
        let SurfaceGrid { points, weights, degree, knots } = grid;
        let sizes = [points.first().map_or(0, Vec::len), points.len()];
        check_points(kind, sizes, &points)?;
        MemoryOwner::ensure_room(sizes[0] * sizes[1] * size_of::<DVec4>())?;
        let weights = match (kind, weights) {
            (SurfaceKind::Nurbs, Some(weights)) => check_weights(sizes, weights)?,
            (SurfaceKind::Nurbs, None) => {
                return Err(Error::argument("NURBS need weights")
                    .help("give weights, one number for each point, or write kind = \"b-spline\""));
            }
            (_, Some(_)) => {
                return Err(Error::argument("weights are only for NURBS").help("write kind = \"nurbs\""));
            }
            (_, None) => Vec::new(),
        };
        if kind == SurfaceKind::Bezier && (degree.is_some_and(|degree| degree != 3) || knots != [None, None])
        {
            return Err(Error::argument("Bezier patches have the degree 3 and no knots")
                .help("omit degree and knots, or write kind = \"b-spline\""));
        }
        let degree = degree.unwrap_or(3);
        if !(1..=MOST_DEGREE).contains(&degree) {
            return Err(Error::argument(format!("the degree must be from 1 to {MOST_DEGREE}, not {degree}")));
        }
        let [u_knots, v_knots] = knots;
        let basis = |count: usize, name: &str, knots: Option<Vec<f64>>| match (kind, knots) {
            (SurfaceKind::Bezier, _) => Ok(Basis::bezier(count)),
            (_, Some(knots)) => Basis::with_knots(name, &knots, count, degree.min(count - 1)),
            (_, None) => Ok(Basis::uniform(count, degree)),
        };
        let bases = [basis(sizes[0], "u_knots", u_knots)?, basis(sizes[1], "v_knots", v_knots)?];
        Ok(Self { sizes, points: points.into_iter().flatten().collect(), weights, bases })
    }

    /// Returns the position (m) at `u` and `v`, which are limited to 0 to 1.
    pub fn point(&self, u: f64, v: f64) -> DVec3 {
        self.derivatives(u, v)[0]
    }

    /// Returns the unit normal at `u` and `v`: the side from which u runs to the right and v upwards.
    ///
    /// At a degenerate place, such as a border of equal points, it is the normal beside it.
    pub fn normal(&self, u: f64, v: f64) -> DVec3 {
        let [_, along_u, along_v] = self.derivatives(u, v);
        normal(along_u, along_v).unwrap_or_else(|| {
            let inward = |t: f64| if t < 0.5 { t + BESIDE } else { t - BESIDE };
            let places = [(inward(u), v), (u, inward(v)), (inward(u), inward(v))];
            let found = places.into_iter().find_map(|(u, v)| {
                let [_, along_u, along_v] = self.derivatives(u, v);
                normal(along_u, along_v)
            });
            found.unwrap_or(DVec3::Z)
        })
    }

    /// Returns the position and its derivatives by u and by v.
    pub(super) fn derivatives(&self, u: f64, v: f64) -> [DVec3; 3] {
        let [in_u, in_v] = [self.bases[0].at(u), self.bases[1].at(v)];
        let mut sums = [DVec4::ZERO; 3];
        for row in 0..=self.bases[1].degree {
            let mut across = [DVec4::ZERO; 2];
            for column in 0..=self.bases[0].degree {
                let index = (in_v.first + row) * self.sizes[0] + in_u.first + column;
                let weight = self.weights.get(index).copied().unwrap_or(1.0);
                let point = (self.points[index] * weight).extend(weight);
                across[0] += point * in_u.values[column];
                across[1] += point * in_u.slopes[column];
            }
            sums[0] += across[0] * in_v.values[row];
            sums[1] += across[1] * in_v.values[row];
            sums[2] += across[0] * in_v.slopes[row];
        }
        let weight = sums[0].w;
        let at = sums[0].truncate() / weight;
        [at, (sums[1].truncate() - at * sums[1].w) / weight, (sums[2].truncate() - at * sums[2].w) / weight]
    }

    /// Returns the number of points along u, and of rows.
    pub fn sizes(&self) -> [usize; 2] {
        self.sizes
    }

    /// Returns the numbers that define the surface: points, weights and knots.
    pub fn numbers(&self) -> impl Iterator<Item = f64> {
        let points = self.points.iter().flat_map(|point| point.to_array());
        let knots = self.bases.iter().flat_map(Basis::knots);
        points.chain(self.weights.iter().chain(knots).copied())
    }

    /// Returns the approximate memory (bytes).
    pub fn memory(&self) -> usize {
        let knots: usize = self.bases.iter().map(Basis::memory).sum();
        self.points.len() * size_of::<DVec3>() + self.weights.len() * size_of::<f64>() + knots
    }
}

/// Returns the unit normal of two tangents, unless one is zero or they are parallel.
pub(super) fn normal(along_u: DVec3, along_v: DVec3) -> Option<DVec3> {
    let cross = along_u.cross(along_v);
    let scale = along_u.length_squared().max(along_v.length_squared());
    (cross.length() > 1e-9 * scale).then(|| cross.try_normalize()).flatten()
}

fn check_points(kind: SurfaceKind, sizes: [usize; 2], points: &[Vec<DVec3>]) -> Result<()> {
    let example = "give rows of points: points = { { vec(...), ... }, { vec(...), ... }, ... }";
    if sizes.iter().any(|size| *size < 2) {
        return Err(Error::argument(format!(
            "a surface needs at least 2 rows of 2 points, not {} of {}",
            sizes[1], sizes[0]
        ))
        .help(example));
    }
    for (row, found) in points.iter().enumerate() {
        if found.len() != sizes[0] {
            let message = format!("row {} has {} points, but row 1 has {}", row + 1, found.len(), sizes[0]);
            return Err(Error::argument(message).help("give as many points in each row"));
        }
        found.iter().enumerate().try_for_each(|(column, point)| check_point([column, row], *point))?;
    }
    if kind == SurfaceKind::Bezier && sizes.iter().any(|size| size % 3 != 1) {
        let message = format!("Bezier patches do not have {} rows of {} points", sizes[1], sizes[0]);
        return Err(Error::argument(message).help(
            "a patch has 4 rows of 4 points, and each further patch 3 more rows or columns: 4, 7, 10",
        ));
    }
    Ok(())
}

/// Fails unless the `point` in this column and row is finite and within 1e9 m of the origin.
pub(super) fn check_point([column, row]: [usize; 2], point: DVec3) -> Result<()> {
    if point.is_finite() && point.abs().max_element() <= MOST {
        return Ok(());
    }
    let message = format!("point {} of row {} is not within 1e9 m of the origin", column + 1, row + 1);
    Err(Error::argument(message).help("give finite coordinates in metres"))
}

/// Returns the weights row after row. Fails unless there is one above 0 for each point.
fn check_weights(sizes: [usize; 2], weights: Vec<Vec<f64>>) -> Result<Vec<f64>> {
    if weights.len() != sizes[1] || weights.iter().any(|row| row.len() != sizes[0]) {
        let message =
            format!("weights do not have {} rows of {} numbers, as points have", sizes[1], sizes[0]);
        return Err(Error::argument(message).help("give one weight for each point"));
    }
    let weights: Vec<f64> = weights.into_iter().flatten().collect();
    if let Some(wrong) = weights.iter().find(|weight| !(**weight > 0.0 && **weight <= MOST)) {
        return Err(Error::argument(format!("a weight is {wrong}")).help("give weights above 0, up to 1e9"));
    }
    Ok(weights)
}
