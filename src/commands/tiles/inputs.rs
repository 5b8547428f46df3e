//! Paths and files of a plan.

use std::borrow::Cow;
use std::path::{Path, PathBuf};

use burgeon::tiles::TileFolder;
use burgeon::tiles::earth::GeoidGrid;
use burgeon::tiles::make::TerrainHeights;
use burgeon::tiles::plan::{PlannedFile, TilePlan};
use burgeon::{Error, Result};
use clap::Parser;
use clap::builder::{PathBufValueParser, TypedValueParser};

use super::super::shared::ScriptFlags;

/// Arguments of the runs of a plan.
#[derive(Parser)]
#[command(no_binary_name = true)]
struct PlannedArguments {
    #[command(flatten)]
    script: ScriptFlags,
}

/// Returns the parser of the folder of a plan.
pub(super) fn tile_folder() -> impl TypedValueParser<Value = TileFolder> {
    PathBufValueParser::new().map(TileFolder)
}

/// Returns the path of an existing file or folder relative to the folder `base`, with `/` between the parts, so that it stays
/// valid when both are moved or mounted elsewhere.
pub(super) fn portable_path(base: &Path, path: &Path) -> Result<String> {
    let absolute = |path: &Path| {
        path.canonicalize().map_err(|error| {
            Error::file(path, format!("cannot find {}: {error}", path.display())).help("check the path")
        })
    };
    let (base, path) = (absolute(base)?, absolute(path)?);
    let common = base.components().zip(path.components()).take_while(|(a, b)| a == b).count();
    let ups = base.components().skip(common).map(|_| Cow::Borrowed(".."));
    let downs = path.components().skip(common).map(|part| part.as_os_str().to_string_lossy());
    let parts: Vec<Cow<str>> = ups.chain(downs).collect();
    Ok(if parts.is_empty() { ".".to_owned() } else { parts.join("/") })
}

/// Returns the hash of a file.
pub(super) fn hash_file(path: &Path) -> Result<String> {
    let unreadable = |error: std::io::Error| {
        Error::file(path, format!("cannot read {}: {error}", path.display())).help("check its permissions")
    };
    burgeon::tiles::plan::hash_file(path).map_err(unreadable)
}

/// Returns the script flags of a plan in `folder`.
pub(super) fn planned_flags(folder: &Path, plan: &TilePlan, threads: Option<u16>) -> Result<ScriptFlags> {
    let arguments = plan.arguments.iter().map(String::as_str).chain(["--", plan.script.as_str()]);
    let parsed = PlannedArguments::try_parse_from(arguments).map_err(|error| {
        Error::data(format!("the arguments of the plan are invalid: {error}")).help("plan again")
    })?;
    let mut flags = parsed.script;
    flags.relocate(|path| local_path(folder, path), threads);
    Ok(flags)
}

/// Returns the path for this process of a path of a plan in `folder`.
pub(super) fn local_path(folder: &Path, path: &Path) -> PathBuf {
    folder.join(path)
}

/// Returns the grid of the geoid of a plan in `folder`, if it has one.
pub(super) fn geoid(folder: &Path, plan: &TilePlan) -> Result<Option<GeoidGrid>> {
    let grid = plan.frame.geoid.as_ref();
    grid.map(|path| GeoidGrid::open(&local_path(folder, Path::new(path)), path)).transpose()
}

/// Returns the heights of the terrain of a plan in `folder`, if it has one.
pub(super) fn terrain_heights(folder: &Path, plan: &TilePlan) -> Result<Option<TerrainHeights>> {
    let frame = plan.frame.reference()?;
    let file = plan.terrain.as_ref().map(|terrain| &terrain.file.path);
    file.map(|path| TerrainHeights::open(&local_path(folder, Path::new(path)), path, &frame)).transpose()
}

/// Fails if the program or a file is not that of the plan.
pub(super) fn verify_files(folder: &Path, plan: &TilePlan) -> Result<()> {
    let version = env!("CARGO_PKG_VERSION");
    if plan.program != version {
        let planned = &plan.program;
        return Err(Error::data(format!(
            "the plan was made by version {planned}, and this is version {version}"
        ))
        .help("plan again with this version"));
    }
    let terrain = plan.terrain.iter().map(|terrain| &terrain.file);
    for PlannedFile { path, hash } in plan.files.iter().chain(terrain) {
        if hash_file(&local_path(folder, Path::new(path)))? != *hash {
            return Err(Error::data(format!("{path} has changed since the plan was made"))
                .help("plan again: burgeon tiles plan SCRIPT -o FOLDER; tiles that do not change are kept"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_lead_from_the_folder_of_the_plan_to_the_files() {
        let folder = tempfile::tempdir().unwrap();
        let (out, data) = (folder.path().join("a/out"), folder.path().join("a/data/b"));
        std::fs::create_dir_all(&out).unwrap();
        std::fs::create_dir_all(&data).unwrap();
        assert_eq!(portable_path(&out, &data).unwrap(), "../data/b");
        assert_eq!(portable_path(&out, &out).unwrap(), ".");
        assert_eq!(
            local_path(&out, Path::new("../data/b")).canonicalize().unwrap(),
            data.canonicalize().unwrap()
        );
        assert!(portable_path(&out, Path::new("missing")).is_err());
    }
}
