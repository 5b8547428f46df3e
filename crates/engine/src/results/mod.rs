//! What a derivation gives: the derived system, what could not be built of it, and which rules made what.
//!
//! Input: what the derivation hands over. Output: the same, to be asked by scripts, by commands and by the page.
//! It never runs a rule.

mod derived_system;
mod emptiness;
mod layers;
mod records;
mod remark;
mod row_features;
mod trace;

pub use burgeon_rewriting::Use;
pub(crate) use derived_system::SystemUses;
pub use derived_system::{DerivedSystem, RuleReport, Times};
pub(crate) use emptiness::{emptiness, idleness, is_whole, left_out, tells_of_emptiness};
pub use layers::layers;
pub(crate) use records::SourceFeatures;
pub use remark::{FeatureReport, Remark};
pub(crate) use row_features::RowFeatures;
pub use trace::{Ancestor, Module, RuleName, RuleProducts, Trace};
pub(crate) use trace::{PendingAnswer, RESOLVED};
pub(crate) use trace::{Step, around};
