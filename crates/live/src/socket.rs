//! A page's socket: what the server says to all pages, and answers to this one.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::ws::{Message, Utf8Bytes, WebSocket, WebSocketUpgrade};
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::mpsc::{Sender, channel};
use tokio::time::timeout;

use super::message::Event;
use super::state::ServerState;
use burgeon_base::error::Error;

/// The largest message (bytes) that a page may send.
const LARGEST: usize = 64 << 10;

/// How long a page may take to receive a message before it is given up.
const PATIENCE: Duration = Duration::from_secs(30);

/// Answers that wait for a page at most.
const ANSWERS: usize = 16;

/// How often a page is asked whether it is still there.
const HEARTBEAT: Duration = Duration::from_secs(30);

/// How long a page may say nothing, not even that it is still there, before it is given up.
const SILENCE: Duration = Duration::from_secs(100);

/// A socket that takes no large messages.
pub(super) fn limited(upgrade: WebSocketUpgrade) -> WebSocketUpgrade {
    upgrade.max_message_size(LARGEST).max_frame_size(LARGEST)
}

/// Talks to a page until one side ends it.
pub(super) async fn talk(mut socket: WebSocket, state: Arc<ServerState>) {
    let Some(mut said) = greet(&mut socket, &state).await else { return };
    let (later, mut answers) = channel(ANSWERS);
    let mut heartbeat = tokio::time::interval(HEARTBEAT);
    let mut heard = Instant::now();
    loop {
        let going = tokio::select! {
            message = said.recv() => match message {
                Ok(text) => send(&mut socket, text).await,
                // It was slower than its queue is long. The present state says all that still matters.
                Err(RecvError::Lagged(_)) => match greet(&mut socket, &state).await {
                    Some(fresh) => { said = fresh; true }
                    None => false,
                },
                Err(RecvError::Closed) => false,
            },
            Some(text) = answers.recv() => send(&mut socket, text).await,
            message = socket.recv() => { heard = Instant::now(); match message {
                Some(Ok(Message::Text(text))) => answer(&mut socket, &state, &later, text).await,
                Some(Ok(Message::Binary(_))) => {
                    let refused = Event::refused(None, &Error::argument("a message is text"));
                    send(&mut socket, refused.to_text().into()).await
                }
                Some(Ok(Message::Ping(_) | Message::Pong(_))) => true,
                Some(Ok(Message::Close(_)) | Err(_)) | None => false,
            } },
            _ = heartbeat.tick() => {
                heard.elapsed() < SILENCE
                    && deliver(&mut socket, Message::Ping(axum::body::Bytes::new())).await
            }
        };
        if !going {
            return;
        }
    }
}

/// Tells the present state. Returns where the rest is heard, unless the page has gone.
async fn greet(socket: &mut WebSocket, state: &ServerState) -> Option<Receiver<Utf8Bytes>> {
    let (texts, said) = state.greet();
    for text in texts {
        if !send(socket, text).await {
            return None;
        }
    }
    Some(said)
}

async fn answer(
    socket: &mut WebSocket,
    state: &Arc<ServerState>,
    later: &Sender<Utf8Bytes>,
    text: Utf8Bytes,
) -> bool {
    let (state, later) = (Arc::clone(state), later.clone());
    // Some answers take a while, and other pages are not to wait for them.
    let ask = move || state.ask(&text, &later).map(|event| state.to_text(&event));
    match tokio::task::spawn_blocking(ask).await {
        Ok(Some(text)) => send(socket, text).await,
        Ok(None) => true,
        Err(_) => {
            let error = Error::internal("internal error; this is a mistake in Burgeon");
            send(socket, Event::refused(None, &error).to_text().into()).await
        }
    }
}

/// Sends a text. Returns whether the page is still there.
async fn send(socket: &mut WebSocket, text: Utf8Bytes) -> bool {
    deliver(socket, Message::Text(text)).await
}

async fn deliver(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}
