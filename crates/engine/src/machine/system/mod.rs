//! `lsystem`: declaration of a system by a script, in each machine.
//!
//! Input: the calls of a script. Output: a grammar, an axiom and functions, ready for derivation. This folder
//! runs no rules.

mod axiom;
mod chain_builder;
mod declaration;
mod declare;
mod dependents;
mod derive_arguments;
mod handle;
mod hooks;
mod ignored;
mod interpretations;
mod lazy;
mod module_string;
mod selection;
mod source;
mod strings;
mod subsystems;
mod unseen;

pub(crate) use axiom::Axiom;
pub(crate) use chain_builder::replaced_chain;
pub(super) use declaration::{DeclaredAxiom, DeclaredRule, DerivationRecord, ReceiverUse};
pub(crate) use declaration::{RulePhase, SystemDeclaration, SystemFunctions};
pub(crate) use declare::{returns_value, stops_at_depth};
pub(crate) use handle::SystemHandle;
pub(crate) use hooks::{HookFunction, HookMoment};
pub(super) use interpretations::{DeclaredInterpretation, is_unconditional};
pub(crate) use interpretations::{Interpretation, Interpretations};
pub(crate) use lazy::{EagerMark, UNREAD, feature_of, install as install_lazy};
pub(super) use module_string::undeclared_letters;
pub(crate) use source::SourceHandle;
pub(crate) use unseen::tell_unseen;
