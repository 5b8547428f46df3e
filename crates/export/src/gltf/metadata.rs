//! Features of the model and their attributes: feature ids and property tables.
//!
//! A mesh that shows one feature stores the feature's number at each vertex (`EXT_mesh_features`). If instances of a
//! mesh belong to several features, each instance stores it (`EXT_instance_features`). The number is a row of a
//! property table (`EXT_structural_metadata`), with one table for each system.
//!
//! Specification: Cesium GS, "3D Metadata Specification" and the three extensions of glTF, 2023.

use std::borrow::Cow;

use crate::layers::{ColumnKind, column_kinds};
use burgeon_scene::{Instance, Scene};
use burgeon_spatial::Attribute;
use burgeon_spatial::RecordTable;
use gltf_json as json;
use rustc_hash::FxHashSet;
use serde_json::{Map, Value as Json, json};

use super::body::{Body, BodyArray};
use super::description::use_extension;
use crate::SceneFacts;

pub(super) const MESH_FEATURES: &str = "EXT_mesh_features";
pub(super) const INSTANCE_FEATURES: &str = "EXT_instance_features";
const STRUCTURAL: &str = "EXT_structural_metadata";

/// Placeholder for a missing number.
const NO_NUMBER: f64 = f64::MIN;

/// Feature: its table and its row in the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FeaturePlace {
    pub(super) table: usize,
    pub(super) row: usize,
}

/// Features that a mesh shows.
#[derive(Clone, Copy, PartialEq, Eq)]
enum MeshFeatures {
    None,
    One(FeaturePlace),
    /// Several features, or one feature and instances without one.
    Several,
}

/// Features of the items of a scene.
pub(super) struct Metadata {
    /// Tables with the systems that they belong to.
    tables: Vec<(usize, RecordTable)>,
    meshes: Vec<MeshFeatures>,
}

impl Metadata {
    /// Collects the metadata of `scene`. Returns `None` if metadata is not requested or there are no features.
    pub(super) fn of(scene: &Scene, facts: &SceneFacts<'_>) -> Option<Self> {
        let attributes = facts.metadata?;
        let systems = facts.systems.iter().filter(|system| !system.records.records.is_empty());
        let tables: Vec<_> =
            systems.map(|system| (system.system, system.records.with_columns(attributes))).collect();
        if tables.is_empty() {
            return None;
        }
        let mut metadata = Self { tables, meshes: Vec::new() };
        let mut meshes: Vec<Option<MeshFeatures>> = vec![None; scene.meshes.len()];
        for instance in &scene.instances {
            let features = metadata.of_instance(instance).map_or(MeshFeatures::None, MeshFeatures::One);
            let known = &mut meshes[instance.mesh];
            *known = Some(match known {
                Some(known) if *known != features => MeshFeatures::Several,
                _ => features,
            });
        }
        metadata.meshes = meshes.into_iter().map(|known| known.unwrap_or(MeshFeatures::None)).collect();
        Some(metadata)
    }

    /// Returns the feature of an instance.
    pub(super) fn of_instance(&self, instance: &Instance) -> Option<FeaturePlace> {
        let origin = instance.origin?;
        let table = self.tables.iter().position(|(system, _)| *system == origin.system)?;
        let row = origin.record.filter(|row| *row < self.tables[table].1.records.len())?;
        Some(FeaturePlace { table, row })
    }

    /// Returns the row of the instance's feature in its table; -1 for none.
    pub(super) fn number_of(&self, instance: &Instance) -> f32 {
        self.of_instance(instance).map_or(-1.0, |place| place.row as f32)
    }

    /// Returns the feature of a mesh that shows exactly one.
    pub(super) fn of_mesh(&self, mesh: usize) -> Option<FeaturePlace> {
        match self.meshes[mesh] {
            MeshFeatures::One(place) => Some(place),
            _ => None,
        }
    }

    /// Returns true if a mesh shows several features, so that its instances store them.
    pub(super) fn is_shared(&self, mesh: usize) -> bool {
        self.meshes[mesh] == MeshFeatures::Several
    }

    /// Returns the number of rows of a table.
    pub(super) fn rows(&self, table: usize) -> usize {
        self.tables[table].1.records.len()
    }

    /// Lists the extension of the tables.
    pub(super) fn use_tables(&self, root: &mut json::Root) {
        use_extension(root, STRUCTURAL);
    }

    /// Lists the extensions that every document with features uses.
    pub(super) fn use_extensions(&self, root: &mut json::Root) {
        self.use_tables(root);
        if self.meshes.iter().any(|mesh| matches!(mesh, MeshFeatures::One(_))) {
            use_extension(root, MESH_FEATURES);
        }
    }

    /// Writes the tables, before all other data. Returns the extensions of the document.
    pub(super) fn write(&self, body: &mut Body<'_>) -> Json {
        let (mut classes, mut tables) = (Map::new(), Vec::new());
        let mut names = FxHashSet::default();
        for (_, table) in &self.tables {
            let class = identifier(&table.name, &mut names);
            let (mut described, mut values) = (Map::new(), Map::new());
            let mut known = FxHashSet::default();
            let id = identifier("id", &mut known);
            let ids: Vec<Option<&str>> = table.records.iter().map(|record| Some(&*record.id)).collect();
            values.insert(id.clone(), strings(&ids, "", body));
            described.insert(id, json!({ "type": "STRING", "required": true, "semantic": "ID" }));
            for (column, kind) in column_kinds(table).into_iter().enumerate() {
                let name = identifier(&table.columns[column], &mut known);
                let (mut description, value) = property(table, column, kind, body);
                description["name"] = table.columns[column].as_str().into();
                described.insert(name.clone(), description);
                values.insert(name, value);
            }
            tables.push(json!({
                "name": table.name, "class": class, "count": table.records.len(), "properties": values,
            }));
            classes.insert(class, json!({ "name": table.name, "properties": described }));
        }
        json!({ STRUCTURAL: { "schema": { "id": "burgeon", "classes": classes }, "propertyTables": tables } })
    }
}

impl FeaturePlace {
    /// Returns the extension of a primitive that shows only this feature.
    pub(super) fn of_primitive(self) -> Json {
        let ids = json!([{ "featureCount": 1, "attribute": 0, "propertyTable": self.table }]);
        json!({ MESH_FEATURES: { "featureIds": ids } })
    }
}

/// Returns the extension of a primitive whose vertices have numbers of `count` features, rows of a table; vertices with the
/// number `none` have no feature.
pub(super) fn mesh_features(count: usize, none: Option<u32>, table: usize) -> Json {
    // The specification requires at least one feature.
    let mut ids = json!({ "featureCount": count.max(1), "attribute": 0, "propertyTable": table });
    if let Some(none) = none {
        ids["nullFeatureId"] = none.into();
    }
    json!({ MESH_FEATURES: { "featureIds": [ids] } })
}

/// Returns the extension of a node with the features of its instances.
pub(super) fn instance_features(features: &[f32], table: usize) -> Json {
    let different: FxHashSet<u32> = features.iter().map(|number| number.to_bits()).collect();
    json!({ "featureIds": [{ "featureCount": different.len(), "attribute": 0, "propertyTable": table }] })
}

/// Converts `name` to an identifier that differs from all in `taken`.
fn identifier(name: &str, taken: &mut FxHashSet<String>) -> String {
    let letter = |letter: char| if letter.is_ascii_alphanumeric() { letter } else { '_' };
    let plain: String = name.chars().map(letter).collect();
    let first = plain.starts_with(|letter: char| letter.is_ascii_alphabetic() || letter == '_');
    let plain = if first { plain } else { format!("_{plain}") };
    let mut free = Cow::Borrowed(&*plain);
    let mut count = 1;
    while taken.contains(&*free) {
        count += 1;
        free = Cow::Owned(format!("{plain}_{count}"));
    }
    let free = free.into_owned();
    taken.insert(free.clone());
    free
}

/// Returns the schema entry of a column and the location of its values.
fn property(table: &RecordTable, column: usize, kind: ColumnKind, body: &mut Body<'_>) -> (Json, Json) {
    let cells = || table.records.iter().map(|record| record.value(column));
    let complete = cells().all(|cell| cell.is_some());
    match kind {
        ColumnKind::Number | ColumnKind::Integer => {
            let number = |cell: Option<&Attribute>| match cell {
                Some(Attribute::Number(number)) => *number,
                _ => NO_NUMBER,
            };
            let bytes = cells().flat_map(|cell| number(cell).to_le_bytes()).collect();
            let mut described = json!({ "type": "SCALAR", "componentType": "FLOAT64", "required": complete });
            if !complete {
                described["noData"] = NO_NUMBER.into();
            }
            (described, json!({ "values": body.add_aligned(BodyArray::Blob(bytes)) }))
        }
        ColumnKind::Boolean if complete => {
            let mut bytes = vec![0_u8; table.records.len().div_ceil(8)];
            for (row, cell) in cells().enumerate() {
                if matches!(cell, Some(Attribute::Boolean(true))) {
                    bytes[row / 8] |= 1 << (row % 8);
                }
            }
            (
                json!({ "type": "BOOLEAN", "required": true }),
                json!({ "values": body.add_aligned(BodyArray::Blob(bytes)) }),
            )
        }
        // A boolean has no value that could mark a missing one.
        ColumnKind::Boolean => {
            let byte = |cell: Option<&Attribute>| match cell {
                Some(Attribute::Boolean(value)) => u8::from(*value),
                _ => u8::MAX,
            };
            let described = json!({
                "type": "SCALAR", "componentType": "UINT8", "noData": u8::MAX, "description": "1 is true, 0 is false",
            });
            (described, json!({ "values": body.add_aligned(BodyArray::Blob(cells().map(byte).collect())) }))
        }
        ColumnKind::Text => {
            let texts: Vec<Option<String>> = cells().map(|cell| cell.map(Attribute::text)).collect();
            let is_free = |text: &String| !texts.iter().flatten().any(|known| known == text);
            let mut missing =
                (0..).map(|number| if number == 0 { String::new() } else { format!("missing {number}") });
            let missing = missing.find(is_free).unwrap_or_default();
            let mut described = json!({ "type": "STRING", "required": complete });
            if !complete {
                described["noData"] = missing.as_str().into();
            }
            (described, strings(&texts, &missing, body))
        }
    }
}

/// Writes strings one after another, and the offset of each. Returns the locations.
fn strings(texts: &[Option<impl AsRef<str>>], missing: &str, body: &mut Body<'_>) -> Json {
    let (mut bytes, mut offsets) = (Vec::new(), Vec::new());
    for text in texts {
        offsets.push(bytes.len() as u64);
        bytes.extend_from_slice(text.as_ref().map_or(missing, AsRef::as_ref).as_bytes());
    }
    offsets.push(bytes.len() as u64);
    // A view must have at least one byte.
    if bytes.is_empty() {
        bytes.push(0);
    }
    let long = bytes.len() > u32::MAX as usize;
    let kind = if long { "UINT64" } else { "UINT32" };
    let offsets = offsets.into_iter().flat_map(|offset| {
        let bytes = offset.to_le_bytes();
        bytes.into_iter().take(if long { 8 } else { 4 })
    });
    let offsets = offsets.collect();
    let (values, offsets) =
        (body.add_aligned(BodyArray::Blob(bytes)), body.add_aligned(BodyArray::Blob(offsets)));
    json!({ "values": values, "stringOffsets": offsets, "stringOffsetType": kind })
}
