//! Damages bytes: flips, cuts, repeats and joins pieces, and writes numbers and words that readers stumble over.

use burgeon::random::Stream;

/// Numbers at the edges of their types.
const NUMBERS: [u64; 14] = [
    0,
    1,
    0x7f,
    0x80,
    0xff,
    0x7fff,
    0x8000,
    0xffff,
    0x7fff_ffff,
    0x8000_0000,
    0xffff_ffff,
    0x7ff0_0000_0000_0000,
    0x7ff8_0000_0000_0000,
    u64::MAX,
];

/// The most bytes of an input.
const MOST: usize = 1 << 16;

/// One of `inputs`, damaged; the same `dice` damage it the same way.
pub(crate) fn damaged(inputs: &[Vec<u8>], words: &[&str], dice: &mut Stream) -> Vec<u8> {
    let mut bytes = inputs[dice.below(inputs.len())].clone();
    for _ in 0..=dice.below(6) {
        let at = dice.below(bytes.len() + 1);
        let length = dice.below(64);
        let end = (at + length).min(bytes.len());
        match dice.below(9) {
            0 if at < bytes.len() => bytes[at] ^= 1 << dice.below(8),
            1 if at < bytes.len() => bytes[at] = dice.below(256).to_le_bytes()[0],
            2 => drop(bytes.drain(at..end)),
            3 => {
                let piece = bytes[at..end].repeat(1 + dice.below(40));
                drop(bytes.splice(at..at, piece));
            }
            4 => {
                let other = &inputs[dice.below(inputs.len())];
                let from = dice.below(other.len() + 1);
                let to = (from + dice.below(200)).min(other.len());
                drop(bytes.splice(at..end, other[from..to].iter().copied()));
            }
            5 | 6 if !words.is_empty() => {
                let word = words[dice.below(words.len())].repeat(1 + dice.below(3) * dice.below(80));
                drop(bytes.splice(at..if dice.below(2) == 0 { at } else { end }, word.into_bytes()));
            }
            7 => {
                let number = NUMBERS[dice.below(NUMBERS.len())];
                let size = [1, 2, 4, 8][dice.below(4)];
                let mut number = number.to_le_bytes()[..size].to_vec();
                if dice.below(2) == 0 {
                    number.reverse();
                }
                let end = (at + size).min(bytes.len());
                drop(bytes.splice(at..end, number));
            }
            _ => {
                let text = NUMBERS[dice.below(NUMBERS.len())].to_string();
                drop(bytes.splice(at..end.min(at + 2), text.into_bytes()));
            }
        }
        bytes.truncate(MOST);
    }
    bytes
}
