//! Layers of data files.

use std::path::Path;
use std::sync::Arc;

use super::data_store::LoadedSources;
use super::provider::SourceReading;
use super::servers;
use super::survey::SurveyedSource;
use super::tables::{SourceTable, TableContent};
use burgeon_base::error::{Error, Result};
use burgeon_data::{Cache, Layer, Source, SourceOptions, companions, split_name};
use burgeon_kit::SourceRequest;
use burgeon_spatial::ReferenceFrame;

/// Reads the layer that `source(text, wanted)` names, and adds it as the table `table`, or as a table of its own name. `key`
/// identifies the call.
pub(super) fn read(
    request: &SourceRequest<'_>,
    (text, key): (&str, &str),
    mut wanted: SourceOptions,
    known: &mut LoadedSources,
    table: Option<&str>,
) -> Result<Arc<Layer>> {
    if text.starts_with("postgres://") || text.starts_with("postgresql://") {
        return servers::read(request, text, wanted, known, table);
    }
    let (name, layer) = split_name(text);
    let SourceOptions { condition, tags, within, limit, id, kind, crs, layer: _, records: _, budget: _ } =
        &wanted;
    let is_whole = (condition, within, limit, id, kind, crs) == (&None, &None, &None, &None, &None, &None)
        && tags.is_none();
    wanted.layer = wanted.layer.or_else(|| layer.map(str::to_owned));
    if name.is_empty() {
        return Err(Error::argument("source needs a file name").help("write source(\"village.geojson\")"));
    }
    let path = request.resources.find("data file", name)?;
    for beside in companions(&path) {
        request.resources.seek(&beside, beside.exists());
    }
    let LoadedSources { frame, cache, reading, .. } = &mut *known;
    let layer = match reading {
        SourceReading::Whole => read_whole(&path, name, &wanted, cache.as_deref(), frame)?,
        SourceReading::Survey(survey) => {
            let (key, name, options) = (key.to_owned(), name.to_owned(), wanted);
            let found = SurveyedSource { key, path: path.clone(), name, options, label: String::new() };
            Arc::new(survey.read(found, frame)?)
        }
        SourceReading::Window(window) => {
            let cache = cache.as_deref();
            let part = lending(cache, &path, &wanted, || window.read(key, &path, name, &wanted));
            let layer = match part? {
                Some(layer) => Arc::new(layer),
                None => {
                    let whole = read_whole(&path, name, &wanted, cache, frame)?;
                    window.choose(key, &whole).map_or(whole, Arc::new)
                }
            };
            window.serve(key, &layer);
            layer
        }
    };
    if let (true, Some((_, error))) = (request.is_strict, layer.refused.first()) {
        return Err(error.clone());
    }
    let is_package = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("gpkg"));
    known.tables.add(SourceTable {
        name: table.unwrap_or(&layer.name).to_owned(),
        content: match is_whole && is_package {
            true => TableContent::GeoPackage { path, shown: name.to_owned(), layer: layer.name.clone() },
            false => TableContent::Layer(Arc::clone(&layer)),
        },
    });
    Ok(layer)
}

/// Calls `read` with the copy of the database at `path` that an earlier run has made, if any, and keeps its copy.
#[cfg(feature = "data")]
fn lending<T>(cache: Option<&Cache>, path: &Path, wanted: &SourceOptions, read: impl FnOnce() -> T) -> T {
    if let Some(cache) = cache {
        cache.lend_copy(path, &wanted.budget);
    }
    let read = read();
    if let Some(cache) = cache {
        cache.keep_copy(path, &wanted.budget);
    }
    read
}

/// Calls `read`; without database support there are no copies.
#[cfg(not(feature = "data"))]
fn lending<T>(_: Option<&Cache>, _: &Path, _: &SourceOptions, read: impl FnOnce() -> T) -> T {
    read()
}

/// Reads all features of a layer, or returns them from the cache.
fn read_whole(
    path: &Path,
    name: &str,
    wanted: &SourceOptions,
    cache: Option<&Cache>,
    frame: &mut Option<ReferenceFrame>,
) -> Result<Arc<Layer>> {
    let key = match cache {
        Some(_) => Cache::key(path, name, wanted, frame.as_ref())?,
        None => None,
    };
    if let Some((layer, known)) = cache.zip(key.as_deref()).and_then(|(cache, key)| cache.get(key)) {
        *frame = Some(known);
        return Ok(layer);
    }
    let table = Source::open_within(path, name, wanted)?.read(name, wanted)?;
    let label = table.shown.clone();
    let layer = Layer::new(table, frame).map_err(|error| error.about(&label))?;
    let layer = Arc::new(layer);
    if let (Some(cache), Some(key), Some(frame)) = (cache, key, &*frame) {
        cache.keep(key, &layer, frame);
    }
    Ok(layer)
}
