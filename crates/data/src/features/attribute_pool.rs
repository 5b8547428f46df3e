//! Pool of attribute lists: equal lists, such as those of most buildings in a register, are stored once.

use std::hash::{Hash, Hasher};
use std::sync::Arc;

use rustc_hash::FxHasher;

use burgeon_kit::Attribute;

/// Attributes of a feature: the indices of their names, and their values.
pub(crate) type FeatureAttributes = Arc<[(usize, Attribute)]>;

/// Number of slots in the pool.
const PLACES: usize = 4096;

/// Pool of recent attribute lists, by hash.
#[derive(Debug)]
pub(crate) struct AttributePool(Vec<Option<FeatureAttributes>>);

impl AttributePool {
    /// Creates an empty pool.
    pub(crate) fn new() -> Self {
        Self(Vec::new())
    }

    /// Returns the stored list equal to `attributes`, or stores `attributes`. The flag is true if they were new.
    pub(crate) fn intern(&mut self, attributes: Vec<(usize, Attribute)>) -> (FeatureAttributes, bool) {
        let Some(place) = place(&attributes) else { return (attributes.into(), true) };
        if self.0.is_empty() {
            self.0.resize(PLACES, None);
        }
        let (stored, is_new) = match &mut self.0[place] {
            Some(known) if same(known, &attributes) => (known, false),
            known => (known.insert(attributes.into()), true),
        };
        (Arc::clone(stored), is_new)
    }
}

/// Returns the slot for attributes; `None` if they contain GeoJSON lists or objects, which are not pooled.
#[allow(clippy::cast_possible_truncation, reason = "any bits of a hash will do")]
fn place(attributes: &[(usize, Attribute)]) -> Option<usize> {
    let mut hasher = FxHasher::default();
    for (name, value) in attributes {
        name.hash(&mut hasher);
        match value {
            Attribute::Boolean(value) => value.hash(&mut hasher),
            // Few numbers differ in their lower bits, which the hasher uses most.
            Attribute::Number(value) => {
                (value.to_bits() ^ value.to_bits().rotate_right(32)).hash(&mut hasher)
            }
            Attribute::Text(value) => value.hash(&mut hasher),
            Attribute::Nested(_) => return None,
        }
    }
    Some(hasher.finish() as usize % PLACES)
}

/// Returns true if two lists are equal bit by bit; 0 and -0 differ.
fn same(known: &[(usize, Attribute)], others: &[(usize, Attribute)]) -> bool {
    known.len() == others.len()
        && known.iter().zip(others).all(|((name, value), (other_name, other))| {
            name == other_name
                && match (value, other) {
                    (Attribute::Number(value), Attribute::Number(other)) => {
                        value.to_bits() == other.to_bits()
                    }
                    _ => value == other,
                }
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_repeats_is_there_once() {
        let kinds: Vec<Arc<str>> = ["house", "shed", "church", "school"].map(Arc::from).to_vec();
        let mut pool = AttributePool::new();
        let mut own = 0;
        for number in 0..100_000_u32 {
            let kind = Attribute::Text(Arc::clone(&kinds[number as usize % 4]));
            let height = Attribute::Number(f64::from(number % 30));
            own += usize::from(pool.intern(vec![(0, kind), (1, height), (2, Attribute::Number(3.0))]).1);
        }
        // There are 60 lists, and some may alternate in one slot.
        assert!((60..6000).contains(&own), "{own}");
    }
}
