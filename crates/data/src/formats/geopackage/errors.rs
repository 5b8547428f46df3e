//! Errors of SQLite as errors of a file or of a condition.

use crate::source_options::SourceOptions;
use burgeon_base::error::Error;
use std::borrow::Cow;

/// Returns the message text of an SQLite error.
fn error_text(error: &rusqlite::Error) -> Cow<'_, str> {
    match error {
        rusqlite::Error::SqliteFailure(_, Some(text)) => text.into(),
        rusqlite::Error::SqlInputError { msg, .. } => msg.into(),
        rusqlite::Error::MultipleStatement => "it contains more than one statement".into(),
        other => other.to_string().into(),
    }
}

/// Returns the error for a file called `name` that cannot be read.
pub(super) fn read_error(name: &str, error: &rusqlite::Error) -> Error {
    Error::data(format!("cannot read {name}: {}", error_text(error)))
        .help("the file is damaged or cut short; download it again")
}

/// Returns the error of a query; it refers to the condition, if there is one.
pub(in crate::formats) fn query_error(shown: &str, wanted: &SourceOptions, error: &rusqlite::Error) -> Error {
    let text = error_text(error);
    match &wanted.condition {
        Some(condition) if !text.contains("malformed") => {
            let condition: String = condition.chars().take(200).collect();
            Error::argument(format!("where {condition:?} of {shown}: {text}"))
                .help("write an SQL condition on the layer's columns, such as where = \"height > 10\"")
        }
        _ => read_error(shown, error),
    }
}
