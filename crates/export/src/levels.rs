//! Several levels of detail of a model in one glTF file.

use std::path::Path;

use burgeon_base::error::{Error, Result};
use burgeon_scene::Scene;

use crate::files::Files;
use crate::film_model::FilmModel;
use crate::level_storage::LevelStorage;
use crate::{Format, GLB, SceneFacts, gltf, stem};

/// Model in several levels of detail, where equal meshes are stored once.
#[derive(Debug)]
pub struct LevelModel(FilmModel);

impl LevelModel {
    /// Creates a model without levels, whose memory may take `limit` (bytes).
    pub fn new(storage: LevelStorage, limit: usize) -> Self {
        let mut model = FilmModel::new(limit);
        model.levels = Some(storage);
        Self(model)
    }

    /// Adds the next level, from the finest on. Fails if all levels together exceed the memory limit.
    pub fn add(&mut self, level: Scene) -> Result<()> {
        self.0.add(level)
    }

    /// Writes the levels to the future `.glb` file `path`. Fails for another format, and as [`Files::export`] does.
    pub fn write(&mut self, facts: &SceneFacts<'_>, path: &Path, files: &mut Files) -> Result<()> {
        if *Format::of(path)? != GLB {
            return Err(Error::usage(format!("{} cannot have several levels of detail", path.display()))
                .help("write a .glb file, or a file for each level: --level-storage files"));
        }
        let name = stem(path);
        for (level, known) in self.0.names.iter_mut().enumerate() {
            *known = format!("{name}_LOD{level}");
        }
        gltf::write_levels(&self.0, facts, path, files)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;
    use serde_json::{Value, json};

    fn document(storage: LevelStorage) -> Value {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a b.glb");
        let mut model = LevelModel::new(storage, 1 << 30);
        for boxes in [3, 2, 1] {
            model.add(samples::boxes(boxes)).unwrap();
        }
        let mut files = Files::default();
        model.write(&SceneFacts::default(), &path, &mut files).unwrap();
        files.publish().unwrap();
        let bytes = std::fs::read(path).unwrap();
        let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
        serde_json::from_slice(&bytes[20..20 + length]).unwrap()
    }

    /// Returns the places and names of the nodes of levels, and their numbers of children.
    fn levels(document: &Value) -> Vec<(usize, &str, usize)> {
        let nodes = document["nodes"].as_array().unwrap().iter().enumerate();
        let named = nodes.filter_map(|(place, node)| {
            let name = node["name"].as_str().filter(|name| name.contains("_LOD"))?;
            Some((place, name, node["children"].as_array().map_or(0, Vec::len)))
        });
        named.collect()
    }

    #[test]
    fn levels_have_the_names_that_engines_know_and_share_meshes() {
        let document = document(LevelStorage::Names);
        let levels = levels(&document);
        let expected = [("a b_LOD0", 3), ("a b_LOD1", 2), ("a b_LOD2", 1)];
        assert_eq!(levels.iter().map(|(_, name, children)| (*name, *children)).collect::<Vec<_>>(), expected);
        assert_eq!(document["scenes"][0]["nodes"].as_array().unwrap().len(), 3);
        assert_eq!(document["meshes"].as_array().unwrap().len(), 1);
        assert!(document["animations"].is_null());
        assert!(
            document["nodes"].as_array().unwrap().iter().all(|node| node["scale"] != json!([0.0, 0.0, 0.0]))
        );
    }

    #[test]
    fn the_extension_refers_from_the_finest_level_to_the_others() {
        let document = document(LevelStorage::Extension);
        let places: Vec<usize> = levels(&document).iter().map(|(place, _, _)| *place).collect();
        assert_eq!(document["scenes"][0]["nodes"], json!([places[0]]));
        assert_eq!(document["nodes"][places[0]]["extensions"]["MSFT_lod"]["ids"], json!(places[1..]));
        assert_eq!(document["extensionsUsed"], json!(["MSFT_lod"]));
    }
}
