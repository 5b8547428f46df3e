//! Tiles of a tile with implicit tiling.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fs;

use burgeon_base::error::{Error, Result};
use serde_json::Value;

use super::subtree::{SubtreeFile, SubtreeTile};
use super::tileset::{ParentTile, ShownContent, TilesetCheck};

/// Largest number of levels of a subtree that is read.
const LEVELS: u64 = 10;

/// Description of implicit tiling.
struct ImplicitTiling<'a> {
    content: &'a str,
    subtrees: &'a str,
    /// Number of levels of a subtree.
    step: u32,
    /// Number of levels.
    available: u32,
    replaces: bool,
}

/// Place of a tile: level, column and row.
type TileNumbers = [u32; 3];

impl TilesetCheck<'_> {
    /// Checks the tiles of a tile with implicit tiling. `own` is the tile itself.
    pub(super) fn implicit(&mut self, described: &Value, own: &ParentTile, schema: &Value) -> Result<()> {
        let tiling = match read(described) {
            Ok(tiling) => tiling,
            Err(why) => {
                self.problem(format!("a tile with implicit tiling: {why}"));
                return Ok(());
            }
        };
        let mut tiles: BTreeMap<TileNumbers, SubtreeTile> = BTreeMap::new();
        let mut open: Vec<TileNumbers> = vec![[0; 3]];
        while let Some([level, x, y]) = open.pop() {
            let name = fill_template(tiling.subtrees, [level, x, y]);
            let path = self.folder.path().join(&name);
            let bytes = fs::read(&path).map_err(|error| {
                Error::file(&path, format!("cannot read {name}: {error}"))
                    .help("write it: burgeon tiles join FOLDER --tiling implicit")
            })?;
            let subtree = match SubtreeFile::read(&bytes, tiling.step, schema) {
                Ok(subtree) => subtree,
                Err(why) => {
                    self.problem(format!("{name}: {why}"));
                    continue;
                }
            };
            for tile in subtree.tiles {
                let [own, column, row] = tile.place;
                let place = [level + own, (x << own) + column, (y << own) + row];
                if place[0] >= tiling.available {
                    self.problem(format!("{name} has a tile below the {} levels", tiling.available));
                } else {
                    tiles.insert(place, tile);
                }
            }
            if level + tiling.step < tiling.available {
                let below = |[column, row]: [u32; 2]| {
                    [level + tiling.step, (x << tiling.step) + column, (y << tiling.step) + row]
                };
                open.extend(subtree.children.into_iter().map(below));
            } else if !subtree.children.is_empty() {
                self.problem(format!("{name} has subtrees below the {} levels", tiling.available));
            }
        }
        self.listed(&tiling, own, &tiles)
    }

    /// Checks the tiles, whose parents are before them.
    fn listed(
        &mut self,
        tiling: &ImplicitTiling<'_>,
        own: &ParentTile,
        tiles: &BTreeMap<TileNumbers, SubtreeTile>,
    ) -> Result<()> {
        for (place, tile) in tiles {
            let [level, x, y] = *place;
            let uri = fill_template(tiling.content, *place);
            let parent = level.checked_sub(1).map(|level| tiles.get(&[level, x / 2, y / 2]));
            let above = match parent {
                None => *own,
                Some(None) => {
                    self.problem(format!("{uri} has no parent"));
                    continue;
                }
                Some(Some(parent)) => ParentTile { bounds: Some(parent.bounds), error: parent.error, ..*own },
            };
            let transform = own.transform;
            let inner = ParentTile { transform, bounds: Some(tile.bounds), error: tile.error };
            self.volume(&uri, &inner, &above);
            if tile.has_content {
                let child = |quarter: u32| [level + 1, x * 2 + (quarter & 1), y * 2 + (quarter >> 1)];
                let has_children = (0..4).any(|quarter| tiles.contains_key(&child(quarter)));
                self.content(&ShownContent { uri: &uri, has_children, replaces: tiling.replaces }, &inner)?;
            }
        }
        Ok(())
    }
}

/// Reads the description. Fails with the reason.
fn read(described: &Value) -> std::result::Result<ImplicitTiling<'_>, Cow<'static, str>> {
    let implicit = &described["implicitTiling"];
    let levels = |key: &str, most: u64| {
        let levels = implicit[key].as_u64().filter(|levels| (1..=most).contains(levels));
        levels
            .and_then(|levels| u32::try_from(levels).ok())
            .ok_or_else(|| Cow::from(format!("{key} is invalid")))
    };
    let uri = |value: &'_ Value| -> Option<()> {
        let text = value["uri"].as_str()?;
        ["{level}", "{x}", "{y}"].iter().all(|name| text.contains(name)).then_some(())
    };
    for key in ["children", "metadata"] {
        if !described[key].is_null() {
            return Err(format!("it has {key}").into());
        }
    }
    if !described["content"]["boundingVolume"].is_null() {
        return Err("its content has a volume".into());
    }
    if implicit["subdivisionScheme"] != "QUADTREE" {
        return Err("it is no quadtree".into());
    }
    uri(&described["content"]).zip(uri(&implicit["subtrees"])).ok_or("a template has no place")?;
    Ok(ImplicitTiling {
        content: described["content"]["uri"].as_str().unwrap_or_default(),
        subtrees: implicit["subtrees"]["uri"].as_str().unwrap_or_default(),
        step: levels("subtreeLevels", LEVELS)?,
        available: levels("availableLevels", 24)?,
        replaces: described["refine"] == "REPLACE",
    })
}

/// Returns a template with the place of a tile.
fn fill_template(template: &str, [level, x, y]: TileNumbers) -> String {
    let text = template.replace("{level}", &level.to_string());
    text.replace("{x}", &x.to_string()).replace("{y}", &y.to_string())
}
