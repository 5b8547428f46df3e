//! Names that every script has in addition to object types, each declared once with its type and description.
//!
//! The help, the errors for unknown names, the analysis of calls and the completion in editors are derived from these
//! declarations. The names of the standard library are declared in its own file.

mod burgeon;
mod list;
mod luau;
mod name;
mod shapes;
mod standard;
mod systems;

pub use burgeon::{CAMERA, CAMERA_ANGLES, EXTEND, LAYER, OBJECT, PARAM, SOURCE, VECTOR};
pub use list::{deprecated_names, is_pure_function, library_effect, names};
pub use luau::LOCKED;
pub use name::{Effect, Name, NameKind, Operator};
pub use systems::{DERIVE, DERIVED, LSYSTEM, NOW, RULE, SYSTEM};
