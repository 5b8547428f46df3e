//! Renders of a scene as PNG files.

use std::io::Write;
use std::path::Path;

use super::facts::Export;
use super::files::Files;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_picture::{CameraChoice, ModelSight, Picture, render_with_sight, render_within};
use burgeon_scene::Scene;

/// Renders `scene` as a PNG file. Fails as [`burgeon_picture::render`] does.
pub fn png(scene: &Scene, picture: &Picture, stop: &Stop) -> Result<Vec<u8>> {
    burgeon_scene::image::encode(&render_within(scene, None, picture, stop)?)
}

/// Writes a render to `path`, with a warning if it shows nothing of the model.
pub(super) fn write(export: &Export<'_>, path: &Path, files: &mut Files) -> Result<()> {
    let (image, sight) = render_with_sight(export.scene, export.picture, &files.stop())?;
    files.warn(sight_warning(export, sight, path));
    let png = burgeon_scene::image::encode(&image)?;
    files.write(path, |out| out.write_all(&png))
}

/// Returns a warning with the reason why a render to `path` shows nothing of the model, unless it shows it.
fn sight_warning(export: &Export<'_>, sight: ModelSight, path: &Path) -> Option<Warning> {
    let reason = match sight {
        ModelSight::Seen => return None,
        ModelSight::Outside => "the model is outside of it",
        ModelSight::Speck => "the model is smaller than a pixel",
        ModelSight::Hidden => "its faces are seen from behind, are transparent or are thinner than a pixel",
    };
    let (scene, picture) = (export.scene, export.picture);
    let declared = match &picture.camera {
        CameraChoice::Named(name) => scene.cameras.iter().find(|camera| camera.name == *name),
        CameraChoice::Automatic if picture.is_free() => scene.cameras.first(),
        CameraChoice::Automatic | CameraChoice::View(_) => None,
    };
    let by = declared.map_or_else(String::new, |camera| format!(" by camera {}", camera.name));
    let text = format!("the picture {}{by} shows nothing of the model: {reason}", path.display());
    let help = match (sight, scene.bounds()) {
        (ModelSight::Hidden, _) | (_, None) => {
            "see it from the other side, give its material double_sided = true, or draw it thicker".to_owned()
        }
        (_, Some((low, high))) => {
            let [x, y, z] = ((low + high) * 0.5).to_array().map(|number| (number * 10.0).round() / 10.0);
            let action =
                if sight == ModelSight::Speck { "move the camera nearer to" } else { "direct the camera at" };
            format!(
                "{action} the model, whose middle is at {{ {x}, {y}, {z} }}, or give angles, which fit the \
                 distance to it: azimuth = 30, elevation = 15"
            )
        }
    };
    let place = declared.and_then(|camera| camera.place.clone());
    Some(Warning::new(WarningKind::Doubtful, text).at(place).help(help))
}
