//! Page with a model and its recipe in one file, which browsers show without a server or a network.
//!
//! The page is a text with places for the model, made from the folder `viewer`. It is data here: no crate of the live view is
//! needed. The model is binary glTF with compressed arrays, in base64.

use std::collections::BTreeMap;
use std::io::Write as _;
use std::path::Path;

use base64::engine::general_purpose::STANDARD;
use base64::write::EncoderWriter;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_spatial::{Attribute, RecordTable};
use serde_json::{Map, Value, json};

use crate::files::Files;
use crate::xml::escape_attribute;
use crate::{Export, SceneFacts, gltf, stem};

/// Text of the page, with places for its generator, title and content.
const PAGE: &str = include_str!("../../../viewer/dist/shared.html");

/// Number of bytes by which a page is recognised.
const BEGIN: usize = 15;

/// Start tag of the facts.
const FACTS: &str = "<script type=\"application/json\" id=\"facts\">";

/// Maximum size (bytes) of a page. Browsers hold its text in memory several times.
const LARGEST: u64 = 100_000_000;

/// Factor by which compression reduces arrays at most, as a cautious estimate.
const SMALLEST: u64 = 8;

/// Approximate least size (bytes) of a triangle on a page. A triangle of a Menger sponge has 6 bytes, and of a tower 11.
const TRIANGLE: u64 = 4;

/// Largest number of triangles of a page, an instance counted as one. It is an estimate, known before the model is complete.
pub const PAGE_TRIANGLES: u64 = LARGEST / TRIANGLE;

/// Remedy for a page that is too large.
const REMEDY: &str = "leave something out: less detail (--lod 2), one part of the features (--part 1/4), attributes, or textures; \
                      or write a .glb file";

/// Returns the message and the remedy for a system with more than [`PAGE_TRIANGLES`].
pub fn refused_page() -> (String, &'static str) {
    let text = format!(
        "the page would have more than {} MB: the system draws more than {} triangles, which have about {TRIANGLE} bytes each or \
         more",
        LARGEST / 1_000_000,
        grouped(PAGE_TRIANGLES as usize)
    );
    (text, REMEDY)
}

/// Axes of the model's coordinates on the page.
const AXES: &str = "x east, y north, z up (m)";

/// Writes the page of a model to `path`.
///
/// Fails if the page would have more than 100 MB.
pub(crate) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let name = stem(path);
    let facts = escape_json(&facts(export, &name)?.to_string());
    let stop = files.stop();
    let rest = (PAGE.len() + facts.len()) as u64;
    let model = if export.scene.triangles() == 0 {
        None
    } else {
        let allow = |arrays: u64, pictures: u64| {
            let least = (arrays / SMALLEST + pictures) * 4 / 3 + rest;
            if least > LARGEST { Err(too_large(least, pictures, rest, "at least ")) } else { Ok(()) }
        };
        let bytes = gltf::packed_glb_for_viewer(export.scene, allow, &stop)?;
        let size = bytes.len() as u64 * 4 / 3 + rest;
        if size > LARGEST {
            return Err(too_large(size, 0, rest, ""));
        }
        Some(bytes)
    };
    let generator = format!("Burgeon {}", env!("CARGO_PKG_VERSION"));
    let (head, tail) =
        PAGE.split_once("{{content}}").ok_or_else(|| Error::internal("the page has no place for a model"))?;
    let head =
        head.replacen("{{generator}}", &generator, 1).replacen("{{title}}", &escape_attribute(&name), 1);
    files.write(path, |out| {
        out.write_all(head.as_bytes())?;
        writeln!(out, "{FACTS}{facts}</script>")?;
        if let Some(model) = &model {
            out.write_all(b"<script type=\"application/octet-stream\" id=\"model\">")?;
            let mut encoder = EncoderWriter::new(&mut *out, &STANDARD);
            encoder.write_all(model)?;
            encoder.finish()?;
            drop(encoder);
            out.write_all(b"</script>")?;
        }
        out.write_all(tail.as_bytes())
    })
}

/// Returns true if a file that begins with `text` is a page.
pub(crate) fn is_page(text: &[u8]) -> bool {
    PAGE.as_bytes().starts_with(text.get(..BEGIN).unwrap_or(b"no page"))
}

/// Returns the facts in the text of a page as JSON; `None` if it is no page of a model.
pub(crate) fn facts_of(text: &str) -> Option<&str> {
    let (_, facts) = text.split_once(FACTS).filter(|_| is_page(text.as_bytes()))?;
    facts.split_once("</script>").map(|(facts, _)| facts)
}

/// Returns the facts that the page shows.
fn facts(export: &Export<'_>, name: &str) -> Result<Value> {
    let (scene, facts) = (export.scene, &export.facts);
    let bounds = scene.bounds().map(|(low, high)| json!({ "low": low.to_array(), "high": high.to_array() }));
    let recipe = facts.recipe.map(serde_json::to_value).transpose().map_err(Error::internal)?;
    Ok(json!({
        "name": name,
        "program": env!("CARGO_PKG_VERSION"),
        "triangles": scene.triangles(),
        "instances": scene.instances.len(),
        "bounds": bounds,
        "place": facts.frame.map(|frame| {
            let mut place = frame.world_place().to_json();
            place["axes"] = AXES.into();
            place
        }),
        "features": features(facts),
        // JavaScript has no such large numbers.
        "seed": facts.recipe.map(|recipe| recipe.seed.to_string()),
        "recipe": recipe,
    }))
}

/// Returns the chosen attributes of all features by their ids; empty without a choice.
fn features(facts: &SceneFacts<'_>) -> BTreeMap<String, Map<String, Value>> {
    let mut features = BTreeMap::new();
    let Some(names) = facts.metadata else { return features };
    for system in facts.systems {
        let RecordTable { columns, records, .. } = system.records.with_columns(names);
        for record in records {
            let value = |(number, name): (usize, &String)| {
                let value = match record.value(number)? {
                    Attribute::Boolean(value) => (*value).into(),
                    Attribute::Number(value) => (*value).into(),
                    Attribute::Text(text) => text.as_ref().into(),
                    Attribute::Nested(value) => value.to_string().into(),
                };
                Some((name.clone(), value))
            };
            let values: Map<String, Value> = columns.iter().enumerate().filter_map(value).collect();
            features.entry(record.id).or_insert(values);
        }
    }
    features
}

/// Escapes JSON for an element of a page, which its end tag and comments would end.
fn escape_json(text: &str) -> String {
    // In JSON these characters are in texts only.
    text.replace('<', "\\u003c").replace('>', "\\u003e").replace('&', "\\u0026")
}

/// Returns the error for a page of `size` bytes, of which `pictures` are textures and `rest` is neither them nor the model.
fn too_large(size: u64, pictures: u64, rest: u64, about: &str) -> Error {
    let mb = |bytes: u64| bytes.div_ceil(1_000_000);
    let text = format!(
        "the page would have {about}{} MB: textures {}, shapes {}, page and facts {}; at most {} MB are allowed",
        mb(size),
        mb(pictures * 4 / 3),
        mb(size.saturating_sub(pictures * 4 / 3 + rest)),
        mb(rest),
        LARGEST / 1_000_000
    );
    Error::limit(Limit::Format, text).help(REMEDY)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::samples;
    use base64::Engine as _;
    use burgeon_picture::Picture;
    use burgeon_scene::{Recipe, RecipeFile, Scene};

    const NASTY: &str = "\"quotes\" 'and' </script><!--<script> &amp; \u{1f331}\u{2028}";

    fn page(scene: &Scene, recipe: Option<&Recipe>, name: &str) -> String {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join(name);
        let facts = SceneFacts { recipe, ..SceneFacts::default() };
        let mut files = Files::default();
        files.export(&Export { scene, picture: &Picture::default(), facts }, &path).unwrap();
        files.publish().unwrap();
        std::fs::read_to_string(path).unwrap()
    }

    fn recipe() -> Recipe {
        let file = RecipeFile { name: "a.lua".into(), text: NASTY.into() };
        serde_json::from_value(json!({ "program": "1", "script": "a.lua", "files": [file] })).unwrap()
    }

    fn element<'a>(page: &'a str, id: &str) -> &'a str {
        let (_, rest) = page.split_once(&format!("id=\"{id}\">")).unwrap();
        rest.split_once("</script>").unwrap().0
    }

    #[test]
    fn texts_of_the_script_cannot_end_their_element() {
        let page = page(&samples::boxes(2), Some(&recipe()), "a <title> \u{1f331}'.html");
        let facts: Value = serde_json::from_str(element(&page, "facts")).unwrap();
        assert_eq!(facts["recipe"]["files"][0]["text"], NASTY);
        assert_eq!(facts["name"], "a <title> \u{1f331}'");
        assert!(page.contains("<title>a &lt;title&gt; \u{1f331}&apos;</title>"));
        // Facts, model and bundle.
        assert_eq!(page.matches("<script").count(), 3);
        assert_eq!(page.matches("</script>").count(), 3);
    }

    #[test]
    fn the_model_is_in_the_page_and_no_address_is() {
        let scene = samples::hill(40);
        let page = page(&scene, None, "a.html");
        let model = STANDARD.decode(element(&page, "model")).unwrap();
        assert_eq!(&model[..4], b"glTF");
        let length = u32::from_le_bytes(model[12..16].try_into().unwrap()) as usize;
        let document: Value = serde_json::from_slice(&model[20..20 + length]).unwrap();
        let counts = document["accessors"].as_array().unwrap().iter().filter(|it| it["type"] == "SCALAR");
        assert_eq!(counts.filter_map(|it| it["count"].as_u64()).sum::<u64>(), 3 * scene.triangles() as u64);
        assert!(
            document["extensionsRequired"].as_array().unwrap().contains(&"EXT_meshopt_compression".into())
        );
        assert!(!page.contains("src=") && !page.contains("{{"), "a place is left");
        assert!(page.len() < 1_000_000, "{}", page.len());
    }

    #[test]
    fn a_page_of_nothing_has_no_model_and_the_same_scene_gives_the_same_bytes() {
        assert!(!page(&Scene::default(), None, "a.html").contains("id=\"model\""));
        let twice = || page(&samples::boxes(3), Some(&recipe()), "a.html");
        assert_eq!(twice(), twice());
    }

    #[test]
    fn a_page_that_is_too_large_names_its_parts_and_what_can_be_left_out() {
        let error = too_large(240_000_001, 60_000_000, 1_000_000, "").to_string();
        assert!(error.contains("241 MB: textures 80, shapes 160"), "{error}");
        assert!(error.contains("--lod 2"), "{error}");
    }
}
