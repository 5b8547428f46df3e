//! The renderer, in order: the scene is checked and moved to the origin (`stage`), a viewpoint is chosen (`view`) and the
//! camera fitted (`camera`); depth maps are drawn from the sun (`sun`) and from many directions of the sky
//! (`sky`), and from them how the ground is lit (`floor`); the camera's samples learn which triangle they see
//! (`visible`), as far as it is neither translucent nor cut out there (`coverage`); each pixel's triangles become points on a surface (`surface`), are lit (`shade`) and mixed
//! into a colour (`develop`).

mod camera;
mod clip;
mod coverage;
mod detail;
mod develop;
mod extent;
mod floor;
mod light_map;
mod points;
mod raster;
mod render;
#[cfg(test)]
mod samples;
mod shade;
mod sky;
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
pub use render::{render, render_within};
