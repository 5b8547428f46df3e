//! Paths and files of a plan.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use burgeon::script::Session;
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

/// Returns the path of a file that does not exist as [`portable_path`] does; `None` unless it is in one of `folders`, which are
/// canonical.
fn portable_absent_path(base: &Path, path: &Path, folders: &[PathBuf]) -> Result<Option<String>> {
    let absolute = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    for ancestor in absolute.ancestors().skip(1) {
        let Ok(there) = ancestor.canonicalize() else { continue };
        if !folders.iter().any(|folder| there.starts_with(folder)) {
            return Ok(None);
        }
        let Ok(rest) = absolute.strip_prefix(ancestor) else { return Ok(None) };
        let rest = rest.components().map(|part| part.as_os_str().to_string_lossy());
        return Ok(Some(format!("{}/{}", portable_path(base, &there)?, rest.collect::<Vec<_>>().join("/"))));
    }
    Ok(None)
}

/// Returns the hash of a file and of the files that are read with it, such as that of its coordinate system.
pub(super) fn hash_file(path: &Path) -> Result<String> {
    let hash = |path: &Path| {
        burgeon::tiles::plan::hash_file(path).map_err(|error: std::io::Error| {
            Error::file(path, format!("cannot read {}: {error}", path.display()))
                .help("check its permissions")
        })
    };
    let mut hashes = vec![hash(path)?];
    let mut known = Vec::new();
    for companion in burgeon::sources::companions(path) {
        let kind = companion.extension().unwrap_or_default().to_ascii_lowercase();
        // The spellings of an extension are one file on some systems.
        if companion.is_file() && !known.contains(&kind) {
            known.push(kind);
            hashes.push(hash(&companion)?);
        }
    }
    Ok(hashes.join("+"))
}

/// Returns the files that a script has read in `session`, except the sources `own`, and those that it looked for in its folder or in the
/// folders of data and did not find: a file that is added later changes the result, too.
pub(super) fn planned_files(
    session: &Session,
    folder: &Path,
    data: &[PathBuf],
    own: &BTreeSet<PathBuf>,
) -> Result<Vec<PlannedFile>> {
    let roots = std::iter::once(session.root()).chain(data.iter().map(PathBuf::as_path));
    let roots: Vec<PathBuf> = roots.filter_map(|folder| folder.canonicalize().ok()).collect();
    let (mut files, mut spellings) = (Vec::new(), BTreeSet::new());
    let mut absent = Vec::new();
    for (path, is_there) in session.sought() {
        if !is_there {
            absent.extend(portable_absent_path(folder, &path, &roots)?);
        } else if path.is_file() && !path.canonicalize().is_ok_and(|path| own.contains(&path)) {
            let (path, hash) = (portable_path(folder, &path)?, hash_file(&path)?);
            spellings.insert(path.to_lowercase());
            files.push(PlannedFile { path, hash });
        }
    }
    // Another spelling of a file that exists is this file on some systems.
    absent.retain(|path| !spellings.contains(&path.to_lowercase()));
    files.extend(absent.into_iter().map(|path| PlannedFile { path, hash: String::new() }));
    files.sort_by(|a, b| a.path.cmp(&b.path));
    files.dedup();
    Ok(files)
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
        let local = local_path(folder, Path::new(path));
        match (local.exists(), hash.is_empty()) {
            (false, true) => continue,
            (true, true) => {
                return Err(Error::data(format!("{path} was not there when the plan was made"))
                    .help("remove it, or plan again: burgeon tiles plan SCRIPT -o FOLDER"));
            }
            (false, false) => {
                return Err(Error::file(&local, format!("{path} is missing, which the plan needs"))
                    .help("restore it, or mount its folder; the path begins in the folder of the plan"));
            }
            (true, false) => {}
        }
        if hash_file(&local)? != *hash {
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
        let root = [folder.path().canonicalize().unwrap()];
        let absent = |path: &str| portable_absent_path(&out, &folder.path().join(path), &root).unwrap();
        assert_eq!(absent("a/data/none.lua").as_deref(), Some("../data/none.lua"));
        assert_eq!(absent("a/none/b/c.lua").as_deref(), Some("../none/b/c.lua"));
        assert_eq!(portable_absent_path(&out, Path::new("/none/x.lua"), &root).unwrap(), None);
    }
}
