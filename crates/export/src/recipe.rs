//! Reads the recipe of a model from its file.

use std::io::{ErrorKind, Read as _};
use std::path::Path;

use crate::page;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::grouped;
use burgeon_scene::Recipe;
use serde::Deserialize;
use serde_json::value::RawValue;

/// Maximum size (bytes) of the description of a model.
const LARGEST: u64 = 1_000_000_000;

/// Length (bytes) of the headers of a `.glb` file and of its description.
const HEAD: u64 = 20;

#[derive(Deserialize)]
struct RecipeDocument<'a> {
    #[serde(borrow)]
    asset: Option<RecipeAsset<'a>>,
}

#[derive(Deserialize)]
struct RecipeAsset<'a> {
    #[serde(borrow)]
    extras: Option<&'a RawValue>,
}

#[derive(Deserialize)]
struct RecipeExtras<'a> {
    #[serde(borrow)]
    recipe: Option<&'a RawValue>,
}

/// Returns the recipe in the `.glb`, `.gltf` or `.html` file at `path`.
///
/// Fails if the file is broken, if it has no recipe, or if the recipe is larger than [`Recipe::LARGEST`] or incomplete. The file
/// need not be trusted.
///
/// ```
/// use burgeon_export::read_recipe;
/// # let folder = tempfile::tempdir()?;
/// let path = folder.path().join("empty.glb");
/// burgeon_export::write(&Default::default(), &path, &Default::default())?;
/// let error = read_recipe(&path).expect_err("no recipe");
/// assert!(error.to_string().contains("no recipe"), "{error}");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn read_recipe(path: &Path) -> Result<Recipe> {
    let text = description(path)?;
    let text =
        std::str::from_utf8(&text).map_err(|_| unreadable_recipe(path, &"its description is not text"))?;
    let extras = match page::facts_of(text) {
        Some(facts) => Some(
            serde_json::from_str::<RecipeExtras<'_>>(facts)
                .map_err(|error| unreadable_recipe(path, &error))?,
        ),
        None => {
            let document: RecipeDocument<'_> =
                serde_json::from_str(text).map_err(|error| unreadable_recipe(path, &error))?;
            let extras = document.asset.and_then(|asset| asset.extras);
            extras.and_then(|extras| serde_json::from_str::<RecipeExtras<'_>>(extras.get()).ok())
        }
    };
    let Some(recipe) = extras.and_then(|extras| extras.recipe) else {
        return Err(Error::file(path, format!("{} has no recipe", path.display()))
            .help("burgeon run writes one into .glb, .gltf and .html files, unless --no-recipe is given"));
    };
    parse(path, recipe.get())
}

/// Parses the JSON `text` of the recipe of the file at `path`.
fn parse(path: &Path, text: &str) -> Result<Recipe> {
    let shown = path.display();
    if text.len() > Recipe::LARGEST {
        let (size, most) = (grouped(text.len()), grouped(Recipe::LARGEST));
        let text = format!("the recipe of {shown} has {size} bytes, and at most {most} are allowed");
        return Err(
            Error::limit(Limit::Size, text).help("Burgeon writes no such recipe; do not trust the file")
        );
    }
    let recipe: Recipe = serde_json::from_str(text).map_err(|error| {
        Error::file(path, format!("the recipe of {shown} is broken: {error}"))
            .help("make the model again, or get an unchanged copy of the file")
    })?;
    if recipe.main_text().is_none() {
        return Err(Error::file(path, format!("the recipe of {shown} is broken: it has no script"))
            .help("make the model again, or get an unchanged copy of the file"));
    }
    Ok(recipe)
}

/// Reads the description of the model at `path`: the first part of a `.glb` file, or all of another file.
fn description(path: &Path) -> Result<Vec<u8>> {
    let unreadable = |error: &std::io::Error| {
        let error_of = Error::file(path, format!("cannot read {}: {error}", path.display()));
        match error.kind() {
            ErrorKind::NotFound => error_of.help("check the path"),
            _ => error_of.help("specify a .glb, .gltf or .html file with read permission"),
        }
    };
    let (mut file, meta) = burgeon_base::files::open(path).map_err(|error| unreadable(&error))?;
    let mut head = Vec::new();
    file.by_ref().take(HEAD).read_to_end(&mut head).map_err(|error| unreadable(&error))?;
    let (length, mut text) = match head.as_slice() {
        [b'g', b'l', b'T', b'F', numbers @ ..] => {
            let number = |at: usize| -> Option<u32> {
                Some(u32::from_le_bytes(numbers.get(at..at + 4)?.try_into().ok()?))
            };
            let (Some(2), Some(length), Some(kind)) = (number(0), number(8), number(12)) else {
                return Err(unreadable_recipe(path, &"it is not binary glTF 2.0"));
            };
            if kind != u32::from_le_bytes(*b"JSON") {
                return Err(unreadable_recipe(path, &"it does not begin with its description"));
            }
            if HEAD + u64::from(length) > meta.len() {
                return Err(unreadable_recipe(path, &"it is shorter than its headers say"));
            }
            (u64::from(length), Vec::new())
        }
        text if text.trim_ascii_start().starts_with(b"{") || page::is_page(text) => {
            (meta.len().saturating_sub(HEAD), text.to_vec())
        }
        _ => return Err(unreadable_recipe(path, &"it is neither glTF nor a page")),
    };
    if length > LARGEST {
        let text = format!("the description of {} has {} MB", path.display(), length / 1_000_000);
        return Err(Error::limit(Limit::Size, text)
            .help(format!("a recipe is read from descriptions of at most {} MB", LARGEST / 1_000_000)));
    }
    file.take(length).read_to_end(&mut text).map_err(|error| unreadable(&error))?;
    Ok(text)
}

/// Returns the error for a file that is no model, for the reason `why`.
fn unreadable_recipe(path: &Path, why: &dyn std::fmt::Display) -> Error {
    Error::file(path, format!("{} is broken: {why}", path.display()))
        .help("specify a .glb, .gltf or .html file that burgeon run has written")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Export, Files, SceneFacts, samples};
    use burgeon_picture::Picture;
    use burgeon_scene::{RecipeFile, RecipeValue};

    fn recipe(text: &str) -> Recipe {
        Recipe {
            program: "0.1.0".into(),
            script: "a.lua".into(),
            files: vec![RecipeFile { name: "a.lua".into(), text: text.into() }],
            values: vec![RecipeValue {
                name: "n".into(),
                value: 3.into(),
                default: None,
                unit: String::new(),
            }],
            seed: 7,
            steps: None,
            lod: 3,
            part: None,
            packages: Vec::new(),
            data: Vec::new(),
            databases: false,
            stdlib: None,
        }
    }

    fn write(recipe: Option<&Recipe>, path: &Path) {
        let facts = SceneFacts { recipe, ..SceneFacts::default() };
        let mut files = Files::default();
        let export = Export { scene: &samples::boxes(2), picture: &Picture::default(), facts };
        files.export(&export, path).unwrap();
        files.publish().unwrap();
    }

    #[test]
    fn models_and_pages_carry_a_recipe_with_any_text() {
        let folder = tempfile::tempdir().unwrap();
        let recipe = recipe("-- \"quotes\", </script>, \u{1f331} and \\\n\u{0}");
        for name in ["a.glb", "a.gltf", "a.html"] {
            let path = folder.path().join(name);
            write(Some(&recipe), &path);
            assert_eq!(read_recipe(&path).unwrap(), recipe);
            write(None, &path);
            assert!(read_recipe(&path).unwrap_err().to_string().contains("has no recipe"));
        }
    }

    #[test]
    fn broken_files_and_large_recipes_are_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        let told = |bytes: &[u8]| {
            std::fs::write(&path, bytes).unwrap();
            read_recipe(&path).unwrap_err().to_string()
        };
        assert!(told(b"").contains("is neither glTF nor a page"));
        assert!(told(b"glTF").contains("not binary glTF 2.0"));
        assert!(
            told(b"glTF\x02\0\0\0\xff\xff\xff\xff\xff\xff\xff\xffJSON{}")
                .contains("shorter than its headers")
        );
        assert!(told(b"glTF\x02\0\0\0\xff\xff\xff\xff\x02\0\0\0BIN\0{}").contains("does not begin"));
        assert!(told(b"{ \"asset\": {").contains("is broken"));
        assert!(told(b"{\"asset\":{\"extras\":5}}             ").contains("has no recipe"));
        assert!(told(b"{\"asset\":{\"extras\":{\"recipe\":5}}}   ").contains("recipe of"));
        assert!(told("[".repeat(100_000).as_bytes()).contains("is neither glTF nor a page"));
        let nested = format!("{{\"asset\":{}", "[".repeat(100_000));
        assert!(told(nested.as_bytes()).contains("is broken"));
        write(Some(&recipe(&"x".repeat(Recipe::LARGEST))), &path);
        assert!(read_recipe(&path).unwrap_err().to_string().contains("at most 1,000,000 are allowed"));
        let mut empty = recipe("");
        empty.files.clear();
        write(Some(&empty), &path);
        assert!(read_recipe(&path).unwrap_err().to_string().contains("it has no script"));
        assert!(
            read_recipe(&folder.path().join("missing.glb")).is_err() && read_recipe(folder.path()).is_err()
        );
    }
}
