//! State of the page of a tileset: its revision and the progress, which one thread observes.

use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::{Duration, Instant};

use axum::extract::ws::Utf8Bytes;
use tokio::sync::broadcast;
use tokio::sync::mpsc::Sender;

use super::folder::{ServedFile, ServedFolder};
use super::message::{TilesetEvent, TilesetProgress};
use crate::view::LiveEvent;
use crate::view::message::Event;
use crate::view::settings::EventReceiver;
use crate::view::socket::PageState;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;

/// Maximum number of messages that wait for a page. A slower page receives the present state instead.
const QUEUE: usize = 16;

/// Interval of observations of the folder. Joins are usually noticed earlier, by the watch.
const ROUND: Duration = Duration::from_secs(1);

/// Minimum interval of progress reports, in multiples of the time that a report takes: it reads all manifests.
const REST: u32 = 20;

/// Reader of the progress; `None` if the folder has no plan.
pub type ProgressReader = Box<dyn Fn() -> Result<Option<TilesetProgress>> + Send + Sync>;

/// State that all pages share.
pub(in crate::view) struct TilesetState {
    pub(in crate::view) folder: TilesetFiles,
    progress: ProgressReader,
    tell: EventReceiver,
    inner: Mutex<Observation>,
    wake: Condvar,
    pages: broadcast::Sender<Utf8Bytes>,
}

/// Files of the folder.
pub(in crate::view) struct TilesetFiles(pub(super) ServedFolder);

impl TilesetFiles {
    /// Returns the file at a path of `names` inside the folder, if pages may read it.
    pub(in crate::view) fn file(&self, names: &[String]) -> Option<ServedFile> {
        self.0.file(names)
    }
}

/// Last observation of the folder.
#[derive(Default)]
struct Observation {
    revision: Option<String>,
    plan: Option<String>,
    progress: Option<TilesetEvent>,
    /// Time of the next progress report; `None` for never, because all tiles are made.
    due: Option<Instant>,
    over: bool,
}

impl TilesetState {
    /// Creates the state, and observes the folder.
    pub(super) fn new(folder: ServedFolder, progress: ProgressReader, tell: EventReceiver) -> Self {
        let state = Self {
            folder: TilesetFiles(folder),
            progress,
            tell,
            inner: Mutex::default(),
            wake: Condvar::new(),
            pages: broadcast::channel(QUEUE).0,
        };
        state.observe();
        state
    }

    /// Sends a notice to the process that started the server.
    pub(in crate::view) fn tell(&self, notice: &LiveEvent) {
        (self.tell)(notice);
    }

    /// Observes the folder until [`end`](Self::end) is called.
    pub(super) fn work(&self) {
        loop {
            let inner = self.lock();
            if inner.over {
                return;
            }
            // A poisoned lock is recovered by the next one.
            drop(self.wake.wait_timeout(inner, ROUND));
            self.observe();
        }
    }

    /// Observes the folder at once.
    pub(super) fn hurry(&self) {
        self.wake.notify_all();
    }

    /// Ends the observation.
    pub(super) fn end(&self) {
        self.lock().over = true;
        self.wake.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, Observation> {
        self.inner.lock().recover()
    }

    /// Sends what has changed to all pages.
    fn observe(&self) {
        let revision = self.folder.0.revision();
        let plan = self.folder.0.plan_revision();
        let mut inner = self.lock();
        // While a join replaces the file, the last tileset remains.
        let is_joined = revision.is_some() && revision != inner.revision;
        if is_joined {
            inner.revision = revision;
            inner.revision_event().iter().for_each(|event| self.send(event));
        }
        let is_due = is_joined || plan != inner.plan || inner.due.is_some_and(|due| due <= Instant::now());
        inner.plan = plan;
        if inner.over || !is_due {
            return;
        }
        drop(inner);
        let begin = Instant::now();
        let progress = match (self.progress)() {
            Ok(progress) => progress.map(TilesetEvent::Making),
            Err(error) => Some(TilesetEvent::Unknown { text: error.to_string() }),
        };
        let mut inner = self.lock();
        let is_complete = match &progress {
            Some(TilesetEvent::Making(progress)) => progress.open == 0,
            Some(_) => false,
            None => true,
        };
        inner.due = (!is_complete).then(|| Instant::now() + (begin.elapsed() * REST).max(ROUND));
        if progress != inner.progress {
            inner.progress = progress;
            inner.progress.iter().for_each(|event| self.send(event));
        }
    }

    fn send(&self, event: &TilesetEvent) {
        // An error means that there is no page.
        let _ = self.pages.send(event.to_text().into());
    }
}

impl Observation {
    fn revision_event(&self) -> Option<TilesetEvent> {
        Some(TilesetEvent::Tileset { revision: self.revision.clone()? })
    }
}

impl PageState for TilesetState {
    fn greet(&self) -> (Vec<Utf8Bytes>, broadcast::Receiver<Utf8Bytes>) {
        let path = &self.folder.0.path;
        let real = path.canonicalize();
        let real = real.as_ref().unwrap_or(path);
        let name = real.file_name().unwrap_or(real.as_os_str());
        let hello = TilesetEvent::Hello {
            version: env!("CARGO_PKG_VERSION"),
            tileset: name.to_string_lossy().into_owned(),
            path: path.display().to_string(),
        };
        let inner = self.lock();
        let events = [Some(hello), inner.revision_event(), inner.progress.clone()];
        (events.iter().flatten().map(|event| event.to_text().into()).collect(), self.pages.subscribe())
    }

    fn reply(self: &Arc<Self>, _: &str, _: &Sender<Utf8Bytes>) -> Option<Utf8Bytes> {
        let error = Error::argument("the page of a tileset sends no messages");
        Some(Event::rejection(None, &error).to_text().into())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    /// Returns a state of a tileset whose progress has `open` tiles, and its folder.
    fn state(open: usize) -> (tempfile::TempDir, Arc<AtomicUsize>, TilesetState) {
        let folder = tempfile::tempdir().unwrap();
        std::fs::write(folder.path().join("tileset.json"), "{}").unwrap();
        let reads = Arc::new(AtomicUsize::new(0));
        let counted = Arc::clone(&reads);
        let progress = move || {
            let done = counted.fetch_add(1, Ordering::Relaxed);
            Ok(Some(TilesetProgress { done, open, ..TilesetProgress::default() }))
        };
        let opened = ServedFolder::open(folder.path()).unwrap();
        let state = TilesetState::new(opened, Box::new(progress), Box::new(|_| {}));
        (folder, reads, state)
    }

    #[test]
    fn a_page_is_greeted_with_the_tileset_and_the_progress() {
        let (_folder, _, state) = state(3);
        let (texts, _) = state.greet();
        let kinds: Vec<String> = texts
            .iter()
            .map(|text| serde_json::from_str::<serde_json::Value>(text).unwrap())
            .map(|event| event["type"].as_str().unwrap().to_owned())
            .collect();
        assert_eq!(kinds, ["hello", "tileset", "making"]);
    }

    #[test]
    fn a_new_join_is_sent_once() {
        let (folder, _, state) = state(0);
        let (_, mut pages) = state.greet();
        state.observe();
        assert!(pages.try_recv().is_err());
        let path = folder.path().join("tileset.json");
        std::fs::write(path.with_extension("new"), "{}").unwrap();
        std::fs::rename(path.with_extension("new"), &path).unwrap();
        state.observe();
        assert!(pages.try_recv().unwrap().contains("\"tileset\""));
        assert!(pages.try_recv().unwrap().contains("\"making\""));
        std::fs::remove_file(&path).unwrap();
        state.observe();
        assert!(pages.try_recv().is_err());
    }

    #[test]
    fn the_progress_of_a_complete_tileset_is_read_again_only_for_another_plan() {
        let (folder, reads, state) = state(0);
        state.observe();
        assert_eq!(reads.load(Ordering::Relaxed), 1);
        std::fs::write(folder.path().join("plan.json"), "{}").unwrap();
        state.observe();
        assert_eq!(reads.load(Ordering::Relaxed), 2);
        let (_folder, reads, state) = self::state(1);
        std::thread::sleep(ROUND + ROUND / 10);
        state.observe();
        assert_eq!(reads.load(Ordering::Relaxed), 2);
    }
}
