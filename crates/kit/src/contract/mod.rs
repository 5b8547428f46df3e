//! The contract of objects, kinds and values, which refer to each other: an object has a kind, a kind has methods that take
//! values, and a value may be an object.

mod argument;
mod capability;
mod constructor;
mod control_points;
pub mod declare;
mod deprecation;
mod drawing;
mod environment;
mod kind;
mod loading;
mod model;
mod object;
mod parameter;
mod place;
mod prefetch;
mod rewriter;
mod value;
mod values;
mod vector;

pub use argument::Argument;
pub use capability::{
    Capabilities, Capability, Draw, Expand, Gather, HasLayers, IntoParts, LevelOfDetail, ObjectContent,
    PartMaker, Report, Show, Warn,
};
pub use constructor::Constructor;
pub use control_points::{ControlPoints, HasControlPoints, PointRows, PointSpace};
pub use deprecation::Deprecation;
pub use drawing::{Drawing, DrawingMark};
pub use environment::Environment;
pub use kind::{
    Call, Construct, Field, Kind, KindDeclaration, Make, Method, ReadCall, Write, WriteNumbers, luau_name,
};
pub use loading::{LoadRequest, LoadServices, LoadedObject, Loader, Resources};
pub use model::Model;
pub use object::Object;
pub use parameter::{Answer, Expectation, ObjectParameter, Parameter, object};
pub use place::{Locate, ObjectPlace, Rescale, Rewind};
pub use prefetch::{BeginPrefetch, Prefetch};
pub use rewriter::{RewriteOutcome, Rewriter, RuleSet, System};
pub use value::{Table, TableKey, Value, are_equal, is_keyword};
pub use values::Values;
pub use vector::{AxisScale, Vector};
