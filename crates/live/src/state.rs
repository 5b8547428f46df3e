//! What all pages share: the request, the run that is under way, the present model, and what is wrong.

use std::collections::{BTreeSet, VecDeque};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use axum::body::Bytes;
use axum::extract::ws::Utf8Bytes;
use tokio::sync::broadcast;

use super::message::{Cause, Event, Hello, ModelMessage};
use super::open::Editor;
use super::request::{Inputs, Request};
use super::{Notice, Settings};
use burgeon_base::error::{Error, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_base::stop::Stop;
use burgeon_base::warning::Warning;
use burgeon_engine::run::Run;
use burgeon_engine::script::{Param, RunOptions, Session};
use burgeon_export::Format;
use burgeon_export::gltf::Layout;
use burgeon_presets::Presets;
use burgeon_watch::Change;

/// Messages that wait for a page at most; a page that is slower gets the present state instead.
const QUEUE: usize = 64;

/// Models that are kept at most, and their size (bytes) beyond which only the present one is.
const KEPT: usize = 3;
const KEPT_BYTES: usize = 256 << 20;

/// Lines that an error shows before and after its own.
const AROUND: usize = 2;

/// Small pictures that are kept at most.
const PICTURES: usize = 512;

/// A run that is likely to take less is not stopped for a newer value, so that a page sees pictures while a
/// slider moves.
const SHORT: Duration = Duration::from_millis(400);

/// What all pages share.
pub(super) struct ServerState {
    pub script: PathBuf,
    pub options: RunOptions,
    pub editor: Option<Editor>,
    tell: Box<dyn Fn(&Notice) + Send + Sync>,
    inner: Mutex<LiveState>,
    /// Wakes the worker and whoever tells of progress.
    pub wake: Condvar,
    pages: broadcast::Sender<Utf8Bytes>,
    /// Ends the variations that are being made.
    pub variations: Mutex<Option<Arc<Stop>>>,
    /// The names of presets that pages know; held while their file is written or read, so that a change is told once.
    pub presets: Mutex<Vec<String>>,
    /// By package: the file of its presets, as far as a run has told.
    pub package_presets: Mutex<Vec<(String, PathBuf)>>,
    /// Held while a chain is traced, since each may take all cores.
    pub tracing: Mutex<()>,
}

pub(super) struct LiveState {
    pub request: Request,
    pub due: Option<DueRun>,
    pub running: Option<ActiveRun>,
    pub shown: Option<Arc<PresentModel>>,
    /// Why there is no newer model: the script is missing or has an error.
    pub trouble: Option<Event>,
    /// That the last run was stopped by a page, so that what is shown is older than what is requested.
    pub cancelled: Option<Event>,
    /// Since when the model that is shown has not been the present one.
    pub stale: Option<Instant>,
    /// Since when failures are kept back because files change.
    pub doubts: Option<Instant>,
    /// What the last run that came to an end was made from.
    pub finished: Option<Inputs>,
    /// How long that took.
    pub took: Duration,
    /// Counts the changes of files.
    pub generation: u64,
    pub runs: u64,
    /// The parameters of the script as it is; unknown while it has an error.
    pub params: Option<Vec<Param>>,
    models: VecDeque<(String, Bytes)>,
    pictures: VecDeque<(String, Bytes)>,
    /// For these inputs, but for their limit, the number of steps to the end.
    pub last_step: Option<(Inputs, usize)>,
    /// Values that could not be used, as far as that has been told.
    pub left_out: BTreeSet<String>,
    /// The warnings of the last model, as far as they have been told.
    pub warnings: BTreeSet<String>,
    /// The same of its notes.
    pub notes: BTreeSet<String>,
    /// The script's files, which an editor may open.
    pub files: Vec<PathBuf>,
    /// Ends what is made besides models, for it is about a script that has changed.
    pub aside: Arc<Stop>,
    pub over: bool,
}

/// A run that is to be made.
#[derive(Clone)]
pub(super) struct DueRun {
    pub cause: Cause,
    pub files: Vec<String>,
    /// When its cause was seen.
    pub at: Instant,
}

/// A run that is under way.
pub(super) struct ActiveRun {
    pub run: u64,
    pub cause: Cause,
    pub files: Vec<String>,
    pub session: Arc<Session>,
    pub begin: Instant,
    pub cancelled: Arc<AtomicBool>,
    /// Whether pages do not know of it.
    pub background: bool,
}

/// The present model.
pub(super) struct PresentModel {
    pub run: Arc<Run>,
    /// What had been requested.
    pub request: Request,
    /// What it was made from.
    pub inputs: Inputs,
    /// Where the scene's things are in the model's bytes.
    pub layout: Arc<Layout>,
    pub message: ModelMessage,
}

impl ServerState {
    pub(super) fn new(mut settings: Settings) -> Self {
        let request = Request::new(&settings.options);
        // Its values are a part of the request from now on.
        settings.options.params.preset = None;
        settings.options.inputs.cache = Some(std::sync::Arc::default());
        let presets = super::tools::presets(&settings.script);
        let inner = LiveState {
            request,
            due: None,
            running: None,
            shown: None,
            trouble: None,
            cancelled: None,
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
            tell: settings.tell,
            inner: Mutex::new(inner),
            wake: Condvar::new(),
            pages: broadcast::channel(QUEUE).0,
            variations: Mutex::default(),
            presets: Mutex::new(presets),
            package_presets: Mutex::default(),
            tracing: Mutex::default(),
        }
    }

    pub(super) fn lock(&self) -> MutexGuard<'_, LiveState> {
        self.inner.lock().recover()
    }

    /// Says something to all pages. Called with the lock held, it comes in order.
    pub(super) fn send(&self, event: &Event) {
        // There may be no page.
        let _ = self.pages.send(self.to_text(event));
    }

    /// `event` as it travels, with paths from the script's folder on.
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

    /// `text` with the paths of files in the script's folder from there on.
    fn relative(&self, text: &str) -> String {
        let real = self.script.canonicalize().ok();
        let scripts = [Some(self.script.as_path()), real.as_deref()];
        let folders = scripts.into_iter().flatten().filter_map(Path::parent);
        // Whatever begins with a slash is in the root.
        let folders = folders.filter(|folder| folder.is_absolute() && folder.parent().is_some());
        folders.fold(text.to_owned(), |text, folder| {
            text.replace(&format!("{}{MAIN_SEPARATOR}", folder.display()), "")
        })
    }

    /// Says something where the server was started.
    pub(super) fn tell(&self, notice: &Notice) {
        (self.tell)(notice);
    }

    /// What a new page is told first, and where it hears the rest.
    pub(super) fn greet(&self) -> (Vec<Utf8Bytes>, broadcast::Receiver<Utf8Bytes>) {
        let presets = self.presets.lock().recover();
        let inner = self.lock();
        let mut texts: Vec<Utf8Bytes> =
            vec![self.to_text(&Event::Hello(self.hello(presets.clone(), &inner)))];
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
            formats: Format::OF_SCENES.map(Format::extension).to_vec(),
            presets,
            stale: inner.stale.map(|since| since.elapsed().as_secs_f64()),
        }
    }

    /// The script's file name.
    pub(super) fn script_name(&self) -> String {
        self.script.file_name().unwrap_or(self.script.as_os_str()).to_string_lossy().into_owned()
    }

    /// A file as pages name it: from the script's folder.
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

    /// An error whose file is named as pages name it, with the lines around its own.
    pub(super) fn error_json(&self, error: &Error) -> serde_json::Value {
        self.placed(error.to_json(), error.place())
    }

    /// The same of a warning.
    pub(super) fn warning_json(&self, warning: &Warning) -> serde_json::Value {
        self.placed(warning.to_json(), warning.place())
    }

    fn placed(&self, mut object: serde_json::Value, place: Option<&SourcePlace>) -> serde_json::Value {
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

    /// A file of an error or a rule as pages name it.
    pub(super) fn short(&self, file: &str) -> String {
        let file = Path::new(file);
        let folder = self.script.parent().filter(|folder| !folder.as_os_str().is_empty());
        let inner = folder.and_then(|folder| file.strip_prefix(folder).ok());
        inner.map_or_else(|| self.name(file), |inner| inner.display().to_string())
    }

    /// The model of that name, if it is kept.
    pub(super) fn model(&self, hash: &str) -> Option<Bytes> {
        self.lock().models.iter().find(|(known, _)| known == hash).map(|(_, bytes)| bytes.clone())
    }

    /// The small picture of that name, if it is kept.
    pub(super) fn picture(&self, hash: &str) -> Option<Bytes> {
        self.lock().pictures.iter().find(|(known, _)| known == hash).map(|(_, bytes)| bytes.clone())
    }

    /// Keeps a small picture. Returns where pages find it.
    pub(super) fn keep_picture(&self, png: Vec<u8>) -> String {
        let hash = blake3::hash(&png).to_hex()[..32].to_owned();
        let mut inner = self.lock();
        inner.pictures.retain(|(known, _)| *known != hash);
        inner.pictures.push_back((hash.clone(), png.into()));
        if inner.pictures.len() > PICTURES {
            inner.pictures.pop_front();
        }
        format!("picture/{hash}.png")
    }

    /// Ends the variations that are being made, for they are of no use any more.
    fn stop_variations(&self, why: &str) {
        if let Some(stop) = self.variations.lock().recover().take() {
            stop.stop(Error::stopped(why));
        }
    }

    /// Takes notice of changed files.
    pub(super) fn changed(&self, change: &Change) {
        let mut presets = vec![Presets::path_of(&self.script)];
        let of_packages = self.package_presets.lock().recover();
        presets.extend(of_packages.iter().map(|(_, path)| path.clone()));
        drop(of_packages);
        if change.files.iter().any(|path| presets.contains(path)) {
            super::tools::presets_changed(self);
        }
        let files: Vec<String> =
            change.files.iter().filter(|path| !presets.contains(path)).map(|path| self.name(path)).collect();
        if files.is_empty() {
            return;
        }
        self.stop_variations("the script has changed");
        let mut inner = self.lock();
        std::mem::take(&mut inner.aside).stop(Error::stopped("the script has changed"));
        inner.generation += 1;
        inner.post(DueRun { cause: Cause::Save, files, at: change.at });
        self.wake.notify_all();
    }

    /// Ends the worker, and the run that is under way.
    pub(super) fn end(&self) {
        self.stop_variations("the server ends");
        let mut inner = self.lock();
        inner.over = true;
        inner.aside.stop(Error::stopped("the server ends"));
        inner.stop("the server ends");
        self.wake.notify_all();
    }
}

impl LiveState {
    /// Has a run made as soon as may be.
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

    /// The model that is shown, as pages are told it now.
    pub(super) fn present(&self) -> Option<ModelMessage> {
        let shown = self.shown.as_ref()?;
        Some(ModelMessage { preset: self.request.preset(), ..shown.message.clone() })
    }

    /// Takes the request back to that of the model that is shown, and tells pages its values again: what was cancelled
    /// must not come with the next change.
    pub(super) fn take_back(&mut self, state: &ServerState) {
        let Some(shown) = self.shown.clone() else { return };
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

    /// Whether the model that is shown is that of the request and of the files as they are.
    fn is_present(&self) -> bool {
        self.shown.as_ref().is_some_and(|shown| shown.inputs == self.request.inputs(self.generation))
    }

    /// Notes that the model that is shown is not the present one any more.
    pub(super) fn grow_stale(&mut self) {
        if self.shown.is_some() {
            self.stale.get_or_insert_with(Instant::now);
        }
    }

    /// Tells that `run` was stopped, and keeps in mind whether the model is older than what is requested.
    pub(super) fn cancelled(&mut self, state: &ServerState, run: u64) {
        let stale = self.due.is_none() && !self.is_present();
        let event = Event::Cancelled { run, stale };
        state.send(&event);
        if stale {
            self.grow_stale();
            self.cancelled = Some(event);
        }
    }

    /// Stops the run that is under way. Returns whether there is one that pages know of.
    pub(super) fn stop(&self, why: &str) -> bool {
        let Some(running) = &self.running else { return false };
        running.cancelled.store(true, Ordering::Release);
        running.session.stop.stop(Error::stopped(why));
        !running.background
    }

    /// Keeps a model; those that came before it go when they are too many or too large.
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
