//! Files of scripts from a mapping or a function of Python.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex};

use burgeon::Error;
use burgeon::script::FileLoader;
use burgeon_base::locks::LockRecovery;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString};

/// First exception of Python code that a run has called.
pub(crate) type RaisedException = Arc<Mutex<Option<PyErr>>>;

/// Creates a loader from a dictionary of texts and bytes, or from a function that returns one of them, or `None`, for a
/// name. If the function has an attribute `names`, it lists files, which are loaded before the run begins. Exceptions of the
/// function are kept in `raised`.
pub(crate) fn file_loader(from: &Bound<'_, PyAny>, raised: &RaisedException) -> PyResult<FileLoader> {
    if let Ok(files) = from.cast::<PyDict>() {
        let mut content = BTreeMap::new();
        for (name, value) in files {
            content.insert(name.extract::<String>()?, bytes_of(&value)?);
        }
        return Ok(FileLoader::of_files(content));
    }
    let names = match from.getattr_opt("names")? {
        Some(names) => names.try_iter()?.map(|name| name?.extract()).collect::<PyResult<Vec<String>>>()?,
        None => Vec::new(),
    };
    let (function, raised) = (from.clone().unbind(), Arc::clone(raised));
    let loader = FileLoader::new(move |name| {
        let loaded = Python::attach(|py| {
            let value = function.bind(py).call1((name,))?;
            if value.is_none() { Ok(None) } else { bytes_of(&value).map(Some) }
        });
        loaded.map_err(|error: PyErr| {
            let message = format!("the loader failed for {name}: {error}");
            raised.lock().recover().get_or_insert(error);
            Error::other(message).help("let it return None for files that it does not have")
        })
    });
    Ok(loader.with_names(names))
}

/// Returns a text as UTF-8, or bytes as they are.
fn bytes_of(value: &Bound<'_, PyAny>) -> PyResult<Vec<u8>> {
    match value.cast::<PyString>() {
        Ok(text) => Ok(text.to_str()?.as_bytes().to_vec()),
        Err(_) => value.extract::<Vec<u8>>(),
    }
}
