//! What stands in the place of the renderer where a program is built without pictures.

use super::settings::Picture;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::Scene;
use burgeon_scene::image::{self, Image};

/// The room that one or more scenes take.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extent(());

impl Extent {
    /// Fails: pictures are not there.
    pub fn of(_scene: &Scene) -> Result<Self> {
        image::check().map(|()| Self(()))
    }

    /// Makes room for `other`, too.
    pub fn join(&mut self, _other: &Self) {}
}

/// Fails: pictures are not there.
pub fn render(scene: &Scene, picture: &Picture) -> Result<Image> {
    render_within(scene, None, picture, &Stop::default())
}

/// Fails: pictures are not there.
pub fn render_within(
    _scene: &Scene,
    _extent: Option<&Extent>,
    picture: &Picture,
    _stop: &Stop,
) -> Result<Image> {
    picture.check()?;
    image::check().map(|()| Image::filled(0, 0, [0; 4]))
}
