//! LZW decompression of strips and tiles.
//!
//! The decoder of the crate `tiff` fails at rows whose padding ends amid a code's bytes.

/// TIFF compression of LZW.
pub(super) const LZW: u32 = 5;

/// LZW codes that clear the table and end the data, first free code, and maximum number of codes.
const CLEAR: usize = 256;
const END: usize = 257;
const FIRST: usize = 258;
const MOST_CODES: usize = 4096;

/// Returns the first `length` bytes of LZW data; fewer if it ends before. Returns `None` if it is damaged.
///
/// Method: TIFF revision 6.0, section 13, with codes that grow one entry early.
pub(super) fn unpack_lzw(packed: &[u8], length: usize) -> Option<Vec<u8>> {
    let mut out: Vec<u8> = Vec::new();
    // Each entry of the table is the text of a code and the next byte, which stand in the output.
    let mut table: Vec<(usize, usize)> = Vec::with_capacity(MOST_CODES - FIRST);
    let mut previous: Option<(usize, usize)> = None;
    let (mut buffer, mut held, mut width) = (0_usize, 0_u32, 9_u32);
    let mut bytes = packed.iter();
    while out.len() < length {
        while held < width {
            let Some(byte) = bytes.next() else { return Some(out) };
            buffer = (buffer << 8 | usize::from(*byte)) & 0xFF_FFFF;
            held += 8;
        }
        held -= width;
        let code = buffer >> held & ((1 << width) - 1);
        if code == END {
            break;
        }
        if code == CLEAR {
            table.clear();
            (previous, width) = (None, 9);
            continue;
        }
        let start = out.len();
        if let Some((from, count)) = previous.filter(|_| table.len() < MOST_CODES - FIRST) {
            table.push((from, count + 1));
        }
        match code.checked_sub(FIRST) {
            #[allow(clippy::cast_possible_truncation, reason = "codes below 256 are bytes")]
            None => out.push(code as u8),
            Some(entry) => {
                let (from, count) = *table.get(entry)?;
                // The newest entry ends with the byte that it begins with, which is written here.
                let known = count.min(start - from);
                out.extend_from_within(from..from + known);
                if known < count {
                    out.push(out[from]);
                }
            }
        }
        previous = Some((start, out.len() - start));
        // The next code may already refer to the entry that it creates.
        while width < 12 && FIRST + table.len() + 2 > 1 << width {
            width += 1;
        }
    }
    out.truncate(length);
    Some(out)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lzw_of_the_standards_example_is_unpacked() {
        // Section 13 of TIFF 6.0: 7 7 7 8 8 7 7 6 6 becomes the codes clear 7 258 8 8 258 6 6 end.
        let codes = [256_u32, 7, 258, 8, 8, 258, 6, 6, 257];
        let mut bits: Vec<u8> =
            codes.iter().flat_map(|code| (0..9).rev().map(move |bit| (code >> bit & 1) as u8)).collect();
        bits.resize(bits.len().next_multiple_of(8), 0);
        let packed: Vec<u8> =
            bits.chunks(8).map(|byte| byte.iter().fold(0, |sum, bit| sum << 1 | bit)).collect();
        assert_eq!(unpack_lzw(&packed, 100), Some(vec![7, 7, 7, 8, 8, 7, 7, 6, 6]));
        assert_eq!(unpack_lzw(&packed, 3), Some(vec![7, 7, 7]));
        assert_eq!(unpack_lzw(&packed[..4], 100), Some(vec![7, 7, 7]));
        assert_eq!(unpack_lzw(&[0xFF; 4], 100), None);
    }
}
