//! Warnings of a run: content that draws nothing, rules that cannot apply, skipped data.
//!
//! A [`Warning`] is a value of the run. `Session::warn` collects warnings and keeps each text of a location once, with
//! a count. `Run::warnings` returns them in the order of files and lines, for any number of threads. The terminal, JSON
//! and the live view show them from there; a strict run ends with the first as an error. Code reports a warning
//! depending on its context:
//!
//! - *A function that scripts call, or a declaration*: `machine.warn(Warning::new(kind, "...").help("..."))`. The
//!   machine adds the line of the script, and helper machines report nothing.
//! - *An object* keeps a list, adds to it during construction, in write methods or while it grows, and returns it from
//!   `Object::take_warnings`. The engine adds the line of the constructor's or the method's call, or of the system. If
//!   passes begin empty, only the warnings of the last pass count. [`Warning::of_all`] suppresses a warning if some
//!   module of the same symbol causes none, and [`Warning::of_pass`] lets a later pass replace it.
//! - *An object that is only read* [defers](defer_warning) the warning. The caller in the line of a script
//!   [takes](take_deferred) the deferred warnings.
//! - *A file*: the loaded data keeps its warnings. The function with which a script loads the file passes them to its
//!   machine, so every run reports them, even if it does not read the file again.
//!
//! Problems of single features are warnings [of the feature](Warning::of_feature) with a [cause](Warning::with_cause). The
//! report lists them, not `Run::warnings`: an object returns them from `Report::notes`.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt;
use std::ops::Range;
use std::sync::Mutex;

use crate::error::{Error, ErrorKind, Excerpt, SourcePlace};
use crate::locks::LockRecovery;

pub use crate::warning_kind::WarningKind;

thread_local! {
    static DEFERRED: RefCell<Vec<Warning>> = const { RefCell::new(Vec::new()) };
}

/// Stores a warning for the caller that this thread works for.
pub fn defer_warning(warning: Warning) {
    DEFERRED.with_borrow_mut(|deferred| deferred.push(warning));
}

/// Takes all warnings that were [deferred](defer_warning) in this thread since the last call.
pub fn take_deferred() -> Vec<Warning> {
    DEFERRED.take()
}

/// A warning of a successful run, with its location and a remedy.
///
/// ```
/// use burgeon_base::error::SourcePlace;
/// use burgeon_base::{Warning, WarningKind};
///
/// let place = SourcePlace { file: "plant.lua".into(), line: 3 };
/// let warning = Warning::new(WarningKind::EmptyModel, "the model is empty").at(Some(place)).help("draw something");
/// assert_eq!(warning.to_string(), "plant.lua:3: the model is empty\n  help: draw something");
/// assert_eq!(warning.to_json()["line"], 3);
/// ```
#[derive(Debug, Clone)]
pub struct Warning {
    kind: WarningKind,
    /// Content of the warning, as the error of a strict run.
    told: Error,
    count: usize,
    of_all: bool,
    of_pass: bool,
    cause: String,
    feature: Option<WarnedFeature>,
}

/// Feature of a warning.
#[derive(Debug, Clone)]
struct WarnedFeature {
    /// Source; empty for a list of the script and for a chain without a feature.
    source: String,
    id: Option<String>,
}

impl Warning {
    /// Creates a warning with `message`, a clause without a full stop.
    pub fn new(kind: WarningKind, message: impl fmt::Display) -> Self {
        Self {
            kind,
            told: Error::of(ErrorKind::Warning(kind), message),
            count: 1,
            of_all: false,
            of_pass: false,
            cause: String::new(),
            feature: None,
        }
    }

    /// Creates a warning about a result that differs from the request: `what` replaces it, such as "a flat roof instead of
    /// a hip roof".
    pub fn simplification(what: impl fmt::Display) -> Self {
        Self::new(WarningKind::SimplifiedFeature, what)
    }

    /// Sets the remedy, unless it is already set.
    #[must_use]
    pub fn help(self, help: impl fmt::Display) -> Self {
        Self { told: self.told.help(help), ..self }
    }

    /// Sets the location, unless it is already set.
    #[must_use]
    pub fn at(self, place: Option<SourcePlace>) -> Self {
        Self { told: self.told.at(place), ..self }
    }

    /// Sets the location to a copy of `place`, unless it is already set.
    #[must_use]
    pub fn at_place(self, place: Option<&SourcePlace>) -> Self {
        Self { told: self.told.at_place(place), ..self }
    }

    /// Sets the script line that led to the warning to a copy of `caller`, unless it is already set.
    #[must_use]
    pub fn called_from(self, caller: Option<&SourcePlace>) -> Self {
        Self { told: self.told.called_from(caller), ..self }
    }

    /// Sets the script line that led to the warning, unless it is already set.
    #[must_use]
    pub fn called_at(self, caller: Option<SourcePlace>) -> Self {
        Self { told: self.told.called_at(caller), ..self }
    }

    /// Sets the rule, unless it is already set.
    #[must_use]
    pub fn rule(self, rule: impl fmt::Display) -> Self {
        Self { told: self.told.rule(rule), ..self }
    }

    /// Sets the module with its parameters and the derivation step, unless they are already set.
    #[must_use]
    pub fn module(self, module: impl fmt::Display, step: usize) -> Self {
        Self { told: self.told.module(module, step), ..self }
    }

    /// Marks a warning of an object that is only reported if all modules with the same symbol cause it, because a size
    /// of 0 can be intended for some of them.
    #[must_use]
    pub fn of_all(self) -> Self {
        Self { of_all: true, ..self }
    }

    /// Returns true if the warning is only reported if all modules with the same symbol cause it.
    pub fn is_of_all(&self) -> bool {
        self.of_all
    }

    /// Marks a warning of one interpretation pass: a later pass of the system replaces it.
    #[must_use]
    pub fn of_pass(self) -> Self {
        Self { of_pass: true, ..self }
    }

    /// Returns true if a later interpretation pass replaces the warning.
    pub fn is_of_pass(&self) -> bool {
        self.of_pass
    }

    /// Sets the reason for this object or feature. The message has no details of it, so that equal changes can be counted.
    #[must_use]
    pub fn with_cause(self, cause: impl Into<String>) -> Self {
        Self { cause: cause.into(), ..self }
    }

    /// Returns the reason for this object or feature; may be empty.
    pub fn cause(&self) -> &str {
        &self.cause
    }

    /// Sets the feature: its source, which is empty for a list of the script and for a chain without a feature, and its id
    /// if the chain came from a feature.
    ///
    /// ```
    /// use burgeon_base::Warning;
    ///
    /// let flat = Warning::simplification("a flat roof instead of a hip roof").with_cause("too narrow");
    /// let flat = flat.of_feature("town.gpkg:houses", Some("7"));
    /// assert_eq!((flat.source(), flat.feature(), flat.cause()), ("town.gpkg:houses", Some("7"), "too narrow"));
    /// ```
    #[must_use]
    pub fn of_feature(self, source: &str, id: Option<&str>) -> Self {
        let feature = WarnedFeature { source: source.to_owned(), id: id.map(str::to_owned) };
        Self { feature: Some(feature), ..self }
    }

    /// Returns the source of the feature; empty if it has none.
    pub fn source(&self) -> &str {
        self.feature.as_ref().map_or("", |feature| &feature.source)
    }

    /// Returns the id of the feature, if the chain came from a feature.
    pub fn feature(&self) -> Option<&str> {
        self.feature.as_ref()?.id.as_deref()
    }

    /// Returns the kind.
    pub fn kind(&self) -> WarningKind {
        self.kind
    }

    /// Returns the message without the location.
    pub fn message(&self) -> &str {
        self.told.message()
    }

    /// Returns the suggested fix, if any.
    pub fn remedy(&self) -> Option<&str> {
        self.told.remedy()
    }

    /// Returns the location, if known.
    pub fn place(&self) -> Option<&SourcePlace> {
        self.told.place()
    }

    /// Returns true if the warning has the same kind and message as `other`, at any location.
    pub fn says_the_same(&self, other: &Self) -> bool {
        self.told.says_the_same(&other.told)
    }

    /// Returns true if the warning has the same kind, message and location as `other`.
    pub fn is_same(&self, other: &Self) -> bool {
        self.told.is_same(&other.told)
    }

    /// Returns the number of times that the warning occurred at this location.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Adds `more` occurrences.
    pub fn add_occurrences(&mut self, more: usize) {
        self.count += more;
    }

    /// Converts the warning to the error of a strict run.
    pub fn into_error(self) -> Error {
        self.told
    }

    /// Converts the warning to JSON: the fields of an error, the `kind`, and the number of occurrences as `count`.
    pub fn to_json(&self) -> serde_json::Value {
        let mut object = self.told.to_json();
        object["kind"] = self.kind.name().into();
        object["count"] = self.count.into();
        object
    }

    /// Sets the columns of the location (characters of the line, from 0), unless they are already set.
    #[must_use]
    pub fn in_columns(self, columns: Range<usize>) -> Self {
        Self { told: self.told.in_columns(columns), ..self }
    }

    /// Returns the line of the location with the columns that the warning is about, as [`Error::excerpt`] does.
    pub fn excerpt(&self) -> Option<Excerpt> {
        self.told.excerpt()
    }

    /// Returns the line of the location in `text`, as [`Error::excerpt_of`] does.
    pub fn excerpt_of(&self, text: &str) -> Option<Excerpt> {
        self.told.excerpt_of(text)
    }

    /// Formats the warning, with its column and with `excerpt` below the message, in `width` cells of a terminal.
    pub fn with_excerpt(&self, excerpt: Option<&Excerpt>, width: usize) -> String {
        match self.count {
            1 => self.told.with_excerpt(excerpt, width),
            count => self.told.clone().noting(&format!("{count} times")).with_excerpt(excerpt, width),
        }
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.with_excerpt(None, 0))
    }
}

/// Sort key: location, with unknown locations last, then message.
type WarningOrder = (bool, Option<SourcePlace>, String);

/// Warnings of a run.
///
/// ```
/// use burgeon_base::warning::Warnings;
/// use burgeon_base::{Warning, WarningKind};
///
/// let warnings = Warnings::default();
/// for _ in 0..3 {
///     warnings.add(Warning::new(WarningKind::EmptyModel, "the model is empty"));
/// }
/// assert_eq!(warnings.list().iter().map(Warning::count).collect::<Vec<_>>(), [3]);
/// ```
#[derive(Debug, Default)]
pub struct Warnings(Mutex<BTreeMap<WarningOrder, Warning>>);

impl Warnings {
    /// Adds a warning. A warning with the same text and location is only counted.
    pub fn add(&self, warning: Warning) {
        let mut known = self.0.lock().recover();
        let key = (warning.place().is_none(), warning.place().cloned(), warning.message().to_owned());
        let count = warning.count;
        known.entry(key).and_modify(|known| known.add_occurrences(count)).or_insert(warning);
    }

    /// Returns all warnings, in the order of files and lines.
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
            warnings.add(Warning::new(WarningKind::NoEffect, text).at(place).help("remove it"));
        }
        let texts: Vec<String> = warnings.list().iter().map(ToString::to_string).collect();
        insta::assert_snapshot!(texts.join("\n"), @r"
        a.lua:2: early
          help: remove it
        a.lua:7: also late
          help: remove it
        a.lua:7: late (2 times)
          help: remove it
        nowhere
          help: remove it
        ");
        assert_eq!(warnings.list()[2].to_json()["count"], 2);
    }
}
