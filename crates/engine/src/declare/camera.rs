//! Cameras that scripts declare (`camera`).

use super::session::Session;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_kit::{Parameter, Table, TableKey};
use burgeon_language::{CAMERA, CAMERA_ANGLES};
use burgeon_scene::{CameraView, FittedView, SceneCamera};
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
    let [azimuth, elevation] = CAMERA_ANGLES;
    // Without a position, the distance is fitted to the model.
    let is_fitted = CAMERA_ANGLES.iter().any(|angle| options.get(angle).is_some());
    let owned: &[&str] = match kind.as_str() {
        "perspective" if is_fitted => &[azimuth, elevation, "to", "radius", "fov"],
        "orthographic" if is_fitted => &[azimuth, elevation, "to", "radius"],
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
        let is_free = ["perspective", "orthographic"].contains(&kind.as_str());
        let (reason, help) = match owned {
            [] => (
                format!("its view is \"{kind}\""),
                format!("remove it: the view \"{kind}\" is fitted to the model"),
            ),
            _ if is_fitted && is_free => (
                "its direction is given by angles".to_owned(),
                format!("a camera by angles has {}; with `from` and `to` it has no angles", owned.join(", ")),
            ),
            _ if *foreign == "radius" && is_free => (
                "it has a position".to_owned(),
                "give its direction by angles instead of `from`: azimuth = 30, elevation = 15".to_owned(),
            ),
            _ => (format!("its view is \"{kind}\""), format!("the view \"{kind}\" has {}", owned.join(", "))),
        };
        return Err(Error::argument(format!("camera {name} has no `{foreign}`: {reason}")).help(help));
    }
    let point = |part: &'static str| {
        field::<DVec3>(options, part)?.ok_or_else(|| {
            Error::argument(format!("camera {name} has no `{part}`")).help(format!(
                "write camera({{ name = \"{name}\", from = {{ 20, -30, 2 }}, to = {{ 0, 0, 5 }} }}), or \
                 camera({{ name = \"{name}\", azimuth = 30, elevation = 15 }}), which shows the whole model"
            ))
        })
    };
    let view = match kind.as_str() {
        "perspective" | "orthographic" if is_fitted => CameraView::Fitted(FittedView {
            azimuth: field(options, "azimuth")?,
            elevation: field(options, elevation)?,
            fov: field(options, "fov")?,
            sphere: sphere(options, &name)?,
            is_parallel: kind == "orthographic",
        }),
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

/// Returns the centre (m) and the radius (m) of the sphere that the camera `name` is fitted to, if it has one.
fn sphere(options: &Table, name: &str) -> Result<Option<(DVec3, f64)>> {
    match (field(options, "to")?, field(options, "radius")?) {
        (Some(center), Some(radius)) => Ok(Some((center, radius))),
        (None, None) => Ok(None),
        (center, _) => {
            let (given, missing) = if center.is_some() { ("to", "radius") } else { ("radius", "to") };
            Err(Error::argument(format!("camera {name} has `{given}` and no `{missing}`"))
                .help("give both, the sphere that the picture shows: to = { 0, 0, 5 }, radius = 8; or none, for the whole model"))
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
