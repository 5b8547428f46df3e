//! Blobs of an extract, and their decompression.

use std::fs::File;
use std::io::{Read, Seek, SeekFrom};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, MutexGuard, OnceLock};

use flate2::{Decompress, FlushDecompress, Status};

use super::wire::{WireDamage, WireField, WireFields};
use crate::formats::packed::{DEFLATED, can_hold};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;

/// Maximum size (bytes) of a blob's header, and of a blob, compressed or not, according to the format.
const LARGEST_HEADER: usize = 64 << 10;
const LARGEST: usize = 32 << 20;

/// Maximum number of decompressed bytes that are cached.
const KEPT: usize = 64 << 20;

/// Memory needed while a block is processed, per byte of the block.
const AROUND: usize = 8;

/// Required features (as declared in a file's header) that this reader supports.
const KNOWN: [&str; 2] = ["OsmSchema-V0.6", "DenseNodes"];

/// File of blobs.
pub(super) struct BlobFile {
    /// File on disk; `None` if all blocks are in memory.
    file: Option<Mutex<File>>,
    name: String,
    blobs: Vec<Blob>,
    /// Number of cached bytes of blocks.
    kept: AtomicUsize,
}

struct Blob {
    at: u64,
    size: usize,
    unpacked: OnceLock<Vec<u8>>,
}

/// Returns true if a file that begins with `head` is an extract.
pub(super) fn is_packed_extract(head: &[u8]) -> bool {
    head.get(4..15).is_some_and(|found| found == b"\x0a\x09OSMHeader")
}

impl BlobFile {
    /// Finds the blobs of `file` and checks its header. Fails if the file is truncated or requires unsupported
    /// features.
    pub(super) fn open(file: File, name: &str, budget: &Budget) -> Result<Self> {
        let mut found = Self {
            file: Some(Mutex::new(file)),
            name: name.to_owned(),
            blobs: Vec::new(),
            kept: AtomicUsize::new(0),
        };
        let mut header = None;
        let mut at = 0;
        while let Some((kind, begin, size)) = found.head(at, budget)? {
            at = begin + size as u64;
            budget.take(size_of::<Blob>())?;
            let blob = Blob { at: begin, size, unpacked: OnceLock::new() };
            match (&*kind, header.is_some()) {
                (b"OSMHeader", false) => header = Some(blob),
                (b"OSMData", true) => found.blobs.push(blob),
                // Blobs of other types are for other programs.
                _ => {}
            }
        }
        let header = header.ok_or_else(|| found.damage_error("it has no header"))?;
        found.look(&header, budget, |bytes| found.check(bytes))?;
        Ok(found)
    }

    /// Creates a file from blocks that were converted from another format.
    pub(super) fn of_blocks(blocks: Vec<Vec<u8>>, name: &str) -> Self {
        let blobs = (0..).zip(blocks).map(|(at, block)| {
            let size = block.len();
            Blob { at, size, unpacked: OnceLock::from(block) }
        });
        Self { file: None, name: name.to_owned(), blobs: blobs.collect(), kept: AtomicUsize::new(0) }
    }

    /// Locks the file for one reader at a time.
    fn file(&self) -> Result<MutexGuard<'_, File>> {
        let file = self.file.as_ref().ok_or_else(|| Error::internal("a block is missing"))?;
        Ok(file.lock().recover())
    }

    /// Returns the number of blocks.
    pub(super) fn len(&self) -> usize {
        self.blobs.len()
    }

    /// Returns the error for damaged bytes.
    pub(super) fn damage_error(&self, why: &str) -> Error {
        Error::data(format!("{} cannot be read: {why}", self.name))
            .help("the file is damaged or cut short; download it again")
    }

    /// Reads the header of the blob at `at`; returns its type, the start of its content, and its size. Returns `None`
    /// at the end.
    fn head(&self, at: u64, budget: &Budget) -> Result<Option<(Vec<u8>, u64, usize)>> {
        budget.tick()?;
        let mut file = self.file()?;
        let ends = |_| self.damage_error(&format!("the blob at byte {at} is cut short"));
        let end = file.seek(SeekFrom::End(0)).map_err(ends)?;
        if at == end {
            return Ok(None);
        }
        file.seek(SeekFrom::Start(at)).map_err(ends)?;
        let mut length = [0; 4];
        file.read_exact(&mut length).map_err(ends)?;
        let length = u32::from_be_bytes(length) as usize;
        if length > LARGEST_HEADER {
            return Err(self.damage_error(&format!("the blob at byte {at} has a header of {length} bytes")));
        }
        let mut header = vec![0; length];
        file.read_exact(&mut header).map_err(ends)?;
        let (mut kind, mut size) = (&[][..], None);
        for field in WireFields(&header) {
            let wrong = |why| self.damage_error(&format!("the header of the blob at byte {at} {why}"));
            match field.map_err(wrong)? {
                (1, field) => kind = field.bytes().map_err(wrong)?,
                (3, field) => size = Some(field.number().map_err(wrong)?),
                _ => {}
            }
        }
        let begin = at + 4 + length as u64;
        let size = size.and_then(|size| usize::try_from(size).ok()).filter(|size| *size <= LARGEST);
        let Some(size) = size else {
            return Err(self.damage_error(&format!("the blob at byte {at} has an invalid size")));
        };
        if end - begin < size as u64 {
            return Err(self.damage_error(&format!("the blob at byte {at} is cut short")));
        }
        Ok(Some((kind.to_vec(), begin, size)))
    }

    /// Calls `work` with the bytes of the block `index`.
    pub(super) fn block<T>(
        &self,
        index: usize,
        budget: &Budget,
        work: impl FnOnce(&[u8]) -> Result<T, WireDamage>,
    ) -> Result<T> {
        let blob = &self.blobs[index];
        self.look(blob, budget, |bytes| {
            work(bytes).map_err(|why| {
                // The error may be an exceeded time limit instead of a damaged block.
                budget
                    .check()
                    .err()
                    .unwrap_or_else(|| self.damage_error(&format!("the block at byte {} {why}", blob.at)))
            })
        })
    }

    fn look<T>(&self, blob: &Blob, budget: &Budget, work: impl FnOnce(&[u8]) -> Result<T>) -> Result<T> {
        budget.check()?;
        if let Some(bytes) = blob.unpacked.get() {
            let _held = budget.hold(bytes.len() * AROUND)?;
            return work(bytes);
        }
        let mut packed = vec![0; blob.size];
        {
            let mut file = self.file()?;
            let read = file.seek(SeekFrom::Start(blob.at)).and_then(|_| file.read_exact(&mut packed));
            read.map_err(|error| self.damage_error(&error.to_string()))?;
        }
        let wrong = |why: WireDamage| self.damage_error(&format!("the blob at byte {} {why}", blob.at));
        let (content, size) = self.content(&packed).map_err(wrong)?.map_err(|packing| {
            Error::data(format!("{} is compressed with {packing}, which is not supported", self.name))
                .help("re-export it: osmium cat IN.osm.pbf -o OUT.osm.pbf -f pbf,pbf_compression=zlib")
        })?;
        let _held = budget.hold(size * (AROUND + 1))?;
        let bytes = match content {
            BlobContent::Plain(bytes) => bytes.to_vec(),
            BlobContent::Deflated(bytes) => inflate(bytes, size).map_err(wrong)?,
        };
        let result = work(&bytes)?;
        let before = self.kept.fetch_add(size, Ordering::Relaxed);
        if before + size <= KEPT && budget.take(size).is_ok() {
            // If another thread was faster, its copy is kept.
            let _ = blob.unpacked.set(bytes);
        }
        Ok(result)
    }

    /// Returns the content of a blob and its decompressed size, or the name of an unsupported compression.
    fn content<'a>(
        &self,
        blob: &'a [u8],
    ) -> Result<Result<(BlobContent<'a>, usize), &'static str>, WireDamage> {
        let (mut content, mut size) = (None, None);
        for field in WireFields(blob) {
            match field? {
                (1, field) => content = Some(BlobContent::Plain(field.bytes()?)),
                (2, field) => size = Some(field.number()?),
                (3, field) => content = Some(BlobContent::Deflated(field.bytes()?)),
                (4, WireField::Bytes(_)) => return Ok(Err("LZMA")),
                (5, WireField::Bytes(_)) => return Ok(Err("bzip2")),
                (6, WireField::Bytes(_)) => return Ok(Err("LZ4")),
                (7, WireField::Bytes(_)) => return Ok(Err("Zstandard")),
                _ => {}
            }
        }
        let content = content.ok_or("is empty")?;
        let size = match content {
            BlobContent::Plain(bytes) => bytes.len(),
            BlobContent::Deflated(packed) => {
                let size =
                    size.and_then(|size| usize::try_from(size).ok()).ok_or("does not declare its size")?;
                if size > LARGEST || !can_hold(packed.len(), DEFLATED, size) {
                    return Err("declares more than the maximum size");
                }
                size
            }
        };
        Ok(Ok((content, size)))
    }

    /// Fails if the header block requires an unsupported feature.
    fn check(&self, header: &[u8]) -> Result<()> {
        for field in WireFields(header) {
            let field = field.and_then(|(number, field)| if number == 4 { field.bytes() } else { Ok(&[]) });
            let needed = field.map_err(|why| self.damage_error(&format!("its header {why}")))?;
            if needed == b"HistoricalInformation" {
                return Err(Error::data(format!("{} contains the history of its features", self.name))
                    .help("extract the present state: osmium time-filter IN.osh.pbf -o OUT.osm.pbf"));
            }
            if !needed.is_empty() && !KNOWN.iter().any(|known| known.as_bytes() == needed) {
                let needed = String::from_utf8_lossy(needed);
                let needed = burgeon_base::text::shown(&needed);
                return Err(Error::data(format!("{} needs \"{needed}\", which is not supported", self.name))
                    .help("re-export it: osmium cat IN.osm.pbf -o OUT.osm.pbf"));
            }
        }
        Ok(())
    }
}

enum BlobContent<'a> {
    Plain(&'a [u8]),
    Deflated(&'a [u8]),
}

/// Decompresses bytes whose decompressed size must be exactly `size`.
fn inflate(packed: &[u8], size: usize) -> Result<Vec<u8>, WireDamage> {
    // One additional byte, to detect streams that are longer than declared.
    let mut bytes = Vec::with_capacity(size + 1);
    let mut stream = Decompress::new(true);
    let status = stream.decompress_vec(packed, &mut bytes, FlushDecompress::Finish);
    match status {
        Ok(Status::StreamEnd) if bytes.len() == size => Ok(bytes),
        _ => Err("cannot be unpacked"),
    }
}
