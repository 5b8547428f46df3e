//! Access of scripts to files: names are resolved in the script's folder, in data folders and in packages.

use std::path::{Path, PathBuf};

use super::paths::{is_absolute, lead};
use super::session::Session;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::{Loader, Resources};
use burgeon_packages::Package;

/// Access to the files of a run, for the script or for a package.
pub(super) struct FileAccess<'a> {
    pub(super) session: &'a Session,
    /// Package whose file requests the files, if any.
    pub(super) asker: Option<&'a Package>,
}

impl Resources for FileAccess<'_> {
    fn find(&self, what: &'static str, name: &str) -> Result<PathBuf> {
        find(self.session, self.asker, what, name)
    }

    fn seek(&self, path: &Path, exists: bool) {
        self.session.seek(path, exists);
    }

    fn warn(&self, warning: Warning) {
        self.session.warn(warning);
    }

    fn check(&self) -> Result<()> {
        self.session.stop.check()
    }
}

/// Returns the files that a script calls `name`, at least one. If `loader` takes several files, `name` can be a folder or a
/// pattern of file names.
pub(super) fn find_all(
    session: &Session,
    asker: Option<&Package>,
    loader: &Loader,
    name: &str,
) -> Result<Vec<(String, PathBuf)>> {
    let (folder, last) = name.rsplit_once('/').unwrap_or((".", name));
    let is_pattern = !loader.several.is_empty() && last.contains(['*', '?']);
    let path = find(session, asker, loader.what, if is_pattern { folder } else { name })?;
    if loader.several.is_empty() || !path.is_dir() {
        return Ok(vec![(name.to_owned(), path)]);
    }
    let (folder, pattern) = if is_pattern { (folder, last) } else { (name.trim_end_matches('/'), "*") };
    let entries = std::fs::read_dir(&path)
        .map_err(|error| Error::file(&path, format!("cannot read the folder {folder}: {error}")))?;
    let mut found: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    found.retain(|file| {
        let extension =
            Path::new(file).extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        loader.several.contains(&&*extension) && matches_pattern(pattern.as_bytes(), file.as_bytes())
    });
    found.sort();
    if found.is_empty() || found.len() > MOST_FILES {
        let count = (!found.is_empty()).then(|| found.len().to_string());
        let count = count.as_deref().unwrap_or("no");
        let what = format!("{name} means {count} files, each a {}", loader.what);
        return Err(Error::file(&path, what)
            .help(format!("name 1 to {MOST_FILES} files that end in .{}", loader.several.join(", ."))));
    }
    found
        .into_iter()
        .map(|file| {
            let name = if folder == "." { file } else { format!("{folder}/{file}") };
            let path = find(session, asker, loader.what, &name)?;
            Ok((name, path))
        })
        .collect()
}

/// Maximum number of files that one name can match.
const MOST_FILES: usize = 1000;

/// Returns true if a file name matches a pattern, in which `*` matches any text and `?` any byte.
fn matches_pattern(pattern: &[u8], name: &[u8]) -> bool {
    let (mut at, mut read) = (0, 0);
    // Position after the last star, to which the match returns if the rest does not fit.
    let mut star: Option<(usize, usize)> = None;
    while read < name.len() {
        match pattern.get(at) {
            Some(b'*') => {
                star = Some((at, read));
                at += 1;
            }
            Some(byte) if *byte == b'?' || *byte == name[read] => (at, read) = (at + 1, read + 1),
            _ => {
                let Some((begin, taken)) = star else { return false };
                star = Some((begin, taken + 1));
                (at, read) = (begin + 1, taken + 1);
            }
        }
    }
    pattern[at..].iter().all(|byte| *byte == b'*')
}

/// Returns the path of the file `name` of type `what`.
///
/// Searches the script's folder and the `--data` folders, or a package if `name` has a package prefix.
/// `asker` is the package that requests the file, if any.
fn find(session: &Session, asker: Option<&Package>, what: &'static str, name: &str) -> Result<PathBuf> {
    if let Some(found) = session.package_file(what, name, asker) {
        return Ok(found?.path);
    }
    let outside = || {
        Error::file(name, format!("the {what} {name} lies outside the script's folder")).help(
            "a script reads data in its own folder and below it, and in those that are given: --data FOLDER",
        )
    };
    let relative = Path::new(name);
    if is_absolute(relative) {
        return Err(Error::file(name, format!("the {what} {name} is named by a path from the root"))
            .help("name it from the script's folder, or from one that is given: --data FOLDER"));
    }
    let roots = || std::iter::once(session.root()).chain(session.data_roots().iter().map(PathBuf::as_path));
    let mut near = None;
    let mut inside = false;
    for root in roots() {
        let path = lead(root, relative);
        if !path.starts_with(root) {
            continue;
        }
        inside = true;
        match session.find_file(&path)? {
            // A link may point from one of the folders into another.
            Some(found) if session.is_copy(&found) || roots().any(|root| found.starts_with(root)) => {
                return Ok(found);
            }
            Some(_) => return Err(outside()),
            None => {
                let (folder, file) = (path.parent(), path.file_name());
                if let (None, Some(folder), Some(file)) = (&near, folder, file)
                    && folder.canonicalize().is_ok_and(|folder| roots().any(|root| folder.starts_with(root)))
                {
                    near = session.nearest_file(folder, &file.to_string_lossy());
                }
            }
        }
    }
    if !inside {
        return Err(outside());
    }
    let error = Error::not_found(what, name, near.as_deref(), format!("{what} not found: {name}"));
    Err(session.propose_packages(name, error).help(match session.data_roots().is_empty() {
        true => "it is looked for from the script's folder; other folders are given with --data FOLDER",
        false => "it is looked for from the script's folder and from those given with --data",
    }))
}

#[cfg(test)]
mod tests {
    use super::matches_pattern;

    #[test]
    fn stars_mean_any_text() {
        let is = |pattern: &str, name: &str| matches_pattern(pattern.as_bytes(), name.as_bytes());
        assert!(is("*", "a.hgt") && is("N4*.hgt", "N43E007.hgt") && is("N4?E*7.hgt", "N43E007.hgt"));
        assert!(is("**a*", "banana") && is("a", "a") && is("*", ""));
        assert!(
            !is("N4*.hgt", "N53E007.hgt")
                && !is("N4*.hgt", "N43E007.tif")
                && !is("?", "")
                && !is("a*b", "abc")
        );
    }
}
