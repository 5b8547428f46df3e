//! What a run tells people besides its result: what draws nothing, cannot happen or is left out.
//!
//! A [`Warning`] is a value of the run: it goes into `Session::warn`, which keeps each
//! text of a place once, with a count, and comes out of `Run::warnings` in the order of files
//! and lines, for any number of threads. Terminal, JSON and the live page show it from there; a strict run ends with it
//! as an error. Whoever finds something says it in the way of its place:
//!
//! - *A function that scripts call, or a declaration*: `machine.warn(Warning::new(kind, "...").help("..."))`. The line of
//!   the script is filled in, and machines that only help say nothing.
//! - *An object* keeps a list, adds to it while it is made, in a method that changes it or while it grows, and gives it
//!   away in `Object::take_warnings`. The line is that of the constructor's or
//!   the method's call, or of the system. Where passes begin empty, only what the last pass said counts.
//!   [`Warning::of_all`] keeps it back as long as some module of the kind does better, and [`Warning::of_pass`] lets a
//!   later pass replace it.
//! - *An object that is only asked* [defers](defer_warning) it; whoever asked it in the line of a script
//!   [takes](take_deferred) what was deferred.
//! - *A file*: what it was loaded into keeps the warnings, and the function that a script asked for it hands them on to
//!   its machine, so that they are told by every run, also by one that need not read the file again.
//!
//! What only one feature of many is about is a `Note` of the report.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::sync::Mutex;

use crate::error::{Error, ErrorKind, SourcePlace};
use crate::locks::LockRecovery;

/// What a warning is about, for code.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum WarningKind {
    /// A call that draws nothing.
    DrawsNothing,
    /// A model without any triangle.
    EmptyModel,
    /// A module that nothing draws, rewrites or looks at.
    UndrawnModule,
    /// A module of the standard library that the script has declared anew, so that it is not drawn.
    HiddenModule,
    /// An interpretation that returns modules.
    ReturnedModules,
    /// Interpretations of a system without an object.
    NoObject,
    /// A declaration that came too late for the derivation.
    LateDeclaration,
    /// A rule that an earlier one always forestalls.
    UnreachableRule,
    /// A context that cannot occur.
    ImpossibleContext,
    /// A system that was derived twice, so that both models stay.
    DerivedTwice,
    /// Systems of which none is derived.
    NotDerived,
    /// A parameter that was declared twice.
    ParameterTwice,
    /// An option or a call that has no effect where it stands.
    NoEffect,
    /// A file that could be read, though not all of it is as it should be.
    Data,
    /// Something that is done as asked, though hardly as meant.
    Doubtful,
    /// A name that will go, for there is a better one.
    Deprecated,
    /// A package that is not used, for another of its name comes first.
    HiddenPackage,
    /// Something of a package that two others replace.
    ReplacedTwice,
    /// A package that is there and cannot be used.
    BrokenPackage,
}

impl WarningKind {
    /// Its name for machines, without the `warning.` of its [`code`](Self::code).
    pub fn name(self) -> &'static str {
        self.code().trim_start_matches("warning.")
    }

    /// Its name among those of errors, which it is in a strict run.
    pub fn code(self) -> &'static str {
        match self {
            Self::DrawsNothing => "warning.draws-nothing",
            Self::EmptyModel => "warning.empty-model",
            Self::UndrawnModule => "warning.undrawn-module",
            Self::HiddenModule => "warning.hidden-module",
            Self::ReturnedModules => "warning.returned-modules",
            Self::NoObject => "warning.no-object",
            Self::LateDeclaration => "warning.late-declaration",
            Self::UnreachableRule => "warning.unreachable-rule",
            Self::ImpossibleContext => "warning.impossible-context",
            Self::DerivedTwice => "warning.derived-twice",
            Self::NotDerived => "warning.not-derived",
            Self::ParameterTwice => "warning.parameter-twice",
            Self::NoEffect => "warning.no-effect",
            Self::Data => "warning.data",
            Self::Doubtful => "warning.doubtful",
            Self::Deprecated => "warning.deprecated",
            Self::HiddenPackage => "warning.hidden-package",
            Self::ReplacedTwice => "warning.replaced-twice",
            Self::BrokenPackage => "warning.broken-package",
        }
    }
}

thread_local! {
    static DEFERRED: RefCell<Vec<Warning>> = const { RefCell::new(Vec::new()) };
}

/// Keeps a warning for the one for whom this thread is at work.
pub fn defer_warning(warning: Warning) {
    DEFERRED.with_borrow_mut(|deferred| deferred.push(warning));
}

/// Takes all warnings that were [deferred](defer_warning) in this thread since this was called last.
pub fn take_deferred() -> Vec<Warning> {
    DEFERRED.take()
}

/// Something that people should know of a run that has succeeded, with its place and a remedy.
#[derive(Debug, Clone)]
pub struct Warning {
    kind: WarningKind,
    /// What it says, as the error that it is in a strict run.
    told: Error,
    count: usize,
    of_all: bool,
    of_pass: bool,
}

impl Warning {
    /// A warning that says `message`, a clause without a full stop.
    pub fn new(kind: WarningKind, message: impl fmt::Display) -> Self {
        Self {
            kind,
            told: Error::of(ErrorKind::Warning(kind), message),
            count: 1,
            of_all: false,
            of_pass: false,
        }
    }

    /// Says what to do about it.
    #[must_use]
    pub fn help(self, help: impl fmt::Display) -> Self {
        Self { told: self.told.help(help), ..self }
    }

    /// Says where, unless that is known already.
    #[must_use]
    pub fn at(self, place: Option<SourcePlace>) -> Self {
        Self { told: self.told.at(place), ..self }
    }

    /// Says which line of the script led there, if that is known.
    #[must_use]
    pub fn called_at(self, caller: Option<SourcePlace>) -> Self {
        Self { told: self.told.called_at(caller), ..self }
    }

    /// Names the rule, unless it is named already.
    #[must_use]
    pub fn rule(self, rule: impl fmt::Display) -> Self {
        Self { told: self.told.rule(rule), ..self }
    }

    /// Names the module with its parameters and the derivation step, unless they are known already.
    #[must_use]
    pub fn module(self, module: impl fmt::Display, step: usize) -> Self {
        Self { told: self.told.module(module, step), ..self }
    }

    /// An object's: tells it only where all modules with the same symbol give rise to it, for a size may well be 0 here
    /// and there.
    #[must_use]
    pub fn of_all(self) -> Self {
        Self { of_all: true, ..self }
    }

    /// Whether only all modules with the same symbol together give rise to it.
    pub fn is_of_all(&self) -> bool {
        self.of_all
    }

    /// Holds for one interpretation pass only: a later pass of the system replaces it.
    #[must_use]
    pub fn of_pass(self) -> Self {
        Self { of_pass: true, ..self }
    }

    /// Tells if a later interpretation pass replaces it.
    pub fn is_of_pass(&self) -> bool {
        self.of_pass
    }

    /// What it is about.
    pub fn kind(&self) -> WarningKind {
        self.kind
    }

    /// What is doubtful, without the place.
    pub fn message(&self) -> &str {
        self.told.message()
    }

    /// What to do about it, if known.
    pub fn remedy(&self) -> Option<&str> {
        self.told.remedy()
    }

    /// Where, if known.
    pub fn place(&self) -> Option<&SourcePlace> {
        self.told.place()
    }

    /// Whether it is of the kind of `other` and tells people the same, wherever that is.
    pub fn says_the_same(&self, other: &Self) -> bool {
        self.told.says_the_same(&other.told)
    }

    /// Whether it tells people the same as `other`, in the same place.
    pub fn is_same(&self, other: &Self) -> bool {
        self.told.is_same(&other.told)
    }

    /// How often it was found in this place.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Adds that it was found `more` times besides.
    pub fn again(&mut self, more: usize) {
        self.count += more;
    }

    /// The error that it is in a strict run.
    pub fn into_error(self) -> Error {
        self.told
    }

    /// The warning for machines: an error's fields, its `kind`, and the `count` of how often it was found.
    pub fn to_json(&self) -> serde_json::Value {
        let mut object = self.told.to_json();
        object["kind"] = self.kind.name().into();
        object["count"] = self.count.into();
        object
    }

    /// It as a text, with `line`, the text of the line that it is about, below its message.
    pub fn with_line(&self, line: Option<&str>) -> String {
        match self.count {
            1 => self.told.with_line(line),
            count => self.told.clone().noting(&format!("{count} times")).with_line(line),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_line(None))
    }
}

/// Where it stands, those without a place last, and what it says.
type WarningOrder = (bool, Option<SourcePlace>, String);

/// The warnings of a run.
#[derive(Debug, Default)]
pub struct Warnings(Mutex<BTreeMap<WarningOrder, Warning>>);

impl Warnings {
    /// Adds a warning; the same text in the same place is counted.
    pub fn add(&self, warning: Warning) {
        let mut known = self.0.lock().recover();
        let key = (warning.place().is_none(), warning.place().cloned(), warning.message().to_owned());
        let count = warning.count;
        known.entry(key).and_modify(|known| known.again(count)).or_insert(warning);
    }

    /// All of them, in the order of files and lines.
    pub fn list(&self) -> Vec<Warning> {
        self.0.lock().recover().values().cloned().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_text_in_the_same_place_is_counted_and_all_come_in_the_order_of_their_places() {
        let at = |line| Some(SourcePlace { file: "a.lua".to_owned(), line });
        let warnings = Warnings::default();
        for (line, text) in [(7, "late"), (0, "nowhere"), (2, "early"), (7, "late"), (7, "also late")] {
            let place = if line == 0 { None } else { at(line) };
            warnings.add(Warning::new(WarningKind::NoEffect, text).at(place).help("leave it out"));
        }
        let texts: Vec<String> = warnings.list().iter().map(ToString::to_string).collect();
        insta::assert_snapshot!(texts.join("\n"), @r"
        a.lua:2: early
          help: leave it out
        a.lua:7: also late
          help: leave it out
        a.lua:7: late (2 times)
          help: leave it out
        nowhere
          help: leave it out
        ");
        assert_eq!(warnings.list()[2].to_json()["count"], 2);
    }
}
