//! The appearance of the ground: layers of colour, blended into an image for each tile.

use std::sync::Arc;

use glam::DVec2;
use rayon::prelude::*;

use burgeon_base::error::Result;
use burgeon_base::{MemoryOwner, srgb_byte};
use burgeon_kit::{Color, Expectation, Field, Parameter, Table, Value, fields};
use burgeon_scene::{Material, Texture};
use burgeon_terrain::{Ground, GroundReader, Tile};

use super::mask::{GroundPoint, Mask, PatchPlace};
use super::object::Terrain;

/// A layer that covers the ground.
#[fields("cover")]
pub struct GroundCover {
    /// Colour of the cover.
    #[default(Color([0.2, 0.25, 0.1, 1.0]))]
    pub color: Color,
    /// Location of the cover. If omitted, everywhere.
    pub on: Mask,
    /// Maximum opacity (0 to 1) of the cover.
    #[default(1.0)]
    pub amount: f64,
}

impl Parameter for GroundCover {
    fn luau() -> String {
        "{ color: Color?, on: Mask?, amount: number? }".into()
    }

    fn fields() -> Vec<Field> {
        Self::fields()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let Value::Table(table) = &value else { return Err(Expectation::new("a table of a cover's fields")) };
        let cover = Self::from_table(table)
            .map_err(|error| Expectation::new(format!("a cover ({})", error.message())))?;
        if !(0.0..=1.0).contains(&cover.amount) {
            return Err(Expectation::new("a cover with an amount from 0 to 1"));
        }
        Ok(cover)
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

/// Maximum number of texels per side of a tile's image.
const MOST_TEXELS: usize = 2048;

/// Returns the image of `tile` with its covers, and the number of texels per side. Its outermost texels are on the
/// tile's border, so that images of adjacent tiles match.
pub(super) fn paint(ground: &Ground, tile: &Tile, covers: &[GroundCover]) -> (Vec<u8>, usize) {
    let (corner, size) = tile.bounds(ground.world());
    // A single tile is seen as a whole; most of many tiles are far from the eye.
    let fine = if ground.tiles().len() == 1 { 2 } else { 1 };
    let across = texels(tile, fine);
    #[allow(clippy::cast_precision_loss, reason = "texels are few")]
    let step = size / (across - 1) as f64;
    let reach = ground.world().cell(tile.level());
    let bent = covers.iter().any(|cover| cover.on.is_bent());
    let bytes = image(across, |row| {
        let mut reader = GroundReader::new(ground);
        let mut point = |column: usize| {
            #[allow(clippy::cast_precision_loss, reason = "texels are few")]
            let offset = DVec2::new(column as f64, (across - 1 - row) as f64) * step;
            let place = (corner + offset).min(corner + size);
            GroundPoint::new(&mut reader, place, reach, bent)
        };
        let points: Vec<GroundPoint<'_>> = (0..across).map(&mut point).collect();
        blend(&points, covers)
    });
    (bytes, across)
}

/// Returns the number of texels per side of a tile's image, with `fine` texels per cell.
pub(crate) fn texels(tile: &Tile, fine: usize) -> usize {
    ((1usize << tile.detail) * fine).min(MOST_TEXELS) + 1
}

/// Creates an image with `across` texels per side. `colors` takes the number of a row from the north, and returns the colours of its
/// texels from the west.
pub(crate) fn image(across: usize, colors: impl Fn(usize) -> Vec<[f32; 3]> + Sync) -> Vec<u8> {
    let row = |row: usize| colors(row).into_iter().flat_map(|color| color.map(srgb_byte)).collect();
    let owner = MemoryOwner::current();
    let rows: Vec<Vec<u8>> = (0..across).into_par_iter().map(|number| owner.charge(|| row(number))).collect();
    rows.concat()
}

/// Returns the colour of each of `points` under `covers`.
pub(crate) fn blend(points: &[GroundPoint<'_>], covers: &[GroundCover]) -> Vec<[f32; 3]> {
    let lowest = covers.first().map_or([0.25, 0.25, 0.2], |cover| [0, 1, 2].map(|at| cover.color.0[at]));
    let mut colors = vec![[0.0; 3]; points.len()];
    let add = |color: &mut [f32; 3], part: [f32; 3], amount: f32| {
        color.iter_mut().zip(part).for_each(|(into, part)| *into += part * amount);
    };
    // From the top down, because what an opaque cover hides needs no noise.
    let mut visible = vec![1.0; points.len()];
    for (number, cover) in covers.iter().enumerate().skip(1).rev() {
        let strengths = cover.on.strengths(points, number as u64, &visible);
        for ((color, visible), strength) in colors.iter_mut().zip(&mut visible).zip(strengths) {
            #[allow(clippy::cast_possible_truncation, reason = "colours are f32")]
            let amount = *visible * (strength * cover.amount) as f32;
            add(color, [0, 1, 2].map(|at| cover.color.0[at]), amount);
            *visible -= amount;
        }
    }
    colors.iter_mut().zip(visible).for_each(|(color, visible)| add(color, lowest, visible));
    colors
}

impl Terrain {
    /// Returns the colour of the whole ground, in linear red, green and blue; `None` if covers or water change it.
    pub fn plain_color(&self) -> Option<[f32; 3]> {
        let has_one = self.options.covers.is_empty() && self.options.water.is_none();
        let [red, green, blue, _] = self.options.color.0;
        has_one.then_some([red, green, blue])
    }

    /// Returns true if the colour of the ground depends on its curvature.
    pub fn is_colored_by_curvature(&self) -> bool {
        self.options.covers.iter().any(|cover| cover.on.is_bent())
    }

    /// Returns the colour, in linear red, green and blue, that the covers and the standing water give to ground of a `height` (m), a
    /// `slope` (degrees) and a `curvature` (1/m) at a place (m). Symbols of cells are those of this terrain.
    pub fn ground_color(&self, place: DVec2, height: f64, slope: f64, curvature: f64) -> [f32; 3] {
        if let Some(water) = self.options.water.as_ref().filter(|water| height < water.level) {
            return water.tint(water.level - height);
        }
        if self.options.covers.is_empty() {
            let [red, green, blue, _] = self.options.color.0;
            return [red, green, blue];
        }
        let symbol = self.ground.symbol(place);
        let place = PatchPlace::Flat(place);
        let point = GroundPoint { place, height, slope, curvature, latitude: 0.0, symbol };
        blend(&[point], &self.options.covers)[0]
    }
}

/// Returns half the size (m) of a texel of an image with `across` texels per side, on a tile of `size` (m): the
/// distance between the border and the centre of a texel.
#[allow(clippy::cast_precision_loss, reason = "texels are few")]
pub(super) fn half_texel(size: f64, across: usize) -> f64 {
    size / (across - 1) as f64 / 2.0
}

/// Creates a material with an image of `across` texels per side, on a tile of `size` (m).
pub(crate) fn material(
    name: String,
    bytes: &[u8],
    across: usize,
    size: f64,
    roughness: f32,
) -> Result<Material> {
    let side = u32::try_from(across).unwrap_or(0);
    let png = burgeon_scene::image::encode_opaque(side, side, bytes)?;
    #[allow(clippy::cast_precision_loss, reason = "texels are few")]
    let whole = size * across as f64 / (across - 1) as f64;
    let texture =
        Texture { path: format!("{name}.png").into(), size: [whole, whole], content: Some(png.into()) };
    Ok(Material { name, base_color: [1.0; 4], roughness, texture: Some(texture), ..Material::default() })
}
