//! Parts of the surfaces of streets: carriageways, sidewalks, medians, decks and footings.

use glam::{DVec2, DVec3};

use crate::plan::network::PieceId;
use burgeon_geometry::Line;

/// Options for the surfaces of streets.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SurfaceOptions {
    /// Radius (m) of the turning circle at a dead end; no circle if it is less than half of the street's width.
    pub turning: f64,
}

/// Band along the streets around a face, or around the outside of the network.
#[derive(Debug, Clone, PartialEq)]
pub struct Sidewalk {
    /// Edge of the carriageway (m), with the face on its left.
    pub kerb: Vec<DVec3>,
    /// Edge of the block (m), with one point for each point of the kerb.
    pub edge: Vec<DVec3>,
    /// Set if the sidewalk surrounds an area enclosed by streets, counter-clockwise.
    pub is_around_block: bool,
}

/// Triangulated surface: the carriageway of a segment between its junctions, the carriageway of a junction, or a
/// median.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetSurface {
    /// Vertices (m).
    pub points: Vec<DVec3>,
    /// Triangles of vertex indices, counter-clockwise.
    pub triangles: Vec<[u32; 3]>,
    /// Street segment; `None` for a junction.
    pub piece: Option<PieceId>,
    /// Depth of the street in the hierarchy; for a junction, the minimum of its streets.
    pub depth: u32,
}

/// Raised median of a segment.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Median {
    /// Top surface, at the height of the street.
    pub top: StreetSurface,
    /// Kerb (m), with the median on its left; open where the median continues in the next segment.
    pub kerbs: Vec<Line<DVec3>>,
}

/// All surfaces of a network.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetSurfaces {
    /// Carriageways.
    pub carriageways: Vec<StreetSurface>,
    /// Sidewalks.
    pub sidewalks: Vec<Sidewalk>,
    /// Medians between the two directions.
    pub medians: Vec<Median>,
    /// Surfaces that replace the [sidewalks](Self::sidewalks) of overlapping streets.
    pub merged: MergedSurfaces,
}

/// Sidewalks of a network with existing streets, and its bridges over other streets.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MergedSurfaces {
    /// Sidewalks.
    pub walks: Vec<StreetSurface>,
    /// Edges (m) of carriageways, with the carriageway on the right.
    pub kerbs: Vec<[DVec3; 2]>,
    /// Edges (m) of streets on the ground, with the street on the right.
    pub edges: Vec<[DVec3; 2]>,
    /// Decks that carry streets over others.
    pub decks: Vec<StreetDeck>,
}

/// Deck that carries the streets of a level over those of lower levels.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct StreetDeck {
    /// Top surface: carriageways and sidewalks.
    pub surface: StreetSurface,
    /// Edges (m), with the deck on their right, and true if the edge has a railing; there is none where the deck ends.
    pub sides: Vec<([DVec3; 2], bool)>,
    /// Positions of piers (m) at the height of the street, with the direction of the street.
    pub piers: Vec<(DVec3, DVec2)>,
}

/// Ground area below a segment, below a junction, or below the part of a segment before or after its bridge.
#[derive(Debug, Clone, PartialEq)]
pub struct StreetFooting {
    /// Centreline of a segment (m), or outline of a junction.
    pub line: Vec<DVec3>,
    /// Width (m) of a segment; 0 for a junction.
    pub width: f64,
    /// Street segment; `None` for a junction.
    pub piece: Option<PieceId>,
    /// Set if a bridge carries the street over this area.
    pub is_below: bool,
}
