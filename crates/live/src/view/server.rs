//! Routes: the page, models, exports and the socket, for clients that know the address.

use std::sync::Arc;

use axum::body::{Body, Bytes};
use axum::extract::ws::WebSocketUpgrade;
use axum::extract::{FromRequestParts, Request};
use axum::http::header::{self, HeaderMap, HeaderName, HeaderValue};
use axum::http::{Method, StatusCode};
use axum::response::{IntoResponse, Response};
use percent_encoding::{AsciiSet, NON_ALPHANUMERIC, percent_decode_str, utf8_percent_encode};
use tokio::sync::Semaphore;

use super::address::admits;
use super::socket::{self, PageState};
use super::state::ServerState;
use super::tileset::{TilesetState, send_file};
use super::urls::{MODEL, PICTURE, measured_hash, model_url};
use super::{LiveEvent, Token, export, page};
use burgeon_base::error::Error;
use burgeon_base::stop::Stop;
use burgeon_export::{Export, Format, SceneFacts, gltf};

/// Content security policy: only content of this server. Textures inside models are read from the browser's memory.
const POLICY: &str = "default-src 'none'; script-src 'self'; style-src 'self'; img-src 'self' blob: data:; \
                      connect-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'";

/// The same for tilesets, whose compressed tiles a decoder in WebAssembly reads.
const TILESET_POLICY: &str = "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; \
                              img-src 'self' blob: data:; connect-src 'self' blob: data:; base-uri 'none'; \
                              form-action 'none'; frame-ancestors 'none'";

const FOR_EVER: &str = "private, max-age=31536000, immutable";
const NEVER: &str = "no-store";

/// Shared state of all request handlers.
pub(super) struct Site {
    pub token: Token,
    pub content: SiteContent,
}

/// Subject of the pages.
pub(super) enum SiteContent {
    Script(ScriptSite),
    Tileset(Arc<TilesetState>),
}

/// Script that is shown.
pub(super) struct ScriptSite {
    pub state: Arc<ServerState>,
    /// Limit of one export at a time. A cancelled export counts until it has ended.
    pub exports: Arc<Semaphore>,
}

/// Guard that cancels the work for a request when the client disconnects.
struct RequestGuard(Arc<Stop>);

impl Drop for RequestGuard {
    fn drop(&mut self) {
        self.0.stop(Error::cancellation("cancelled"));
    }
}

impl Site {
    /// Sends a notice to the process that started the server.
    pub(super) fn tell(&self, notice: &LiveEvent) {
        match &self.content {
            SiteContent::Script(script) => script.state.tell(notice),
            SiteContent::Tileset(tileset) => tileset.tell(notice),
        }
    }
}

impl ScriptSite {
    /// Runs `make` when its turn comes, separately from runs of the script, and cancels it when the client disconnects.
    /// Returns `None` if `make` panicked.
    async fn export<T: Send + 'static>(
        &self,
        make: impl FnOnce(&Arc<Stop>) -> T + Send + 'static,
    ) -> Option<T> {
        let turn = Arc::clone(&self.exports).acquire_owned().await.ok()?;
        let waiting = RequestGuard(Arc::default());
        let stop = Arc::clone(&waiting.0);
        let made = tokio::task::spawn_blocking(move || {
            let made = export::run_separately(|| make(&stop));
            drop(turn);
            made
        });
        made.await.ok()
    }
}

/// Answers a request; calls `known` before handling the request if it has the token.
pub(super) async fn answer(site: &Arc<Site>, request: Request, known: impl FnOnce()) -> Response {
    let mut response = route(site, request, known).await;
    let headers = response.headers_mut();
    let policy = match &site.content {
        SiteContent::Script(_) => POLICY,
        SiteContent::Tileset(_) => TILESET_POLICY,
    };
    let always: [(HeaderName, &'static str); 6] = [
        (header::CONTENT_SECURITY_POLICY, policy),
        (header::X_CONTENT_TYPE_OPTIONS, "nosniff"),
        (header::X_FRAME_OPTIONS, "DENY"),
        (header::REFERRER_POLICY, "no-referrer"),
        (HeaderName::from_static("cross-origin-resource-policy"), "same-origin"),
        (HeaderName::from_static("cross-origin-opener-policy"), "same-origin"),
    ];
    for (name, value) in always {
        headers.insert(name, HeaderValue::from_static(value));
    }
    headers.entry(header::CACHE_CONTROL).or_insert(HeaderValue::from_static(NEVER));
    response
}

async fn route(site: &Arc<Site>, request: Request, known: impl FnOnce()) -> Response {
    let headers = request.headers();
    if !admits(
        single_header(headers, &header::HOST).unwrap_or(None),
        single_header(headers, &header::ORIGIN).unwrap_or(Some("")),
    ) {
        return plain(StatusCode::FORBIDDEN, "this server answers only requests of its own pages");
    }
    let path = request.uri().path().to_owned();
    let (token, inner) = match path.strip_prefix('/').unwrap_or("").split_once('/') {
        Some((token, inner)) => (token, Some(inner)),
        None => (path.strip_prefix('/').unwrap_or(""), None),
    };
    if let ("proof", Some(question), &Method::GET) = (token, inner, request.method()) {
        return match site.token.proof(question) {
            Some(proof) => plain_text(StatusCode::OK, proof),
            None => missing(),
        };
    }
    if !site.token.is(token) {
        return plain(
            StatusCode::FORBIDDEN,
            "open the address that burgeon live printed: it ends with a token",
        );
    }
    known();
    if request.method() != Method::GET {
        let refused = plain(StatusCode::METHOD_NOT_ALLOWED, "only GET is supported");
        return ([(header::ALLOW, "GET")], refused).into_response();
    }
    match (inner, &site.content) {
        // The page's URLs are relative to the folder.
        (None, _) => {
            (StatusCode::PERMANENT_REDIRECT, [(header::LOCATION, format!("/{token}/"))]).into_response()
        }
        (Some("viewer.css"), _) => page::STYLE.answer(headers),
        (Some(inner), SiteContent::Script(script)) => route_script(script, inner, request).await,
        (Some(inner), SiteContent::Tileset(tileset)) => route_tileset(tileset, inner, request).await,
    }
}

/// Answers a request for `inner`, a part of the page of a script.
async fn route_script(site: &ScriptSite, inner: &str, request: Request) -> Response {
    match inner {
        "" => page::INDEX.answer(request.headers()),
        "viewer.js" => page::SCRIPT.answer(request.headers()),
        "editor.js" => page::EDITOR.answer(request.headers()),
        "names.json" => json_text(site.state.names.clone()),
        "socket" => open_socket(&site.state, request).await,
        inner => match inner.split_once('/') {
            Some(("model", name)) => match measured_hash(name) {
                Some(hash) => measured_model(site, hash).await,
                None => content_file(name, &MODEL, |hash| site.state.model(hash)),
            },
            Some(("picture", name)) => content_file(name, &PICTURE, |hash| site.state.picture(hash)),
            Some(("export", name)) if !name.contains('/') => {
                let query = request.uri().query().unwrap_or("").to_owned();
                save(site, name, &query).await
            }
            _ => missing(),
        },
    }
}

/// Answers a request for `inner`, a part of the page of a tileset.
async fn route_tileset(state: &Arc<TilesetState>, inner: &str, request: Request) -> Response {
    match inner {
        "" => page::TILESET_INDEX.answer(request.headers()),
        "tileset.js" => page::TILESET_SCRIPT.answer(request.headers()),
        "tileset.css" => page::TILESET_STYLE.answer(request.headers()),
        "socket" => open_socket(state, request).await,
        inner => {
            let names = inner.strip_prefix("tileset/").map(|path| path.split('/').map(decode_name));
            let names: Option<Vec<String>> = names.and_then(Iterator::collect);
            let found = names.and_then(|names| state.folder.file(&names));
            match found {
                Some(found) => send_file(found).await,
                None => missing(),
            }
        }
    }
}

/// Returns the value of a header that may occur once; fails if it occurs more often or is not text.
fn single_header<'a>(headers: &'a HeaderMap, name: &HeaderName) -> std::result::Result<Option<&'a str>, ()> {
    let mut values = headers.get_all(name).iter();
    match (values.next(), values.next()) {
        (None, _) => Ok(None),
        (Some(value), None) => value.to_str().map(Some).map_err(|_| ()),
        (Some(_), Some(_)) => Err(()),
    }
}

async fn open_socket<S: PageState>(state: &Arc<S>, request: Request) -> Response {
    let (mut parts, _) = request.into_parts();
    match WebSocketUpgrade::from_request_parts(&mut parts, &()).await {
        Ok(upgrade) => {
            let state = Arc::clone(state);
            socket::limit_messages(upgrade).on_upgrade(move |socket| socket::talk(socket, state))
        }
        Err(refused) => refused.into_response(),
    }
}

/// Responds with a file whose name is a hash of its content.
fn content_file(name: &str, format: &Format, find: impl Fn(&str) -> Option<Bytes>) -> Response {
    match format.file.stem(name).and_then(find) {
        Some(bytes) => content_response(format, bytes),
        None => missing(),
    }
}

/// Responds with content that never changes.
fn content_response(format: &Format, bytes: impl Into<Body>) -> Response {
    let headers = [(header::CONTENT_TYPE, format.media_type), (header::CACHE_CONTROL, FOR_EVER)];
    (headers, bytes.into()).into_response()
}

/// Encodes the present model as [`gltf::glb_with_texture_coordinates`] does. Few pages request it.
async fn measured_model(site: &ScriptSite, hash: &str) -> Response {
    let shown = site.state.shown();
    let url = Some(model_url(hash));
    let Some(shown) = shown.filter(|shown| shown.message.url == url) else { return missing() };
    match site.export(move |stop| gltf::glb_with_texture_coordinates(&shown.run.scene, stop)).await {
        Some(Ok(bytes)) => content_response(&MODEL, bytes),
        Some(Err(error)) => plain_text(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()),
        None => plain(StatusCode::INTERNAL_SERVER_ERROR, "the model ended early: this is a bug in Burgeon"),
    }
}

async fn save(site: &ScriptSite, name: &str, query: &str) -> Response {
    let refuse = |text: String| plain_text(StatusCode::BAD_REQUEST, text);
    let Some(name) = decode_name(name) else { return missing() };
    if !Format::of(name.as_ref()).is_ok_and(Format::is_of_scenes) {
        return missing();
    }
    let picture = match export::picture(query) {
        Ok(picture) => picture,
        Err(error) => return refuse(error.to_string()),
    };
    let Some(shown) = site.state.shown() else {
        return plain(StatusCode::CONFLICT, "no model yet");
    };
    let recipe = Arc::clone(&shown.recipe);
    let export = move |stop: &Arc<Stop>| {
        let recipe = export::complete(&recipe)?;
        let facts =
            SceneFacts { frame: shown.run.service(), recipe: recipe.as_ref(), ..SceneFacts::default() };
        export::download(&Export { scene: &shown.run.scene, picture: &picture, facts }, &name, stop)
    };
    match site.export(export).await {
        Some(Ok(download)) => {
            let disposition = disposition(&download.name);
            let headers = [
                (header::CONTENT_TYPE, HeaderValue::from_static(download.media_type)),
                (header::CONTENT_DISPOSITION, disposition),
            ];
            (headers, download.bytes).into_response()
        }
        Some(Err(error)) => plain_text(StatusCode::UNPROCESSABLE_ENTITY, error.to_string()),
        None => plain(StatusCode::INTERNAL_SERVER_ERROR, "the export ended early: this is a bug in Burgeon"),
    }
}

/// Decodes the percent-encoding of `name`. Returns `None` if the result is not text or refers to another folder.
fn decode_name(name: &str) -> Option<String> {
    let is_escape = |rest: &str| rest.len() >= 2 && rest.bytes().take(2).all(|it| it.is_ascii_hexdigit());
    if !name.split('%').skip(1).all(is_escape) {
        return None;
    }
    let name = percent_decode_str(name).decode_utf8().ok()?.into_owned();
    let leads_away = name.contains(['/', '\\', '\0']) || name.starts_with("..") || name.len() > 255;
    (!leads_away).then_some(name)
}

/// Characters that are escaped in a file name in a header.
const ESCAPED: &AsciiSet = &NON_ALPHANUMERIC.remove(b'-').remove(b'_').remove(b'.');

/// Returns a header that makes the browser save a file as `name`.
fn disposition(name: &str) -> HeaderValue {
    let plain: String =
        name.chars().map(|it| if it.is_ascii_graphic() && it != '"' { it } else { '_' }).collect();
    let escaped = utf8_percent_encode(name, ESCAPED);
    let text = format!("attachment; filename=\"{plain}\"; filename*=UTF-8''{escaped}");
    HeaderValue::from_str(&text).unwrap_or(HeaderValue::from_static("attachment"))
}

fn missing() -> Response {
    plain(StatusCode::NOT_FOUND, "page not found")
}

fn plain(status: StatusCode, text: &'static str) -> Response {
    (status, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], Body::from(text)).into_response()
}

fn plain_text(status: StatusCode, text: String) -> Response {
    (status, [(header::CONTENT_TYPE, "text/plain; charset=utf-8")], Body::from(text)).into_response()
}

fn json_text(text: String) -> Response {
    (StatusCode::OK, [(header::CONTENT_TYPE, "application/json")], Body::from(text)).into_response()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn escaped_names_are_read_and_those_that_lead_away_are_not() {
        assert_eq!(decode_name("my%20t%C3%B6wer.glb").as_deref(), Some("my t\u{f6}wer.glb"));
        for wrong in
            ["%2e%2e%2fx.glb", "..%2Fx.glb", "a%5Cb.glb", "%", "%2", "%zz", "%ff.glb", "a%00.glb", "%+1.glb"]
        {
            assert_eq!(decode_name(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn names_of_any_letters_become_headers() {
        assert_eq!(
            disposition("t\u{f6} \"w\".glb"),
            "attachment; filename=\"t___w_.glb\"; filename*=UTF-8''t%C3%B6%20%22w%22.glb"
        );
    }
}
