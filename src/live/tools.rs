//! Presets and variations.

use std::path::Path;

use super::message::Say;
use super::state::State;

/// The names of the script's presets.
pub(super) fn presets(_script: &Path) -> Vec<String> {
    Vec::new()
}

/// Saves, loads or deletes a preset.
pub(super) fn preset(_state: &State, _action: &str, _name: &str) -> Option<Say> {
    Some(Say::Refused { id: None, text: "this server has no presets".into() })
}

/// Draws small pictures of other values.
pub(super) fn variations(
    _state: &State,
    id: u64,
    _seeds: Option<&[String]>,
    _param: Option<&str>,
    _values: Option<&[String]>,
) -> Option<Say> {
    Some(Say::Refused { id: Some(id), text: "this server has no variations".into() })
}
