//! Start of a server: its port, its token and its threads.

use std::io::ErrorKind;
use std::net::{Ipv4Addr, TcpListener};
use std::sync::Arc;

use tokio::runtime::Runtime;

use super::connections;
use super::server::Site;
use super::settings::PORT;
use super::token::{Keep, Token};
use burgeon_base::error::{Error, Result};

/// Number of ports to try after an occupied one.
const TRIES: u16 = 100;

/// Port of a server and its token, before it answers requests.
pub(super) struct Endpoint {
    listener: TcpListener,
    port: u16,
    token: Token,
    keep: Option<Keep>,
}

/// Server that answers requests until it is dropped.
pub(super) struct RunningServer {
    pub(super) port: u16,
    pub(super) token: Token,
    keep: Option<Keep>,
    runtime: Option<Runtime>,
}

impl Endpoint {
    /// Occupies a port. Without a `token` it has the one stored for the port, or a new one if the port may be any free one.
    ///
    /// Fails if the port, or every port that was tried, is occupied.
    pub(super) fn open(port: Option<u16>, token: Option<Token>) -> Result<Self> {
        let listener = listen(port)?;
        listener.set_nonblocking(true).map_err(start_error)?;
        let actual = listener.local_addr().map_err(start_error)?.port();
        let lasting = token.is_none() && port != Some(0);
        let keep = if lasting { Keep::of(actual) } else { None };
        let token = match (token, &keep) {
            (Some(token), _) => token,
            (None, Some(keep)) => keep.token()?,
            (None, None) => Token::random()?,
        };
        Ok(Self { listener, port: actual, token, keep })
    }

    /// Answers requests with the content of the site that `site` makes for the token.
    pub(super) fn serve(self, site: impl FnOnce(Token) -> Site) -> Result<RunningServer> {
        let runtime = tokio::runtime::Builder::new_multi_thread()
            .worker_threads(2)
            .max_blocking_threads(8)
            .thread_name("burgeon server")
            .enable_all()
            .build()
            .map_err(start_error)?;
        let listener = {
            let _inside = runtime.enter();
            tokio::net::TcpListener::from_std(self.listener).map_err(start_error)?
        };
        runtime.spawn(connections::serve(listener, Arc::new(site(self.token.clone()))));
        Ok(RunningServer { port: self.port, token: self.token, keep: self.keep, runtime: Some(runtime) })
    }
}

impl RunningServer {
    /// Returns the address of the page.
    pub(super) fn address(&self) -> String {
        format!("http://127.0.0.1:{}/{}/", self.port, self.token.as_str())
    }

    /// Ends the server, and extends the storage time of its token.
    pub(super) fn end(&mut self) {
        self.keep.iter().for_each(|keep| keep.renew(&self.token));
        if let Some(runtime) = self.runtime.take() {
            runtime.shutdown_background();
        }
    }
}

/// Returns the error of a server that cannot start.
pub(super) fn start_error(error: std::io::Error) -> Error {
    Error::system(format!("cannot start the server: {error}"))
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
