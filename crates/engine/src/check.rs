//! What a script or a package declares, and every problem that is found without deriving anything.

use std::path::Path;
use std::sync::Arc;

use crate::declare::{Param, RunOptions, Session};
use crate::machine::Machine;
use crate::run::{declare_with, refuse_unknown};
use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::Kind;
use burgeon_packages::MANIFEST;

/// What a script declares, without deriving anything.
#[derive(Debug, Clone)]
pub struct ScriptCheck {
    /// Its parameters.
    pub params: Vec<Param>,
    /// The types of objects that it declares, and those that it adds methods to.
    pub types: Vec<Arc<Kind>>,
    /// What people should know of it, in the order of files and lines.
    pub warnings: Vec<Warning>,
}

/// Reads the script and everything it requires, compiles every rule, and tells all problems at once; those that a strict
/// run would end with are among them if it is to be strict.
pub fn check(path: &Path, options: RunOptions) -> Result<ScriptCheck> {
    let session = Session::new(path, RunOptions { check: true, ..options })?;
    checked(&session, Machine::run)
}

/// The same of all Lua files of the package in `folder`, and of the files that they name.
pub fn check_package(folder: &Path, options: RunOptions) -> Result<ScriptCheck> {
    let session = Session::new(&folder.join(MANIFEST), RunOptions { check: true, ..options })?;
    let packages = session.packages();
    let package = packages.order().iter().find(|package| package.folder == session.root());
    let Some(package) = package else {
        // It is hidden by another one, or there is a problem that tells why.
        let shown = folder.display();
        let broken = packages.broken.iter().filter(|broken| broken.folder == session.root());
        let broken = broken.map(|broken| broken.error.clone());
        let problems: Vec<Error> = packages.problems.iter().cloned().chain(broken).collect();
        return Err(if problems.is_empty() {
            Error::not_found("package", &shown, [], format!("{shown} is no package that is used"))
                .help("burgeon mods lists those that are")
        } else {
            Error::several(problems)
        });
    };
    checked(&session, |machine| machine.run_package(package))
}

/// The types of objects that the script at `path` declares, and those that it adds methods to, as far as it comes: for
/// editors, which are of use before a script is complete.
pub fn declared_types(path: &Path, options: RunOptions) -> Vec<Arc<Kind>> {
    let Ok(session) = Session::new(path, RunOptions { check: true, ..options }) else { return Vec::new() };
    // What is wrong with it is told when it is run or checked.
    let _ = declare_with(&session, &mut Vec::new(), Machine::run);
    session.types()
}

/// The same of the package in `folder`.
pub fn declared_types_of_package(folder: &Path, options: RunOptions) -> Vec<Arc<Kind>> {
    let options = RunOptions { check: true, ..options };
    let Ok(session) = Session::new(&folder.join(MANIFEST), options) else { return Vec::new() };
    let packages = session.packages();
    if let Some(package) = packages.order().iter().find(|package| package.folder == session.root()) {
        let _ = declare_with(&session, &mut Vec::new(), |machine| machine.run_package(package));
    }
    session.types()
}

/// What comes of `run` in a session whose options say to check only.
fn checked(session: &Arc<Session>, run: impl FnOnce(&Machine) -> Result<()>) -> Result<ScriptCheck> {
    let mut found = Vec::new();
    let ran = declare_with(session, &mut found, run);
    let mut problems = session.problems();
    problems.extend(session.call_problems());
    problems.retain(|known| !found.iter().any(|found| misses_same(known, found)));
    problems.extend(found);
    if let Err(error) = ran {
        for problem in error.problems() {
            let told =
                problems.iter().any(|known| known.place().is_some() && known.place() == problem.place());
            match problems.iter_mut().find(|known| misses_same(known, problem)) {
                // Whoever ran into it knows more of it than whoever read it.
                Some(known) => *known = problem.alone(),
                None if told => {}
                None => problems.push(problem.alone()),
            }
        }
    }
    if let Err(error) = refuse_unknown(session, &session.params()) {
        problems.push(error);
    }
    let warnings = session.warnings();
    if session.options.strict {
        problems.extend(warnings.iter().cloned().map(Warning::into_error));
    }
    problems.sort_by(|a, b| a.place().cmp(&b.place()));
    if !problems.is_empty() {
        return Err(Error::several(problems));
    }
    Ok(ScriptCheck { params: session.params(), types: session.types(), warnings })
}

/// Whether two errors miss the same name in the same place.
fn misses_same(one: &Error, other: &Error) -> bool {
    let missed = |error: &Error| match error.kind() {
        ErrorKind::NotFound { name, .. } => Some(name.clone()),
        _ => None,
    };
    one.place() == other.place() && missed(one).is_some() && missed(one) == missed(other)
}
