//! Unpacks packages from zip files. The metadata in a zip is not trusted.

use std::collections::BTreeSet;
use std::io::{BufReader, Read, Seek, SeekFrom};
use std::path::Path;

use burgeon_base::error::{Error, Limit, Result};
use zip::ZipArchive;

use super::copy::{LARGEST, MOST, PackageCopy, no_file};

/// Signature of an entry in a zip's central directory, and the length of an entry without its name and the fields after
/// it (bytes).
const ENTRY: &[u8; 4] = b"PK\x01\x02";
const ENTRY_LENGTH: usize = 46;

/// Bit mask of the file type in a mode, and the types of a regular file and of a link.
const KIND: u32 = 0o170_000;
const PLAIN: u32 = 0o100_000;
const LINK: u32 = 0o120_000;

/// Unpacks the zip `from`.
pub(crate) fn unpack(from: &Path, copy: &mut PackageCopy) -> Result<()> {
    let shown = from.display();
    let damaged = || {
        Error::data(format!("{shown} cannot be unpacked"))
            .help("specify a zip, or the folder that contains the mod.toml; if the zip is damaged, download it again")
    };
    let (file, meta) = burgeon_base::files::open(from).map_err(|error| {
        Error::file(from, format!("cannot read {shown}: {error}")).help("specify a folder or a zip")
    })?;
    if meta.len() > LARGEST {
        return Err(Error::limit(Limit::Size, format!("{shown} has more than {} MB", LARGEST / 1_000_000))
            .help("reduce the size of the package"));
    }
    let mut archive = ZipArchive::new(BufReader::new(file)).map_err(|_| damaged())?;
    if archive.len() > MOST {
        return Err(Error::limit(Limit::Size, format!("{shown} has more than {MOST} files and folders"))
            .help("remove files that scripts do not need"));
    }
    let (mut file, _) = burgeon_base::files::open(from).map_err(|_| damaged())?;
    let names = entry_names(&mut file, archive.central_directory_start()).ok_or_else(damaged)?;
    let mut known = BTreeSet::new();
    if let Some(twice) = names.iter().find(|name| !known.insert(*name)) {
        let name = String::from_utf8_lossy(twice);
        return Err(Error::data(format!("{shown} has {} twice", name.escape_debug()))
            .help("this package is unsafe; do not use it"));
    }
    if names.len() != archive.len() {
        return Err(damaged());
    }
    for index in 0..archive.len() {
        let mut entry = archive.by_index(index).map_err(|error| match error {
            zip::result::ZipError::UnsupportedArchive(zip::result::ZipError::PASSWORD_REQUIRED) => {
                Error::data(format!("{shown} needs a password")).help("unpack it, and specify its folder")
            }
            zip::result::ZipError::UnsupportedArchive(_) => {
                Error::data(format!("{shown} has an unsupported compression"))
                    .help("unpack it, and specify its folder")
            }
            _ => damaged(),
        })?;
        let name = std::str::from_utf8(entry.name_raw())
            .map_err(|_| {
                Error::data(format!("{shown} has a file with a name that is not valid text"))
                    .help("rename it")
            })?
            .to_owned();
        let kind = entry.unix_mode().map_or(PLAIN, |mode| mode & KIND);
        match name.strip_suffix('/') {
            // A folder is created with its first file, but its name must be valid anyway.
            Some(folder) => copy.check_folder(from, folder)?,
            None if kind == PLAIN || kind == 0 => copy.add(from, &name, &mut entry)?,
            None => return Err(no_file(from, &name, kind == LINK)),
        }
    }
    Ok(())
}

/// Returns the names in the central directory of a zip, which begins at `start`. Repeated names are kept. Stops after
/// slightly more than [`MOST`] names.
fn entry_names(file: &mut std::fs::File, start: u64) -> Option<Vec<Vec<u8>>> {
    file.seek(SeekFrom::Start(start)).ok()?;
    let mut file = BufReader::new(file);
    let mut names = Vec::new();
    while names.len() <= MOST {
        let mut head = [0; ENTRY_LENGTH];
        // The record that ends the directory is shorter than an entry.
        if file.read_exact(&mut head[..4]).is_err() || head[..4] != *ENTRY {
            break;
        }
        file.read_exact(&mut head[4..]).ok()?;
        let length = |at: usize| usize::from(u16::from_le_bytes([head[at], head[at + 1]]));
        let mut name = vec![0; length(28)];
        file.read_exact(&mut name).ok()?;
        let mut rest = vec![0; length(30) + length(32)];
        file.read_exact(&mut rest).ok()?;
        names.push(name);
    }
    Some(names)
}
