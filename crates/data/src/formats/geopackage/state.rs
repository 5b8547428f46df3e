//! One committed state of a database file for all readers of a run, while other programs may write the file.
//!
//! A file of at most 64 MB is copied into memory in one read transaction, so a writer waits only milliseconds and every
//! reader sees the same state. A larger file is read in place, with a read lock for as long as the run reads. No files
//! are written next to the database: the leftovers of a program that ended in the middle of a change are recovered in a
//! private copy.
//!
//! Sources: SQLite's documents "File Locking and Concurrency", "Write-Ahead Logging" and "Database File Format".

use std::collections::BTreeMap;
use std::collections::btree_map::Entry;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

use rusqlite::backup::Backup;
use rusqlite::ffi;
use rusqlite::serialize::Data;
use rusqlite::{Connection, OpenFlags};

use super::connection::{address, begin, connect, pin};
use super::errors::read_error;
use super::recovery::PrivateCopy;
use super::stamp::{COPIED, PackageStamp, StateFailure, companion_path};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::files::{self, FileLock};
use burgeon_base::locks::LockRecovery;

/// Maximum time to wait for a program that writes.
const PATIENCE: Duration = Duration::from_secs(10);

/// Pause between two attempts.
const PAUSE: Duration = Duration::from_millis(10);

/// Number of the next copy in memory; these copies are shared within the process.
static COPIES: AtomicUsize = AtomicUsize::new(0);

/// States of the files that the readers of one budget have opened.
#[derive(Default)]
struct States(Mutex<BTreeMap<PathBuf, Arc<PackageState>>>);

/// Committed state of a database file.
pub struct PackageState {
    path: PathBuf,
    shown: String,
    address: String,
    key: Option<String>,
    keeper: Keeper,
    /// Stamps of the file and of its log before the state was read; `None` if a write at that moment could have had the same
    /// time.
    stamps: Option<FileStamps>,
}

/// Stamps of a database file and of its log.
type FileStamps = [Option<PackageStamp>; 2];

/// Mechanism that keeps a state unchanged.
enum Keeper {
    /// Connection that keeps a copy in memory.
    Copy { _memory: Mutex<Connection> },
    /// Read transaction on the file, and a connection outside the transaction that notices commits. The lock is dropped
    /// last.
    Lock { _transaction: Mutex<Connection>, observer: Mutex<Connection>, version: i64, _lock: FileLock },
    /// No lock: no program has the file open, and its time and size show if that changes.
    Stamp(PackageStamp),
}

impl PackageState {
    /// Returns the state of the file at `path`, called `shown` in messages. All readers of `budget` get the same state.
    ///
    /// Waits for programs that write, up to a limit; then fails with an error that the file is locked.
    pub fn open(path: &Path, shown: &str, budget: &Arc<Budget>) -> Result<Arc<Self>> {
        let states: Arc<States> = budget.share();
        let mut known = states.0.lock().recover();
        let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let state = match known.entry(path) {
            Entry::Occupied(known) => known.into_mut(),
            Entry::Vacant(unknown) => {
                let state = Self::wait(unknown.key(), shown, budget)?;
                unknown.insert(Arc::new(state))
            }
        };
        Ok(Arc::clone(state))
    }

    /// Returns the state that the readers of `budget` have opened, if any.
    pub fn opened(path: &Path, budget: &Budget) -> Option<Arc<Self>> {
        let states: Arc<States> = budget.share();
        let path = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let known = states.0.lock().recover();
        known.get(&path).map(Arc::clone)
    }

    /// Makes the readers of `budget` use this state, unless they have opened another one of the file.
    pub fn lend(self: &Arc<Self>, budget: &Budget) {
        let states: Arc<States> = budget.share();
        states.0.lock().recover().entry(self.path.clone()).or_insert_with(|| Arc::clone(self));
    }

    /// Returns true if the state is a copy in memory of a file that has not changed since it was copied.
    pub fn is_current_copy(&self) -> bool {
        matches!(self.keeper, Keeper::Copy { .. }) && self.stamps.is_some_and(|it| it == stamps(&self.path))
    }

    fn wait(path: &Path, shown: &str, budget: &Budget) -> Result<Self> {
        let begin = Instant::now();
        loop {
            let before = stamps(path);
            let is_settled = before.iter().flatten().all(PackageStamp::is_settled);
            match (Attempt { path, shown, budget }).state() {
                Ok(state) => return Ok(Self { stamps: is_settled.then_some(before), ..state }),
                Err(StateFailure::Final(error)) => return Err(error),
                Err(StateFailure::Busy) => {}
            }
            budget.check().map_err(|over| over.noting(&format!("another program has locked {shown}")))?;
            if begin.elapsed() > PATIENCE {
                return Err(Error::unavailable(format!(
                    "another program has locked {shown} and has been writing it for {} s",
                    PATIENCE.as_secs()
                ))
                .help("save and close the file there, and run again"));
            }
            std::thread::sleep(PAUSE);
        }
    }

    /// Returns the path of the file, without links.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Returns the address with which SQLite opens the state for reading.
    pub fn address(&self) -> &str {
        &self.address
    }

    /// Returns a key that is equal for states with equal content, if it can be determined.
    pub fn key(&self) -> Option<&str> {
        self.key.as_deref()
    }

    /// Reports whether another state is identical, or has the same file and the same content.
    pub fn is_same(&self, other: &Self) -> bool {
        std::ptr::eq(self, other) || self.path == other.path && self.key.is_some() && self.key == other.key
    }

    /// Reports whether a connection sees this state only within a transaction that [`pin`](Self::pin) has begun.
    pub fn is_locked(&self) -> bool {
        matches!(self.keeper, Keeper::Lock { .. })
    }

    /// Opens a connection that reads this state.
    pub fn connect(&self) -> Result<Connection> {
        let open = || -> rusqlite::Result<Connection> {
            let flags = OpenFlags::SQLITE_OPEN_READ_ONLY
                | OpenFlags::SQLITE_OPEN_NO_MUTEX
                | OpenFlags::SQLITE_OPEN_URI;
            let connection = Connection::open_with_flags(&self.address, flags)?;
            if self.is_locked() {
                connection.execute_batch("BEGIN")?;
            }
            Ok(connection)
        };
        let connection = open().map_err(|error| read_error(&self.shown, &error))?;
        self.pin(&connection, "main")?;
        Ok(connection)
    }

    /// Makes the transaction of a connection, in which the state is attached as `schema`, see this state. Fails if the
    /// file has changed.
    pub fn pin(&self, connection: &Connection, schema: &str) -> Result<()> {
        if self.is_locked() {
            pin(connection, schema).map_err(|error| match failure(error) {
                SqliteFailure::Busy => change_error(&self.shown),
                SqliteFailure::Unrecovered(error)
                | SqliteFailure::Unlockable(error)
                | SqliteFailure::Other(error) => read_error(&self.shown, &error),
            })?;
        }
        self.check()
    }

    /// Fails if the file has changed, because data read since the state was opened may then be from two states.
    pub fn check(&self) -> Result<()> {
        let same = match &self.keeper {
            Keeper::Copy { .. } => true,
            Keeper::Lock { observer, version, .. } => {
                data_version(&observer.lock().recover()).is_ok_and(|now| now == *version)
            }
            Keeper::Stamp(stamp) => PackageStamp::of(&self.path).as_ref() == Some(stamp),
        };
        if same { Ok(()) } else { Err(change_error(&self.shown)) }
    }
}

/// Returns the present stamps of the file at `path` and of its log.
fn stamps(path: &Path) -> FileStamps {
    [PackageStamp::of(path), PackageStamp::of(&companion_path(path, "-wal"))]
}

/// Returns a number that changes when another connection commits.
fn data_version(connection: &Connection) -> rusqlite::Result<i64> {
    connection.query_row("PRAGMA data_version", [], |row| row.get(0))
}

fn change_error(shown: &str) -> Error {
    Error::unavailable(format!("another program changed {shown} while Burgeon read it"))
        .help("save and close the file there, and run again")
}

/// SQLite error, by its remedy.
enum SqliteFailure {
    /// Error that waiting resolves.
    Busy,
    /// Error that needs a recovery with write access.
    Unrecovered(rusqlite::Error),
    /// Error of a file system without locks, where reading must do without them.
    Unlockable(rusqlite::Error),
    /// Error without a remedy.
    Other(rusqlite::Error),
}

fn failure(error: rusqlite::Error) -> SqliteFailure {
    let code = match &error {
        rusqlite::Error::SqliteFailure(code, _) => code.extended_code,
        _ => 0,
    };
    match code {
        ffi::SQLITE_READONLY_ROLLBACK
        | ffi::SQLITE_READONLY_RECOVERY
        | ffi::SQLITE_READONLY_CANTINIT
        | ffi::SQLITE_READONLY_CANTLOCK => SqliteFailure::Unrecovered(error),
        ffi::SQLITE_IOERR_LOCK
        | ffi::SQLITE_IOERR_RDLOCK
        | ffi::SQLITE_IOERR_CHECKRESERVEDLOCK
        | ffi::SQLITE_IOERR_SHMLOCK
        | ffi::SQLITE_IOERR_SHMMAP => SqliteFailure::Unlockable(error),
        code => match code & 0xff {
            ffi::SQLITE_BUSY | ffi::SQLITE_LOCKED | ffi::SQLITE_PROTOCOL => SqliteFailure::Busy,
            ffi::SQLITE_CANTOPEN => SqliteFailure::Unrecovered(error),
            _ => SqliteFailure::Other(error),
        },
    }
}

/// Attempt to get the state of a file.
struct Attempt<'a> {
    path: &'a Path,
    shown: &'a str,
    budget: &'a Budget,
}

impl Attempt<'_> {
    fn state(&self) -> std::result::Result<PackageState, StateFailure> {
        let Some(stamp) = PackageStamp::of(self.path) else {
            return Err(Error::file(self.path, format!("cannot read {}: the file was removed", self.shown))
                .help("check the path")
                .into());
        };
        let logged = PackageStamp::of(&companion_path(self.path, "-wal"));
        let shared = companion_path(self.path, "-shm").exists();
        match logged {
            // A program has the database open.
            Some(_) if shared => self.read_locked(stamp, true),
            // A program ended without closing the database, or the log was copied together with the file.
            Some(log) if log.length > 0 => match stamp.length > COPIED {
                true => self.read_locked(stamp, true),
                false => self.read_recovered("-wal"),
            },
            _ if self.is_logged()? => self.read_unlocked_file(stamp),
            _ => self.read_locked(stamp, false),
        }
    }

    /// Reports whether changes of the file are written to a log when a program opens it.
    fn is_logged(&self) -> Result<bool> {
        let mut head = Vec::new();
        let read = files::read_unlocked(self.path, |file, _| file.take(20).read_to_end(&mut head));
        let cannot = |error| Error::file(self.path, format!("cannot read {}: {error}", self.shown));
        // A database connection of this process that reads the file in place already holds its state.
        Ok(read.map_err(cannot)?.is_some() && head.get(18) == Some(&2))
    }

    /// Returns the state guarded by SQLite's locks.
    fn read_locked(
        &self,
        stamp: PackageStamp,
        logged: bool,
    ) -> std::result::Result<PackageState, StateFailure> {
        let lock = FileLock::announce(self.path)
            .map_err(|error| Error::file(self.path, format!("cannot read {}: {error}", self.shown)))?;
        let open = || -> rusqlite::Result<Option<(Connection, Connection, i64)>> {
            let observer = connect(self.path, "mode=ro")?;
            let version = data_version(&observer)?;
            let connection = connect(self.path, "mode=ro")?;
            begin(&connection)?;
            // The observer's number belongs to the state of the transaction if there was no commit in between.
            Ok((data_version(&observer)? == version).then_some((connection, observer, version)))
        };
        let (mut connection, observer, version) = match open().map_err(failure) {
            Ok(Some(opened)) => opened,
            Ok(None) => return Err(StateFailure::Busy),
            Err(SqliteFailure::Busy) => return Err(StateFailure::Busy),
            Err(SqliteFailure::Unlockable(_)) => {
                drop(lock);
                return self.read_unlocked_file(stamp);
            }
            Err(SqliteFailure::Unrecovered(error)) => {
                drop(lock);
                let suffix = if logged { "-wal" } else { "-journal" };
                return match PackageStamp::of(&companion_path(self.path, suffix)) {
                    Some(_) if stamp.length <= COPIED => self.read_recovered(suffix),
                    Some(_) => Err(StateFailure::Final(
                        Error::unavailable(format!(
                            "a program that wrote {} ended during a change",
                            self.shown
                        ))
                        .help(
                            "open the file once in that program, which then undoes the change, and run again",
                        ),
                    )),
                    // The writer has just closed the database.
                    None if logged => Err(StateFailure::Busy),
                    None => Err(read_error(self.shown, &error).into()),
                };
            }
            Err(SqliteFailure::Other(error)) => return Err(read_error(self.shown, &error).into()),
        };
        if stamp.length <= COPIED {
            let copied = self.copy(&mut connection);
            drop((connection, observer, lock));
            // This check detects writes even if locks do not work. A log may be written back at any time.
            if !logged && PackageStamp::of(self.path) != Some(stamp) {
                return Err(StateFailure::Busy);
            }
            return Ok(copied?);
        }
        let keeper = Keeper::Lock {
            _transaction: Mutex::new(connection),
            observer: Mutex::new(observer),
            version,
            _lock: lock,
        };
        let key = (!logged).then(|| format!("{stamp:?}"));
        Ok(self.new_state(address(self.path, "mode=ro"), key, keeper))
    }

    /// Creates the state of the file, which is read at `address`.
    fn new_state(&self, address: String, key: Option<String>, keeper: Keeper) -> PackageState {
        PackageState {
            path: self.path.to_path_buf(),
            shown: self.shown.to_owned(),
            address,
            key,
            keeper,
            stamps: None,
        }
    }

    /// Returns the state of a file that no program has open, or that cannot be locked.
    fn read_unlocked_file(&self, stamp: PackageStamp) -> std::result::Result<PackageState, StateFailure> {
        if !stamp.is_settled() {
            return Err(StateFailure::Busy);
        }
        if stamp.length > COPIED {
            let (address, key) = (address(self.path, "mode=ro&immutable=1"), format!("{stamp:?}"));
            return Ok(self.new_state(address, Some(key), Keeper::Stamp(stamp)));
        }
        let open = || -> rusqlite::Result<Connection> {
            let connection = connect(self.path, "mode=ro&immutable=1")?;
            begin(&connection)?;
            Ok(connection)
        };
        let lock = FileLock::announce(self.path)
            .map_err(|error| Error::file(self.path, format!("cannot read {}: {error}", self.shown)))?;
        let copied = open()
            .map_err(|error| read_error(self.shown, &error))
            .and_then(|mut connection| self.copy(&mut connection));
        drop(lock);
        if PackageStamp::of(self.path) != Some(stamp) {
            return Err(StateFailure::Busy);
        }
        Ok(copied?)
    }

    /// Returns the state after applying or rolling back the file with `suffix` next to the database.
    fn read_recovered(&self, suffix: &str) -> std::result::Result<PackageState, StateFailure> {
        let private = PrivateCopy::of(self.path, suffix, self.shown)?;
        let mut connection =
            private.connect().map_err(|error| StateFailure::Final(read_error(self.shown, &error)))?;
        Ok(self.copy(&mut connection)?)
    }

    /// Copies the state that a connection sees in its transaction.
    fn copy(&self, connection: &mut Connection) -> Result<PackageState> {
        let failed = |error: rusqlite::Error| {
            self.budget.check().err().unwrap_or_else(|| read_error(self.shown, &error))
        };
        let Data::Owned(mut bytes) = connection.serialize("main").map_err(failed)? else {
            return Err(Error::internal("a file is no database in memory"));
        };
        self.budget.reserve(bytes.len())?;
        // A copy in memory has no log.
        if let Some(versions) = bytes.get_mut(18..20) {
            versions.fill(1);
        }
        let key = content_key(&bytes);
        let copy = || -> rusqlite::Result<(Connection, String)> {
            let mut source = Connection::open_in_memory()?;
            source.deserialize("main", bytes, true)?;
            let number = COPIES.fetch_add(1, Ordering::Relaxed);
            let address = format!("file:/burgeon-state-{number}?vfs=memdb");
            let mut memory = Connection::open(&address)?;
            Backup::new(&source, &mut memory)?.step(-1)?;
            Ok((memory, address))
        };
        let (memory, address) = copy().map_err(failed)?;
        let keeper = Keeper::Copy { _memory: Mutex::new(memory) };
        Ok(self.new_state(format!("{address}&mode=ro"), Some(key), keeper))
    }
}

/// Returns the hash of a database, excluding the numbers that count its commits.
fn content_key(bytes: &[u8]) -> String {
    let mut hasher = blake3::Hasher::new();
    let head: Vec<u8> = bytes.iter().take(100).copied().collect();
    for range in [0..24, 28..92] {
        hasher.update(head.get(range).unwrap_or(&head));
    }
    hasher.update(bytes.get(100..).unwrap_or_default());
    hasher.finalize().to_hex().to_string()
}
