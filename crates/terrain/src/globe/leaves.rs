//! Selection of the tiles of the six faces: smaller tiles closer to the eye.

use glam::{DVec2, DVec3};

use super::sphere::{direction, side};
use crate::division::world::World;
use crate::tiles::tile::TilePlace;
use crate::tiles::view::MOST_HEIGHTS;
use burgeon_base::error::{Error, Limit, Result};

/// Number of divisions of each tile.
pub const DETAIL: u32 = 6;

/// Maximum number of divisions of a face.
pub const DEEPEST: u32 = 28;

/// Viewpoint and detail of a globe.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Sight {
    /// Position of the eye (m, from the centre of the globe, with the ground below it at the radius); `None`
    /// for a distance of four radii on all sides.
    pub eye: Option<DVec3>,
    /// Distance of the eye below which a tile is divided, as a multiple of the tile's size.
    pub closeness: f64,
    /// Maximum number of divisions of a face, including the cells of tiles.
    pub levels: u32,
    /// Height (m) of the highest mountains, if tiles below the horizon of the eye are not divided.
    pub highest: Option<f64>,
}

impl Sight {
    /// Returns true if no mountain on a tile rises above the horizon of the eye.
    fn is_hidden(&self, radius: f64, leaf: Leaf) -> bool {
        let (Some(eye), Some(highest)) = (self.eye, self.highest) else { return false };
        let (middle, reach) = ball(leaf);
        let to_touch = |length: f64| (radius / length.max(radius)).acos();
        let nearest = eye.angle_between(middle) - 2.0 * (reach / 2.0).min(1.0).asin();
        nearest > to_touch(eye.length()) + to_touch(radius + highest)
    }
}

/// A tile with its face.
pub(super) type Leaf = (usize, TilePlace);

/// State of a cell of a face: divided further, or a tile.
#[derive(Debug, Clone, Copy)]
enum Link {
    Divided(usize),
    Leaf(usize),
}

/// Quadtrees of the six faces.
#[derive(Debug, Clone, Default)]
pub(super) struct Tree {
    /// Root of each face; empty without tiles.
    roots: Vec<Link>,
    /// Quadrants: north-west, north-east, south-west and south-east.
    divided: Vec<[Link; 4]>,
    /// Tiles.
    pub leaves: Vec<Leaf>,
}

impl Tree {
    /// Selects the visible tiles of a globe with this radius (m). Fails if there would be too many heights.
    pub(super) fn new(radius: f64, sight: &Sight) -> Result<Self> {
        let mut tree = Self::default();
        for face in 0..6 {
            let root = tree.grow(radius, sight, (face, TilePlace { level: 0, y: 0, x: 0 }))?;
            tree.roots.push(root);
        }
        Ok(tree)
    }

    fn grow(&mut self, radius: f64, sight: &Sight, leaf: Leaf) -> Result<Link> {
        let (face, TilePlace { level, y, x }) = leaf;
        let size = side(radius) / 2f64.powi(level.cast_signed());
        let may = level + DETAIL < sight.levels.min(DEEPEST);
        let far = || distance(radius, sight, leaf) >= sight.closeness * size;
        if !may || far() || sight.is_hidden(radius, leaf) {
            self.leaves.push(leaf);
            if (self.leaves.len() as u64) << (2 * DETAIL) > MOST_HEIGHTS {
                return Err(Error::limit(Limit::Size, format!("planet: more than {MOST_HEIGHTS} heights"))
                    .help("use a lower closeness or fewer levels: most of the planet is far away"));
            }
            return Ok(Link::Leaf(self.leaves.len() - 1));
        }
        let index = self.divided.len();
        self.divided.push([Link::Divided(index); 4]);
        for quadrant in 0..4usize {
            let (right, down) = (i64::from(quadrant % 2 == 1), i64::from(quadrant > 1));
            let place = TilePlace { level: level + 1, y: 2 * y + down, x: 2 * x + right };
            self.divided[index][quadrant] = self.grow(radius, sight, (face, place))?;
        }
        Ok(Link::Divided(index))
    }

    /// Returns the index of the tile that contains a cell of a face at `level`, which must not be above the
    /// level of the tile.
    #[inline]
    pub(super) fn holder(&self, (face, x, y): (usize, i64, i64), level: u32) -> Option<usize> {
        let mut link = *self.roots.get(face)?;
        let mut down = level;
        loop {
            match link {
                Link::Leaf(leaf) => return Some(leaf),
                Link::Divided(index) => {
                    down = down.checked_sub(1)?;
                    let quadrant = usize::from(x >> down & 1 == 1) + 2 * usize::from(y >> down & 1 == 1);
                    link = self.divided[index][quadrant];
                }
            }
        }
    }
}

/// Returns a lower bound of the distance (m) of the eye from a tile on the sphere.
fn distance(radius: f64, sight: &Sight, leaf: Leaf) -> f64 {
    // From four radii, the nearest ground is three radii away.
    let Some(eye) = sight.eye else { return 3.0 * radius };
    let (middle, reach) = ball(leaf);
    (eye.distance(middle * radius) - reach * radius).max(0.0)
}

/// Returns the direction of the centre of a tile on the unit sphere, and the maximum distance of its corners
/// from it.
#[allow(clippy::cast_precision_loss, reason = "columns and rows are below 2^53")]
pub(super) fn ball((face, TilePlace { level, y, x }): Leaf) -> (DVec3, f64) {
    let across = World::across(level) as f64;
    let at = |right: f64, down: f64| {
        direction(
            face,
            DVec2::new(2.0 * (x as f64 + right) / across - 1.0, 1.0 - 2.0 * (y as f64 + down) / across),
        )
    };
    let middle = at(0.5, 0.5);
    let corners = [at(0.0, 0.0), at(1.0, 0.0), at(0.0, 1.0), at(1.0, 1.0)];
    (middle, corners.into_iter().map(|corner| corner.distance(middle)).fold(0.0, f64::max))
}
