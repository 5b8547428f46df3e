//! Drawn functions, curves and surfaces: their outlines while a page changes them, and their file.

use std::time::Instant;

use serde_json::Value;

use super::message::{Cause, Event};
use super::state::{DueRun, ServerState};
use crate::curves::save_curve;
use crate::watch::settled;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_engine::script::PointRows;
use burgeon_engine::script::{Control, CurvesFile, Param, Setting};

/// Returns the outline of the parameter `name` with these points, which a page has not requested yet.
pub(super) fn outline(state: &ServerState, id: u64, name: &str, points: &Value) -> Event {
    let trace = || -> Result<Event> {
        let (param, points) = read(state, name, points)?;
        match &param.control {
            Control::Points(control) => Ok(Event::Outline { id, pieces: control.pieces(&points)? }),
            _ => Err(not_drawn(name)),
        }
    };
    trace().unwrap_or_else(|error| Event::rejection(Some(id), &error))
}

/// Saves the points of the parameter `name` in the file next to the script, whose value the parameter then has. Points
/// that are the script's default are removed from the file.
pub(super) fn store(state: &ServerState, id: u64, name: &str, points: &Value) -> Event {
    let mut known = state.curves.lock().recover();
    let save = || -> Result<CurvesFile> {
        let (param, points) = read(state, name, points)?;
        let setting = Setting::Points(points.clone());
        let is_default = setting == param.default;
        let file = save_curve(&state.script, &param.name, (!is_default).then_some(points))?;
        let mut inner = state.lock();
        inner.request.forget(&param, &setting);
        inner.generation += 1;
        inner.post(DueRun { cause: Cause::Parameters, files: Vec::new(), at: Instant::now() });
        state.wake.notify_all();
        Ok(file)
    };
    match save() {
        Ok(file) => {
            let name = state.name(file.path());
            *known = Some(file);
            Event::Stored { id, file: name }
        }
        Err(error) => Event::rejection(Some(id), &error),
    }
}

/// Returns true if the file of drawn curves differs from the one that the server knows, which it then replaces.
pub(super) fn is_changed(state: &ServerState) -> bool {
    let mut known = state.curves.lock().recover();
    let path = CurvesFile::path_of(&state.script);
    let read = settled(&path, || CurvesFile::read(&state.script)).ok();
    let is_same = match (&*known, &read) {
        (Some(known), Some(read)) => known.is_like(read),
        // The run reports an invalid file.
        _ => false,
    };
    *known = read;
    !is_same
}

/// Returns the drawn parameter `name` and the points that a page sent.
fn read(state: &ServerState, name: &str, points: &Value) -> Result<(Param, PointRows)> {
    let inner = state.lock();
    let shown = inner.shown.as_ref().map(|shown| shown.run.params.as_slice());
    let params = inner.params.as_deref().or(shown);
    let Some(params) = params else {
        return Err(Error::unavailable("curves are drawn when the script has run without an error"));
    };
    let Some(param) = Param::find(params, name)? else {
        let names = params.iter().map(|param| param.name.as_str());
        return Err(Error::not_found("parameter", name, names, format!("unknown parameter `{name}`")));
    };
    match param.accept(&points.to_string())? {
        Setting::Points(points) => Ok((param.clone(), points)),
        _ => Err(not_drawn(name)),
    }
}

fn not_drawn(name: &str) -> Error {
    Error::argument(format!("param {name} is not a function, a curve or a surface, so it is not drawn"))
}
