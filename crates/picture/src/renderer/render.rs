//! Renders a scene.

use super::{Extent, camera, detail, develop, floor, shade, sky, stage, sun, texture, view};
use crate::settings::Picture;
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::Scene;
use burgeon_scene::image::Image;
use glam::DVec3;

/// The picture of `scene` as sRGB with straight opacity; opaque unless the background is clear.
///
/// Corners with a coordinate that is not finite hide their triangles. Fails if the size is zero or beyond
/// 16384, a texture cannot be read, or the scene names a mesh, material or corner that it does not have.
pub fn render(scene: &Scene, picture: &Picture) -> Result<Image> {
    render_within(scene, None, picture, &Stop::default())
}

/// The picture of `scene` by a camera that sees all of `extent`, as large as it stands there, unless `stop` asks for
/// an end; without an extent the camera is fitted to the scene.
///
/// Pictures of several scenes within one extent, with the same `picture`, have the same camera, so that what is
/// larger looks larger. Where `picture` names no direction, the shape of the extent decides. Fails as [`render`]
/// does, and with the reason of a stop.
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
            (eye, camera::Camera::fit(points, eye, size).inside())
        }
        (Some(extent), _) => {
            let points = extent.points(&stage.shrink);
            let eye = view::viewpoint(&points, picture);
            (eye, camera::Camera::fit(points.into_iter(), eye, size))
        }
    };
    let sun = sun::Sun::new(&stage, eye, &detail);
    let sky = sky::Sky::new(&stage, &sun, &detail, picture.ground);
    // A little below the model, so that what lies on the ground is not mixed with it.
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
    // What was stopped has left everything out that was still to be done.
    stop.check().map(|()| image)
}
