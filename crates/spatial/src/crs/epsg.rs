//! EPSG registry of coordinate systems, compressed by `build.rs` in blocks, with one line per system.

use std::io::Read;
use std::ops::Range;
use std::sync::Mutex;

use flate2::read::DeflateDecoder;

use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;

/// Compressed blocks, in sequence.
static PACKED: &[u8] = include_bytes!(concat!(env!("OUT_DIR"), "/epsg.deflate"));

/// First code in each block, and the block's byte range.
static BLOCKS: &[(u16, Range<usize>)] = include!(concat!(env!("OUT_DIR"), "/epsg.rs"));

/// Coordinate system in the registry.
#[derive(Clone)]
pub(super) struct EpsgEntry {
    /// EPSG code.
    pub(super) code: u16,
    /// PROJ definition.
    pub(super) proj: String,
    /// Definition in well-known text.
    pub(super) text: String,
}

/// Coordinate systems that were found last, because a program uses few and unpacking a block takes long.
static RECENT: Mutex<Vec<EpsgEntry>> = Mutex::new(Vec::new());

/// Maximum number of these coordinate systems.
const MOST_RECENT: usize = 8;

/// Returns the coordinate system with a code, if the registry contains it.
pub(super) fn entry(code: u32) -> Result<Option<EpsgEntry>> {
    let Ok(code) = u16::try_from(code) else { return Ok(None) };
    if let Some(known) = RECENT.lock().recover().iter().find(|known| known.code == code) {
        return Ok(Some(known.clone()));
    }
    let found = unpack(code)?;
    if let Some(found) = &found {
        let mut recent = RECENT.lock().recover();
        recent.truncate(MOST_RECENT - 1);
        recent.insert(0, found.clone());
    }
    Ok(found)
}

/// Unpacks the coordinate system with a code.
fn unpack(code: u16) -> Result<Option<EpsgEntry>> {
    let behind = BLOCKS.partition_point(|(first, _)| *first <= code);
    let Some((_, place)) = behind.checked_sub(1).and_then(|block| BLOCKS.get(block)) else { return Ok(None) };
    let lines = block(place)?;
    Ok(lines.lines().find_map(|line| {
        let mut parts = line.splitn(3, '\t');
        let found = parts.next()?.parse().ok().filter(|found| *found == code)?;
        Some(EpsgEntry { code: found, proj: parts.next()?.into(), text: parts.next()?.into() })
    }))
}

/// Calls `each` with the code and the well-known text of each coordinate system, by increasing code.
pub(super) fn for_each(mut each: impl FnMut(u16, &str)) -> Result<()> {
    for (_, place) in BLOCKS {
        for line in block(place)?.lines() {
            let mut parts = line.splitn(3, '\t');
            let code = parts.next().and_then(|code| code.parse().ok());
            if let (Some(code), Some(text)) = (code, parts.nth(1)) {
                each(code, text);
            }
        }
    }
    Ok(())
}

/// Returns the lines of a block.
fn block(place: &Range<usize>) -> Result<String> {
    let mut lines = String::new();
    DeflateDecoder::new(&PACKED[place.clone()]).read_to_string(&mut lines).map_err(|error| {
        Error::data(format!("the registry of coordinate systems cannot be read: {error}"))
    })?;
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_packed_registry_has_every_entry_of_the_published_one() {
        let mut count = 0;
        for code in 0..=u16::MAX {
            let published = crs_definitions::from_code(code);
            // Each lookup unpacks a block, so only a sample of the codes is tested.
            if published.is_none() && code % 64 != 0 {
                continue;
            }
            let entry = entry(u32::from(code)).unwrap();
            assert_eq!(
                entry.map(|found| (found.code, found.proj, found.text)),
                published.map(|found| (found.code, found.proj4.to_owned(), found.wkt.to_owned())),
            );
            count += usize::from(published.is_some());
        }
        assert!(count > 6000, "{count}");
        assert!(entry(70_000).unwrap().is_none());
    }
}
