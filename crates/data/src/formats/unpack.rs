//! Decompression of `.gz` files and of data files in `.zip` files.

use std::io::{Cursor, Read};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use flate2::read::MultiGzDecoder;

use super::packed::{DEFLATED, can_hold};
use crate::content::{Content, DataFile};
use crate::source_options::SourceOptions;
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Limit, Result};
use burgeon_base::text::{listed, shown};

/// Maximum size (bytes) of a file, compressed and decompressed.
const LARGEST_PACKED: u64 = 1_000_000_000;
const LARGEST: usize = 2_000_000_000;

/// Number of bytes that are decompressed at a time.
const PIECE: usize = 1 << 20;

/// Maximum number of files in a zip file.
const MOST_FILES: usize = 100_000;

fn damage_error(name: &str) -> Error {
    Error::data(format!("{name} cannot be unpacked"))
        .help("the file is damaged or cut short; download it again")
}

/// Decompresses the data from `packed`, counted in the memory budget.
fn unpack(mut packed: impl Read, name: &str, budget: &Budget) -> Result<Arc<[u8]>> {
    let mut bytes = Vec::new();
    loop {
        budget.check()?;
        // Memory is reserved before it is allocated; a vector may allocate twice its length.
        let held = budget.hold(2 * (bytes.len() + PIECE))?;
        let count =
            (&mut packed).take(PIECE as u64).read_to_end(&mut bytes).map_err(|_| damage_error(name))?;
        if bytes.len() > LARGEST {
            let what = format!("{name} is larger than {} MB when it is unpacked", LARGEST / 1_000_000);
            return Err(Error::limit(Limit::Size, what).help("unpack it, and extract a part of it"));
        }
        if count == 0 {
            drop(held);
            budget.take(bytes.len())?;
            return Ok(bytes.into());
        }
    }
}

/// Decompresses a gzip file.
pub(crate) fn gunzip(file: DataFile, wanted: &SourceOptions) -> Result<DataFile> {
    let cannot =
        |error: std::io::Error| Error::file(&file.path, format!("cannot read {}: {error}", file.name));
    let packed = file.content.reader().map_err(cannot)?;
    let bytes = unpack(MultiGzDecoder::new(packed), &file.name, &wanted.budget)?;
    // town.geojson.gz becomes town.geojson.
    let path = match file.extension().as_str() {
        "gz" | "gzip" => file.path.with_extension(""),
        "tgz" => file.path.with_extension("tar"),
        _ => file.path,
    };
    Ok(DataFile { content: Content::Memory(bytes), path, name: file.name })
}

/// Zip file, with the names of its files.
pub(crate) struct ZippedFiles {
    bytes: Arc<[u8]>,
    name: String,
    path: PathBuf,
    pub(crate) names: Vec<String>,
}

impl ZippedFiles {
    pub(crate) fn open(file: &DataFile, wanted: &SourceOptions) -> Result<Self> {
        let bytes = file.bytes(LARGEST_PACKED, &wanted.budget)?;
        let archive = zip::ZipArchive::new(Cursor::new(&bytes)).map_err(|_| damage_error(&file.name))?;
        if archive.len() > MOST_FILES {
            return Err(Error::data(format!("{} contains {} files", file.name, archive.len()))
                .help("unpack it, and specify the data file itself"));
        }
        let mut names: Vec<String> = archive.file_names().map(str::to_owned).collect();
        // The macOS Finder adds resource fork files.
        names.retain(|name| !name.ends_with('/') && !name.starts_with("__MACOSX/"));
        names.sort();
        Ok(Self { bytes, name: file.name.clone(), path: file.path.clone(), names })
    }

    /// Returns the names with one of some extensions, ignoring case.
    pub(crate) fn with_extensions(&self, extensions: &[&str]) -> Vec<&str> {
        let ends = |name: &&str| {
            let extension =
                Path::new(name).extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
            extensions.contains(&&*extension)
        };
        self.names.iter().map(String::as_str).filter(ends).collect()
    }

    /// Unpacks one of the files.
    pub(crate) fn file(&self, name: &str, budget: &Budget) -> Result<DataFile> {
        let shown = format!("{} in {}", shown(name), self.name);
        let mut archive =
            zip::ZipArchive::new(Cursor::new(&self.bytes)).map_err(|_| damage_error(&self.name))?;
        let entry = archive.by_name(name).map_err(|_| damage_error(&shown))?;
        let (packed, size) = (entry.compressed_size(), entry.size());
        let [packed, size] = [packed, size].map(|size| usize::try_from(size).unwrap_or(usize::MAX));
        if packed > self.bytes.len() || !can_hold(packed, DEFLATED, size) {
            return Err(damage_error(&shown));
        }
        let bytes = unpack(entry, &shown, budget)?;
        let path = self.path.with_file_name(Path::new(name).file_name().unwrap_or_default());
        Ok(DataFile { content: Content::Memory(bytes), path, name: self.name.clone() })
    }

    /// Unpacks the only data file, which is not a shapefile. Fails if there is none, or if there are several.
    pub(crate) fn only(&self, budget: &Budget) -> Result<DataFile> {
        if self.names.iter().any(|name| name.contains(".gdb/")) {
            return Err(Error::data(format!(
                "{} contains a File Geodatabase (.gdb), which is not supported",
                self.name
            ))
            .help("convert it: ogr2ogr out.gpkg FILE.zip"));
        }
        let office = [
            ("xl/workbook.xml", "spreadsheet"),
            ("content.xml", "spreadsheet"),
            ("word/document.xml", "document"),
        ];
        if let Some((_, what)) = office.iter().find(|(part, _)| self.names.iter().any(|name| name == part)) {
            return Err(Error::data(format!("{} is a {what}, which is not supported", self.name)).help(
                "save its table as .csv, with columns of longitude and latitude or of well-known text",
            ));
        }
        // The main file of a KMZ file, whatever else it contains.
        let main = self.names.iter().find(|name| name.eq_ignore_ascii_case("doc.kml"));
        let found = match main {
            Some(main) => vec![main.as_str()],
            None => {
                // Data files may be accompanied by descriptions.
                let (descriptions, data): (Vec<&str>, Vec<&str>) = crate::EXTENSIONS
                    .into_iter()
                    .filter(|extension| !matches!(*extension, "zip" | "gz" | "kmz"))
                    .partition(|extension| matches!(*extension, "xml" | "json"));
                let found = self.with_extensions(&data);
                if found.is_empty() { self.with_extensions(&descriptions) } else { found }
            }
        };
        match found[..] {
            [one] => self.file(one, budget),
            [] if !self.with_extensions(&["hgt", "tif", "asc"]).is_empty() => {
                Err(Error::data(format!("{} contains heights, not features", self.name))
                    .help("read heights with elevation(\"N43E007.hgt.zip\")"))
            }
            [] => Err(Error::data(format!("{} is a zip without a data file", self.name)).help(
                "it can contain one or several shapefiles, or one .kml, .geojson, .gml, .csv or similar file",
            )),
            _ => Err(Error::data(format!(
                "{} contains several data files: {}",
                self.name,
                listed(found.iter().copied())
            ))
            .help("unpack it, and specify one of them")),
        }
    }
}
