//! Connections: accepts them, and lets none keep others waiting.
//!
//! Any program of this machine can connect. Until a connection has sent a request with the token it is unproven: such
//! connections have a short while for it, they are few, and the oldest is closed first. So they can neither fill the server
//! nor use up its file handles.

use std::collections::VecDeque;
use std::convert::Infallible;
use std::io::ErrorKind;
use std::sync::{Arc, Mutex};
use std::time::Duration;

use axum::body::Body;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Notify;

use super::Notice;
use super::server::{Site, answer};
use burgeon_base::locks::LockRecovery;

/// How long the head of a request may take, and a connection be silent after one.
const HEAD: Duration = Duration::from_secs(5);

/// The most unproven connections at a time; fewer where the system allows few files.
const UNPROVEN: usize = 64;

/// How long to wait after the system had no room for a connection.
const PAUSE: Duration = Duration::from_millis(20);

/// Those who have not sent a request with the token yet, in the order in which they came.
#[derive(Default)]
pub(super) struct UnprovenConnections(Mutex<VecDeque<Arc<Notify>>>);

impl UnprovenConnections {
    /// Takes a new one in, and sends those away that are too many.
    fn admit(&self, most: usize) -> Arc<Notify> {
        let away = Arc::new(Notify::new());
        let mut all = self.0.lock().recover();
        all.push_back(Arc::clone(&away));
        while all.len() > most {
            all.pop_front().iter().for_each(|oldest| oldest.notify_one());
        }
        away
    }

    /// One that is none any more, or has gone.
    fn remove(&self, away: &Arc<Notify>) {
        self.0.lock().recover().retain(|it| !Arc::ptr_eq(it, away));
    }

    fn close_all(&self) {
        self.0.lock().recover().drain(..).for_each(|it| it.notify_one());
    }
}

/// Answers requests until it is dropped.
pub(super) async fn serve(listener: TcpListener, site: Arc<Site>) {
    let unproven = Arc::new(UnprovenConnections::default());
    let most = UNPROVEN.min(files_allowed().unwrap_or(usize::MAX) / 8).max(2);
    let mut notices = false;
    loop {
        match listener.accept().await {
            Ok((stream, _)) => {
                let away = unproven.admit(most);
                tokio::spawn(handle(stream, Arc::clone(&site), Arc::clone(&unproven), away));
            }
            // It went before it was taken.
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset | ErrorKind::Interrupted
                ) => {}
            // Most likely there are too many open files.
            Err(error) => {
                if !std::mem::replace(&mut notices, true) {
                    site.state.tell(&Notice::Note(format!("a connection has to wait: {error}")));
                }
                unproven.close_all();
                tokio::time::sleep(PAUSE).await;
            }
        }
    }
}

/// Answers the requests of one connection.
async fn handle(stream: TcpStream, site: Arc<Site>, unproven: Arc<UnprovenConnections>, away: Arc<Notify>) {
    // Messages are small, and none is to wait for the next. A connection that refuses is only slower.
    let _ = stream.set_nodelay(true);
    let service = service_fn(|request: hyper::Request<hyper::body::Incoming>| {
        let (site, known) = (Arc::clone(&site), || unproven.remove(&away));
        async move { Ok::<_, Infallible>(answer(&site, request.map(Body::new), known).await) }
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    tokio::select! {
        // Whatever ended it, there is nobody to tell.
        _ = connection => {}
        () = away.notified() => {}
    }
    unproven.remove(&away);
}

/// How many files the system lets this program open, where that is known.
fn files_allowed() -> Option<usize> {
    let limits = std::fs::read_to_string("/proc/self/limits").ok()?;
    let line = limits.lines().find_map(|line| line.strip_prefix("Max open files"))?;
    line.split_whitespace().next()?.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_unproven_that_have_been_here_longest_go_first_and_those_that_are_known_stay() {
        let unproven = UnprovenConnections::default();
        let all: Vec<_> = (0..5).map(|_| unproven.admit(3)).collect();
        let known = unproven.admit(3);
        unproven.remove(&known);
        let later: Vec<_> = (0..3).map(|_| unproven.admit(3)).collect();
        let gone = |it: &Arc<Notify>| {
            let runtime = tokio::runtime::Builder::new_current_thread().enable_time().build().unwrap();
            let wait = async { tokio::time::timeout(Duration::ZERO, it.notified()).await.is_ok() };
            runtime.block_on(wait)
        };
        assert!(all.iter().all(gone));
        assert!(!gone(&known) && !later.iter().any(gone));
    }
}
