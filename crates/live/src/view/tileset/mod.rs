//! Page of a tileset: a server of the files of its folder, and of the progress of the processes that make it.
//!
//! Input: a folder with `tileset.json`, and a function that reads the progress. Output: the page, the files of the folder
//! that belong to a tileset, and events when the tileset is joined again or the progress changes. The server never writes to
//! the folder, and pages send no commands.

mod folder;
mod live;
mod message;
mod send;
mod state;

pub use live::{LiveTileset, TilesetSettings};
pub use message::TilesetProgress;
pub(super) use send::send_file;
pub use state::ProgressReader;
pub(super) use state::TilesetState;
