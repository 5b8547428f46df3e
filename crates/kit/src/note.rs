//! What an object had to do otherwise than it was asked, for the report of a run.

/// Something that was simplified or left out.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Note {
    /// What was done instead, in words that can be counted, such as "a flat roof instead of a hip roof".
    pub what: String,
    /// Why, for this object alone; may be empty.
    pub why: String,
}

impl Note {
    /// `what` was done, because of `why`.
    pub fn new(what: impl Into<String>, why: impl Into<String>) -> Self {
        Self { what: what.into(), why: why.into() }
    }
}
