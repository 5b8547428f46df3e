//! Access to the components of a geometry.

use burgeon_geometry::{Rings, planar};
use glam::DVec3;
use rustc_hash::FxHashMap;

use super::Geometry;
use super::plane::{collect_lines, collect_polygons};

impl Geometry {
    /// Returns the members of a multi-geometry or collection, otherwise the geometry itself; empty for an
    /// empty geometry.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let trees = Geometry::from_wkt("MULTIPOINT ((1 2), (3 4))")?;
    /// assert_eq!(trees.geometries()[1].to_wkt(), "POINT (3 4)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn geometries(&self) -> Vec<Self> {
        match self {
            Self::Point(None) => Vec::new(),
            Self::Point(_) | Self::Line(_) | Self::Polygon(_) if self.is_empty() => Vec::new(),
            Self::Point(_) | Self::Line(_) | Self::Polygon(_) => vec![self.clone()],
            Self::MultiPoint(points) => points.iter().map(|point| Self::Point(Some(*point))).collect(),
            Self::MultiLine(lines) => lines.iter().cloned().map(Self::Line).collect(),
            Self::MultiPolygon(polygons) => polygons.iter().cloned().map(Self::Polygon).collect(),
            Self::Collection(members) => members.clone(),
        }
    }

    /// Returns the outer ring of a polygon as a closed line; empty for an empty polygon, `None` for other
    /// types.
    pub fn exterior_ring(&self) -> Option<Self> {
        let Self::Polygon(rings) = self else { return None };
        Some(Self::Line(rings.first().map(|ring| closed(ring)).unwrap_or_default()))
    }

    /// Returns the holes of a polygon as closed lines; `None` for other types.
    pub fn interior_rings(&self) -> Option<Vec<Self>> {
        let Self::Polygon(rings) = self else { return None };
        Some(rings.iter().skip(1).map(|ring| Self::Line(closed(ring))).collect())
    }

    /// Returns the points of a line, in order; `None` for other types.
    pub fn line_points(&self) -> Option<&[DVec3]> {
        if let Self::Line(points) = self { Some(points) } else { None }
    }

    /// Returns the number of points; the first point of a ring counts twice.
    pub fn num_points(&self) -> usize {
        let mut rings = 0;
        collect_polygons(self, &mut |polygon| {
            rings += polygon.iter().filter(|ring| !ring.is_empty()).count()
        });
        self.points().count() + rings
    }

    /// Returns the number of geometries; 0 for an empty geometry.
    pub fn num_geometries(&self) -> usize {
        match self {
            Self::MultiPoint(points) => points.len(),
            Self::MultiLine(lines) => lines.len(),
            Self::MultiPolygon(polygons) => polygons.len(),
            Self::Collection(members) => members.len(),
            single => usize::from(!single.is_empty()),
        }
    }

    /// Returns the straight segments of all lines and rings, each as a line of two points.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let walls = Geometry::from_wkt("POLYGON ((0 0, 4 0, 4 3, 0 0))")?.segments();
    /// assert_eq!(walls.iter().map(Geometry::length).collect::<Vec<_>>(), [4.0, 3.0, 5.0]);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn segments(&self) -> Vec<Self> {
        let segment = |ends: &[DVec3]| (ends[0] != ends[1]).then(|| Self::Line(ends.to_vec()));
        let mut found = Vec::new();
        collect_lines(self, &mut |line| found.extend(line.windows(2).filter_map(segment)));
        collect_polygons(self, &mut |rings| {
            let edges = rings.iter().flat_map(|ring| planar::edges(ring));
            found.extend(edges.filter_map(|edge| segment(&edge)));
        });
        found
    }

    /// Returns the combinatorial boundary: the rings of areas, and the points where an odd number of lines
    /// end. Empty for points and closed lines.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let path = Geometry::from_wkt("MULTILINESTRING ((0 0, 1 0), (1 0, 2 0))")?;
    /// assert_eq!(path.boundary().to_wkt(), "MULTIPOINT ((0 0), (2 0))");
    /// let lawn = Geometry::from_wkt("POLYGON ((0 0, 4 0, 4 3, 0 0))")?;
    /// assert_eq!(lawn.boundary().to_wkt(), "LINESTRING (0 0, 4 0, 4 3, 0 0)");
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn boundary(&self) -> Self {
        let mut rings = Vec::new();
        collect_polygons(self, &mut |polygon: &Rings| {
            rings.extend(polygon.iter().map(|ring| Self::Line(closed(ring))));
        });
        let mut ends: Vec<(DVec3, bool)> = Vec::new();
        let mut known: FxHashMap<[u64; 2], usize> = FxHashMap::default();
        collect_lines(self, &mut |line| {
            let [Some(first), Some(last)] = [line.first(), line.last()] else { return };
            if first.truncate() == last.truncate() {
                return;
            }
            for end in [first, last] {
                // Adding 0 turns -0 into 0.
                let key = end.truncate().to_array().map(|number| (number + 0.0).to_bits());
                let index = *known.entry(key).or_insert_with(|| {
                    ends.push((*end, false));
                    ends.len() - 1
                });
                ends[index].1 ^= true;
            }
        });
        let ends: Vec<DVec3> = ends.into_iter().filter(|(_, is_odd)| *is_odd).map(|(end, _)| end).collect();
        let dimension = self.dimension();
        match (rings.is_empty(), ends.is_empty()) {
            (true, true) if dimension == 1 => Self::MultiPoint(ends),
            (true, true) => Self::empty(dimension.saturating_sub(1)),
            (true, false) => Self::MultiPoint(ends),
            (false, true) => Self::gathered(rings),
            (false, false) => {
                rings.push(Self::MultiPoint(ends));
                Self::Collection(rings)
            }
        }
    }
}

/// Returns a ring with its first point repeated at its end.
pub(crate) fn closed(ring: &[DVec3]) -> Vec<DVec3> {
    ring.iter().chain(ring.first()).copied().collect()
}
