//! The scripting API as data, and the analysis of scripts that use it: the names of the language with their arguments and
//! types, everything derived from them, and the checks of a script before it runs.
//!
//! Input: a registry of object types, and the text of the standard library. Output: names with their signatures, types
//! to check values against, the definition file for editors, and the [`analysis`] of a script. The crate never runs a script, and does not depend on
//! a virtual machine.

pub mod analysis;
mod definitions;
mod editor;
mod examples;
mod form;
mod jsonc;
mod luau_type;
mod names;
mod notation;
mod script_types;
pub mod slips;

pub use definitions::{Definitions, definitions};
pub use editor::{EditorFile, LUAURC, SETTINGS, editor_files, merged_luaurc, merged_settings};
pub use examples::EXAMPLES;
pub use form::{ArgumentList, CallForm, argument};
pub use luau_type::{Literal, LuauType};
pub use names::{
    CAMERA, CAMERA_ANGLES, DERIVE, DERIVED, EXTEND, Effect, LAYER, LOCKED, LSYSTEM, NOW, Name, NameKind,
    OBJECT, Operator, PARAM, RULE, SOURCE, SYSTEM, VECTOR, deprecated_names, is_pure_function,
    library_effect, names,
};
pub use notation::module_form;
pub use script_types::with_types;
