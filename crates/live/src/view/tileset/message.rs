//! Messages to the page of a tileset.

use serde::Serialize;

/// Message from the server.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "type", rename_all = "lowercase")]
pub(super) enum TilesetEvent {
    /// First message on every connection; the present state follows.
    Hello {
        /// Version of Burgeon.
        version: &'static str,
        /// Name of the folder.
        tileset: String,
        /// Path of the folder as named on the command line.
        path: String,
    },
    /// Present tileset, after it was joined.
    Tileset {
        /// Text that differs between joins.
        revision: String,
    },
    /// Present progress of the processes that make the tiles.
    Making(TilesetProgress),
    /// Error of the progress, such as an invalid plan.
    Unknown {
        /// Reason and remedy.
        text: String,
    },
}

/// Progress of the processes that make the tiles of a tileset.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct TilesetProgress {
    /// Number of tiles that were made.
    pub done: usize,
    /// Number of tiles that failed.
    pub failed: usize,
    /// Number of tiles to be made.
    pub open: usize,
    /// Part of the expected cost that is done, from 0 to 1.
    pub part: f64,
    /// Tiles a minute, if known.
    pub rate: Option<f64>,
}

impl TilesetEvent {
    /// Serialises the message.
    pub(super) fn to_text(&self) -> String {
        // Keys are strings and numbers are finite or null, so serialisation cannot fail.
        serde_json::to_string(self).unwrap_or_default()
    }
}
