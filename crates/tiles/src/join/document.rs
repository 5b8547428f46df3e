//! Tileset files, with explicit or implicit tiling.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use burgeon_base::error::Result;
use glam::DAffine3;
use serde_json::{Value, json};

use super::implicit::{ImplicitRoot, SUBTREE_LEVELS, root_box};
use super::subtree::{schema, subtrees};
use super::tree::{TilesetTile, box_around};
use crate::earth::EarthMap;
use crate::folder::{TERRAIN, TileFolder, content_name, template};
use crate::make::{bounding_box, write_bytes, write_text};
use crate::plan::TileId;

/// Largest number of tiles of a tileset file before it is divided into external tilesets.
const LARGE: usize = 2000;

/// Largest number of tiles of an external tileset.
const REGION: usize = 1000;

/// Writer of the files of a tileset.
pub(super) struct TilesetWriter<'a> {
    pub(super) folder: &'a TileFolder,
    pub(super) map: &'a EarthMap<'a>,
    /// Name of the first file without its extension.
    pub(super) stem: &'static str,
    /// Folder that contains the folder of the contents; empty for the folder of the tileset.
    pub(super) within: &'static str,
    pub(super) is_implicit: bool,
    /// Files that have been written.
    pub(super) written: BTreeSet<PathBuf>,
    /// Bounding boxes (m) of tiles that contain the boxes of tiles with implicit tiling.
    pub(super) grown: BTreeMap<TileId, [f64; 12]>,
}

/// Tile of a file to be written, inside a tile.
struct OuterTile<'a> {
    transform: &'a DAffine3,
    /// Geometric error (m).
    error: f64,
}

/// File to be written: the tile with which it begins.
type Pending<'a> = (String, &'a TilesetTile, f64);

impl TilesetWriter<'_> {
    /// Writes the tileset, and returns the number of its tileset files. The tileset of `terrain`, which is written before, becomes a
    /// part of it.
    pub(super) fn write(
        &mut self,
        root: Option<&TilesetTile>,
        terrain: Option<&TilesetTile>,
    ) -> Result<usize> {
        let main = format!("{}.json", self.stem);
        if let (None, Some(terrain)) = (root, terrain) {
            let error = terrain.absent_error();
            let body = terrain_body(terrain);
            self.file(&main, &body, error)?;
            return Ok(1);
        }
        let Some(root) = root else {
            // A tileset must have a root; this one is a point without content at the centre of the data.
            let axes = self.map.axes([0.0; 2])?;
            let point = bounding_box(glam::DVec3::splat(-1.0), glam::DVec3::splat(1.0));
            let body = json!({
                "transform": columns(&axes.transform), "boundingVolume": { "box": point }, "geometricError": 0.0,
                "refine": "ADD",
            });
            self.file(&main, &body, 0.0)?;
            return Ok(1);
        };
        let (mut transform, mut bounds) = (root.transform, root.bounds);
        if self.is_implicit {
            (transform, bounds) = self.grow(root)?;
        }
        let mut external: Vec<Pending<'_>> = Vec::new();
        let divides = self.tiles(root) > LARGE;
        let above = OuterTile { transform: &DAffine3::IDENTITY, error: root.absent_error() };
        let body = self.tile(root, &above, divides.then_some(&mut external))?;
        let count = external.len() + 1;
        for (name, tile, error) in external {
            // The tile that refers to the file has the transform.
            let above = OuterTile { transform: &tile.transform, error };
            let body = self.tile(tile, &above, None)?;
            self.file(&name, &body, tile.error)?;
        }
        let (mut body, mut error) = (body, root.absent_error());
        if let Some(terrain) = terrain {
            error = error.max(terrain.absent_error());
            let inside = [(&transform, bounds), (&terrain.transform, terrain.bounds)];
            body = json!({
                "boundingVolume": { "box": box_around(&DAffine3::IDENTITY, None, &inside) },
                "geometricError": error, "refine": "ADD", "children": [body, terrain_body(terrain)],
            });
        }
        // The first file is written last, so that a reader does not find a file that is not there.
        self.file(&main, &body, error)?;
        Ok(count)
    }

    /// Stores the boxes of the tiles above those with implicit tiling, and returns the transform and the box of `tile`.
    fn grow(&mut self, tile: &TilesetTile) -> Result<(DAffine3, [f64; 12])> {
        if tile.id.level >= TileId::ANCHOR {
            let (axes, bounds) = root_box(tile, self.map)?;
            return Ok((axes.transform, bounds));
        }
        let mut inside = Vec::new();
        for child in &tile.children {
            inside.push(self.grow(child)?);
        }
        let inside: Vec<(&DAffine3, [f64; 12])> =
            inside.iter().map(|(axes, bounds)| (axes, *bounds)).collect();
        let bounds = box_around(&tile.transform, Some(tile.bounds), &inside);
        self.grown.insert(tile.id, bounds);
        Ok((tile.transform, bounds))
    }

    /// Returns the number of tiles in files, without those with implicit tiling.
    fn tiles(&self, tile: &TilesetTile) -> usize {
        match self.is_implicit && tile.id.level >= TileId::ANCHOR {
            true => 1,
            false => {
                usize::from(tile.has_content)
                    + tile.children.iter().map(|child| self.tiles(child)).sum::<usize>()
            }
        }
    }

    /// Returns a tile as JSON. With `external`, regions of the tree go to that list, with the names of their files.
    fn tile<'t>(
        &mut self,
        tile: &'t TilesetTile,
        above: &OuterTile<'_>,
        mut external: Option<&mut Vec<Pending<'t>>>,
    ) -> Result<Value> {
        if self.is_implicit && tile.id.level >= TileId::ANCHOR {
            return self.implicit(tile, above);
        }
        let bounds = self.grown.get(&tile.id).unwrap_or(&tile.bounds);
        let mut body = json!({ "boundingVolume": { "box": bounds }, "geometricError": tile.error });
        place(&mut body, above.transform, &tile.transform);
        let is_region = |tile: &TilesetTile| !tile.has_content && self.tiles(tile) <= REGION;
        if let Some(external) = external.as_deref_mut().filter(|_| is_region(tile)) {
            let TileId { level, x, y } = tile.id;
            let name = format!("{}-{level}-{x}-{y}.json", self.stem);
            body["content"] = json!({ "uri": name });
            body["refine"] = "ADD".into();
            external.push((name, tile, above.error));
            return Ok(body);
        }
        if tile.has_content {
            body["content"] = json!({ "uri": content_name(self.within, tile.id) });
        }
        if !tile.children.is_empty() {
            let inner = OuterTile { transform: &tile.transform, error: tile.error };
            let mut children = Vec::new();
            for child in &tile.children {
                children.push(self.tile(child, &inner, external.as_deref_mut())?);
            }
            body["children"] = Value::Array(children);
        }
        // The children have all features of a coarser tile, and tiles without content show nothing.
        body["refine"] = if tile.is_replaced() { "REPLACE" } else { "ADD" }.into();
        Ok(body)
    }

    /// Returns the root of implicit tiling as JSON, and writes its subtrees.
    fn implicit(&mut self, tile: &TilesetTile, above: &OuterTile<'_>) -> Result<Value> {
        let root = ImplicitRoot::new(tile, above.error, self.map)?;
        let levels = root.levels.min(SUBTREE_LEVELS);
        for (place, bytes) in subtrees(&root.tiles, levels) {
            let path = self.folder.subtrees().join(format!("{}/{place}.subtree", root.id));
            write_bytes(&path, &bytes)?;
            self.written.insert(path);
        }
        // All tiles have the refinement of the root; without content, both kinds are the same.
        let refine = if has_coarse(tile) { "REPLACE" } else { "ADD" };
        let mut body = json!({
            "boundingVolume": { "box": root.bounds },
            "geometricError": root.error,
            "refine": refine,
            "content": { "uri": template("tiles", root.id, "glb") },
            "implicitTiling": {
                "subdivisionScheme": "QUADTREE",
                "availableLevels": root.levels,
                "subtreeLevels": levels,
                "subtrees": { "uri": template("subtrees", root.id, "subtree") },
            },
        });
        place(&mut body, above.transform, &root.axes.transform);
        Ok(body)
    }

    /// Writes a file of the tileset.
    fn file(&mut self, name: &str, root: &Value, error: f64) -> Result<()> {
        let mut document = json!({
            "asset": { "version": "1.1", "generator": format!("Burgeon {}", env!("CARGO_PKG_VERSION")) },
            "geometricError": error,
            "root": root,
        });
        if self.is_implicit {
            document["schema"] = schema();
        }
        let path = self.folder.path().join(name);
        write_text(&path, &format!("{document}\n"))?;
        self.written.insert(path);
        Ok(())
    }
}

/// Returns the tile that refers to the tileset of the terrain, in geocentric axes.
fn terrain_body(terrain: &TilesetTile) -> Value {
    let bounds = box_around(&DAffine3::IDENTITY, None, &[(&terrain.transform, terrain.bounds)]);
    json!({
        "boundingVolume": { "box": bounds }, "geometricError": terrain.absent_error(), "refine": "ADD",
        "content": { "uri": format!("{TERRAIN}.json") },
    })
}

/// Returns true if the tiles inside replace the content of the tile, or of one inside.
fn has_coarse(tile: &TilesetTile) -> bool {
    tile.is_replaced() || tile.children.iter().any(has_coarse)
}

/// Sets the transform of a tile inside a tile with the transform `parent`, unless they are the same.
fn place(body: &mut Value, parent: &DAffine3, child: &DAffine3) {
    if parent != child {
        body["transform"] = columns(&relative(parent, child)).into();
    }
}

/// Returns the columns of a transform, four numbers each.
fn columns(transform: &DAffine3) -> Vec<f64> {
    let columns = transform.to_cols_array_2d();
    let last = [0.0, 0.0, 0.0, 1.0];
    columns.iter().zip(last).flat_map(|([x, y, z], w)| [*x, *y, *z, w]).collect()
}

/// Returns the transform of a child relative to its parent. Both are rotations and translations.
fn relative(parent: &DAffine3, child: &DAffine3) -> DAffine3 {
    let turned = parent.matrix3.transpose();
    DAffine3 {
        matrix3: turned * child.matrix3,
        translation: turned * (child.translation - parent.translation),
    }
}
