//! Faces as JSON: their rings and their meanings.

use burgeon_scene::SurfaceMeaning;
use serde_json::{Value as Json, json};

use super::faces::Face;

/// Returns the name of a level of detail: that of roofs is the refined level 2.2.
///
/// Source: F. Biljecki, H. Ledoux and J. Stoter, "An improved LOD specification for 3D building models", 2016.
pub(super) fn level_name(detail: u8) -> String {
    if detail == 2 { "2.2".into() } else { detail.to_string() }
}

/// Returns the rings of `faces` as numbers of vertices.
pub(super) fn boundaries(faces: &[Face], number: impl Fn(u32) -> u32) -> Json {
    let ring = |ring: &Vec<u32>| ring.iter().map(|point| number(*point)).collect::<Json>();
    faces.iter().map(|face| face.rings.iter().map(ring).collect::<Json>()).collect()
}

/// Returns the semantic surfaces of `faces`, or `None` if no face has a meaning.
pub(super) fn semantics(faces: &[Face], in_solid: bool) -> Option<Json> {
    let mut meanings: Vec<SurfaceMeaning> = Vec::new();
    let mut values = Vec::new();
    for face in faces {
        values.push(face.meaning.map(|meaning| {
            meanings.iter().position(|known| *known == meaning).unwrap_or_else(|| {
                meanings.push(meaning);
                meanings.len() - 1
            })
        }));
    }
    let name = |meaning: &SurfaceMeaning| match meaning {
        SurfaceMeaning::Ground => "GroundSurface",
        SurfaceMeaning::Wall => "WallSurface",
        SurfaceMeaning::Roof => "RoofSurface",
        SurfaceMeaning::Window => "Window",
        SurfaceMeaning::Door => "Door",
    };
    let surfaces: Vec<Json> = meanings.iter().map(|meaning| json!({ "type": name(meaning) })).collect();
    let values = if in_solid { json!([values]) } else { json!(values) };
    (!surfaces.is_empty()).then(|| json!({ "surfaces": surfaces, "values": values }))
}
