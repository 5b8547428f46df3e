//! Writer of well-known binary.

use burgeon_geometry::Rings;
use glam::DVec3;

use crate::Geometry;

impl Geometry {
    /// Returns ISO well-known binary, little-endian, with Z if a point has a height.
    ///
    /// ```
    /// use burgeon_spatial::Geometry;
    ///
    /// let line = Geometry::from_wkt("LINESTRING Z (0 0 1, 2 0 1)")?;
    /// assert_eq!(Geometry::from_wkb(&line.to_wkb())?, line);
    /// # Ok::<(), burgeon_base::error::Error>(())
    /// ```
    pub fn to_wkb(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        let heights = self.has_heights();
        write(self, &mut bytes, heights, if heights { 1000 } else { 0 }, None);
        bytes
    }

    /// Returns extended well-known binary, as PostGIS uses it, little-endian, with the number of a reference
    /// system.
    pub fn to_ewkb(&self, srid: Option<u32>) -> Vec<u8> {
        let mut bytes = Vec::new();
        let heights = self.has_heights();
        write(self, &mut bytes, heights, if heights { 0x8000_0000 } else { 0 }, srid);
        bytes
    }
}

/// Flag of extended binary for the number of a reference system.
const SRID: u32 = 0x2000_0000;

fn write(geometry: &Geometry, bytes: &mut Vec<u8>, heights: bool, of_z: u32, srid: Option<u32>) {
    let code = geometry.kind().code() + of_z;
    head(bytes, code + srid.map_or(0, |_| SRID));
    bytes.extend(srid.into_iter().flat_map(u32::to_le_bytes));
    let kind = |kind: crate::GeometryKind| kind.code() + of_z;
    match geometry {
        // An empty point is written as NaN coordinates.
        Geometry::Point(point) => place(bytes, point.unwrap_or(DVec3::NAN), heights),
        Geometry::Line(line) => points(bytes, line, heights),
        Geometry::Polygon(polygon) => rings(bytes, polygon, heights),
        Geometry::MultiPoint(places) => {
            count(bytes, places.len());
            for point in places {
                head(bytes, kind(crate::GeometryKind::Point));
                place(bytes, *point, heights);
            }
        }
        Geometry::MultiLine(lines) => {
            count(bytes, lines.len());
            for line in lines {
                head(bytes, kind(crate::GeometryKind::Line));
                points(bytes, line, heights);
            }
        }
        Geometry::MultiPolygon(polygons) => {
            count(bytes, polygons.len());
            for polygon in polygons {
                head(bytes, kind(crate::GeometryKind::Polygon));
                rings(bytes, polygon, heights);
            }
        }
        Geometry::Collection(members) => {
            count(bytes, members.len());
            members.iter().for_each(|member| write(member, bytes, heights, of_z, None));
        }
    }
}

fn head(bytes: &mut Vec<u8>, code: u32) {
    bytes.push(1);
    bytes.extend(code.to_le_bytes());
}

fn count(bytes: &mut Vec<u8>, count: usize) {
    bytes.extend(u32::try_from(count).unwrap_or(u32::MAX).to_le_bytes());
}

fn place(bytes: &mut Vec<u8>, point: DVec3, heights: bool) {
    let numbers = point.to_array();
    numbers[..2 + usize::from(heights)].iter().for_each(|number| bytes.extend(number.to_le_bytes()));
}

fn points(bytes: &mut Vec<u8>, points: &[DVec3], heights: bool) {
    count(bytes, points.len());
    points.iter().for_each(|point| place(bytes, *point, heights));
}

/// Writes rings, each with its first point repeated at its end.
fn rings(bytes: &mut Vec<u8>, rings: &Rings, heights: bool) {
    count(bytes, rings.len());
    for ring in rings.iter() {
        count(bytes, if ring.is_empty() { 0 } else { ring.len() + 1 });
        ring.iter().chain(ring.first()).for_each(|point| place(bytes, *point, heights));
    }
}
