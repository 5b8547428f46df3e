//! Detection of the format from the first bytes of a file, and opening of the file.

use super::city::CityJson;
use super::csv::CsvFile;
use super::gml::GmlFile;
use super::gpx::GpxFile;
use super::kml::KmlFile;
use super::osm::OsmFile;
use super::shapefile::Shapefile;
use super::unpack::{ZippedFiles, gunzip};
use crate::SourceOptions;
use crate::content::{DataFile, LayeredFile};
use crate::source::Source;
use burgeon_base::error::{Error, Result};

/// Open file with layers, or the file itself if its format is another.
pub(crate) type OpenResult = std::result::Result<Source, DataFile>;

fn layered_source(file: impl LayeredFile + 'static) -> OpenResult {
    Ok(Source::Layered(Box::new(file)))
}

/// Opens a file that begins with `head`.
pub(crate) fn layered(file: DataFile, head: &[u8], wanted: &SourceOptions) -> Result<OpenResult> {
    if Shapefile::is_one(head) {
        return Ok(layered_source(Shapefile::open(file)?));
    }
    if CityJson::is_one(head) {
        return Ok(layered_source(CityJson::open(file, wanted)?));
    }
    if let Some(root) = root(head) {
        return Ok(match root.as_str() {
            root if super::osm::is_xml(root) => Ok(Source::Osm(OsmFile::open_xml(&file, wanted)?)),
            "osmChange" => {
                return Err(Error::data(format!(
                    "{} holds changes of OpenStreetMap, not an extract",
                    file.name
                ))
                .help("apply them to an extract: osmium apply-changes IN.osm.pbf FILE -o OUT.osm.pbf"));
            }
            root if KmlFile::is_one(root) => layered_source(KmlFile::open(file)),
            root if GpxFile::is_one(root) => layered_source(GpxFile::open(file, wanted)?),
            "html" => {
                return Err(Error::data(format!("{} is a web page, not data", file.name))
                    .help("the download failed, or needs a login; get it again"));
            }
            _ => layered_source(GmlFile::open(file, wanted)?),
        });
    }
    let is_text = !head.trim_ascii_start().starts_with(b"{") && !head.contains(&0);
    if CsvFile::is_named_so(&file) && is_text {
        return Ok(layered_source(CsvFile::open(file)));
    }
    Ok(Err(file))
}

/// Opens a compressed file: returns the shapefiles in it, or the unpacked data file. Returns other files unchanged.
pub(crate) fn unpacked(file: DataFile, head: &[u8], wanted: &SourceOptions) -> Result<OpenResult> {
    if head.starts_with(b"\x1f\x8b") {
        return Ok(Err(gunzip(file, wanted)?));
    }
    if head.starts_with(b"PK\x03\x04") || head.starts_with(b"PK\x05\x06") {
        let zip = ZippedFiles::open(&file, wanted)?;
        return Ok(match Shapefile::in_zip(&zip, &file.name, &wanted.budget)? {
            Some(found) => layered_source(found),
            None => Err(zip.only(&wanted.budget)?),
        });
    }
    Ok(Err(file))
}

/// Returns the local name of the root element of an XML file that begins with `head`; empty if the root begins later.
/// Returns `None` if the file is not XML.
fn root(head: &[u8]) -> Option<String> {
    let text = String::from_utf8_lossy(head.strip_prefix(b"\xef\xbb\xbf").unwrap_or(head));
    let mut rest = text.trim_start();
    if !rest.starts_with('<') {
        return None;
    }
    loop {
        let behind = |end: &str| rest.split_once(end).map_or("", |(_, behind)| behind).trim_start();
        rest = match rest {
            _ if rest.starts_with("<?") => behind("?>"),
            _ if rest.starts_with("<!--") => behind("-->"),
            _ if rest.starts_with("<!") => behind(">"),
            _ => break,
        };
    }
    let name = rest.trim_start_matches('<');
    let end = name
        .find(|letter: char| !(letter.is_alphanumeric() || ":_.-".contains(letter)))
        .unwrap_or(name.len());
    Some(name[..end].rsplit(':').next().unwrap_or_default().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_outermost_element_is_found_behind_declarations_and_comments() {
        let of = |text: &str| root(text.as_bytes());
        assert_eq!(of("<?xml version='1.0'?>\n<!-- a <b> -->\n<kml:kml xmlns='x'>").as_deref(), Some("kml"));
        assert_eq!(of("\u{feff}<gpx>").as_deref(), Some("gpx"));
        assert_eq!(of("<!DOCTYPE osm><osm version='0.6'/>").as_deref(), Some("osm"));
        assert_eq!((of("{}"), of("<!-- a").as_deref()), (None, Some("")));
    }
}
