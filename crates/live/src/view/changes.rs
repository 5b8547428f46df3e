//! Changed files: presets are read again, and other files start a run, unless the server itself has saved them.

use std::path::PathBuf;

use super::curves;
use super::message::Cause;
use super::state::{DueRun, ServerState};
use super::tools;
use crate::presets::Presets;
use crate::watch::Change;
use burgeon_base::error::Error;
use burgeon_base::locks::LockRecovery;
use burgeon_engine::script::CurvesFile;

/// Handles changed files.
pub(super) fn handle_changes(state: &ServerState, change: &Change) {
    let own = Presets::path_of(&state.script);
    let of_packages = state.package_presets.lock().recover();
    let (presets, others): (Vec<&PathBuf>, Vec<&PathBuf>) = change
        .files
        .iter()
        .partition(|path| **path == own || of_packages.iter().any(|(_, presets)| presets == *path));
    drop(of_packages);
    if !presets.is_empty() {
        tools::presets_changed(state);
    }
    let drawn = CurvesFile::path_of(&state.script);
    let saved = change.files.contains(&drawn) && !curves::is_changed(state);
    let is_input = |path: &&PathBuf| !(saved && **path == drawn);
    let files: Vec<String> = others.into_iter().filter(is_input).map(|path| state.name(path)).collect();
    if files.is_empty() {
        return;
    }
    state.stop_variations("the script has changed");
    let mut inner = state.lock();
    std::mem::take(&mut inner.aside).stop(Error::cancellation("the script has changed"));
    inner.generation += 1;
    inner.post(DueRun { cause: Cause::Save, files, at: change.at });
    state.wake.notify_all();
}
