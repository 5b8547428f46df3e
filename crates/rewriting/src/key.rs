//! Keys of random numbers, which depend only on the seed and the lineage of a module.

use burgeon_base::random::Stream;

/// Hash of the seed and a module's lineage.
///
/// A child's key depends on its parent's key and its index among the successors. A module therefore keeps its random
/// numbers when other parts of the chain change.
///
/// ```
/// use burgeon_rewriting::ModuleKey;
///
/// let house = ModuleKey::seed(1).feature("house 12");
/// // The random numbers of a house do not depend on the other houses.
/// assert_eq!(house, ModuleKey::seed(1).feature("house 12"));
/// assert_ne!(house, ModuleKey::seed(2).feature("house 12"));
/// assert_ne!(house.child(0).stream().uniform(), house.child(1).stream().uniform());
/// ```
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Hash)]
pub struct ModuleKey(pub u64);

impl ModuleKey {
    /// Returns the key of a whole system.
    pub fn seed(seed: u64) -> Self {
        Self(mix(seed))
    }

    /// Returns the key of the chain for the feature with this id.
    #[must_use]
    pub fn feature(self, id: &str) -> Self {
        id.bytes().fold(Self(mix(self.0 ^ 0xFEA7)), |key, byte| Self(mix(key.0 ^ u64::from(byte))))
    }

    /// Returns the key of the successor's module number `ordinal`, from 0.
    #[must_use]
    #[inline]
    pub fn child(self, ordinal: usize) -> Self {
        Self(mix(self.0.wrapping_add((ordinal as u64 + 1).wrapping_mul(GOLDEN))))
    }

    /// Returns the key of a module after a rule was applied and kept it.
    #[must_use]
    pub fn advance(self) -> Self {
        Self(mix(self.0 ^ 0x5A17))
    }

    /// Returns the random numbers of this key, from the first.
    #[inline]
    pub fn stream(self) -> Stream {
        Stream::new(self.0)
    }

    /// Returns the key of the random numbers for another computation at the module that is not a rule, with the number
    /// `place`.
    #[must_use]
    pub fn at_place(self, place: usize) -> Self {
        Self(mix(self.0 ^ 0xBE51)).child(place)
    }

    /// Returns the key of the random numbers of an interpretation rule.
    #[must_use]
    pub fn interpretation(self) -> Self {
        Self(mix(self.0 ^ 0x1D7E))
    }
}

const GOLDEN: u64 = 0x9E37_79B9_7F4A_7C15;

/// Mixes bits with the finaliser of `SplitMix64` (Steele, Lea and Flood, "Fast splittable pseudorandom number
/// generators", 2014).
#[inline]
fn mix(state: u64) -> u64 {
    let mut z = state.wrapping_add(GOLDEN);
    z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    z ^ (z >> 31)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_depends_on_the_seed_the_ordinal_and_the_feature() {
        let root = ModuleKey::seed(1);
        let keys = [
            root,
            ModuleKey::seed(2),
            root.child(0),
            root.child(1),
            root.advance(),
            root.interpretation(),
            root.at_place(0),
            root.at_place(1),
            root.feature("a"),
            root.feature("b"),
        ];
        let mut first: Vec<u64> = keys.iter().map(|key| key.stream().uniform().to_bits()).collect();
        first.sort_unstable();
        first.dedup();
        assert_eq!(first.len(), keys.len());
    }
}
