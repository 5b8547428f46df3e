//! Switches packages off and on: a file beside the script's packages has the names of those that are off.

use std::fs;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use burgeon_base::error::{Error, Result, SourcePlace};

use super::find::BESIDE;
use super::manifest::is_name;

/// The file, in the folder of packages beside a script.
pub const SWITCHES: &str = "disabled.txt";

/// The most (bytes) that the file may have.
const LARGEST: u64 = 1_000_000;

/// Switches the packages called `name` off for scripts in the folder `script`, or on. Returns the file that says which are
/// off, and whether it was changed.
///
/// Other lines of the file stay as they are. The file goes with its last name. Fails if the file cannot be read or written.
pub fn switch(script: &Path, name: &str, on: bool) -> Result<(PathBuf, bool)> {
    let folder = script.join(BESIDE);
    let file = folder.join(SWITCHES);
    let known = disabled_names(&folder)?;
    if known.iter().any(|known| known == name) != on {
        return Ok((file, false));
    }
    let cannot = |error: std::io::Error| {
        Error::file(&file, format!("cannot write {}: {error}", file.display()))
            .help("see that you may write there")
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

/// The names in the file of the folder of packages `mods`, sorted; none if there is no file.
pub(crate) fn disabled_names(mods: &Path) -> Result<Vec<String>> {
    let text = read(mods)?.unwrap_or_default();
    let mut names = Vec::new();
    for (index, line) in text.lines().enumerate() {
        match name_of(line) {
            "" => {}
            name if is_name(name) => names.push(name.to_owned()),
            _ => {
                let place = SourcePlace { file: mods.join(SWITCHES).display().to_string(), line: index + 1 };
                return Err(Error::data("this is no name of a package, so no package is switched off")
                    .help("write one name a line; what follows # is a comment")
                    .at(Some(place)));
            }
        }
    }
    names.sort();
    names.dedup();
    Ok(names)
}

/// The name in a line, without its comment.
fn name_of(line: &str) -> &str {
    line.split('#').next().unwrap_or_default().trim()
}

/// The file's text, if there is one. A link is not followed, since messages show lines of what it leads to.
fn read(mods: &Path) -> Result<Option<String>> {
    let file = mods.join(SWITCHES);
    let cannot = |why: &dyn std::fmt::Display| {
        Error::file(&file, format!("cannot read {}: {why}", file.display()))
            .help("it is a text file with one name a line")
    };
    match file.symlink_metadata() {
        Err(error) if error.kind() == ErrorKind::NotFound || error.kind() == ErrorKind::NotADirectory => {
            return Ok(None);
        }
        Err(error) => return Err(cannot(&error)),
        Ok(meta) if !meta.is_file() => return Err(cannot(&"it is no regular file")),
        Ok(_) => {}
    }
    let bytes = burgeon_base::files::read(&file, LARGEST).map_err(|error| cannot(&error))?;
    String::from_utf8(bytes).map(Some).map_err(|_| cannot(&"it is not a text file"))
}
