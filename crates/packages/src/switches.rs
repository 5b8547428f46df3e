//! Enables and disables packages: a file next to the script's packages lists the names of the disabled ones.

use std::fs;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result, SourcePlace};

use super::names::is_name;
use super::package::BESIDE;

/// File name, in the packages folder next to a script.
pub const SWITCHES: &str = "disabled.txt";

/// Maximum size (bytes) of the file.
const LARGEST: u64 = 1_000_000;

/// Disables the packages called `name` for scripts in the folder `script`, or enables them if `on`. Returns the path of
/// the file that lists disabled packages, and true if it was changed.
///
/// Other lines of the file are unchanged. The file is deleted together with its last name. Fails if the file cannot be
/// read or written.
///
/// ```
/// use burgeon_packages::switch;
///
/// let folder = tempfile::tempdir()?;
/// let (file, changed) = switch(folder.path(), "castle", false)?;
/// assert_eq!((changed, std::fs::read_to_string(&file)?), (true, "castle\n".to_owned()));
/// assert!(!switch(folder.path(), "castle", false)?.1);
/// switch(folder.path(), "castle", true)?;
/// assert!(!file.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn switch(script: &Path, name: &str, on: bool) -> Result<(PathBuf, bool)> {
    let folder = script.join(BESIDE);
    let file = folder.join(SWITCHES);
    let known = disabled_names(&folder)?;
    if known.iter().any(|known| known == name) != on {
        return Ok((file, false));
    }
    let cannot = |error: std::io::Error| {
        Error::file(&file, format!("cannot write {}: {error}", file.display()))
            .help("get write permission there")
    };
    let before = read(&folder)?.unwrap_or_default();
    let mut lines: Vec<&str> = before.lines().filter(|line| name_of(line) != name).collect();
    if !on {
        lines.push(name);
    }
    if lines.iter().all(|line| line.trim().is_empty()) {
        fs::remove_file(&file).map_err(cannot)?;
        return Ok((file, true));
    }
    fs::create_dir_all(&folder).map_err(cannot)?;
    let mut part = tempfile::NamedTempFile::new_in(&folder).map_err(cannot)?;
    lines.iter().try_for_each(|line| writeln!(part, "{line}")).map_err(cannot)?;
    part.persist(&file).map_err(|error| cannot(error.error))?;
    Ok((file, true))
}

/// Returns the names in the file of the packages folder `mods`, sorted; empty if there is no file.
pub(crate) fn disabled_names(mods: &Path) -> Result<Vec<String>> {
    let text = read(mods)?.unwrap_or_default();
    let mut names = Vec::new();
    for (index, line) in text.lines().enumerate() {
        match name_of(line) {
            "" => {}
            name if is_name(name) => names.push(name.to_owned()),
            _ => {
                let place = SourcePlace { file: mods.join(SWITCHES).display().to_string(), line: index + 1 };
                return Err(Error::data("invalid package name, so no package is disabled")
                    .help("write one name per line; # begins a comment")
                    .at(Some(place)));
            }
        }
    }
    names.sort();
    names.dedup();
    Ok(names)
}

/// Returns the name in a line, without its comment.
fn name_of(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// Returns the file's text, if the file exists. A link is not followed, because messages show lines of the file.
fn read(mods: &Path) -> Result<Option<String>> {
    let file = mods.join(SWITCHES);
    let cannot = |why: &dyn std::fmt::Display| {
        Error::file(&file, format!("cannot read {}: {why}", file.display()))
            .help("it must be a text file with one name per line")
    };
    match file.symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound || error.kind() == ErrorKind::NotADirectory => {
            return Ok(None);
        }
        Err(error) => return Err(cannot(&error)),
        Ok(meta) if !meta.is_file() => return Err(cannot(&"it is not a regular file")),
        Ok(_) => {}
    }
    let bytes = burgeon_base::files::read(&file, LARGEST).map_err(|error| cannot(&error))?;
    String::from_utf8(bytes).map(Some).map_err(|_| cannot(&"it is not a text file"))
}
