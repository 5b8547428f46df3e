//! Stubs of the renderer, for builds without the feature `pictures`.

use super::settings::Picture;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::Scene;
use burgeon_scene::image::{self, Image};

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
