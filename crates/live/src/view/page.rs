//! Static files of the page, compressed with gzip.

use std::io::Read as _;

use axum::body::Bytes;
use axum::http::header::{self, HeaderMap};
use axum::response::{IntoResponse, Response};
use flate2::read::GzDecoder;

/// Static file of the page.
pub(super) struct PageFile {
    packed: &'static [u8],
    media_type: &'static str,
}

macro_rules! packed {
    ($name:literal) => {
        include_bytes!(concat!(env!("OUT_DIR"), "/", $name, ".gz"))
    };
}

/// HTML document of the page.
pub(super) const INDEX: PageFile =
    PageFile { packed: packed!("index.html"), media_type: "text/html; charset=utf-8" };

/// Script of the page.
pub(super) const SCRIPT: PageFile =
    PageFile { packed: packed!("viewer.js"), media_type: "text/javascript; charset=utf-8" };

/// Editor of the page, which it loads when it is opened.
pub(super) const EDITOR: PageFile =
    PageFile { packed: packed!("editor.js"), media_type: "text/javascript; charset=utf-8" };

/// Style sheet of the page.
pub(super) const STYLE: PageFile =
    PageFile { packed: packed!("viewer.css"), media_type: "text/css; charset=utf-8" };

/// HTML document of the page of a tileset.
pub(super) const TILESET_INDEX: PageFile =
    PageFile { packed: packed!("tileset.html"), media_type: "text/html; charset=utf-8" };

/// Script of the page of a tileset.
pub(super) const TILESET_SCRIPT: PageFile =
    PageFile { packed: packed!("tileset.js"), media_type: "text/javascript; charset=utf-8" };

/// Additional style sheet of the page of a tileset.
pub(super) const TILESET_STYLE: PageFile =
    PageFile { packed: packed!("tileset.css"), media_type: "text/css; charset=utf-8" };

impl PageFile {
    /// Returns the file as a response to a request with `headers`: compressed if the client accepts gzip.
    pub(super) fn answer(&self, headers: &HeaderMap) -> Response {
        let kind = [(header::CONTENT_TYPE, self.media_type), (header::VARY, "accept-encoding")];
        if takes_gzip(headers) {
            let packed = Bytes::from_static(self.packed);
            return (kind, [(header::CONTENT_ENCODING, "gzip")], packed).into_response();
        }
        let mut plain = Vec::new();
        // Decompression cannot fail, because this program's own build compressed the file.
        let _ = GzDecoder::new(self.packed).read_to_end(&mut plain);
        (kind, plain).into_response()
    }
}

/// Returns true if gzip is among the accepted encodings with a weight above 0.
fn takes_gzip(headers: &HeaderMap) -> bool {
    let named = headers.get_all(header::ACCEPT_ENCODING).iter().filter_map(|value| value.to_str().ok());
    named.flat_map(|value| value.split(',')).any(|encoding| {
        let (name, weight) = encoding.split_once(';').unwrap_or((encoding, "q=1"));
        let weight = weight.trim().strip_prefix("q=").and_then(|weight| weight.parse::<f32>().ok());
        name.trim().eq_ignore_ascii_case("gzip") && weight.is_some_and(|weight| weight > 0.0)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use axum::http::HeaderValue;

    #[test]
    fn the_page_is_packed_for_those_who_take_it_so() {
        for (accepted, packed) in [
            ("gzip, deflate, br", true),
            ("br;q=1.0, GZIP;q=0.5", true),
            ("gzip;q=0", false),
            ("deflate, br", false),
            ("", false),
        ] {
            let mut headers = HeaderMap::new();
            headers.insert(header::ACCEPT_ENCODING, HeaderValue::from_static(accepted));
            let answer = INDEX.answer(&headers);
            assert_eq!(answer.headers().contains_key(header::CONTENT_ENCODING), packed, "{accepted}");
        }
    }

    #[test]
    fn every_file_is_what_was_packed() {
        let files = [
            (INDEX, "index.html"),
            (SCRIPT, "viewer.js"),
            (STYLE, "viewer.css"),
            (TILESET_INDEX, "tileset.html"),
            (TILESET_SCRIPT, "tileset.js"),
            (TILESET_STYLE, "tileset.css"),
        ];
        for (file, path) in files {
            let mut plain = Vec::new();
            GzDecoder::new(file.packed).read_to_end(&mut plain).unwrap();
            let dist = concat!(env!("CARGO_MANIFEST_DIR"), "/../../viewer/dist");
            assert!(plain == std::fs::read(format!("{dist}/{path}")).unwrap(), "{path}");
        }
    }
}
