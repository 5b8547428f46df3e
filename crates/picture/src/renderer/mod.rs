//! Renderer, in the order of its steps: check the scene and move it to the origin (`stage`); choose a viewpoint
//! (`view`) and fit the camera (`camera`); draw depth maps from the sun (`sun`) and from many directions of the sky
//! (`sky`, for large scenes of films from `sky_points`), and compute the light on the ground from them (`floor`); find the triangle that each sample of the camera
//! sees (`visible`), skipping the samples that translucent and cut-out surfaces do not cover (`coverage`); convert each
//! pixel's triangles to points on surfaces (`surface`), shade them (`shade`), trace what smooth ones mirror (`reflection`), and mix their colours (`develop`).

mod camera;
#[cfg(test)]
mod camera_tests;
mod clip;
mod coverage;
mod detail;
mod develop;
mod extent;
mod floor;
mod light_map;
mod measure;
#[cfg(test)]
mod mirror_tests;
mod points;
mod pose;
mod raster;
mod reflection;
mod render;
#[cfg(test)]
mod samples;
mod shade;
mod share;
mod sky;
mod sky_points;
mod stage;
mod sun;
mod surface;
#[cfg(test)]
mod tests;
mod texture;
mod tone;
mod view;
mod visible;

pub use extent::Extent;
pub use pose::{CameraPose, is_inside, pose};
pub use render::{render, render_with_sight, render_within};
