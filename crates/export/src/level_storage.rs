//! Storage of levels of detail.

/// Storage of levels of detail in one file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LevelStorage {
    /// Nodes called `NAME_LOD0`, `NAME_LOD1` and so on, from the finest level, as game engines import them. A viewer without
    /// levels shows all of them at once.
    Names,
    /// The extension `MSFT_lod` at the node of the finest level. A viewer without it shows that level.
    Extension,
}
