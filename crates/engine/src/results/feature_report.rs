//! Skipped and simplified features, for the report of a run.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::json;

use burgeon_base::error::Error;
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};

/// Creates the warning about a feature that was skipped because of `error`.
pub(crate) fn skipped_feature(source: &str, feature: Option<&str>, error: &Error) -> Warning {
    Warning::new(WarningKind::SkippedFeature, "skipped")
        .with_cause(error.message())
        .of_feature(source, feature)
}

/// Creates the warning about a feature that could not be read because of `error`.
pub(crate) fn unread_feature(source: &str, feature: &str, error: &Error) -> Warning {
    Warning::new(WarningKind::UnreadFeature, "skipped")
        .with_cause(error.message())
        .of_feature(source, Some(feature))
}

/// Returns true if nothing was built for the feature of a warning.
fn is_skipped(warning: &Warning) -> bool {
    matches!(warning.kind(), WarningKind::SkippedFeature | WarningKind::UnreadFeature)
}

/// Converts a warning about a feature to JSON.
fn feature_json(warning: &Warning) -> serde_json::Value {
    json!({
        "source": warning.source(),
        "feature": warning.feature(),
        "done": if is_skipped(warning) { "skipped" } else { "simplified" },
        "what": warning.message(),
        "why": warning.cause(),
    })
}

/// Number of features of a run, and the skipped and simplified features.
#[derive(Debug, Clone, Default)]
pub struct FeatureReport {
    /// Number of features of all systems that were shown or placed.
    pub features: usize,
    /// Number of skipped features.
    pub skipped: usize,
    /// Number of simplified chains.
    pub simplified: usize,
    /// Number of warnings per kind of change.
    pub counts: BTreeMap<String, usize>,
    /// Warnings about features: for each system first the features without a chain, then the chains in order.
    pub warnings: Vec<Warning>,
}

impl FeatureReport {
    /// Adds the warnings about the features of a system with `features` features.
    pub(crate) fn add(&mut self, features: usize, warnings: &[Warning]) {
        self.features += features;
        let mut last: Option<&Warning> = None;
        for warning in warnings {
            let same =
                |last: &Warning| last.source() == warning.source() && last.feature() == warning.feature();
            if is_skipped(warning) {
                self.skipped += 1;
            } else if !last.is_some_and(|last| same(last) && !is_skipped(last)) {
                self.simplified += 1;
            }
            *self.counts.entry(warning.message().to_owned()).or_default() += 1;
            last = Some(warning);
        }
        self.warnings.extend_from_slice(warnings);
    }

    /// Returns true if nothing was skipped or simplified.
    pub fn is_clean(&self) -> bool {
        self.warnings.is_empty()
    }

    /// Returns the counts as JSON: `{ features, skipped, simplified, counts }`.
    pub fn counts_json(&self) -> serde_json::Value {
        json!({
            "features": self.features,
            "skipped": self.skipped,
            "simplified": self.simplified,
            "counts": self.counts,
        })
    }

    /// Writes the counts and all warnings as one JSON document, one line per warning.
    pub fn write_json(&self, out: &mut impl std::io::Write) -> std::io::Result<()> {
        let counts = self.counts_json().to_string();
        let counts = counts.strip_suffix('}').unwrap_or(&counts);
        writeln!(out, "{counts},\"remarks\":[")?;
        for (index, warning) in self.warnings.iter().enumerate() {
            let comma = if index + 1 < self.warnings.len() { "," } else { "" };
            writeln!(out, "{}{comma}", feature_json(warning))?;
        }
        writeln!(out, "]}}")
    }
}

impl fmt::Display for FeatureReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = if self.features == 1 { "feature" } else { "features" };
        let all = grouped(self.features);
        if self.features == 0 {
            // A chain that came from no feature cannot be skipped.
            let chains = if self.simplified == 1 { "chain" } else { "chains" };
            return write!(f, "{} {chains} simplified", grouped(self.simplified));
        }
        match (self.skipped, self.simplified) {
            (0, simplified) => write!(f, "{} of {all} {what} simplified", grouped(simplified)),
            (skipped, 0) => write!(f, "{} of {all} {what} skipped", grouped(skipped)),
            (skipped, simplified) => {
                write!(f, "{} of {all} {what} skipped, {} simplified", grouped(skipped), grouped(simplified))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn features_are_counted_once_and_what_was_done_each_time() {
        let simplified = |source: &str, feature: Option<&str>, what: &str| {
            Warning::simplification(what).of_feature(source, feature)
        };
        let warnings = [
            skipped_feature("a:b", Some("1"), &Error::geometry("it has no area")),
            simplified("a:b", Some("2"), "a flat roof instead of a hip roof"),
            simplified("a:b", Some("2"), "repeated points dropped"),
            simplified("a:b", Some("7"), "repeated points dropped"),
        ];
        let mut report = FeatureReport::default();
        report.add(15_608, &warnings);
        assert_eq!(report.to_string(), "1 of 15,608 features skipped, 2 simplified");
        assert_eq!(report.counts["repeated points dropped"], 2);
        let mut alone = FeatureReport::default();
        alone.add(0, &[simplified("", None, "repeated points dropped")]);
        assert_eq!(alone.to_string(), "1 chain simplified");
        let mut text = Vec::new();
        report.write_json(&mut text).unwrap();
        let read: serde_json::Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(read["remarks"][0]["why"], "it has no area");
        assert_eq!((&read["simplified"], read["remarks"].as_array().map(Vec::len)), (&json!(2), Some(4)));
    }
}
