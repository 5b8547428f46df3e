//! Responses with a file of any size, of which only a piece is in memory.

use std::fs::File;
use std::io::Read;
use std::pin::Pin;
use std::task::{Context, Poll};

use axum::body::{Body, Bytes};
use axum::http::{HeaderValue, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_core::Stream;
use tokio::sync::mpsc::{Receiver, Sender, channel};

use super::folder::ServedFile;

/// Size (bytes) of a piece.
const PIECE: usize = 256 << 10;

/// Maximum number of pieces that wait for the client.
const AHEAD: usize = 2;

/// Pieces of a file, as they are read.
struct FilePieces(Receiver<std::io::Result<Bytes>>);

impl Stream for FilePieces {
    type Item = std::io::Result<Bytes>;

    fn poll_next(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<Option<Self::Item>> {
        self.0.poll_recv(context)
    }
}

/// Responds with the file. A file that is replaced meanwhile is sent as it was.
pub(in crate::view) async fn send_file(file: ServedFile) -> Response {
    let opened = tokio::task::spawn_blocking(move || {
        let opened = File::open(&file.path)?;
        let length = opened.metadata()?.len();
        Ok::<_, std::io::Error>((opened, length))
    });
    let Ok(Ok((opened, length))) = opened.await else {
        let text = [(header::CONTENT_TYPE, "text/plain; charset=utf-8")];
        return (StatusCode::NOT_FOUND, text, "the file cannot be read").into_response();
    };
    let (sender, pieces) = channel(AHEAD);
    tokio::task::spawn_blocking(move || read_pieces(opened, length, &sender));
    let media_type = HeaderValue::from_static(file.media_type);
    let headers = [(header::CONTENT_TYPE, media_type), (header::CONTENT_LENGTH, HeaderValue::from(length))];
    (headers, Body::from_stream(FilePieces(pieces))).into_response()
}

/// Reads `length` bytes in pieces, until the client disconnects.
fn read_pieces(mut file: File, length: u64, sender: &Sender<std::io::Result<Bytes>>) {
    let mut left = length;
    while left > 0 {
        let mut piece = vec![0; usize::try_from(left).unwrap_or(PIECE).min(PIECE)];
        let read = file.read(&mut piece);
        let sent = match read {
            // A file that was cut ends the response early, so that the client notices.
            Ok(0) => sender.blocking_send(Err(std::io::ErrorKind::UnexpectedEof.into())),
            Ok(count) => {
                piece.truncate(count);
                left -= count as u64;
                sender.blocking_send(Ok(piece.into()))
            }
            Err(error) if error.kind() == std::io::ErrorKind::Interrupted => continue,
            Err(error) => {
                // The client may have disconnected; the response ends in both cases.
                let _ = sender.blocking_send(Err(error));
                return;
            }
        };
        if sent.is_err() {
            return;
        }
    }
}
