//! Saving of drawn functions, curves and surfaces in the file next to the script, [`CurvesFile`].
//!
//! Input: the path of a script, and the points of its parameters. Output: the file, `vase.curves.json` for `vase.lua`. A file
//! in another format is rejected and never overwritten.

use std::path::Path;

use serde_json::Value;

use super::json_file::write_json;
use crate::watch::settled;
use burgeon_base::error::{Error, Result};
use burgeon_engine::script::CurvesFile;
use burgeon_engine::script::PointRows;

/// Saves the points of the parameter `name` of `script`, or removes them if there are none, and returns all drawn curves.
///
/// The file is written completely or not at all, and deleted together with its last curve. Fails if the present file is
/// invalid, or if it cannot be written.
///
/// ```
/// use burgeon_engine::script::PointRows;
/// use burgeon_live::curves::save_curve;
///
/// # let folder = std::env::temp_dir().join(format!("burgeon-curves-{}", std::process::id()));
/// # std::fs::create_dir_all(&folder)?;
/// let script = folder.join("vase.lua");
/// save_curve(&script, "taper", Some(PointRows(vec![vec![0.0, 1.0], vec![1.0, 0.2]])))?;
/// assert_eq!(
///     std::fs::read_to_string(folder.join("vase.curves.json"))?,
///     "{\n  \"taper\": [\n    [0, 1],\n    [1, 0.2]\n  ]\n}\n"
/// );
/// # std::fs::remove_dir_all(&folder)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn save_curve(script: &Path, name: &str, points: Option<PointRows>) -> Result<CurvesFile> {
    let path = CurvesFile::path_of(script);
    let mut file = settled(&path, || CurvesFile::read(script))?;
    let was_empty = file.curves().len() == 0;
    file.set(name, points);
    let curves: Value = file.curves().map(|(name, points)| (name, points.to_json())).collect();
    match (file.curves().len() == 0, was_empty) {
        (true, true) => {}
        (true, false) => std::fs::remove_file(&path)
            .map_err(|error| Error::file(&path, format!("cannot remove {}: {error}", path.display())))?,
        (false, _) => write_json(&path, &curves)?,
    }
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(y: f64) -> Option<PointRows> {
        Some(PointRows(vec![vec![0.0, y], vec![0.5, 0.1], vec![1.0, 1.0]]))
    }

    #[test]
    fn what_is_saved_reads_back_and_the_others_stay() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("vase.lua");
        save_curve(&script, "taper", points(1.0)).unwrap();
        save_curve(&script, "growth", points(2.0)).unwrap();
        let saved = save_curve(&script, "taper", points(3.0)).unwrap();
        let read = CurvesFile::read(&script).unwrap();
        assert!(read.is_like(&saved) && read.curves().len() == 2);
        assert_eq!((read.get("taper"), read.get("growth")), (points(3.0).as_ref(), points(2.0).as_ref()));
        save_curve(&script, "taper", None).unwrap();
        assert_eq!(CurvesFile::read(&script).unwrap().curves().len(), 1);
        save_curve(&script, "growth", None).unwrap();
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }

    #[test]
    fn a_file_of_another_form_is_kept() {
        let folder = tempfile::tempdir().unwrap();
        let script = folder.path().join("vase.lua");
        for text in ["", "[1]", "{ \"taper\": 3 }", "{ \"taper\": [[0, NaN]] }", "{ \"a\": [], \"a\": [] }"] {
            std::fs::write(CurvesFile::path_of(&script), text).unwrap();
            let error = save_curve(&script, "taper", points(1.0)).unwrap_err();
            assert!(error.place().is_some() && error.remedy().is_some(), "{error}");
            assert_eq!(std::fs::read_to_string(CurvesFile::path_of(&script)).unwrap(), text);
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_link_is_not_followed() {
        let folder = tempfile::tempdir().unwrap();
        let (script, target) = (folder.path().join("vase.lua"), folder.path().join("target"));
        std::fs::write(&target, "{}\n").unwrap();
        std::os::unix::fs::symlink(&target, CurvesFile::path_of(&script)).unwrap();
        let error = save_curve(&script, "taper", points(1.0)).unwrap_err();
        assert!(error.to_string().contains("it is a link"), "{error}");
        assert_eq!(std::fs::read_to_string(&target).unwrap(), "{}\n");
    }
}
