//! Parameters that scripts declare.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon::Stop;
use burgeon::script::{Control, Param, RunOptions};
use pyo3::prelude::*;
use serde_json::{Value, json};

use crate::errors::exception;
use crate::loader::{RaisedException, file_loader};
use crate::run::{options_of, raise_first};
use crate::supervised::supervise_quietly;

/// Returns the parameters of a script as JSON, without deriving its systems.
#[pyfunction]
#[pyo3(signature = (script, options, loader = None))]
pub(crate) fn parameters(
    py: Python<'_>,
    script: PathBuf,
    options: &str,
    loader: Option<Bound<'_, PyAny>>,
) -> PyResult<String> {
    let raised = RaisedException::default();
    let loader = loader.map(|loader| file_loader(&loader, &raised)).transpose()?;
    let options = options_of(&script, options, None, loader).map_err(|error| exception(py, &error))?;
    let stop = Arc::new(Stop::new());
    let options = RunOptions { stop: Some(Arc::clone(&stop)), ..options };
    let checked = supervise_quietly(py, &stop, move || burgeon::check(&script, options));
    let checked = raise_first(checked, &raised)?;
    Ok(checked.params.iter().map(param_json).collect::<Value>().to_string())
}

/// Returns a parameter with its allowed values as JSON.
fn param_json(param: &Param) -> Value {
    let mut object = json!({
        "name": param.name,
        "value": param.value.to_json(),
        "default": param.default.to_json(),
        "group": param.group,
        "unit": param.unit,
        "doc": param.doc,
        "package": param.package,
    });
    let kind = match &param.control {
        Control::Number { min, max, step } => {
            object["min"] = (*min).into();
            object["max"] = (*max).into();
            object["step"] = (*step).into();
            "number"
        }
        Control::Switch => "boolean",
        Control::Choice(choices) => {
            object["choices"] = choices.clone().into();
            "choice"
        }
        Control::Color => "color",
        Control::Text => "text",
        Control::Points(_) => "points",
    };
    object["kind"] = kind.into();
    object
}
