//! Keys of random numbers, which depend only on the seed and the lineage of a module.

use crate::random::Stream;

/// Hash of the seed and a module's lineage.
///
/// The key of a module depends on the key of the module that was rewritten, on its own name, and on its ordinal among the
/// modules with this name in the successor. A module therefore keeps its random numbers when other parts of the chain
/// change, and when modules with other names are added to the successor.
///
/// ```
/// use burgeon_base::ModuleKey;
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
        Self(id.bytes().fold(mix(self.0 ^ 0xFEA7), |key, byte| mix(key ^ u64::from(byte))))
    }

    /// Returns the hash of the name of a module, which may belong to a package.
    pub fn name_hash(package: Option<&str>, name: &str) -> u64 {
        let bytes = package.unwrap_or_default().bytes().chain([0]).chain(name.bytes());
        bytes.fold(mix(0x4E4D), |hash, byte| mix(hash ^ u64::from(byte)))
    }

    /// Returns the key of a successor's module: number `ordinal`, from 0, among the modules with the same name. `name` is
    /// the [hash](Self::name_hash) of the name.
    #[must_use]
    #[inline]
    pub fn successor(self, name: u64, ordinal: usize) -> Self {
        Self(self.0.wrapping_add(name)).child(ordinal)
    }

    /// Returns the key of part number `ordinal`, from 0, of a module or an object.
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

    /// Returns the key of the substream with the name `part`. Substreams with different names are independent, and can
    /// have substreams of their own.
    #[must_use]
    pub fn substream(self, part: KeyPart<'_>) -> Self {
        let with = |key: u64, bits: u64| mix(mix(key).wrapping_add(bits));
        Self(match part {
            KeyPart::Number(number) => with(self.0 ^ 0x57EA, (number + 0.0).to_bits()),
            KeyPart::Boolean(value) => with(self.0 ^ 0x57EB, u64::from(value)),
            KeyPart::Text(text) => {
                text.chunks(8).fold(with(self.0 ^ 0x57EC, text.len() as u64), |key, chunk| {
                    with(key, chunk.iter().rev().fold(0, |bits, byte| bits << 8 | u64::from(*byte)))
                })
            }
        })
    }

    /// Returns the key of the random numbers of an interpretation rule.
    #[must_use]
    pub fn interpretation(self) -> Self {
        Self(mix(self.0 ^ 0x1D7E))
    }
}

/// Part of the key of a named stream.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum KeyPart<'a> {
    /// A number; 0 and -0 are the same part.
    Number(f64),
    /// A text.
    Text(&'a [u8]),
    /// A truth value.
    Boolean(bool),
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

    fn text(text: &str) -> KeyPart<'_> {
        KeyPart::Text(text.as_bytes())
    }

    #[test]
    fn a_stream_depends_on_the_seed_the_ordinal_the_feature_and_the_name() {
        let root = ModuleKey::seed(1);
        let keys = [
            root,
            ModuleKey::seed(2),
            root.child(0),
            root.child(1),
            root.successor(7, 0),
            root.successor(7, 1),
            root.successor(8, 0),
            root.advance(),
            root.interpretation(),
            root.at_place(0),
            root.at_place(1),
            root.feature("a"),
            root.feature("b"),
            root.substream(text("a")),
            root.substream(text("b")),
            root.substream(text("ab")),
            root.substream(text("a")).substream(text("b")),
            root.substream(text("b")).substream(text("a")),
            root.substream(text("a")).substream(text("1")),
            root.substream(text("a")).substream(text("")),
            root.substream(text("a")).substream(KeyPart::Number(1.0)),
            root.substream(text("a")).substream(KeyPart::Number(2.0)),
            root.substream(text("a")).substream(KeyPart::Boolean(true)),
            root.substream(text("a windowsill")),
            root.substream(text("a windowsill\0")),
            root.child(0).substream(text("a")),
            root.substream(text("a")).child(0),
        ];
        let mut first: Vec<u64> = keys.iter().map(|key| key.stream().uniform().to_bits()).collect();
        first.sort_unstable();
        first.dedup();
        assert_eq!(first.len(), keys.len());
    }

    #[test]
    fn the_first_numbers_of_streams_with_neighbouring_keys_are_independent() {
        let first = |x: f64, y: f64| {
            let place = ModuleKey::seed(3).substream(text("place"));
            place.substream(KeyPart::Number(x)).substream(KeyPart::Number(y)).stream().uniform()
        };
        let mut cells = [0_u32; 100];
        for x in 0..200 {
            for y in 0..200 {
                let (x, y) = (f64::from(x), f64::from(y));
                let cell = (first(x, y) * 10.0) as usize * 10 + (first(x + 1.0, y) * 10.0) as usize;
                cells[cell] += 1;
            }
        }
        let chi: f64 = cells.iter().map(|count| (f64::from(*count) - 400.0).powi(2) / 400.0).sum();
        assert!(chi < 148.2, "chi-square {chi} with 99 degrees of freedom");
        assert_eq!(first(0.0, 0.0).to_bits(), first(-0.0, 0.0).to_bits());
    }
}
