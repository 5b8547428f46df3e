//! Contract of objects: values, object types and the interfaces that rules need from them.
//!
//! Input: values from scripts. Output: [`Kind`]s in a [`Registry`], [`Object`]s with their drawings, and the [`Values`]
//! that chain modules contain. The crate never depends on a virtual machine. Its only object type is
//! [`Model`], the drawn result of a system.

extern crate self as burgeon_kit;

mod buffer_bytes;
mod color;
mod colors;
mod contract;
mod distance;
mod example;
mod fields;
mod makers;
mod registry;
mod script_types;
mod seed;
mod sources;

pub use buffer_bytes::BufferBytes;
pub use color::Color;
pub use colors::color_bytes;
pub use contract::declare;
pub use contract::{
    Answer, Argument, AxisScale, BeginPrefetch, Call, Capabilities, Capability, Construct, Constructor,
    ControlPoints, Deprecation, Draw, Drawing, DrawingMark, Environment, Expand, Expectation, Field, Gather,
    HasControlPoints, HasLayers, IntoParts, Kind, KindDeclaration, LevelOfDetail, LoadRequest, LoadServices,
    LoadedObject, Loader, Locate, Make, Method, Model, Object, ObjectContent, ObjectParameter, ObjectPlace,
    Parameter, PartMaker, PointRows, PointSpace, Prefetch, ReadCall, Report, Rescale, Resources, Rewind,
    RewriteOutcome, Rewriter, RuleSet, Show, System, Table, TableKey, Value, Values, Vector, Warn, Write,
    WriteNumbers, are_equal, is_keyword, luau_name, object,
};
pub use example::ScriptExample;
pub use fields::{Fields, TableOf};
pub use makers::Makers;
pub use registry::Registry;
pub use script_types::{ScriptField, ScriptObject, ScriptType};
pub use seed::Seed;
pub use sources::{
    Attribute, FeatureSource, ModuleTable, QueryRows, SourceProvider, SourceQuery, SourceRequest, SourceStore,
};

#[doc(hidden)]
pub use burgeon_base::Result;
#[doc(hidden)]
pub use burgeon_base::warning::Warning;
pub use burgeon_macros::{fields, methods, object};
