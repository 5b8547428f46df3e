//! Loading of objects from files.

use std::any::{Any, TypeId};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::{Object, Table};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;

/// A loader that makes objects from files.
#[derive(Clone)]
pub struct Loader {
    /// Name of the files' content for messages: "file of heights".
    pub what: &'static str,
    /// Example of a call in a script.
    pub example: &'static str,
    /// Example of a call with fields.
    pub example_with_fields: &'static str,
    /// Extensions of the files that a folder stands for, if one object can be made from several files; otherwise empty.
    pub several: &'static [&'static str],
    /// Function that loads an object from a file. The table contains the additional fields from the script.
    pub load: fn(&mut LoadRequest<'_>, &Table) -> Result<LoadedObject>,
}

/// An object that was loaded from a file.
#[derive(Clone)]
pub struct LoadedObject {
    /// The object.
    pub object: Arc<dyn Object>,
    /// Approximate memory use (bytes).
    pub memory: usize,
    /// Warnings about the file.
    pub warnings: Vec<Warning>,
}

/// Request to load a file that a script names, with the resources for reading it.
pub struct LoadRequest<'a> {
    /// File name as written in the script.
    pub name: &'a str,
    /// Path of the file.
    pub path: &'a Path,
    /// Names and paths of all files that the script names. This file is the first.
    pub files: &'a [(String, PathBuf)],
    /// Memory and time budget for reading.
    pub budget: &'a Arc<Budget>,
    /// Maximum number of triangles.
    pub triangles: usize,
    /// Values of the run that some loaders need, found by their type with [`LoadRequest::service`].
    pub services: &'a mut dyn LoadServices,
    /// Files of the run.
    pub resources: &'a dyn Resources,
}

/// Values of a run that loaders share, such as the projection of its data.
pub trait LoadServices {
    /// Returns the value of a type, if the run has one.
    fn service(&mut self, of: TypeId) -> Option<&mut dyn Any>;
}

/// A run without shared values.
impl LoadServices for () {
    fn service(&mut self, _: TypeId) -> Option<&mut dyn Any> {
        None
    }
}

/// Resources of a run for loaders and sources.
pub trait Resources {
    /// Returns the path of the file that a script calls `name`; `what` describes the file in messages. Fails if the
    /// script may not read the file.
    fn find(&self, what: &'static str, name: &str) -> Result<PathBuf>;

    /// Records that the run depends on a path, and whether the path exists.
    fn seek(&self, path: &Path, exists: bool);

    /// Reports a warning.
    fn warn(&self, warning: Warning);

    /// Fails if the run is cancelled.
    fn check(&self) -> Result<()>;
}

/// Maximum size (bytes) of a file that is read at once.
const LARGEST: u64 = 1_000_000_000;

impl LoadRequest<'_> {
    /// Returns the service of type `T`, if the run provides it, such as the projection that all its data share.
    pub fn service<T: Any>(&mut self) -> Option<&mut T> {
        self.services.service(TypeId::of::<T>())?.downcast_mut()
    }

    /// Reads the file. `remedy` is the suggested fix if reading fails.
    pub fn read(&self, remedy: &str) -> Result<Vec<u8>> {
        self.read_from(self.path, self.name, remedy)
    }

    /// Reads another file, to which the first file refers; `what` describes it in messages.
    pub fn read_beside(&self, what: &'static str, name: &str, remedy: &str) -> Result<Vec<u8>> {
        self.read_from(&self.resources.find(what, name)?, name, remedy)
    }

    /// Reads a file, and takes its size from the memory budget.
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
