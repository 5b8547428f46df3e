//! `require`: other files of the script's folder, each run once.

use std::path::{Path, PathBuf};

use mlua::Value as LuaValue;

use super::library::Library;
use crate::declare::Session;
use crate::declare::paths::{is_absolute, lead};
use burgeon_base::error::{Error, Result};

/// Runs another file of the script's folder once and gives what it returns.
pub(super) fn require(library: &Library, session: &Session, name: &str) -> Result<LuaValue> {
    let machine = library.machine()?;
    let from = library
        .loading
        .borrow()
        .last()
        .and_then(|file| file.parent())
        .map_or_else(|| session.root().to_path_buf(), Path::to_path_buf);
    let (path, shown) = find(session, &from, name)?;
    if let Some(value) = library.loaded.borrow().get(&path) {
        return Ok(value.clone());
    }
    if let Some(position) = library.loading.borrow().iter().position(|file| *file == path) {
        let loading = library.loading.borrow();
        let cycle: Vec<String> = loading[position..]
            .iter()
            .chain([&path])
            .map(|file| file.strip_prefix(session.root()).unwrap_or(file).display().to_string())
            .collect();
        return Err(Error::script(format!("files require each other in a circle: {}", cycle.join(" -> ")))
            .help("move what both need into a third file"));
    }
    let source = session.source(&path, &shown, &library.globals())?;
    if !source.analysis.problems.is_empty() && !session.options.check {
        machine.load(&source.name, &source.analysis.text)?;
        return Err(Error::several(source.analysis.problems.clone()));
    }
    library.loading.borrow_mut().push(path.clone());
    let value = machine
        .load(&source.name, &source.analysis.text)
        .and_then(|chunk| machine.call::<LuaValue>(&chunk, ()).map_err(|error| machine.translate(error)));
    library.loading.borrow_mut().pop();
    let value = value?;
    library.loaded.borrow_mut().insert(path, value.clone());
    Ok(value)
}

/// The file that `require(name)` means, and its name for messages.
fn find(session: &Session, from: &Path, name: &str) -> Result<(PathBuf, String)> {
    let outside = || {
        Error::file(name, format!("require(\"{name}\") leads outside the script's folder"))
            .help("a script reads only files in its own folder and below it")
    };
    let bare = name.strip_suffix(".lua").unwrap_or(name);
    if bare.is_empty() || bare.ends_with(['/', '.']) {
        return Err(Error::argument("require needs the name of a file")
            .help("write require(\"facade\") for facade.lua"));
    }
    let relative = PathBuf::from(format!("{bare}.lua"));
    if is_absolute(&relative) {
        return Err(outside());
    }
    for folder in [from, session.root()] {
        let path = lead(folder, &relative);
        if !path.starts_with(session.root()) {
            return Err(outside());
        }
        let found = path.canonicalize();
        session.seek(&path, found.is_ok());
        if let Ok(path) = found {
            if !path.starts_with(session.root()) {
                return Err(outside());
            }
            let inner = path.strip_prefix(session.root()).unwrap_or(&path);
            let shown =
                session.script().parent().map_or_else(|| inner.to_path_buf(), |parent| parent.join(inner));
            return Ok((path.clone(), shown.display().to_string()));
        }
    }
    let message = format!("require(\"{name}\") finds no file {}", relative.display());
    Err(Error::not_found("file", name, [], message)
        .help("the name is a path from the requiring file or from the script's folder"))
}
