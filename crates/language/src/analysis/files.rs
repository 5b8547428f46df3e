//! Checks the calls of all files of a script against the declarations. Required files are checked first.

use std::cell::RefCell;
use std::collections::BTreeMap;

use full_moon::ast::Ast;
use rustc_hash::FxHashMap;

use super::calls::CallCheck;
use super::inference::Inference;
use super::script::STACK;
use burgeon_base::error::Error;
use burgeon_kit::Registry;

/// A file whose calls are checked.
pub struct CheckedFile<'a> {
    /// File name for messages.
    pub name: &'a str,
    /// Package of the file; `None` for the script.
    pub package: Option<&'a str>,
    /// Syntax tree.
    pub ast: &'a Ast,
    /// Names of the required files, by the text in `require`.
    pub required: &'a BTreeMap<String, String>,
}

/// Files of a script with the state of their checks.
struct FileChecks<'a> {
    files: &'a [CheckedFile<'a>],
    registry: &'a Registry,
    /// Inferred return values by file name; `Inference::Unknown` while a file is being checked.
    exports: RefCell<FxHashMap<&'a str, Inference<'a>>>,
    problems: RefCell<Vec<Error>>,
}

/// Returns the problems in the calls of `files`. `registry` must include the object types that the scripts declare.
pub fn call_problems(files: &[CheckedFile], registry: &Registry) -> Vec<Error> {
    std::thread::scope(|scope| {
        let check = || {
            let checks =
                FileChecks { files, registry, exports: RefCell::default(), problems: RefCell::default() };
            files.iter().for_each(|file| drop(checks.exports(file)));
            checks.problems.into_inner()
        };
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, check);
        // If the thread cannot start, the check is skipped. The script can still run.
        thread.ok().and_then(|thread| thread.join().ok()).unwrap_or_default()
    })
}

impl<'a> FileChecks<'a> {
    /// Returns the inference for the return value of `file`.
    fn exports(&self, file: &'a CheckedFile) -> Inference<'a> {
        if let Some(known) = self.exports.borrow().get(file.name) {
            return known.clone();
        }
        self.exports.borrow_mut().insert(file.name, Inference::Unknown);
        let required = |name: &str| self.infer_required(file, name);
        let mut check = CallCheck::new(file.name, file.ast, self.registry, Some(&required));
        check.package = file.package;
        let found = check.file(file.ast);
        self.problems.borrow_mut().append(&mut check.problems);
        self.exports.borrow_mut().insert(file.name, found.clone());
        found
    }

    /// Returns the inference for `require(name)` in the file `asker`.
    fn infer_required(&self, asker: &CheckedFile, name: &str) -> Inference<'a> {
        let meant = asker.required.get(name).and_then(|meant| self.files.iter().find(|it| it.name == *meant));
        meant.map_or(Inference::Unknown, |file| self.exports(file))
    }
}
