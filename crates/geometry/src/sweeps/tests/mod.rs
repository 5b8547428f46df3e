//! Tests of sweeps: volumes against formulas, closedness over random input, normals, textures and errors.

mod cylinder;
mod forms;
mod properties;
