//! The bytes of a data file: on a disk, or unpacked into memory.

use std::fs::File;
use std::io::{self, Cursor, Read, Seek};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};

/// A data file that has been opened.
pub(crate) struct DataFile {
    /// Its bytes.
    pub(crate) content: Content,
    /// Where it is; of a file that was unpacked, where it would be.
    pub(crate) path: PathBuf,
    /// Its name in messages.
    pub(crate) name: String,
}

/// Bytes that can be read from the front any number of times.
pub(crate) enum Content {
    /// Those of a file.
    File(File),
    /// Those that were unpacked, for which memory was taken.
    #[cfg_attr(not(feature = "data"), allow(dead_code, reason = "nothing is unpacked without the feature"))]
    Memory(Arc<[u8]>),
}

/// Bytes that are read from the front to the end.
pub(crate) type ContentReader = Box<dyn Read + Send>;

impl Content {
    /// A reader that begins at the front. There may be one at a time.
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

    /// How many bytes there are.
    pub(crate) fn size(&self) -> io::Result<u64> {
        match self {
            Self::File(file) => Ok(file.metadata()?.len()),
            Self::Memory(bytes) => Ok(bytes.len() as u64),
        }
    }

    /// The first bytes, at most `count`.
    pub(crate) fn head(&self, count: u64) -> io::Result<Vec<u8>> {
        let mut head = Vec::new();
        self.reader()?.take(count).read_to_end(&mut head)?;
        Ok(head)
    }
}

impl DataFile {
    /// The file at `path`, which messages call `name`.
    pub(crate) fn new(file: File, path: &Path, name: &str) -> Self {
        Self { content: Content::File(file), path: path.to_path_buf(), name: name.to_owned() }
    }

    /// All bytes, for which memory is taken, of a file of at most `most` bytes.
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
        // While they become shared bytes they are there twice.
        let _held = budget.hold(room)?;
        budget.take(room)?;
        let mut bytes = Vec::with_capacity(room);
        // It may grow while it is read.
        self.content.reader().and_then(|reader| reader.take(size).read_to_end(&mut bytes)).map_err(cannot)?;
        Ok(bytes.into())
    }

    /// Fails if it has more than `most` bytes.
    pub(crate) fn check_size(&self, size: u64, most: u64) -> Result<()> {
        if size <= most {
            return Ok(());
        }
        Err(Error::limit(Limit::Size, format!("{} is larger than {} MB", self.name, most / 1_000_000))
            .help("convert it to a FlatGeobuf or a GeoPackage, of which a part can be read"))
    }

    /// Its name without folders and extension.
    #[cfg(feature = "data")]
    pub(crate) fn stem(&self) -> String {
        self.path.file_stem().map_or_else(|| self.name.clone(), |stem| stem.to_string_lossy().into_owned())
    }

    /// Its extension in small letters.
    pub(crate) fn extension(&self) -> String {
        self.path.extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
    }

    /// The file on a disk; fails for one that was unpacked, since a `what` is read piece by piece.
    pub(crate) fn on_disk(self, what: &str) -> Result<(File, PathBuf, String)> {
        match self.content {
            Content::File(file) => Ok((file, self.path, self.name)),
            Content::Memory(_) => Err(Error::data(format!(
                "{} holds a {what}, which is not read while it is packed",
                self.name
            ))
            .help("unpack it, and name the file itself")),
        }
    }
}

/// A data file with layers that are read one by one.
pub trait LayeredFile: Send {
    /// The name of its format.
    fn format(&self) -> &'static str;

    /// The names of its layers.
    fn layers(&self) -> Vec<String>;

    /// Reads what is `wanted` of a layer, in the order of the file.
    fn read(&self, layer: &str, wanted: &crate::SourceOptions) -> Result<crate::FeatureTable>;
}
