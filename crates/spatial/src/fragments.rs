//! Decomposition of a geometry, one level at a time.

use super::Geometry;
use super::parts::closed;

impl Geometry {
    /// Returns the components of the geometry; `None` for a point.
    ///
    /// The components are the geometries of a collection, the parts of a multi-geometry, the rings of a
    /// polygon as closed lines, the segments of a line, or the two points of a segment. Segments without
    /// length are omitted.
    pub fn fragments(&self) -> Option<Vec<Self>> {
        Some(match self {
            Self::Point(Some(_)) => return None,
            Self::Point(None) => Vec::new(),
            Self::MultiPoint(_) | Self::MultiLine(_) | Self::MultiPolygon(_) | Self::Collection(_) => {
                self.geometries()
            }
            Self::Polygon(rings) => rings.iter().map(|ring| Self::Line(closed(ring))).collect(),
            Self::Line(points) if points.len() == 2 => points.iter().copied().map(Self::point).collect(),
            Self::Line(points) => {
                let segments = points.windows(2).filter(|ends| ends[0] != ends[1]);
                segments.map(|ends| Self::Line(ends.to_vec())).collect()
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Decomposes `geometries` level by level; returns the number of geometries and of points of each level.
    fn levels(mut geometries: Vec<Geometry>) -> Vec<(usize, usize)> {
        let mut levels = Vec::new();
        loop {
            levels.push((geometries.len(), geometries.iter().map(|it| it.points().count()).sum()));
            let parts: Vec<Geometry> = geometries.iter().filter_map(Geometry::fragments).flatten().collect();
            if parts.is_empty() {
                return levels;
            }
            geometries = parts;
        }
    }

    #[test]
    fn a_collection_comes_apart_into_points_level_by_level() {
        let read = |text: &str| Geometry::from_wkt(text).unwrap();
        for (text, expected) in [
            ("POINT (1 2)", &[(1, 1)][..]),
            ("LINESTRING (0 0, 1 0)", &[(1, 2), (2, 2)]),
            ("LINESTRING (0 0, 1 0, 1 0, 1 1)", &[(1, 4), (2, 4), (4, 4)]),
            ("POLYGON ((0 0, 4 0, 4 4), (1 1, 1 2, 2 2))", &[(1, 6), (2, 8), (6, 12), (12, 12)]),
            ("MULTIPOINT (0 0, 1 1)", &[(1, 2), (2, 2)]),
            (
                "GEOMETRYCOLLECTION (POLYGON ((0 0, 4 0, 4 4)), LINESTRING (0 0, 1 0, 2 0), POINT (5 5))",
                &[(1, 7), (3, 7), (3, 8), (7, 10), (6, 6)],
            ),
            ("GEOMETRYCOLLECTION EMPTY", &[(1, 0)]),
            ("POINT EMPTY", &[(1, 0)]),
        ] {
            assert_eq!(levels(vec![read(text)]), expected, "{text}");
        }
        assert_eq!(read("POINT (1 2)").fragments(), None);
        assert_eq!(read("POINT EMPTY").fragments(), Some(Vec::new()));
    }
}
