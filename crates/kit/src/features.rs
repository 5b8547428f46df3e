//! The features of a data file, on their way from a source to a constructor.

use std::sync::Arc;

use burgeon_data::Layer;
use burgeon_macros::{methods, object};

/// The features of a data file.
///
/// A constructor may take them; no script holds them in this form.
#[object("source", given)]
pub struct Features(pub Arc<Layer>);

#[methods("source")]
impl Features {}
