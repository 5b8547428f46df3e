//! What scripts get of data files: which they may read, and how a run reads each of them once.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

use super::paths::{is_absolute, lead};
use super::session::Session;
use crate::budget::Budget;
use crate::error::{Error, Result};
use crate::objects::import::Wanted as WantedModel;
use crate::objects::terrain::EditFile;
use crate::objects::{Elevation, Model};
use crate::sources::elevation::{Raster, Relief, Wanted as WantedHeights};
use crate::sources::{Cache, Frame, Layer, Source, Wanted, nearest_file, split_name};

/// The data of a run. All virtual machines call `source` in the same order, so whoever comes first decides nothing
/// that another would decide otherwise; and what was read once is not read again.
#[derive(Default)]
pub(crate) struct Data {
    known: Mutex<Known>,
}

#[derive(Default)]
struct Known {
    /// The projection and the origin, which the first source decides.
    frame: Option<Frame>,
    loaded: BTreeMap<String, Result<Arc<Layer>>>,
    models: BTreeMap<PathBuf, Result<Arc<Model>>>,
    edits: BTreeMap<PathBuf, Result<EditFile>>,
    elevations: BTreeMap<String, Result<Elevation>>,
    /// What all reading of the run may take.
    budget: Option<Arc<Budget>>,
}

impl Known {
    fn budget(&mut self, session: &Session) -> Arc<Budget> {
        let make = || {
            let stop = Arc::clone(&session.stop);
            Budget::new(session.options.limits.memory, move || stop.check())
        };
        Arc::clone(self.budget.get_or_insert_with(make))
    }
}

impl Data {
    /// The features that `source(text, wanted)` means.
    pub(crate) fn load(&self, session: &Arc<Session>, text: &str, mut wanted: Wanted) -> Result<Arc<Layer>> {
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let key = format!("{text:?} {wanted:?}");
        if let Some(loaded) = known.loaded.get(&key) {
            return loaded.clone();
        }
        wanted.budget = known.budget(session);
        let before = wanted.budget.taken();
        let loaded = read(session, text, wanted, &mut known);
        session.stop.check()?;
        let kept = loaded.as_ref().map_or(0, |layer| layer.size());
        known.budget(session).settle(before, kept);
        known.loaded.insert(key, loaded.clone());
        loaded
    }
}

impl Data {
    /// The model that `model(name)` means: the same one each time.
    pub(crate) fn model(&self, session: &Session, name: &str) -> Result<Arc<Model>> {
        let example = "write model(\"window.glb\")";
        if name.is_empty() {
            return Err(Error::argument("model needs the name of a file").help(example));
        }
        let path = find(session, "model", name)?;
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(model) = known.models.get(&path) {
            return model.clone();
        }
        let budget = known.budget(session);
        let before = budget.taken();
        let read = read_model(session, &path, name, &budget);
        session.stop.check()?;
        budget.settle(before, read.as_ref().map_or(0, |model| model.memory()));
        known.models.insert(path, read.clone());
        read
    }
}

impl Data {
    /// The heights that `elevation(name, wanted)` means: the same ones each time.
    pub(crate) fn elevation(
        &self,
        session: &Session,
        name: &str,
        wanted: &WantedHeights,
    ) -> Result<Elevation> {
        if name.is_empty() {
            return Err(Error::argument("elevation needs the name of a file")
                .help("write elevation(\"N43E007.hgt\")"));
        }
        let path = find(session, "file of heights", name)?;
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let key = format!("{} {wanted:?}", path.display());
        if let Some(loaded) = known.elevations.get(&key) {
            return loaded.clone();
        }
        let loaded = read_heights(session, &path, name, wanted, &mut known);
        session.stop.check()?;
        known.elevations.insert(key, loaded.clone());
        loaded
    }
}

impl Data {
    /// The changes of the ground that `edits(name)` means.
    pub(crate) fn edits(&self, session: &Session, name: &str) -> Result<EditFile> {
        if name.is_empty() {
            return Err(
                Error::argument("edits needs the name of a file").help("write edits(\"ground.json\")")
            );
        }
        let path = find(session, "file of edits", name)?;
        let mut known = self.known.lock().unwrap_or_else(PoisonError::into_inner);
        let budget = known.budget(session);
        let read = || -> Result<EditFile> {
            let text = String::from_utf8(read_file(&path, name, "name a .json file", &budget)?)
                .map_err(|_| Error::data(format!("{name} is not text, so it holds no edits of a terrain")))?;
            Ok(EditFile { name: name.to_owned(), text: text.into() })
        };
        known.edits.entry(path.clone()).or_insert_with(read).clone()
    }

    /// The projection and the origin of the run, if any data has decided them.
    pub(crate) fn frame(&self) -> Option<Frame> {
        self.known.lock().unwrap_or_else(PoisonError::into_inner).frame.clone()
    }
}

fn read_heights(
    session: &Session,
    path: &Path,
    name: &str,
    wanted: &WantedHeights,
    known: &mut Known,
) -> Result<Elevation> {
    let budget = known.budget(session);
    let before = budget.taken();
    let raster = match session.options.cache.as_deref() {
        Some(cache) => cache.raster(path, name, wanted, &budget),
        None => Raster::open(path, name, wanted, &budget).map(Arc::new),
    };
    // A raster that is kept from an earlier run was not read for this one, and takes its room all the same.
    let kept = raster.as_ref().map_or(0, |raster| raster.heights.len() * size_of::<f32>());
    budget.settle(before, kept);
    let raster = raster?;
    Ok(Elevation::new(Arc::new(Relief::new(raster, &mut known.frame)?)))
}

/// The largest file (bytes) of a model.
const LARGEST: u64 = 1_000_000_000;

fn read_model(session: &Session, path: &Path, name: &str, budget: &Budget) -> Result<Arc<Model>> {
    let remedy = "name a .glb or .gltf file";
    let content = read_file(path, name, remedy, budget)?;
    // Files beside it are named from its own folder.
    let folder = Path::new(name).parent().map(Path::to_path_buf).unwrap_or_default();
    let mut beside = |uri: &str| {
        let name = folder.join(uri).display().to_string();
        read_file(&find(session, "file of a model", &name)?, &name, remedy, budget)
    };
    let triangles = session.options.limits.triangles;
    crate::objects::import::model(&content, &mut WantedModel { name, triangles, budget, beside: &mut beside })
}

/// The content of a file, for which memory is taken.
fn read_file(path: &Path, name: &str, remedy: &str, budget: &Budget) -> Result<Vec<u8>> {
    let cannot = |why: &dyn std::fmt::Display| Error::file(path, format!("cannot read {name}: {why}"));
    let (_, meta) = crate::files::open(path).map_err(|error| cannot(&error).help(remedy))?;
    if meta.len() > LARGEST {
        return Err(cannot(&format!("it is larger than {} MB", LARGEST / 1_000_000)).help("simplify it"));
    }
    budget.check()?;
    budget.take(usize::try_from(meta.len()).unwrap_or(usize::MAX))?;
    crate::files::read(path, meta.len()).map_err(|error| cannot(&error).help(remedy))
}

fn read(session: &Session, text: &str, mut wanted: Wanted, known: &mut Known) -> Result<Arc<Layer>> {
    let (name, layer) = split_name(text);
    wanted.layer = wanted.layer.or_else(|| layer.map(str::to_owned));
    if name.is_empty() {
        return Err(
            Error::argument("source needs the name of a file").help("write source(\"village.geojson\")")
        );
    }
    let path = find(session, "data file", name)?;
    let cache = session.options.cache.as_deref();
    let key = cache.and_then(|_| Cache::key(&path, &wanted, known.frame.as_ref()));
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
    Ok(layer)
}

/// The file that a script means by `name`, which is to be a `what`: in its own folder, or in one of those given with
/// `--data`.
fn find(session: &Session, what: &'static str, name: &str) -> Result<PathBuf> {
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
            // A link may lead from one of the folders into another.
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
    Err(error.help(match session.data_roots().is_empty() {
        true => "it is looked for from the script's folder; other folders are given with --data FOLDER",
        false => "it is looked for from the script's folder and from those given with --data",
    }))
}
