//! The ground of blocks as a network shows it, and the water between.

use glam::DVec3;

use super::Network;
use super::draw::{add_points, upright};
use burgeon_base::error::Result;
use burgeon_geometry::Polygon;
use burgeon_geometry::planar::distance;
use burgeon_kit::Color;
use burgeon_scene::Part;
use burgeon_streets::{StreetFit, StreetProfiles};

/// The colour of water.
pub(super) const WATER: Color = Color([0.055, 0.105, 0.125, 1.0]);
/// The height (m) of water, where nothing tells it.
pub(super) const WATER_LEVEL: f64 = -3.0;
/// How far (m) the banks of water reach below it.
const BANK: f64 = 2.0;
/// A place that is nearer (m) to an outline is on it.
const ON: f64 = 1e-3;

impl Network {
    /// Fills the blocks; gives the height (m) of the water that is to be drawn between them.
    pub(super) fn draw_ground(&self, part: &mut Part, fit: &StreetFit) -> Result<Option<f64>> {
        let kerb = self.options.kerb;
        let is_flat = self.options.on.is_none();
        let level = self.water_level().unwrap_or(WATER_LEVEL);
        // Blocks without a ground are level, also beside a street that rises to a bridge.
        let level_streets = StreetProfiles::default();
        let profiles = if is_flat { &level_streets } else { &fit.profiles };
        for rings in self.network.blocks_at(self.surface_options(), profiles) {
            let block: Polygon<DVec3> = Polygon::new(rings)?;
            let outline = block.flat();
            let is_wet = is_flat && self.water.iter().any(|water| meets(&outline, water));
            if !is_wet {
                let points: Vec<DVec3> = block.points().collect();
                fill(part, &outline, &points, kerb)?;
                continue;
            }
            for dry in outline.without(&self.water) {
                let points: Vec<DVec3> = dry.points().map(|at| at.extend(0.0)).collect();
                fill(part, &dry, &points, kerb)?;
                // Its banks: what the water has cut, and not what the streets bound.
                for [a, b] in dry.edges() {
                    let middle = (a + b) / 2.0;
                    if outline.edges().all(|edge| distance(edge, middle) > ON) {
                        let depth = kerb - level + BANK;
                        upright(part, [a, b].map(|at| at.extend(kerb - depth)), depth);
                    }
                }
            }
        }
        Ok((is_flat && !self.water.is_empty()).then_some(level))
    }
}

/// Draws the surface of waters at a level (m).
pub(super) fn draw_water(part: &mut Part, waters: &[Polygon], level: Option<f64>) -> Result<()> {
    let Some(level) = level else { return Ok(()) };
    for water in waters {
        let points: Vec<DVec3> = water.points().map(|at| at.extend(level)).collect();
        fill(part, water, &points, 0.0)?;
    }
    Ok(())
}

fn fill(part: &mut Part, outline: &Polygon, points: &[DVec3], lift: f64) -> Result<()> {
    let first = add_points(part, points, lift);
    for corners in outline.triangles()? {
        #[allow(clippy::cast_possible_truncation, reason = "a block has few corners")]
        part.triangles.push(corners.map(|corner| corner as u32 + first));
    }
    Ok(())
}

/// Whether the boxes around two areas meet.
fn meets(a: &Polygon, b: &Polygon) -> bool {
    match (a.bounds(), b.bounds()) {
        (Some([a, b]), Some([c, d])) => a.cmple(d).all() && c.cmple(b).all(),
        _ => false,
    }
}
