//! Error kinds for code, with stable machine-readable names.

use std::path::PathBuf;

use crate::warning_kind::WarningKind;

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
    /// All codes in alphabetical order with their meanings. [`WarningKind`](crate::WarningKind) has the codes
    /// of warnings that end a strict run.
    pub const CODES: [(&str, &str); 20] = [
        ("argument", "a value that a function, a field, an option or a message does not accept"),
        ("data", "invalid or unsupported content of a data file, a model or an image"),
        ("file", "a file or a folder that cannot be read or written"),
        ("geometry", "a shape that cannot be built"),
        ("internal", "a bug in Burgeon"),
        ("limit.format", "more than a file format can contain"),
        ("limit.memory", "the memory limit of a run: --memory-limit"),
        ("limit.modules", "the module limit of a system: --module-limit"),
        ("limit.size", "a fixed size limit of Burgeon"),
        ("limit.time", "the time limit of a run: --time-limit"),
        ("limit.triangles", "the triangle limit of a system: --triangle-limit"),
        ("not-found", "an unknown name"),
        ("other", "an error of a host program or of its object types"),
        ("scope", "an operation that is not allowed at this place"),
        ("script", "an error of the script: an error it raises, a wrong order or a duplicate"),
        ("stopped", "cancelled"),
        ("syntax", "text that cannot be parsed"),
        ("system", "a failure of the operating system: threads, ports, other programs"),
        ("unavailable", "something that is not available at the moment, or not in this program"),
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
