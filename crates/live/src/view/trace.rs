//! Links between the model and the script: the module that made a triangle, and the results of a line of the script.
//!
//! The engine uses the scene's meshes and parts, pages use glTF's meshes and primitives (`layout`).

use std::sync::Arc;
use std::time::Duration;

use super::job;
use super::layout::Indices;
use super::message::{
    AroundMessage, CountMessage, Event, HighlightMessage, ModuleMessage, NamedValue, OriginMessage,
    PickCommand, PickMessage, RuleMessage, RulePlace, StepMessage,
};
use super::state::{PresentModel, ServerState};
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_base::locks::LockRecovery;
use burgeon_engine::results::{DerivedSystem, RuleName};
use burgeon_engine::run::Run;
use burgeon_engine::script::RunOptions;
use burgeon_engine::trace as engine;

/// Time limit for finding the origin of a triangle or the result of a line.
const PATIENCE: Duration = Duration::from_secs(30);

/// Returns the number of modules of each symbol that occurs, the most frequent first.
pub(super) fn symbols(system: &DerivedSystem) -> Vec<CountMessage> {
    let found = system.symbols.counts(&system.chain).into_iter().filter(|(_, count)| *count > 0);
    let mut found: Vec<CountMessage> =
        found.map(|(name, count)| CountMessage { name: name.to_owned(), count }).collect();
    found.sort_by_key(|symbol| std::cmp::Reverse(symbol.count));
    found
}

/// Returns the rules of all systems with their costs.
pub(super) fn rules(state: &ServerState, run: &Run) -> Vec<RuleMessage> {
    let reports = run.systems.iter().flat_map(|system| &system.rules);
    let rules = reports.map(|report| {
        let (file, line) = place(state, report.name.place.as_ref());
        RuleMessage {
            text: report.name.text.clone(),
            kind: if report.interprets { "interpretation" } else { "rule" },
            file,
            line,
            applied: report.done.applied,
            made: report.done.made,
            ms: report.done.time.as_secs_f64() * 1e3,
        }
    });
    rules.collect()
}

/// Returns a location as pages name it; an empty file and line 0 if there is none.
fn place(state: &ServerState, place: Option<&SourcePlace>) -> (String, usize) {
    place.map_or_else(|| (String::new(), 0), |place| (state.short(&place.file), place.line))
}

/// Finds the module that made a triangle.
pub(super) fn pick(state: &ServerState, pick: &PickCommand) -> Event {
    let find = || -> Result<PickMessage> {
        let (shown, options) = present(state)?;
        let scene = &shown.run.scene;
        let indices = Indices { scene, layout: &shown.layout };
        let wanted = indices.triangle(pick)?;
        let _turn = state.tracing.lock().recover();
        let found = engine::pick(&state.script, &options, scene, wanted)?;
        let tell = |made: engine::ModuleOrigin| tell_made(state, &shown, made);
        let (main, placed) = match (found.drawn, found.placed) {
            (Some(drawn), placed) => (Some(tell(drawn)), placed.map(tell)),
            (None, placed) => (placed.map(tell), None),
        };
        Ok(PickMessage { id: pick.id, found: main.is_some(), made: main, placed, instance: pick.instance })
    };
    find().map_or_else(|error| rejection(pick.id, &error), |picked| Event::Picked(Box::new(picked)))
}

/// Finds the modules and triangles that a line of a script made.
pub(super) fn highlight(state: &ServerState, id: u64, file: &str, line: usize) -> Event {
    let find = || -> Result<HighlightMessage> {
        let (shown, options) = present(state)?;
        let path = state.own_file(file)?;
        let lines = std::fs::read_to_string(&path).map_or(0, |text| text.lines().count());
        if !(1..=lines).contains(&line) {
            let s = if lines == 1 { "" } else { "s" };
            let message = format!("unknown line {line}: {file} has {lines} line{s}");
            return Err(Error::not_found("line", line, [], message));
        }
        let name = state.engine_name(&path);
        let scene = &shown.run.scene;
        let _turn = state.tracing.lock().recover();
        let systems = shown.run.systems.len();
        let found = engine::highlight(&state.script, &options, scene, systems, &name, line)?;
        let mut indices = Indices { scene, layout: &shown.layout };
        let mut ranges = indices.ranges(&found.runs);
        ranges.extend(indices.instance_ranges(&found.instances));
        let what = found.what.join(", ");
        Ok(HighlightMessage { id, file: file.to_owned(), line, what, modules: found.modules, ranges })
    };
    find().map_or_else(|error| rejection(id, &error), |found| Event::Highlighted(Box::new(found)))
}

/// Returns a part of a chain.
pub(super) fn chain(state: &ServerState, id: u64, system: usize, chain: usize, module: usize) -> Event {
    let shown = state.shown();
    let derived = shown.as_ref().and_then(|shown| system_of(&shown.run, system));
    match derived.filter(|derived| chain < derived.features.len()) {
        Some(derived) => {
            let ([before, at, after], of) = engine::around(derived, chain, module);
            Event::Chain { id, system, chain, module, of, text: AroundMessage { before, at, after } }
        }
        None => rejection(id, &Error::unavailable(format!("unknown chain {chain} of system {system}"))),
    }
}

/// Returns the present model, and the options with which its script was run. Fails if the script has changed since.
pub(super) fn present(state: &ServerState) -> Result<(Arc<PresentModel>, RunOptions)> {
    let inner = state.lock();
    let Some(shown) = inner.shown.clone() else { return Err(Error::unavailable("no model yet")) };
    if inner.generation != shown.inputs.generation {
        return Err(Error::unavailable("the script has changed since this model was made")
            .help("fix the script to get a new model"));
    }
    let mut options = job::options(state, &shown.inputs);
    options.reports.print = None;
    options.reports.profile = false;
    options.limits.time = options.limits.time.min(PATIENCE);
    options.stop = Some(Arc::clone(&inner.aside));
    Ok((shown, options))
}

fn system_of(run: &Run, number: usize) -> Option<&Arc<DerivedSystem>> {
    run.systems.iter().find(|system| system.system == number)
}

fn tell_made(state: &ServerState, shown: &PresentModel, made: engine::ModuleOrigin) -> OriginMessage {
    let rule_at = |rule: RuleName| {
        let (file, line) = place(state, rule.place.as_ref());
        RulePlace { text: rule.text, file, line }
    };
    let axiom = made.axiom.as_ref();
    let path = made.path.into_iter().map(|ancestor| {
        let made_by = ancestor.rule.as_ref().or(ancestor.answer.as_ref());
        let (file, line) = place(state, made_by.map_or(axiom, |made_by| made_by.place.as_ref()));
        StepMessage {
            step: ancestor.step,
            module: ancestor.module.text,
            rule: ancestor.rule.map(|rule| rule.text),
            file,
            line,
            ordinal: ancestor.ordinal,
            answer: ancestor.answer.map(|answer| answer.text),
            asked: ancestor.asked,
        }
    });
    let [before, at, after] = made.around;
    let params = made.module.params.into_iter();
    let features = system_of(&shown.run, made.origin.system).map(|system| &system.features);
    OriginMessage {
        system: made.origin.system,
        chain: made.origin.chain,
        feature: features.and_then(|features| features.get(made.origin.chain)?.clone()),
        module: ModuleMessage {
            text: made.module.text,
            symbol: made.module.symbol,
            params: params.map(|(name, value)| NamedValue { name, value }).collect(),
            index: made.index,
        },
        interpretation: made.interpretation.map(rule_at),
        path: path.collect(),
        chain_text: AroundMessage { before, at, after },
        ranges: Indices { scene: &shown.run.scene, layout: &shown.layout }.ranges(&made.runs),
    }
}

fn rejection(id: u64, error: &Error) -> Event {
    Event::rejection(Some(id), error)
}
