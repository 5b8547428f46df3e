//! Contours of generalised cylinders: closed curves in a plane, sampled at common places.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use crate::cross_section::section::Section;
use crate::curves::curve::Curve;
use crate::limits::NOTHING;
use burgeon_base::error::{Error, Result};

/// Maximum number of points of a contour.
const MOST: usize = 256;
/// Number of points of a contour for each of its pieces, if there are not more sides.
const POINTS: usize = 4;

/// Fails unless `curve` can be the contour of a generalised cylinder: closed, in the plane z = 0, without crossings.
///
/// ```
/// use burgeon_geometry::{Curve, CurveKind, check_contour};
/// use glam::DVec3;
///
/// let blade = [DVec3::X, DVec3::Y * 0.1, DVec3::NEG_X, DVec3::Y * -0.1];
/// assert!(check_contour(&Curve::new(&blade, CurveKind::Through, true)?).is_ok());
/// assert!(check_contour(&Curve::new(&blade, CurveKind::Through, false)?).is_err());
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn check_contour(curve: &Curve) -> Result<()> {
    if !curve.is_closed() {
        return Err(Error::argument("the contour is an open curve")
            .help("close it: curve({ ... }, { closed = true })"));
    }
    if curve.points().iter().any(|point| point.z.abs() > NOTHING) {
        return Err(Error::argument("the contour leaves the plane z = 0").help("give points { x, y }"));
    }
    let places = places([curve], POINTS);
    let points: Vec<DVec2> = places.iter().map(|place| curve.point(place.at).truncate()).collect();
    Section::polygon(&crate::planar::Rings(vec![points]))
        .map(|_| ())
        .map_err(|error| error.about("the contour"))
}

/// A place on all contours of a cylinder.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ContourPlace {
    /// Part of the length, from 0 to below 1.
    pub(crate) at: f64,
    /// Set at a corner, where the surface has an edge.
    pub(crate) sharp: bool,
}

/// Returns the common places of `contours`, in order: `sides` even ones or more, and all corners.
pub(crate) fn places<'a>(
    contours: impl IntoIterator<Item = &'a Curve> + Clone,
    sides: usize,
) -> Vec<ContourPlace> {
    let pieces = contours.clone().into_iter().map(Curve::piece_count).max().unwrap_or(0);
    let count = sides.max((POINTS * pieces).min(MOST)).max(3);
    let mut places: Vec<ContourPlace> = Vec::new();
    for at in contours.into_iter().flat_map(corners).take(MOST) {
        places.push(ContourPlace { at, sharp: true });
    }
    places.sort_by(|a, b| a.at.total_cmp(&b.at));
    places.dedup_by(|next, kept| next.at - kept.at < 1e-6);
    let near = 0.4 / count as f64;
    let sharp = places.clone();
    // The distance around the closed contour.
    let apart = |a: f64, b: f64| (a - b).abs().min(1.0 - (a - b).abs());
    let even = (0..count).map(|i| i as f64 / count as f64);
    let free = even.filter(|at| sharp.iter().all(|place| apart(place.at, *at) > near));
    places.extend(free.map(|at| ContourPlace { at, sharp: false }));
    places.sort_by(|a, b| a.at.total_cmp(&b.at));
    places
}

/// Returns the corners of a contour, as places of the counter-clockwise contour.
fn corners(curve: &Curve) -> Vec<f64> {
    let mut corners = curve.corners();
    if is_clockwise(curve) {
        corners.iter_mut().for_each(|at| *at = (1.0 - *at) % 1.0);
    }
    corners
}

/// Returns the points of a contour at `places`, counter-clockwise; those of a circle with radius 1 without a contour.
pub(crate) fn sample(contour: Option<&Curve>, places: &[ContourPlace]) -> Vec<DVec2> {
    let Some(curve) = contour else {
        return places.iter().map(|place| DVec2::from_angle(place.at * TAU)).collect();
    };
    let turned = is_clockwise(curve);
    let at = |place: &ContourPlace| if turned { 1.0 - place.at } else { place.at };
    places.iter().map(|place| curve.point(at(place)).truncate()).collect()
}

/// Returns true if a closed curve in the plane runs clockwise.
fn is_clockwise(curve: &Curve) -> bool {
    let count = (POINTS * curve.piece_count()).clamp(16, MOST);
    let points: Vec<DVec3> = (0..count).map(|i| curve.point(i as f64 / count as f64)).collect();
    let area: f64 =
        (0..count).map(|i| points[i].truncate().perp_dot(points[(i + 1) % count].truncate())).sum();
    area < 0.0
}
