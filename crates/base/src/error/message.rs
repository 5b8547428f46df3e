//! What is told of an error: the place, the rule, the message and the remedy.

use std::borrow::Cow;
use std::fmt;

use super::{ErrorKind, Limit};
use crate::text::{escaped_lines, without_passwords};

/// The characters of a message or a remedy that are told at most; more are left out in the middle.
const LONGEST: usize = 2000;

/// The same for the name of a rule and for a module.
const LONGEST_NAME: usize = 500;

/// The crate's result.
pub type Result<T, E = Error> = std::result::Result<T, E>;

/// A line of a script or data file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct SourcePlace {
    /// The file as the user named it.
    pub file: String,
    /// The line, counted from 1.
    pub line: usize,
}

/// The longest file (bytes) of which lines are shown, and the longest line (characters).
const LARGEST: u64 = 16_000_000;

const WIDEST: usize = 160;

impl SourcePlace {
    /// The lines from so many before it to so many after, each with its number. None if the file cannot be read, and if
    /// the line itself is empty or not there.
    pub fn excerpt(&self, before: usize, after: usize) -> Vec<(usize, String)> {
        let path = std::path::Path::new(&self.file);
        let fits = |metadata: std::fs::Metadata| metadata.is_file() && metadata.len() <= LARGEST;
        if !std::fs::metadata(path).is_ok_and(fits) {
            return Vec::new();
        }
        let Ok(text) = std::fs::read_to_string(path) else { return Vec::new() };
        let first = self.line.saturating_sub(before).max(1);
        let lines = text.lines().enumerate().skip(first - 1).take(self.line + after + 1 - first);
        let shown = |line: &str| without_passwords(line.trim_end()).chars().take(WIDEST).collect();
        let lines = lines.map(|(index, line)| (index + 1, shown(line)));
        let lines: Vec<(usize, String)> = lines.collect();
        let there =
            lines.iter().any(|(number, line): &(usize, String)| *number == self.line && !line.is_empty());
        if there { lines } else { Vec::new() }
    }
}

impl fmt::Display for SourcePlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.file, self.line)
    }
}

/// An error with its place and remedy. Each part is filled in by the first layer that knows it.
///
/// It reads, with everything known:
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
    caller: Option<SourcePlace>,
    rule: Option<String>,
    module: Option<String>,
    step: Option<usize>,
    help: Option<String>,
    more: Vec<Error>,
    fault: Fault,
}

/// Who can mend what is wrong.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
enum Fault {
    /// That is not known.
    #[default]
    Unknown,
    /// Whoever made the data.
    Data,
    /// Whoever wrote the script.
    Script,
}

impl Error {
    /// An error of a kind that says `message`, a clause without a full stop.
    pub fn of(kind: ErrorKind, message: impl fmt::Display) -> Self {
        Self(Box::new(ErrorParts {
            kind,
            message: told(&message.to_string(), LONGEST),
            place: None,
            caller: None,
            rule: None,
            module: None,
            step: None,
            help: None,
            more: Vec::new(),
            fault: Fault::Unknown,
        }))
    }

    /// Several problems found in one go; `problems` is not empty.
    pub fn several(mut problems: Vec<Error>) -> Self {
        if problems.is_empty() {
            return Self::internal("nothing is wrong");
        }
        let mut first = problems.remove(0);
        first.0.more.extend(problems);
        first
    }

    /// The same place, rule and module, but the kind, the message and the remedy of `cause`.
    #[must_use]
    pub fn because(mut self, cause: &Self) -> Self {
        self.0.kind.clone_from(&cause.0.kind);
        self.0.message.clone_from(&cause.0.message);
        self.0.help.clone_from(&cause.0.help);
        self
    }

    /// Is of another kind.
    #[must_use]
    pub fn in_kind(mut self, kind: ErrorKind) -> Self {
        self.0.kind = kind;
        self
    }

    /// Says `message` in place of its own, and something else about the same.
    #[must_use]
    pub fn saying(mut self, message: impl fmt::Display) -> Self {
        self.0.message = told(&message.to_string(), LONGEST);
        self
    }

    /// Says what it is about, unless the message says that already.
    #[must_use]
    pub fn about(mut self, what: &str) -> Self {
        let what = without_passwords(what);
        if !self.0.message.contains(&*what) {
            self.0.message = format!("{}: {}", shortened(&what, LONGEST_NAME), self.0.message);
        }
        self
    }

    /// Adds `what` in brackets to the message.
    #[must_use]
    pub fn noting(mut self, what: &str) -> Self {
        self.0.message = format!("{} ({})", self.0.message, told(what, LONGEST_NAME));
        self
    }

    /// Says which feature was being read when it happened.
    #[must_use]
    pub fn feature(self, id: &str) -> Self {
        self.noting(&format!("feature {id}"))
    }

    /// Blames the data: what a feature holds cannot be built, whatever the script does with it. A run that is out of time or
    /// memory, or cancelled, is never blamed on one feature, since the next one would fail as well.
    #[must_use]
    pub fn of_data(mut self) -> Self {
        let ends_run =
            matches!(self.0.kind, ErrorKind::Limit(Limit::Memory | Limit::Time) | ErrorKind::Stopped);
        if self.0.fault == Fault::Unknown && !ends_run {
            self.0.fault = Fault::Data;
        }
        self
    }

    /// Says that the script is at fault, whatever the data holds, and not the data.
    #[must_use]
    pub fn of_script(mut self) -> Self {
        self.0.fault = Fault::Script;
        self
    }

    /// Whether the data is at fault, and not the script: then a run may leave the feature out and go on.
    pub fn is_of_data(&self) -> bool {
        self.0.fault == Fault::Data
    }

    /// Says what to do about it.
    #[must_use]
    pub fn help(mut self, help: impl fmt::Display) -> Self {
        self.0.help.get_or_insert_with(|| told(&help.to_string(), LONGEST));
        self
    }

    /// Says where, unless that is known already.
    #[must_use]
    pub fn at(mut self, place: Option<SourcePlace>) -> Self {
        if self.0.place.is_none() {
            self.0.place = place;
        }
        self
    }

    /// Says where more exactly than is known so far.
    #[must_use]
    pub fn rather_at(mut self, place: Option<SourcePlace>) -> Self {
        if place.is_some() {
            self.0.place = place;
        }
        self
    }

    /// Says which line of the script led there, unless that is known already. It is told if the place is in another file.
    #[must_use]
    pub fn called_at(mut self, caller: Option<SourcePlace>) -> Self {
        if self.0.caller.is_none() {
            self.0.caller = caller;
        }
        self
    }

    /// Says which line of the script led there more exactly than is known so far: no line calls a rule, so what led there is
    /// what made its system.
    #[must_use]
    pub fn rather_called_at(mut self, caller: Option<SourcePlace>) -> Self {
        self.0.caller = caller;
        self
    }

    /// Names the rule, unless it is named already.
    #[must_use]
    pub fn rule(mut self, rule: impl fmt::Display) -> Self {
        self.0.rule.get_or_insert_with(|| told(&rule.to_string(), LONGEST_NAME));
        self
    }

    /// Names the module with its parameters and the derivation step, unless they are known already.
    #[must_use]
    pub fn module(mut self, module: impl fmt::Display, step: usize) -> Self {
        if self.0.module.is_none() {
            self.0.module = Some(told(&module.to_string(), LONGEST_NAME));
            self.0.step = Some(step);
        }
        self
    }

    /// What it is about, for code.
    pub fn kind(&self) -> &ErrorKind {
        &self.0.kind
    }

    /// What is wrong, without the place.
    pub fn message(&self) -> &str {
        &self.0.message
    }

    /// What to do about it, if known.
    pub fn remedy(&self) -> Option<&str> {
        self.0.help.as_deref()
    }

    /// Where, if known.
    pub fn place(&self) -> Option<&SourcePlace> {
        self.0.place.as_ref()
    }

    /// The line that led to the place, if it is to be told.
    fn caller(&self) -> Option<&SourcePlace> {
        let (place, caller) = (self.0.place.as_ref()?, self.0.caller.as_ref()?);
        (place.file != caller.file).then_some(caller)
    }

    /// Whether it is of the kind of `other` and tells people the same, wherever that is.
    pub fn says_the_same(&self, other: &Self) -> bool {
        self.0.kind == other.0.kind && self.0.message == other.0.message
    }

    /// Whether it tells people the same as `other`, in the same place.
    pub fn is_same(&self, other: &Self) -> bool {
        self.0.place == other.0.place && self.says_the_same(other)
    }

    /// This problem without those reported with it.
    #[must_use]
    pub fn alone(&self) -> Self {
        let mut alone = self.clone();
        alone.0.more.clear();
        alone
    }

    /// This problem and those reported with it, in order.
    pub fn problems(&self) -> impl Iterator<Item = &Error> {
        std::iter::once(self).chain(&self.0.more)
    }

    /// The error for machines: `{ code, message, file, line, called_at: { file, line }, rule, module, step, help }`, absent
    /// where unknown; codes are those of [`ErrorKind::code`].
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

    /// This problem alone, with `line`, the text of the line that it is about, below its message.
    pub fn with_line(&self, line: Option<&str>) -> String {
        let parts = &*self.0;
        let mut text = String::new();
        if let Some(place) = &parts.place {
            text += &format!("{place}: ");
        }
        if let Some(rule) = &parts.rule {
            text += &format!("rule {rule}: ");
        }
        text += &parts.message;
        if let Some(line) = line {
            text += &format!("\n  | {line}");
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
            f.write_str(&problem.with_line(None))?;
        }
        Ok(())
    }
}

impl std::error::Error for Error {}

/// Returns a text for people: without passwords, and not too long.
fn told(text: &str, most: usize) -> String {
    shortened(&without_passwords(text), most).into_owned()
}

/// `text`, without its middle where it has more than `most` characters: how long it is stands in its place.
pub fn shortened(text: &str, most: usize) -> Cow<'_, str> {
    // A text has at least as many bytes as characters.
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
        insta::assert_snapshot!(error("b.lua").with_line(Some("error()")), @r"
        b.lua:3: no
          | error()
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
        assert_eq!(shortened("0123456789", 10), "0123456789");
        assert_eq!(shortened("0123456789a", 10), "01234... (11 characters in all) ...6789a");
        assert_eq!(shortened("äöüäöü", 6), "äöüäöü");
        assert_eq!(shortened("äöüßéñø", 4), "äö... (7 characters in all) ...ñø");
        let long = "ä".repeat(20_000_000);
        let error =
            Error::argument(&long).help(&long).rule(&long).module(&long, 1).feature(&long).about(&long);
        assert!(error.to_string().len() < 20_000 && error.to_json().to_string().len() < 20_000);
        assert!(error.message().contains("20000000 characters in all"), "{error}");
    }
}
