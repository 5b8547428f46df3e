//! Renders a scene to an image on the CPU, without a graphics card or a display.
//!
//! Input: a [`Scene`](burgeon_scene::Scene) and its view, a [`Picture`]. Output: an
//! [`Image`](burgeon_scene::image::Image). The crate never changes the scene and never writes a file. The same scene
//! results in the same bytes for any number of threads. Without the feature `pictures`, [`render`] fails.

#![allow(
    clippy::cast_possible_truncation,
    reason = "numbers of pixels, texels and triangles are checked against their limits once, at the start"
)]

mod settings;
mod sight;

#[cfg_attr(not(feature = "pictures"), path = "absent.rs")]
mod renderer;

pub use renderer::{CameraPose, Extent, is_inside, pose, render, render_with_sight, render_within};
pub use settings::{Background, CameraChoice, Picture, Quality, SunPosition, ViewBall};
pub use sight::ModelSight;
