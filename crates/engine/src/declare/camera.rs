//! Cameras that scripts declare (`camera`).

use super::session::Session;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{Parameter, Table, TableKey};
use burgeon_language::CAMERA;
use burgeon_scene::{CameraView, SceneCamera};
use glam::DVec3;

/// Field of view of a camera without another (degrees).
const FOV: f64 = 40.0;

/// Parses the declaration `camera({ from = ..., to = ... })` in the line `place`. Fails for unknown fields, for fields that
/// the view does not have, and if the camera has no direction.
pub(crate) fn declare_camera(options: &Table, place: Option<SourcePlace>) -> Result<SceneCamera> {
    let known = CAMERA.part_names();
    for (key, _) in &options.entries {
        let key = match key {
            TableKey::Name(name) => name.to_string(),
            TableKey::Index(index) => index.to_string(),
        };
        if !known.contains(&key.as_str()) {
            let message = format!("unknown field `{key}` in camera");
            return Err(Error::not_found("field", &key, known.iter().copied(), message)
                .help(format!("it has {}", known.join(", "))));
        }
    }
    let name = field::<String>(options, "name")?.unwrap_or_else(|| "camera".to_owned());
    if name.trim().is_empty() {
        return Err(Error::argument("the name of a camera is empty").help("write name = \"street\""));
    }
    let kind = field::<String>(options, "view")?.unwrap_or_else(|| "perspective".to_owned());
    let owned: &[&str] = match kind.as_str() {
        "perspective" => &["from", "to", "fov"],
        "orthographic" => &["from", "to", "height"],
        "plan" => &[],
        "eye" => &["azimuth"],
        _ => {
            let views = ["perspective", "orthographic", "plan", "eye"];
            let message = format!("unknown view \"{kind}\" of camera {name}");
            return Err(Error::not_found("view", &kind, views, message)
                .help("write \"perspective\", \"orthographic\", \"plan\" or \"eye\""));
        }
    };
    let foreign = known.iter().find(|part| {
        !["name", "view"].contains(*part) && !owned.contains(*part) && options.get(part).is_some()
    });
    if let Some(foreign) = foreign {
        let help = match owned {
            [] => format!("remove it: the view \"{kind}\" is fitted to the model"),
            _ => format!("the view \"{kind}\" has {}", owned.join(", ")),
        };
        return Err(
            Error::argument(format!("camera {name} has no `{foreign}`: its view is \"{kind}\"")).help(help)
        );
    }
    let point = |part: &'static str| {
        field::<DVec3>(options, part)?.ok_or_else(|| {
            Error::argument(format!("camera {name} has no `{part}`")).help(format!(
                "write camera({{ name = \"{name}\", from = {{ 20, -30, 2 }}, to = {{ 0, 0, 5 }} }})"
            ))
        })
    };
    let view = match kind.as_str() {
        "plan" => CameraView::Plan,
        "eye" => CameraView::EyeLevel { azimuth: field(options, "azimuth")? },
        "orthographic" => CameraView::Orthographic {
            from: point("from")?,
            to: point("to")?,
            height: field(options, "height")?,
        },
        _ => {
            let fov = field(options, "fov")?.unwrap_or(FOV);
            CameraView::Perspective { from: point("from")?, to: point("to")?, fov }
        }
    };
    view.check()?;
    Ok(SceneCamera { name, view, place })
}

impl Session {
    /// Returns the declared cameras, in order.
    pub(crate) fn cameras(&self) -> Vec<SceneCamera> {
        self.cameras.lock().recover().clone()
    }

    /// Adds a camera, which other virtual machines may have added already. Fails if another line has declared its name.
    pub(crate) fn add_camera(&self, camera: SceneCamera) -> Result<()> {
        let mut cameras = self.cameras.lock().recover();
        match cameras.iter().find(|known| known.name == camera.name) {
            Some(known) if *known == camera => Ok(()),
            Some(known) => {
                let first = known.place.as_ref().map_or_else(String::new, |first| format!(" in {first}"));
                Err(Error::argument(format!("the camera {} is already declared{first}", camera.name))
                    .help("give each camera a name: camera({ name = \"street\", ... })"))
            }
            None => {
                cameras.push(camera);
                Ok(())
            }
        }
    }
}

/// Reads the field `name`, if the table has it.
fn field<T: Parameter>(options: &Table, name: &str) -> Result<Option<T>> {
    match options.get(name) {
        None => Ok(None),
        Some(value) => {
            T::read_value(value).map(Some).map_err(|expected| expected.refuse("camera", name, value))
        }
    }
}
