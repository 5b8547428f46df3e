//! Runs of scripts.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::channel;

use burgeon::presets::Presets;
use burgeon::script::{FileLoader, Print, RunOptions, Session};
use burgeon::{Error, Result};
use burgeon_base::locks::LockRecovery;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::errors::exception;
use crate::loader::{RaisedException, file_loader};
use crate::model::ScriptModel;
use crate::model_data::ModelData;
use crate::options::OptionValues;
use crate::supervised::{WorkMessage, supervise};

/// Runs a script and returns its model. `options` is JSON; `printed` and `progress` are functions, and `loader` is a
/// dictionary or a function.
#[pyfunction]
#[pyo3(signature = (script, options, printed = None, progress = None, loader = None))]
pub(crate) fn run(
    py: Python<'_>,
    script: PathBuf,
    options: &str,
    printed: Option<Bound<'_, PyAny>>,
    progress: Option<Bound<'_, PyAny>>,
    loader: Option<Bound<'_, PyAny>>,
) -> PyResult<ScriptModel> {
    let raised = RaisedException::default();
    let (sender, receiver) = channel();
    let texts = sender.clone();
    let print = printed.is_some().then(|| {
        Print::new(move |text| {
            // Nobody receives it once the call has returned.
            let _ = texts.send(WorkMessage::Printed(text.to_owned()));
        })
    });
    let loader = loader.map(|loader| file_loader(&loader, &raised)).transpose()?;
    // A loader takes the interpreter's lock, so it must be free.
    let session = py.detach(|| Session::new(&script, options_of(&script, options, print, loader)?));
    let session = raise_first(session.map_err(|error| exception(py, &error)), &raised)?;
    let working = Arc::clone(&session);
    let work = move || {
        let mut run = burgeon::run_session(&working)?;
        run.note_packages(&working)?;
        Ok(ModelData { run, session: working })
    };
    let print = |text: &str| printed.as_ref().map_or(Ok(()), |printed| printed.call1((text,)).map(|_| ()));
    let pulse = |elapsed: std::time::Duration| {
        let Some(progress) = &progress else { return Ok(()) };
        let (step, steps, modules) = session.progress.counts();
        let state = PyDict::new(py);
        state.set_item("step", step)?;
        state.set_item("steps", steps)?;
        state.set_item("modules", modules)?;
        state.set_item("seconds", elapsed.as_secs_f64())?;
        state.set_item("text", session.progress.message(elapsed))?;
        progress.call1((state,)).map(|_| ())
    };
    let made = supervise(py, &session.stop, (sender, receiver), print, pulse, work);
    raise_first(made, &raised).map(ScriptModel::new)
}

/// Returns the options of a run of `script`, with its preset and its loader.
pub(crate) fn options_of(
    script: &Path,
    options: &str,
    print: Option<Print>,
    loader: Option<FileLoader>,
) -> Result<RunOptions> {
    let values = OptionValues::parse(options)?;
    let preset = match values.preset() {
        Some(_) if loader.is_some() => {
            return Err(Error::argument("a script in memory has no presets").help("give values and seed"));
        }
        Some(name) => Some(Presets::read(script)?.get(name)?),
        None => None,
    };
    let mut options = values.run_options(preset, print)?;
    options.inputs.loader = loader;
    Ok(options)
}

/// Returns the result of work, or the exception that a loader has raised in it.
pub(crate) fn raise_first<T>(result: PyResult<T>, raised: &RaisedException) -> PyResult<T> {
    result.map_err(|error| raised.lock().recover().take().unwrap_or(error))
}
