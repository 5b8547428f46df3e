//! Tree of the tiles of a tileset.

use burgeon_base::error::Result;
use glam::{DAffine3, DVec3};

use crate::earth::{EarthMap, TileAxes};
use crate::make::{TileFile, bounding_box};
use crate::plan::{PlannedTile, TileGrid, TileId};

/// Tile with content, from its plan and its manifest.
#[derive(Debug, Clone, Copy)]
pub struct JoinedTile<'a> {
    /// Plan.
    pub planned: &'a PlannedTile,
    /// Content.
    pub file: &'a TileFile,
    /// Geometric errors (m) of the coarser levels of detail of its features, from fine to coarse.
    pub errors: &'a [f64],
}

/// Tile of a tileset.
#[derive(Debug, Clone, PartialEq)]
pub struct TilesetTile {
    /// Place in the quadtree.
    pub id: TileId,
    /// Transform from the local axes to geocentric coordinates (m).
    pub transform: DAffine3,
    /// Bounding box (m) in the local axes.
    pub bounds: [f64; 12],
    /// Geometric error (m): 0 without children, otherwise the error of the content while the children are not shown, or the size
    /// of what is missing without content.
    pub error: f64,
    /// True if the tile has content.
    pub has_content: bool,
    /// True if the content is shown together with the tiles inside, which have other features.
    pub is_added: bool,
    /// Tiles inside, in the order of the curve.
    pub children: Vec<TilesetTile>,
}

/// Part of the diagonal of a tile without content that counts as its geometric error.
///
/// There is no coarser model to be compared with the children, so the error is the larger of their height and this part:
/// a viewer with 16 pixels of allowed error then loads the children at about twice the diagonal.
const PART: f64 = 1.0 / 32.0;

impl TilesetTile {
    /// Returns the number of tiles with content.
    pub fn contents(&self) -> usize {
        usize::from(self.has_content) + self.children.iter().map(Self::contents).sum::<usize>()
    }

    /// Returns true if the tiles inside replace the content.
    pub(super) fn is_replaced(&self) -> bool {
        self.has_content && !self.is_added && !self.children.is_empty()
    }

    /// Returns the geometric error (m) while nothing of the tile is shown.
    pub fn absent_error(&self) -> f64 {
        let [.., x, _, _, _, y, _, _, _, z] = self.bounds;
        (2.0 * DVec3::new(x, y, z).length() * PART).max(2.0 * z).max(self.error)
    }
}

/// Returns the corners of a bounding box.
pub(crate) fn corners(bounds: &[f64; 12]) -> [DVec3; 8] {
    let at = |index: usize| DVec3::new(bounds[index], bounds[index + 1], bounds[index + 2]);
    std::array::from_fn(|corner| {
        let sign = |axis: usize| if corner >> axis & 1 == 0 { -1.0 } else { 1.0 };
        at(0) + at(3) * sign(0) + at(6) * sign(1) + at(9) * sign(2)
    })
}

/// Returns the tree of the tiles with content, which are in the order of the curve; `None` without tiles.
///
/// The root is the smallest tile of the quadtree that contains all. Tiles without content that have one child are left out.
/// `lods` are the levels of detail of coarser tiles, from fine to coarse. The error of a coarser tile is the largest error of its
/// level of detail in the tiles inside, and at least that of its children.
pub fn join_tree(tiles: &[JoinedTile<'_>], map: &EarthMap<'_>, lods: &[u8]) -> Result<Option<TilesetTile>> {
    Ok(TreeJoin { map, lods, is_terrain: false }.join(tiles)?.map(|(tile, _)| tile))
}

/// Returns the tree of terrain tiles with content, as [`join_tree`]. The error of a tile is its distance from the tiles inside, and the
/// largest of their errors.
pub(super) fn join_terrain(tiles: &[JoinedTile<'_>], map: &EarthMap<'_>) -> Result<Option<TilesetTile>> {
    Ok(TreeJoin { map, lods: &[], is_terrain: true }.join(tiles)?.map(|(tile, _)| tile))
}

/// Parameters of a join.
struct TreeJoin<'a> {
    map: &'a EarthMap<'a>,
    lods: &'a [u8],
    is_terrain: bool,
}

impl TreeJoin<'_> {
    /// Returns the tree of tiles, and the largest errors (m) of their coarser levels of detail.
    fn join(&self, tiles: &[JoinedTile<'_>]) -> Result<Option<(TilesetTile, Vec<f64>)>> {
        let (Some(first), Some(last)) = (tiles.first(), tiles.last()) else { return Ok(None) };
        let id = first.planned.id.common(last.planned.id);
        // A tile is before those inside it on the curve.
        let (content, mut rest) = match first.planned.id == id {
            true => (Some(first), &tiles[1..]),
            false => (None, tiles),
        };
        let (mut children, mut errors) = (Vec::new(), vec![0.0; self.lods.len()]);
        for child in id.children() {
            let end = rest.partition_point(|tile| child.is_not_before(tile.planned.id));
            let (own, later) = rest.split_at(end);
            if let Some((tile, own)) = self.join(own)? {
                children.push(tile);
                raise(&mut errors, &own);
            }
            rest = later;
        }
        let axes = self.axes(id, content, tiles)?;
        let inside = children.iter().map(|child| (&child.transform, child.bounds)).collect::<Vec<_>>();
        let bounds = box_around(&axes.transform, content.map(|tile| tile.file.bounds), &inside);
        let mut tile = TilesetTile {
            id,
            transform: axes.transform,
            bounds,
            error: children.iter().map(|child| child.error).fold(0.0, f64::max),
            has_content: content.is_some(),
            is_added: content.is_some_and(|tile| tile.planned.is_tall()),
            children,
        };
        match content {
            Some(content) if self.is_terrain => {
                if !tile.children.is_empty() {
                    tile.error += content.errors.first().copied().unwrap_or(0.0);
                }
            }
            Some(JoinedTile { planned: PlannedTile { lod: None, .. }, errors: own, .. }) => {
                raise(&mut errors, own);
                if tile.is_added && !tile.children.is_empty() {
                    // The other features are not shown.
                    tile.error = tile.absent_error();
                }
            }
            Some(JoinedTile { planned, .. }) if !tile.children.is_empty() => {
                let level = self.lods.iter().position(|lod| Some(*lod) == planned.lod);
                tile.error = tile.error.max(level.map_or(0.0, |level| errors[level]));
            }
            Some(_) => {}
            None => tile.error = tile.absent_error(),
        }
        Ok(Some((tile, errors)))
    }

    /// Returns the axes of a tile: those of its content, or of the largest tile of a plan that contains it.
    fn axes(
        &self,
        id: TileId,
        content: Option<&JoinedTile<'_>>,
        tiles: &[JoinedTile<'_>],
    ) -> Result<TileAxes> {
        if let Some(tile) = content {
            return self.map.axes(tile.planned.origin());
        }
        let [west, south, east, north] = match id.level >= TileId::ANCHOR {
            true => TileGrid::bounds(id.anchor()),
            // The middle of a larger tile may be far from its content, and outside the projection.
            false => tiles
                .iter()
                .map(|tile| tile.planned.region)
                .reduce(|a, b| [a[0].min(b[0]), a[1].min(b[1]), a[2].max(b[2]), a[3].max(b[3])])
                .unwrap_or_default(),
        };
        self.map.axes([west.midpoint(east), south.midpoint(north)])
    }
}

/// Raises errors to others of the same levels of detail.
fn raise(errors: &mut [f64], others: &[f64]) {
    errors.iter_mut().zip(others).for_each(|(error, other)| *error = error.max(*other));
}

/// Returns the box in the axes of `transform` around a box in the same axes, and around boxes in other axes.
pub(super) fn box_around(
    transform: &DAffine3,
    content: Option<[f64; 12]>,
    inside: &[(&DAffine3, [f64; 12])],
) -> [f64; 12] {
    if let (Some(bounds), []) = (content, inside) {
        return bounds;
    }
    let (mut low, mut high) = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let mut add = |point: DVec3| (low, high) = (low.min(point), high.max(point));
    content.iter().flat_map(corners).for_each(&mut add);
    // The axes are orthonormal, so the transpose is the inverse.
    let back = transform.matrix3.transpose();
    for (other, bounds) in inside {
        for corner in corners(bounds) {
            let enter = |corner: DVec3| back * (other.transform_point3(corner) - transform.translation);
            add(if *other == transform { corner } else { enter(corner) });
        }
    }
    // Corners are rounded when they are transformed.
    let margin = (high - low).max_element() * 1e-9 + 1e-3;
    bounding_box(low - margin, high + margin)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plan::{TileDivision, coarse_tiles, id_digest};
    use burgeon_spatial::{Crs, ReferenceFrame};

    /// Returns a content of 10 m, and errors that depend on the number of the tile.
    fn content(number: usize, map: &EarthMap<'_>, tile: &PlannedTile) -> (TileFile, Vec<f64>) {
        let axes = map.axes(tile.origin()).unwrap();
        let at = |x: f64, y: f64, z: f64| map.local(&axes, DVec3::new(x, y, z)).unwrap();
        let [west, south, east, north] = tile.region;
        let bounds = bounding_box(at(west, south, 0.0) - 1.0, at(east, north, 9.0) + 1.0);
        let file = TileFile {
            bytes: 1,
            hash: String::new(),
            degrees: axes.degrees,
            bounds,
            triangles: 1,
            instances: 1,
            primitives: 1,
        };
        (file, vec![0.5 + (number % 7) as f64, 3.0 + (number % 5) as f64])
    }

    #[test]
    fn errors_of_coarser_tiles_are_the_largest_inside_and_fall_to_the_leaves() {
        let frame = ReferenceFrame::around(&Crs::epsg(2154).unwrap(), [652_000.0, 6_862_000.0], "a").unwrap();
        let map = EarthMap::new(&frame, 44.0).unwrap();
        let mut division = TileDivision::default();
        for number in 0..2000_u32 {
            let place = [f64::from(number % 50) * 30.0, f64::from(number / 50) * 400.0].into();
            let digest = id_digest("trees", &number.to_string());
            division.add([place, place], 10, digest, digest).unwrap();
        }
        let planned = division.tiles(20);
        let lods = [2, 1];
        let mut all = planned.clone();
        all.extend(coarse_tiles(&planned, &lods));
        all.sort_by_key(|tile| tile.id.curve());
        let contents: Vec<(TileFile, Vec<f64>)> =
            all.iter().enumerate().map(|(number, tile)| content(number, &map, tile)).collect();
        let joined =
            all.iter().zip(&contents).map(|(planned, (file, errors))| JoinedTile { planned, file, errors });
        let root = join_tree(&joined.collect::<Vec<_>>(), &map, &lods).unwrap().unwrap();
        assert_eq!(root.contents(), all.len());
        let mut open = vec![&root];
        let mut coarse = 0;
        while let Some(tile) = open.pop() {
            let index = all.iter().position(|planned| planned.id == tile.id);
            let inside = |id: TileId| id.level >= tile.id.level && id.ancestor(tile.id.level) == tile.id;
            if let Some(lod) = index.and_then(|index| all[index].lod) {
                let level = lods.iter().position(|known| *known == lod).unwrap();
                let leaves =
                    all.iter().zip(&contents).filter(|(leaf, _)| leaf.lod.is_none() && inside(leaf.id));
                let largest = leaves.map(|(_, (_, errors))| errors[level]).fold(0.0, f64::max);
                assert!(tile.error >= largest && tile.error < 8.5, "{} {largest}", tile.error);
                coarse += 1;
            }
            assert!(tile.children.iter().all(|child| child.error <= tile.error));
            assert_eq!(tile.children.is_empty(), tile.error == 0.0);
            open.extend(&tile.children);
        }
        assert_eq!(coarse, all.len() - planned.len());
    }
}
