//! Numbers that the prelude and Rust share, which the build script writes into the prelude.

/// Value of each name in the prelude.
pub(crate) const WORDS: [(&str, u32); 12] = [
    ("@KEEP", 0x8000_0000),
    ("@SHAPE", 0x4000_0000),
    ("@NO_RULE", 0xFFFF),
    ("@SKIPPED", 0xFFFF_FFFF),
    ("@OPEN_SYMBOL", 0),
    ("@CLOSE_SYMBOL", 1),
    ("@END_SYMBOL", 2),
    ("@ORDERED", 0x2000_0000),
    ("@OPEN_ITEM", 0xFFFF_FFFE),
    ("@CLOSE_ITEM", 0xFFFF_FFFF),
    ("@OPEN_CALL", 0xFFFE),
    ("@CLOSE_CALL", 0xFFFD),
];
