//! `lsystem`: what a script declares of a system, in each machine.
//!
//! Input: the calls of a script. Output: a grammar, an axiom and functions, ready to derive. No rule is run here.

mod axiom;
mod declaration;
mod declare;
mod handle;
mod lazy;
mod list_table;
mod source;
mod tags;
mod unseen;

pub(crate) use axiom::Axiom;
pub(super) use declaration::{DeclaredAxiom, DeclaredInterpretation, DeclaredRule, DerivationRecord};
pub(crate) use declaration::{Interpretations, SystemDeclaration, SystemFunctions};
pub(crate) use declare::{returns_modules, returns_value};
pub(crate) use handle::SystemHandle;
pub(crate) use lazy::{EagerMark, UNREAD, feature_of, install as install_lazy};
pub(crate) use source::SourceHandle;
pub(crate) use unseen::tell_unseen;
