//! State that all pages share: the request, the current run, the present model, and its problems.

use std::borrow::Cow;
use std::collections::{BTreeSet, VecDeque};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use tokio::sync::broadcast;

use super::console::Console;
use super::message::{Cause, Event, Hello, ModelMessage};
use super::open::Editor;
use super::request::{Inputs, Request};
use super::settings::EventReceiver;
use super::urls::picture_url;
use super::{LiveEvent, Settings, export};
use burgeon_base::error::{Error, Excerpt, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use burgeon_base::warning::Warning;
use burgeon_engine::run::Run;
use burgeon_engine::script::{CurvesFile, Param, RecipeDraft, RunOptions, Session};
use burgeon_export::gltf::Layout;

/// Maximum number of messages that wait for a page. A slower page receives the present state instead.
const QUEUE: usize = 64;

/// Maximum number of stored models, and the total size (bytes) beyond which only the present model is stored.
const KEPT: usize = 3;
const KEPT_BYTES: usize = 256 << 20;

/// Number of lines that an error shows before and after its own.
const AROUND: usize = 2;

/// Maximum number of stored small renders.
const PICTURES: usize = 512;

/// Expected duration below which a run is not cancelled for a newer value, so that a page shows models while a slider
/// moves.
const SHORT: Duration = Duration::from_millis(400);

/// Returns the hash of a content, as URLs contain it.
pub(super) fn content_hash(content: &[u8]) -> String {
    blake3::hash(content).to_hex()[..32].to_owned()
}

/// Returns the content with a hash, if it is stored.
fn find_content(stored: &VecDeque<(String, Bytes)>, hash: &str) -> Option<Bytes> {
    stored.iter().find(|(known, _)| known == hash).map(|(_, bytes)| bytes.clone())
}

/// State that all pages share.
pub(super) struct ServerState {
    pub script: PathBuf,
    pub options: RunOptions,
    pub editor: Option<Editor>,
    /// Names of the scripting API as JSON.
    pub names: String,
    tell: EventReceiver,
    inner: Mutex<LiveState>,
    /// Condition that wakes the worker and the thread that reports progress.
    pub wake: Condvar,
    pages: broadcast::Sender<Utf8Bytes>,
    /// Cancellation of the variations in progress.
    pub variations: Mutex<Option<Arc<Stop>>>,
    /// Names of presets that pages know. The lock is held while their file is written or read, so that a change is
    /// reported once.
    pub presets: Mutex<Vec<String>>,
    /// Presets file of each package, as far as runs have found them.
    pub package_presets: Mutex<Vec<(String, PathBuf)>>,
    /// Drawn curves of the last run or save; `None` if their file is invalid. The lock is held while the file is written
    /// or read, so that a save does not count as a change.
    pub curves: Mutex<Option<CurvesFile>>,
    /// Lock that is held while a chain is traced, because each trace may use all cores.
    pub tracing: Mutex<()>,
}

pub(super) struct LiveState {
    pub request: Request,
    pub due: Option<DueRun>,
    pub running: Option<ActiveRun>,
    pub shown: Option<Arc<PresentModel>>,
    /// Reason that there is no newer model: the script is missing or has an error.
    pub trouble: Option<Event>,
    /// Cancellation event, if a page cancelled the last run, so that the shown model is older than the request.
    pub cancelled: Option<Event>,
    /// Texts that the last run printed, if it printed any.
    pub printed: Option<Event>,
    /// Time since which the shown model has been out of date.
    pub stale: Option<Instant>,
    /// Time since which failures have been withheld because files are changing.
    pub doubts: Option<Instant>,
    /// Inputs of the last completed run.
    pub finished: Option<Inputs>,
    /// Duration of the last completed run.
    pub took: Duration,
    /// Number of file changes so far.
    pub generation: u64,
    pub runs: u64,
    /// Parameters of the current script; `None` while it has an error.
    pub params: Option<Vec<Param>>,
    models: VecDeque<(String, Bytes)>,
    pictures: VecDeque<(String, Bytes)>,
    /// Total number of steps for these inputs without their limit.
    pub last_step: Option<(Inputs, usize)>,
    /// Unusable values that have already been reported.
    pub left_out: BTreeSet<String>,
    /// Warnings of the last model that have already been reported.
    pub warnings: BTreeSet<String>,
    /// Notes of the last model that have already been reported.
    pub notes: BTreeSet<String>,
    /// Files of the script, which an editor may open.
    pub files: Vec<PathBuf>,
    /// Cancellation of work other than models, which refers to a script that has changed.
    pub aside: Arc<Stop>,
    pub over: bool,
}

/// Scheduled run.
#[derive(Clone)]
pub(super) struct DueRun {
    pub cause: Cause,
    pub files: Vec<String>,
    /// Time when the cause was detected.
    pub at: Instant,
}

/// Run in progress.
pub(super) struct ActiveRun {
    pub run: u64,
    pub cause: Cause,
    pub files: Vec<String>,
    pub session: Arc<Session>,
    pub begin: Instant,
    pub cancelled: Arc<AtomicBool>,
    /// Set if pages are not informed about the run.
    pub background: bool,
    /// Texts that the run prints.
    pub console: Arc<Console>,
}

/// Present model.
#[derive(Clone)]
pub(super) struct PresentModel {
    pub run: Arc<Run>,
    /// Request that led to the model.
    pub request: Request,
    /// Inputs of the model.
    pub inputs: Inputs,
    /// Layout of the scene in the model's bytes.
    pub layout: Arc<Layout>,
    pub message: ModelMessage,
    /// Recipe of the model, which its files carry.
    pub recipe: Arc<RecipeDraft>,
}

impl ServerState {
    /// Creates the state of a server that knows the script's `presets`.
    pub(super) fn new(mut settings: Settings, presets: Vec<String>) -> Self {
        let request = Request::new(&settings.options);
        // The preset's values are part of the request from now on.
        settings.options.params.preset = None;
        if let Some(sources) = settings.options.registry.sources().map(|sources| sources.with_cache()) {
            settings.options.registry.set_sources(sources);
        }
        settings.options.inputs.derivations = Some(std::sync::Arc::default());
        let curves = CurvesFile::read(&settings.script).ok();
        let inner = LiveState {
            request,
            due: None,
            running: None,
            shown: None,
            trouble: None,
            cancelled: None,
            printed: None,
            stale: None,
            doubts: None,
            finished: None,
            took: Duration::ZERO,
            generation: 0,
            runs: 0,
            params: None,
            models: VecDeque::new(),
            pictures: VecDeque::new(),
            last_step: None,
            left_out: BTreeSet::new(),
            warnings: BTreeSet::new(),
            notes: BTreeSet::new(),
            files: Vec::new(),
            aside: Arc::default(),
            over: false,
        };
        Self {
            script: settings.script,
            options: settings.options,
            editor: settings.editor,
            names: settings.names,
            tell: settings.tell,
            inner: Mutex::new(inner),
            wake: Condvar::new(),
            pages: broadcast::channel(QUEUE).0,
            variations: Mutex::default(),
            presets: Mutex::new(presets),
            package_presets: Mutex::default(),
            curves: Mutex::new(curves),
            tracing: Mutex::default(),
        }
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, LiveState> {
        self.inner.lock().recover()
    }

    /// Sends an event to all pages. Events sent while the lock is held arrive in order.
    pub(super) fn send(&self, event: &Event) {
        // An error means that there is no page.
        let _ = self.pages.send(self.to_text(event));
    }

    /// Serialises `event`, with paths relative to the script's folder.
    pub(super) fn to_text(&self, event: &Event) -> Utf8Bytes {
        if let Event::Model(_) = event {
            return event.to_text().into();
        }
        let mut event = event.clone();
        if let Some(text) = event.text_mut() {
            *text = self.relative(text);
        }
        event.to_text().into()
    }

    /// Makes the paths of files in the script's folder relative within `text`.
    fn relative(&self, text: &str) -> String {
        let real = self.script.canonicalize().ok();
        let scripts = [Some(self.script.as_path()), real.as_deref()];
        let folders = scripts.into_iter().flatten().filter_map(Path::parent);
        // If the folder were the root, every absolute path would match.
        let folders = folders.filter(|folder| folder.is_absolute() && folder.parent().is_some());
        let relative = folders.fold(Cow::Borrowed(text), |text, folder| {
            Cow::Owned(text.replace(&format!("{}{MAIN_SEPARATOR}", folder.display()), ""))
        });
        relative.into_owned()
    }

    /// Sends a notice to the process that started the server.
    pub(super) fn tell(&self, notice: &LiveEvent) {
        (self.tell)(notice);
    }

    /// Returns the first messages for a new page, and the receiver of later ones.
    pub(super) fn greeting(&self) -> (Vec<Utf8Bytes>, broadcast::Receiver<Utf8Bytes>) {
        let presets = self.presets.lock().recover();
        let inner = self.lock();
        let mut texts: Vec<Utf8Bytes> =
            vec![self.to_text(&Event::Hello(self.hello(presets.clone(), &inner)))];
        texts.extend(inner.printed.iter().map(|event| self.to_text(event)));
        if let Some(model) = inner.present() {
            texts.push(self.to_text(&Event::Model(Box::new(model))));
        }
        texts.extend(inner.trouble.iter().chain(&inner.cancelled).map(|event| self.to_text(event)));
        if let Some(running) = inner.running.as_ref().filter(|running| !running.background) {
            let (run, cause, files) = (running.run, running.cause, running.files.clone());
            texts.push(self.to_text(&Event::Working { run, cause, files }));
        }
        (texts, self.pages.subscribe())
    }

    fn hello(&self, presets: Vec<String>, inner: &LiveState) -> Hello {
        Hello {
            version: env!("CARGO_PKG_VERSION"),
            script: self.script_name(),
            path: self.script.display().to_string(),
            editor: self.editor.is_some(),
            formats: export::downloads(),
            presets,
            stale: inner.stale.map(|since| since.elapsed().as_secs_f64()),
        }
    }

    /// Returns the file name of the script.
    pub(super) fn script_name(&self) -> String {
        self.script.file_name().unwrap_or(self.script.as_os_str()).to_string_lossy().into_owned()
    }

    /// Returns the name of a file relative to the script's folder, as pages use it.
    pub(super) fn name(&self, path: &Path) -> String {
        if path == self.script {
            return self.script_name();
        }
        let script = self.script.canonicalize().ok();
        if script.as_deref() == Some(path) {
            return self.script_name();
        }
        let root = script.as_deref().and_then(Path::parent);
        let inner = root.and_then(|root| path.strip_prefix(root).ok());
        inner.unwrap_or(path).display().to_string()
    }

    /// Converts an error to JSON, with the file named as pages name it and with the surrounding lines.
    pub(super) fn error_json(&self, error: &Error) -> serde_json::Value {
        self.add_place(error.to_json(), error.place(), error.excerpt())
    }

    /// Converts a warning in the same way.
    pub(super) fn warning_json(&self, warning: &Warning) -> serde_json::Value {
        self.add_place(warning.to_json(), warning.place(), warning.excerpt())
    }

    fn add_place(
        &self,
        mut object: serde_json::Value,
        place: Option<&SourcePlace>,
        excerpt: Option<Excerpt>,
    ) -> serde_json::Value {
        excerpt.into_iter().for_each(|excerpt| excerpt.add_to(&mut object));
        for key in ["message", "help"] {
            if let Some(text) = object[key].as_str() {
                object[key] = self.relative(text).into();
            }
        }
        if let Some(place) = place {
            object["file"] = self.short(&place.file).into();
            let excerpt = place.excerpt(AROUND, AROUND);
            if !excerpt.is_empty() {
                let line = |(line, text)| serde_json::json!({ "line": line, "text": text });
                object["excerpt"] = excerpt.into_iter().map(line).collect();
            }
        }
        object
    }

    /// Returns the name of a file of an error or a rule, as pages use it.
    pub(super) fn short(&self, file: &str) -> String {
        let file = Path::new(file);
        let folder = self.script.parent().filter(|folder| !folder.as_os_str().is_empty());
        let inner = folder.and_then(|folder| file.strip_prefix(folder).ok());
        inner.map_or_else(|| self.name(file), |inner| inner.display().to_string())
    }

    /// Returns the present model, if there is one.
    pub(super) fn shown(&self) -> Option<Arc<PresentModel>> {
        self.lock().shown.clone()
    }

    /// Returns the model with that hash, if it is stored.
    pub(super) fn model(&self, hash: &str) -> Option<Bytes> {
        find_content(&self.lock().models, hash)
    }

    /// Returns the small render with that hash, if it is stored.
    pub(super) fn picture(&self, hash: &str) -> Option<Bytes> {
        find_content(&self.lock().pictures, hash)
    }

    /// Stores a small render. Returns its URL.
    pub(super) fn keep_picture(&self, png: Vec<u8>) -> String {
        let hash = content_hash(&png);
        let url = picture_url(&hash);
        let mut inner = self.lock();
        inner.pictures.retain(|(known, _)| *known != hash);
        inner.pictures.push_back((hash, png.into()));
        if inner.pictures.len() > PICTURES {
            inner.pictures.pop_front();
        }
        url
    }

    /// Cancels the variations in progress, which are no longer needed.
    pub(super) fn stop_variations(&self, why: &str) {
        if let Some(stop) = self.variations.lock().recover().take() {
            stop.stop(Error::cancellation(why));
        }
    }

    /// Stops the worker, and the current run.
    pub(super) fn end(&self) {
        self.stop_variations("the server ends");
        let mut inner = self.lock();
        inner.over = true;
        inner.aside.stop(Error::cancellation("the server ends"));
        inner.stop("the server ends");
        self.wake.notify_all();
    }
}

impl LiveState {
    /// Schedules a run as soon as possible.
    pub(super) fn post(&mut self, mut due: DueRun) {
        let soon_over = self.took < SHORT
            && self
                .running
                .as_ref()
                .is_some_and(|running| !running.background && running.begin.elapsed() < SHORT);
        if due.cause == Cause::Save || !soon_over {
            self.stop("there is something newer");
        }
        if let Some(waiting) = self.due.take() {
            due.files = waiting.files.into_iter().chain(due.files).collect();
            due.files.dedup();
            if waiting.cause == Cause::Save {
                due.cause = Cause::Save;
            }
        }
        self.due = Some(due);
    }

    /// Returns the shown model, as currently described to pages.
    pub(super) fn present(&self) -> Option<ModelMessage> {
        let shown = self.shown.as_ref()?;
        Some(ModelMessage { preset: self.request.preset(), ..shown.message.clone() })
    }

    /// Restores the request of the shown model and sends its values to the pages, so that cancelled values do not
    /// return with the next change.
    pub(super) fn take_back(&mut self, state: &ServerState) {
        let Some(shown) = &self.shown else { return };
        let before = self.request.inputs(self.generation);
        self.request = shown.request.clone();
        if self.is_present() {
            self.trouble = None;
            self.cancelled = None;
            self.stale = None;
            self.finished = Some(shown.inputs.clone());
            self.params = Some(shown.run.params.clone());
        }
        if self.request.inputs(self.generation) != before {
            let model = self.present().map(|model| Event::Model(Box::new(model)));
            model.iter().chain(&self.trouble).for_each(|event| state.send(event));
        }
    }

    /// Returns true if the shown model corresponds to the request and to the current files.
    fn is_present(&self) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.inputs == self.request.inputs(self.generation))
    }

    /// Records that the shown model is out of date.
    pub(super) fn grow_stale(&mut self) {
        if self.shown.is_some() {
            self.stale.get_or_insert_with(Instant::now);
        }
    }

    /// Reports that `run` was cancelled, and records if the model is older than the request.
    pub(super) fn report_cancelled(&mut self, state: &ServerState, run: u64) {
        let stale = self.due.is_none() && !self.is_present();
        let event = Event::Cancelled { run, stale };
        state.send(&event);
        if stale {
            self.grow_stale();
            self.cancelled = Some(event);
        }
    }

    /// Cancels the current run. Returns true if there is one that pages know of.
    pub(super) fn stop(&self, why: &str) -> bool {
        let Some(running) = &self.running else { return false };
        running.cancelled.store(true, Ordering::Release);
        running.session.stop.stop(Error::cancellation(why));
        !running.background
    }

    /// Stores a model, and removes older ones if they are too many or too large. Returns the removed models.
    pub(super) fn keep(&mut self, hash: String, bytes: Bytes) -> VecDeque<(String, Bytes)> {
        self.models.retain(|(known, _)| *known != hash);
        self.models.push_back((hash, bytes));
        let mut gone = VecDeque::new();
        let size =
            |models: &VecDeque<(String, Bytes)>| models.iter().map(|(_, bytes)| bytes.len()).sum::<usize>();
        while self.models.len() > 1 && (self.models.len() > KEPT || size(&self.models) > KEPT_BYTES) {
            gone.extend(self.models.pop_front());
        }
        gone
    }
}
