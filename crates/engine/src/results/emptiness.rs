//! Warnings about an empty model, an empty system and skipped features.

use std::sync::Arc;

use super::DerivedSystem;
use crate::declare::{RunOptions, Session};
use burgeon_base::text::shown;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_scene::Scene;

/// Returns true if the warning explains why modules are not visible.
pub(crate) fn tells_of_emptiness(warning: &Warning) -> bool {
    use WarningKind::{DrawsNothing, HiddenModule, UndrawnModule};
    matches!(warning.kind(), DrawsNothing | HiddenModule | UndrawnModule)
}

/// Returns the warning for an empty model, if a system has drawing objects. `warnings` are the existing
/// warnings.
pub(crate) fn emptiness(warnings: &[Warning], systems: &[Arc<DerivedSystem>]) -> Option<Warning> {
    let mut drawing = systems.iter().filter(|system| system.draws).peekable();
    let first = drawing.peek().copied();
    let drawing = drawing.find(|system| !system.is_placed()).or(first)?;
    let help = if warnings.iter().any(tells_of_emptiness) {
        "another warning shows the reason"
    } else if systems.iter().any(|system| system.is_placed()) {
        "a system that another one places is not shown separately: check that it is placed"
    } else if drawing.objects.is_empty() {
        "its source has no features"
    } else if is_interpreted(drawing) {
        NO_EXTENT
    } else if drawing.steps == 0 {
        "the derivation has 0 steps: check that a rule applies to the axiom, or interpret the axiom's modules"
    } else if drawing.modules() == 0 && drawing.has_cut {
        "its final chain is empty, because Cut() erases itself and all that follows in its branch: put it into a branch, or behind what remains"
    } else if drawing.modules() == 0 {
        "its final chain is empty, because its rules erase all modules: return a module that is drawn, not nil"
    } else {
        "no module of its final chain is drawn: add system:interpret(pattern, function(this, ...) ... end)"
    };
    let warning = Warning::new(WarningKind::EmptyModel, "the model is empty: this system draws nothing");
    Some(drawing.locate(warning).help(help))
}

/// Advice for interpretations that draw nothing.
const NO_EXTENT: &str = "its interpretations draw nothing: check that lengths and scales are above 0";

/// Returns the warning for a system that draws nothing although its interpretations ran and other systems
/// draw.
pub(crate) fn idleness(session: &Session, scene: &Scene, system: &DerivedSystem) -> Option<Warning> {
    let is_told = scene.triangles() == 0 || session.warnings().iter().any(tells_of_emptiness);
    if is_told || !system.draws || !is_interpreted(system) || !is_whole(session) {
        return None;
    }
    let warning = Warning::new(WarningKind::DrawsNothing, "this system draws nothing");
    Some(system.locate(warning).help(NO_EXTENT))
}

/// Returns true if the options neither limit the steps or the features nor reduce the level of detail.
pub(crate) fn is_whole(session: &Session) -> bool {
    session.options.steps.is_none()
        && session.options.part.is_none()
        && session.options.lod == RunOptions::default().lod
}

/// Returns true if interpretation rules of the system ran.
fn is_interpreted(system: &DerivedSystem) -> bool {
    system.rules.iter().any(|rule| rule.interprets && rule.done.applied > 0)
}

/// Returns the warning about skipped features of a system, with the first reason. Features that the source
/// has already reported are not counted.
pub(crate) fn left_out(system: &DerivedSystem) -> Option<Warning> {
    let mut skipped =
        system.feature_warnings.iter().filter(|warning| warning.kind() == WarningKind::SkippedFeature);
    let first = skipped.next()?;
    let (count, why) = (1 + skipped.count(), first.cause());
    let id = first.feature().map_or_else(String::new, |id| format!(" {}", shown(id)));
    let source = if first.source().is_empty() { String::new() } else { format!(" of {}", first.source()) };
    let text = match count {
        1 => format!("skipped feature{id}{source}: {why}"),
        _ => format!("skipped {count} of {} features, e.g. feature{id}{source}: {why}", system.given),
    };
    let warning = Warning::new(WarningKind::Data, text);
    Some(system.locate(warning).help("--report FILE lists all; with --strict they are errors"))
}
