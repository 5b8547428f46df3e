//! Stubs of the renderer, for builds without the feature `pictures`.

use super::settings::Picture;
use crate::ModelSight;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::image::{self, Image};
use burgeon_scene::{CameraView, Scene, Upright};
use glam::DVec3;

/// Extent of one or more scenes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extent(());

impl Extent {
    /// Fails, because rendering is not available.
    pub fn of(_scene: &Scene) -> Result<Self> {
        image::check().map(|()| Self(()))
    }

    /// Extends the extent by `other`.
    pub fn join(&mut self, _other: &Self) {}

    /// Extends the extent by `other`.
    pub fn join_outline(&mut self, _other: &Self) {}

    /// Returns true, because nothing can be shown.
    pub fn contains(&self, _other: &Self) -> bool {
        true
    }

    /// Returns true, because nothing can be shown.
    pub fn is_empty(&self) -> bool {
        true
    }

    /// Returns an empty extent.
    #[must_use]
    pub fn revolved(&self, _upright: Option<Upright>, _center: Option<DVec3>, _count: usize) -> Self {
        Self(())
    }
}

/// Place of a camera in the world.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CameraPose {
    /// Position (m).
    pub eye: DVec3,
    /// Unit vector along the view.
    pub forward: DVec3,
    /// Unit vector that is up in the picture.
    pub up: DVec3,
    /// Vertical field of view (degrees) in perspective, height that the picture shows (m) in parallel projection.
    pub shown: f64,
    /// Set for a parallel projection.
    pub is_parallel: bool,
}

/// Fails, because rendering is not available.
pub fn pose(_scene: &Scene, view: &CameraView, _aspect: f64) -> Result<CameraPose> {
    view.check()?;
    Err(image::check().err().unwrap_or_else(|| burgeon_base::Error::internal("no renderer")))
}

/// Returns false, because nothing is measured.
pub fn is_inside(_scene: &Scene, _point: DVec3) -> Result<bool> {
    Ok(false)
}

/// Fails, because rendering is not available.
pub fn render_with_sight(_scene: &Scene, picture: &Picture, _stop: &Stop) -> Result<(Image, ModelSight)> {
    picture.check()?;
    image::check().map(|()| (Image::filled(0, 0, [0; 4]), ModelSight::Seen))
}

/// Fails, because rendering is not available.
pub fn render(scene: &Scene, picture: &Picture) -> Result<Image> {
    render_within(scene, None, picture, &Stop::default())
}

/// Fails, because rendering is not available.
pub fn render_within(
    _scene: &Scene,
    _extent: Option<&Extent>,
    picture: &Picture,
    _stop: &Stop,
) -> Result<Image> {
    picture.check()?;
    image::check().map(|()| Image::filled(0, 0, [0; 4]))
}
