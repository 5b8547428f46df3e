//! Construction of shapes from plans, primitives and triangles.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::{Polygon, Rings};
use burgeon_scene::Part;
use glam::{DMat3, DVec2, DVec3};

use crate::crossings::check_crossings;
use crate::mesh::{PolygonFace, PolygonMesh, PolygonMeshBuilder};
use crate::{Scope, Shape};

/// Range of the number of sides of round primitives.
const SIDES: std::ops::RangeInclusive<u32> = 3..=1024;

impl Shape {
    /// Creates a horizontal face that looks upwards, from rings in any direction: the outer ring and the holes, at a
    /// height (m). The x axis of the scope runs along the longest edge.
    ///
    /// Fails if a ring is not valid.
    pub fn plan(rings: &[Vec<DVec2>], height: f64) -> Result<Self> {
        let polygon = Polygon::turned(Rings(rings.to_vec()))?;
        check_crossings(&polygon)?;
        let longest = polygon.edges().max_by(|a, b| {
            let length = |[from, to]: &[DVec2; 2]| from.distance_squared(*to);
            // Rounding does not decide between equal edges; the first wins.
            let (a, b) = (length(a), length(b));
            if (a - b).abs() <= 1e-9 * a.max(b) { std::cmp::Ordering::Greater } else { a.total_cmp(&b) }
        });
        let along = longest.map_or(DVec2::X, |[from, to]| (to - from).normalize_or(DVec2::X));
        // Of the two directions of the edge, the one that points more to the east.
        let along = if along.x < -1e-9 || (along.x.abs() <= 1e-9 && along.y < 0.0) { -along } else { along };
        let x = along.extend(0.0);
        let axes = DMat3::from_cols(x, DVec3::Z.cross(x), DVec3::Z);
        let mut builder = PolygonMeshBuilder::default();
        let lifted: Vec<Vec<DVec3>> =
            polygon.iter().map(|ring| ring.iter().map(|at| at.extend(height)).collect()).collect();
        builder.face(lifted.iter().map(Vec::as_slice), &None);
        Ok(Self::of_mesh(builder.build(), axes))
    }

    /// Creates a rectangle with a corner at the origin that looks upwards.
    pub fn rectangle(size: DVec2) -> Self {
        let scope = Scope { size: size.extend(0.0), ..Scope::default() };
        Self::new(scope, crate::ShapeBody::Rectangle(None))
    }

    /// Creates a regular polygon around the origin that looks upwards; fails unless it has 3 to 1024 sides.
    pub fn disk(radius: f64, sides: u32) -> Result<Self> {
        let ring = circle(radius, sides)?;
        let mut builder = PolygonMeshBuilder::default();
        builder.face([ring.as_slice()], &None);
        Ok(Self::of_mesh(builder.build(), DMat3::IDENTITY))
    }

    /// Creates an upright cylinder around the origin; `top` (m) is its upper radius, 0 for a cone.
    pub fn cylinder(radius: f64, top: f64, height: f64, sides: u32) -> Result<Self> {
        if !(top >= 0.0 && top.is_finite()) {
            return Err(Error::argument(format!("the upper radius is {top} m")).help("use 0 or more"));
        }
        let mut solid = Self::disk(radius, sides)?.taper(height, top / radius)?;
        solid = solid.with_styles(|_| None);
        Ok(solid)
    }

    /// Creates a sphere around the origin, with `sides` meridians and half as many rows.
    pub fn sphere(radius: f64, sides: u32) -> Result<Self> {
        let ring = circle(1.0, sides)?;
        check_radius(radius)?;
        let rows = (sides / 2).max(2);
        let row = |number: u32| -> Vec<DVec3> {
            let (sin, cos) = (std::f64::consts::PI * f64::from(number) / f64::from(rows)).sin_cos();
            ring.iter().map(|at| DVec3::new(at.x * sin, at.y * sin, -cos) * radius).collect()
        };
        let mut builder = PolygonMeshBuilder::default();
        let poles = [DVec3::NEG_Z * radius, DVec3::Z * radius];
        for number in 0..rows {
            let (low, high) = (row(number), row(number + 1));
            for index in 0..ring.len() {
                let next = (index + 1) % ring.len();
                if number == 0 {
                    builder.face([[poles[0], high[next], high[index]].as_slice()], &None);
                } else if number + 1 == rows {
                    builder.face([[low[index], low[next], poles[1]].as_slice()], &None);
                } else {
                    builder.face([[low[index], low[next], high[next], high[index]].as_slice()], &None);
                }
            }
        }
        Ok(Self::of_mesh(builder.build(), DMat3::IDENTITY))
    }

    /// Creates a shape of points (m) and faces as lists of point numbers (from 0), counter-clockwise seen from outside.
    ///
    /// Fails if a face has fewer than three corners, refers to a missing point, has no area, or is not flat within 1 mm
    /// or a thousandth of its size; triangles are always flat.
    pub fn of_faces(points: Vec<DVec3>, faces: &[Vec<u32>]) -> Result<Self> {
        let mut made = Vec::with_capacity(faces.len());
        if let Some(number) = points.iter().position(|at| !at.is_finite()) {
            return Err(Error::argument(format!("point {} of the shape is not finite", number + 1)));
        }
        let mesh = PolygonMesh::new(points, Vec::new());
        for (number, ring) in (1..).zip(faces) {
            let fails = |what: String, help: &str| {
                Err(Error::argument(format!("face {number} {what}")).help(help.to_owned()))
            };
            if ring.len() < 3 {
                return fails(format!("has {} corners", ring.len()), "give at least three corners");
            }
            if let Some(missing) = ring.iter().find(|point| **point as usize >= mesh.points.len()) {
                let count = mesh.points.len();
                return fails(
                    format!("refers to point {}, and there are {count}", missing + 1),
                    "points are numbered from 1",
                );
            }
            let face = PolygonFace::of(ring, &None);
            let normal = mesh.normal(&face);
            if normal == DVec3::ZERO {
                return fails("has no area".into(), "remove it");
            }
            let heights = ring.iter().map(|point| mesh.at(*point).dot(normal));
            let (low, high) = heights
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
            let size = Scope::around(DMat3::IDENTITY, ring.iter().map(|point| mesh.at(*point))).size.length();
            if high - low > (size * 1e-3).max(1e-3) {
                return fails(
                    format!("is not flat: its corners are {:.3} m apart along its normal", high - low),
                    "divide it into triangles",
                );
            }
            made.push(face);
        }
        if made.is_empty() {
            return Err(Error::argument("the shape has no faces").help("give at least one face"));
        }
        Ok(Self::of_mesh(
            crate::operations::weld(&PolygonMesh::new(mesh.points, made), crate::operations::SAME_POINT),
            DMat3::IDENTITY,
        ))
    }

    /// Creates a shape of the triangles of meshes, with coplanar ones joined; `None` without triangles.
    pub fn of_parts<'a>(
        parts: impl IntoIterator<Item = (&'a Part, Option<[f32; 4]>)>,
    ) -> Result<Option<Self>> {
        let mut mesh = PolygonMesh::default();
        for (part, color) in parts {
            let style = color.map(|color| {
                std::sync::Arc::new(crate::FaceStyle { color: Some(color), ..crate::FaceStyle::default() })
            });
            let base = u32::try_from(mesh.points.len()).unwrap_or(u32::MAX);
            mesh.points.extend(part.positions.iter().map(|at| at.as_dvec3()));
            mesh.faces.extend(
                part.triangles
                    .iter()
                    .map(|corners| PolygonFace::of(&corners.map(|corner| corner + base), &style)),
            );
        }
        let welded = crate::operations::weld(&mesh, crate::operations::SAME_POINT);
        if welded.faces.is_empty() {
            return Ok(None);
        }
        Ok(Some(Self::of_mesh(crate::operations::merge_coplanar(&welded)?, DMat3::IDENTITY)))
    }
}

/// Returns the corners of a regular polygon around the origin.
fn circle(radius: f64, sides: u32) -> Result<Vec<DVec3>> {
    check_radius(radius)?;
    if !SIDES.contains(&sides) {
        let message = format!("the number of sides is {sides}");
        return Err(Error::argument(message).help(format!("use {} to {}", SIDES.start(), SIDES.end())));
    }
    let angle = |side: u32| std::f64::consts::TAU * f64::from(side) / f64::from(sides);
    Ok((0..sides).map(|side| DVec2::from_angle(angle(side)).extend(0.0) * radius).collect())
}

fn check_radius(radius: f64) -> Result<()> {
    if radius > 0.0 && radius.is_finite() {
        return Ok(());
    }
    Err(Error::argument(format!("the radius is {radius} m")).help("use a radius above 0"))
}
