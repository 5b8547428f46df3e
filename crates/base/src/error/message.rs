//! Content of an error: location, rule, message and remedy.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

use super::excerpt::Excerpt;
use super::kind::{ErrorKind, Limit};
use super::source_place::SourcePlace;
use crate::text::{escaped_lines, without_passwords};

/// Maximum length of a message or a remedy (characters). Longer text is shortened in the middle.
const LONGEST: usize = 2000;

/// Maximum length of the name of a rule and of a module (characters).
const LONGEST_NAME: usize = 500;

/// Result type of the crate.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// An error with its location and remedy. The first layer that knows a part sets it.
///
/// A complete error has this format:
///
/// ```text
/// city.lua:41: rule Lot(w): the parts take 12.5 m but the shape is 10 m wide
///   module: Lot(10), step 3
///   help: give the last part a smaller minimum
/// ```
#[derive(Debug, Clone)]
pub struct Error(Box<ErrorParts>);

#[derive(Debug, Clone)]
struct ErrorParts {
    kind: ErrorKind,
    message: String,
    place: Option<SourcePlace>,
    columns: Option<Range<usize>>,
    caller: Option<SourcePlace>,
    rule: Option<String>,
    module: Option<String>,
    step: Option<usize>,
    help: Option<String>,
    more: Vec<Error>,
    fault: Fault,
}

/// Cause of an error, which determines who can fix it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Fault {
    /// Unknown cause.
    #[default]
    Unknown,
    /// Error in the data.
    Data,
    /// Error in the script.
    Script,
}

impl Error {
    /// Creates an error of a kind with `message`, a clause without a full stop.
    pub fn of(kind: ErrorKind, message: impl fmt::Display) -> Self {
        Self(Box::new(ErrorParts {
            kind,
            message: prepare_text(&message.to_string(), LONGEST),
            place: None,
            columns: None,
            caller: None,
            rule: None,
            module: None,
            step: None,
            help: None,
            more: Vec::new(),
            fault: Fault::Unknown,
        }))
    }

    /// Combines several problems into one error; `problems` must not be empty.
    ///
    /// ```
    /// use burgeon_base::Error;
    ///
    /// let error = Error::several(vec![Error::syntax("missing brace"), Error::argument("invalid `side`")]);
    /// let codes: Vec<_> = error.problems().map(|problem| problem.kind().code()).collect();
    /// assert_eq!(codes, ["syntax", "argument"]);
    /// ```
    pub fn several(mut problems: Vec<Error>) -> Self {
        if problems.is_empty() {
            return Self::internal("nothing is wrong");
        }
        let mut first = problems.remove(0);
        first.0.more.extend(problems);
        first
    }

    /// Replaces the kind, the message and the remedy by those of `cause`. Keeps the location, rule and module.
    #[must_use]
    pub fn because(mut self, cause: &Self) -> Self {
        self.0.kind.clone_from(&cause.0.kind);
        self.0.message.clone_from(&cause.0.message);
        self.0.help.clone_from(&cause.0.help);
        self
    }

    /// Replaces the kind.
    #[must_use]
    pub fn in_kind(mut self, kind: ErrorKind) -> Self {
        self.0.kind = kind;
        self
    }

    /// Returns the message alone.
    pub fn into_message(self) -> String {
        self.0.message
    }

    /// Replaces the message.
    #[must_use]
    pub fn saying(mut self, message: impl fmt::Display) -> Self {
        self.0.message = prepare_text(&message.to_string(), LONGEST);
        self
    }

    /// Adds `what` as the subject before the message, unless the message already contains it. A method, such as "shape:roof",
    /// replaces a method that is the subject already, so that a message names the one that was called.
    #[must_use]
    pub fn about(mut self, what: &str) -> Self {
        let what = without_passwords(what);
        if is_method(&what)
            && let Some((method, rest)) = self.0.message.split_once(": ")
            && is_method(method)
        {
            self.0.message = rest.to_owned();
        }
        if !self.0.message.contains(&*what) {
            self.0.message = format!("{}: {}", shorten(&what, LONGEST_NAME), self.0.message);
        }
        self
    }

    /// Adds `what` in brackets to the message.
    #[must_use]
    pub fn noting(mut self, what: &str) -> Self {
        self.0.message = format!("{} ({})", self.0.message, prepare_text(what, LONGEST_NAME));
        self
    }

    /// Adds the id of the feature that was being read to the message.
    #[must_use]
    pub fn feature(self, id: &str) -> Self {
        self.noting(&format!("feature {id}"))
    }

    /// Marks the data as the cause: the feature cannot be built, regardless of the script. Has no effect on a run that
    /// is out of time or memory or cancelled, because the next feature would fail as well.
    #[must_use]
    pub fn of_data(mut self) -> Self {
        let ends_run =
            matches!(self.0.kind, ErrorKind::Limit(Limit::Memory | Limit::Time) | ErrorKind::Stopped);
        if self.0.fault == Fault::Unknown && !ends_run {
            self.0.fault = Fault::Data;
        }
        self
    }

    /// Marks the script as the cause, regardless of the data.
    #[must_use]
    pub fn of_script(mut self) -> Self {
        self.0.fault = Fault::Script;
        self
    }

    /// Returns true if the data is the cause. A run can then skip the feature and continue.
    pub fn is_of_data(&self) -> bool {
        self.0.fault == Fault::Data
    }

    /// Sets the remedy, unless it is already set.
    #[must_use]
    pub fn help(mut self, help: impl fmt::Display) -> Self {
        self.0.help.get_or_insert_with(|| prepare_text(&help.to_string(), LONGEST));
        self
    }

    /// Replaces the remedy.
    #[must_use]
    pub fn rather_help(mut self, help: impl fmt::Display) -> Self {
        self.0.help = Some(prepare_text(&help.to_string(), LONGEST));
        self
    }

    /// Sets the location, unless it is already set.
    #[must_use]
    pub fn at(mut self, place: Option<SourcePlace>) -> Self {
        if self.0.place.is_none() {
            self.0.place = place;
        }
        self
    }

    /// Sets the location to a copy of `place`, unless it is already set.
    #[must_use]
    pub fn at_place(mut self, place: Option<&SourcePlace>) -> Self {
        if self.0.place.is_none() {
            self.0.place = place.cloned();
        }
        self
    }

    /// Sets the location to a line of `file`, unless it is already set.
    #[must_use]
    pub fn at_line(mut self, file: &str, line: usize) -> Self {
        self.0.place.get_or_insert_with(|| SourcePlace::new(file, line));
        self
    }

    /// Sets the columns of the location (characters of the line, from 0), unless they are already set.
    #[must_use]
    pub fn in_columns(mut self, columns: Range<usize>) -> Self {
        self.0.columns.get_or_insert(columns);
        self
    }

    /// Replaces the location by a more precise one, if `place` is known.
    #[must_use]
    pub fn rather_at(mut self, place: Option<SourcePlace>) -> Self {
        if place.is_some() {
            self.0.place = place;
            self.0.columns = None;
        }
        self
    }

    /// Removes the location.
    #[must_use]
    pub fn without_place(mut self) -> Self {
        self.0.place = None;
        self.0.columns = None;
        self
    }

    /// Sets the script line that led to the error, unless it is already set. It is only shown if the location is in
    /// another file.
    #[must_use]
    pub fn called_at(mut self, caller: Option<SourcePlace>) -> Self {
        if self.0.caller.is_none() {
            self.0.caller = caller;
        }
        self
    }

    /// Sets the script line that led to the error to a copy of `caller`, unless it is already set.
    #[must_use]
    pub fn called_from(mut self, caller: Option<&SourcePlace>) -> Self {
        if self.0.caller.is_none() {
            self.0.caller = caller.cloned();
        }
        self
    }

    /// Replaces the script line that led to the error. For a rule, which no line calls, it is the line that created the
    /// system.
    #[must_use]
    pub fn rather_called_at(mut self, caller: Option<SourcePlace>) -> Self {
        self.0.caller = caller;
        self
    }

    /// Sets the rule, unless it is already set.
    #[must_use]
    pub fn rule(mut self, rule: impl fmt::Display) -> Self {
        self.0.rule.get_or_insert_with(|| prepare_text(&rule.to_string(), LONGEST_NAME));
        self
    }

    /// Sets the module with its parameters and the derivation step, unless they are already set.
    #[must_use]
    pub fn module(mut self, module: impl fmt::Display, step: usize) -> Self {
        if self.0.module.is_none() {
            self.0.module = Some(prepare_text(&module.to_string(), LONGEST_NAME));
            self.0.step = Some(step);
        }
        self
    }

    /// Returns the kind.
    pub fn kind(&self) -> &ErrorKind {
        &self.0.kind
    }

    /// Returns the message without the location.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// Returns the suggested fix, if any.
    pub fn remedy(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Returns the location, if known.
    pub fn place(&self) -> Option<&SourcePlace> {
        self.0.place.as_ref()
    }

    /// Returns the location alone, if known.
    pub fn into_place(self) -> Option<SourcePlace> {
        self.0.place
    }

    /// Returns the line that led to the location, if it should be shown.
    fn caller(&self) -> Option<&SourcePlace> {
        let (place, caller) = (self.0.place.as_ref()?, self.0.caller.as_ref()?);
        (place.file != caller.file).then_some(caller)
    }

    /// Returns true if the error has the same kind and message as `other`, at any location.
    pub fn says_the_same(&self, other: &Self) -> bool {
        self.0.kind == other.0.kind && self.0.message == other.0.message
    }

    /// Returns true if the error has the same kind, message and location as `other`.
    pub fn is_same(&self, other: &Self) -> bool {
        self.0.place == other.0.place && self.says_the_same(other)
    }

    /// Returns this problem without the problems reported with it.
    #[must_use]
    pub fn without_others(&self) -> Self {
        let mut alone = self.clone();
        alone.0.more.clear();
        alone
    }

    /// Returns this problem and the problems reported with it, in order.
    pub fn problems(&self) -> impl Iterator<Item = &Error> {
        std::iter::once(self).chain(&self.0.more)
    }

    /// Converts the error to JSON: `{ code, message, file, line, called_at: { file, line }, rule, module, step, help
    /// }`. Unknown parts are omitted; codes are from [`ErrorKind::code`].
    pub fn to_json(&self) -> serde_json::Value {
        let mut object = serde_json::Map::new();
        let parts = &*self.0;
        object.insert("code".into(), parts.kind.code().into());
        object.insert("message".into(), parts.message.clone().into());
        if let Some(place) = &parts.place {
            object.insert("file".into(), place.file.clone().into());
            object.insert("line".into(), place.line.into());
        }
        if let Some(caller) = self.caller() {
            let place = serde_json::json!({ "file": caller.file, "line": caller.line });
            object.insert("called_at".into(), place);
        }
        for (key, part) in [("rule", &parts.rule), ("module", &parts.module), ("help", &parts.help)] {
            if let Some(text) = part {
                object.insert(key.into(), text.clone().into());
            }
        }
        if let Some(step) = parts.step {
            object.insert("step".into(), step.into());
        }
        object.into()
    }

    /// Returns the line of the location with the columns that the error is about. `None` if the file cannot be read, or if the
    /// line is empty or missing.
    pub fn excerpt(&self) -> Option<Excerpt> {
        Excerpt::at(self.0.place.as_ref()?, self.0.columns.as_ref(), &self.0.message)
    }

    /// Returns the line of the location in `text`, which is the content of a file in memory, as [`excerpt`](Self::excerpt) does.
    pub fn excerpt_of(&self, text: &str) -> Option<Excerpt> {
        let line = self.0.place.as_ref()?.line_of(text)?;
        Some(Excerpt::of_line(&line, self.0.columns.as_ref(), &self.0.message))
    }

    /// Formats only this problem, with its column and with `excerpt` below the message, in `width` cells of a terminal.
    pub fn with_excerpt(&self, excerpt: Option<&Excerpt>, width: usize) -> String {
        let parts = &*self.0;
        let mut text = String::new();
        match (&parts.place, excerpt) {
            (Some(place), Some(excerpt)) => text += &format!("{place}:{}: ", excerpt.column()),
            (Some(place), None) => text += &format!("{place}: "),
            _ => {}
        }
        if let Some(rule) = &parts.rule {
            text += &format!("rule {rule}: ");
        }
        text += &parts.message;
        if let Some(excerpt) = excerpt {
            for row in excerpt.rows(width.saturating_sub(4)) {
                text += &format!("\n  | {row}");
            }
        }
        if let Some(caller) = self.caller() {
            text += &format!("\n  called at {caller}");
        }
        match (&parts.module, parts.step) {
            (Some(module), Some(step)) => text += &format!("\n  module: {module}, step {step}"),
            (Some(module), None) => text += &format!("\n  module: {module}"),
            _ => {}
        }
        if let Some(help) = &parts.help {
            text += &format!("\n  help: {help}");
        }
        match escaped_lines(&text) {
            Cow::Borrowed(_) => text,
            Cow::Owned(escaped) => escaped,
        }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, problem) in self.problems().enumerate() {
            if i > 0 {
                f.write_str("\n")?;
            }
            f.write_str(&problem.with_excerpt(None, 0))?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

/// Prepares a text for users: hides passwords and shortens it to `most` characters.
fn prepare_text(text: &str, most: usize) -> String {
    shorten(&without_passwords(text), most).into_owned()
}

/// Shortens `text` to about `most` characters by replacing its middle with a note of the full length.
pub fn shorten(text: &str, most: usize) -> Cow<'_, str> {
    // The number of bytes is at least the number of characters.
    if text.len() <= most {
        return Cow::Borrowed(text);
    }
    let count = text.chars().count();
    let half = most / 2;
    let begin = text.char_indices().nth(half).map(|(at, _)| at);
    let end = text.char_indices().nth_back(half.saturating_sub(1)).map(|(at, _)| at);
    match (begin, end) {
        (Some(begin), Some(end)) if count > most => {
            Cow::Owned(format!("{}... ({count} characters in all) ...{}", &text[..begin], &text[end..]))
        }
        _ => Cow::Borrowed(text),
    }
}

/// Returns true for the name of a method, such as "shape:roof".
fn is_method(text: &str) -> bool {
    let is_name = |name: &str| {
        name.starts_with(|first: char| first.is_ascii_lowercase())
            && name.chars().all(|letter| letter.is_ascii_lowercase() || letter == '_')
    };
    text.split_once(':').is_some_and(|(kind, method)| is_name(kind) && is_name(method))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_is_not_at_fault_where_the_run_is_out_of_time_or_memory() {
        assert!(Error::limit(Limit::Size, "a line has too many points").of_data().is_of_data());
        for limit in [Limit::Memory, Limit::Time] {
            assert!(!Error::limit(limit, "too much").of_data().is_of_data());
        }
    }

    #[test]
    fn no_part_of_an_error_holds_the_password_of_an_address() {
        let address = "postgre://me:s3cret@host/db";
        let error = Error::argument(format!("there is no data file {address}"))
            .saying(format!("cannot read {address}"))
            .about(&format!("{address}:houses"))
            .noting(address)
            .rule(address)
            .module(address, 1)
            .help(format!("write {address}"));
        let text = format!("{error} {error:?} {}", error.to_json());
        assert!(!text.contains("s3cret") && text.contains("postgre://me:***@host/db"), "{text}");
    }

    #[test]
    fn an_error_reads_place_rule_message_module_and_help() {
        let error = Error::argument("the height is NaN")
            .at(Some(SourcePlace { file: "a.lua".into(), line: 3 }))
            .rule("Slab(h)")
            .module("Slab(NaN)", 2)
            .help("give a finite length");
        insta::assert_snapshot!(error, @r"
        a.lua:3: rule Slab(h): the height is NaN
          module: Slab(NaN), step 2
          help: give a finite length
        ");
    }

    #[test]
    fn a_place_in_another_file_has_the_line_that_led_there() {
        let at = |file: &str, line: usize| Some(SourcePlace { file: file.into(), line });
        let error = |file: &str| Error::script("no").at(at(file, 3)).called_at(at("a.lua", 7)).help("yes");
        let excerpt = Excerpt::of_line("  error()", None, "");
        insta::assert_snapshot!(error("b.lua").with_excerpt(Some(&excerpt), 80), @r"
        b.lua:3:3: no
          | error()
          | ^^^^^^^
          called at a.lua:7
          help: yes
        ");
        assert_eq!(error("b.lua").to_json()["called_at"]["line"], 7);
        assert_eq!(error("a.lua").to_string(), "a.lua:3: no\n  help: yes");
        insta::assert_snapshot!(error("b.lua").rule("A"), @r"
        b.lua:3: rule A: no
          called at a.lua:7
          help: yes
        ");
    }

    #[test]
    fn the_same_is_of_one_kind_and_in_one_place() {
        let at = |error: Error, line| error.at(Some(SourcePlace { file: "a.lua".into(), line }));
        let error = at(Error::argument("no"), 3);
        assert!(error.is_same(&at(Error::argument("no").help("yes").module("A", 2), 3)));
        let elsewhere = at(Error::argument("no"), 4);
        assert!(!error.is_same(&elsewhere) && error.says_the_same(&elsewhere));
        for other in [at(Error::argument("never"), 3), at(Error::script("no"), 3)] {
            assert!(!error.is_same(&other) && !error.says_the_same(&other), "{other}");
        }
    }

    #[test]
    fn a_long_text_is_told_without_its_middle() {
        assert_eq!(shorten("0123456789", 10), "0123456789");
        assert_eq!(shorten("0123456789a", 10), "01234... (11 characters in all) ...6789a");
        assert_eq!(shorten("äöüäöü", 6), "äöüäöü");
        assert_eq!(shorten("äöüßéñø", 4), "äö... (7 characters in all) ...ñø");
        let long = "ä".repeat(20_000_000);
        let error =
            Error::argument(&long).help(&long).rule(&long).module(&long, 1).feature(&long).about(&long);
        assert!(error.to_string().len() < 20_000 && error.to_json().to_string().len() < 20_000);
        assert!(error.message().contains("20000000 characters in all"), "{error}");
    }
}
