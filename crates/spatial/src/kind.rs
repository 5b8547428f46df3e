//! Types of geometry.

/// Type of a geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GeometryKind {
    /// A point.
    Point,
    /// A polyline.
    Line,
    /// An area with holes.
    Polygon,
    /// Several points.
    MultiPoint,
    /// Several lines.
    MultiLine,
    /// Several polygons.
    MultiPolygon,
    /// Geometries of any type.
    Collection,
}

impl GeometryKind {
    /// All types.
    pub const ALL: [Self; 7] = [
        Self::Point,
        Self::Line,
        Self::Polygon,
        Self::MultiPoint,
        Self::MultiLine,
        Self::MultiPolygon,
        Self::Collection,
    ];

    /// Types that consist of one part.
    pub const SINGLE: [Self; 3] = [Self::Point, Self::Line, Self::Polygon];

    /// Returns the name in scripts.
    pub fn name(self) -> &'static str {
        match self {
            Self::Point => "point",
            Self::Line => "line",
            Self::Polygon => "polygon",
            Self::MultiPoint => "multipoint",
            Self::MultiLine => "multiline",
            Self::MultiPolygon => "multipolygon",
            Self::Collection => "collection",
        }
    }

    /// Returns the name in GeoJSON.
    pub fn geojson(self) -> &'static str {
        match self {
            Self::Point => "Point",
            Self::Line => "LineString",
            Self::Polygon => "Polygon",
            Self::MultiPoint => "MultiPoint",
            Self::MultiLine => "MultiLineString",
            Self::MultiPolygon => "MultiPolygon",
            Self::Collection => "GeometryCollection",
        }
    }

    /// Returns the name in well-known text.
    pub fn wkt(self) -> &'static str {
        match self {
            Self::Point => "POINT",
            Self::Line => "LINESTRING",
            Self::Polygon => "POLYGON",
            Self::MultiPoint => "MULTIPOINT",
            Self::MultiLine => "MULTILINESTRING",
            Self::MultiPolygon => "MULTIPOLYGON",
            Self::Collection => "GEOMETRYCOLLECTION",
        }
    }

    /// Returns the number in well-known binary.
    pub fn code(self) -> u32 {
        match self {
            Self::Point => 1,
            Self::Line => 2,
            Self::Polygon => 3,
            Self::MultiPoint => 4,
            Self::MultiLine => 5,
            Self::MultiPolygon => 6,
            Self::Collection => 7,
        }
    }
}
