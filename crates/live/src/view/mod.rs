//! Live view: a local server that shows a script's model in the browser and updates it on every save.
//!
//! Input: a script, and commands of its pages ([`message`]). Output: the page, the present model as glTF, and events
//! over a socket. The server answers only this machine's user (`address`, `token`), writes only presets, drawn
//! curves and saved files of the script (`source`), and never lets a page wait for a run.
//!
//! ```text
//! files ──► watch ──► state ──► work ──► state ──► server, socket ──► pages
//!                       ▲ (request)  (model)              │
//!                       └────────── commands ◄────────────┘
//! ```
//!
//! One thread runs the script (`work`) with the latest request (`request`); all pages share that request and the model
//! (`state`). A newer request cancels the run of an older one, unless the run is almost done.
//!
//! A folder with a tileset is served by [`LiveTileset`], without a script and without commands (`tileset`).

mod address;
mod cameras;
mod changes;
mod commands;
mod connections;
mod console;
mod curves;
mod describe;
mod endpoint;
mod export;
mod job;
mod layout;
mod live;
pub mod message;
mod open;
mod page;
mod parts;
mod request;
mod server;
mod settings;
mod socket;
mod source;
mod state;
mod tileset;
mod token;
mod tools;
mod trace;
mod urls;
mod work;

pub use live::Live;
pub use open::{Editor, browse, has_display};
pub use settings::{EventReceiver, LiveEvent, PORT, Settings};
pub use tileset::{LiveTileset, ProgressReader, TilesetProgress, TilesetSettings};
pub use token::Token;
