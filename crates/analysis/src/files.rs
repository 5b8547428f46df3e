//! Holds the calls of all files of a script against what is declared, those first that others require.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::sync::Arc;

use full_moon::ast::Ast;
use rustc_hash::FxHashMap;

use super::calls::CallCheck;
use super::inference::Inference;
use super::script::STACK;
use burgeon_base::error::Error;
use burgeon_kit::Registry;

/// A file whose calls are to be checked.
pub struct CheckedFile {
    /// Its name for messages.
    pub name: String,
    /// The package that it is of; none for the script.
    pub package: Option<String>,
    /// What stands in it.
    pub ast: Arc<Ast>,
    /// By what it writes in `require`: the names of the files that are meant.
    pub required: BTreeMap<String, String>,
}

/// The files of a script, as far as they have been checked.
struct FileChecks<'a> {
    files: &'a [CheckedFile],
    registry: &'a Registry,
    /// By name: what is known of the value that a file gives; nothing while it is being checked.
    exports: RefCell<FxHashMap<&'a str, Inference>>,
    problems: RefCell<Vec<Error>>,
}

/// What is wrong with the calls in `files`, where the scripts' own types of objects are in the `registry` too.
pub fn call_problems(files: &[CheckedFile], registry: &Registry) -> Vec<Error> {
    std::thread::scope(|scope| {
        let check = || {
            let checks =
                FileChecks { files, registry, exports: RefCell::default(), problems: RefCell::default() };
            files.iter().for_each(|file| drop(checks.exports(file)));
            checks.problems.into_inner()
        };
        let thread = std::thread::Builder::new().stack_size(STACK).spawn_scoped(scope, check);
        // Without a thread nobody checks; the script runs as well.
        thread.ok().and_then(|thread| thread.join().ok()).unwrap_or_default()
    })
}

impl<'a> FileChecks<'a> {
    /// What is known of the value that `file` gives.
    fn exports(&self, file: &'a CheckedFile) -> Inference {
        if let Some(known) = self.exports.borrow().get(&*file.name) {
            return known.clone();
        }
        self.exports.borrow_mut().insert(&file.name, Inference::Unknown);
        let required = |name: &str| self.required(file, name);
        let mut check = CallCheck::new(&file.name, &file.ast, self.registry, Some(&required));
        check.package = file.package.as_deref();
        let found = check.file(&file.ast);
        self.problems.borrow_mut().append(&mut check.problems);
        self.exports.borrow_mut().insert(&file.name, found.clone());
        found
    }

    /// What is known of `require(name)` in the file `asker`.
    fn required(&self, asker: &CheckedFile, name: &str) -> Inference {
        let meant = asker.required.get(name).and_then(|meant| self.files.iter().find(|it| it.name == *meant));
        meant.map_or(Inference::Unknown, |file| self.exports(file))
    }
}
