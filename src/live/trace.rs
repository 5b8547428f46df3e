//! From the picture to the script and back: which rule made a triangle, what a line of the script made.

use super::message::{Count, Pick, Rule, Say};
use super::state::State;
use crate::derive::Derived;
use crate::run::Run;

/// The file and line that made a system.
pub(super) fn place(_system: &Derived) -> String {
    String::new()
}

/// The number of modules of each symbol.
pub(super) fn symbols(_system: &Derived) -> Vec<Count> {
    Vec::new()
}

/// The rules with what they cost.
pub(super) fn rules(_run: &Run) -> Vec<Rule> {
    Vec::new()
}

/// The module that made a triangle.
pub(super) fn pick(_state: &State, pick: &Pick) -> Say {
    unable(pick.id)
}

/// What a line of a script made.
pub(super) fn highlight(_state: &State, id: u64, _file: &str, _line: usize) -> Say {
    unable(id)
}

/// A part of a chain.
pub(super) fn chain(_state: &State, id: u64, _system: usize, _chain: usize, _module: usize) -> Say {
    unable(id)
}

fn unable(id: u64) -> Say {
    Say::Refused { id: Some(id), text: "this server cannot trace modules".into() }
}
