//! Checks of a script or a package: all problems that are found without derivation, and the declarations.

use std::path::Path;
use std::sync::Arc;

use crate::declare::{Param, RunOptions, Session};
use crate::machine::Machine;
use crate::run::{declare_with, refuse_unknown};
use burgeon_base::error::{Error, ErrorKind, Result};
use burgeon_base::warning::Warning;
use burgeon_kit::Kind;
use burgeon_packages::MANIFEST;

/// Declarations of a script, found without derivation.
#[derive(Debug, Clone)]
pub struct ScriptCheck {
    /// Declared parameters.
    pub params: Vec<Param>,
    /// Object types that the script declares or adds methods to.
    pub types: Vec<Arc<Kind>>,
    /// Warnings, in the order of files and lines.
    pub warnings: Vec<Warning>,
}

/// Checks the script and every file it requires, and compiles every rule.
///
/// Fails with all problems together. If `options` are strict, the problems include the warnings.
pub fn check(path: &Path, options: RunOptions) -> Result<ScriptCheck> {
    let session = Session::new(path, RunOptions { check: true, ..options })?;
    checked(&session, Machine::run)
}

/// Checks all Lua files of the package in `folder`, and the files that they name, as [`check`] does.
pub fn check_package(folder: &Path, options: RunOptions) -> Result<ScriptCheck> {
    let session = Session::new(&folder.join(MANIFEST), RunOptions { check: true, ..options })?;
    let packages = session.packages();
    let package = packages.order().iter().find(|package| package.folder == session.root());
    let Some(package) = package else {
        // Another package takes precedence, or a problem explains why the package is not used.
        let shown = folder.display();
        let broken = packages.broken.iter().filter(|broken| broken.folder == session.root());
        let broken = broken.map(|broken| &broken.error);
        let problems: Vec<Error> = packages.problems.iter().chain(broken).cloned().collect();
        return Err(if problems.is_empty() {
            Error::not_found("package", &shown, [], format!("the script does not use the package {shown}"))
                .help("run burgeon mods to list the packages in use")
        } else {
            Error::several(problems)
        });
    };
    checked(&session, |machine| machine.run_package(package))
}

/// Returns the object types that the script at `path` declares or adds methods to.
///
/// Ignores errors: an editor needs the types before the script is complete. If the script fails, the result
/// has the types declared up to that line.
pub fn declared_types(path: &Path, options: RunOptions) -> Vec<Arc<Kind>> {
    let Ok(session) = Session::new(path, RunOptions { check: true, ..options }) else { return Vec::new() };
    // A run or a check reports the errors of the script.
    let _ = declare_with(&session, &mut Vec::new(), Machine::run);
    session.types()
}

/// Returns the object types that the package in `folder` declares or adds methods to.
pub fn declared_types_of_package(folder: &Path, options: RunOptions) -> Vec<Arc<Kind>> {
    let options = RunOptions { check: true, ..options };
    let Ok(session) = Session::new(&folder.join(MANIFEST), options) else { return Vec::new() };
    let packages = session.packages();
    if let Some(package) = packages.order().iter().find(|package| package.folder == session.root()) {
        let _ = declare_with(&session, &mut Vec::new(), |machine| machine.run_package(package));
    }
    session.types()
}

/// Checks what `run` runs in a session whose options request a check only.
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
                // The error of the call has more detail than the error of the static analysis.
                Some(known) => *known = problem.without_others(),
                None if told => {}
                None => problems.push(problem.without_others()),
            }
        }
    }
    if let Err(error) = refuse_unknown(session, &session.params()) {
        problems.push(error);
    }
    let mut warnings = session.warnings();
    if session.options.strict {
        problems.extend(warnings.drain(..).map(Warning::into_error));
    }
    problems.sort_by(|a, b| a.place().cmp(&b.place()));
    if !problems.is_empty() {
        return Err(session.with_usage(Error::several(problems)));
    }
    Ok(ScriptCheck { params: session.params(), types: session.types(), warnings })
}

/// Returns true if both errors report the same missing name at the same location.
fn misses_same(one: &Error, other: &Error) -> bool {
    fn missed(error: &Error) -> Option<&str> {
        match error.kind() {
            ErrorKind::NotFound { name, .. } => Some(name),
            _ => None,
        }
    }
    one.place() == other.place() && missed(one).is_some() && missed(one) == missed(other)
}
