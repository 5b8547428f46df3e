//! Description of a run for pages: counts, systems, rules and times, and the reason if the model is empty.

use std::time::Duration;

use super::job::{PROBLEMS, RunJob};
use super::message::{Bounds, ModelMessage, SystemMessage, TimesMessage};
use super::state::ServerState;
use super::{cameras, trace};
use burgeon_engine::run::Run;
use burgeon_engine::script::Session;
use serde_json::json;

/// Describes a run for pages, except for the parts that depend on the request and on the model's bytes.
pub(super) fn describe(state: &ServerState, job: &RunJob, session: &Session, run: &Run) -> ModelMessage {
    let mut files: Vec<String> = session.files().iter().map(|path| state.name(path)).collect();
    let textures = run.scene.materials.iter().flat_map(|material| material.images());
    let textures = textures.filter(|texture| texture.content.is_none());
    files.extend(textures.map(|texture| state.name(&texture.path)));
    files.extend(state.options.inputs.stdlib.iter().map(|path| path.display().to_string()));
    files.sort();
    files.dedup();
    let systems = run.systems.iter().map(|system| {
        let place = system.place.as_ref();
        SystemMessage {
            system: system.system,
            place: place.map(|it| format!("{}:{}", state.short(&it.file), it.line)).unwrap_or_default(),
            chains: system.features.len(),
            modules: system.modules(),
            steps: system.steps,
            symbols: trace::symbols(system),
        }
    });
    let bounds = run.scene.bounds();
    ModelMessage {
        run: job.run,
        cause: job.due.cause,
        url: None,
        bytes: 0,
        triangles: run.scene.triangles(),
        instances: run.scene.instances.len(),
        modules: run.systems.iter().map(|system| system.modules()).sum(),
        bounds: bounds.map(|(low, high)| Bounds { low: low.to_array(), high: high.to_array() }),
        steps: run.systems.iter().map(|system| system.steps).max().unwrap_or(0),
        last_step: 0,
        step_limit: job.inputs.steps,
        seed: job.inputs.seed.to_string(),
        preset: None,
        nothing: (run.scene.triangles() == 0).then(|| nothing(run, job.inputs.steps)),
        params: Vec::new(),
        cameras: cameras::declared(state, run),
        systems: systems.collect(),
        rules: trace::rules(state, run),
        times: TimesMessage {
            script: ms(run.times.script),
            rewriting: ms(run.times.derivation.rewriting),
            interpretation: ms(run.times.derivation.interpretation),
            scene: ms(run.times.scene),
            encode: 0.0,
            total: 0.0,
        },
        files,
        warnings: run.warnings.iter().take(PROBLEMS).map(|warning| state.warning_json(warning)).collect(),
        notes: remark(state, run)
            .map(|(message, help)| json!({ "message": message, "help": help }))
            .into_iter()
            .collect(),
    }
}

/// Returns a summary of skipped and simplified features and a command that lists them, or `None` if there are none.
pub(super) fn remark(state: &ServerState, run: &Run) -> Option<(String, String)> {
    let report = run.report();
    let help = || format!("burgeon run {} --report FILE lists them", state.script.display());
    (!report.is_clean()).then(|| (report.to_string(), help()))
}

/// Returns the reason that a run draws nothing, and a remedy.
fn nothing(run: &Run, limit: Option<usize>) -> String {
    let modules: usize = run.systems.iter().map(|system| system.modules()).sum();
    let steps = run.systems.iter().map(|system| system.steps).max().unwrap_or(0);
    let at_limit = limit.is_some_and(|limit| steps >= limit);
    let after = (steps != 1).then(|| format!("{steps} steps"));
    let after = after.as_deref().unwrap_or("1 step");
    if let Some(part) = run.part {
        part.empty_note()
    } else if run.systems.is_empty() {
        "the script derives no system: end it with system:derive()".to_owned()
    } else if at_limit {
        format!("nothing is drawn after {after}: show a later one")
    } else if modules == 0 {
        format!("the chain is empty after {after}: keep modules that are drawn")
    } else if let Some(warning) = run.emptiness() {
        let message = warning.message();
        warning.remedy().map_or_else(|| message.to_owned(), |remedy| format!("{message}: {remedy}"))
    } else {
        let counts = run.systems.iter().flat_map(|system| trace::symbols(system));
        let most = counts.max_by_key(|symbol| symbol.count).map_or_else(String::new, |symbol| symbol.name);
        let who = (modules != 1).then(|| format!("none of the {modules} modules is drawn"));
        let who = who.as_deref().unwrap_or("the only module is not drawn");
        format!("{who}: add system:interpret(\"{most}\", function(this) ... end)")
    }
}

pub(super) fn ms(duration: Duration) -> f64 {
    duration.as_secs_f64() * 1e3
}
