//! Origin of a triangle, and products of a line of a script. Both derive the chain again, with its lineage.

use std::path::Path;

use crate::declare::{RunOptions, Session, TraceRequest};
use crate::results::{Ancestor, Module, RuleName, RuleProducts, Trace};
use crate::run::run_traced;
use burgeon_base::error::{Error, Result, SourcePlace};
use burgeon_kit::Makers;
use burgeon_scene::{Origin, Part, Scene};

/// Number of symbols shown on each side of a module.
const AROUND: usize = 12;

/// A triangle of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pick {
    /// Index into [`Scene::instances`].
    pub instance: usize,
    /// Index of the part in its mesh.
    pub part: usize,
    /// Index of the triangle in its part.
    pub triangle: usize,
}

/// Consecutive triangles of one part of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct TriangleRun {
    /// Index into [`Scene::meshes`].
    pub mesh: usize,
    /// Index of the part in the mesh.
    pub part: usize,
    /// First triangle.
    pub from: usize,
    /// Number of triangles.
    pub count: usize,
}

/// Module that made something, with its lineage.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ModuleOrigin {
    /// System and chain of the module.
    pub origin: Origin,
    /// Index of the module in its chain, counting brackets.
    pub index: usize,
    /// Name and parameters.
    pub module: Module,
    /// Interpretation rule of the module; `None` if the standard library interprets it.
    pub interpretation: Option<RuleName>,
    /// Ancestors from the axiom on; the last entry is the module itself.
    pub path: Vec<Ancestor>,
    /// Location where the axiom was set.
    pub axiom: Option<SourcePlace>,
    /// Text of the chain before the module, of the module, and of the chain after it.
    pub around: [String; 3],
    /// Triangles that the module has drawn.
    pub runs: Vec<TriangleRun>,
}

/// Origin of a triangle.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PickOrigin {
    /// Module that drew the triangle.
    pub drawn: Option<ModuleOrigin>,
    /// Module that placed the model of the triangle.
    pub placed: Option<ModuleOrigin>,
}

/// Products of a line of a script.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct LineProducts {
    /// Rules at the line, without duplicates.
    pub what: Vec<String>,
    /// Number of modules made by these rules.
    pub modules: usize,
    /// Triangles drawn by these modules.
    pub runs: Vec<TriangleRun>,
    /// Instances of models placed by these modules, as indices into [`Scene::instances`].
    pub instances: Vec<usize>,
}

/// Finds the modules that made a triangle of `scene`, which a run of `script` with these `options` has made.
///
/// Derives the chain again, with its lineage. Fails if the changed script no longer derives the chain.
pub fn pick(script: &Path, options: &RunOptions, scene: &Scene, pick: Pick) -> Result<PickOrigin> {
    let instance =
        scene.instances.get(pick.instance).ok_or_else(|| Error::unavailable("unknown instance"))?;
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

/// Finds everything in `scene` that the rule, interpretation rule or axiom at a line has made.
///
/// Derives all chains again, with their lineage.
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
        if !found.what.iter().any(|known| known == name) {
            found.what.push(name.to_owned());
        }
        found.add(scene, &trace, system, &made);
    }
    Ok(found)
}

/// Finds everything in `scene` that the modules of a symbol have made.
///
/// Derives all chains of the system again, with their lineage.
pub fn highlight_symbol(
    script: &Path,
    options: &RunOptions,
    scene: &Scene,
    system: usize,
    symbol: &str,
) -> Result<LineProducts> {
    let trace = trace(script, options, TraceRequest { system, chain: None })?;
    let mut found = LineProducts::default();
    found.add(scene, &trace, system, &trace.named(symbol));
    Ok(found)
}

impl LineProducts {
    /// Adds what the `made` symbols of the final chain have made in `scene`.
    fn add(&mut self, scene: &Scene, trace: &Trace, system: usize, made: &[bool]) {
        let starts = trace.starts();
        let is_made = |index: usize| made.get(index).copied().unwrap_or(false);
        self.modules += (0..trace.len()).filter(|index| is_made(*index) && trace.is_module(*index)).count();
        for (chain, makers) in trace.makers().iter().enumerate() {
            let (Some(makers), true) = (makers, chain + 1 < starts.len()) else { continue };
            let origin = Some(Origin { system, chain, record: Some(chain) });
            for (mesh, _) in scene.meshes.iter().enumerate().filter(|(_, mesh)| mesh.origin == origin) {
                let runs = makers.runs(is_made).into_iter();
                self.runs.extend(runs.map(|(part, from, count)| TriangleRun { mesh, part, from, count }));
            }
            let placements = makers.placements(is_made);
            let instances = scene.instances.iter().enumerate().filter(|(_, instance)| {
                instance.origin == origin
                    && instance.placement.is_some_and(|number| placements.binary_search(&number).is_ok())
            });
            self.instances.extend(instances.map(|(index, _)| index));
        }
    }
}

/// Returns the text of chain `chain` of a derived system around symbol `index`: the chain before it, the
/// symbol, the chain after it; and the number of symbols in the chain.
pub fn around(system: &crate::results::DerivedSystem, chain: usize, index: usize) -> ([String; 3], usize) {
    let only = system.chain.single_chain(chain, &system.symbols.arities());
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
    let mut options = options.clone();
    options.reports.trace = Some(wanted);
    let session = Session::new(script, options)?;
    run_traced(&session)?.ok_or_else(|| {
        Error::script("the script no longer derives this system").help("wait until the model is updated")
    })
}

/// Converts the index of an exported triangle to its index among all triangles of `part`. Exporters skip
/// degenerate triangles.
pub fn exported_triangle(part: &Part, triangle: usize) -> Option<usize> {
    let written = part.triangles.iter().enumerate().filter(|(_, [a, b, c])| a != b && b != c && c != a);
    written.map(|(index, _)| index).nth(triangle)
}
