//! Data files of scripts: access checks, and loading of each file once per run.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex};

use super::paths::{is_absolute, lead};
use super::session::Session;
use super::tables::{ListTable, SourceTable, SourceTables, TableContent};
use burgeon_base::budget::Budget;
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_data::output::RecordTable;
use burgeon_data::{
    Cache, Layer, ReferenceFrame, Source, SourceOptions, companions, nearest_file, split_name,
};
use burgeon_kit::{LoadRequest, LoadedObject, Loader, Resources, Table};
use burgeon_packages::Package;

/// Data of a run.
///
/// All virtual machines call `source` in the same order, so the results do not depend on the machine that
/// loads first. Each file is read once.
#[derive(Default)]
pub(crate) struct Data {
    known: Mutex<LayerStore>,
}

#[derive(Default)]
pub(super) struct LayerStore {
    /// Projection and origin, set by the first source.
    pub(super) frame: Option<ReferenceFrame>,
    loaded: BTreeMap<String, Result<Arc<Layer>>>,
    /// Objects loaded from files, by type, files and fields.
    objects: BTreeMap<String, Result<LoadedObject>>,
    /// Sources as tables.
    pub(super) tables: SourceTables,
    /// Memory budget of all reading in the run.
    budget: Option<Arc<Budget>>,
}

impl LayerStore {
    fn budget(&mut self, session: &Session) -> Arc<Budget> {
        let make = || {
            let stop = Arc::clone(&session.stop);
            Budget::new(session.options.limits.memory, move || stop.check())
        };
        Arc::clone(self.budget.get_or_insert_with(make))
    }
}

impl Data {
    /// Loads the features of `source(text, wanted)`, called in a file of the package `asker`, or of the
    /// script.
    pub(crate) fn load(
        &self,
        session: &Session,
        asker: Option<&Package>,
        text: &str,
        mut wanted: SourceOptions,
        table: Option<&str>,
    ) -> Result<Arc<Layer>> {
        let mut known = self.known.lock().recover();
        let key = format!("{:?} {text:?} {wanted:?} {table:?}", asker.map(|asker| &asker.manifest.name));
        if let Some(loaded) = known.loaded.get(&key) {
            return loaded.clone();
        }
        wanted.budget = known.budget(session);
        let before = wanted.budget.used_bytes();
        let loaded = read(session, asker, text, wanted, &mut known, table);
        session.stop.check()?;
        let kept = loaded.as_ref().map_or(0, |layer| layer.size());
        known.budget(session).settle(before, kept);
        known.loaded.insert(key, loaded.clone());
        loaded
    }
}

impl Data {
    /// Loads the object of type `kind` that `loader` makes of the files `names`; equal calls return the same
    /// object. The caller is a file of the package `asker`, or of the script.
    pub(crate) fn object(
        &self,
        session: &Session,
        asker: Option<&Package>,
        (kind, loader): (&str, &Loader),
        names: &[String],
        fields: &Table,
    ) -> Result<LoadedObject> {
        let Some(name) = names.first().filter(|_| names.iter().all(|name| !name.is_empty())) else {
            return Err(Error::argument(format!("{kind} needs the name of a file"))
                .help(format!("write {}", loader.example)));
        };
        let alone = if names.len() == 1 { session.package_file(loader.what, name, asker) } else { None };
        let (files, asker) = match alone.transpose()? {
            // A replacement file names further files of its own package.
            Some(located) => (vec![(located.name.to_string(), located.path)], Some(located.package)),
            None => {
                let files = names.iter().map(|name| find_all(session, asker, loader, name));
                (files.collect::<Result<Vec<_>>>()?.concat(), asker)
            }
        };
        for (_, path) in &files {
            seek_companions(session, path);
        }
        let (own, path) = &files[0];
        let mut known = self.known.lock().recover();
        let key = format!("{kind} {files:?} {:?} {fields:?}", asker.map(|asker| &asker.manifest.name));
        if let Some(loaded) = known.objects.get(&key) {
            return loaded.clone();
        }
        let budget = known.budget(session);
        let before = budget.used_bytes();
        let mut cache = session.options.inputs.cache.clone();
        let mut file = LoadRequest {
            name: own,
            path,
            files: &files,
            budget: &budget,
            triangles: session.options.limits.triangles,
            services: &mut [&mut known.frame, &mut cache],
            resources: &FileAccess { session, asker },
        };
        let loaded = (loader.load)(&mut file, fields);
        session.stop.check()?;
        budget.settle(before, loaded.as_ref().map_or(0, |loaded| loaded.memory));
        known.objects.insert(key, loaded.clone());
        loaded
    }

    /// Adds a list of the script as the table `name`.
    pub(crate) fn add_list(&self, name: &str, list: ListTable) {
        let mut known = self.known.lock().recover();
        known.tables.add(SourceTable { name: name.to_owned(), content: TableContent::List(list) });
    }

    /// Returns the lists that the script made into tables, with the table names.
    pub(crate) fn lists(&self) -> Vec<RecordTable> {
        self.known.lock().recover().tables.lists()
    }

    /// Calls `act` with the tables, the projection of the run, and the memory budget for reading.
    #[cfg(feature = "data")]
    pub(super) fn with_tables<T>(
        &self,
        session: &Session,
        act: impl FnOnce(&mut SourceTables, Option<&ReferenceFrame>, &Arc<Budget>) -> Result<T>,
    ) -> Result<T> {
        let mut known = self.known.lock().recover();
        let budget = known.budget(session);
        let LayerStore { frame, tables, .. } = &mut *known;
        act(tables, frame.as_ref(), &budget)
    }

    /// Returns the projection and origin of the run, once data has set them.
    pub(crate) fn frame(&self) -> Option<ReferenceFrame> {
        self.known.lock().recover().frame.clone()
    }
}

/// Access to the files of a run, for the script or for a package.
struct FileAccess<'a> {
    session: &'a Session,
    asker: Option<&'a Package>,
}

impl Resources for FileAccess<'_> {
    fn find(&self, what: &'static str, name: &str) -> Result<PathBuf> {
        find(self.session, self.asker, what, name)
    }
}

fn read(
    session: &Session,
    asker: Option<&Package>,
    text: &str,
    mut wanted: SourceOptions,
    known: &mut LayerStore,
    table: Option<&str>,
) -> Result<Arc<Layer>> {
    if text.starts_with("postgres://") || text.starts_with("postgresql://") {
        return super::servers::read(session, text, wanted, known, table);
    }
    let (name, layer) = split_name(text);
    let SourceOptions { condition, limit, id, kind, crs, .. } = &wanted;
    let is_whole = (condition, limit, id, kind, crs) == (&None, &None, &None, &None, &None);
    wanted.layer = wanted.layer.or_else(|| layer.map(str::to_owned));
    if name.is_empty() {
        return Err(
            Error::argument("source needs the name of a file").help("write source(\"village.geojson\")")
        );
    }
    let path = find(session, asker, "data file", name)?;
    seek_companions(session, &path);
    let cache = session.options.inputs.cache.as_deref();
    let key = match cache {
        Some(_) => Cache::key(&path, name, &wanted, known.frame.as_ref())?,
        None => None,
    };
    let kept = cache.zip(key.as_deref()).and_then(|(cache, key)| cache.get(key));
    let layer = match kept {
        Some((layer, frame)) => {
            known.frame = Some(frame);
            layer
        }
        None => {
            let table = Source::open_within(&path, name, &wanted)?.read(name, &wanted)?;
            let shown = table.shown.clone();
            let layer = Layer::new(table, &mut known.frame).map_err(|error| error.about(&shown))?;
            let layer = Arc::new(layer);
            if let (Some(cache), Some(key), Some(frame)) = (cache, key, &known.frame) {
                cache.keep(key, &layer, frame);
            }
            layer
        }
    };
    if let (true, Some((_, error))) = (session.options.strict, layer.refused.first()) {
        return Err(error.clone());
    }
    known.tables.add(SourceTable {
        name: table.unwrap_or(&layer.name).to_owned(),
        content: match is_whole
            && path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gpkg"))
        {
            true => TableContent::GeoPackage { path, shown: name.to_owned(), layer: layer.name.clone() },
            false => TableContent::Layer(Arc::clone(&layer)),
        },
    });
    Ok(layer)
}

/// Takes notice of the files that are read with the one at `path`, also of those that may be added later.
fn seek_companions(session: &Session, path: &Path) {
    for beside in companions(path) {
        session.seek(&beside, beside.exists());
    }
}

/// The files that a script means by `name`: one, or, where `loader` takes several, those in a folder or those whose names are as a
/// pattern says, in their order. At least one.
fn find_all(
    session: &Session,
    asker: Option<&Package>,
    loader: &Loader,
    name: &str,
) -> Result<Vec<(String, PathBuf)>> {
    let (folder, last) = name.rsplit_once('/').unwrap_or((".", name));
    let is_pattern = !loader.several.is_empty() && last.contains(['*', '?']);
    let path = find(session, asker, loader.what, if is_pattern { folder } else { name })?;
    if loader.several.is_empty() || !path.is_dir() {
        return Ok(vec![(name.to_owned(), path)]);
    }
    let (folder, pattern) = if is_pattern { (folder, last) } else { (name.trim_end_matches('/'), "*") };
    let entries = std::fs::read_dir(&path)
        .map_err(|error| Error::file(&path, format!("cannot read the folder {folder}: {error}")))?;
    let mut found: Vec<String> =
        entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
    found.retain(|file| {
        let extension =
            Path::new(file).extension().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        loader.several.contains(&&*extension) && matches_pattern(pattern.as_bytes(), file.as_bytes())
    });
    found.sort();
    if found.is_empty() || found.len() > MOST_FILES {
        let count = if found.is_empty() { "no".to_owned() } else { found.len().to_string() };
        let what = format!("{name} means {count} files, each a {}", loader.what);
        return Err(Error::file(&path, what)
            .help(format!("name 1 to {MOST_FILES} files that end in .{}", loader.several.join(", ."))));
    }
    found
        .into_iter()
        .map(|file| {
            let name = if folder == "." { file } else { format!("{folder}/{file}") };
            let path = find(session, asker, loader.what, &name)?;
            Ok((name, path))
        })
        .collect()
}

/// Maximum number of files that one name can match.
const MOST_FILES: usize = 1000;

/// Returns true if a file name matches a pattern, in which `*` matches any text and `?` any byte.
fn matches_pattern(pattern: &[u8], name: &[u8]) -> bool {
    let (mut at, mut read) = (0, 0);
    // Position after the last star, to which the match returns if the rest does not fit.
    let mut star: Option<(usize, usize)> = None;
    while read < name.len() {
        match pattern.get(at) {
            Some(b'*') => {
                star = Some((at, read));
                at += 1;
            }
            Some(byte) if *byte == b'?' || *byte == name[read] => (at, read) = (at + 1, read + 1),
            _ => {
                let Some((begin, taken)) = star else { return false };
                star = Some((begin, taken + 1));
                (at, read) = (begin + 1, taken + 1);
            }
        }
    }
    pattern[at..].iter().all(|byte| *byte == b'*')
}

/// Returns the path of the file `name` of type `what`.
///
/// Searches the script's folder and the `--data` folders, or a package if `name` has a package prefix.
/// `asker` is the package that requests the file, if any.
fn find(session: &Session, asker: Option<&Package>, what: &'static str, name: &str) -> Result<PathBuf> {
    if let Some(found) = session.package_file(what, name, asker) {
        return Ok(found?.path);
    }
    let outside = || {
        Error::file(name, format!("the {what} {name} lies outside the script's folder")).help(
            "a script reads data in its own folder and below it, and in those that are given: --data FOLDER",
        )
    };
    let relative = Path::new(name);
    if is_absolute(relative) {
        return Err(Error::file(name, format!("the {what} {name} is named by a path from the root"))
            .help("name it from the script's folder, or from one that is given: --data FOLDER"));
    }
    let roots = || std::iter::once(session.root()).chain(session.data_roots().iter().map(PathBuf::as_path));
    let mut near = None;
    let mut inside = false;
    for root in roots() {
        let path = lead(root, relative);
        if !path.starts_with(root) {
            continue;
        }
        inside = true;
        let found = path.canonicalize();
        session.seek(&path, found.is_ok());
        match found {
            // A link may point from one of the folders into another.
            Ok(found) if roots().any(|root| found.starts_with(root)) => return Ok(found),
            Ok(_) => return Err(outside()),
            Err(_) => {
                let (folder, file) = (path.parent(), path.file_name());
                if let (None, Some(folder), Some(file)) = (&near, folder, file)
                    && folder.canonicalize().is_ok_and(|folder| roots().any(|root| folder.starts_with(root)))
                {
                    near = nearest_file(folder, &file.to_string_lossy());
                }
            }
        }
    }
    if !inside {
        return Err(outside());
    }
    let error = Error::not_found(what, name, near.as_deref(), format!("there is no {what} {name}"));
    Err(session.propose_packages(name, error).help(match session.data_roots().is_empty() {
        true => "it is looked for from the script's folder; other folders are given with --data FOLDER",
        false => "it is looked for from the script's folder and from those given with --data",
    }))
}

#[cfg(test)]
mod tests {
    use super::matches_pattern;

    #[test]
    fn stars_mean_any_text() {
        let is = |pattern: &str, name: &str| matches_pattern(pattern.as_bytes(), name.as_bytes());
        assert!(is("*", "a.hgt") && is("N4*.hgt", "N43E007.hgt") && is("N4?E*7.hgt", "N43E007.hgt"));
        assert!(is("**a*", "banana") && is("a", "a") && is("*", ""));
        assert!(
            !is("N4*.hgt", "N53E007.hgt")
                && !is("N4*.hgt", "N43E007.tif")
                && !is("?", "")
                && !is("a*b", "abc")
        );
    }
}
