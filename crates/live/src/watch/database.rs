//! Committed content of an SQLite database, from the file and the log next to it.
//!
//! A program that keeps a database open in WAL mode writes its changes into the log, and transfers them to the file
//! later (checkpoint). The content is the same before and after a checkpoint.
//!
//! Source: SQLite's document "Database File Format", section 4.

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::Read;
use std::path::{Path, PathBuf};

/// Signature at the beginning of a database.
const MAGIC: &[u8] = b"SQLite format 3\0";

/// Length (bytes) of a log's header, and of a frame's header.
const HEADS: [usize; 2] = [32, 24];

/// File name suffixes of the files next to a database.
pub(super) const SUFFIXES: [&str; 2] = ["-wal", "-journal"];

/// Returns true if `bytes` are a database.
pub(super) fn is_one(bytes: &[u8]) -> bool {
    bytes.starts_with(MAGIC)
}

/// Returns the path of the file next to `path` with the additional `suffix`.
pub(super) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name: OsString = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

/// Returns true if the database at `path` is in the middle of a transaction that a journal can roll back.
pub(super) fn is_changing(path: &Path) -> bool {
    let mut first = [0; 1];
    let read = std::fs::File::open(beside(path, "-journal")).and_then(|mut file| file.read_exact(&mut first));
    // A journal that is kept for the next transaction begins with zeros.
    read.is_ok() && first != [0]
}

/// Returns the hash of the committed content of a database, whose file and log contain these bytes.
///
/// Commit counters and the version number of SQLite are excluded.
pub(super) fn content(file: &[u8], log: &[u8]) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    let Some(pages) = LogPages::read(log) else {
        hash_page(&mut hasher, 1, file);
        return hasher.finalize();
    };
    for number in 1..=pages.count {
        let begin = (number as usize - 1) * pages.size;
        let page = match pages.places.get(&number) {
            Some(place) => log.get(*place..place + pages.size),
            None => file.get(begin..(begin + pages.size).min(file.len())),
        };
        hash_page(&mut hasher, number, page.unwrap_or_default());
    }
    hasher.finalize()
}

fn hash_page(hasher: &mut blake3::Hasher, number: u32, page: &[u8]) {
    if number != 1 || page.len() < 100 {
        hasher.update(page);
        return;
    }
    for range in [0..18, 20..24, 28..92] {
        hasher.update(&page[range]);
    }
    hasher.update(&page[100..]);
}

/// Pages that a log has committed.
struct LogPages {
    /// Size of a page (bytes).
    size: usize,
    /// Number of pages of the database.
    count: u32,
    /// Offset of the last version of each page (bytes).
    places: BTreeMap<u32, usize>,
}

impl LogPages {
    fn read(log: &[u8]) -> Option<Self> {
        let word = |at: usize| Some(u32::from_be_bytes(log.get(at..at + 4)?.try_into().ok()?));
        let magic = word(0)?;
        if magic & !1 != 0x377f_0682 {
            return None;
        }
        let size = usize::try_from(word(8)?).ok().filter(|size| (512..=65_536).contains(size))?;
        let (salts, big) = ([word(16)?, word(20)?], magic & 1 == 1);
        let mut sum = checksum([0; 2], log.get(..24)?, big);
        if sum != [word(24)?, word(28)?] {
            return None;
        }
        let mut pages = Self { size, count: 0, places: BTreeMap::new() };
        let (mut open, mut at) = (Vec::new(), HEADS[0]);
        while let Some(page) = log.get(at + HEADS[1]..at + HEADS[1] + size) {
            if [word(at + 8)?, word(at + 12)?] != salts {
                break;
            }
            sum = checksum(checksum(sum, &log[at..at + 8], big), page, big);
            if sum != [word(at + 16)?, word(at + 20)?] {
                break;
            }
            open.push((word(at)?, at + HEADS[1]));
            let count = word(at + 4)?;
            if count > 0 {
                pages.count = count;
                pages.places.extend(open.drain(..));
            }
            at += HEADS[1] + size;
        }
        (pages.count > 0).then_some(pages)
    }
}

fn checksum(mut sum: [u32; 2], bytes: &[u8], big: bool) -> [u32; 2] {
    let read = |word: &[u8]| {
        let word = word.try_into().unwrap_or_default();
        if big { u32::from_be_bytes(word) } else { u32::from_le_bytes(word) }
    };
    for pair in bytes.chunks_exact(8) {
        sum[0] = sum[0].wrapping_add(read(&pair[..4])).wrapping_add(sum[1]);
        sum[1] = sum[1].wrapping_add(read(&pair[4..])).wrapping_add(sum[0]);
    }
    sum
}
