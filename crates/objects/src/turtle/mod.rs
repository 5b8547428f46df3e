//! The turtle: walks, turns and draws branches, polygons, generalised cylinders, surfaces and instances.
//!
//! Input: the calls of scripts. Output: closed branches and cylinders, which the end of a pass can join, and open polygons
//! and surfaces. Shapes already drawn never change.

mod angles;
mod cylinder;
mod joined;
mod object;
mod options;
mod rewind;
#[cfg(test)]
mod scale_tests;
mod state;
mod steps;
#[cfg(test)]
mod tests;
mod tropism;

pub use object::Turtle;
