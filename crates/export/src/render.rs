//! Renders of a scene as PNG files.

use std::io::Write;
use std::path::Path;

use super::facts::Export;
use super::files::Files;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_picture::{Picture, render_within};
use burgeon_scene::Scene;

/// Renders `scene` as a PNG file. Fails as [`burgeon_picture::render`] does.
pub fn png(scene: &Scene, picture: &Picture, stop: &Stop) -> Result<Vec<u8>> {
    burgeon_scene::image::encode(&render_within(scene, None, picture, stop)?)
}

/// Writes a render to `path`.
pub(super) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let png = png(export.scene, export.picture, &files.stop())?;
    files.write(path, |out| out.write_all(&png))
}
