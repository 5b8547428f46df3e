//! Plants and other models that are scattered over the ground. Each depends only on its position, and not on the view.

use std::sync::Arc;

use glam::{DAffine3, DQuat, DVec2, DVec3};
use rayon::prelude::*;

use super::beds::RiverBeds;
use super::mask::{GroundPoint, Mask};
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::random::Stream;
use burgeon_base::{MemoryOwner, Stop};
use burgeon_kit::{Drawing, Expectation, Field, Model, Parameter, Table, Value, fields};
use burgeon_terrain::{Ground, GroundReader};

/// Models that are scattered over the ground.
#[fields("plants")]
pub struct Plants {
    /// Models to scatter, chosen at random with equal probability.
    pub models: Vec<Arc<Model>>,
    /// Number of models per hectare where the mask is strongest.
    #[default(100.0)]
    pub density: f64,
    /// Location of the plants. If omitted, everywhere.
    pub on: Mask,
    /// Minimum and maximum scale factor of the models.
    #[default(vec![0.8, 1.2])]
    pub size: Vec<f64>,
    /// Depth (m) of the models' origins in the ground.
    #[default(0.0)]
    pub sink: f64,
}

/// Maximum number of scattered models.
const MOST: f64 = 5_000_000.0;

impl Parameter for Plants {
    fn luau() -> String {
        "{ models: { Model }, density: number?, on: Mask?, size: { number }?, sink: number? }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = &value else {
            return Err(Expectation::new("a table of the fields of plants"));
        };
        let plants = Self::from_table(table)
            .map_err(|error| Expectation::new(format!("plants ({})", error.message())))?;
        if plants.models.is_empty() {
            return Err(Expectation::new("plants with at least one model: { models = { tree:derive() } }"));
        }
        if plants.density <= 0.0 {
            return Err(Expectation::new("plants with a density above 0"));
        }
        if !matches!(plants.size.as_slice(), [low, high] if 0.0 < *low && low <= high) {
            return Err(Expectation::new("plants with a size { min, max } above 0"));
        }
        Ok(plants)
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

impl Plants {
    /// Places the models on all of `ground` except in the `beds` of rivers. They depend only on the world, the `key`
    /// and their positions.
    pub(super) fn scatter(
        &self,
        ground: &Ground,
        key: ModuleKey,
        beds: &RiverBeds,
        drawing: &mut Drawing,
    ) -> Result<()> {
        let world = ground.world();
        // Level at which each square has at most one model.
        let most = 10_000.0 / self.density;
        let level =
            (0..burgeon_terrain::DEEPEST).find(|level| world.cell(*level).powi(2) <= most).unwrap_or(0);
        let cell = world.cell(level);
        let chance = self.density * cell * cell / 10_000.0;
        let area: f64 = ground.tiles().iter().map(|tile| tile.bounds(world).1.powi(2)).sum();
        let count = area / (cell * cell);
        if count > MOST {
            return Err(Error::limit(Limit::Size, format!("plants: up to {count:.0} models are too many"))
                .help(format!("the maximum is {MOST}: lower the density, or show less of the terrain")));
        }
        for tile in ground.tiles() {
            Stop::check_current()?;
            let (corner, size) = tile.bounds(world);
            let first = (corner - world.corner) / cell;
            #[allow(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "squares are below 2^31"
            )]
            let [x, y, across] =
                [first.x.ceil(), first.y.ceil(), (size / cell).max(1.0).round()].map(|it| it as u64);
            // A square larger than a tile belongs to the tile at its south-west corner.
            if cell > size && (first.fract().abs().max_element() > 1e-9) {
                continue;
            }
            let reach = world.cell(tile.level());
            let owner = MemoryOwner::current();
            let grown: Vec<Vec<(usize, DAffine3)>> = (y..y + across)
                .into_par_iter()
                .map(|y| {
                    let one = |x: u64| self.one(ground, key, (x, y), (cell, chance), reach);
                    let seen = |(_, frame): &(usize, DAffine3)| !beds.contain(frame.translation.truncate());
                    owner.charge(|| (x..x + across).filter_map(one).filter(seen).collect())
                })
                .collect();
            for (model, frame) in grown.into_iter().flatten() {
                drawing.place(&self.models[model], frame);
            }
        }
        Ok(())
    }

    /// Returns the plant of a square, if one grows there: the index of its model and its frame.
    #[allow(clippy::cast_precision_loss, reason = "squares are below 2^31")]
    fn one(
        &self,
        ground: &Ground,
        key: ModuleKey,
        (x, y): (u64, u64),
        (cell, chance): (f64, f64),
        reach: f64,
    ) -> Option<(usize, DAffine3)> {
        let mut stream: Stream = ModuleKey(key.0 ^ (x << 32 | y)).child(0).stream();
        let (luck, along) = (stream.uniform(), DVec2::new(stream.uniform(), stream.uniform()));
        if luck >= chance {
            return None;
        }
        let place = ground.world().corner + (DVec2::new(x as f64, y as f64) + along) * cell;
        // Plants stand on the visible triangles of the ground.
        let shown = ground.shown_height(place)?;
        let spot = GroundPoint::new(&mut GroundReader::new(ground), place, reach, self.on.is_bent());
        if luck >= chance * self.on.at(&spot, key.0) {
            return None;
        }
        let model = stream.below(self.models.len());
        let turn = DQuat::from_rotation_z(stream.uniform() * std::f64::consts::TAU);
        let size = self.size[0] + (self.size[1] - self.size[0]) * stream.uniform();
        let at = place.extend(shown - self.sink);
        Some((model, DAffine3::from_scale_rotation_translation(DVec3::splat(size), turn, at)))
    }
}
