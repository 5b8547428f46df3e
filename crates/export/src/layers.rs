//! Layers of modules as GeoJSON and as a GeoPackage.

use std::io::Write;
use std::path::Path;

use super::facts::Export;
use super::files::Files;
use burgeon_base::error::Result;
use burgeon_data::output;

/// Writes the modules of the final chains that have a geometry to `path`, in degrees.
pub(super) fn write_geojson(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let mut text = Vec::new();
    output::write_geojson(export.facts.layers, export.facts.frame, &mut text)?;
    files.write(path, |out| out.write_all(&text))
}

/// Writes the same modules to `path` as a GeoPackage with a layer for each symbol.
pub(super) fn write_geopackage(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let package = burgeon_data::write_geopackage(export.facts.layers, export.facts.frame, &files.stop())?;
    files.write(path, |out| out.write_all(&package))
}
