//! Bytes of a data file, on disk or unpacked in memory.

use std::borrow::Cow;
use std::ffi::OsStr;
use std::fs::File;
use std::io::{self, Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};

/// Open data file.
pub(crate) struct DataFile {
    /// Bytes of the file.
    pub(crate) content: Content,
    /// Path of the file; for an unpacked file, the path that it would have.
    pub(crate) path: PathBuf,
    /// Name in messages.
    pub(crate) name: String,
}

/// Bytes that can be read from the beginning any number of times.
pub(crate) enum Content {
    /// File on disk.
    File(File),
    /// Unpacked bytes, counted in the memory budget.
    #[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nothing is unpacked without the feature"))]
    Memory(Arc<[u8]>),
}

/// Reader from the beginning to the end.
pub(crate) type ContentReader = Box<dyn Read + Send>;

impl Content {
    /// Returns a reader that starts at the beginning. Only one reader may exist at a time.
    pub(crate) fn reader(&self) -> io::Result<ContentReader> {
        Ok(match self {
            Self::File(file) => {
                let mut file = file.try_clone()?;
                file.rewind()?;
                Box::new(file)
            }
            Self::Memory(bytes) => Box::new(Cursor::new(Arc::clone(bytes))),
        })
    }

    /// Returns the number of bytes.
    pub(crate) fn size(&self) -> io::Result<u64> {
        match self {
            Self::File(file) => Ok(file.metadata()?.len()),
            Self::Memory(bytes) => Ok(bytes.len() as u64),
        }
    }

    /// Returns the first bytes, at most `count`.
    pub(crate) fn head(&self, count: u64) -> io::Result<Vec<u8>> {
        let mut head = Vec::new();
        self.reader()?.take(count).read_to_end(&mut head)?;
        Ok(head)
    }
}

/// Returns the file name in `path` without folders and extension, or `name` if it has none.
pub(crate) fn stem<'a>(path: &'a Path, name: &'a str) -> Cow<'a, str> {
    path.file_stem().map_or(Cow::Borrowed(name), OsStr::to_string_lossy)
}

impl DataFile {
    /// Creates a data file from the open file at `path`, called `name` in messages.
    pub(crate) fn new(file: File, path: &Path, name: &str) -> Self {
        Self { content: Content::File(file), path: path.to_path_buf(), name: name.to_owned() }
    }

    /// Returns all bytes, counted in the memory budget; fails if there are more than `most`.
    pub(crate) fn bytes(&self, most: u64, budget: &Budget) -> Result<Arc<[u8]>> {
        let cannot =
            |error: io::Error| Error::file(&self.path, format!("cannot read {}: {error}", self.name));
        if let Content::Memory(bytes) = &self.content {
            return Ok(Arc::clone(bytes));
        }
        let size = self.content.size().map_err(cannot)?;
        self.check_size(size, most)?;
        budget.check()?;
        let room = usize::try_from(size).unwrap_or(usize::MAX);
        // During the conversion to shared bytes, the data exists twice.
        let _held = budget.hold(room)?;
        budget.take(room)?;
        let mut bytes = Vec::with_capacity(room);
        // The file may grow while it is read.
        self.content.reader().and_then(|reader| reader.take(size).read_to_end(&mut bytes)).map_err(cannot)?;
        Ok(bytes.into())
    }

    /// Fails if `size` exceeds `most` bytes.
    pub(crate) fn check_size(&self, size: u64, most: u64) -> Result<()> {
        if size <= most {
            return Ok(());
        }
        Err(Error::limit(Limit::Size, format!("{} is larger than {} MB", self.name, most / 1_000_000))
            .help("convert it to a FlatGeobuf or a GeoPackage, which can be read in parts"))
    }

    /// Returns the file name without folders and extension.
    #[cfg(feature = "data")]
    pub(crate) fn stem(&self) -> Cow<'_, str> {
        stem(&self.path, &self.name)
    }

    /// Returns the extension in lower case.
    pub(crate) fn extension(&self) -> String {
        self.path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
    }

    /// Returns the file on disk; fails for an unpacked file, because a `what` is read in parts.
    pub(crate) fn on_disk(self, what: &str) -> Result<(File, PathBuf, String)> {
        match self.content {
            Content::File(file) => Ok((file, self.path, self.name)),
            Content::Memory(_) => Err(Error::data(format!(
                "{} contains a {what}, which is not supported in an archive",
                self.name
            ))
            .help("unpack it, and specify the file itself")),
        }
    }
}
