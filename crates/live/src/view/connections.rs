//! Accepts connections, and prevents each from blocking others.
//!
//! Any program on this machine can connect. Until a connection has sent a request with the token, it is unproven. The
//! time and the number of unproven connections are limited, and the oldest is closed first, so they can neither
//! overload the server nor exhaust its file handles.

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

use super::LiveEvent;
use super::server::{Site, answer};
use burgeon_base::locks::LockRecovery;

/// Time limit for the head of a request, and for an idle connection after it.
const HEAD: Duration = Duration::from_secs(5);

/// Maximum number of unproven connections; fewer if the system allows few files.
const UNPROVEN: usize = 64;

/// Pause after the system has refused a connection.
const PAUSE: Duration = Duration::from_millis(20);

/// Connections that have not sent a request with the token yet, in the order of their arrival.
#[derive(Default)]
pub(super) struct UnprovenConnections(Mutex<VecDeque<Arc<Notify>>>);

impl UnprovenConnections {
    /// Adds a connection, and closes the oldest ones if there are more than `most`.
    fn admit(&self, most: usize) -> Arc<Notify> {
        let away = Arc::new(Notify::new());
        let mut all = self.0.lock().recover();
        all.push_back(Arc::clone(&away));
        while all.len() > most {
            all.pop_front().iter().for_each(|oldest| oldest.notify_one());
        }
        away
    }

    /// Removes a connection that has been proven or closed.
    fn remove(&self, away: &Arc<Notify>) {
        self.0.lock().recover().retain(|it| !Arc::ptr_eq(it, away));
    }

    fn close_all(&self) {
        self.0.lock().recover().drain(..).for_each(|it| it.notify_one());
    }
}

/// Answers requests until the future is dropped.
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
            // The client closed the connection before it was accepted.
            Err(error)
                if matches!(
                    error.kind(),
                    ErrorKind::ConnectionAborted | ErrorKind::ConnectionReset | ErrorKind::Interrupted
                ) => {}
            // Too many open files are the most likely cause.
            Err(error) => {
                if !std::mem::replace(&mut notices, true) {
                    site.tell(&LiveEvent::Text(format!("a connection has to wait: {error}")));
                }
                unproven.close_all();
                tokio::time::sleep(PAUSE).await;
            }
        }
    }
}

/// Answers the requests of one connection.
async fn handle(stream: TcpStream, site: Arc<Site>, unproven: Arc<UnprovenConnections>, away: Arc<Notify>) {
    // Messages are small and must not wait for the next one. If setting the option fails, the connection is only
    // slower.
    let _ = stream.set_nodelay(true);
    let site = &site;
    let service = service_fn(|request: hyper::Request<hyper::body::Incoming>| {
        let known = || unproven.remove(&away);
        async move { Ok::<_, Infallible>(answer(site, request.map(Body::new), known).await) }
    });
    let connection = http1::Builder::new()
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD)
        .serve_connection(TokioIo::new(stream), service)
        .with_upgrades();
    tokio::select! {
        // An error is ignored, because the client is no longer reachable.
        _ = connection => {}
        () = away.notified() => {}
    }
    unproven.remove(&away);
}

/// Returns the number of files that the system allows this program to open, if known.
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
