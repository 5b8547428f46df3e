//! Straight skeletons and insets of areas.

use burgeon_base::error::{Error, Result};
use burgeon_geometry::planar::edges;
use burgeon_geometry::skeleton::{Pace, Skeleton};
use burgeon_geometry::{Polygon, Rings};
use glam::DVec2;

use super::Geometry;
use super::edges::with_heights;
use super::plane::Plane;

impl Geometry {
    /// Computes the lines inside the areas where borders meet that move inwards at equal speed: the ridges
    /// and hips of a roof over them. Fails if the geometry has no areas, or if their rings touch.
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
                // The first edge of a face is the edge of the plan.
                for [from, to] in edges(face).skip(1) {
                    let [a, b] = [from, to].map(|peak| skeleton.peaks[peak].at);
                    // Each line borders two faces and is added once.
                    if from < to && a != b {
                        lines.push(Self::Line(vec![plane.back(a), plane.back(b)]));
                    }
                }
            }
        }
        Ok(with_heights(Self::gathered(lines), &[self]))
    }

    /// Computes the faces of the straight skeleton, one for each edge of the areas: polygons that begin with
    /// the edge and are counter-clockwise.
    ///
    /// Their heights are the distances (m) from that edge, so that they form a hip roof with a slope of 1.
    /// Fails like [`Geometry::straight_skeleton`].
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

    /// Moves the borders of the areas inwards by `distance` (m), or outwards if it is negative.
    ///
    /// Corners that turn by less than 60 degrees stay corners. Empty if no area remains. Fails if the
    /// geometry has no areas, or if the distance is not finite.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let lot = Geometry::from_wkt("POLYGON ((0 0, 20 0, 20 10, 0 10, 0 0))")?;
    /// assert_eq!(lot.inset(3.0)?.area(), 14.0 * 4.0);
    /// assert!(lot.inset(5.5)?.is_empty());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn inset(&self, distance: f64) -> Result<Self> {
        if !distance.is_finite() {
            return Err(Error::argument(format!("inset takes a finite distance, not {distance}"))
                .help("use metres: a greater distance goes further inwards"));
        }
        let (plane, polygons) = self.plans("inset")?;
        let parts = polygons.iter().flat_map(|polygon| polygon.inset(distance)).map(|part| {
            let rings = part.iter().map(|ring| ring.iter().map(|at| plane.back(*at)).collect());
            Self::Polygon(rings.collect())
        });
        let made = Self::gathered(parts.collect());
        Ok(if made.is_empty() { Self::empty(2) } else { with_heights(made, &[self]) })
    }

    /// Converts the areas to polygons whose rings neither cross nor overlap.
    fn plans(&self, method: &str) -> Result<(Plane, Vec<Polygon>)> {
        let plane = Plane::of(&[self]);
        if self.dimension() < 2 || !self.is_sound() {
            return Err(Error::argument(format!("{method} takes areas, not a {}", self.kind().name()))
                .help("buffer converts lines and points to an area"));
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
