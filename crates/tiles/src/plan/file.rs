//! Plan as a file.

use std::fmt;
use std::path::Path;

use burgeon_base::error::{Error, Result};
use burgeon_export::gltf::TileModelOptions;
use burgeon_export::layers::{ColumnKind, TableColumn};
use burgeon_spatial::{Crs, ReferenceFrame};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::{
    OmittedFeature, PlannedFile, PlannedTerrain, PlannedTile, TableFormat, TallRule, TileGrid, TileId,
    hash_text,
};

/// Version of the format of plans and manifests.
pub const PLAN_VERSION: u32 = 3;

/// Frame of the coordinates of a plan.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlanFrame {
    /// EPSG code of the data.
    pub epsg: u16,
    /// Centre of the data in that coordinate system.
    pub place: [f64; 2],
    /// Height (m) of the origin of heights above the WGS 84 ellipsoid; with a grid, at the centre of the data.
    pub geoid_height: f64,
    /// Path of the grid of the heights of the geoid above the ellipsoid, one of the files of the plan.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub geoid: Option<String>,
}

/// Source whose features are divided among tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PlannedSource {
    /// Call of `source` in the script.
    pub key: String,
    /// File and layer.
    pub label: String,
    /// Number of features.
    pub features: u64,
    /// Minimum and maximum coordinates (m) of the features.
    pub bounds: [[f64; 3]; 2],
    /// Set if a tile can be read from a part of the file.
    pub in_parts: bool,
    /// Attributes, and the types of their values in all features.
    pub columns: Vec<TableColumn>,
}

/// TileDivision of the features of a script among tiles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TilePlan {
    /// Version of the format.
    pub version: u32,
    /// Version of the program.
    pub program: String,
    /// Script, relative to the folder of the plan.
    pub script: String,
    /// Arguments of the run, with paths relative to the folder of the plan.
    pub arguments: Vec<String>,
    /// Script and all files that it reads, except the sources of features.
    pub files: Vec<PlannedFile>,
    /// Packages that the script uses, with versions and hashes.
    pub packages: Vec<String>,
    /// Frame.
    pub frame: PlanFrame,
    /// Distance (m) within which features of other tiles are derived too.
    pub reach: f64,
    /// Names of the attributes to include; `*` for all, and none for those that the script names.
    pub metadata: Vec<String>,
    /// Choices for the models of tiles.
    pub model: TileModelOptions,
    /// Tables to be written beside the contents of tiles.
    pub tables: Vec<TableFormat>,
    /// Sources of features.
    pub sources: Vec<PlannedSource>,
    /// Rule for tall features, which inner tiles contain.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tall: Option<TallRule>,
    /// Terrain, whose tiles are beside those of the features.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub terrain: Option<PlannedTerrain>,
    /// Levels of detail of coarser tiles, from fine to coarse.
    pub lods: Vec<u8>,
    /// Tiles, in an order that keeps neighbours together.
    pub tiles: Vec<PlannedTile>,
    /// Coarser tiles, which have the features of the tiles inside them, in the same order.
    pub coarse: Vec<PlannedTile>,
    /// Features that cannot be in a tile.
    pub left_out: Vec<OmittedFeature>,
    /// Remarks on the data.
    pub notes: Vec<String>,
}

impl PlanFrame {
    /// Returns the frame of the run.
    pub fn reference(&self) -> Result<ReferenceFrame> {
        ReferenceFrame::around(&Crs::epsg(self.epsg.into())?, self.place, "the plan")
    }
}

impl TilePlan {
    /// Reads the plan at `path`. Fails if it is not a plan of this version of the format.
    pub fn read(path: &Path) -> Result<Self> {
        let text = std::fs::read_to_string(path).map_err(|error| match error.kind() {
            std::io::ErrorKind::NotFound => Error::not_found(
                "plan",
                path.display().to_string(),
                [],
                format!("no plan in this folder: {}", path.display()),
            )
            .help("make one: burgeon tiles plan SCRIPT -o FOLDER"),
            _ => Error::file(path, format!("cannot read {}: {error}", path.display()))
                .help("check its permissions"),
        })?;
        let refuse = |why: &dyn fmt::Display| {
            Error::data(format!("{} is not a plan of tiles: {why}", path.display()))
                .help("make it again: burgeon tiles plan SCRIPT -o FOLDER")
        };
        let plan: Self = serde_json::from_str(&text).map_err(|error| refuse(&error))?;
        if plan.version != PLAN_VERSION {
            return Err(refuse(&format_args!(
                "its version is {}, and this program reads {PLAN_VERSION}",
                plan.version
            )));
        }
        let is_odd =
            |tile: &PlannedTile| tile.id.to_string().parse::<TileId>().is_err() || !tile.cost.is_finite();
        let are_odd = |tiles: &[PlannedTile]| {
            tiles.iter().any(is_odd) || tiles.windows(2).any(|pair| pair[0].id.curve() >= pair[1].id.curve())
        };
        if are_odd(&plan.tiles) || are_odd(&plan.coarse) {
            return Err(refuse(&"its tiles are not in order"));
        }
        Ok(plan)
    }

    /// Returns the text of the plan: one line for each tile.
    pub fn text(&self) -> Result<String> {
        let value = |value: serde_json::Result<String>| value.map_err(Error::internal);
        let list = |tiles: &[PlannedTile]| -> Result<String> {
            let lines = tiles.iter().map(|tile| value(serde_json::to_string(tile)));
            let lines = lines.collect::<Result<Vec<_>>>()?.join(",\n    ");
            Ok(if lines.is_empty() { "[]".to_owned() } else { format!("[\n    {lines}\n  ]") })
        };
        // Each field, so that none is forgotten.
        let Self {
            version,
            program,
            script,
            arguments,
            files,
            packages,
            sources,
            frame,
            reach,
            metadata,
            model,
            tables,
            tall,
            terrain,
            lods,
            tiles,
            coarse,
            left_out,
            notes,
        } = self;
        let parts = [
            ("version", value(serde_json::to_string(version))?),
            ("program", value(serde_json::to_string(program))?),
            ("script", value(serde_json::to_string(script))?),
            ("arguments", value(serde_json::to_string(arguments))?),
            ("files", value(serde_json::to_string(files))?),
            ("packages", value(serde_json::to_string(packages))?),
            ("frame", value(serde_json::to_string(frame))?),
            ("reach", value(serde_json::to_string(reach))?),
            ("metadata", value(serde_json::to_string(metadata))?),
            ("model", value(serde_json::to_string(model))?),
            ("tables", value(serde_json::to_string(tables))?),
            ("sources", value(serde_json::to_string(sources))?),
            ("tall", value(serde_json::to_string(tall))?),
            ("terrain", value(serde_json::to_string(terrain))?),
            ("lods", value(serde_json::to_string(lods))?),
            ("tiles", list(tiles)?),
            ("coarse", list(coarse)?),
            ("left_out", value(serde_json::to_string(left_out))?),
            ("notes", value(serde_json::to_string(notes))?),
        ];
        let parts = parts.map(|(name, text)| format!("  \"{name}\": {text}"));
        Ok(format!("{{\n{}\n}}\n", parts.join(",\n")))
    }

    /// Returns all tiles: those of the features, and the coarser ones.
    pub fn all_tiles(&self) -> Vec<&PlannedTile> {
        self.tiles.iter().chain(&self.coarse).collect()
    }

    /// Returns the terrain tiles, in the order of the curve. Their hashes depend on the program, the file of the heights, the frame and
    /// the choices for models, and on the script with its arguments and files if they have its colours.
    pub fn terrain_tiles(&self) -> Result<Vec<PlannedTile>> {
        let Some(terrain) = &self.terrain else { return Ok(Vec::new()) };
        let common = (self.version, &self.program, &self.frame, terrain, &self.model);
        let geoid = self.files.iter().find(|file| Some(&file.path) == self.frame.geoid.as_ref());
        let script = terrain.is_colored.then_some((&self.arguments, &self.files, &self.packages));
        let common = serde_json::to_string(&(common, geoid, script)).map_err(Error::internal)?;
        let cost = f64::from(PlannedTerrain::SQUARES);
        let tile = |id: TileId| {
            let mut hasher = blake3::Hasher::new();
            hasher.update(common.as_bytes()).update(id.to_string().as_bytes());
            let hash = hash_text(hasher.finalize());
            let (ids, data, region) = (String::new(), String::new(), terrain.part(id));
            PlannedTile { id, features: 0, cost, region, ids, data, hash, lod: None, tall: None }
        };
        Ok(terrain.tile_ids().into_iter().map(tile).collect())
    }

    /// Returns the attributes of all sources. Attributes with the same name are one column.
    pub fn columns(&self) -> Vec<TableColumn> {
        let mut columns: Vec<TableColumn> = Vec::new();
        for column in self.sources.iter().flat_map(|source| &source.columns) {
            match columns.iter_mut().find(|known| known.name == column.name) {
                Some(known) => {
                    let joined = ColumnKind::join(Some(known.kind), Some(column.kind));
                    known.kind = joined.unwrap_or(known.kind);
                }
                None => columns.push(column.clone()),
            }
        }
        columns
    }

    /// Returns west, south, east and north (m) of the features that a tile needs: its own, and those within the reach.
    pub fn needed(&self, tile: &PlannedTile) -> [f64; 4] {
        let [west, south, east, north] = tile.region;
        let [cell_west, cell_south, cell_east, cell_north] = TileGrid::bounds(tile.id);
        let reach = self.reach;
        // The cell is included, so that a feature that was added since the plan is noticed.
        [
            (west - reach).min(cell_west),
            (south - reach).min(cell_south),
            (east + reach).max(cell_east),
            (north + reach).max(cell_north),
        ]
    }

    /// Sets the hash of each tile: of everything that determines its bytes. These are the program, the script and its
    /// arguments, the frame, the features of the tile, and those of the tiles within the reach. A change of a feature therefore
    /// changes its tile, the coarser tiles above it, and those within the reach.
    pub fn set_hashes(&mut self) -> Result<()> {
        let Self {
            version,
            program,
            arguments,
            files,
            packages,
            frame,
            reach,
            metadata,
            model,
            tables,
            tall,
            lods,
            ..
        } = &*self;
        let common = (version, program, arguments, files, packages, frame, reach, metadata, model, lods);
        let columns = (!tables.is_empty()).then(|| self.columns());
        let common = serde_json::to_string(&(common, tables, columns, tall)).map_err(Error::internal)?;
        let mut by_west: Vec<usize> = (0..self.tiles.len()).collect();
        by_west.sort_by(|a, b| self.tiles[*a].region[0].total_cmp(&self.tiles[*b].region[0]));
        let widest = self.tiles.iter().map(|tile| tile.region[2] - tile.region[0]).fold(0.0, f64::max);
        let hash = |tile: &PlannedTile| {
            let mut hasher = blake3::Hasher::new();
            hasher.update(common.as_bytes());
            hasher.update(tile.id.to_string().as_bytes());
            hasher.update(tile.data.as_bytes());
            hasher.update(&[tile.lod.unwrap_or(u8::MAX), tile.tall.map_or(u8::MAX, u8::from)]);
            if *reach > 0.0 {
                let [west, south, east, north] = tile.region;
                let first =
                    by_west.partition_point(|other| self.tiles[*other].region[0] < west - reach - widest);
                let mut near: Vec<&str> = by_west[first..]
                    .iter()
                    .map(|other| &self.tiles[*other])
                    .take_while(|other| other.region[0] <= east + reach)
                    .filter(|other| {
                        let [low_x, low_y, high_x, high_y] = other.region;
                        // A coarser tile has the features of the tiles inside.
                        let is_apart =
                            other.id.level < tile.id.level || other.id.ancestor(tile.id.level) != tile.id;
                        other.id != tile.id
                            && (tile.lod.is_none() || is_apart)
                            && low_x <= east + reach
                            && high_x >= west - reach
                            && low_y <= north + reach
                            && high_y >= south - reach
                    })
                    .map(|other| other.data.as_str())
                    .collect();
                near.sort_unstable();
                near.iter().for_each(|data| {
                    hasher.update(data.as_bytes());
                });
            }
            hash_text(hasher.finalize())
        };
        let hashes: Vec<String> = self.all_tiles().into_par_iter().map(hash).collect();
        let tiles = self.tiles.iter_mut().chain(&mut self.coarse);
        tiles.zip(hashes).for_each(|(tile, hash)| tile.hash = hash);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn tile(x: u32, data: &str) -> PlannedTile {
        let id = TileId { level: 12, x, y: 5 };
        let [west, south, east, north] = TileGrid::bounds(id);
        PlannedTile {
            id,
            features: 3,
            cost: 4.5,
            region: [west + 10.0, south + 10.0, east - 10.0, north - 10.0],
            ids: "1".to_owned(),
            data: data.to_owned(),
            hash: String::new(),
            lod: None,
            tall: None,
        }
    }

    fn plan(reach: f64, tiles: Vec<PlannedTile>) -> TilePlan {
        let mut plan = TilePlan {
            version: PLAN_VERSION,
            program: "1".to_owned(),
            script: "../town.lua".to_owned(),
            arguments: Vec::new(),
            files: Vec::new(),
            packages: Vec::new(),
            frame: PlanFrame { epsg: 2154, place: [652_000.1, 6_862_000.7], geoid_height: 44.0, geoid: None },
            reach,
            metadata: Vec::new(),
            model: TileModelOptions::default(),
            tables: Vec::new(),
            sources: Vec::new(),
            tall: None,
            terrain: None,
            lods: vec![2],
            coarse: super::super::coarse_tiles(&tiles, &[2]),
            tiles,
            left_out: Vec::new(),
            notes: Vec::new(),
        };
        plan.set_hashes().unwrap();
        plan
    }

    #[test]
    fn a_plan_that_was_written_is_read_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("plan.json");
        for tiles in [Vec::new(), vec![tile(1, "a"), tile(2, "b")]] {
            let plan = plan(12.5, tiles);
            std::fs::write(&path, plan.text().unwrap()).unwrap();
            assert_eq!(TilePlan::read(&path).unwrap(), plan);
        }
        std::fs::write(&path, "{}").unwrap();
        assert_eq!(TilePlan::read(&path).unwrap_err().kind().code(), "data");
        assert_eq!(TilePlan::read(&folder.path().join("none")).unwrap_err().kind().code(), "not-found");
    }

    #[test]
    fn a_changed_feature_changes_its_tile_and_those_within_the_reach() {
        let hashes = |reach, changed: &str| -> Vec<String> {
            let tiles = vec![tile(1, "a"), tile(2, changed), tile(3, "c"), tile(4, "d")];
            plan(reach, tiles).tiles.into_iter().map(|tile| tile.hash).collect()
        };
        let differs = |reach| -> Vec<bool> {
            hashes(reach, "b").iter().zip(hashes(reach, "x")).map(|(a, b)| *a != b).collect()
        };
        assert_eq!(differs(0.0), [false, true, false, false]);
        assert_eq!(differs(19.0), [false, true, false, false]);
        assert_eq!(differs(21.0), [true, true, true, false]);
        assert_eq!(differs(2000.0), [true, true, true, true]);
    }

    #[test]
    fn a_changed_feature_changes_the_coarser_tiles_above_it_and_no_others() {
        let hashes = |changed: &str| -> Vec<(String, String)> {
            let tiles = (0..8).map(|x| tile(x, if x == 2 { changed } else { "a1" })).collect();
            plan(0.0, tiles).coarse.into_iter().map(|tile| (tile.id.to_string(), tile.hash)).collect()
        };
        let (before, after) = (hashes("b1"), hashes("c1"));
        let changed = before.iter().zip(&after).filter(|(a, b)| a.1 != b.1).map(|(a, _)| a.0.as_str());
        // Column 2 is in the second pair.
        assert_eq!((before.len(), changed.collect::<Vec<_>>()), (4, vec!["11/1/2"]));
    }
}
