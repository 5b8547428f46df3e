//! Watch of files and folders, and waits for files that are being written.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::thread::JoinHandle;
use std::time::{Duration, Instant, SystemTime};

use super::files::{self, WatchedFiles};
use super::folders::{self, AnyWatcher, Folders, Handler, Sign};
use burgeon_base::error::{Error, Result};
use burgeon_base::named_thread;

/// Quiet time after an event before files are compared, unless the event marks the end of a save. Editors save in
/// several steps.
const QUIET: Duration = Duration::from_millis(10);

/// Maximum time from an event to a comparison, even in a busy folder.
const LONGEST: Duration = Duration::from_millis(100);

/// Time after which a missing or empty file is accepted. Some editors delete or truncate a file before they write it.
const PATIENCE: Duration = Duration::from_millis(150);

/// Time after which the content of a file that a program keeps open for writing is accepted.
const SAVE: Duration = Duration::from_secs(1);

/// Set if the system reports when a written file is closed.
const TELLS_ENDS: bool = cfg!(any(target_os = "linux", target_os = "android"));

/// Maximum number of events that are processed before an overdue comparison.
const AT_ONCE: usize = 1000;

/// Interval of comparisons without an event. Some file systems, such as network drives, report no events.
const ROUND: Duration = Duration::from_secs(1);

/// Interval of comparisons if the system cannot watch folders, instead of [`ROUND`].
const SHORT_ROUND: Duration = Duration::from_millis(100);

/// Files whose content has changed.
#[derive(Debug, Clone)]
pub struct Change {
    /// Changed files, as named to [`Watch`].
    pub files: Vec<PathBuf>,
    /// Time of the first sign of the change.
    pub at: Instant,
}

/// Returns the remaining wait until `files` are stable, or `None` if they are.
///
/// A file that has just been written in place may be incomplete. A caller that cannot read it should try again.
///
/// ```
/// use burgeon_live::watch::unsettled;
/// use std::time::{Duration, SystemTime};
///
/// let file = tempfile::NamedTempFile::new()?;
/// file.as_file().set_modified(SystemTime::now() - Duration::from_secs(60))?;
/// assert_eq!(unsettled([file.path()]), None);
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn unsettled<'a>(files: impl IntoIterator<Item = &'a Path>) -> Option<Duration> {
    let now = SystemTime::now();
    let young = files.into_iter().filter_map(|path| {
        let metadata = std::fs::metadata(path).ok().filter(std::fs::Metadata::is_file)?;
        PATIENCE.checked_sub(now.duration_since(metadata.modified().ok()?).ok()?)
    });
    young.filter(|left| !left.is_zero()).max()
}

/// Calls `read` for the file at `path`, and repeats it while it fails and the file has just been written.
///
/// ```
/// use burgeon_base::Error;
/// use burgeon_live::watch::settled;
///
/// let file = tempfile::NamedTempFile::new()?;
/// std::fs::write(file.path(), "42")?;
/// let read = || {
///     let text = std::fs::read_to_string(file.path()).map_err(|error| Error::file(file.path(), error))?;
///     text.parse::<u32>().map_err(Error::data)
/// };
/// assert_eq!(settled(file.path(), read)?, 42);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
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

/// Watches files in a separate thread until it is dropped.
///
/// ```
/// use burgeon_live::watch::Watch;
/// use std::sync::mpsc::channel;
/// use std::time::Duration;
///
/// let folder = tempfile::tempdir()?;
/// let script = folder.path().join("plant.lua");
/// std::fs::write(&script, "-- 1")?;
/// let (changed, changes) = channel();
/// let _watch = Watch::new(vec![script.clone()], move |change| drop(changed.send(change)), |_| {})?;
/// std::fs::write(&script, "-- 2")?;
/// assert_eq!(changes.recv_timeout(Duration::from_secs(20))?.files, [script]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Watch {
    signals: Sender<Signal>,
    thread: Option<JoinHandle<()>>,
}

/// Message to the thread.
enum Signal {
    /// Event at these paths, or at unknown paths if the list is empty.
    Event(Vec<PathBuf>, Instant, Sign),
    Follow(Vec<(PathBuf, bool)>, SystemTime),
    /// Request to confirm that all changes up to now have been reported.
    CatchUp(Sender<()>),
    Over,
}

/// Handler that receives the reason for the fallback to polling.
type ComplaintHandler = dyn FnOnce(String) + Send;

struct Watcher {
    files: WatchedFiles,
    folders: Folders,
    /// Handler that is called once if only polling is possible.
    complain: Option<Box<ComplaintHandler>>,
    /// Time of the first sign of a change that has not been examined yet.
    first: Option<Instant>,
    /// Files that have been written to since the last comparison. The flag is set while the file is still open, if the
    /// system reports that.
    open: BTreeMap<PathBuf, bool>,
}

impl Watch {
    /// Watches `files` and calls `changed` in a separate thread; `complain` is called if only polling is possible.
    pub fn new(
        files: Vec<PathBuf>,
        changed: impl Fn(Change) + Send + 'static,
        complain: impl FnOnce(String) + Send + 'static,
    ) -> Result<Self> {
        Self::by(folders::recommended, files, changed, complain)
    }

    /// Watches `files` as [`Watch::new`] does, with the watcher that `make` creates.
    fn by(
        make: impl FnOnce(Handler) -> notify::Result<AnyWatcher>,
        files: Vec<PathBuf>,
        changed: impl Fn(Change) + Send + 'static,
        complain: impl FnOnce(String) + Send + 'static,
    ) -> Result<Self> {
        let (signals, inbox) = channel();
        let events = signals.clone();
        let seen = move |paths, sign| {
            // The thread may have ended already.
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
        let thread = named_thread("watch")
            .spawn(watch)
            .map_err(|error| Error::system(format!("cannot start a thread to watch files: {error}")))?;
        Ok(Self { signals, thread: Some(thread) })
    }

    /// Watches `files` instead of the previous ones. The flag of each file is set if the file existed at the caller's
    /// last look, which was not before `since`. New files that have changed since are reported as changed.
    ///
    /// ```
    /// use burgeon_live::watch::Watch;
    /// use std::sync::mpsc::channel;
    /// use std::time::{Duration, SystemTime};
    ///
    /// let folder = tempfile::tempdir()?;
    /// let tree = folder.path().join("tree.glb");
    /// let (changed, changes) = channel();
    /// let watch = Watch::new(Vec::new(), move |change| drop(changed.send(change)), |_| {})?;
    /// // A run did not find the file.
    /// watch.follow(vec![(tree.clone(), false)], SystemTime::now());
    /// std::fs::write(&tree, "a model")?;
    /// assert_eq!(changes.recv_timeout(Duration::from_secs(20))?.files, [tree]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn follow(&self, files: Vec<(PathBuf, bool)>, since: SystemTime) {
        // The thread ends only when this value is dropped.
        let _ = self.signals.send(Signal::Follow(files, since));
    }

    /// Waits until all changes up to now have been reported, for a limited time.
    pub fn catch_up(&self) {
        let (done, all) = channel();
        if self.signals.send(Signal::CatchUp(done)).is_ok() {
            // The wait ends after the time limit in any case.
            let _ = all.recv_timeout(SAVE * 2);
        }
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        let _ = self.signals.send(Signal::Over);
        if let Some(thread) = self.thread.take() {
            // Its remaining reports are no longer needed.
            let _ = thread.join();
        }
    }
}

impl Watcher {
    /// Watches the folders that the files require.
    fn cover(&mut self) {
        self.folders.cover(&self.files);
        if let Some(why) = self.folders.failure()
            && let Some(complain) = self.complain.take()
        {
            complain(format!("cannot watch folders; polling files ten times a second: {why}"));
        }
    }

    fn work(mut self, inbox: &Receiver<Signal>, changed: &dyn Fn(Change)) {
        // Changes before the folders were watched caused no event.
        let mut due = Some(Instant::now());
        let mut looked = Instant::now();
        let mut asked: Vec<Sender<()>> = Vec::new();
        let mut overdue = 0;
        loop {
            // Frequent events of other files must not delay a round.
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
                    // Changes before the new folders were watched caused no event.
                    due = Some(Instant::now());
                }
                Ok(Signal::CatchUp(done)) => {
                    asked.push(done);
                    due.get_or_insert_with(Instant::now);
                }
                Err(RecvTimeoutError::Timeout) => {
                    // Events that arrive while files are read cause another comparison.
                    self.cover();
                    due = self.look(changed);
                    (looked, overdue) = (Instant::now(), 0);
                    if due.is_none() {
                        // The requester may have stopped waiting.
                        for done in asked.drain(..) {
                            let _ = done.send(());
                        }
                    }
                }
                Ok(Signal::Over) | Err(RecvTimeoutError::Disconnected) => return,
            }
        }
    }

    /// Compares the files and reports a change. Returns the time of the next comparison if a file looks unfinished.
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
                // Closing the file will cause an event.
                return Some(first + SAVE);
            }
            // The change was found before its events arrived. A program may keep a database open for as long as it
            // runs.
            let early = |it: &files::FileChange| it.is_database() || open(it).is_none();
            if found.iter().any(|it| early(it) && unsettled([it.path()]).is_some()) {
                return Some(Instant::now() + QUIET);
            }
        }
        self.first = None;
        self.open.clear();
        let files = self.files.accept(found);
        // A changed link may lead to another folder.
        self.cover();
        changed(Change { files, at: first });
        None
    }
}

#[cfg(test)]
mod tests;
