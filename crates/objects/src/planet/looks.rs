//! The appearance of a planet's ground and seas: one image per tile.

use glam::{DVec2, DVec3};

use super::options::PlanetOptions;
use crate::terrain::Water;
use crate::terrain::looks::{blend, image, material, texels};
use crate::terrain::mask::{GroundPoint, PatchPlace};
use burgeon_base::error::Result;
use burgeon_scene::Material;
use burgeon_terrain::Tile;
use burgeon_terrain::globe::{Globe, latitude, place_within};

/// Returns the material named `name` for a tile of a face.
pub(super) fn of(
    options: &PlanetOptions,
    globe: &Globe,
    (face, tile): (usize, &Tile),
    name: &str,
) -> Result<Material> {
    let roughness = 0.95;
    if options.covers.is_empty() && options.water.is_none() {
        let base_color = options.color.0;
        return Ok(Material { name: name.to_owned(), base_color, roughness, ..Material::default() });
    }
    let relief = TileRelief::new(globe, tile);
    let plain = [0, 1, 2].map(|at| options.color.0[at]);
    let across = texels(tile, 2);
    let whole = across + 2 * MARGIN;
    let spot = |column: usize, row: usize| {
        let [column, row] = [column, row].map(|at| at.saturating_sub(MARGIN).min(across - 1));
        relief.spot(options, globe, (face, tile), (column, row, across))
    };
    let water = |spot: &GroundPoint<'_>| options.water.as_ref().filter(|water| spot.height < water.level);
    let bytes = image(whole, |row| {
        let spots: Vec<GroundPoint<'_>> = (0..whole).map(|column| spot(column, row)).collect();
        let dry: Vec<GroundPoint<'_>> = spots.iter().filter(|spot| water(spot).is_none()).copied().collect();
        let ground = if options.covers.is_empty() { Vec::new() } else { blend(&dry, &options.covers) };
        let mut ground = ground.into_iter();
        let color = |spot: &GroundPoint<'_>| match water(spot) {
            Some(water) => water_color(options, water, spot),
            None => ground.next().unwrap_or(plain),
        };
        spots.iter().map(color).collect()
    });
    #[allow(clippy::cast_precision_loss, reason = "texels are few")]
    let size = texel(globe, tile) * (whole - 1) as f64;
    material(name.to_owned(), &bytes, whole, size, roughness)
}

/// Returns the colour of water and of its ice at a point.
fn water_color(options: &PlanetOptions, water: &Water, spot: &GroundPoint<'_>) -> [f32; 3] {
    let mut color = water.tint(water.level - spot.height);
    if let Some(ice) = &options.ice {
        let spot = GroundPoint { height: water.level, slope: 0.0, ..*spot };
        #[allow(clippy::cast_possible_truncation, reason = "colours are f32")]
        let amount = (ice.on.at(&spot, 0) * ice.amount) as f32;
        for (at, into) in color.iter_mut().enumerate() {
            *into += (ice.color.0[at] - *into) * amount;
        }
    }
    color
}

/// Number of texels by which an image extends beyond its tile on each side. Minified textures blend with these texels
/// at the border, not with the texels of the opposite border.
const MARGIN: usize = 4;

/// Returns the distance (m) between the border of the image and the tile, at which texture coordinates begin.
#[allow(clippy::cast_precision_loss, reason = "texels are few")]
pub(super) fn begin(globe: &Globe, tile: &Tile) -> f64 {
    texel(globe, tile) * (MARGIN as f64 + 0.5)
}

/// Returns the texel size (m).
#[allow(clippy::cast_precision_loss, reason = "texels are few")]
fn texel(globe: &Globe, tile: &Tile) -> f64 {
    globe.world().cell(tile.place.level) / (texels(tile, 2) - 1) as f64
}

/// The heights and slopes at all cell corners of a tile.
struct TileRelief<'a> {
    tile: &'a Tile,
    /// Height (m), and its gradients to the east and to the south (m/m).
    corners: Vec<DVec3>,
    /// Number of corners along a side.
    across: usize,
    /// Cell size (m).
    cell: f64,
}

impl<'a> TileRelief<'a> {
    fn new(globe: &Globe, tile: &'a Tile) -> Self {
        let own = Tile::own_cells(tile.place, tile.detail);
        let (across, cell) = (own.columns + 1, globe.world().cell(tile.level()));
        let mut corners = Vec::with_capacity(across * across);
        for y in (own.y..).take(across) {
            for x in (own.x..).take(across) {
                let [a, b, c, d] =
                    [(x - 1, y - 1), (x, y - 1), (x - 1, y), (x, y)].map(|(x, y)| tile.cell(x, y));
                let slope = DVec2::new(b + d - a - c, c + d - a - b) / (2.0 * cell);
                corners.push(slope.extend(tile.corner(x, y)));
            }
        }
        Self { tile, corners, across, cell }
    }

    /// Returns the ground at a texel of an image with `across` texels per side.
    #[allow(
        clippy::cast_precision_loss,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_possible_wrap,
        reason = "texels and cells of a tile are few"
    )]
    fn spot<'b>(
        &self,
        options: &PlanetOptions,
        globe: &'b Globe,
        (face, tile): (usize, &Tile),
        (column, row, across): (usize, usize, usize),
    ) -> GroundPoint<'b> {
        let part = DVec2::new(column as f64, row as f64) / (across - 1) as f64;
        let way = place_within(face, tile, part);
        let along = part * (self.across - 1) as f64;
        let index = |along: f64| (along as usize).min(self.across - 2);
        let (x, y) = (index(along.x), index(along.y));
        let part = along - DVec2::new(x as f64, y as f64);
        let at = |right: usize, down: usize| self.corners[(y + down) * self.across + x + right];
        let north = at(0, 0).lerp(at(1, 0), part.x);
        let here = north.lerp(at(0, 1).lerp(at(1, 1), part.x), part.y);
        let own = Tile::own_cells(self.tile.place, self.tile.detail);
        let (x, y) = (own.x + x as i64, own.y + y as i64);
        let around: f64 = [(-1, 0), (1, 0), (0, -1), (0, 1)]
            .map(|(right, down)| tile.cell(x + right, y + down))
            .iter()
            .sum();
        GroundPoint {
            place: PatchPlace::Round(way * globe.radius(), texel(globe, tile)),
            height: here.z,
            slope: here.truncate().length().atan().to_degrees(),
            curvature: (around - 4.0 * tile.cell(x, y)) / (self.cell * self.cell),
            latitude: latitude(way, options.axis.0),
            symbol: Some(globe.world().name(tile.level(), tile.symbol(x, y))),
        }
    }
}
