//! WebSocket of a page: the server's events to all pages, and answers to this page.

use std::sync::Arc;
use std::time::{Duration, Instant};

use axum::extract::ws::{Message, Utf8Bytes, WebSocket, WebSocketUpgrade};
use tokio::sync::broadcast::Receiver;
use tokio::sync::broadcast::error::RecvError;
use tokio::sync::mpsc::{Sender, channel};
use tokio::time::timeout;

use super::message::Event;
use burgeon_base::error::Error;

/// Maximum size (bytes) of a message from a page.
const LARGEST: usize = 1 << 20;

/// Time limit for sending a message to a page before the connection is closed.
const PATIENCE: Duration = Duration::from_secs(30);

/// Maximum number of answers that wait for a page.
const ANSWERS: usize = 16;

/// Interval of pings to a page.
const HEARTBEAT: Duration = Duration::from_secs(30);

/// Maximum silence of a page, including pongs, before the connection is closed.
const SILENCE: Duration = Duration::from_secs(100);

/// State that greets pages and answers their messages.
pub(super) trait PageState: Send + Sync + 'static {
    /// Returns the first messages for a new page, and the receiver of later ones.
    fn greet(&self) -> (Vec<Utf8Bytes>, Receiver<Utf8Bytes>);

    /// Returns the answer to the message `text` of a page; slow answers are sent through `page`.
    fn reply(self: &Arc<Self>, text: &str, page: &Sender<Utf8Bytes>) -> Option<Utf8Bytes>;
}

/// Limits the size of messages that a socket accepts.
pub(super) fn limit_messages(upgrade: WebSocketUpgrade) -> WebSocketUpgrade {
    upgrade.max_message_size(LARGEST).max_frame_size(LARGEST)
}

/// Exchanges messages with a page until one side closes the connection.
pub(super) async fn talk<S: PageState>(mut socket: WebSocket, state: Arc<S>) {
    let Some(mut said) = greet(&mut socket, &*state).await else { return };
    let (later, mut answers) = channel(ANSWERS);
    let mut heartbeat = tokio::time::interval(HEARTBEAT);
    let mut heard = Instant::now();
    loop {
        let going = tokio::select! {
            message = said.recv() => match message {
                Ok(text) => send(&mut socket, text).await,
                // The page was too slow for its queue. The present state contains everything that still matters.
                Err(RecvError::Lagged(_)) => match greet(&mut socket, &*state).await {
                    Some(fresh) => { said = fresh; true }
                    None => false,
                },
                Err(RecvError::Closed) => false,
            },
            Some(text) = answers.recv() => send(&mut socket, text).await,
            message = socket.recv() => { heard = Instant::now(); match message {
                Some(Ok(Message::Text(text))) => answer(&mut socket, &state, &later, text).await,
                Some(Ok(Message::Binary(_))) => {
                    let refused = Event::rejection(None, &Error::argument("a message is text"));
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

/// Sends the present state. Returns the receiver of later events, or `None` if the page has disconnected.
async fn greet<S: PageState>(socket: &mut WebSocket, state: &S) -> Option<Receiver<Utf8Bytes>> {
    let (texts, said) = state.greet();
    for text in texts {
        if !send(socket, text).await {
            return None;
        }
    }
    Some(said)
}

async fn answer<S: PageState>(
    socket: &mut WebSocket,
    state: &Arc<S>,
    later: &Sender<Utf8Bytes>,
    text: Utf8Bytes,
) -> bool {
    let (state, later) = (Arc::clone(state), later.clone());
    // Some answers take a while, and other pages must not wait for them.
    let ask = move || state.reply(&text, &later);
    match tokio::task::spawn_blocking(ask).await {
        Ok(Some(text)) => send(socket, text).await,
        Ok(None) => true,
        Err(_) => {
            let error = Error::internal("internal error; this is a bug in Burgeon");
            send(socket, Event::rejection(None, &error).to_text().into()).await
        }
    }
}

/// Sends a text. Returns true if the page is still connected.
async fn send(socket: &mut WebSocket, text: Utf8Bytes) -> bool {
    deliver(socket, Message::Text(text)).await
}

async fn deliver(socket: &mut WebSocket, message: Message) -> bool {
    matches!(timeout(PATIENCE, socket.send(message)).await, Ok(Ok(())))
}
