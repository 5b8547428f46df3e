//! Tests of sweeps: volumes against formulas, closedness over random input, normals, textures and errors.

mod forms;
mod properties;

use forms::{least_cosine, near, solid, swept, texture_area, tower};
