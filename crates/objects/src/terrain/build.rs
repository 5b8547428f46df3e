//! The construction of a terrain's world from its options.

use std::sync::Arc;

use glam::DVec2;

use super::options::TerrainOptions;
use super::rules;
use crate::Elevation;
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Result};
use burgeon_base::text::number;
use burgeon_terrain::{DivisionRules, HeightSource, LevelRules, World};

/// Creates the world that `options` describe. Fails if an option is invalid.
pub(super) fn world(options: &TerrainOptions) -> Result<World> {
    if !(options.size > 0.0 && options.size <= 1e9) {
        return Err(Error::argument(format!("terrain: size is {} m", number(options.size)))
            .help("use a length above 0 and up to 1e9 m"));
    }
    if options.error.is_some_and(|error| error < 0.0) {
        return Err(Error::argument("terrain: error is below 0").help("use metres of at least 0"));
    }
    let masks = options.covers.iter().map(|cover| &cover.on);
    if masks.chain(options.plants.iter().map(|plants| &plants.on)).any(|mask| !mask.latitude.is_empty()) {
        return Err(Error::argument("terrain: flat ground has no latitude")
            .help("use height or slope instead, or a planet"));
    }
    if options.rules.0.is_empty() && options.elevation.is_none() {
        return Err(rules::none("terrain"));
    }
    let corner = options.position.0.truncate() - options.size / 2.0;
    let fine = match &options.elevation {
        Some(elevation) => finer(elevation, corner, options.size)?,
        None => 0,
    };
    let mut built =
        options.rules.build("terrain", options.start.as_ref(), (options.height, options.decay), fine)?;
    if options.elevation.is_some() {
        let level = LevelRules {
            from: 0,
            rules: DivisionRules::None,
            start: 0,
            height: 0.0,
            rest: Vec::new(),
            names: Arc::default(),
        };
        built.layers.insert(0, level);
    }
    Ok(World {
        corner,
        size: options.size,
        layers: built.layers,
        smooth: options.smooth,
        remap: remap(&options.remap)?,
        key: built.drawn.then(ModuleKey::default),
        measured: options.elevation.clone().map(|elevation| Arc::new(elevation) as Arc<dyn HeightSource>),
    })
}

/// Converts the pairs of heights (m) of `remap`. Fails if they are not in ascending order.
fn remap(pairs: &[Vec<f64>]) -> Result<Vec<[f64; 2]>> {
    let wrong = |what: String| {
        Error::argument(format!("terrain: {what}"))
            .help("write remap = { { -100, 0 }, { 0, 10 }, { 100, 80 } }: pairs from lower to higher heights")
    };
    let pair = |pair: &Vec<f64>| <[f64; 2]>::try_from(pair.as_slice()).ok();
    let pairs = pairs.iter().map(pair).collect::<Option<Vec<_>>>();
    let pairs = pairs.ok_or_else(|| wrong("remap has an item that is not a pair of heights".into()))?;
    if let Some(pair) = pairs.windows(2).find(|pair| pair[0][0] >= pair[1][0]) {
        return Err(wrong(format!("remap decreases from {} to {}", pair[0][0], pair[1][0])));
    }
    Ok(pairs)
}

/// Number of positions along a side of a terrain at which the elevation is checked.
const PIECES: u32 = 64;

/// Returns the first level whose cells are smaller than the distance between the samples of `elevation`. Fails unless
/// the elevation covers the square of `size` (m) from `corner` (m).
fn finer(elevation: &Elevation, corner: DVec2, size: f64) -> Result<u32> {
    // A projected raster may lack heights in the middle of a side.
    let sides = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y];
    let along =
        (0..4).flat_map(|side| (0..PIECES).map(move |part| (side, f64::from(part) / f64::from(PIECES))));
    for (side, part) in along {
        let at = corner + sides[side].lerp(sides[(side + 1) % 4], part) * size;
        if elevation.height_at(at).is_none() {
            let (low, high) = (elevation.low(), elevation.high());
            return Err(Error::argument(format!("terrain: the elevation has no height at ({:.1}, {:.1})", at.x, at.y)).help(
                format!(
                    "it extends from ({:.1}, {:.1}) to ({:.1}, {:.1}) m: make the terrain smaller, or move it with position",
                    low.x, low.y, high.x, high.y
                ),
            ));
        }
    }
    let levels = (size / elevation.step()).log2().max(0.0).ceil();
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 30")]
    let levels = levels.min(30.0) as u32;
    Ok(levels.max(1))
}
