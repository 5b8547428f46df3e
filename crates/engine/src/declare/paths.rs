//! Where the names of files lead that scripts give.

use std::path::{Component, Path, PathBuf};

/// Whether a name begins at the root of the file system, where no script may look.
pub(crate) fn is_absolute(name: &Path) -> bool {
    name.components().any(|part| matches!(part, Component::RootDir | Component::Prefix(_)))
}

/// Where `name` leads from `folder`, by the names alone: links are not followed, and it may be outside.
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
