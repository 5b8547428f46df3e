//! Files that are published together and complete, or not at all.

use std::fs::{self, File};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::target::{FileTarget, ReplaceMethod};
use super::temporary::{Temporary, TemporaryNames, remove};
use burgeon_base::Warning;
use burgeon_base::error::{Error, Result};
use burgeon_base::stop::Stop;

/// Group of files to write in one transaction. Every file has a temporary name until [`publish`](Files::publish), and
/// is removed if the group is dropped before that.
///
/// A symbolic link is kept, and its target is replaced by a file of the same mode and owner. A file that has other hard
/// links, or an owner that this process cannot set, is overwritten in place. A target that is not a regular file, such
/// as a pipe, receives its content after the other files have been written.
///
/// ```
/// use burgeon_export::Files;
/// use std::io::Write;
///
/// let folder = tempfile::tempdir()?;
/// let (model, material) = (folder.path().join("town.obj"), folder.path().join("town.mtl"));
/// let mut files = Files::default();
/// files.write(&model, |out| out.write_all(b"mtllib town.mtl\n"))?;
/// files.write(&material, |out| out.write_all(b"newmtl stone\n"))?;
/// assert!(!model.exists() && !material.exists());
/// files.publish()?;
/// assert!(model.exists() && material.exists());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Default)]
pub struct Files {
    stop: Arc<Stop>,
    written: Vec<OutputFile>,
    /// Folders that were created for the files, each after its parent.
    folders: Vec<Temporary>,
    warnings: Vec<Warning>,
    notes: Vec<String>,
}

/// File under its temporary name.
struct OutputFile {
    target: FileTarget,
    temporary: Temporary,
    way: ReplaceMethod,
}

/// File of a group whose content is being written.
pub struct OpenFile {
    path: PathBuf,
    written: OutputFile,
    out: Out,
}

impl OpenFile {
    /// Returns the writer for the content.
    pub fn out(&mut self) -> &mut Out {
        &mut self.out
    }

    /// Returns the error for content that could not be written.
    pub fn error(&self, error: &io::Error) -> Error {
        self.written.target.write_error(error)
    }
}

/// Writer for the content of a file.
pub type Out = BufWriter<Stoppable>;

/// File that refuses further writes after cancellation.
#[derive(Debug)]
pub struct Stoppable {
    file: File,
    stop: Arc<Stop>,
}

impl Files {
    /// Creates an empty group. If `stop` requests cancellation, writing fails with its reason.
    pub fn new(stop: &Arc<Stop>) -> Self {
        let mut files = Self::default();
        files.stop = Arc::clone(stop);
        files
    }

    /// Returns the cancellation signal.
    pub fn stop(&self) -> Arc<Stop> {
        Arc::clone(&self.stop)
    }

    /// Adds a warning about the content of a file, if there is one.
    pub(super) fn warn(&mut self, warning: impl Into<Option<Warning>>) {
        self.warnings.extend(warning.into());
    }

    /// Adds warnings about the content of a file.
    pub(super) fn warn_all(&mut self, warnings: impl IntoIterator<Item = Warning>) {
        self.warnings.extend(warnings);
    }

    /// Adds notes about the content of a file.
    pub(super) fn note_all(&mut self, notes: impl IntoIterator<Item = String>) {
        self.notes.extend(notes);
    }

    /// Takes the warnings about the contents of the files.
    pub fn take_warnings(&mut self) -> Vec<Warning> {
        std::mem::take(&mut self.warnings)
    }

    /// Takes the notes about the contents of the files.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Writes the content of the future file `path`.
    ///
    /// Fails if the folder does not exist, if `path` is a folder or not writable, if `path` refers to the same file as
    /// another path, or if the disk is full.
    pub fn write(&mut self, path: &Path, content: impl FnOnce(&mut Out) -> io::Result<()>) -> Result<()> {
        let mut file = self.open(path)?;
        let done = content(&mut file.out);
        // A cancelled write reports the cancellation and not an error of the file.
        self.stop.check()?;
        done.map_err(|error| file.error(&error))?;
        self.close(file)
    }

    /// Begins the future file `path`, for content that is written in several steps. It is not part of the group before
    /// [`close`](Self::close).
    ///
    /// Fails as [`write`](Self::write) does.
    pub fn open(&self, path: &Path) -> Result<OpenFile> {
        self.stop.check()?;
        let target = FileTarget::of(path)?;
        self.refuse_twice(&target, path)?;
        let (temporary, file, way) = target.create()?;
        let out = BufWriter::with_capacity(1 << 18, Stoppable { file, stop: Arc::clone(&self.stop) });
        Ok(OpenFile { path: path.to_owned(), written: OutputFile { target, temporary, way }, out })
    }

    /// Adds a file with all of its content to the group.
    pub fn close(&mut self, mut file: OpenFile) -> Result<()> {
        let done = file.out.flush();
        self.stop.check()?;
        done.map_err(|error| file.error(&error))?;
        self.refuse_twice(&file.written.target, &file.path)?;
        self.written.push(file.written);
        Ok(())
    }

    fn refuse_twice(&self, target: &FileTarget, path: &Path) -> Result<()> {
        if self.written.iter().any(|known| known.target.is(target)) {
            return Err(Error::usage(format!("{} would be written twice", path.display()))
                .help("specify different files"));
        }
        Ok(())
    }

    /// Creates the folder `path` for files of this group, unless it exists.
    pub fn folder(&mut self, path: &Path) -> Result<()> {
        let missing = |path: &&Path| !path.as_os_str().is_empty() && !path.exists();
        let missing: Vec<&Path> = path.ancestors().take_while(missing).collect();
        for folder in missing.into_iter().rev() {
            let made = Temporary::folder(folder).map_err(|error| {
                Error::file(folder, format!("cannot create the folder {}: {error}", folder.display()))
                    .help("create it first, or specify an existing folder")
            })?;
            self.folders.push(made);
        }
        if path.is_dir() {
            return Ok(());
        }
        Err(Error::file(path, format!("cannot create the folder {}: a file has that name", path.display()))
            .help("specify another folder"))
    }

    /// Writes `bytes` as [`write`](Self::write) does, unless the same `bytes` have already been written to `path`.
    pub(super) fn copy(&mut self, path: &Path, bytes: &[u8]) -> Result<()> {
        match self.has(path, bytes) {
            Some(true) => Ok(()),
            _ => self.write(path, |out| out.write_all(bytes)),
        }
    }

    /// Reports whether the content written for `path` is `bytes`; `None` if nothing has been written for it.
    pub(super) fn has(&self, path: &Path, bytes: &[u8]) -> Option<bool> {
        let target = FileTarget::of(path).ok()?;
        let known = self.written.iter().find(|known| known.target.is(&target))?;
        Some(fs::read(known.temporary.path()).is_ok_and(|known| known == bytes))
    }

    /// Renames every file to its final name, in the order of writing. If one rename fails, the earlier files are
    /// restored.
    pub fn publish(self) -> Result<()> {
        self.stop.check()?;
        for OutputFile { target, temporary, .. } in
            self.written.iter().filter(|file| file.way == ReplaceMethod::Through)
        {
            target.fill(temporary.path()).map_err(|error| target.write_error(&error))?;
        }
        let mut names = TemporaryNames::lock();
        let (kept, done) = replace(&self.written, &mut names);
        if done.is_ok() {
            self.folders.iter().for_each(|folder| folder.keep(&mut names));
        }
        // Dropping a temporary locks the names, so release the lock first.
        drop(names);
        drop(kept);
        done
    }
}

impl Drop for Files {
    fn drop(&mut self) {
        self.written.clear();
        while self.folders.pop().is_some() {}
    }
}

/// Moves all written files to their final paths. The first value of the result is the previous files.
fn replace(written: &[OutputFile], names: &mut TemporaryNames) -> (Vec<Option<Temporary>>, Result<()>) {
    let mut kept: Vec<Option<Temporary>> = Vec::new();
    let files: Vec<&OutputFile> = written.iter().filter(|file| file.way != ReplaceMethod::Through).collect();
    for (index, file) in files.iter().enumerate() {
        let into = file.way == ReplaceMethod::Into;
        // Nothing can fail after the last rename, so the last file needs no backup.
        let last = index + 1 == files.len() && !into;
        let target = file.target.real();
        let before = if last { Ok(None) } else { Temporary::of(target, into, names) };
        let done = before.and_then(|before| {
            kept.push(before);
            if into { file.target.fill(file.temporary.path()) } else { file.temporary.rename(target, names) }
        });
        if let Err(error) = done {
            for (place, (file, before)) in files.iter().zip(&kept).enumerate() {
                restore(file, before.as_ref(), place == index, names);
            }
            return (kept, Err(file.target.write_error(&error)));
        }
    }
    (kept, Ok(()))
}

/// Restores the previous file `before` at the path of `file`, which has replaced it unless it `failed` to. An error
/// while restoring is ignored, because nothing more can be done.
fn restore(file: &OutputFile, before: Option<&Temporary>, failed: bool, names: &mut TemporaryNames) {
    let target = file.target.real();
    match (before, file.way) {
        (Some(before), ReplaceMethod::Into) => {
            let _ = file.target.fill(before.path());
        }
        (Some(before), _) if !failed => {
            let _ = before.rename(target, names);
        }
        (None, ReplaceMethod::Instead) if !failed => remove(target),
        _ => {}
    }
}

impl Write for Stoppable {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.stop.is_stopped() {
            return Err(io::Error::other("stopped"));
        }
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Seek for Stoppable {
    fn seek(&mut self, place: SeekFrom) -> io::Result<u64> {
        self.file.seek(place)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::ErrorKind;

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
        let mut files = Files::default();
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
        fs::write(path("b.bin"), "old").unwrap();
        fs::hard_link(path("b.bin"), path("c.bin")).unwrap();
        let all = || {
            let mut files = Files::default();
            for name in ["a.png", "a.bin", "b.bin", "a.gltf"] {
                files.write(&path(name), |out| out.write_all(b"new")).unwrap();
            }
            files.folder(&path("in/side")).unwrap();
            files.write(&path("in/side/d.bin"), |out| out.write_all(b"new")).unwrap();
            files
        };
        let files = all();
        // A folder that blocks the path appears after the check.
        fs::create_dir_all(path("a.gltf/full")).unwrap();
        files.publish().unwrap_err();
        let read = |name: &str| fs::read_to_string(path(name)).unwrap();
        assert_eq!(["a.bin", "b.bin", "c.bin"].map(read), ["old", "old", "old"]);
        assert_eq!(names(folder.path()), ["a.bin", "a.gltf", "b.bin", "c.bin"]);

        fs::remove_dir_all(path("a.gltf")).unwrap();
        let files = all();
        assert_eq!(read("a.bin"), "old");
        files.publish().unwrap();
        assert_eq!(names(folder.path()), ["a.bin", "a.gltf", "a.png", "b.bin", "c.bin", "in"]);
        assert_eq!(["a.bin", "b.bin", "c.bin", "in/side/d.bin"].map(read), ["new"; 4]);
    }

    #[test]
    fn what_is_stopped_ends_with_the_reason_and_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let stop = Arc::new(Stop::default());
        let mut files = Files::new(&stop);
        let mut written = 0;
        let error = files
            .write(&folder.path().join("a.obj"), |out| {
                for line in 0..1_000_000 {
                    if line == 10_000 {
                        stop.stop(Error::cancellation("nobody waits for it"));
                    }
                    out.write_all(&[b'x'; 1000])?;
                    written = line;
                }
                Ok(())
            })
            .unwrap_err();
        assert_eq!(error.message(), "nobody waits for it");
        assert!(written < 11_000, "{written}");
        assert!(files.publish().is_err());
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn a_missing_folder_and_a_folder_in_the_way_are_refused_before_anything_is_written() {
        let folder = tempfile::tempdir().unwrap();
        let said = |path: &Path| {
            let text = Files::default().write(path, |_| panic!("it is written")).unwrap_err().to_string();
            text.replace(&folder.path().display().to_string(), "FOLDER")
        };
        insta::assert_snapshot!(said(&folder.path().join("no/a.glb")), @r"
        cannot write FOLDER/no/a.glb: folder not found: FOLDER/no
          help: create the folder first, or write to an existing folder
        ");
        insta::assert_snapshot!(said(folder.path()), @r"
        cannot write FOLDER: it is a folder
          help: specify a file in it, such as FOLDER/model.glb
        ");
    }
}
