//! Detection of the format of a height file, and dispatch to its reader.

use std::path::Path;

use crate::formats::{geotiff, png, zipped};
use crate::heights::{HeightOptions, RasterHeader, ascii, hgt, raw};
use burgeon_base::error::{Error, Result};

/// Supported formats.
const KNOWN: &str = "supported formats are .hgt (also zipped), GeoTIFF (.tif), ESRI ASCII grid (.asc), PNG, and raw floats (.r32, .r64)";

/// Reads `bytes`, the content of the file called `name`.
///
/// Zip, TIFF, PNG and ASCII grid files are detected from their content, other formats from the extension.
pub(super) fn read<'a>(
    bytes: &'a [u8],
    name: &'a str,
    wanted: &'a HeightOptions,
) -> Result<RasterHeader<'a>> {
    if bytes.is_empty() {
        return Err(Error::data(format!("{name} is empty")).help("download it again"));
    }
    let extension = Path::new(name).extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let is_png = bytes.starts_with(b"\x89PNG");
    if !is_png && (wanted.low.is_some() || wanted.high.is_some() || wanted.terrain_rgb) {
        return Err(Error::argument(format!(
            "{name} is not a PNG, so low, high and encoding are not allowed"
        ))
        .help("its heights are already in metres; remove these options"));
    }
    match bytes {
        _ if is_png => png::read(bytes, name, wanted),
        [b'P', b'K', 3 | 5, ..] => zipped::read(bytes, name, wanted),
        [b'I', b'I', 42 | 43, 0, ..] | [b'M', b'M', 0, 42 | 43, ..] => geotiff::read(bytes, name),
        _ if extension == "hgt" => hgt::read(bytes, name, wanted),
        _ if matches!(&*extension, "r32" | "f32") => raw::read::<4>(bytes, name),
        _ if matches!(&*extension, "r64" | "f64") => raw::read::<8>(bytes, name),
        _ if extension == "asc" || begins_with(bytes, b"ncols") => ascii::read(bytes, name),
        _ if matches!(&*extension, "png" | "tif" | "tiff" | "zip") => {
            Err(Error::data(format!("{name} does not begin like a .{extension} file"))
                .help("download it again, or correct its extension"))
        }
        _ => Err(Error::data(format!("{name} has an unknown format of heights")).help(KNOWN)),
    }
}

/// Returns true if the first word of a text is `word`, ignoring case.
fn begins_with(bytes: &[u8], word: &[u8]) -> bool {
    let text = bytes.trim_ascii_start();
    text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}
