//! Holds scripts against Luau's type checker.
//!
//! Only its test does anything. It is a package of its own since the checker brings a Luau of its own, which cannot be
//! linked beside the one that runs scripts; so what it tests is the members that know of no virtual machine.
