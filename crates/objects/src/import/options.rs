//! The inputs of an import in addition to the file, and the error for a damaged file.

use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};

/// Maximum memory (bytes) of a JSON object of the description, and of an instance.
pub(super) const OBJECT: usize = 500;

/// The inputs of an import in addition to the file.
pub(super) struct ImportOptions<'a> {
    /// Name of the file in messages.
    pub name: &'a str,
    /// Maximum number of triangles, with repeated meshes counted for each instance.
    pub triangles: usize,
    /// Budget for reading.
    pub budget: &'a Budget,
    /// Function that reads an external file, by its URI in the file.
    pub beside: &'a mut dyn FnMut(&str) -> Result<Vec<u8>>,
}

/// Creates the error for a damaged file.
pub(super) fn broken_file(name: &str, why: impl std::fmt::Display) -> Error {
    Error::data(format!("the model {name} cannot be read: {why}"))
        .help("export it again as glTF 2.0 (.glb), and check that the copy is complete")
}
