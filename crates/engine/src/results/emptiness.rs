//! Why nothing is seen of a model, of a system, or of some of its features.

use std::sync::Arc;

use super::DerivedSystem;
use crate::declare::{RunOptions, Session};
use burgeon_base::text::shown;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_scene::Scene;

/// Whether a warning tells why nothing of some module is seen.
pub(crate) fn tells_of_emptiness(warning: &Warning) -> bool {
    use WarningKind::{DrawsNothing, HiddenModule, ReturnedModules, UndrawnModule};
    matches!(warning.kind(), DrawsNothing | HiddenModule | ReturnedModules | UndrawnModule)
}

/// The warning for an empty model of drawing objects, of which `warnings` are known.
pub(crate) fn emptiness(warnings: &[Warning], systems: &[Arc<DerivedSystem>]) -> Option<Warning> {
    let mut drawing = systems.iter().filter(|system| system.draws);
    let drawing = drawing.clone().find(|system| !system.is_placed()).or_else(|| drawing.next())?;
    let help = if warnings.iter().any(tells_of_emptiness) {
        "another warning tells why"
    } else if systems.iter().any(|system| system.is_placed()) {
        "a system that another one is to place is not shown by itself: see that it is placed"
    } else if drawing.objects.is_empty() {
        "its source has no features"
    } else if is_interpreted(drawing) {
        NO_EXTENT
    } else if drawing.steps == 0 {
        "it was derived by 0 steps: see that a rule applies to the axiom, or interpret the axiom's modules"
    } else {
        "no module of its final chain is drawn: write system:interpret(pattern, function(this, ...) ... end)"
    };
    let warning = Warning::new(WarningKind::EmptyModel, "the model is empty, for this system draws nothing");
    Some(warning.at(drawing.place.clone()).called_at(drawing.caller.clone()).help(help))
}

/// What to look for where interpretations draw nothing.
const NO_EXTENT: &str = "its interpretations draw nothing: see that lengths and scales are above 0";

/// The warning for a system that draws nothing in a model where others do, though its interpretations ran.
pub(crate) fn idleness(session: &Session, scene: &Scene, system: &DerivedSystem) -> Option<Warning> {
    let is_told = scene.triangles() == 0 || session.warnings().iter().any(tells_of_emptiness);
    if is_told || !system.draws || !is_interpreted(system) || !is_whole(session) {
        return None;
    }
    let warning = Warning::new(WarningKind::DrawsNothing, "this system draws nothing");
    Some(warning.at(system.place.clone()).called_at(system.caller.clone()).help(NO_EXTENT))
}

/// Whether nobody has asked to see less of the model.
pub(crate) fn is_whole(session: &Session) -> bool {
    session.options.steps.is_none() && session.options.lod == RunOptions::default().lod
}

/// Whether interpretation rules of a system ran.
fn is_interpreted(system: &DerivedSystem) -> bool {
    system.rules.iter().any(|rule| rule.interprets && rule.done.applied > 0)
}

/// Which features of a system were left out, and why; those that its source has told of are not counted.
pub(crate) fn left_out(system: &DerivedSystem) -> Option<Warning> {
    let mut skipped = system.remarks.iter().filter(|remark| remark.skipped && !remark.unread);
    let first = skipped.next()?;
    let (count, why) = (1 + skipped.count(), &first.why);
    let id = first.feature.as_deref().map_or_else(String::new, |id| format!(" {}", shown(id)));
    let source = if first.source.is_empty() { String::new() } else { format!(" of {}", first.source) };
    let text = match count {
        1 => format!("left out feature{id}{source}: {why}"),
        _ => format!("left out {count} of {} features, such as feature{id}{source}: {why}", system.given),
    };
    let warning = Warning::new(WarningKind::Data, text);
    let warning = warning.at(system.place.clone()).called_at(system.caller.clone());
    Some(warning.help("--report FILE lists all of them; with --strict they are errors"))
}
