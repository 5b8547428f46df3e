//! Results of a derivation: the derived system, its skipped and simplified features, and the lineage of
//! modules.
//!
//! Input: the output of the derivation. Output: the same data, for queries by scripts, commands and the live
//! view. This folder runs no rules.

mod derived_system;
mod emptiness;
mod feature_report;
mod layers;
mod records;
mod report_sums;
mod row_features;
mod trace;
mod variables;

pub use burgeon_rewriting::Use;
pub(crate) use derived_system::SystemUses;
pub use derived_system::{DerivedSystem, RuleReport, Times};
pub(crate) use emptiness::{emptiness, idleness, is_whole, left_out, tells_of_emptiness};
pub use feature_report::FeatureReport;
pub(crate) use feature_report::{skipped_feature, unread_feature};
pub use layers::layers;
pub(crate) use records::SourceFeatures;
pub(crate) use report_sums::ReportSums;
pub use report_sums::ReportTotal;
pub(crate) use row_features::RowFeatures;
pub use trace::{Ancestor, Module, RuleName, RuleProducts, Trace};
pub(crate) use trace::{PendingAnswer, RESOLVED};
pub(crate) use trace::{Step, around};
pub(crate) use variables::VariableValues;
