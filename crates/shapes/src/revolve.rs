//! Solids of revolution.

use std::f64::consts::TAU;
use std::sync::Arc;

use burgeon_base::MemoryOwner;
use burgeon_base::error::{Error, Result};
use burgeon_base::work::WorkLimits;
use burgeon_geometry::{Polygon, Rings};
use glam::{DMat3, DVec2, DVec3};

use crate::crossings::check_crossings;
use crate::mesh::PolygonMeshBuilder;
use crate::style::FaceStyle;
use crate::{Shape, UvMap};

/// Range of the number of sides of a full turn.
const SIDES: std::ops::RangeInclusive<u32> = 3..=1024;
/// Approximate memory (bytes) of a face with its corners and its style.
const BYTES_OF_FACE: usize = 400;
/// Distance (m) from the axis within which a point is on it.
const ON_AXIS: f64 = 1e-9;

/// Turn of an outline around an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Revolution {
    /// Direction of the axis, which passes through the origin.
    pub axis: DVec3,
    /// Angle (radians), up to a full turn.
    pub angle: f64,
    /// Number of flat sides.
    pub sides: u32,
    /// Size (m) of a tile of the texture.
    pub tile: f64,
}

impl Shape {
    /// Creates the solid that an outline with holes sweeps around an axis: x is the distance (m) from the axis, y the position
    /// (m) along it.
    ///
    /// Texture coordinates run around the axis and along the outline, in whole tiles for a turn. Faces have the tags
    /// "revolve.side", "revolve.start" and "revolve.end". Fails if the outline crosses itself or the axis.
    pub fn revolve(outline: &[Vec<DVec2>], turn: &Revolution) -> Result<Self> {
        let polygon = Polygon::turned(Rings(outline.to_vec()))?;
        check_crossings(&polygon)?;
        turn.check()?;
        if let Some(beyond) = polygon.points().find(|at| at.x < -ON_AXIS) {
            return Err(Error::argument(format!(
                "the outline crosses the axis at ({}, {})",
                beyond.x, beyond.y
            ))
            .help("give points with x from 0, the distance from the axis"));
        }
        let frame = turn.frame();
        let is_whole = turn.angle > TAU - 1e-9;
        let steps = turn.sides;
        let spoke = |step: u32| {
            let step = if is_whole { step % steps } else { step };
            let way = DVec2::from_angle(turn.angle * f64::from(step) / f64::from(steps));
            frame.x_axis * way.x + frame.y_axis * way.y
        };
        let spokes: Vec<DVec3> = (0..=steps).map(spoke).collect();
        let place = |at: DVec2, step: u32| {
            let out = if at.x <= ON_AXIS { DVec3::ZERO } else { spokes[step as usize] * at.x };
            out + frame.z_axis * at.y
        };
        let faces = polygon.points().count().saturating_mul(steps as usize);
        MemoryOwner::ensure_room(faces.saturating_mul(BYTES_OF_FACE))?;
        let widest = polygon.points().map(|at| at.x).fold(0.0, f64::max);
        let (side, limits) = (FaceStyle::with_automatic_tag(&None, "revolve.side"), WorkLimits::current());
        let mut builder = PolygonMeshBuilder::default();
        for ring in &polygon {
            let mut gone = 0.0;
            for [a, b] in ring.edges() {
                limits.check()?;
                let length = a.distance(b);
                for step in 0..steps {
                    let corners = [place(a, step), place(a, step + 1), place(b, step + 1), place(b, step)];
                    let map = turn.map(corners, step, widest, gone);
                    let mut style = side.as_deref().cloned().unwrap_or_default();
                    style.uv = map;
                    builder.face([corners.as_slice()], &Some(Arc::new(style)));
                }
                gone += length;
            }
        }
        if !is_whole {
            let end = |step: u32, tag: &'static str, builder: &mut PolygonMeshBuilder| {
                let rings: Vec<Vec<DVec3>> = polygon
                    .iter()
                    .map(|ring| {
                        let mut corners: Vec<DVec3> = ring.iter().map(|at| place(*at, step)).collect();
                        if step > 0 {
                            corners.reverse();
                        }
                        corners
                    })
                    .collect();
                let style = FaceStyle::with_automatic_tag(&None, tag);
                builder.face(rings.iter().map(Vec::as_slice), &style);
            };
            end(0, "revolve.start", &mut builder);
            end(steps, "revolve.end", &mut builder);
        }
        Ok(Self::of_mesh(builder.build(), DMat3::IDENTITY))
    }
}

impl Revolution {
    fn check(&self) -> Result<()> {
        if !SIDES.contains(&self.sides) {
            return Err(Error::argument(format!("the number of sides is {}", self.sides)).help(format!(
                "use {} to {}",
                SIDES.start(),
                SIDES.end()
            )));
        }
        if !(self.angle > 0.0 && self.angle <= TAU + 1e-9) {
            return Err(Error::argument(format!("the angle is {} degrees", self.angle.to_degrees()))
                .help("use degrees above 0, up to 360"));
        }
        if self.angle >= std::f64::consts::PI * 0.999 * f64::from(self.sides) {
            return Err(Error::argument(format!("{} sides are too few for the angle", self.sides))
                .help("use at least 3 sides for a full turn"));
        }
        if !(self.tile > 0.0 && self.tile.is_finite()) {
            return Err(Error::argument(format!("the tile is {} m", self.tile)).help("use a length above 0"));
        }
        if self.axis.length() < 1e-9 || !self.axis.is_finite() {
            return Err(
                Error::argument("the axis has no direction").help("use a vector such as vec(0, 0, 1)")
            );
        }
        Ok(())
    }

    /// Returns the axes of the first half plane: x away from the axis, z along it. The turn is counter-clockwise seen against z.
    fn frame(&self) -> DMat3 {
        let z = self.axis.normalize_or(DVec3::Z);
        let x =
            if z.x.abs() < 0.9 { (DVec3::X - z * z.x).normalize() } else { (DVec3::Y - z * z.y).normalize() };
        DMat3::from_cols(x, z.cross(x), z)
    }

    /// Returns the projection of a side, whose outline begins `gone` (m) after the first corner.
    fn map(&self, [a, b, c, d]: [DVec3; 4], step: u32, widest: f64, gone: f64) -> Option<UvMap> {
        let (left, right) = (a.midpoint(d), b.midpoint(c));
        let (low, high) = (a.midpoint(b), d.midpoint(c));
        let (across, up) = (right - left, high - low);
        if across.length() < 1e-9 || up.length() < 1e-9 {
            return None;
        }
        // Whole tiles for a full turn, so that the image has no seam.
        let tiles = (TAU * widest / self.tile).round().max(1.0) * self.angle / TAU / f64::from(self.sides);
        Some(UvMap {
            origin: low,
            u: across / across.length_squared() * tiles,
            v: up / (up.length() * self.tile),
            offset: DVec2::new(tiles * (f64::from(step) + 0.5), gone / self.tile),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FULL: Revolution = Revolution { axis: DVec3::Z, angle: TAU, sides: 32, tile: 1.0 };

    fn outline(points: &[(f64, f64)]) -> Vec<Vec<DVec2>> {
        vec![points.iter().copied().map(DVec2::from).collect()]
    }

    /// Returns the factor between the area of a regular polygon and that of a circle.
    fn share(sides: u32) -> f64 {
        let angle = TAU / f64::from(sides);
        angle.sin() / angle
    }

    #[test]
    fn a_rectangle_at_the_axis_is_a_cylinder_and_one_beside_it_a_ring() {
        let cylinder =
            Shape::revolve(&outline(&[(0., 0.), (2., 0.), (2., 3.), (0., 3.)]), &FULL).expect("a solid");
        let expected = std::f64::consts::PI * 4.0 * 3.0 * share(32);
        assert!(cylinder.is_closed() && (cylinder.volume() - expected).abs() < 1e-9, "{}", cylinder.volume());
        assert_eq!(cylinder.mesh().faces.len(), 96);
        // The order of the points does not matter.
        let ring =
            Shape::revolve(&outline(&[(2., 3.), (2., 0.), (4., 0.), (4., 3.)]), &FULL).expect("a solid");
        let expected = std::f64::consts::PI * (16.0 - 4.0) * 3.0 * share(32);
        assert!(ring.is_closed() && (ring.volume() - expected).abs() < 1e-9, "{}", ring.volume());
    }

    #[test]
    fn a_part_of_a_turn_around_any_axis_is_closed_and_has_ends_with_holes() {
        let mut rings = outline(&[(1., 0.), (5., 0.), (5., 4.), (1., 4.)]);
        rings.extend(outline(&[(2., 1.), (4., 1.), (4., 3.), (2., 3.)]));
        for axis in [DVec3::Z, DVec3::X, DVec3::new(1.0, -2.0, 0.5)] {
            let turn = Revolution { axis, angle: 1.5, sides: 7, ..FULL };
            let solid = Shape::revolve(&rings, &turn).expect("a solid");
            let angle: f64 = 1.5 / 7.0;
            let expected = ((25.0 - 1.0) * 4.0 - (16.0 - 4.0) * 2.0) / 2.0 * 7.0 * angle.sin();
            assert!(solid.is_closed() && (solid.volume() - expected).abs() < 1e-9, "{}", solid.volume());
            let ends = solid.mesh().faces.iter().filter(|face| face.rings.len() == 2).count();
            assert_eq!(ends, 2);
        }
    }

    #[test]
    fn texture_coordinates_continue_around_a_cylinder_and_end_with_a_whole_tile() {
        let solid =
            Shape::revolve(&outline(&[(0., 0.), (2., 0.), (2., 3.), (0., 3.)]), &FULL).expect("a solid");
        let mesh = solid.mesh();
        let upright = mesh.faces.iter().filter(|face| mesh.normal(face).z.abs() < 0.5);
        let mut last = 0.0;
        for face in upright {
            let map = face.style.as_deref().and_then(|style| style.uv).expect("coordinates");
            let [from, to] = [face.rings[0][0], face.rings[0][1]].map(|point| map.at(mesh.at(point)).x);
            assert!((from - last).abs() < 1e-9 && to > from, "{from} {last}");
            last = to;
        }
        assert!((last - 13.0).abs() < 1e-9, "{last}");
    }

    #[test]
    fn outlines_across_the_axis_and_bad_turns_are_refused() {
        let square = outline(&[(0., 0.), (2., 0.), (2., 3.), (0., 3.)]);
        let across = outline(&[(-1., 0.), (2., 0.), (2., 3.)]);
        assert!(Shape::revolve(&across, &FULL).is_err());
        assert!(Shape::revolve(&outline(&[(0., 0.), (2., 2.), (2., 0.), (0., 2.)]), &FULL).is_err());
        for turn in [
            Revolution { sides: 2, ..FULL },
            Revolution { angle: 7.0, ..FULL },
            Revolution { angle: 0.0, ..FULL },
            Revolution { axis: DVec3::ZERO, ..FULL },
            Revolution { tile: 0.0, ..FULL },
        ] {
            assert!(Shape::revolve(&square, &turn).is_err(), "{turn:?}");
        }
    }
}
