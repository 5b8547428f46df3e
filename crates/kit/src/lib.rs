//! Contract of objects: values, object types and the interfaces that rules need from them.
//!
//! Input: values from scripts. Output: [`Kind`]s in a [`Registry`], [`Object`]s with their drawings, and the [`Values`]
//! that chain modules contain. The crate does not depend on a virtual machine. It defines only two object types:
//! [`Model`], the drawn result of a system, and [`GeometryObject`], a value.

extern crate self as burgeon_kit;

pub mod declare;

mod argument;
mod buffer_bytes;
mod capability;
mod color;
mod colors;
mod constructor;
mod distance;
mod drawing;
mod example;
mod fields;
mod kind;
mod loading;
mod makers;
mod model;
mod note;
mod object;
mod parameter;
mod prefetch;
mod registry;
mod rewriter;
mod script_field;
mod script_object;
mod script_type;
mod seed;
mod value;
mod values;

pub use argument::Argument;
pub use buffer_bytes::BufferBytes;
pub use capability::{
    Capabilities, Capability, Draw, Expand, Gather, HasLayers, LevelOfDetail, Members, ObjectContent, Report,
    Show, Warn,
};
pub use color::Color;
pub use constructor::Constructor;
pub use drawing::Drawing;
pub use example::ScriptExample;
pub use fields::{Fields, TableOf};
pub use kind::{Call, Construct, Deprecation, Field, Kind, Make, Method, ReadCall, Write, WriteNumbers};
pub use loading::{LoadRequest, LoadedObject, Loader, Resources};
pub use makers::Makers;
pub use model::Model;
pub use note::Note;
pub use object::Object;
pub use parameter::{Answer, AxisScale, Expectation, ObjectParameter, Parameter, Vector, object};
pub use prefetch::{BeginPrefetch, Prefetch};
pub use registry::Registry;
pub use rewriter::{RewriteOutcome, Rewriter, RuleSet, System};
pub use script_field::ScriptField;
pub use script_object::ScriptObject;
pub use script_type::ScriptType;
pub use seed::Seed;
pub use value::{Table, TableKey, Value, is_keyword};
pub use values::Values;

#[doc(hidden)]
pub use burgeon_base::Result;
#[doc(hidden)]
pub use burgeon_base::warning::Warning;
pub use burgeon_macros::{fields, methods, object};
