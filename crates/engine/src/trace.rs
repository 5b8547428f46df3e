//! Where a triangle comes from, and what a line of a script has made: a chain is derived again to find out.

use std::path::Path;

use crate::declare::{RunOptions, RunReports, Session, TraceRequest};
use crate::results::{Ancestor, Module, RuleName, RuleProducts, Trace};
use crate::run::run_traced;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_kit::Makers;
use burgeon_scene::{Origin, Part, Scene};

/// Symbols that are shown on each side of a module.
const AROUND: usize = 12;

/// A triangle of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pick {
    /// Index into [`Scene::instances`].
    pub instance: usize,
    /// The part of its mesh.
    pub part: usize,
    /// The triangle of the part.
    pub triangle: usize,
}

/// Triangles of one part of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TriangleRun {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// The part of the mesh.
    pub part: usize,
    /// The first triangle.
    pub from: usize,
    /// How many.
    pub count: usize,
}

/// A module that made something, and how it came about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModuleOrigin {
    /// Its chain.
    pub origin: Origin,
    /// Its place in the chain, brackets counted.
    pub index: usize,
    /// The module.
    pub module: Module,
    /// The rule that interprets it; `None` if the standard library does.
    pub interpretation: Option<RuleName>,
    /// The modules that led to it, from the axiom on; the last one is itself as it was made.
    pub path: Vec<Ancestor>,
    /// Where the axiom was set.
    pub axiom: Option<SourcePlace>,
    /// The chain before it, itself, and the chain after it.
    pub around: [String; 3],
    /// What it has drawn.
    pub runs: Vec<TriangleRun>,
}

/// What made a triangle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PickOrigin {
    /// The module that drew it.
    pub drawn: Option<ModuleOrigin>,
    /// The module that placed the model to which it belongs.
    pub placed: Option<ModuleOrigin>,
}

/// What a line of a script has made.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LineProducts {
    /// The rules at the line, each once.
    pub what: Vec<String>,
    /// The number of modules that came of them.
    pub modules: usize,
    /// What these have drawn.
    pub runs: Vec<TriangleRun>,
    /// The instances of models that these have placed, as indices into [`Scene::instances`].
    pub instances: Vec<usize>,
}

/// Finds the modules that made a triangle of `scene`, which a run of `script` with these `options` has made.
///
/// Derives the chain again, with its lineage. Fails if the script has changed so that it cannot.
pub fn pick(script: &Path, options: &RunOptions, scene: &Scene, pick: Pick) -> Result<PickOrigin> {
    let instance =
        scene.instances.get(pick.instance).ok_or_else(|| Error::unavailable("there is no such instance"))?;
    let mesh = &scene.meshes[instance.mesh];
    let mut picked = PickOrigin { drawn: None, placed: None };
    if let Some(origin) = mesh.origin {
        let trace = trace_chain(script, options, origin)?;
        let maker = first_makers(&trace).and_then(|makers| makers.of_triangle(pick.part, pick.triangle));
        picked.drawn = maker.and_then(|index| made(&trace, origin, index, Some(instance.mesh)));
    }
    if let (Some(origin), Some(placement)) = (instance.origin, instance.placement) {
        let trace = trace_chain(script, options, origin)?;
        let maker = first_makers(&trace).and_then(|makers| makers.of_placement(placement));
        picked.placed = maker.and_then(|index| made(&trace, origin, index, None));
    }
    Ok(picked)
}

/// Finds all that the rule, interpretation rule or axiom at a line has made in `scene`.
///
/// Derives all chains again, with their lineages.
pub fn highlight(
    script: &Path,
    options: &RunOptions,
    scene: &Scene,
    systems: usize,
    file: &str,
    line: usize,
) -> Result<LineProducts> {
    let (mut found, mut nearest) = (LineProducts::default(), 0);
    for system in 0..systems {
        let trace = trace(script, options, TraceRequest { system, chain: None })?;
        let Some(RuleProducts { name, line, made }) = trace.made_by(file, line) else { continue };
        if line < nearest {
            continue;
        }
        if line > nearest {
            (found, nearest) = (LineProducts::default(), line);
        }
        if !found.what.contains(&name) {
            found.what.push(name);
        }
        let starts = trace.starts();
        found.modules += (0..trace.len()).filter(|index| made[*index] && trace.is_module(*index)).count();
        for (chain, makers) in trace.makers().iter().enumerate() {
            let (Some(makers), true) = (makers, chain + 1 < starts.len()) else { continue };
            let wanted = |index: usize| made.get(index).copied().unwrap_or(false);
            let origin = Some(Origin { system, chain, record: Some(chain) });
            for (mesh, _) in scene.meshes.iter().enumerate().filter(|(_, mesh)| mesh.origin == origin) {
                let runs = makers.runs(wanted).into_iter();
                found.runs.extend(runs.map(|(part, from, count)| TriangleRun { mesh, part, from, count }));
            }
            let placements = makers.placements(wanted);
            let instances = scene.instances.iter().enumerate().filter(|(_, instance)| {
                instance.origin == origin
                    && instance.placement.is_some_and(|number| placements.binary_search(&number).is_ok())
            });
            found.instances.extend(instances.map(|(index, _)| index));
        }
    }
    Ok(found)
}

/// The chain number `chain` of a derived system around place `index`: what is before it, itself, what is after it, and
/// the number of symbols in the chain.
pub fn around(system: &crate::results::DerivedSystem, chain: usize, index: usize) -> ([String; 3], usize) {
    let only = system.chain.only(chain, &system.symbols.arities());
    let count = only.symbols.len().saturating_sub(1);
    let texts = crate::results::around(&only, &system.symbols, &system.values, index.min(count), AROUND);
    (texts, count)
}

fn first_makers(trace: &Trace) -> Option<&Makers> {
    trace.makers().first()?.as_ref()
}

fn made(trace: &Trace, origin: Origin, index: usize, mesh: Option<usize>) -> Option<ModuleOrigin> {
    let module = trace.module(index)?;
    let runs = match (mesh, first_makers(trace)) {
        (Some(mesh), Some(makers)) => {
            let runs = makers.runs(|maker| maker == index).into_iter();
            runs.map(|(part, from, count)| TriangleRun { mesh, part, from, count }).collect()
        }
        _ => Vec::new(),
    };
    Some(ModuleOrigin {
        origin,
        index,
        module,
        interpretation: trace.interpretation(index).cloned(),
        path: trace.path(index),
        axiom: trace.axiom().cloned(),
        around: trace.around(index, AROUND),
        runs,
    })
}

fn trace_chain(script: &Path, options: &RunOptions, origin: Origin) -> Result<Trace> {
    trace(script, options, TraceRequest { system: origin.system, chain: Some(origin.chain) })
}

/// Runs `script` until the wanted system is derived, with the lineage of the wanted chains.
pub fn trace(script: &Path, options: &RunOptions, wanted: TraceRequest) -> Result<Trace> {
    let reports = RunReports { trace: Some(wanted), ..options.reports.clone() };
    let session = Session::new(script, RunOptions { reports, ..options.clone() })?;
    run_traced(&session)?.ok_or_else(|| {
        Error::script("the script no longer derives this system")
            .help("wait until the model has been made anew")
    })
}

/// The place among all triangles of `part` of number `triangle` among those that exporters write.
pub fn exported_triangle(part: &Part, triangle: usize) -> Option<usize> {
    let written = part.triangles.iter().enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a);
    written.map(|(index, _)| index).nth(triangle)
}
