//! Presets and variations: named requests, and small renders with other values.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

use axum::extract::ws::Utf8Bytes;
use tokio::sync::mpsc::Sender;

use super::message::{Cause, Event};
use super::request::seed;
use super::state::ServerState;
use crate::presets::Presets;
use crate::variations::{Framing, Variation, VariationAxis, Variations};
use burgeon_base::error::{Error, Result};
use burgeon_base::locks::LockRecovery;
use burgeon_base::named_thread;
use burgeon_engine::script::{Param, ParamValues, Preset, RunOptions, Session};
use burgeon_picture::{Background, Picture, Quality};
use burgeon_scene::image;

/// Interval of progress reports of variations.
const TICK: Duration = Duration::from_millis(500);

/// Width and height (pixels) of a small render.
const SIZE: (u32, u32) = (320, 240);

/// Returns the names of the script's presets; empty if their file is invalid, which is reported when a preset is used.
pub(super) fn presets(script: &Path) -> Vec<String> {
    Presets::read(script).map(|presets| names(&presets)).unwrap_or_default()
}

fn names(presets: &Presets) -> Vec<String> {
    presets.names().map(str::to_owned).collect()
}

/// Returns the names of the script's presets and of packages' presets, such as `@castle/grand`.
fn all_names(state: &ServerState, own: &Presets) -> Vec<String> {
    let of_packages = state.package_presets.lock().recover();
    let mut all = names(own);
    for (package, path) in of_packages.iter() {
        // An error of their file is reported when one of its presets is used.
        let Ok(presets) = Presets::read_file(path) else { continue };
        all.extend(presets.names().map(|name| format!("@{package}/{name}")));
    }
    all
}

/// Returns the preset with the name `name` in pages, of the script or of a package.
fn find(state: &ServerState, own: &Presets, name: &str) -> Result<Preset> {
    let Some((package, inner)) = of_package(name) else { return own.get(name) };
    let of_packages = state.package_presets.lock().recover();
    let Some((_, path)) = of_packages.iter().find(|(known, _)| known == package) else {
        let known = of_packages.iter().map(|(known, _)| known.as_str());
        let message = format!("no package named `{package}` has presets");
        return Err(Error::not_found("package", package, known, message));
    };
    let preset = Presets::read_file(path)?.get(inner)?.of_package(package);
    Ok(Preset { name: name.to_owned(), ..preset })
}

/// Splits the name of a package's preset, such as `@castle/grand`, into package and name.
fn of_package(name: &str) -> Option<(&str, &str)> {
    name.strip_prefix('@')?.split_once('/')
}

/// Records the packages with presets that a run has found. Returns the files of their presets.
pub(super) fn find_package_presets(state: &ServerState, session: &Session) -> Vec<(PathBuf, bool)> {
    let found = session.package_presets();
    let files = session.package_preset_places();
    let mut known = state.package_presets.lock().recover();
    let is_new = *known != found;
    *known = found;
    drop(known);
    if is_new {
        presets_changed(state);
    }
    files
}

/// Saves, loads or deletes a preset; an existing preset is overwritten only if `replace` is set. Returns the answer to
/// the page.
pub(super) fn preset(state: &ServerState, action: &str, name: &str, replace: bool) -> Option<Event> {
    let mut known = state.presets.lock().recover();
    let done = match action {
        "save" | "delete" if of_package(name).is_some() => {
            Err(Error::argument(format!("{name} is a preset of a package and can only be changed there"))
                .help("save it under another name"))
        }
        "save" => save(state, name, replace).map(Some),
        "delete" => Presets::remove(&state.script, name).map(Some),
        "load" => match Presets::read(&state.script).and_then(|presets| find(state, &presets, name)) {
            Ok(preset) => {
                return state.change(None, Cause::Preset, |inner| {
                    inner.request.load(preset);
                    Ok(())
                });
            }
            Err(error) => Err(error),
        },
        _ => Err(Error::argument(format!("{action:?} cannot be done with a preset"))
            .help("save, load or delete it")),
    };
    match done {
        Ok(presets) => {
            let mut inner = state.lock();
            if let Some(presets) = &presets {
                *known = all_names(state, presets);
                inner.request.look_for_preset(|name| find(state, presets, name));
            }
            state.send(&Event::Presets { names: known.clone(), chosen: inner.request.preset() });
            None
        }
        Err(error) => Some(Event::rejection(None, &error)),
    }
}

/// Informs pages after the presets file has been edited.
pub(super) fn presets_changed(state: &ServerState) {
    let mut known = state.presets.lock().recover();
    let read = Presets::read(&state.script);
    let mut inner = state.lock();
    let event = match read {
        Ok(presets) => {
            let before = inner.request.preset();
            inner.request.look_for_preset(|name| find(state, &presets, name));
            let (names, chosen) = (all_names(state, &presets), inner.request.preset());
            if *known == names && chosen == before {
                return;
            }
            known.clone_from(&names);
            Event::Presets { names, chosen }
        }
        Err(error) => Event::rejection(None, &error),
    };
    state.send(&event);
}

/// Saves the values that are set and used, and the seed.
fn save(state: &ServerState, name: &str, replace: bool) -> Result<Presets> {
    if !replace && Presets::read(&state.script)?.names().any(|known| known == name) {
        return Err(Error::argument(format!("preset `{name}` already exists"))
            .help("choose another name, or confirm the replacement"));
    }
    let preset = {
        let inner = state.lock();
        let Some(params) = &inner.params else {
            return Err(Error::unavailable("a preset is saved when the script runs without an error"));
        };
        let params = inner.request.used_values(params);
        Preset { name: name.to_owned(), seed: Some(inner.request.seed()), params, ..Preset::default() }
    };
    let presets = Presets::save(&state.script, preset.clone())?;
    let inner = &mut *state.lock();
    // Another page may have changed the request since.
    let same = |params: &[Param]| inner.request.used_values(params) == preset.params;
    if inner.params.as_deref().is_some_and(same) && preset.seed == Some(inner.request.seed()) {
        inner.request.is_preset(preset);
    }
    Ok(presets)
}

/// Starts small renders with other values and sends them to the page through `page`. Cancels the variations in
/// progress. Returns the rejection if that fails.
pub(super) fn variations(
    state: &Arc<ServerState>,
    id: u64,
    over: Result<VariationAxis>,
    page: Sender<Utf8Bytes>,
) -> Option<Event> {
    let begin = || -> Result<Variations> {
        let over = over?;
        let inputs = {
            let inner = state.lock();
            if let (VariationAxis::Param { name, .. }, Some(params)) = (&over, &inner.params)
                && Param::find(params, name)?.is_none()
            {
                let names = params.iter().map(|param| param.name.as_str());
                let message = format!("unknown parameter `{name}`");
                return Err(Error::not_found("parameter", name, names, message));
            }
            inner.request.inputs(inner.generation)
        };
        let options = RunOptions {
            params: ParamValues { set: inputs.set, preset: None, forgiving: true },
            seed: inputs.seed,
            steps: inputs.steps,
            ..state.options.clone()
        };
        Variations::new(&state.script, options, &over)
    };
    let variations = match begin() {
        Ok(variations) => variations,
        Err(error) => return Some(Event::rejection(Some(id), &error)),
    };
    let before = state.variations.lock().recover().replace(Arc::clone(&variations.stop));
    if let Some(before) = before {
        before.stop(Error::cancellation("others are made"));
    }
    let state = Arc::clone(state);
    let make = move || {
        let picture = Picture {
            width: SIZE.0,
            height: SIZE.1,
            background: Background::Clear,
            quality: Quality::Draft,
            ..Picture::default()
        };
        let of = variations.len();
        let (over, ended) = channel::<()>();
        let gone = || variations.stop.stop(Error::cancellation("the page has gone"));
        let (running, page, state) = (&variations, &page, &*state);
        let tell = move || {
            // The loop ends when the other end of the channel is dropped.
            while ended.recv_timeout(TICK) == Err(RecvTimeoutError::Timeout) {
                let event = Event::Variations { id, ran: running.ran(), of };
                if page.blocking_send(state.to_text(&event)).is_err() {
                    return gone();
                }
            }
        };
        let made = std::thread::scope(|scope| {
            scope.spawn(tell);
            // All renders have the same scale, so that sizes can be compared.
            let made = variations.make(&picture, Framing::Together, |cell| {
                let event = variation(state, id, of, cell);
                if page.blocking_send(state.to_text(&event)).is_err() {
                    gone();
                }
            });
            drop(over);
            made
        });
        if let Err(error) = made
            && !variations.stop.is_stopped()
        {
            // An error means that the page has disconnected.
            let _ = page.blocking_send(state.to_text(&Event::rejection(Some(id), &error)));
        }
    };
    match named_thread("variations").spawn(make) {
        Ok(_) => None,
        Err(error) => {
            Some(Event::rejection(Some(id), &Error::system(format!("cannot start a thread: {error}"))))
        }
    }
}

fn variation(state: &ServerState, id: u64, of: usize, cell: Variation) -> Event {
    let mut params: BTreeMap<String, serde_json::Value> = BTreeMap::new();
    let picture = cell.made.and_then(|made| {
        params.extend(made.params.iter().map(|param| (param.name.clone(), param.value.to_json())));
        image::encode(&made.picture)
    });
    if let Some((name, value)) = cell.set {
        params.entry(name).or_insert_with(|| value.into());
    }
    let (url, error) = match picture {
        Ok(png) => (Some(state.keep_picture(png)), None),
        Err(error) => (None, Some(error.to_string())),
    };
    Event::Variation {
        id,
        index: cell.index,
        of,
        label: cell.label,
        seed: cell.seed.to_string(),
        params,
        url,
        error,
    }
}

/// Parses the axis of the variations that a page requests: seeds, or a parameter.
pub(super) fn parse_axis(
    seeds: Option<&[String]>,
    param: Option<String>,
    values: Option<Vec<String>>,
) -> Result<VariationAxis> {
    match (seeds, param, values) {
        (Some(seeds), None, None) => {
            let seeds = seeds.iter().map(|text| seed(&text.as_str().into()));
            Ok(VariationAxis::Seeds(seeds.collect::<Result<_>>()?))
        }
        (None, Some(name), Some(values)) => Ok(VariationAxis::Param { name, values }),
        _ => Err(Error::argument("variations have seeds, or a param and its values")),
    }
}
