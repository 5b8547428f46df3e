//! Types of objects that scripts declare.

mod declaration;
mod field;
mod object;

pub use declaration::ScriptType;
pub use field::ScriptField;
pub use object::ScriptObject;
