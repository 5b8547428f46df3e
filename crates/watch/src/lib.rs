//! Watching: tells when files that decide what a run makes hold something else than before.
//!
//! Comes in: paths, of files and folders that are there or not. Goes out: a [`Change`] soon after one of them holds something
//! else, appears or goes; a folder holds the names in it. It never tells of a save that changes nothing, and it never opens what is no regular file.
//!
//! Folders are watched, not files, since most editors save by renaming a new file over the old one (`folders`).
//! What an event means is decided by comparing contents (`files`).

mod database;
mod files;
mod folders;

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

use burgeon_base::error::{Error, Result};
use files::WatchedFiles;
use folders::{AnyWatcher, Folders, Handler, Sign};

/// How long it must be quiet after an event until files are compared, unless it is what comes at the end of a save:
/// editors save in several steps.
const QUIET: Duration = Duration::from_millis(10);

/// The longest time from an event to a comparison, however busy the folder is.
const LONGEST: Duration = Duration::from_millis(100);

/// How long a file may be missing or empty until that is believed: some editors delete a file or cut it to
/// nothing before they write it.
const PATIENCE: Duration = Duration::from_millis(150);

/// How long a file that someone writes into may stay open until what it holds is believed.
const SAVE: Duration = Duration::from_secs(1);

/// Whether the system tells when a file that was written is closed.
const TELLS_ENDS: bool = cfg!(any(target_os = "linux", target_os = "android"));

/// How many events are taken before files are compared that should have been by now.
const AT_ONCE: usize = 1000;

/// How often files are compared without an event: some disks, such as those of other machines, tell of none.
const ROUND: Duration = Duration::from_secs(1);

/// As [`ROUND`], where the system cannot watch folders.
const SHORT_ROUND: Duration = Duration::from_millis(100);

/// Files that hold something else than before.
#[derive(Debug, Clone)]
pub struct Change {
    /// The files as they were named to [`Watch`].
    pub files: Vec<PathBuf>,
    /// When the first sign of it was seen.
    pub at: Instant,
}

/// How long to wait until `files` have been as they are for a while; `None` if they have.
///
/// What has just been written in place may be the half of what is to come: who cannot read it tries again first.
pub fn unsettled<'a>(files: impl IntoIterator<Item = &'a Path>) -> Option<Duration> {
    let now = SystemTime::now();
    let young = files.into_iter().filter_map(|path| {
        let metadata = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file)?;
        PATIENCE.checked_sub(now.duration_since(metadata.modified().ok()?).ok()?)
    });
    young.filter(|left| !left.is_zero()).max()
}

/// What `read` makes of the file at `path`; tried again while it fails and the file has only just been written.
pub fn settled<T>(path: &Path, read: impl Fn() -> Result<T>) -> Result<T> {
    let begin = Instant::now();
    loop {
        let before = files::stamp_of(path);
        let result = read();
        let young = || files::stamp_of(path) != before || unsettled([path]).is_some();
        if result.is_ok() || begin.elapsed() > SAVE || !young() {
            return result;
        }
        std::thread::sleep(QUIET);
    }
}

/// Watches files in a thread of its own until it is dropped.
pub struct Watch {
    signals: Sender<Signal>,
    thread: Option<JoinHandle<()>>,
}

/// What the thread waits for.
enum Signal {
    /// Something happened to these paths; none if the system lost count.
    Event(Vec<PathBuf>, Instant, Sign),
    Follow(Vec<(PathBuf, bool)>, SystemTime),
    /// Someone waits until all that has changed by now has been told.
    CatchUp(Sender<()>),
    Over,
}

/// What is told why only polling is left.
type ComplaintHandler = dyn FnOnce(&str) + Send;

struct Watcher {
    files: WatchedFiles,
    folders: Folders,
    /// Is told once that only polling is left.
    complain: Option<Box<ComplaintHandler>>,
    /// When the first sign of a change was seen that has not been looked into.
    first: Option<Instant>,
    /// What someone has written into since the last look, and whether it has not been closed yet, where the system tells
    /// of that.
    open: BTreeMap<PathBuf, bool>,
}

impl Watch {
    /// Watches `files` and calls `changed` in a thread of its own; `complain` is told if only polling is left.
    pub fn new(
        files: Vec<PathBuf>,
        changed: impl Fn(Change) + Send + 'static,
        complain: impl FnOnce(&str) + Send + 'static,
    ) -> Result<Self> {
        Self::by(folders::recommended, files, changed, complain)
    }

    /// As [`Watch::new`], by the watcher that `make` makes.
    fn by(
        make: impl FnOnce(Handler) -> notify::Result<AnyWatcher>,
        files: Vec<PathBuf>,
        changed: impl Fn(Change) + Send + 'static,
        complain: impl FnOnce(&str) + Send + 'static,
    ) -> Result<Self> {
        let (signals, inbox) = channel();
        let events = signals.clone();
        let seen = move |paths, sign| {
            // The watcher may be over already.
            let _ = events.send(Signal::Event(paths, Instant::now(), sign));
        };
        let mut watcher = Watcher {
            files: WatchedFiles::default(),
            folders: Folders::new(make, seen),
            complain: Some(Box::new(complain)),
            first: None,
            open: BTreeMap::new(),
        };
        watcher.files.follow(files.into_iter().map(|path| (path, true)).collect(), None);
        let watch = move || {
            watcher.cover();
            watcher.work(&inbox, &changed);
        };
        let thread = std::thread::Builder::new()
            .name("burgeon watch".to_owned())
            .spawn(watch)
            .map_err(|error| Error::system(format!("cannot start a thread to watch files: {error}")))?;
        Ok(Self { signals, thread: Some(thread) })
    }

    /// Watches `files` and no others from now on. Each comes with whether it was there when someone last looked, not
    /// before `since`; those that are new to the watch and have changed by now are told as changed.
    pub fn follow(&self, files: Vec<(PathBuf, bool)>, since: SystemTime) {
        // The thread ends only when this is dropped.
        let _ = self.signals.send(Signal::Follow(files, since));
    }

    /// Waits until all that has changed by now has been told, but not for ever.
    pub fn catch_up(&self) {
        let (done, all) = channel();
        if self.signals.send(Signal::CatchUp(done)).is_ok() {
            // Whether it was in time or not, nothing more can be known.
            let _ = all.recv_timeout(SAVE * 2);
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.signals.send(Signal::Over);
        if let Some(thread) = self.thread.take() {
            // What it would have told does not matter any more.
            let _ = thread.join();
        }
    }
}

impl Watcher {
    /// Watches the folders that the files need.
    fn cover(&mut self) {
        self.folders.cover(&self.files);
        if let Some(why) = self.folders.failure()
            && let Some(complain) = self.complain.take()
        {
            complain(&format!("cannot watch folders, so files are looked at ten times a second: {why}"));
        }
    }

    fn work(mut self, inbox: &Receiver<Signal>, changed: &dyn Fn(Change)) {
        // Before the folders were watched nothing was told of them.
        let mut due = Some(Instant::now());
        let mut looked = Instant::now();
        let mut asked: Vec<Sender<()>> = Vec::new();
        let mut overdue = 0;
        loop {
            // Events of other files, of which there may be many, put off no round.
            let round = looked + if self.folders.failure().is_some() { SHORT_ROUND } else { ROUND };
            let wait = due.unwrap_or(round).saturating_duration_since(Instant::now());
            overdue = if wait.is_zero() { overdue + 1 } else { 0 };
            let signal = match overdue {
                ..AT_ONCE => inbox.recv_timeout(wait),
                _ => Err(RecvTimeoutError::Timeout),
            };
            match signal {
                Ok(Signal::Event(paths, at, sign)) => {
                    if self.files.concerned_by(&paths) {
                        let first = *self.first.get_or_insert(at);
                        let quiet = if sign == Sign::End { Duration::ZERO } else { QUIET };
                        due = Some((Instant::now() + quiet).min(first + LONGEST));
                        if sign != Sign::Other {
                            self.open.extend(paths.into_iter().map(|path| (path, sign == Sign::Write)));
                        }
                    }
                }
                Ok(Signal::Follow(files, since)) => {
                    if self.files.follow(files, Some(since)) {
                        self.first.get_or_insert_with(Instant::now);
                    }
                    self.cover();
                    // What has changed before its folder was watched was not told.
                    due = Some(Instant::now());
                }
                Ok(Signal::CatchUp(done)) => {
                    asked.push(done);
                    due.get_or_insert_with(Instant::now);
                }
                Err(RecvTimeoutError::Timeout) => {
                    // Events that come while files are read lead to another look.
                    self.cover();
                    due = self.look(changed);
                    (looked, overdue) = (Instant::now(), 0);
                    if due.is_none() {
                        // Who asked may have given up.
                        for done in asked.drain(..) {
                            let _ = done.send(());
                        }
                    }
                }
                Ok(Signal::Over) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Compares the files and tells of a change. Returns when to look again, if what is there looks unfinished.
    fn look(&mut self, changed: &dyn Fn(Change)) -> Option<Instant> {
        let found = self.files.changed(self.first.is_none());
        if found.is_empty() {
            self.first = None;
            self.open.clear();
            return None;
        }
        let first = *self.first.get_or_insert_with(Instant::now);
        if found.iter().any(files::FileChange::looks_unfinished) && first.elapsed() < PATIENCE {
            return Some(Instant::now() + QUIET);
        }
        if TELLS_ENDS && first.elapsed() < SAVE {
            let open = |it: &files::FileChange| {
                files::hops(it.path()).iter().find_map(|path| self.open.get(path)).copied()
            };
            if found.iter().any(|it| !it.is_database() && open(it) == Some(true)) {
                // That it is closed comes as an event.
                return Some(first + SAVE);
            }
            // It was seen before its events have come. A program may keep a database open for as long as it runs.
            let early = |it: &files::FileChange| it.is_database() || open(it).is_none();
            if found.iter().any(|it| early(it) && unsettled([it.path()]).is_some()) {
                return Some(Instant::now() + QUIET);
            }
        }
        self.first = None;
        self.open.clear();
        let files = self.files.accept(found);
        // What has just been named may lie elsewhere than before, if it is a link.
        self.cover();
        changed(Change { files, at: first });
        None
    }
}

#[cfg(test)]
mod tests;
