//! Folder of a tileset, and its files that pages may read.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::UNIX_EPOCH;

use burgeon_base::error::{Error, Result};
use burgeon_base::files::identity;
use burgeon_export::{FORMATS, Format, GLB, PNG};

/// Extensions of the files of tilesets that are no output format, with their media types.
const MEDIA_TYPES: &[(&str, &str)] = &[
    ("json", "application/json"),
    ("csv", "text/csv; charset=utf-8"),
    ("bin", "application/octet-stream"),
    ("subtree", "application/octet-stream"),
    ("jpg", "image/jpeg"),
    ("webp", "image/webp"),
];

/// Returns the media type of a file of a tileset. Returns `None` for other files.
fn media_type(extension: &str) -> Option<&'static str> {
    let is_of_tilesets =
        |format: &&Format| **format == GLB || **format == PNG || format.media_type.ends_with("json");
    let mut formats = FORMATS.iter().filter(is_of_tilesets);
    let other = MEDIA_TYPES.iter().find(|(known, _)| *known == extension).map(|(_, media_type)| *media_type);
    other.or_else(|| {
        formats.find(|format| format.file.extensions.contains(&extension)).map(|format| format.media_type)
    })
}

/// Folder of a tileset.
pub(super) struct ServedFolder {
    /// Path as named on the command line.
    pub(super) path: PathBuf,
    /// Path with links resolved.
    real: PathBuf,
}

/// File that a page may read.
pub(in crate::view) struct ServedFile {
    /// Path with links resolved.
    pub(super) path: PathBuf,
    pub(super) media_type: &'static str,
}

impl ServedFolder {
    /// Opens the folder at `path`. Fails if it has no tileset.
    pub(super) fn open(path: &Path) -> Result<Self> {
        let shown = path.display();
        let real = path.canonicalize().map_err(|error| {
            Error::file(path, format!("cannot open {shown}: {error}"))
                .help("check the path and its permissions")
        })?;
        if real.join(TILESET).is_file() {
            return Ok(Self { path: path.to_owned(), real });
        }
        let error = Error::not_found(
            "tileset",
            TILESET,
            [],
            format!("no tileset in this folder: {shown} has no {TILESET}"),
        );
        Err(if real.join(PLAN).is_file() {
            error.help(format!("join the tiles that were made: burgeon tiles join {shown}"))
        } else {
            error.help("make one: burgeon tiles plan SCRIPT -o FOLDER, then make and join; or name a script")
        })
    }

    /// Returns the file at a path of `names` inside the folder. Returns `None` if there is no such file, if it does not belong
    /// to a tileset, or if a link leads out of the folder.
    pub(super) fn file(&self, names: &[String]) -> Option<ServedFile> {
        if names.iter().any(|name| name.is_empty() || name.starts_with('.') || name.contains(':')) {
            return None;
        }
        let (_, extension) = names.last()?.rsplit_once('.')?;
        let media_type = media_type(extension)?;
        let inner: PathBuf = names.iter().collect();
        let path = self.real.join(inner).canonicalize().ok()?;
        (path.starts_with(&self.real) && path.is_file()).then_some(ServedFile { path, media_type })
    }

    /// Returns the files whose changes matter to pages: the tileset and its plan.
    pub(super) fn watched(&self) -> Vec<PathBuf> {
        vec![self.path.join(TILESET), self.path.join(PLAN)]
    }

    /// Returns a text that changes when the tileset is joined again, even to the same bytes. Returns `None` if it is missing.
    pub(super) fn revision(&self) -> Option<String> {
        stamp(&self.real.join(TILESET))
    }

    /// Returns the same of the plan.
    pub(super) fn plan_revision(&self) -> Option<String> {
        stamp(&self.real.join(PLAN))
    }
}

/// Name of the tileset.
const TILESET: &str = "tileset.json";

/// Name of the plan of the tiles.
const PLAN: &str = "plan.json";

/// Returns the length, the time and the identity of the file at `path` as text.
fn stamp(path: &Path) -> Option<String> {
    let metadata = fs::metadata(path).ok()?;
    let modified = metadata.modified().ok().and_then(|time| time.duration_since(UNIX_EPOCH).ok());
    Some(format!(
        "{:x}-{:x}-{:x}",
        metadata.len(),
        modified.unwrap_or_default().as_nanos(),
        identity(&metadata)
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn served(folder: &ServedFolder, path: &str) -> Option<&'static str> {
        let names: Vec<String> = path.split('/').map(str::to_owned).collect();
        folder.file(&names).map(|file| file.media_type)
    }

    fn tileset() -> (tempfile::TempDir, ServedFolder) {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir_all(folder.path().join("out/tiles/12")).unwrap();
        for name in
            ["out/tileset.json", "out/tiles/12/3.glb", "out/notes.lua", "out/.hidden.json", "secret.json"]
        {
            fs::write(folder.path().join(name), "{}").unwrap();
        }
        let opened = ServedFolder::open(&folder.path().join("out")).unwrap();
        (folder, opened)
    }

    #[test]
    fn only_files_of_a_tileset_in_the_folder_are_served() {
        let (_kept, folder) = tileset();
        assert_eq!(served(&folder, "tileset.json"), Some("application/json"));
        assert_eq!(served(&folder, "tiles/12/3.glb"), Some("model/gltf-binary"));
        let refused = [
            "notes.lua",
            ".hidden.json",
            "../secret.json",
            "tiles/../../secret.json",
            "tiles/./12/3.glb",
            "tiles//12/3.glb",
            "tiles",
            "tiles/12",
            "none.json",
            "",
            "/etc/passwd",
            "C:secret.json",
        ];
        for path in refused {
            assert_eq!(served(&folder, path), None, "{path}");
        }
    }

    #[test]
    #[cfg(unix)]
    fn links_lead_to_files_of_the_folder_only() {
        let (kept, folder) = tileset();
        let link = |target: &str, name: &str| {
            std::os::unix::fs::symlink(target, kept.path().join("out").join(name)).unwrap();
        };
        link("tiles/12/3.glb", "inside.glb");
        link("../secret.json", "outside.json");
        link("..", "above");
        link("/etc", "system");
        assert_eq!(served(&folder, "inside.glb"), Some("model/gltf-binary"));
        for path in ["outside.json", "above/secret.json", "system/passwd.json"] {
            assert_eq!(served(&folder, path), None, "{path}");
        }
    }

    #[test]
    fn a_folder_without_a_tileset_is_an_error_with_a_remedy() {
        let folder = tempfile::tempdir().unwrap();
        let remedy = || {
            let error = ServedFolder::open(folder.path()).err().unwrap();
            assert_eq!(error.kind().code(), "not-found");
            error.remedy().unwrap_or_default().to_owned()
        };
        assert!(remedy().contains("burgeon tiles plan"), "{}", remedy());
        fs::write(folder.path().join("plan.json"), "{}").unwrap();
        let join = format!("burgeon tiles join {}", folder.path().display());
        assert!(remedy().contains(&join), "{}", remedy());
        assert_eq!(ServedFolder::open(&folder.path().join("none")).err().unwrap().kind().code(), "file");
    }

    #[test]
    fn a_tileset_of_the_same_bytes_has_another_revision() {
        let (kept, folder) = tileset();
        let before = folder.revision().unwrap();
        assert_eq!(folder.revision().as_deref(), Some(&before[..]));
        let path = kept.path().join("out/tileset.json");
        fs::write(path.with_extension("new"), "{}").unwrap();
        fs::rename(path.with_extension("new"), &path).unwrap();
        assert_ne!(folder.revision(), Some(before));
        fs::remove_file(path).unwrap();
        assert_eq!(folder.revision(), None);
    }
}
