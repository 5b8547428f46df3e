//! Errors of Burgeon as exceptions of Python.

use burgeon::Error;
use pyo3::prelude::*;
use serde_json::{Value, json};

/// Converts an error to `burgeon.Error`, with all problems that were found with it.
pub(crate) fn exception(py: Python<'_>, error: &Error) -> PyErr {
    let problems: Vec<Value> = error
        .problems()
        .map(|problem| {
            let mut object = problem.to_json();
            object["text"] = problem.without_others().to_string().into();
            object
        })
        .collect();
    let content = json!({ "text": error.to_string(), "problems": problems }).to_string();
    let made = py
        .import("burgeon._errors")
        .and_then(|module| module.getattr("Error"))
        .and_then(|class| class.call_method1("_from_json", (content,)));
    made.map_or_else(|error| error, PyErr::from_value)
}
