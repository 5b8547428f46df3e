//! The server of the live view: start, addresses and notices.

use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::Instant;

use tokio::runtime::Runtime;
use tokio::sync::Semaphore;

use super::message::Cause;
use super::server::Site;
use super::settings::{LiveEvent, PORT, Settings};
use super::state::{DueRun, ServerState};
use super::token::{Keep, Token};
use super::{changes, connections, tools, work};
use crate::watch::Watch;
use burgeon_base::error::{Error, Result};
use burgeon_base::named_thread;

/// Number of ports to try after an occupied one.
const TRIES: u16 = 100;

/// Live view server. It runs until it is dropped.
pub struct Live {
    state: Arc<ServerState>,
    port: u16,
    token: Token,
    keep: Option<Keep>,
    runtime: Option<Runtime>,
    threads: Vec<JoinHandle<()>>,
}

impl Live {
    /// Starts a server. Fails if the port, or every port that was tried, is occupied.
    pub fn start(mut settings: Settings) -> Result<Self> {
        let listener = listen(settings.port)?;
        let failed = |error: std::io::Error| Error::system(format!("cannot start the server: {error}"));
        listener.set_nonblocking(true).map_err(failed)?;
        let port = listener.local_addr().map_err(failed)?.port();
        let lasting = settings.token.is_none() && settings.port != Some(0);
        let keep = if lasting { Keep::of(port) } else { None };
        let token = match (settings.token.take(), &keep) {
            (Some(token), _) => token,
            (None, Some(keep)) => keep.token()?,
            (None, None) => Token::random()?,
        };
        let presets = tools::presets(&settings.script);
        let state = Arc::new(ServerState::new(settings, presets));
        let (seen, complained) = (Arc::clone(&state), Arc::clone(&state));
        let watch = Watch::new(
            work::constant_inputs(&state),
            move |change| changes::handle_changes(&seen, &change),
            move |why| complained.tell(&LiveEvent::Text(why.to_owned())),
        )?;
        state.lock().post(DueRun { cause: Cause::Start, files: Vec::new(), at: Instant::now() });
        let thread = |name: &str, work: Box<dyn FnOnce(&ServerState) + Send>| {
            let state = Arc::clone(&state);
            named_thread(name).spawn(move || work(&state)).map_err(failed)
        };
        let threads = vec![
            thread("worker", Box::new(move |state| work::work(state, &watch)))?,
            thread("progress", Box::new(work::report))?,
        ];
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .max_blocking_threads(8)
            .thread_name("burgeon server")
            .enable_all()
            .build()
            .map_err(failed)?;
        let listener = {
            let _inside = runtime.enter();
            tokio::net::TcpListener::from_std(listener).map_err(failed)?
        };
        let site =
            Site { state: Arc::clone(&state), token: token.clone(), exports: Arc::new(Semaphore::new(1)) };
        runtime.spawn(connections::serve(listener, Arc::new(site)));
        Ok(Self { state, port, token, keep, runtime: Some(runtime), threads })
    }

    /// Returns the port on which the server listens.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// Returns the secret part of the address.
    pub fn token(&self) -> &Token {
        &self.token
    }

    /// Returns the address of the page.
    pub fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token.as_str())
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        self.state.end();
        self.keep.iter().for_each(|keep| keep.renew(&self.token));
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
        for thread in self.threads.drain(..) {
            // A thread that panicked needs no further cleanup.
            let _ = thread.join();
        }
    }
}

/// Listens on `port` of this machine only, or on the first free port from [`PORT`] on.
fn listen(port: Option<u16>) -> Result<TcpListener> {
    let bind = |port: u16| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    let first = port.unwrap_or(PORT);
    let error = match bind(first) {
        Ok(listener) => return Ok(listener),
        Err(error) => error,
    };
    if error.kind() != ErrorKind::AddrInUse {
        return Err(Error::system(format!("cannot listen on port {first}: {error}"))
            .help("choose another one: --port N, or 0 for a free port"));
    }
    let next = (first.saturating_add(1)..=first.saturating_add(TRIES)).find_map(|port| bind(port).ok());
    match (port, next) {
        (None, Some(listener)) => Ok(listener),
        (_, next) => {
            let free =
                next.and_then(|listener| listener.local_addr().ok()).map_or(0, |address| address.port());
            Err(Error::system(format!("port {first} is in use"))
                .help(format!("another server may be running; use another port: --port {free}")))
        }
    }
}
