//! Renders a scene.

use super::{Extent, camera, detail, develop, floor, shade, sky, stage, sun, texture, view};
use crate::settings::Picture;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::Scene;
use burgeon_scene::image::Image;
use glam::DVec3;

/// Renders `scene` as sRGB with straight alpha; opaque unless the background is clear.
///
/// Triangles with a corner that is not finite are skipped. Fails if the size is zero or exceeds 16384, if a texture
/// cannot be read, or if the scene refers to a mesh, material or corner that does not exist.
pub fn render(scene: &Scene, picture: &Picture) -> Result<Image> {
    render_within(scene, None, picture, &Stop::default())
}

/// Renders `scene` with a camera that sees all of `extent`. Without an extent the camera is fitted to the scene.
///
/// Renders of several scenes with the same extent and the same `picture` share a camera, so that sizes can be compared.
/// If `picture` specifies no direction, the shape of the extent determines it. Fails as [`render`] does, and if `stop`
/// requests cancellation.
pub fn render_within(
    scene: &Scene,
    extent: Option<&Extent>,
    picture: &Picture,
    stop: &Stop,
) -> Result<Image> {
    picture.check()?;
    let textures = texture::load(&scene.materials)?;
    let stage = stage::Stage::within(scene, &textures, extent, stop)?;
    let detail = detail::RenderDetail::of(picture.quality, stage.triangles());
    let size = [picture.width, picture.height];
    let (eye, camera) = match (extent, picture.look) {
        (None, None) => {
            let eye = view::viewpoint(&stage.hull, picture);
            (eye, camera::Camera::fit(stage.points(), eye, size))
        }
        (None, Some(look)) => {
            let eye = view::viewpoint(&stage.hull, picture);
            let axes = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
            let points = axes.map(|axis| DVec3::from(look.at) + axis * look.radius);
            let points = points.map(|point| stage.shrink.transform_point3(point).as_vec3a());
            (eye, camera::Camera::fit(points, eye, size).with_nearer_plane())
        }
        (Some(extent), _) => {
            let points = extent.points(&stage.shrink);
            let eye = view::viewpoint(&points, picture);
            (eye, camera::Camera::fit(points.into_iter(), eye, size))
        }
    };
    let sun = sun::Sun::new(&stage, eye, &detail);
    let sky = sky::Sky::new(&stage, &sun, &detail, picture.ground);
    // Slightly below the model, so that surfaces on the ground do not merge with it.
    let height = stage.bounds.0.z - 0.0005;
    let floor = picture.ground.then(|| floor::Floor::new(&stage, &sun, &sky, height));
    let light = shade::Light {
        stage: &stage,
        textures: &textures,
        camera: &camera,
        sun: &sun,
        sky: &sky,
        floor: floor.as_ref(),
    };
    let image = develop::develop(&light, picture, &detail);
    // A cancelled render is incomplete.
    stop.check().map(|()| image)
}
