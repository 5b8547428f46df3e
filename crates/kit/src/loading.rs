//! How a type of object is made of a file.

use std::any::Any;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::{Object, Table};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;

/// Makes objects of files.
#[derive(Clone)]
pub struct Loader {
    /// What its files are, for messages: "file of heights".
    pub what: &'static str,
    /// How a script calls it.
    pub example: &'static str,
    /// The same, with fields.
    pub example_with_fields: &'static str,
    /// The extensions of the files that a folder means, if one object may be made of several files; otherwise none.
    pub several: &'static [&'static str],
    /// Makes one of a file, with the fields that the script gives besides.
    pub load: fn(&mut LoadRequest<'_>, &Table) -> Result<LoadedObject>,
}

/// An object that was made of a file.
#[derive(Clone)]
pub struct LoadedObject {
    /// The object.
    pub object: Arc<dyn Object>,
    /// About how much memory (bytes) it takes.
    pub memory: usize,
    /// What people should know of the file.
    pub warnings: Vec<Warning>,
}

/// A file that a script has named, and what may be used to read it.
pub struct LoadRequest<'a> {
    /// The name that the script gave.
    pub name: &'a str,
    /// Where it is.
    pub path: &'a Path,
    /// The names and the paths of all files that the script has named, of which the first is this one.
    pub files: &'a [(String, PathBuf)],
    /// What reading may take.
    pub budget: &'a Arc<Budget>,
    /// The most triangles that it may hold.
    pub triangles: usize,
    /// Values of the run that some loaders need, found by their type with [`LoadRequest::service`].
    pub services: &'a mut [&'a mut dyn Any],
    /// Files of the run.
    pub resources: &'a dyn Resources,
}

/// What a run gives to those who read its files.
pub trait Resources {
    /// The file that a script means by `name`, which is to be a `what`. Fails for one that it may not read.
    fn find(&self, what: &'static str, name: &str) -> Result<PathBuf>;
}

/// The largest file (bytes) that is read whole.
const LARGEST: u64 = 1_000_000_000;

impl LoadRequest<'_> {
    /// Returns the service of type `T`, if the run provides it, such as the projection that all its data share.
    pub fn service<T: Any>(&mut self) -> Option<&mut T> {
        self.services.iter_mut().find_map(|service| service.downcast_mut())
    }

    /// The content of the file; `remedy` is told where it cannot be read.
    pub fn read(&self, remedy: &str) -> Result<Vec<u8>> {
        self.read_from(self.path, self.name, remedy)
    }

    /// The content of another file, which the first one names; it is a `what`.
    pub fn read_beside(&self, what: &'static str, name: &str, remedy: &str) -> Result<Vec<u8>> {
        self.read_from(&self.resources.find(what, name)?, name, remedy)
    }

    /// The content of a file, for which memory is taken.
    fn read_from(&self, path: &Path, name: &str, remedy: &str) -> Result<Vec<u8>> {
        let cannot = |why: &dyn std::fmt::Display| Error::file(path, format!("cannot read {name}: {why}"));
        let (_, meta) = burgeon_base::files::open(path).map_err(|error| cannot(&error).help(remedy))?;
        if meta.len() > LARGEST {
            return Err(cannot(&format!("it is larger than {} MB", LARGEST / 1_000_000)).help("simplify it"));
        }
        self.budget.check()?;
        self.budget.take(usize::try_from(meta.len()).unwrap_or(usize::MAX))?;
        burgeon_base::files::read(path, meta.len()).map_err(|error| cannot(&error).help(remedy))
    }
}
