//! The live page: a server on this machine that shows what a script makes, and shows it anew on every save.
//!
//! Comes in: a script, and what its pages ask for ([`message`]). Goes out: the page, the present model as glTF, and
//! news over a socket. It never answers anybody but this machine's user (`address`, `token`), never writes to the script's
//! folder but presets, and never lets a page wait for a run.
//!
//! ```text
//! files ──► watch ──► state ──► work ──► state ──► server, socket ──► pages
//!                       ▲ (request)  (model)              │
//!                       └────────── commands ◄────────────┘
//! ```
//!
//! One thread runs the script (`work`) as it was last requested (`request`); all pages share that request and the model
//! (`state`). A newer request stops the run of an older one, unless that is almost done.

mod address;
mod commands;
mod connections;
mod describe;
mod export;
mod layout;
pub mod message;
mod open;
mod page;
mod request;
mod server;
mod socket;
mod state;
mod token;
mod tools;
mod trace;
mod work;

pub use open::{Editor, browse, has_display};
pub use token::Token;

use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener};
use std::path::PathBuf;
use std::sync::Arc;
use std::thread::JoinHandle;
use std::time::{Duration, Instant};

use tokio::runtime::Runtime;
use tokio::sync::Semaphore;

use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_engine::script::RunOptions;
use burgeon_watch::Watch;
use message::Cause;
use server::Site;
use state::{DueRun, ServerState};
use token::Keep;

/// The port that is taken if it is free and none was named.
pub const PORT: u16 = 4747;

/// How many ports after a taken one are tried.
const TRIES: u16 = 100;

/// What is to be served.
pub struct Settings {
    /// The script; it need not exist yet.
    pub script: PathBuf,
    /// How it is run at first. Pages change the parameters, the seed and the limit of steps.
    pub options: RunOptions,
    /// The port; [`PORT`] or one of the next if `None`.
    pub port: Option<u16>,
    /// The secret part of the address. The one that is kept for the port if `None`, so that a page that is open finds the
    /// next server there; a new one if the port may be any that is free.
    pub token: Option<Token>,
    /// What opens lines of the script.
    pub editor: Option<Editor>,
    /// Is told what happens, from several threads.
    pub tell: Box<dyn Fn(&Notice) + Send + Sync>,
}

/// What the place is told where the server was started.
#[derive(Debug, Clone)]
pub enum Notice {
    /// There is a new model.
    Model {
        /// Triangles that are seen.
        triangles: usize,
        /// Modules of all systems.
        modules: usize,
        /// From the cause to the model's bytes.
        total: Duration,
    },
    /// The script has failed.
    Failed(Error),
    /// The new model has a warning that the last one did not have.
    Warning(Warning),
    /// The script does not exist.
    Waiting(String),
    /// Something else worth knowing.
    Note(String),
}

/// A server that runs until it is dropped.
pub struct Live {
    state: Arc<ServerState>,
    port: u16,
    token: Token,
    keep: Option<Keep>,
    runtime: Option<Runtime>,
    threads: Vec<JoinHandle<()>>,
}

impl Live {
    /// Starts a server. Fails if the port, or every port that was tried, is taken.
    pub fn start(settings: Settings) -> Result<Self> {
        let listener = listen(settings.port)?;
        let failed = |error: std::io::Error| Error::system(format!("cannot start the server: {error}"));
        listener.set_nonblocking(true).map_err(failed)?;
        let port = listener.local_addr().map_err(failed)?.port();
        let lasting = settings.token.is_none() && settings.port != Some(0);
        let keep = if lasting { Keep::of(port) } else { None };
        let token = match (&settings.token, &keep) {
            (Some(token), _) => token.clone(),
            (None, Some(keep)) => keep.token()?,
            (None, None) => Token::random()?,
        };
        let state = Arc::new(ServerState::new(settings));
        let (seen, complained) = (Arc::clone(&state), Arc::clone(&state));
        let watch = Watch::new(
            work::always(&state),
            move |change| seen.changed(&change),
            move |why| complained.tell(&Notice::Note(why.to_owned())),
        )?;
        state.lock().post(DueRun { cause: Cause::Start, files: Vec::new(), at: Instant::now() });
        let thread = |name: &str, work: Box<dyn FnOnce(&ServerState) + Send>| {
            let state = Arc::clone(&state);
            let builder = std::thread::Builder::new().name(format!("burgeon {name}"));
            builder.spawn(move || work(&state)).map_err(failed)
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

    /// The port that it listens on.
    pub fn port(&self) -> u16 {
        self.port
    }

    /// The secret part of the address.
    pub fn token(&self) -> &Token {
        &self.token
    }

    /// Where a browser finds the page.
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
            // One that panicked has nothing left to end.
            let _ = thread.join();
        }
    }
}

/// Listens on `port` of this machine alone, or on the first free one from [`PORT`] on.
fn listen(port: Option<u16>) -> Result<TcpListener> {
    let bind = |port: u16| TcpListener::bind((Ipv4Addr::LOCALHOST, port));
    let first = port.unwrap_or(PORT);
    let error = match bind(first) {
        Ok(listener) => return Ok(listener),
        Err(error) => error,
    };
    if error.kind() != ErrorKind::AddrInUse {
        return Err(Error::system(format!("cannot listen on port {first}: {error}"))
            .help("choose another one: --port N, or 0 for any that is free"));
    }
    let next = (first.saturating_add(1)..=first.saturating_add(TRIES)).find_map(|port| bind(port).ok());
    match (port, next) {
        (None, Some(listener)) => Ok(listener),
        (_, next) => {
            let free =
                next.and_then(|listener| listener.local_addr().ok()).map_or(0, |address| address.port());
            Err(Error::system(format!("port {first} is in use"))
                .help(format!("another server may be running; to use another port: --port {free}")))
        }
    }
}
