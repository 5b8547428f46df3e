//! How much packed bytes can become.

use burgeon_base::error::Error;

/// Bytes that any packed content may have more than its kind of packing makes of a few.
const SLACK: usize = 1 << 16;

/// Whether `packed` bytes can become `bytes`, where each becomes `most` at best: what cannot is no reason to make room.
pub(super) fn can_hold(packed: usize, most: usize, bytes: usize) -> bool {
    bytes <= packed.saturating_mul(most).saturating_add(SLACK)
}

/// The most bytes that one of a deflated stream becomes: two bits stand for 258 of them, and blocks begin anew.
pub(super) const DEFLATED: usize = 1040;

/// The error for a file that says it has more heights than it can hold.
pub(super) fn cannot_hold(name: &str, bytes: usize, columns: usize, rows: usize) -> Error {
    Error::data(format!("{name} is cut short: its {bytes} bytes cannot hold {columns} x {rows} heights"))
        .help("get it again")
}
