//! Outlines of the rings of an axis: circles, or contours that blend between control points.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::DVec2;

use crate::planar::triangulate;
use crate::sweeps::contour::{ContourPlace, places, sample};
use crate::sweeps::control_point::CylinderPoint;
use burgeon_base::error::Result;

/// Outlines with a radius of 1 at the control points of an axis.
#[derive(Debug)]
pub(super) struct Outlines {
    /// Places of the points on all outlines.
    pub(super) places: Vec<ContourPlace>,
    /// Maximum distance of a point from the axis.
    pub(super) reach: f64,
    /// Outline of each control point, or a single one for all.
    all: Vec<Vec<DVec2>>,
    /// Triangles of a flat end with a single outline.
    end: Vec<[usize; 3]>,
}

impl Outlines {
    /// Creates circles with `sides` points.
    pub(super) fn circle(sides: usize) -> Self {
        let places = places([], sides);
        let circle = places.iter().map(|place| DVec2::from_angle(place.at * TAU)).collect();
        let end = (2..places.len()).map(|corner| [0, corner - 1, corner]).collect();
        Self { places, reach: 1.0, all: vec![circle], end }
    }

    /// Creates the outlines of `points`, with at least this number of `sides`.
    pub(super) fn of(points: &[CylinderPoint], sides: usize) -> Self {
        let places = places(points.iter().filter_map(|point| point.contour.as_deref()), sides);
        let all: Vec<Vec<DVec2>> =
            points.iter().map(|point| sample(point.contour.as_deref(), &places)).collect();
        let reach = all.iter().flatten().map(|point| point.length()).fold(0.0, f64::max);
        Self { places, reach, all, end: Vec::new() }
    }

    /// Returns the number of points of an outline.
    #[inline]
    pub(super) fn count(&self) -> usize {
        self.places.len()
    }

    /// Returns point number `index` of the outline at `part` (0 to 1) of the way from a control point to the next.
    #[inline]
    pub(super) fn point(&self, control: usize, part: f64, index: usize) -> DVec2 {
        let Some(from) = self.all.get(control) else { return self.all[0][index] };
        let to = self.all.get(control + 1).unwrap_or(from);
        from[index].lerp(to[index], part)
    }

    /// Returns the triangles of a flat end, counter-clockwise; fails if the outline is too narrow.
    pub(super) fn end(&self, control: usize, part: f64) -> Result<Cow<'_, [[usize; 3]]>> {
        if !self.end.is_empty() {
            return Ok(Cow::Borrowed(&self.end));
        }
        let outline: Vec<DVec2> = (0..self.count()).map(|index| self.point(control, part, index)).collect();
        let triangles = triangulate(&[outline]).map_err(|error| error.about("the end of a cylinder"))?;
        Ok(Cow::Owned(triangles))
    }
}
