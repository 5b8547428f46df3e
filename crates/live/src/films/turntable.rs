//! Renders of one model from all sides.

use super::order::in_order;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_export::films::{FilmFrame, FilmNeeds};
use burgeon_picture::{Extent, Picture, Quality, render_within};
use burgeon_scene::Scene;
use glam::DVec3;
use std::sync::atomic::{AtomicU32, Ordering};

/// Azimuth of the first frame unless the picture has one (degrees).
const BEGIN: f64 = 150.0;

/// Turn of the camera around a model.
pub struct Turntable<'a> {
    scene: &'a Scene,
    picture: Picture,
    extent: Extent,
    frames: u32,
    /// Number of completed frames.
    done: &'a AtomicU32,
}

impl<'a> Turntable<'a> {
    /// Prepares `frames` renders of `scene` around its vertical axis, or around the centre that `picture` looks at.
    /// `done` counts the completed frames.
    ///
    /// Fails if the scene or the picture is invalid.
    pub fn new(scene: &'a Scene, picture: &Picture, frames: u32, done: &'a AtomicU32) -> Result<Self> {
        picture.check()?;
        let center = picture.look.map(|look| DVec3::from(look.at));
        let extent = Extent::of(scene)?.revolved(scene.upright, center, frames as usize);
        let picture = Picture { quality: Quality::Film, ..picture.clone() };
        Ok(Self { scene, picture, extent, frames, done })
    }

    /// Renders all frames on `threads` threads and passes each to `take`, in order. Fails if a frame fails, with its
    /// error, or if `stop` requests cancellation.
    pub fn make(
        &self,
        needs: FilmNeeds,
        threads: usize,
        stop: &Stop,
        mut take: impl FnMut(FilmFrame) -> Result<()>,
    ) -> Result<()> {
        let frame = |number: usize| {
            let turned = 360.0 * number as f64 / f64::from(self.frames);
            let azimuth = (self.picture.azimuth.unwrap_or(BEGIN) + turned).rem_euclid(360.0);
            let picture = Picture { azimuth: Some(azimuth), ..self.picture.clone() };
            let image = render_within(self.scene, Some(&self.extent), &picture, stop)?;
            self.done.fetch_add(1, Ordering::Relaxed);
            FilmFrame::of_image(needs, image)
        };
        in_order(self.frames as usize, threads, stop, frame, |_, frame| take(frame))
    }
}
