//! Search for the files of a script on disk and in memory.

use std::path::{Path, PathBuf};

use super::session::Session;
use burgeon_base::error::Result;

impl Session {
    /// Returns the canonical path of the file or folder at `path`, which is that of a copy if a loader has it, and records the
    /// search; `None` if there is nothing.
    ///
    /// All files that a script names are found here, so each of them can be in memory. The caller checks with
    /// [`is_inside`](Self::is_inside) that a link does not lead elsewhere. Fails if the loader fails.
    pub(crate) fn find_file(&self, path: &Path) -> Result<Option<PathBuf>> {
        let copy = self.loaded.as_ref().map_or(Ok(None), |folder| folder.find(path))?;
        let found = copy.or_else(|| path.canonicalize().ok());
        match &found {
            Some(copy) if self.is_copy(copy) => self.seek(copy, true),
            found => self.seek(path, found.is_some()),
        }
        Ok(found)
    }

    /// Returns true if the canonical path of a file is in the script's folder, or is that of a copy of a file in memory.
    pub(crate) fn is_inside(&self, path: &Path) -> bool {
        path.starts_with(self.root()) || self.is_copy(path)
    }

    /// Returns true if `path` is that of a copy of a file in memory, which is removed with the session.
    pub(crate) fn is_copy(&self, path: &Path) -> bool {
        self.inner_copy(path).is_some()
    }

    /// Returns the path that the file of a copy seems to have, and any other path as it is.
    pub(crate) fn origin(&self, path: &Path) -> PathBuf {
        let origin = self.loaded.as_ref().and_then(|folder| folder.origin(path));
        origin.unwrap_or_else(|| path.to_path_buf())
    }

    /// Returns the path of a copy from the folder of copies; `None` for other files.
    pub(crate) fn inner_copy<'a>(&self, path: &'a Path) -> Option<&'a Path> {
        self.loaded.as_ref().and_then(|folder| folder.inner_copy(path))
    }
}
