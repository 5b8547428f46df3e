//! Constructors for each kind of error.

use std::fmt;
use std::path::Path;

use super::kind::{ErrorKind, Limit};
use super::message::Error;
use super::suggest::{did_you_mean, nearest};

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
    ///
    /// ```
    /// use burgeon_base::Error;
    ///
    /// let error = Error::not_found("layer", "streats", ["houses", "streets"], "no layer named `streats`");
    /// assert_eq!(error.kind().code(), "not-found");
    /// assert_eq!(error.remedy(), Some("did you mean streets?"));
    /// ```
    pub fn not_found<'a>(
        what: &'static str,
        name: impl fmt::Display,
        known: impl IntoIterator<Item = &'a str>,
        message: impl fmt::Display,
    ) -> Self {
        let name = name.to_string();
        let suggestion = nearest(&name, known).map(str::to_owned);
        let help = suggestion.as_deref().map(did_you_mean);
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
    pub fn cancellation(message: impl fmt::Display) -> Self {
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
            Error::cancellation(""),
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
