//! The fields of networks.

use std::sync::Arc;

use super::existing::ExistingLines;
use super::kinds::StreetOptions;
use crate::Terrain;
use burgeon_kit::{Color, Vector, fields};
use burgeon_spatial::PolygonArgument;

/// Fields of `network(...)`.
#[fields("network")]
pub struct NetworkOptions {
    /// Start positions of streets (m): junctions 1, 2, 3 and so on. If omitted, the origin; with existing streets, the
    /// origin only if no obstacle is there.
    pub starts: Option<Vec<Vector>>,
    /// Street types, by depth from 0. The last type also applies to greater depths.
    #[default([20.0, 14.0, 11.0].map(StreetOptions::of_width).to_vec())]
    pub streets: Vec<StreetOptions>,
    /// Snap distance (m): the end of a street joins a junction or another street within this distance.
    #[default(25.0)]
    pub snap: f64,
    /// Minimum angle (degrees) between two streets at a junction.
    #[default(45.0)]
    pub min_angle: f64,
    /// Minimum length (m) of a street between two junctions.
    #[default(12.0)]
    pub min_length: f64,
    /// Minimum distance (m) between streets that do not meet.
    #[default(6.0)]
    pub clearance: f64,
    /// Radius (m) of the corners of blocks.
    #[default(4.0)]
    pub corner: f64,
    /// Maximum turn (degrees) to avoid an obstacle.
    #[default(40.0)]
    pub bend: f64,
    /// Maximum length (m) of a bridge over water.
    #[default(0.0)]
    pub bridge: f64,
    /// Areas that no street crosses: polygons.
    #[default(Vec::new())]
    pub obstacles: Vec<PolygonArgument>,
    /// Areas that only bridges cross: polygons.
    #[default(Vec::new())]
    pub water: Vec<PolygonArgument>,
    /// Area that streets stay inside. If omitted, streets are not limited.
    pub limit: Option<PolygonArgument>,
    /// Shorten streets before an obstacle instead of refusing them.
    #[default(true)]
    pub shorten: bool,
    /// Existing streets, which stay unchanged regardless of the constraints: a list of { lines = ..., depth = ...,
    /// width = ..., lanes = ..., level = ... }.
    #[default(Vec::new())]
    pub existing: Vec<ExistingLines>,
    /// Maximum number of street segments.
    #[default(400_000)]
    pub max_segments: u32,
    /// Terrain under the streets, which must already be derived.
    pub on: Option<Arc<Terrain>>,
    /// Maximum slope (%) of streets on the terrain. To keep it, streets cut into the ground or rise above it.
    #[default(10.0)]
    pub max_slope: f64,
    /// Height (m) of the water under bridges. If omitted, the terrain's water level.
    pub water_level: Option<f64>,
    /// Height (m) of kerbs.
    #[default(0.14)]
    pub kerb: f64,
    /// Radius (m) of turning circles at dead ends; 0 for none.
    #[default(0.0)]
    pub turning: f64,
    /// Square dead ends without a turning circle, as at the edge of the map, instead of round ones.
    #[default(false)]
    pub square_ends: bool,
    /// Paint lines and crossings on the streets.
    #[default(true)]
    pub markings: bool,
    /// Colour of carriageways.
    #[default(Color([0.095, 0.098, 0.105, 1.0]))]
    pub asphalt: Color,
    /// Colour of sidewalks.
    #[default(Color([0.45, 0.44, 0.42, 1.0]))]
    pub paving: Color,
    /// Colour of the blocks between the streets. If omitted, blocks are not drawn.
    pub block_color: Option<Color>,
}
