//! What an error is about, for code: a kind with a stable name for machines.

use std::fmt;
use std::path::{Path, PathBuf};

use super::Error;
use super::suggest::nearest;
use crate::warning::WarningKind;

/// What an error is about. Its text is for people; whoever has to tell errors apart matches on this.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A value that a function, a field, an option or a message does not take.
    Argument,
    /// What a data file, a model or an image holds.
    Data,
    /// A file or a folder that cannot be read or written.
    File {
        /// Which.
        path: PathBuf,
    },
    /// A shape that cannot be built.
    Geometry,
    /// A mistake in Burgeon.
    Internal,
    /// More than is allowed.
    Limit(Limit),
    /// A name that nothing has.
    NotFound {
        /// What it would be the name of, such as `field`.
        what: &'static str,
        /// The name.
        name: String,
        /// The nearest name that there is, if one is near enough to be meant.
        suggestion: Option<String>,
    },
    /// What a host program, or an object of its own, says.
    Other,
    /// Something that may not be done where it stands, such as a change of an object in a rule.
    Scope,
    /// A mistake of the script: what it raises, and what it does in the wrong order or twice.
    Script,
    /// Work that was stopped, since nobody waits for it any more.
    Stopped,
    /// A text that cannot be parsed.
    Syntax,
    /// What the operating system refuses: threads, ports, other programs.
    System,
    /// Something that is not there at the moment, such as the model of a script that has changed since, or that the
    /// program was built without.
    Unavailable,
    /// The command line.
    Usage,
    /// A warning that ends a strict run.
    Warning(WarningKind),
}

/// A bound that was passed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// What a file format can hold.
    Format,
    /// The memory of a run.
    Memory,
    /// The modules of a system.
    Modules,
    /// What Burgeon takes at most, whatever a run is allowed.
    Size,
    /// The time of a run.
    Time,
    /// The triangles of a system or of a model.
    Triangles,
}

impl ErrorKind {
    /// Every code, in order, and what it says. Those of warnings that end a strict run stand in
    /// [`WarningKind`](crate::warning::WarningKind).
    pub const CODES: [(&str, &str); 20] = [
        ("argument", "a value that a function, a field, an option or a message does not take"),
        ("data", "what a data file, a model or an image holds"),
        ("file", "a file or a folder that cannot be read or written"),
        ("geometry", "a shape that cannot be built"),
        ("internal", "a mistake in Burgeon"),
        ("limit.format", "more than a file format can hold"),
        ("limit.memory", "more memory than a run may use: --memory-limit"),
        ("limit.modules", "more modules than a system may have: --module-limit"),
        ("limit.size", "more than Burgeon takes at most, whatever a run is allowed"),
        ("limit.time", "more time than a run may take: --time-limit"),
        ("limit.triangles", "more triangles than a system may draw: --triangle-limit"),
        ("not-found", "a name that nothing has"),
        ("other", "what a host program, or an object of its own, says"),
        ("scope", "something that may not be done where it stands"),
        ("script", "a mistake of the script: what it raises, or does in the wrong order or twice"),
        ("stopped", "work that was stopped, since nobody waits for it any more"),
        ("syntax", "a text that cannot be parsed"),
        ("system", "what the operating system refuses: threads, ports, other programs"),
        ("unavailable", "something that is not there at the moment, or not in this program"),
        ("usage", "the command line"),
    ];

    /// Its name for machines, one of [`CODES`](Self::CODES), or that of a warning. It stays the same from version to
    /// version.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Argument => "argument",
            Self::Data => "data",
            Self::File { .. } => "file",
            Self::Geometry => "geometry",
            Self::Internal => "internal",
            Self::Limit(Limit::Format) => "limit.format",
            Self::Limit(Limit::Memory) => "limit.memory",
            Self::Limit(Limit::Modules) => "limit.modules",
            Self::Limit(Limit::Size) => "limit.size",
            Self::Limit(Limit::Time) => "limit.time",
            Self::Limit(Limit::Triangles) => "limit.triangles",
            Self::NotFound { .. } => "not-found",
            Self::Other => "other",
            Self::Scope => "scope",
            Self::Script => "script",
            Self::Stopped => "stopped",
            Self::Syntax => "syntax",
            Self::System => "system",
            Self::Unavailable => "unavailable",
            Self::Usage => "usage",
            Self::Warning(kind) => kind.code(),
        }
    }
}

/// Errors of each kind; each says `message`, a clause without a full stop.
impl Error {
    /// A value that is not taken.
    pub fn argument(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Argument, message)
    }

    /// Something wrong in a data file, a model or an image.
    pub fn data(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Data, message)
    }

    /// A file or a folder that cannot be read or written.
    pub fn file(path: impl AsRef<Path>, message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::File { path: path.as_ref().to_owned() }, message)
    }

    /// A shape that cannot be built.
    pub fn geometry(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Geometry, message)
    }

    /// A mistake in Burgeon.
    pub fn internal(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Internal, message)
    }

    /// More than is allowed.
    pub fn limit(limit: Limit, message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Limit(limit), message)
    }

    /// A `name` that nothing has; `what` it would be the name of. The remedy is the nearest of the names that are
    /// `known`, where one is near enough to be meant, and otherwise what is given to [`help`](Self::help).
    pub fn not_found<'a>(
        what: &'static str,
        name: impl fmt::Display,
        known: impl IntoIterator<Item = &'a str>,
        message: impl fmt::Display,
    ) -> Self {
        let name = name.to_string();
        let suggestion = nearest(&name, known).map(str::to_owned);
        let help = suggestion.as_deref().map(super::suggest::did_you_mean);
        let error = Self::of(ErrorKind::NotFound { what, name, suggestion }, message);
        match help {
            Some(help) => error.help(help),
            None => error,
        }
    }

    /// What a host program, or an object of its own, says.
    pub fn other(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Other, message)
    }

    /// Something that may not be done where it stands.
    pub fn scope(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Scope, message)
    }

    /// A mistake of the script.
    pub fn script(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Script, message)
    }

    /// The reason why work is stopped.
    pub fn stopped(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Stopped, message)
    }

    /// A text that cannot be parsed.
    pub fn syntax(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Syntax, message)
    }

    /// Something that the operating system refuses.
    pub fn system(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::System, message)
    }

    /// Something that is not there at the moment, or not in this program.
    pub fn unavailable(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Unavailable, message)
    }

    /// What this program was built without, and the cargo feature that brings it: `pictures`, `pictures`.
    pub fn left_out(what: &str, feature: &str) -> Self {
        Self::unavailable(format!("this program was built without {what}"))
            .help(format!("build it with --features {feature}"))
    }

    /// A wrong command line.
    pub fn usage(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Usage, message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One error of each kind, but for the warnings.
    fn every_kind() -> Vec<Error> {
        let limits =
            [Limit::Format, Limit::Memory, Limit::Modules, Limit::Size, Limit::Time, Limit::Triangles];
        let of_limits = limits.map(|limit| Error::limit(limit, ""));
        let others = [
            Error::argument(""),
            Error::data(""),
            Error::file("a.lua", ""),
            Error::geometry(""),
            Error::internal(""),
            Error::not_found("field", "heigth", ["height"], ""),
            Error::other(""),
            Error::scope(""),
            Error::script(""),
            Error::stopped(""),
            Error::syntax(""),
            Error::system(""),
            Error::unavailable(""),
            Error::usage(""),
        ];
        of_limits.into_iter().chain(others).collect()
    }

    #[test]
    fn every_code_is_unique_and_stands_in_the_one_list() {
        let mut codes: Vec<&str> = every_kind().iter().map(|error| error.kind().code()).collect();
        codes.sort_unstable();
        let listed: Vec<&str> = ErrorKind::CODES.iter().map(|(code, _)| *code).collect();
        assert_eq!(codes, listed);
        codes.dedup();
        assert_eq!(codes.len(), listed.len());
        assert!(ErrorKind::CODES.iter().all(|(_, meaning)| !meaning.is_empty()));
    }

    #[test]
    fn a_missing_name_proposes_the_nearest_and_has_it_as_data() {
        let error = Error::not_found("field", "heigth", ["width", "height"], "it has no field called heigth");
        assert_eq!(error.clone().help("it has width, height").remedy(), Some("did you mean height?"));
        let ErrorKind::NotFound { what, name, suggestion } = error.kind() else { panic!("{error:?}") };
        assert_eq!((*what, name.as_str(), suggestion.as_deref()), ("field", "heigth", Some("height")));
        let far = Error::not_found("field", "x", ["width", "height"], "it has no field called x");
        assert_eq!(far.help("it has width, height").remedy(), Some("it has width, height"));
    }
}
