//! The server of the page of a tileset.

use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;

use super::folder::ServedFolder;
use super::state::{ProgressReader, TilesetState};
use crate::view::LiveEvent;
use crate::view::endpoint::{Endpoint, RunningServer, start_error};
use crate::view::server::{Site, SiteContent};
use crate::view::settings::EventReceiver;
use crate::view::token::Token;
use crate::watch::Watch;
use burgeon_base::error::Result;
use burgeon_base::named_thread;

/// Settings of a server of a tileset.
pub struct TilesetSettings {
    /// Folder of the tileset.
    pub folder: PathBuf,
    /// Port; if `None`, [`PORT`](crate::PORT) or one of the next ports.
    pub port: Option<u16>,
    /// Secret part of the address. If `None`, the token stored for the port is used; if the port may be any free one, a new
    /// token.
    pub token: Option<Token>,
    /// Reader of the progress of the processes that make the tiles; it returns `None` if the folder has no plan. It is called
    /// from a thread of the server.
    pub progress: ProgressReader,
    /// Receiver of events. It is called from several threads.
    pub tell: EventReceiver,
}

/// Server of the page of a tileset. It runs until it is dropped.
///
/// ```
/// use burgeon_live::{LiveTileset, TilesetSettings};
///
/// let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("tileset.json"), "{}")?;
/// let live = LiveTileset::start(TilesetSettings {
///     folder: folder.path().to_owned(),
///     port: Some(0),
///     token: None,
///     progress: Box::new(|| Ok(None)),
///     tell: Box::new(|_| {}),
/// })?;
/// assert!(live.address().ends_with(&format!(":{}/{}/", live.port(), live.token().as_str())));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct LiveTileset {
    state: Arc<TilesetState>,
    server: RunningServer,
    /// Watch, which ends before the thread that it wakes.
    watch: Option<Watch>,
    thread: Option<JoinHandle<()>>,
}

impl LiveTileset {
    /// Starts a server. Fails if the folder has no tileset, or if the port, or every port that was tried, is occupied.
    pub fn start(settings: TilesetSettings) -> Result<Self> {
        let folder = ServedFolder::open(&settings.folder)?;
        let endpoint = Endpoint::open(settings.port, settings.token)?;
        let watched = folder.watched();
        let state = Arc::new(TilesetState::new(folder, settings.progress, settings.tell));
        let (seen, complained, observer) = (Arc::clone(&state), Arc::clone(&state), Arc::clone(&state));
        let watch =
            Watch::new(watched, move |_| seen.hurry(), move |why| complained.tell(&LiveEvent::Text(why)))?;
        let content = SiteContent::Tileset(Arc::clone(&state));
        let server = endpoint.serve(|token| Site { token, content })?;
        let thread = named_thread("tileset").spawn(move || observer.work()).map_err(start_error)?;
        Ok(Self { state, server, watch: Some(watch), thread: Some(thread) })
    }

    /// Returns the port on which the server listens.
    pub fn port(&self) -> u16 {
        self.server.port
    }

    /// Returns the secret part of the address.
    pub fn token(&self) -> &Token {
        &self.server.token
    }

    /// Returns the address of the page.
    pub fn address(&self) -> String {
        self.server.address()
    }
}

impl Drop for LiveTileset {
    fn drop(&mut self) {
        self.watch = None;
        self.state.end();
        self.server.end();
        if let Some(thread) = self.thread.take() {
            // A thread that panicked needs no further cleanup.
            let _ = thread.join();
        }
    }
}
