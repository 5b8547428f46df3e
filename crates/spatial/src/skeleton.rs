//! The straight skeleton of areas, and what is left when their borders move inwards.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::planar::edges;
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Polygon, Rings};
use glam::DVec2;

use super::Geometry;
use super::edges::with_heights;
use super::plane::Plane;

impl Geometry {
    /// The lines inside of its areas on which borders meet that all move inwards alike: the ridges and hips of a roof over
    /// them. Fails if it has no areas, or their rings touch.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let hall = Geometry::from_wkt("POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0))")?;
    /// assert!((hall.straight_skeleton()?.length() - (4.0 + 4.0 * 32f64.sqrt())).abs() < 1e-9);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn straight_skeleton(&self) -> Result<Self> {
        let (plane, polygons) = self.plans("straight_skeleton")?;
        let mut lines = Vec::new();
        for polygon in polygons {
            let paces = vec![Pace::default(); polygon.size()];
            let skeleton = Skeleton::new(&polygon, &paces)?;
            for face in &skeleton.faces {
                // The first is that of the plan.
                for [from, to] in edges(face).skip(1) {
                    let [a, b] = [from, to].map(|peak| skeleton.peaks[peak].at);
                    // Each line is the border of two faces.
                    if from < to && a != b {
                        lines.push(Self::Line(vec![plane.back(a), plane.back(b)]));
                    }
                }
            }
        }
        Ok(with_heights(Self::gathered(lines), &[self]))
    }

    /// The faces of its straight skeleton, one for each edge of its areas: polygons that begin with the edge and turn left.
    /// Their heights are how far (m) inwards from that edge they reach, so that they are a hip roof with a slope of 1.
    /// Fails as [`Geometry::straight_skeleton`] does.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let hall = Geometry::from_wkt("POLYGON ((0 0, 12 0, 12 8, 0 8, 0 0))")?;
    /// let faces = hall.skeleton_faces()?;
    /// assert_eq!(faces.len(), 4);
    /// assert_eq!(faces.iter().map(Geometry::area).sum::<f64>(), 96.0);
    /// assert_eq!(faces[0].to_wkt(), "POLYGON Z ((0 0 0, 12 0 0, 8 4 4, 4 4 4, 0 0 0))");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn skeleton_faces(&self) -> Result<Vec<Self>> {
        let (plane, polygons) = self.plans("skeleton_faces")?;
        let mut made = Vec::new();
        for polygon in polygons {
            let skeleton = Skeleton::new(&polygon, &vec![Pace::default(); polygon.size()])?;
            made.extend(skeleton.faces.iter().map(|face| {
                let corner = |peak: &usize| {
                    let peak = &skeleton.peaks[*peak];
                    plane.back(peak.at).truncate().extend(peak.time)
                };
                Self::Polygon(Rings(vec![face.iter().map(corner).collect()]))
            }));
        }
        Ok(made)
    }

    /// What is left of its areas when their borders move inwards by `distance` (m), or outwards if that is negative, with
    /// corners that stay corners as far as they turn by less than 60 degrees; empty if nothing is left. Fails if it has
    /// no areas, or the distance is not finite.
    pub fn inset(&self, distance: f64) -> Result<Self> {
        if !distance.is_finite() {
            return Err(Error::argument(format!("inset takes a finite distance, not {distance}"))
                .help("give metres: more goes further inwards"));
        }
        let (plane, polygons) = self.plans("inset")?;
        let parts = polygons.iter().flat_map(|polygon| polygon.inset(distance)).map(|part| {
            let rings = part.iter().map(|ring| ring.iter().map(|at| plane.back(*at)).collect());
            Self::Polygon(rings.collect())
        });
        let made = Self::gathered(parts.collect());
        Ok(if made.is_empty() { Self::empty(2) } else { with_heights(made, &[self]) })
    }

    /// Its areas as plans, whose rings neither cross nor overlap.
    fn plans(&self, method: &str) -> Result<(Plane, Vec<Polygon>)> {
        let plane = Plane::of(&[self]);
        if self.dimension() < 2 || !self.is_sound() {
            return Err(Error::argument(format!("{method} takes areas, not a {}", self.kind().name()))
                .help("buffer makes an area of lines and points"));
        }
        let areas = super::overlay::dissolved(plane.polygons(self));
        let polygons = areas.iter().map(|polygon| {
            let open = |ring: &geo::LineString| -> Vec<DVec2> {
                let mut ring: Vec<DVec2> = ring.0.iter().map(|at| DVec2::new(at.x, at.y)).collect();
                ring.dedup();
                if ring.len() > 1 && ring.first() == ring.last() {
                    ring.pop();
                }
                ring
            };
            let rings: Rings<DVec2> =
                std::iter::once(polygon.exterior()).chain(polygon.interiors()).map(open).collect();
            Polygon::turned(rings)
        });
        Ok((plane, polygons.collect::<Result<_>>()?))
    }
}
