//! A network on a terrain: the heights of its streets, the ground under them, and the objects next to them.

use std::sync::Arc;

use glam::DVec3;

use super::object::Network;
use crate::terrain::{GroundStreets, StreetsOnGround};
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_geometry::Polygon;
use burgeon_kit::{Answer, Expectation, Parameter, Table, TableKey, Value, Vector};
use burgeon_spatial::Geometry;
use burgeon_streets::{SlopeOptions, StreetArea, StreetFit, StreetFooting, StreetPiece, VergeKind};
use burgeon_terrain::{Edit, GroundBed, GroundCut, GroundCuts};

/// Distance (m) of the ground below the edge of a sidewalk.
const FLUSH: f64 = 0.02;
/// Minimum distance (m) of the ground below a bridge.
const BELOW: f64 = 0.05;
/// Maximum slope (m/m) of the ground next to a street.
const BATTER: f64 = 2.0 / 3.0;
/// Maximum distance (m) from a street at which the ground changes.
const FARTHEST: f64 = 80.0;
/// Number of cells on each side that a height of the ground depends on.
const CELLS: f64 = 2.2;
/// Number of cells next to a street that are level with its sidewalks.
const VERGE: f64 = 1.6;
/// Height (m) above or below the ground beyond which a warning reports a street.
const DEEP: f64 = 8.0;
/// Height (m) above or below the visible ground beyond which a warning reports hidden streets.
const OFF: f64 = 0.5;
/// Minimum height (m) of streets above water, and of bridges.
const DRY: [f64; 2] = [0.8, 3.0];

/// Positions next to streets, as records for scripts.
pub struct VergeRecords(Vec<Value>);

impl Answer for VergeRecords {
    fn luau() -> String {
        "{ { id: string, geometry: Geometry, place: Vector, heading: number, street_depth: number } }".into()
    }

    fn answer(self) -> Result<Value> {
        Ok(self.0.into_value())
    }
}

impl Network {
    /// Returns the heights of the streets, computed once per version of the network.
    pub(super) fn fit(&self) -> Result<Arc<StreetFit>> {
        let version = self.network.version();
        if let Some((known, fit)) = self.fit.get()
            && *known == version
        {
            return Ok(Arc::clone(fit));
        }
        let fit = Arc::new(self.lay_streets()?);
        // A result of an earlier version remains stored until the pass ends.
        let _ = self.fit.set((version, Arc::clone(&fit)));
        Ok(fit)
    }

    fn lay_streets(&self) -> Result<StreetFit> {
        let Some(ground) = &self.options.on else { return Ok(self.raise_bridges()) };
        let water = self.water_level();
        let slopes = SlopeOptions {
            max_slope: self.options.max_slope / 100.0,
            least: DRY.map(|above| water.map(|level| level + above)),
        };
        let height = |at: glam::DVec2| ground.height(Vector(at.extend(0.0))).ok();
        self.network.lay(self.surface_options(), slopes, height).map_err(|at| {
            Error::argument(format!(
                "network: on: the terrain has no ground at ({:.1}, {:.1}), below a street",
                at.x, at.y
            ))
            .help("enlarge the terrain, derive it before, or keep streets on it: network { limit = ... }")
        })
    }

    /// Computes the heights of streets without a terrain: some streets rise to bridges over others.
    fn raise_bridges(&self) -> StreetFit {
        let is_above = |piece: &StreetPiece| piece.attributes.level > 0;
        if !self.network.pieces().any(|(_, piece)| is_above(piece)) {
            return StreetFit::default();
        }
        let slopes = SlopeOptions { max_slope: self.options.max_slope / 100.0, least: [None; 2] };
        self.network.lay(self.surface_options(), slopes, |_| Some(0.0)).unwrap_or_default()
    }

    /// Returns the height (m) of the water under bridges.
    pub(super) fn water_level(&self) -> Option<f64> {
        self.options.water_level.or_else(|| self.options.on.as_ref()?.water_level())
    }

    /// Returns the height (m) of the ground next to sidewalks above the carriageway.
    fn rise(&self) -> f64 {
        (self.options.kerb - FLUSH).max(0.0)
    }

    /// Returns the warning about streets above or below the visible ground. Only a terrain that is created after the
    /// streets can match them.
    pub(super) fn hidden_warning(&self) -> Result<Option<Warning>> {
        if self.network.size() == 0 || !self.options.on.as_ref().is_some_and(|ground| ground.is_visible()) {
            return Ok(None);
        }
        let fit = self.fit()?;
        let deepest = fit.depths.iter().copied().fold(0.0, f64::max);
        Ok((deepest > OFF).then(|| {
            let text = "network: on: the visible terrain is not adapted to the streets, so some streets are below or above the ground";
            Warning::new(WarningKind::Doubtful, text).help(
                "set visible = false for that terrain, and create a second one of the same form with under = these streets",
            )
        }))
    }

    /// Returns the height (m) of the sidewalks at the point of the nearest street that is closest to a position.
    pub(super) fn height_at(&self, place: DVec3) -> Result<f64> {
        let Some((piece, _)) = self.network.nearest(place.truncate()) else { return Ok(0.0) };
        let fit = self.fit()?;
        Ok(fit.profiles.height_near(&self.network, piece, place.truncate()) + self.options.kerb)
    }

    /// Returns the positions for an object type next to the streets. Fails if the object type is unknown.
    pub(super) fn verge_of(&self, what: &str) -> Result<VergeRecords> {
        let thing = match what {
            "tree" => VergeKind::Tree,
            "lamp" => VergeKind::Lamp,
            _ => {
                let message = format!("unknown object {what:?} along streets");
                return Err(Error::not_found("thing", what, ["tree", "lamp"], message)
                    .help("use \"tree\" or \"lamp\""));
            }
        };
        let fit = self.fit()?;
        let places = self.network.verge(self.surface_options(), &fit.profiles, &self.kinds, thing);
        let record = |found: &burgeon_streets::VergePlace| {
            let depth = self.network.attributes(found.piece).depth;
            let place = found.place + DVec3::Z * self.options.kerb;
            let fields = [
                ("id", Value::Text(format!("{what} {:.2} {:.2}", place.x, place.y).into())),
                ("geometry", Geometry::Point(Some(place)).into_value()),
                ("place", place.into_value()),
                ("heading", found.heading.into_value()),
                ("street_depth", depth.into_value()),
            ];
            let entries =
                fields.into_iter().map(|(name, value)| (TableKey::Name(name.into()), value)).collect();
            Value::Table(Arc::new(Table { class: None, entries }))
        };
        Ok(VergeRecords(places.iter().map(record).collect()))
    }
}

impl GroundStreets for Network {
    fn bed(&self, cell: f64, error: f64) -> Result<Vec<Edit>> {
        let fit = self.fit()?;
        let rise = self.rise();
        let beds: Vec<(GroundBed, bool)> = self
            .network
            .footings(self.surface_options(), &fit.profiles)
            .into_iter()
            .map(|StreetFooting { line, width, piece, is_below }| {
                // The ground is straight between cells, even if the street bends.
                let sink = if is_below { BELOW + error + 0.6 * steepest(&line) * cell } else { -rise };
                let depth = piece.and_then(|piece| fit.depths.get(piece as usize)).copied();
                let margin = ((depth.unwrap_or(DEEP) + sink.abs() + 4.0) / BATTER).min(FARTHEST);
                let line = line.iter().map(|at| [at.x, at.y, at.z - sink]).collect();
                let width = width + 2.0 * if is_below { CELLS } else { VERGE } * cell;
                (GroundBed { line, width, is_area: piece.is_none(), slope: BATTER, margin }, is_below)
            })
            .collect();
        let raised = beds.iter().filter(|(_, is_below)| !is_below);
        // All beds are raised before any is lowered, so that the ground is never above a street.
        let mut edits: Vec<Edit> = raised.map(|(bed, _)| Edit::Embank { bed: bed.clone() }).collect();
        edits.extend(beds.into_iter().map(|(bed, _)| Edit::Excavate { bed }));
        Ok(edits)
    }

    fn ground_cuts(&self, lift: f64) -> Result<GroundCuts> {
        let fit = self.fit()?;
        let areas = self.network.ground_areas(self.surface_options(), &fit.profiles);
        let by = DVec3::Z * (self.rise() - lift);
        let cuts = areas.into_iter().filter_map(|StreetArea { outline, line }| {
            let outline = Polygon::turned(vec![outline]).ok()?;
            Some(GroundCut { outline, line: line.into_iter().map(|at| at + by).collect() })
        });
        Ok(GroundCuts::new(cuts.collect()))
    }

    fn steep_warning(&self) -> Result<Option<Warning>> {
        let fit = self.fit()?;
        let deep = fit.depths.iter().filter(|depth| **depth > DEEP).count();
        let deepest = fit.depths.iter().copied().fold(0.0, f64::max);
        Ok((deep > 0).then(|| {
            let text = format!(
                "network: {deep} of {} street segments are more than {DEEP} m above or below the ground, up to {deepest:.1} m, to keep max_slope = {} %",
                self.network.size(),
                self.options.max_slope
            );
            Warning::new(WarningKind::Doubtful, text)
                .help("set a greater max_slope, or keep streets away from steep ground: network { obstacles = ... }")
        }))
    }
}

/// Allows a terrain to take a script's network as its streets.
impl Parameter for StreetsOnGround {
    fn luau() -> String {
        Arc::<Network>::luau()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let network: Arc<Network> = Parameter::from_value(value)?;
        Ok(Self(network))
    }

    fn into_value(self) -> Value {
        Value::Object(self.0)
    }
}

/// Returns the maximum slope (m/m) of a line.
fn steepest(line: &[DVec3]) -> f64 {
    let slope = |pair: &[DVec3]| {
        let way = pair[1] - pair[0];
        way.z.abs() / way.truncate().length().max(1e-9)
    };
    line.windows(2).map(slope).fold(0.0, f64::max)
}
