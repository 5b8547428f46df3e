//! Messages between server and pages: JSON objects whose `type` is the name of the variant.
//!
//! The server sends every message to all pages, except answers with an `id`, which only the querying page receives.
//! 64-bit integers are sent as strings. Times are in milliseconds, lengths in metres with z up; the model itself is
//! glTF, y up.

mod bounded;
mod cause;
mod command;
mod event;
mod model;
mod origin;

pub use cause::Cause;
pub use command::{PageCommand, PickCommand, read};
pub use event::{Event, FormatMessage, Hello, PartMessage, PrintMessage};
pub use model::{
    Bounds, CameraMessage, ControlMessage, CountMessage, ModelMessage, ParamMessage, RuleMessage,
    SystemMessage, TimesMessage,
};
pub use origin::{
    AroundMessage, HighlightMessage, ModuleMessage, NamedValue, OriginMessage, PickMessage, Range, RulePlace,
    StepMessage,
};
