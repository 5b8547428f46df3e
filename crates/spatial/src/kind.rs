//! Kinds of geometry.

/// The kinds of geometry.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum GeometryKind {
    /// A place.
    Point,
    /// A way from place to place.
    Line,
    /// An area with holes.
    Polygon,
    /// Places.
    MultiPoint,
    /// Lines.
    MultiLine,
    /// Polygons.
    MultiPolygon,
    /// Geometries of any kinds.
    Collection,
}

impl GeometryKind {
    /// All kinds.
    pub const ALL: [Self; 7] = [
        Self::Point,
        Self::Line,
        Self::Polygon,
        Self::MultiPoint,
        Self::MultiLine,
        Self::MultiPolygon,
        Self::Collection,
    ];

    /// The kinds of one part.
    pub const SINGLE: [Self; 3] = [Self::Point, Self::Line, Self::Polygon];

    /// Its name in scripts.
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

    /// Its name in well-known text.
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

    /// Its number in well-known binary.
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
