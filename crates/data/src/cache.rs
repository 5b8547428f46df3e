//! Cache of layers and rasters for consecutive runs.

use std::fmt;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::companions;
use super::elevation::{HeightOptions, Raster};
use crate::layer::Layer;
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::Result;
use burgeon_base::files;
use burgeon_base::locks::LockRecovery;
use burgeon_spatial::ReferenceFrame;

/// Maximum number of cached layers.
const MOST: usize = 16;
/// Maximum number of cached rasters, which may be large.
const MOST_RASTERS: usize = 2;

/// Layers and rasters by the content of their files; a file is read again only if its content has changed.
#[derive(Default)]
pub struct Cache {
    kept: Mutex<Vec<(String, Arc<Layer>, ReferenceFrame)>>,
    rasters: Mutex<Vec<(String, Arc<Raster>)>>,
    #[cfg(feature = "data")]
    copies: Mutex<Vec<Arc<super::PackageState>>>,
}

impl fmt::Debug for Cache {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Cache")
    }
}

impl Cache {
    /// Returns a key that identifies a layer of the file at `path`, called `name` in messages; `None` if the content
    /// cannot be identified. Fails if the file is a database locked by another program.
    ///
    /// `frame` is the current reference frame of the run, into which the layer is transformed.
    pub fn key(
        path: &Path,
        name: &str,
        wanted: &SourceOptions,
        frame: Option<&ReferenceFrame>,
    ) -> Result<Option<String>> {
        let Some(mut content) = content(path, name, &wanted.budget)? else { return Ok(None) };
        for beside in companions(path) {
            // A missing file contributes nothing to the key.
            content += &hash(&beside).map(|hash| hash.to_hex().to_string()).unwrap_or_default();
        }
        let frame = frame.map(|frame| (&frame.name, frame.origin));
        Ok(Some(format!("{content} {} {wanted:?} {frame:?}", path.display())))
    }

    /// Returns the layer with this key, and its reference frame.
    pub fn get(&self, key: &str) -> Option<(Arc<Layer>, ReferenceFrame)> {
        let kept = self.kept.lock().recover();
        let found = kept.iter().find(|(known, ..)| known == key);
        found.map(|(_, layer, frame)| (Arc::clone(layer), frame.clone()))
    }

    /// Stores a layer; removes the oldest if the cache is full.
    pub fn keep(&self, key: String, layer: &Arc<Layer>, frame: &ReferenceFrame) {
        let mut kept = self.kept.lock().recover();
        if kept.len() >= MOST {
            kept.remove(0);
        }
        kept.push((key, Arc::clone(layer), frame.clone()));
    }

    /// Returns the raster of files, each with a name and a path; reads it if it is not cached. Removes the oldest
    /// raster if the cache is full.
    pub fn raster(
        &self,
        files: &[(String, PathBuf)],
        wanted: &HeightOptions,
        budget: &Budget,
    ) -> Result<Arc<Raster>> {
        let read = || Raster::open_all(files, wanted, budget).map(Arc::new);
        let beside = |path: &Path| -> Vec<_> {
            companions(path).iter().filter_map(|path| Some(hash(path).ok()?.to_hex())).collect()
        };
        let contents = files.iter().map(|(name, path)| Ok((hash(path)?.to_hex(), beside(path), name)));
        // The reader reports files that cannot be hashed.
        let Ok(contents) = contents.collect::<std::io::Result<Vec<_>>>() else { return read() };
        let key = format!("{contents:?} {wanted:?}");
        let mut kept = self.rasters.lock().recover();
        let index = match kept.iter().position(|(known, _)| *known == key) {
            Some(index) => index,
            None => {
                if kept.len() >= MOST_RASTERS {
                    kept.remove(0);
                }
                kept.push((key, read()?));
                kept.len() - 1
            }
        };
        Ok(Arc::clone(&kept[index].1))
    }
}

#[cfg(feature = "data")]
impl Cache {
    /// Lets the readers of `budget` use the copy of the database at `path` that an earlier run has made, if the file has not
    /// changed since then.
    pub fn lend_copy(&self, path: &Path, budget: &Budget) {
        let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let mut copies = self.copies.lock().recover();
        copies.retain(|state| state.path() != path || state.is_current_copy());
        copies.iter().filter(|state| state.path() == path).for_each(|state| state.lend(budget));
    }

    /// Keeps the copy of the database at `path` that the readers of `budget` have made, if any, for later runs.
    pub fn keep_copy(&self, path: &Path, budget: &Budget) {
        let Some(state) = super::PackageState::opened(path, budget).filter(|state| state.is_current_copy())
        else {
            return;
        };
        let mut copies = self.copies.lock().recover();
        copies.retain(|known| known.path() != state.path());
        if copies.len() >= MOST {
            copies.remove(0);
        }
        copies.push(state);
    }
}

/// Returns a key that identifies the content of a file, if possible.
fn content(path: &Path, name: &str, budget: &Arc<Budget>) -> Result<Option<String>> {
    let mut head = Vec::new();
    let read = files::read_unlocked(path, |file, _| {
        file.take(16).read_to_end(&mut head)?;
        Ok(())
    });
    // The reader reports files that cannot be read.
    let Ok(read) = read else { return Ok(None) };
    // A file locked by a database connection of this process is a database.
    if read.is_none() || head.starts_with(b"SQLite format 3") {
        return database_content(path, name, budget);
    }
    Ok(hash(path).ok().map(|hash| hash.to_hex().to_string()))
}

#[cfg(feature = "data")]
fn database_content(path: &Path, name: &str, budget: &Arc<Budget>) -> Result<Option<String>> {
    Ok(super::PackageState::open(path, name, budget)?.key().map(str::to_owned))
}

#[cfg(not(feature = "data"))]
fn database_content(_: &Path, _: &str, _: &Arc<Budget>) -> Result<Option<String>> {
    Ok(None)
}

/// Returns the hash of a file's content.
fn hash(path: &Path) -> std::io::Result<blake3::Hash> {
    let (file, _) = burgeon_base::files::open(path)?;
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(file)?;
    Ok(hasher.finalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_raster_is_read_anew_when_its_file_or_what_is_wanted_has_changed() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.r32");
        let cache = Cache::default();
        let read = |height: f32, east: f64| {
            std::fs::write(&path, [height.to_le_bytes(); 4].concat()).unwrap();
            let bounds = Some([0.0, 0.0, east, 1.0]);
            let wanted = HeightOptions { bounds, ..HeightOptions::default() };
            cache.raster(&[("a.r32".to_owned(), path.clone())], &wanted, &Budget::default()).unwrap()
        };
        let first = read(1.0, 1.0);
        assert!(Arc::ptr_eq(&first, &read(1.0, 1.0)));
        assert_eq!(read(1.0, 2.0).bounds()[2], 2.0);
        assert_eq!(read(3.0, 1.0).heights, [3.0; 4]);
        let files = [("a".to_owned(), folder.path().to_path_buf())];
        let error = cache.raster(&files, &HeightOptions::default(), &Budget::default()).unwrap_err();
        assert_eq!(error.message(), "a is a folder");
    }

    #[cfg(feature = "data")]
    #[test]
    fn a_copied_database_is_lent_to_later_runs_until_its_file_changes() {
        use crate::{PackageState, SourceOptions};
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.gpkg");
        let connection = rusqlite::Connection::open(&path).unwrap();
        connection.execute_batch("CREATE TABLE a(b INTEGER); INSERT INTO a VALUES (1)").unwrap();
        std::thread::sleep(std::time::Duration::from_millis(100));
        let cache = Cache::default();
        let open = || {
            let budget = SourceOptions::default().budget;
            cache.lend_copy(&path, &budget);
            let state = PackageState::open(&path, "a.gpkg", &budget).unwrap();
            cache.keep_copy(&path, &budget);
            state
        };
        let first = open();
        assert!(Arc::ptr_eq(&first, &open()));
        connection.execute_batch("UPDATE a SET b = 2").unwrap();
        assert!(!Arc::ptr_eq(&first, &open()));
    }
}
