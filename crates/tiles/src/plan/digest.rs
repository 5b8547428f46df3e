//! Digests of features, whose sum does not depend on their order, and hashes of files.

use std::fs;
use std::path::Path;

use burgeon_data::{Attribute, Feature};

/// Sum of the hashes of features.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FeatureDigest(u128);

impl FeatureDigest {
    /// Adds the features of another digest.
    pub fn add(&mut self, other: Self) {
        self.0 = self.0.wrapping_add(other.0);
    }

    /// Digest of no features.
    pub(super) const ZERO: Self = Self(0);

    fn of(hasher: &blake3::Hasher) -> Self {
        let mut bytes = [0; 16];
        hasher.finalize_xof().fill(&mut bytes);
        Self(u128::from_le_bytes(bytes))
    }

    /// Returns a part of the digest that rarely is the same for different features.
    #[allow(clippy::cast_possible_truncation, reason = "a part of the digest is wanted")]
    pub(crate) fn short(self) -> u64 {
        self.0 as u64
    }

    /// Reads the digest from its hexadecimal digits; `None` if the text is no digest.
    pub(super) fn parse(text: &str) -> Option<Self> {
        u128::from_str_radix(text, 16).ok().map(Self)
    }

    /// Returns the digest as 32 hexadecimal digits.
    pub fn text(self) -> String {
        format!("{:032x}", self.0)
    }
}

/// Adds a text with its length, so that different sequences of texts have different hashes.
fn add_text(hasher: &mut blake3::Hasher, text: &str) {
    hasher.update(&(text.len() as u64).to_le_bytes()).update(text.as_bytes());
}

/// Returns the digest of the id of a feature of `layer`.
pub fn id_digest(layer: &str, id: &str) -> FeatureDigest {
    let mut hasher = blake3::Hasher::new();
    add_text(&mut hasher, layer);
    add_text(&mut hasher, id);
    FeatureDigest::of(&hasher)
}

/// Returns the digest of a feature of `layer`, whose attributes are called `names`: its id, its geometry in the frame and its
/// attributes.
pub fn feature_digest(layer: &str, names: &[String], feature: &Feature) -> FeatureDigest {
    let mut hasher = blake3::Hasher::new();
    add_text(&mut hasher, layer);
    add_text(&mut hasher, feature.id.as_str());
    hasher.update(&[feature.geometry.kind() as u8]);
    for list in feature.geometry.lists() {
        hasher.update(&(list.len() as u64).to_le_bytes());
        for point in list {
            // Both zeros are the same position.
            point.to_array().iter().for_each(|value| {
                hasher.update(&(value + 0.0).to_bits().to_le_bytes());
            });
        }
    }
    for (number, value) in &*feature.attributes {
        add_text(&mut hasher, names.get(*number).map_or("", String::as_str));
        hasher.update(value.kind().as_bytes());
        match value {
            Attribute::Number(value) => {
                hasher.update(&value.to_bits().to_le_bytes());
            }
            value => add_text(&mut hasher, &value.text()),
        }
    }
    FeatureDigest::of(&hasher)
}

/// Returns the hash of the content of a file.
pub fn hash_file(path: &Path) -> std::io::Result<String> {
    let mut hasher = blake3::Hasher::new();
    hasher.update_reader(fs::File::open(path)?)?;
    Ok(hash_text(hasher.finalize()))
}

/// Returns the first half of a hash as hexadecimal digits.
pub(crate) fn hash_text(hash: blake3::Hash) -> String {
    hash.to_hex()[..32].to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_has_no_order_and_a_repeated_feature_counts() {
        let sum = |ids: &[&str]| {
            let mut all = FeatureDigest::default();
            ids.iter().for_each(|id| all.add(id_digest("a", id)));
            all.text()
        };
        assert_eq!(sum(&["1", "2", "3"]), sum(&["3", "1", "2"]));
        assert_ne!(sum(&["1", "2"]), sum(&["1", "2", "2"]));
        assert_ne!(sum(&["12", "3"]), sum(&["1", "23"]));
        assert_ne!(id_digest("a", "1"), id_digest("b", "1"));
    }
}
