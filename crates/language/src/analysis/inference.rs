//! The inference of a value in a script.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::{CallForm, Literal, Name};
use burgeon_kit::Kind;

/// Inferred value of an expression.
#[derive(Clone)]
pub(super) enum Inference<'a> {
    /// Unknown value.
    Unknown,
    /// A literal, or a value of a literal's type.
    Value(Literal),
    /// An object of this type.
    Object(&'a Kind),
    /// The constructor of this type.
    Constructor(&'a Kind),
    /// A table with the inferred values of its named entries.
    Table(Arc<BTreeMap<String, Self>>),
    /// A system with the type of its object, if known.
    System(Option<&'a Kind>),
    /// A value of a type of the language, such as a vector.
    Given(&'static Name),
    /// A function or a library of the language.
    Name(&'static Name),
    /// A local function of the script with its declared types.
    Local(Arc<CallForm>),
}

impl Inference<'_> {
    /// Returns true if the inference is worth storing for an entry of a table.
    pub(super) fn is_telling(&self) -> bool {
        matches!(self, Self::Object(_) | Self::Constructor(_) | Self::Table(_) | Self::System(_))
    }
}
