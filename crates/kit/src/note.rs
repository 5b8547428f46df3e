//! Report entries of objects about results that differ from the request.

/// A report entry about something that was simplified or omitted.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// Result instead of the requested one, in a fixed text that can be counted, such as "a flat roof instead of a hip
    /// roof".
    pub what: String,
    /// Reason for this object; may be empty.
    pub why: String,
}

impl Note {
    /// Creates an entry that `what` was done because of `why`.
    pub fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into() }
    }
}
