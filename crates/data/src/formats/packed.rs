//! Upper bounds for the size of decompressed data.

use burgeon_base::error::Error;

/// Constant added to the bound (bytes), because small contents may exceed the ratio.
const SLACK: usize = 1 << 16;

/// Returns true if `packed` bytes can decompress to `bytes`, at a maximum ratio of `most`. Memory is not allocated for
/// impossible sizes.
pub(super) fn can_hold(packed: usize, most: usize, bytes: usize) -> bool {
    bytes <= packed.saturating_mul(most).saturating_add(SLACK)
}

/// Maximum compression ratio of Deflate: two bits represent up to 258 bytes, and blocks have headers.
pub(super) const DEFLATED: usize = 1040;

/// Returns the error for a file that declares more heights than it can contain.
pub(super) fn cannot_hold(name: &str, bytes: usize, columns: usize, rows: usize) -> Error {
    Error::data(format!("{name} is cut short: its {bytes} bytes cannot hold {columns} x {rows} heights"))
        .help("download it again")
}
