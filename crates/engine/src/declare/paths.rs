//! Resolution of file names from scripts.

use std::path::{Component, Path, PathBuf};

/// Returns true if a path starts at the root of the file system, which scripts may not do.
pub(crate) fn is_absolute(name: &Path) -> bool {
    name.components().any(|part| matches!(part, Component::RootDir | Component::Prefix(_)))
}

/// Resolves `name` from `folder` by its components only: links are not followed, and the result may be
/// outside.
pub(crate) fn lead(folder: &Path, name: &Path) -> PathBuf {
    let mut path = folder.to_path_buf();
    for part in name.components() {
        match part {
            Component::ParentDir => {
                path.pop();
            }
            Component::Normal(part) => path.push(part),
            _ => {}
        }
    }
    path
}
