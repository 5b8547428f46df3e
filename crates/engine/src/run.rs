//! One run of a script, from the file to the scene.

use std::any::Any;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::sync::Arc;
use std::time::{Duration, Instant};

use crate::declare::{FeaturePart, Param, RunOptions, Session};
use crate::derive::ThreadPool;
use crate::machine::{Machine, Watchdog};
use crate::results::{
    DerivedSystem, FeatureReport, Times, Trace, emptiness, idleness, is_whole, left_out, tells_of_emptiness,
};
use crate::texture_sets;
use burgeon_base::error::{Error, Result};
use burgeon_base::warning::Warning;
use burgeon_packages::LockedPackage;
use burgeon_scene::{Scene, ScenePackage};

/// Result of running a script.
pub struct Run {
    /// Drawings of the systems, in the order of derivation.
    pub scene: Scene,
    /// Derived systems, in order.
    pub systems: Vec<Arc<DerivedSystem>>,
    /// Parameters that the script declares.
    pub params: Vec<Param>,
    /// Values of the sources that exports need, by type.
    services: Vec<Box<dyn Any + Send + Sync>>,
    /// Warnings, in the order of files and lines.
    pub warnings: Vec<Warning>,
    /// Report entries about the data that are not warnings, such as features without ids of their own.
    pub notes: Vec<String>,
    /// Part of the features that the run built; all features if `None`.
    pub part: Option<FeaturePart>,
    /// Time spent on the run.
    pub times: RunTimes,
}

impl Run {
    /// Returns the number of features, and the skipped and simplified features.
    pub fn report(&self) -> FeatureReport {
        let mut report = FeatureReport::default();
        for system in &self.systems {
            report.add(system.given, &system.feature_warnings);
        }
        report
    }

    /// Returns the value of type `T` of the sources, such as the projection and origin of the data.
    pub fn service<T: Any>(&self) -> Option<&T> {
        self.services.iter().find_map(|service| service.downcast_ref())
    }

    /// Records the packages of the run in its scene, with versions and content hashes. Reads all package
    /// files.
    pub fn note_packages(&mut self, session: &Session) -> Result<()> {
        self.scene.packages = session.lock()?.into_iter().map(scene_package).collect();
        Ok(())
    }

    /// Returns the warning that explains an empty model, even if the options limit steps or detail.
    ///
    /// `None` if the model has triangles, if the run built a part of the features, or if the reason is unknown.
    pub fn emptiness(&self) -> Option<Warning> {
        if self.scene.triangles() > 0 || self.part.is_some() {
            return None;
        }
        let reason = self.warnings.iter().find(|warning| tells_of_emptiness(warning)).cloned();
        reason.or_else(|| emptiness(&self.warnings, &self.systems))
    }
}

/// Returns a locked package as a scene lists it.
pub(crate) fn scene_package(locked: LockedPackage) -> ScenePackage {
    ScenePackage { name: locked.name, version: locked.version.to_string(), hash: locked.hash }
}

/// Time spent on a run.
#[derive(Debug, Clone, Copy, Default)]
pub struct RunTimes {
    /// Time for starting the virtual machine and running the script, without derivation.
    pub script: Duration,
    /// Time for the derivation of all systems.
    pub derivation: Times,
    /// Time for building the scene from the objects.
    pub scene: Duration,
}

/// Runs the script at `path`.
///
/// Call it from a thread, or from a dedicated thread pool. Inside a task of rayon's global pool it can
/// deadlock: the run waits for threads of that pool and occupies one.
pub fn run(path: &Path, options: RunOptions) -> Result<Run> {
    let session = Session::new(path, options)?;
    run_session(&session)
}

/// Runs a session, which another thread can cancel.
pub fn run_session(session: &Arc<Session>) -> Result<Run> {
    run_stages(session).map_err(|error| session.with_usage(error))
}

/// Runs the stages of a run.
fn run_stages(session: &Arc<Session>) -> Result<Run> {
    let begin = Instant::now();
    let _work = session.stop.at_work();
    let (machine, threads) = leading_machine(session)?;
    machine.run()?;
    let problems: Vec<Error> = machine.library.problems.borrow_mut().drain(..).collect();
    if !problems.is_empty() {
        return Err(Error::several(problems));
    }
    let params = session.params();
    refuse_unknown(session, &params)?;
    let mut systems: Vec<Arc<DerivedSystem>> = machine.driver.derived().into_iter().flatten().collect();
    drop((machine, threads));
    let mut times = RunTimes::default();
    for system in &systems {
        times.derivation.rewriting += system.times.rewriting;
        times.derivation.interpretation += system.times.interpretation;
    }
    times.script =
        begin.elapsed().saturating_sub(times.derivation.rewriting + times.derivation.interpretation);
    let begin = Instant::now();
    let mut scene = Scene { cameras: session.cameras(), ..Scene::default() };
    let mut idle = Vec::new();
    for (number, system) in systems.iter_mut().enumerate() {
        session.stop.check()?;
        if session.options.check {
            // Objects are not expanded.
            continue;
        }
        if system.is_placed() {
            let is_empty = system.placed_model().is_some_and(|model| model.size() == 0);
            idle.extend(is_empty.then_some(number));
            continue;
        }
        if session.options.part.is_some_and(|part| !part.has_featureless()) && system.is_featureless() {
            // The first part shows it.
            continue;
        }
        let known = scene.instances.len();
        let shown = match Arc::get_mut(system) {
            Some(system) => system.hand_over(&mut scene),
            None => system.add_to(&mut scene),
        };
        shown.map_err(|error| error.rather_at(system.place.clone()).called_from(system.caller.as_ref()))?;
        let mut meshes = scene.instances[known..].iter().map(|instance| &scene.meshes[instance.mesh]);
        idle.extend((!meshes.any(|mesh| mesh.triangles() > 0)).then_some(number));
    }
    session.stop.check()?;
    if let Some(note) = note_unplaced(&systems) {
        session.add_note(note);
    }
    systems.iter().filter_map(|system| left_out(system)).for_each(|warning| session.warn(warning));
    find_textures(&mut scene, session)?;
    texture_sets::missing_sets(&scene, session).into_iter().for_each(|warning| session.warn(warning));
    times.scene = begin.elapsed();
    if let Some(part) = session.options.part.filter(|_| scene.triangles() == 0) {
        session.add_note(part.empty_note());
    }
    if scene.triangles() == 0 && is_whole(session) {
        emptiness(&session.warnings(), &systems).into_iter().for_each(|warning| session.warn(warning));
    }
    let idle = idle.into_iter().map(|number: usize| &systems[number]);
    let idle: Vec<Warning> = idle.filter_map(|system| idleness(session, &scene, system)).collect();
    idle.into_iter().for_each(|warning| session.warn(warning));
    let warnings = session.warnings();
    if session.options.strict && !warnings.is_empty() {
        return Err(Error::several(warnings.into_iter().map(Warning::into_error).collect()));
    }
    Ok(Run {
        scene,
        systems,
        params,
        services: session.data.results(),
        warnings,
        notes: session.notes(),
        part: session.options.part,
        times,
    })
}

/// Maximum number of lines that the note on systems without placement lists.
const MOST_LINES: usize = 3;

/// Returns a report entry about systems that are not shown because rules can place them but never did.
fn note_unplaced(systems: &[Arc<DerivedSystem>]) -> Option<String> {
    let unseen = systems.iter().filter(|system| system.is_placed() && !system.has_been_placed());
    let mut lines: Vec<String> = unseen
        .filter(|system| system.objects.iter().any(|object| object.triangles() > 0))
        .filter_map(|system| system.caller.as_ref().or(system.place.as_ref()).map(ToString::to_string))
        .collect();
    let count = lines.len();
    lines.dedup();
    let more = lines.len().saturating_sub(MOST_LINES);
    lines.truncate(MOST_LINES);
    let more = if more > 0 { format!(" and {more} more") } else { String::new() };
    let lines = lines.join(", ");
    match count {
        0 => None,
        1 => Some(format!("the system in {lines} is not shown: no rule places it")),
        count => Some(format!("{count} systems are not shown: no rule places them ({lines}{more})")),
    }
}

/// Creates the main machine for a session, while the script's files are prefetched.
pub(crate) fn leading_machine(session: &Arc<Session>) -> Result<(Rc<Machine>, Rc<ThreadPool>)> {
    let problems = &session.packages().problems;
    if !problems.is_empty() {
        return Err(Error::several(problems.clone()));
    }
    session.read_ahead();
    let watchdog = Arc::new(Watchdog::new(session));
    let threads = Rc::new(ThreadPool::leading(&watchdog));
    Ok((Machine::new(session, &watchdog, Rc::clone(&threads) as _)?, threads))
}

/// Runs a session with a trace request until the trace is complete. `None` if the script does not reach it.
pub(crate) fn run_traced(session: &Arc<Session>) -> Result<Option<Trace>> {
    let _work = session.stop.at_work();
    let (machine, threads) = leading_machine(session)?;
    let ran = machine.run();
    match threads.take_trace() {
        Some(trace) => Ok(Some(trace)),
        None => ran.map(|()| None),
    }
}

/// Runs the script of a session whose options request a check only, to collect its declared parameters.
pub fn declare(session: &Arc<Session>) -> Result<()> {
    declare_with(session, &mut Vec::new(), Machine::run)
}

/// Runs `run` instead of the script, as [`declare`] does, and collects the `problems` of the rules.
pub(crate) fn declare_with(
    session: &Arc<Session>,
    problems: &mut Vec<Error>,
    run: impl FnOnce(&Machine) -> Result<()>,
) -> Result<()> {
    let _work = session.stop.at_work();
    let (machine, _threads) = leading_machine(session)?;
    let ran = run(&machine);
    problems.extend(machine.library.problems.borrow_mut().drain(..));
    ran
}

/// Refuses values for parameters that the script does not declare, and warns of such values in the file of drawn curves.
pub(crate) fn refuse_unknown(session: &Session, params: &[Param]) -> Result<()> {
    session.curves().unused(session.script(), params).into_iter().for_each(|warning| session.warn(warning));
    for (name, _) in &session.options.params.set {
        match Param::find(params, name) {
            Ok(Some(_)) => {}
            Ok(None) => session.forgive(name, no_such(session.script(), name, params))?,
            Err(error) => session.forgive(name, error)?,
        }
    }
    if let Some(preset) = &session.options.params.preset {
        for (name, _) in &preset.params {
            match Param::find(params, name) {
                Ok(Some(_)) => {}
                Ok(None) => {
                    let script = session.script().display().to_string();
                    session.forgive(name, preset.outdated(name, &script, params))?;
                }
                Err(error) => session.forgive(name, preset.refused(name, &error))?,
            }
        }
    }
    Ok(())
}

/// Returns the error for a parameter `name` that `script` does not declare.
pub fn no_such(script: &Path, name: &str, params: &[Param]) -> Error {
    let names: Vec<&str> = params.iter().map(|param| param.name.as_str()).collect();
    let message = format!("{}: unknown parameter `{name}`", script.display());
    let error = Error::not_found("parameter", name, names.iter().copied(), message);
    match names.is_empty() {
        true => error.help("the script declares no parameters"),
        false => error.help(format!("it has {}", names.join(", "))),
    }
}

/// Resolves the names of textures, normal maps and dirt maps to files in the script's folder or in packages.
fn find_textures(scene: &mut Scene, session: &Session) -> Result<()> {
    let images = scene.materials.iter_mut().flat_map(|material| {
        let normal_map = material.normal_map.as_mut().map(|map| ("normal map", &mut map.image));
        let dirt_map = material.dirt_map.as_mut().map(|map| ("dirt map", &mut map.image));
        let texture = material.texture.as_mut().map(|texture| ("texture", texture));
        texture.into_iter().chain(normal_map).chain(dirt_map)
    });
    for (what, texture) in images.filter(|(_, texture)| texture.content.is_none()) {
        let shown = texture.path.display().to_string();
        if let Some(found) = session.package_file(what, &shown, None) {
            texture.path = readable(found?.path, what, &shown)?;
            continue;
        }
        let path = session.root().join(&texture.path);
        let path = session.find_file(&path)?.ok_or_else(|| {
            let near = path.parent().zip(path.file_name());
            let near = near.and_then(|(folder, name)| session.nearest_file(folder, &name.to_string_lossy()));
            let error =
                Error::not_found(what, &shown, near.as_deref(), format!("{what} not found: \"{shown}\""));
            let error = session.propose_packages(&shown, error).at(session.place_of_string(&shown));
            error.help(format!(
                "{what}s are files next to the script: put the file there, or change its name in the script"
            ))
        })?;
        if !session.is_inside(&path) {
            return Err(Error::file(&path, format!("the {what} {shown} is outside the script's folder"))
                .help("a script can read only files in its own folder and its subfolders"));
        }
        if session.is_copy(&path) {
            texture.content = Some(texture_content(&path, what, &shown)?);
            continue;
        }
        texture.path = readable(path, what, &shown)?;
    }
    Ok(())
}

/// Maximum size (bytes) of a texture in memory.
const LARGEST_TEXTURE: u64 = 1 << 30;

/// Returns the content of an image, which is a texture or a normal map.
fn texture_content(path: &Path, what: &str, shown: &str) -> Result<Arc<[u8]>> {
    let bytes = burgeon_base::files::read(path, LARGEST_TEXTURE)
        .map_err(|error| Error::file(shown, format!("the {what} {shown} cannot be read: {error}")))?;
    Ok(bytes.into())
}

/// Returns the path of an image, which is a texture or a normal map, if the file can be opened.
fn readable(path: PathBuf, what: &str, shown: &str) -> Result<PathBuf> {
    burgeon_base::files::open(&path).map_err(|error| {
        Error::file(&path, format!("the {what} {shown} cannot be read: {error}"))
            .help(format!("{what}s are PNG or JPEG files next to the script"))
    })?;
    Ok(path)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::RunOptions;
    use burgeon_language::{LOCKED, NameKind, names};

    #[test]
    fn scripts_have_the_names_that_are_declared_and_no_others() {
        let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scripts/herb.lua");
        let registry = burgeon_objects::registry();
        let session =
            Session::new(&script, RunOptions { registry: registry.clone(), ..RunOptions::default() })
                .unwrap();
        let (machine, _threads) = leading_machine(&session).unwrap();
        let there = machine.library.globals().names;
        let declared: Vec<String> = names()
            .iter()
            .filter(|name| name.sort != NameKind::Given)
            .map(|name| name.name.to_string())
            .chain(registry.kinds().map(|kind| kind.name.to_string()))
            .collect();
        let missing: Vec<&String> = declared.iter().filter(|name| !there.contains(name)).collect();
        assert!(missing.is_empty(), "declared, but not there: {missing:?}");
        let unknown: Vec<&String> = there.iter().filter(|name| !declared.contains(name)).collect();
        assert!(unknown.is_empty(), "there, but not declared: {unknown:?}");
        assert!(there.len() > 70, "{}", there.len());
        // Locked names are removed from the scripts' globals.
        assert!(!LOCKED.iter().any(|locked| there.iter().any(|name| name == locked)));
    }

    #[test]
    fn modules_of_the_library_call_the_methods_that_are_declared() {
        let registry = burgeon_objects::registry();
        let mut modules = 0;
        for name in names() {
            let NameKind::Module { kind, method } = name.sort else { continue };
            modules += 1;
            assert!(registry.get(kind).and_then(|kind| kind.method(method)).is_some(), "{}", name.name);
        }
        assert!(modules > 20, "{modules}");
    }
}
