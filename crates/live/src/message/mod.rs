//! What server and page say to each other: JSON objects whose `type` is the name of the case.
//!
//! Everything that the server says goes to all pages, except answers with an `id`, which go to the page that
//! asked. Whole numbers of 64 bits travel as text. Times are in milliseconds, lengths in metres with z up; the
//! model itself is glTF, y up.

mod bounded;
mod command;
mod event;
mod model;
mod origin;

pub use command::{PageCommand, PickCommand, read};
pub use event::{Cause, Event, Hello};
pub use model::{
    Bounds, ControlMessage, CountMessage, ModelMessage, ParamMessage, RuleMessage, SystemMessage,
    TimesMessage, json,
};
pub use origin::{
    AroundMessage, HighlightMessage, ModuleMessage, NamedValue, OriginMessage, PickMessage, Range, RulePlace,
    StepMessage,
};
