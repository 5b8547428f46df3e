//! Checks scripts with Luau's type checker.
//!
//! The crate contains only a test. It is a separate package, because the checker includes its own copy of Luau, which
//! cannot be linked together with the one that runs scripts. The test therefore covers the crates that do not depend on
//! a virtual machine.
