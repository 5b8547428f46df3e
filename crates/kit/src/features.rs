//! Features of a data file, as a source passes them to a constructor.

use std::sync::Arc;

use burgeon_data::Layer;
use burgeon_macros::{methods, object};

/// The features of a data file.
///
/// Constructors can take them; no script sees them in this form.
#[object("source", given)]
pub struct Features(pub Arc<Layer>);

#[methods("source")]
impl Features {}
