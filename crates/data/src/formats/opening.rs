//! Detection of the format from the first bytes of a file, and opening of the file.

use super::city::CityJson;
use super::csv::CsvFile;
use super::gml::GmlFile;
use super::gpx::GpxFile;
use super::kml::KmlFile;
use super::shapefile::Shapefile;
use super::unpack::{ZippedFiles, gunzip};
use super::xml::root_name;
use crate::content::DataFile;
use crate::layered_file::LayeredFile;
use crate::source_options::SourceOptions;
use burgeon_base::error::{Error, Result};

/// Open file with layers, or the file itself if its format is another.
type OpenResult = std::result::Result<Box<dyn LayeredFile>, DataFile>;

fn boxed(file: impl LayeredFile + 'static) -> OpenResult {
    Ok(Box::new(file))
}

/// Opens a file that begins with `head`.
pub(crate) fn open_layers(file: DataFile, head: &[u8], wanted: &SourceOptions) -> Result<OpenResult> {
    if Shapefile::is_one(head) {
        return Ok(boxed(Shapefile::open(file)?));
    }
    if CityJson::is_one(head) {
        return Ok(boxed(CityJson::open(file, wanted)?));
    }
    if let Some(root) = root_name(head) {
        return Ok(match root.as_str() {
            "osmChange" => {
                return Err(Error::data(format!(
                    "{} contains OpenStreetMap changes, not an extract",
                    file.name
                ))
                .help("apply them to an extract: osmium apply-changes IN.osm.pbf FILE -o OUT.osm.pbf"));
            }
            root if KmlFile::is_one(root) => boxed(KmlFile::open(file)),
            root if GpxFile::is_one(root) => boxed(GpxFile::open(file, wanted)?),
            "html" => {
                return Err(Error::data(format!("{} is a web page, not data", file.name))
                    .help("the download failed, or needs a login; download it again"));
            }
            _ => boxed(GmlFile::open(file, wanted)?),
        });
    }
    let is_text = !head.trim_ascii_start().starts_with(b"{") && !head.contains(&0);
    if CsvFile::is_named_so(&file) && is_text {
        return Ok(boxed(CsvFile::open(file)));
    }
    Ok(Err(file))
}

/// Opens a compressed file: returns the shapefiles in it, or the unpacked data file. Returns other files unchanged.
pub(crate) fn unpack_file(file: DataFile, head: &[u8], wanted: &SourceOptions) -> Result<OpenResult> {
    if head.starts_with(b"\x1f\x8b") {
        return Ok(Err(gunzip(file, wanted)?));
    }
    if head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06") {
        let zip = ZippedFiles::open(&file, wanted)?;
        return Ok(match Shapefile::in_zip(&zip, &file.name, &wanted.budget)? {
            Some(found) => boxed(found),
            None => Err(zip.only(&wanted.budget)?),
        });
    }
    Ok(Err(file))
}
