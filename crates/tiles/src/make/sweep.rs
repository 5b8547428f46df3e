//! Removal of temporary files that ended processes left behind.

use std::fs;
use std::path::Path;
use std::time::{Duration, SystemTime};

use crate::folder::TileFolder;

/// Removes temporary files below `folder` whose last change is older than `age`, and returns their number. Files that
/// cannot be removed stay.
pub fn sweep_temporary(folder: &TileFolder, age: Duration) -> usize {
    let Some(limit) = folder_time(folder.path()).and_then(|now| now.checked_sub(age)) else { return 0 };
    sweep(folder.path(), limit, 0)
}

/// Returns the time of the file system of `folder`, which is that of its files. The clock of this computer may differ from those of
/// other workers.
fn folder_time(folder: &Path) -> Option<SystemTime> {
    let path = folder.join(format!(".clock.{}.part", std::process::id()));
    let time = fs::File::create(&path).and_then(|file| file.metadata()?.modified());
    // A file that stays is removed by a later sweep.
    let _ = fs::remove_file(&path);
    time.ok()
}

/// Largest depth of folders of tiles.
const DEPTH: usize = 7;

fn sweep(folder: &Path, limit: SystemTime, depth: usize) -> usize {
    let mut removed = 0;
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let Ok(kind) = entry.file_type() else { continue };
        if kind.is_dir() {
            let is_ours = depth > 0 || entry.file_name() == "tiles";
            if is_ours && depth < DEPTH {
                removed += sweep(&entry.path(), limit, depth + 1);
            }
            continue;
        }
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let changed = entry.metadata().and_then(|file| file.modified());
        if name.starts_with('.') && name.ends_with(".part") && changed.is_ok_and(|time| time <= limit) {
            removed += usize::from(fs::remove_file(entry.path()).is_ok());
        }
    }
    removed
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_old_temporary_files_are_removed() {
        let folder = tempfile::tempdir().unwrap();
        let tiles = folder.path().join("tiles/9/3/4/5/6");
        fs::create_dir_all(&tiles).unwrap();
        for name in [".5.glb.77-0.part", "5.glb", ".hidden"] {
            fs::write(tiles.join(name), "a").unwrap();
        }
        fs::write(folder.path().join(".plan.json.9-1.part"), "a").unwrap();
        let folder = TileFolder(folder.path().to_owned());
        assert_eq!(sweep_temporary(&folder, Duration::from_secs(3600)), 0);
        assert_eq!(sweep_temporary(&folder, Duration::ZERO), 2);
        let left: Vec<_> =
            folder.path().read_dir().unwrap().flatten().map(|entry| entry.file_name()).collect();
        assert_eq!(left, ["tiles"]);
        assert!(tiles.join("5.glb").exists() && tiles.join(".hidden").exists());
    }
}
