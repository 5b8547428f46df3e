//! Files that appear together and whole, or not at all.

use crate::error::{Error, Result};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// What an export writes: its main file and others in the same folder, under temporary names until
/// [`publish`](Files::publish). Dropped before that, it removes them.
pub(super) struct Files {
    main: PathBuf,
    written: Vec<Written>,
}

struct Written {
    temporary: PathBuf,
    target: PathBuf,
}

/// A target that has been replaced, and how it was before: under another name, or not there.
struct Replaced<'a> {
    target: &'a Path,
    before: Option<PathBuf>,
}

impl Files {
    /// Nothing yet, for an export to `main`. Fails if its folder is not there or if `main` is a folder.
    pub(super) fn beside(main: &Path) -> Result<Self> {
        if main.is_dir() {
            let error = Error::new(format!("cannot write {}: it is a folder", main.display()));
            return Err(
                error.help(format!("name a file in it, such as {}", main.join("model.glb").display()))
            );
        }
        let folder = folder(main);
        if !folder.is_dir() {
            let error = Error::new(format!(
                "cannot write {}: there is no folder {}",
                main.display(),
                folder.display()
            ));
            return Err(error.help("make the folder first, or write to one that is there"));
        }
        Ok(Self { main: main.into(), written: Vec::new() })
    }

    /// The file that the export was asked for.
    pub(super) fn main(&self) -> &Path {
        &self.main
    }

    /// The name of the main file without its extension.
    pub(super) fn stem(&self) -> String {
        self.main.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// The path of a file called `name` in the main file's folder.
    pub(super) fn sibling(&self, name: &str) -> PathBuf {
        self.main.with_file_name(name)
    }

    /// Writes what will be `target`, a file in the main file's folder. Fails if the disk or the folder does.
    pub(super) fn write(
        &mut self,
        target: &Path,
        content: impl FnOnce(&mut BufWriter<File>) -> io::Result<()>,
    ) -> Result<()> {
        let (temporary, file) = create_temporary(target).map_err(|error| refused(target, &error))?;
        self.written.push(Written { temporary, target: target.into() });
        let mut out = BufWriter::with_capacity(1 << 18, file);
        content(&mut out).and_then(|()| out.flush()).map_err(|error| refused(target, &error))
    }

    /// Gives every file its name, in the order they were written. If one of them fails, those before it are
    /// as they were.
    pub(super) fn publish(mut self) -> Result<()> {
        let written = std::mem::take(&mut self.written);
        let mut replaced: Vec<Replaced<'_>> = Vec::new();
        let mut failure = None;
        for (i, file) in written.iter().enumerate() {
            // The last rename needs no way back, since nothing can fail after it.
            let last = i + 1 == written.len();
            let renamed = (if last { Ok(None) } else { set_aside(&file.target) }).and_then(|before| {
                replaced.push(Replaced { target: &file.target, before });
                fs::rename(&file.temporary, &file.target)
            });
            if let Err(error) = renamed {
                failure = Some((i, refused(&file.target, &error)));
                break;
            }
        }
        match failure {
            None => {
                for before in replaced.into_iter().filter_map(|it| it.before) {
                    remove(&before);
                }
                Ok(())
            }
            Some((failed, error)) => {
                // The file whose rename failed is still there as it was.
                for (i, Replaced { target, before }) in replaced.iter().enumerate() {
                    match before {
                        Some(before) if i < failed => {
                            let _ = fs::rename(before, target);
                        }
                        Some(before) => remove(before),
                        None if i < failed => remove(target),
                        None => {}
                    }
                }
                self.written = written;
                Err(error)
            }
        }
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        for file in &self.written {
            remove(&file.temporary);
        }
    }
}

/// Removes a file of ours; if that fails there is nothing better to do than to leave it.
fn remove(path: &Path) {
    let _ = fs::remove_file(path);
}

/// The folder that `path` is in.
fn folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if folder.as_os_str().is_empty() => Path::new("."),
        Some(folder) => folder,
        None => path,
    }
}

/// A name beside `target` that this process has not used yet.
fn temporary_name(target: &Path) -> PathBuf {
    static NEXT: AtomicU64 = AtomicU64::new(0);
    let mut name = OsString::from(".");
    name.push(target.file_name().unwrap_or_default());
    name.push(format!(".{}-{}.part", std::process::id(), NEXT.fetch_add(1, Ordering::Relaxed)));
    target.with_file_name(name)
}

fn create_temporary(target: &Path) -> io::Result<(PathBuf, File)> {
    loop {
        let path = temporary_name(target);
        match File::create_new(&path) {
            // A process that had our number was killed and left its file.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            other => return other.map(|file| (path, file)),
        }
    }
}

/// A second name for the file at `target`, or a copy where the disk knows no second names; `None` if there is
/// no such file.
fn set_aside(target: &Path) -> io::Result<Option<PathBuf>> {
    if !target.is_file() {
        return Ok(None);
    }
    let aside = temporary_name(target);
    if fs::hard_link(target, &aside).is_err() {
        fs::copy(target, &aside)?;
    }
    Ok(Some(aside))
}

/// The error for a `path` that could not be written.
fn refused(path: &Path, error: &io::Error) -> Error {
    let said = Error::new(format!("cannot write {}: {error}", path.display()));
    match error.kind() {
        ErrorKind::NotFound => said.help("make the folder first, or write to one that is there"),
        ErrorKind::PermissionDenied | ErrorKind::ReadOnlyFilesystem => said.help(format!(
            "write to a folder other than {}, where you may make files",
            folder(path).display()
        )),
        ErrorKind::StorageFull | ErrorKind::QuotaExceeded => {
            said.help("free some space, or write to another disk")
        }
        ErrorKind::IsADirectory => said.help("remove that folder, or choose another name"),
        _ => said.help("write to another folder or disk"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|it| it.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_failing_write_leaves_the_old_file_and_no_temporary_one() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.glb");
        fs::write(&path, "old").unwrap();
        let mut files = Files::beside(&path).unwrap();
        let error = files
            .write(&path, |out| {
                out.write_all(b"half")?;
                Err(io::Error::from(ErrorKind::StorageFull))
            })
            .unwrap_err();
        assert!(error.to_string().contains("free some space"), "{error}");
        drop(files);
        assert_eq!(fs::read_to_string(&path).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.glb"]);
    }

    #[test]
    fn files_appear_together_or_not_at_all() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        fs::write(path("a.bin"), "old").unwrap();
        fs::create_dir_all(path("a.gltf/full")).unwrap();
        let write_all = |files: &mut Files| {
            for name in ["a.png", "a.bin", "a.gltf"] {
                files.write(&path(name), |out| out.write_all(b"new")).unwrap();
            }
        };
        let mut files = Files { main: path("a.gltf"), written: Vec::new() };
        write_all(&mut files);
        files.publish().unwrap_err();
        assert_eq!(fs::read_to_string(path("a.bin")).unwrap(), "old");
        assert_eq!(names(folder.path()), ["a.bin", "a.gltf"]);

        fs::remove_dir_all(path("a.gltf")).unwrap();
        let mut files = Files::beside(&path("a.gltf")).unwrap();
        write_all(&mut files);
        assert_eq!(fs::read_to_string(path("a.bin")).unwrap(), "old");
        files.publish().unwrap();
        assert_eq!(names(folder.path()), ["a.bin", "a.gltf", "a.png"]);
        assert_eq!(fs::read_to_string(path("a.bin")).unwrap(), "new");
    }

    #[test]
    fn a_missing_folder_and_a_folder_in_the_way_are_refused_before_anything_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let said = |path: &Path| {
            let text = Files::beside(path).map(|_| ()).unwrap_err().to_string();
            text.replace(&folder.path().display().to_string(), "FOLDER")
        };
        insta::assert_snapshot!(said(&folder.path().join("no/a.glb")), @r"
        cannot write FOLDER/no/a.glb: there is no folder FOLDER/no
          help: make the folder first, or write to one that is there
        ");
        insta::assert_snapshot!(said(folder.path()), @r"
        cannot write FOLDER: it is a folder
          help: name a file in it, such as FOLDER/model.glb
        ");
        assert!(Files::beside(Path::new("a.glb")).is_ok());
    }
}
