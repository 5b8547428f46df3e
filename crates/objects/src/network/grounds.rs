//! The drawing of the blocks' ground, and of the water between.

use glam::DVec3;

use super::object::Network;
use super::vertices::{add_points, upright};
use burgeon_base::error::Result;
use burgeon_geometry::Polygon;
use burgeon_geometry::planar::distance;
use burgeon_kit::Color;
use burgeon_scene::Part;
use burgeon_streets::{StreetFit, StreetProfiles};

/// Colour of water.
pub(super) const WATER: Color = Color([0.055, 0.105, 0.125, 1.0]);
/// Default height (m) of water.
pub(super) const WATER_LEVEL: f64 = -3.0;
/// Depth (m) of banks below the water.
const BANK: f64 = 2.0;
/// Tolerance (m) within which a point is on an outline.
const ON: f64 = 1e-3;

impl Network {
    /// Fills the blocks, and returns the height (m) of the water to draw between them.
    pub(super) fn draw_ground(&self, part: &mut Part, fit: &StreetFit) -> Result<Option<f64>> {
        let kerb = self.options.kerb;
        let is_flat = self.options.on.is_none();
        let level = self.water_level().unwrap_or(WATER_LEVEL);
        // Blocks without a terrain are level, also next to a street that rises to a bridge.
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
                // Banks are the edges cut by the water, but not the edges along streets.
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

/// Draws the surface of water areas at a level (m).
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

/// Reports whether the bounding boxes of two areas intersect.
fn meets(a: &Polygon, b: &Polygon) -> bool {
    match (a.bounds(), b.bounds()) {
        (Some([a, b]), Some([c, d])) => a.cmple(d).all() && c.cmple(b).all(),
        _ => false,
    }
}
