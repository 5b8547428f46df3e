//! Files of the layers of an export.

use std::io::Write;
use std::path::Path;

use super::{write_dxf, write_geojson, write_geopackage};
use crate::facts::Export;
use crate::files::Files;
use burgeon_base::error::Result;

/// Writes the modules of the final chains that have a geometry to `path`, in degrees.
pub(crate) fn write_geojson_file(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let mut text = Vec::new();
    write_geojson(export.facts.layers, export.facts.frame, &mut text)?;
    files.write(path, |out| out.write_all(&text))
}

/// Writes the same modules to `path` as a GeoPackage with a layer for each symbol.
pub(crate) fn write_geopackage_file(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let package = write_geopackage(export.facts.layers, export.facts.frame, &files.stop())?;
    files.write(path, |out| out.write_all(&package))
}

/// Writes the same modules to `path` as a drawing with a layer for each symbol.
pub(crate) fn write_dxf_file(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let mut text = Vec::new();
    write_dxf(export.facts.layers, export.facts.frame, &mut text)?;
    files.write(path, |out| out.write_all(&text))
}
