//! Surfaces of an object in space, and its footprint.

use glam::{DVec2, DVec3};

use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_spatial::Geometry;
use burgeon_spatial::union_all;

/// Role of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::formats) enum SurfaceRole {
    /// Footprint given in the file, without heights.
    Footprint,
    /// Ground surface.
    Ground,
    /// Roof surface.
    Roof,
    /// Other or unknown role.
    Other,
}

impl SurfaceRole {
    /// Returns the role of an element or semantic object called `name`.
    pub(in crate::formats) fn of_name(name: &str) -> Self {
        match name {
            "GroundSurface" => Self::Ground,
            "RoofSurface" => Self::Roof,
            _ => Self::Other,
        }
    }
}

/// Flat surface.
#[derive(Debug, Clone)]
pub(in crate::formats) struct CitySurface {
    /// Rings: the outer ring, then the holes.
    pub(in crate::formats) rings: Vec<Vec<DVec3>>,
    pub(in crate::formats) role: SurfaceRole,
    /// Level of detail, in tenths.
    pub(in crate::formats) level: u32,
    /// Set if the surface is part of a closed shell, whose surfaces face outwards.
    pub(in crate::formats) is_solid: bool,
}

/// Geometry of an object.
#[derive(Debug, Clone, Default)]
pub(in crate::formats) struct CityShape {
    pub(in crate::formats) surfaces: Vec<CitySurface>,
    pub(in crate::formats) lines: Vec<Vec<DVec3>>,
    pub(in crate::formats) points: Vec<DVec3>,
}

/// Maximum vertical component of a wall's unit normal.
const STEEP: f64 = 0.01;

/// Maximum number of surfaces that are merged; larger sets are terrain, whose triangles are kept.
const MOST_MERGED: usize = 5_000;

/// Returns the normal of a ring, with twice the ring's area as its length. Method: Newell.
fn normal(ring: &[DVec3]) -> DVec3 {
    let Some(first) = ring.first() else { return DVec3::ZERO };
    let next = ring.iter().skip(1).chain([first]);
    ring.iter().zip(next).map(|(a, b)| (*a - *first).cross(*b - *first)).sum()
}

impl CitySurface {
    /// Returns the vertical component of the unit normal, from -1 to 1; 0 for walls and for surfaces without area.
    fn upward(&self) -> f64 {
        let normal = self.rings.first().map_or(DVec3::ZERO, |ring| normal(ring));
        let part = normal.z / normal.length();
        if part.is_nan() || part.abs() < STEEP { 0.0 } else { part }
    }

    fn points(&self) -> impl Iterator<Item = &DVec3> {
        self.rings.iter().flatten()
    }
}

impl CityShape {
    /// Returns true if there is no geometry.
    pub(in crate::formats) fn is_empty(&self) -> bool {
        self.surfaces.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }

    /// Returns true if no surface has its own height: all surfaces are footprints or have the level of detail 0.
    pub(in crate::formats) fn is_flat(&self) -> bool {
        self.surfaces.iter().all(|surface| surface.role == SurfaceRole::Footprint || surface.level < 10)
    }

    /// Returns the lowest and the highest height (m) of the most detailed surfaces with heights.
    pub(in crate::formats) fn heights(&self) -> Option<[f64; 2]> {
        let has_heights =
            |surface: &&CitySurface| surface.level >= 10 && surface.role != SurfaceRole::Footprint;
        let level = self.surfaces.iter().filter(has_heights).map(|surface| surface.level).max()?;
        let of_level = self.surfaces.iter().filter(has_heights).filter(|surface| surface.level == level);
        let known = of_level.flat_map(CitySurface::points).map(|point| point.z);
        let (low, high) =
            known.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
        (low < high).then_some([low, high])
    }

    /// Returns the parts of the footprint: the footprint in the file, otherwise the ground surfaces, otherwise the
    /// projection of the most detailed surfaces. Returns lines or points if there are no surfaces.
    pub(in crate::formats) fn footprint(&self, budget: &Budget) -> Result<Vec<Geometry>> {
        if self.surfaces.is_empty() {
            let lines = self.lines.iter().cloned().filter_map(Geometry::line);
            let mut parts: Vec<Geometry> = lines.collect();
            if parts.is_empty() {
                parts.extend(self.points.iter().copied().map(Geometry::point));
            }
            return Ok(parts);
        }
        for role in [SurfaceRole::Footprint, SurfaceRole::Ground] {
            let found = self.best(|surface| surface.role == role && surface.upward() != 0.0);
            if !found.is_empty() {
                return merge(&found, budget);
            }
        }
        // The downward surfaces of a shell cover its projection.
        let shell = self.best(|surface| surface.is_solid && surface.upward() < 0.0);
        let found = if shell.is_empty() { self.best(|surface| surface.upward() != 0.0) } else { shell };
        merge(&found, budget)
    }

    /// Returns the most detailed surfaces that satisfy `wanted`.
    fn best(&self, wanted: impl Fn(&CitySurface) -> bool) -> Vec<&CitySurface> {
        let found: Vec<&CitySurface> = self.surfaces.iter().filter(|surface| wanted(surface)).collect();
        let level = found.iter().map(|surface| surface.level).max();
        found.into_iter().filter(|surface| Some(surface.level) == level).collect()
    }
}

/// Returns the union of surfaces in projection from above, at the lowest height of their points.
fn merge(surfaces: &[&CitySurface], budget: &Budget) -> Result<Vec<Geometry>> {
    let low = surfaces
        .iter()
        .flat_map(|surface| surface.points())
        .map(|point| point.z)
        .fold(f64::INFINITY, f64::min);
    let flat =
        |ring: &Vec<DVec3>| -> Vec<DVec3> { ring.iter().map(|point| point.truncate().extend(low)).collect() };
    let rings = surfaces.iter().map(|surface| surface.rings.iter().map(flat).collect::<Vec<_>>());
    let polygons: Vec<Geometry> = rings.filter_map(Geometry::polygon).collect();
    if polygons.len() < 2 || polygons.len() > MOST_MERGED {
        return Ok(polygons);
    }
    budget.check()?;
    let size: usize = polygons.iter().map(|polygon| polygon.points().count()).sum();
    let _held = budget.hold(size * 1000)?;
    // Far from the origin, the union of adjacent areas would suffer from rounding.
    let middle = polygons[0].points().next().map_or(DVec2::ZERO, |point| point.truncate()).extend(0.0);
    let shift = |geometry: &mut Geometry, by: DVec3| geometry.points_mut().for_each(|point| *point += by);
    let mut moved = polygons;
    moved.iter_mut().for_each(|polygon| shift(polygon, -middle));
    let mut merged = union_all(&moved);
    shift(&mut merged, middle);
    merged.points_mut().for_each(|point| point.z = low);
    Ok(merged.into_parts())
}
