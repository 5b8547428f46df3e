//! Ways to look at a script beside a single run: the live view, presets, variations and films.
//!
//! Input: a script, its files of presets and of drawn curves, and commands of pages. Output: a page that shows the present
//! model, the presets, and thumbnails of many runs; the frames of a film; or changes of the script's files. Another page shows
//! the tileset in a folder. The server, which needs the feature `server`, answers only this machine's user, writes only presets
//! and drawn curves to the script's folder, and never lets a page wait for a run.

pub mod curves;
pub mod films;
mod json_file;
pub mod presets;
#[cfg(test)]
mod presets_tests;
pub mod variations;
#[cfg(feature = "server")]
mod view;
pub mod watch;

#[cfg(feature = "server")]
pub use view::*;
