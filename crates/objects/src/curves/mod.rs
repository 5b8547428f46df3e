//! Curves and surfaces as values of scripts: functions of one variable, curves in space and patches.
//!
//! Input: points of scripts. Output: immutable objects with read methods. Nothing here draws by itself.

pub(crate) mod choice;
pub(crate) mod curve;
pub(crate) mod ramp;
pub(crate) mod surface;
