//! `require`: files of the script's folder and of packages, each run once.

use std::path::{Path, PathBuf};

use mlua::{Lua, Value as LuaValue};
use rustc_hash::FxHashSet;

use super::Machine;
use super::library::Library;
use crate::declare::Session;
use crate::declare::paths::{is_absolute, lead};
use burgeon_base::error::{Error, ErrorKind, Result, SourcePlace};
use burgeon_packages::{FileName, Package};

/// Runs another file once and returns its result.
pub(super) fn require(library: &Library, session: &Session, lua: &Lua, name: &str) -> Result<LuaValue> {
    let machine = library.machine()?;
    let bare = name.strip_suffix(".lua").unwrap_or(name);
    if bare.is_empty() || bare.ends_with(['/', '.']) {
        return Err(
            Error::argument("require needs a file name").help("write require(\"facade\") for facade.lua")
        );
    }
    let asker = Machine::asker(lua, session);
    if let Ok(file) = FileName::parse(bare) {
        let scope = asker.map(|package| package.manifest.name.as_str().into());
        library.required.borrow_mut().entry(scope).or_default().insert(file.package.into());
    }
    let (path, shown) = match asker {
        _ if FileName::is_meant(name) => located(session, &FileName::script(bare)?, asker)?,
        Some(package) => find_in_package(session, package, &caller(lua), bare)?,
        None => {
            let loading = library.loading.borrow();
            let file = loading.last().map(|file| session.origin(file));
            let folder = file.as_deref().and_then(Path::parent).unwrap_or(session.root());
            find(session, folder, name, bare)?
        }
    };
    if session.options.check
        && let Some(place) = Machine::place(lua)
    {
        session.note_required(&place.file, name, &shown);
    }
    if let Some(value) = library.loaded.borrow().get(&path) {
        return Ok(value.clone());
    }
    if let Some(position) = library.loading.borrow().iter().position(|file| *file == path) {
        let loading = library.loading.borrow();
        let cycle: Vec<String> =
            loading[position..].iter().chain([&path]).map(|file| session.name_of(file)).collect();
        return Err(Error::script(format!("circular require: {}", cycle.join(" -> ")))
            .help("move the common part into a third file"));
    }
    load(library, session, &machine, path, &shown)
}

impl Machine {
    /// Runs every Lua file of `package`, and checks the names of package files in them.
    pub(crate) fn run_package(&self, package: &Package) -> Result<()> {
        let (library, session) = (&self.library, &self.session);
        let mut problems = session.packages().check_files(package);
        for script in package.scripts() {
            let (path, shown) = (package.folder.join(&script), package.shown.join(&script));
            let known = library.loaded.borrow().contains_key(&path);
            let shown = shown.display().to_string();
            if !known && let Err(error) = load(library, session, self, path.clone(), &shown) {
                problems.extend(error.problems().map(Error::without_others));
            }
            if let Ok(source) = session.source(&path, &shown, &library.globals()) {
                problems.extend(session.missing(package, &shown, &source.analysis.packages));
            }
        }
        if problems.is_empty() { Ok(()) } else { Err(Error::several(problems)) }
    }
}

/// Runs the file at `path` with the display name `shown`.
fn load(
    library: &Library,
    session: &Session,
    machine: &Machine,
    path: PathBuf,
    shown: &str,
) -> Result<LuaValue> {
    let source = session.source(&path, shown, &library.globals())?;
    if !source.analysis.problems.is_empty() && !session.options.check {
        machine.load_file(&source)?;
        return Err(Error::several(source.analysis.problems.clone()));
    }
    library.loading.borrow_mut().push(path);
    let value = machine
        .load_file(&source)
        .and_then(|chunk| machine.call::<LuaValue>(&chunk, ()).map_err(|error| machine.translate(error)));
    let path = library.loading.borrow_mut().pop();
    let value = value?;
    if let Some(package) = session.package_of(shown) {
        freeze_all(&value, &package.manifest.name)
            .map_err(|error| error.rather_at(Some(SourcePlace::new(shown, 1))))?;
    }
    library.loaded.borrow_mut().extend(path.map(|path| (path, value.clone())));
    Ok(value)
}

/// Makes the exports of a package read-only, so that no user of the package can change them for the others.
///
/// Freezes every table that can be reached through tables and metatables, also through tables that are
/// already read-only. Captured variables of functions stay writable. Fails for a buffer, which cannot be
/// read-only.
fn freeze_all(value: &LuaValue, package: &str) -> Result<()> {
    let mut queue = vec![value.clone()];
    let mut seen = FxHashSet::default();
    while let Some(value) = queue.pop() {
        let table = match value {
            LuaValue::Table(table) => table,
            LuaValue::Buffer(_) => {
                return Err(Error::scope(format!(
                    "the package {package} returns a buffer, which one user could change for all others"
                ))
                .help("return a function that creates a buffer, or a string: buffer.tostring(b)"));
            }
            _ => continue,
        };
        if !seen.insert(table.to_pointer() as usize) {
            continue;
        }
        table.set_readonly(true);
        queue.extend(table.metatable().map(LuaValue::Table));
        queue.extend(table.pairs::<LuaValue, LuaValue>().flatten().flat_map(|(key, value)| [key, value]));
    }
    Ok(())
}

/// Returns the folder of the file that is being run, as in messages.
fn caller(lua: &Lua) -> PathBuf {
    let place = Machine::place(lua);
    place.and_then(|place| Some(Path::new(&place.file).parent()?.to_path_buf())).unwrap_or_default()
}

/// Returns the path of a package file and its display name.
fn located(session: &Session, name: &FileName, asker: Option<&Package>) -> Result<(PathBuf, String)> {
    let located = session.locate("file", name, asker)?;
    Ok((located.path, located.shown.display().to_string()))
}

/// Finds the file for `require(bare)` in a file of `package` in the folder `from`: relative to `from`, or to
/// the package.
fn find_in_package(
    session: &Session,
    package: &Package,
    from: &Path,
    bare: &str,
) -> Result<(PathBuf, String)> {
    let name = &package.manifest.name;
    let relative = PathBuf::from(format!("{bare}.lua"));
    let inner = from.strip_prefix(&package.shown).unwrap_or(Path::new(""));
    let outside = || {
        Error::file(bare, format!("require(\"{bare}\") is outside the package {name}"))
            .help("a file of another package needs the package name: require(\"@castle/towers\")")
    };
    if is_absolute(&relative) {
        return Err(outside());
    }
    let mut missing = None;
    for folder in [inner, Path::new("")] {
        let path = lead(&package.folder.join(folder), &relative);
        let path = path.strip_prefix(&package.folder).map_err(|_| outside())?;
        let parts: Vec<_> = path.iter().map(|part| part.to_string_lossy()).collect();
        let file = FileName::new(name, parts.join("/"));
        match located(session, &file, Some(package)) {
            Err(error) if matches!(error.kind(), ErrorKind::NotFound { .. }) => {
                missing.get_or_insert(error);
            }
            found => return found,
        }
    }
    Err(missing.unwrap_or_else(outside))
}

/// Finds the file for `require(name)`, and returns its path and display name.
fn find(session: &Session, from: &Path, name: &str, bare: &str) -> Result<(PathBuf, String)> {
    let outside = || {
        Error::file(name, format!("require(\"{name}\") is outside the script's folder"))
            .help("a script can read only files in its own folder and its subfolders")
    };
    let relative = PathBuf::from(format!("{bare}.lua"));
    if is_absolute(&relative) {
        return Err(outside());
    }
    for folder in [from, session.root()] {
        let path = lead(folder, &relative);
        if !path.starts_with(session.root()) {
            return Err(outside());
        }
        if let Some(path) = session.find_file(&path)? {
            if !session.is_inside(&path) {
                return Err(outside());
            }
            let origin = session.origin(&path);
            let inner = origin.strip_prefix(session.root()).unwrap_or(&origin);
            let shown =
                session.script().parent().map_or_else(|| inner.to_path_buf(), |parent| parent.join(inner));
            return Ok((path, shown.display().to_string()));
        }
    }
    let message = format!("require(\"{name}\"): file not found: {}", relative.display());
    let error = Error::not_found("file", name, [], message);
    Err(session
        .propose_packages(&format!("{bare}.lua"), error)
        .help("the name is a path relative to the requiring file or to the script's folder"))
}
