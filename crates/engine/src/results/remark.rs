//! Skipped and simplified features, for the report of a run.

use std::collections::BTreeMap;
use std::fmt;

use serde_json::json;

use burgeon_base::error::Error;
use burgeon_base::text::grouped;
use burgeon_kit::Note;

/// Skipped or simplified feature, with the reason.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Remark {
    /// Source of the feature; empty for a list of the script and for a chain without a feature.
    pub source: String,
    /// Feature id, if the chain came from a feature.
    pub feature: Option<String>,
    /// Set if nothing was built for the feature.
    pub skipped: bool,
    /// Change that was made, as a text without details of the feature, so that equal changes can be counted.
    pub what: String,
    /// Reason for this feature; may be empty.
    pub why: String,
    /// Set if the feature could not be read; its source has already reported it.
    pub unread: bool,
}

impl Remark {
    /// Creates the remark for a feature that was skipped because of `error`.
    pub(crate) fn skipped(source: &str, feature: Option<&str>, error: &Error) -> Self {
        let (source, feature) = (source.to_owned(), feature.map(str::to_owned));
        Self {
            source,
            feature,
            skipped: true,
            what: "skipped".to_owned(),
            why: error.message().to_owned(),
            unread: false,
        }
    }

    /// Creates the remark for a note of an object.
    pub(crate) fn simplified(source: &str, feature: Option<&str>, note: &Note) -> Self {
        let (source, feature) = (source.to_owned(), feature.map(str::to_owned));
        Self {
            source,
            feature,
            skipped: false,
            what: note.what.clone(),
            why: note.why.clone(),
            unread: false,
        }
    }

    fn to_json(&self) -> serde_json::Value {
        json!({
            "source": self.source,
            "feature": self.feature,
            "done": if self.skipped { "skipped" } else { "simplified" },
            "what": self.what,
            "why": self.why,
        })
    }
}

/// Number of features of a run, and the skipped and simplified features.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct FeatureReport {
    /// Number of features of all systems that were shown or placed.
    pub features: usize,
    /// Number of skipped features.
    pub skipped: usize,
    /// Number of simplified chains.
    pub simplified: usize,
    /// Number of remarks per kind of change.
    pub counts: BTreeMap<String, usize>,
    /// All remarks: for each system first the features without a chain, then the chains in order.
    pub remarks: Vec<Remark>,
}

impl FeatureReport {
    /// Adds the remarks of a system with `features` features.
    pub(crate) fn add(&mut self, features: usize, remarks: &[Remark]) {
        self.features += features;
        for (index, remark) in remarks.iter().enumerate() {
            let same = |other: &Remark| other.source == remark.source && other.feature == remark.feature;
            if remark.skipped {
                self.skipped += 1;
            } else if index == 0 || !same(&remarks[index - 1]) || remarks[index - 1].skipped {
                self.simplified += 1;
            }
            *self.counts.entry(remark.what.clone()).or_default() += 1;
        }
        self.remarks.extend_from_slice(remarks);
    }

    /// Returns true if nothing was skipped or simplified.
    pub fn is_clean(&self) -> bool {
        self.remarks.is_empty()
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

    /// Writes the counts and all remarks as one JSON document, one line per remark.
    pub fn write_json(&self, out: &mut impl std::io::Write) -> std::io::Result<()> {
        let counts = self.counts_json().to_string();
        let counts = counts.strip_suffix('}').unwrap_or(&counts);
        writeln!(out, "{counts},\"remarks\":[")?;
        for (index, remark) in self.remarks.iter().enumerate() {
            let comma = if index + 1 < self.remarks.len() { "," } else { "" };
            writeln!(out, "{}{comma}", remark.to_json())?;
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
        let note = |what: &str| Note::new(what, "");
        let remarks = [
            Remark::skipped("a:b", Some("1"), &Error::geometry("it has no area")),
            Remark::simplified("a:b", Some("2"), &note("a flat roof instead of a hip roof")),
            Remark::simplified("a:b", Some("2"), &note("repeated points dropped")),
            Remark::simplified("a:b", Some("7"), &note("repeated points dropped")),
        ];
        let mut report = FeatureReport::default();
        report.add(15_608, &remarks);
        assert_eq!(report.to_string(), "1 of 15,608 features skipped, 2 simplified");
        assert_eq!(report.counts["repeated points dropped"], 2);
        let mut alone = FeatureReport::default();
        alone.add(0, &[Remark::simplified("", None, &note("repeated points dropped"))]);
        assert_eq!(alone.to_string(), "1 chain simplified");
        let mut text = Vec::new();
        report.write_json(&mut text).unwrap();
        let read: serde_json::Value = serde_json::from_slice(&text).unwrap();
        assert_eq!(read["remarks"][0]["why"], "it has no area");
        assert_eq!((&read["simplified"], read["remarks"].as_array().map(Vec::len)), (&json!(2), Some(4)));
    }
}
