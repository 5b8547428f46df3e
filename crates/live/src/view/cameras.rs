//! Cameras for pages: those that the script declares, and views that are fitted to the model.

use super::message::{CameraMessage, Event};
use super::state::ServerState;
use burgeon_base::error::{Error, Result};
use burgeon_engine::run::Run;
use burgeon_picture::pose;
use burgeon_scene::{CameraView, FittedView};
use glam::DVec3;

/// Camera that a page asks for.
pub(super) struct WantedCamera {
    /// Name of a camera of the script.
    pub name: Option<String>,
    /// View without a name: `plan` or `eye`.
    pub view: Option<String>,
    /// Azimuth from north, clockwise (degrees), of the view `eye`.
    pub azimuth: Option<f64>,
    /// Ratio of width to height.
    pub aspect: f64,
}

/// Returns the cameras that the script of a run declares.
pub(super) fn declared(state: &ServerState, run: &Run) -> Vec<CameraMessage> {
    let message = |camera: &burgeon_scene::SceneCamera| CameraMessage {
        name: camera.name.clone(),
        view: camera.view.kind_name(),
        file: camera.place.as_ref().map_or_else(String::new, |place| state.short(&place.file)),
        line: camera.place.as_ref().map_or(0, |place| place.line),
    };
    run.scene.cameras.iter().map(message).collect()
}

/// Returns the place of a camera of the present model.
pub(super) fn find(state: &ServerState, id: u64, wanted: &WantedCamera) -> Event {
    place(state, id, wanted).unwrap_or_else(|error| Event::rejection(Some(id), &error))
}

fn place(state: &ServerState, id: u64, wanted: &WantedCamera) -> Result<Event> {
    let Some(shown) = state.shown() else { return Err(Error::unavailable("no model yet")) };
    let scene = &shown.run.scene;
    let Some((low, high)) = scene.bounds() else {
        return Err(Error::unavailable("the model is empty, so no camera shows it"));
    };
    if !wanted.aspect.is_finite() || wanted.aspect <= 0.0 {
        return Err(Error::argument("the ratio of width to height is not above 0"));
    }
    let view = match (&wanted.name, wanted.view.as_deref()) {
        (Some(name), None) => {
            let known = scene.cameras.iter().find(|camera| camera.name == *name);
            known.map(|camera| camera.view).ok_or_else(|| {
                let names = scene.cameras.iter().map(|camera| camera.name.as_str());
                Error::not_found("camera", name, names, format!("unknown camera `{name}`"))
            })?
        }
        (None, Some("plan")) => CameraView::Plan,
        (None, Some("eye")) => CameraView::EyeLevel { azimuth: wanted.azimuth },
        _ => return Err(Error::argument("a camera has a name, or the view plan or eye")),
    };
    let pose = pose(scene, &view, wanted.aspect)?;
    let target = match view {
        CameraView::Perspective { to, .. } => to,
        CameraView::Fitted(FittedView { sphere: Some((center, _)), is_parallel: false, .. }) => center,
        CameraView::Orthographic { .. }
        | CameraView::Plan
        | CameraView::EyeLevel { .. }
        | CameraView::Fitted(_) => {
            let ahead = (0.5 * (low + high) - pose.eye).dot(pose.forward);
            pose.eye + pose.forward * ahead.max(1e-3 * DVec3::distance(low, high)).max(1e-3)
        }
    };
    Ok(Event::Camera {
        id,
        eye: pose.eye.to_array(),
        target: target.to_array(),
        parallel: pose.is_parallel,
        shown: pose.shown,
    })
}
