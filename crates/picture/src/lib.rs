//! Pictures of a scene, made without a graphics card or a display.
//!
//! Comes in: a [`Scene`](burgeon_scene::Scene) and how it is to be seen, a [`Picture`]. Goes out: an
//! [`Image`](burgeon_scene::image::Image). It never changes the scene and writes no file. The same scene gives the same
//! bytes for any number of threads. Without the feature `pictures` nothing is rendered, and [`render`] says so.

#![allow(
    clippy::cast_possible_truncation,
    reason = "numbers of pixels, texels and triangles are checked against their limits once, at the start"
)]

mod settings;

#[cfg_attr(not(feature = "pictures"), path = "absent.rs")]
mod renderer;

pub use renderer::{Extent, render, render_within};
pub use settings::{Background, Picture, Quality, ViewBall};
