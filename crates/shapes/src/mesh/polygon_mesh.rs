//! Meshes of flat polygons that share their points.

use std::sync::OnceLock;

use burgeon_geometry::{Polygon, Rings};
use glam::{DMat3, DVec2, DVec3};
use rustc_hash::FxHashMap;
use smallvec::SmallVec;

use crate::style::SharedStyle;

/// Flat polygons with holes that share their points.
///
/// Outer rings are counter-clockwise seen from outside, holes clockwise. Faces that share an edge refer to the same
/// points.
#[derive(Debug, Clone, Default)]
pub struct PolygonMesh {
    /// Points (m).
    pub points: Vec<DVec3>,
    /// Faces.
    pub faces: Vec<PolygonFace>,
    /// Set by the first question whether the mesh is closed.
    pub(super) closed: OnceLock<bool>,
}

/// A face of a [`PolygonMesh`].
#[derive(Debug, Clone, Default)]
pub struct PolygonFace {
    /// Rings of point numbers: the outer ring, and the holes.
    pub rings: SmallVec<[Vec<u32>; 1]>,
    /// Tags and colour.
    pub style: SharedStyle,
}

impl PolygonFace {
    /// Creates a face without holes and tags.
    pub(crate) fn of(ring: &[u32], style: &SharedStyle) -> Self {
        Self { rings: smallvec::smallvec![ring.to_vec()], style: style.clone() }
    }

    /// Returns the edges of all rings, in their direction.
    pub fn edges(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        self.rings
            .iter()
            .flat_map(|ring| (0..ring.len()).map(move |index| [ring[index], ring[(index + 1) % ring.len()]]))
    }
}

impl PolygonMesh {
    /// Creates a mesh of points and faces.
    pub fn new(points: Vec<DVec3>, faces: Vec<PolygonFace>) -> Self {
        Self { points, faces, closed: OnceLock::new() }
    }

    /// Returns the position (m) of a point.
    #[inline]
    pub fn at(&self, point: u32) -> DVec3 {
        self.points[point as usize]
    }

    /// Returns the vector area (m²) of a face: its normal, as long as its area.
    ///
    /// Method: Newell's, relative to the first point.
    pub fn area_vector(&self, face: &PolygonFace) -> DVec3 {
        let Some(&first) = face.rings.first().and_then(|ring| ring.first()) else { return DVec3::ZERO };
        let base = self.at(first);
        let sum: DVec3 =
            face.edges().map(|[from, to]| (self.at(from) - base).cross(self.at(to) - base)).sum();
        sum / 2.0
    }

    /// Returns the unit normal of a face; zero without area.
    pub fn normal(&self, face: &PolygonFace) -> DVec3 {
        self.area_vector(face).normalize_or_zero()
    }

    /// Returns the centroid (m) of a face, and its area (m²).
    pub fn centroid(&self, face: &PolygonFace) -> (DVec3, f64) {
        let normal = self.normal(face);
        let Some(&first) = face.rings.first().and_then(|ring| ring.first()) else {
            return (DVec3::ZERO, 0.0);
        };
        let base = self.at(first);
        let (mut sum, mut twice) = (DVec3::ZERO, 0.0);
        for [from, to] in face.edges() {
            let (a, b) = (self.at(from) - base, self.at(to) - base);
            let area = a.cross(b).dot(normal);
            sum += (a + b) * area;
            twice += area;
        }
        if twice > 0.0 { (base + sum / (3.0 * twice), twice / 2.0) } else { (base, 0.0) }
    }

    /// Returns the area (m²) of all faces.
    pub fn area(&self) -> f64 {
        self.faces.iter().map(|face| self.area_vector(face).length()).sum()
    }

    /// Returns the enclosed volume (m³); undefined for an open mesh.
    ///
    /// Method: the divergence theorem, relative to the first point.
    pub fn volume(&self) -> f64 {
        let Some(&base) = self.points.first() else { return 0.0 };
        let part = |face: &PolygonFace| {
            let first = face.rings.first().and_then(|ring| ring.first());
            first.map_or(0.0, |&first| (self.at(first) - base).dot(self.area_vector(face)) / 3.0)
        };
        self.faces.iter().map(part).sum()
    }

    /// Returns a face in the plane of `axes` (x and y), with all its rings.
    pub(crate) fn flat_rings(&self, face: &PolygonFace, axes: DMat3, origin: DVec3) -> Rings<DVec2> {
        let turn = axes.transpose();
        let flat = |point: &u32| (turn * (self.at(*point) - origin)).truncate();
        Rings(face.rings.iter().map(|ring| ring.iter().map(flat).collect()).collect())
    }

    /// Returns a face as a polygon in the plane of `axes`; `None` if its rings are not valid.
    pub(crate) fn flat_polygon(&self, face: &PolygonFace, axes: DMat3, origin: DVec3) -> Option<Polygon> {
        Polygon::turned(self.flat_rings(face, axes, origin)).ok()
    }

    /// Returns the mesh after moving every point. If `transform` mirrors, faces are reversed.
    #[must_use]
    pub fn translate(&self, transform: impl Fn(DVec3) -> DVec3, mirrors: bool) -> Self {
        let points = self.points.iter().map(|point| transform(*point)).collect();
        let mut faces = self.faces.clone();
        if mirrors {
            faces.iter_mut().flat_map(|face| &mut face.rings).for_each(|ring| ring.reverse());
        }
        Self { points, faces, closed: self.closed.clone() }
    }

    /// Returns the faces with these numbers, with the points that they use.
    #[must_use]
    pub(crate) fn select(&self, numbers: impl IntoIterator<Item = usize>) -> Self {
        let mut renumbered: FxHashMap<u32, u32> = FxHashMap::default();
        let mut part = Self::default();
        for number in numbers {
            let mut face = self.faces[number].clone();
            for point in face.rings.iter_mut().flatten() {
                let (points, at) = (&mut part.points, self.at(*point));
                *point = *renumbered.entry(*point).or_insert_with(|| {
                    points.push(at);
                    u32::try_from(points.len() - 1).unwrap_or(u32::MAX)
                });
            }
            part.faces.push(face);
        }
        part
    }

    /// Returns the approximate memory (bytes).
    pub(crate) fn memory(&self) -> usize {
        let ring = |ring: &Vec<u32>| ring.len() * size_of::<u32>();
        let face = |face: &PolygonFace| size_of::<PolygonFace>() + face.rings.iter().map(ring).sum::<usize>();
        self.points.len() * size_of::<DVec3>() + self.faces.iter().map(face).sum::<usize>()
    }
}
