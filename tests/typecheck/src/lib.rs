//! Checks scripts with Luau's type checker.
//!
//! Only the test of this package does anything. It is a separate package, because the checker includes its
//! own Luau, which cannot be linked together with the Luau that runs scripts. It therefore tests only crates
//! without a virtual machine.
