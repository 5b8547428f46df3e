//! The server of the live view of a script.

use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use tokio::sync::Semaphore;

use super::endpoint::{Endpoint, RunningServer, start_error};
use super::message::Cause;
use super::server::{ScriptSite, Site, SiteContent};
use super::settings::{LiveEvent, Settings};
use super::state::{DueRun, ServerState};
use super::token::Token;
use super::{changes, tools, work};
use crate::watch::Watch;
use burgeon_base::error::Result;
use burgeon_base::named_thread;

/// Live view server. It runs until it is dropped.
pub struct Live {
    state: Arc<ServerState>,
    server: RunningServer,
    threads: Vec<JoinHandle<()>>,
}

impl Live {
    /// Starts a server. Fails if the port, or every port that was tried, is occupied.
    pub fn start(mut settings: Settings) -> Result<Self> {
        let endpoint = Endpoint::open(settings.port, settings.token.take())?;
        let presets = tools::presets(&settings.script);
        let state = Arc::new(ServerState::new(settings, presets));
        let (seen, complained) = (Arc::clone(&state), Arc::clone(&state));
        let watch = Watch::new(
            work::constant_inputs(&state),
            move |change| changes::handle_changes(&seen, &change),
            move |why| complained.tell(&LiveEvent::Text(why)),
        )?;
        state.lock().post(DueRun { cause: Cause::Start, files: Vec::new(), at: Instant::now() });
        let thread = |name: &str, work: Box<dyn FnOnce(&ServerState) + Send>| {
            let state = Arc::clone(&state);
            named_thread(name).spawn(move || work(&state)).map_err(start_error)
        };
        let threads = vec![
            thread("worker", Box::new(move |state| work::work(state, &watch)))?,
            thread("progress", Box::new(work::report))?,
        ];
        let content = ScriptSite { state: Arc::clone(&state), exports: Arc::new(Semaphore::new(1)) };
        let server = endpoint.serve(|token| Site { token, content: SiteContent::Script(content) })?;
        Ok(Self { state, server, threads })
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

impl Drop for Live {
    fn drop(&mut self) {
        self.state.end();
        self.server.end();
        for thread in self.threads.drain(..) {
            // A thread that panicked needs no further cleanup.
            let _ = thread.join();
        }
    }
}
