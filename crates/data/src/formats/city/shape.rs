//! The surfaces of an object in space, and its footprint.

use glam::{DVec2, DVec3};

use crate::Geometry;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_spatial::union_all;

/// The role of a surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::formats) enum SurfaceRole {
    /// The footprint that the file tells, without heights.
    Footprint,
    /// It is on the ground.
    Ground,
    /// It is a roof.
    Roof,
    /// It is something else, or nothing says what it is.
    Other,
}

impl SurfaceRole {
    /// The role that an element or a semantic object called `name` stands for.
    pub(in crate::formats) fn named(name: &str) -> Self {
        match name {
            "GroundSurface" => Self::Ground,
            "RoofSurface" => Self::Roof,
            _ => Self::Other,
        }
    }
}

/// A flat surface.
#[derive(Debug, Clone)]
pub(in crate::formats) struct CitySurface {
    /// Its rings: the outer one, and its holes.
    pub(in crate::formats) rings: Vec<Vec<DVec3>>,
    pub(in crate::formats) role: SurfaceRole,
    /// The level of detail, in tenths.
    pub(in crate::formats) level: u32,
    /// Whether it is a part of a closed shell, whose surfaces face outwards.
    pub(in crate::formats) is_solid: bool,
}

/// The geometry of an object.
#[derive(Debug, Clone, Default)]
pub(in crate::formats) struct CityShape {
    pub(in crate::formats) surfaces: Vec<CitySurface>,
    pub(in crate::formats) lines: Vec<Vec<DVec3>>,
    pub(in crate::formats) points: Vec<DVec3>,
}

/// Surfaces whose normals are nearer to the horizon than this are walls.
const STEEP: f64 = 0.01;

/// The most surfaces that are merged: more are a relief, whose triangles stay as they are.
const MOST_MERGED: usize = 5_000;

/// The normal of a ring, as long as its area twice. Method: Newell.
fn normal(ring: &[DVec3]) -> DVec3 {
    let Some(first) = ring.first() else { return DVec3::ZERO };
    let next = ring.iter().skip(1).chain([first]);
    ring.iter().zip(next).map(|(a, b)| (*a - *first).cross(*b - *first)).sum()
}

impl CitySurface {
    /// How far its normal leads upwards, from -1 to 1; 0 for a wall, and for what has no area.
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
    /// Whether there is nothing.
    pub(in crate::formats) fn is_empty(&self) -> bool {
        self.surfaces.is_empty() && self.lines.is_empty() && self.points.is_empty()
    }

    /// Whether nothing of it has a height of its own: all surfaces are footprints, or of the level of detail 0.
    pub(in crate::formats) fn is_flat(&self) -> bool {
        self.surfaces.iter().all(|surface| surface.role == SurfaceRole::Footprint || surface.level < 10)
    }

    /// The lowest and the highest place (m) of the most detailed surfaces that have heights.
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

    /// The parts of its footprint: that which the file tells, or its ground, or all of its most detailed surfaces as seen from
    /// above. Lines or points where there are no surfaces.
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
        // Of a shell, what faces the ground is its shadow.
        let shell = self.best(|surface| surface.is_solid && surface.upward() < 0.0);
        let found = if shell.is_empty() { self.best(|surface| surface.upward() != 0.0) } else { shell };
        merge(&found, budget)
    }

    /// The most detailed of the surfaces that are `wanted`.
    fn best(&self, wanted: impl Fn(&CitySurface) -> bool) -> Vec<&CitySurface> {
        let found: Vec<&CitySurface> = self.surfaces.iter().filter(|surface| wanted(surface)).collect();
        let level = found.iter().map(|surface| surface.level).max();
        found.into_iter().filter(|surface| Some(surface.level) == level).collect()
    }
}

/// The areas that surfaces make together as seen from above, at the height of the lowest of their places.
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
    // Far from the origin, sums of areas that touch would be rounded.
    let middle = polygons[0].points().next().map_or(DVec2::ZERO, |point| point.truncate()).extend(0.0);
    let shift = |geometry: &mut Geometry, by: DVec3| geometry.points_mut().for_each(|point| *point += by);
    let mut moved = polygons;
    moved.iter_mut().for_each(|polygon| shift(polygon, -middle));
    let mut merged = union_all(&moved);
    shift(&mut merged, middle);
    merged.points_mut().for_each(|point| point.z = low);
    Ok(merged.into_parts())
}
