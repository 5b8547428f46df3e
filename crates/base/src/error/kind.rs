//! Error kinds for code, with stable machine-readable names.

use std::fmt;
use std::path::{Path, PathBuf};

use super::Error;
use super::suggest::nearest;
use crate::warning::WarningKind;

/// Kind of an error. The message is for users; code that must distinguish errors matches on the kind.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// A value that a function, a field, an option or a message does not accept.
    Argument,
    /// Invalid content of a data file, a model or an image.
    Data,
    /// A file or a folder that cannot be read or written.
    File {
        /// Path of the file or folder.
        path: PathBuf,
    },
    /// A shape that cannot be built.
    Geometry,
    /// A bug in Burgeon.
    Internal,
    /// An exceeded limit.
    Limit(Limit),
    /// An unknown name.
    NotFound {
        /// Type of the named thing, such as `field`.
        what: &'static str,
        /// The unknown name.
        name: String,
        /// Nearest known name, if one is similar enough.
        suggestion: Option<String>,
    },
    /// An error from a host program or from one of its objects.
    Other,
    /// An operation that is not allowed in its context, such as a change of an object in a rule.
    Scope,
    /// An error of the script: an error that it raises, or calls that are repeated or in the wrong order.
    Script,
    /// Cancelled work.
    Stopped,
    /// Text that cannot be parsed.
    Syntax,
    /// An operation that the operating system refuses: threads, ports, other programs.
    System,
    /// Something that is not available now, such as the model of a script that has changed since, or that is not part
    /// of this build.
    Unavailable,
    /// An invalid command line.
    Usage,
    /// A warning that ends a strict run.
    Warning(WarningKind),
}

/// An exceeded limit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Limit {
    /// Capacity of a file format.
    Format,
    /// Memory of a run.
    Memory,
    /// Number of modules of a system.
    Modules,
    /// Fixed maximum of Burgeon, independent of the limits of a run.
    Size,
    /// Time of a run.
    Time,
    /// Number of triangles of a system or model.
    Triangles,
}

impl ErrorKind {
    /// All codes in alphabetical order with their meanings. [`WarningKind`](crate::warning::WarningKind) has the codes
    /// of warnings that end a strict run.
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

    /// Returns the machine-readable name: one of [`CODES`](Self::CODES), or the code of a warning. Names are stable
    /// across versions.
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

/// Constructors for each kind of error. `message` is a clause without a full stop.
impl Error {
    /// Creates an error for a value that is not accepted.
    pub fn argument(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Argument, message)
    }

    /// Creates an error for invalid content of a data file, a model or an image.
    pub fn data(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Data, message)
    }

    /// Creates an error for a file or a folder that cannot be read or written.
    pub fn file(path: impl AsRef<Path>, message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::File { path: path.as_ref().to_owned() }, message)
    }

    /// Creates an error for a shape that cannot be built.
    pub fn geometry(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Geometry, message)
    }

    /// Creates an error for a bug in Burgeon.
    pub fn internal(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Internal, message)
    }

    /// Creates an error for an exceeded limit.
    pub fn limit(limit: Limit, message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Limit(limit), message)
    }

    /// Creates an error for an unknown `name` of a `what`. If one of the `known` names is similar enough, the remedy
    /// suggests it, and a later call of [`help`](Self::help) has no effect.
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

    /// Creates an error from a host program or from one of its objects.
    pub fn other(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Other, message)
    }

    /// Creates an error for an operation that is not allowed in its context.
    pub fn scope(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Scope, message)
    }

    /// Creates an error of the script.
    pub fn script(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Script, message)
    }

    /// Creates the reason for cancelling work.
    pub fn stopped(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Stopped, message)
    }

    /// Creates an error for text that cannot be parsed.
    pub fn syntax(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Syntax, message)
    }

    /// Creates an error for an operation that the operating system refuses.
    pub fn system(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::System, message)
    }

    /// Creates an error for something that is not available now or not part of this build.
    pub fn unavailable(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Unavailable, message)
    }

    /// Creates an error for a part that this build lacks, such as "pictures", with the cargo feature that adds it.
    pub fn left_out(what: &str, feature: &str) -> Self {
        Self::unavailable(format!("this program was built without {what}"))
            .help(format!("build it with --features {feature}"))
    }

    /// Creates an error for an invalid command line.
    pub fn usage(message: impl fmt::Display) -> Self {
        Self::of(ErrorKind::Usage, message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns one error of each kind except warnings.
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
