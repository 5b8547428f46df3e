//! Renders a scene.

use super::pose::picture_camera;
use super::reflection::Tracer;
use super::{Extent, camera, detail, develop, floor, shade, sky, stage, sun, texture};
use crate::ModelSight;
use crate::settings::{Picture, Quality};
use burgeon_base::error::Result;
use burgeon_base::stop::Stop;
use burgeon_scene::Scene;
use burgeon_scene::image::Image;
use glam::Vec3A;

/// Renders `scene` as sRGB with straight alpha; opaque unless the background is clear.
///
/// Triangles with a corner that is not finite are skipped. Fails if the size is zero or exceeds 16384, if a texture
/// cannot be read, or if the scene refers to a mesh, material or corner that does not exist.
///
/// ```
/// use burgeon_picture::{Background, Picture, Quality, render};
/// use burgeon_scene::{Instance, Mesh, Scene};
/// use glam::{DAffine3, Vec3};
///
/// # let (transform, name, feature) = (DAffine3::IDENTITY, String::new(), None);
/// # let instance = Instance { mesh: 0, transform, name, feature, origin: None, placement: None, meaning: None };
/// let mut scene = Scene { instances: vec![instance], ..Scene::default() };
/// let mut tile = Mesh::default();
/// let part = tile.part(scene.material(&Default::default()));
/// part.positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
/// # (part.normals, part.uvs) = (vec![burgeon_scene::Normal::Z; 3], vec![glam::Vec2::ZERO; 3]);
/// part.triangles.push([0, 1, 2]);
/// scene.meshes.push(tile);
/// let size = Picture { width: 16, height: 12, quality: Quality::Draft, ..Picture::default() };
/// let image = render(&scene, &Picture { background: Background::Clear, ground: false, ..size })?;
/// assert_eq!((image.width(), image.pixel(0, 0)[3]), (16, 0));
/// assert!(image.pixels().iter().any(|[_, _, _, opacity]| *opacity == 255));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn render(scene: &Scene, picture: &Picture) -> Result<Image> {
    render_within(scene, None, picture, &Stop::default())
}

/// Renders `scene` with a camera that sees all of `extent`. Without an extent the camera is fitted to the scene.
///
/// Renders of several scenes with the same extent and the same `picture` share a camera, so that sizes can be compared.
/// If `picture` specifies no direction, the shape of the extent determines it. With [`Quality::Film`] they share the ground
/// and the grids of the shadows too. Fails as [`render`] does, and if `stop`
/// requests cancellation.
///
/// ```
/// use burgeon_base::{Error, Stop};
/// use burgeon_picture::{Extent, Picture, Quality, render_within};
/// use burgeon_scene::Scene;
///
/// let picture = Picture { width: 8, height: 6, quality: Quality::Draft, ..Picture::default() };
/// let (scene, stop) = (Scene::default(), Stop::new());
/// assert_eq!(render_within(&scene, Some(&Extent::default()), &picture, &stop)?.pixels().len(), 48);
/// stop.stop(Error::cancellation("the window was closed"));
/// let error = render_within(&scene, None, &picture, &stop).expect_err("cancelled");
/// assert_eq!(error.message(), "the window was closed");
/// # Ok::<(), Error>(())
/// ```
pub fn render_within(
    scene: &Scene,
    extent: Option<&Extent>,
    picture: &Picture,
    stop: &Stop,
) -> Result<Image> {
    develop_within(scene, extent, picture, stop).map(|(image, _)| image)
}

/// Renders `scene` as [`render`] does, and determines if the image shows the model. Fails if `stop` requests cancellation too.
///
/// ```
/// use burgeon_base::Stop;
/// use burgeon_picture::{ModelSight, Picture, render_with_sight};
/// use burgeon_scene::Scene;
///
/// let picture = Picture { width: 8, height: 6, ..Picture::default() };
/// let (image, sight) = render_with_sight(&Scene::default(), &picture, &Stop::new())?;
/// assert_eq!((image.width(), sight), (8, ModelSight::Seen));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
pub fn render_with_sight(scene: &Scene, picture: &Picture, stop: &Stop) -> Result<(Image, ModelSight)> {
    develop_within(scene, None, picture, stop)
}

fn develop_within(
    scene: &Scene,
    extent: Option<&Extent>,
    picture: &Picture,
    stop: &Stop,
) -> Result<(Image, ModelSight)> {
    picture.check()?;
    let images = texture::load(&scene.materials)?;
    let is_film = picture.quality == Quality::Film;
    let mut stage = stage::Stage::within(scene, &images, extent, is_film, stop)?;
    let detail = detail::RenderDetail::of(picture.quality, stage.triangles());
    let camera = picture_camera(scene, &stage, extent, picture, is_film)?;
    if detail.thin_diameter > 0.0 {
        stage.reduce_tubes(&camera, detail.thin_diameter);
    }
    let sun = sun::Sun::new(&stage, camera.viewpoint(), picture.sun, &detail);
    let mut sky = sky::Sky::new(&stage, &sun, &detail, picture.ground);
    sky.surround(picture.background);
    // Slightly below the model, so that surfaces on the ground do not merge with it.
    let height = stage.bounds.0.z - 0.0005;
    let floor = picture.ground.then(|| floor::Floor::new(&stage, &sun, &sky, height));
    let tracer = (detail.traces && shade::has_mirrors(&stage)).then(|| Tracer::new(&stage)).flatten();
    let light = shade::Light {
        stage: &stage,
        images: &images,
        camera: &camera,
        sun: &sun,
        sky: &sky,
        floor: floor.as_ref(),
        tracer: tracer.as_ref(),
    };
    let (image, is_seen) = develop::develop(&light, picture, &detail);
    // A cancelled render is incomplete.
    stop.check()?;
    let sight = if is_seen || stage.triangles() == 0 {
        ModelSight::Seen
    } else {
        reason_unseen(&stage, &camera, [picture.width, picture.height])
    };
    Ok((image, sight))
}

/// Returns the reason why an image of `size` (pixels) shows nothing of the model.
fn reason_unseen(stage: &stage::Stage, camera: &camera::Camera, size: [u32; 2]) -> ModelSight {
    let [width, height] = size.map(|side| side as f32);
    let pixels = stage.hull.iter().map(|point| camera.project(camera.view.transform_point3a(*point)));
    let inside = pixels
        .filter(|pixel| (0.0..=width).contains(&pixel.x) && (0.0..=height).contains(&pixel.y))
        .fold(None, |bounds: Option<(Vec3A, Vec3A)>, pixel| {
            Some(bounds.map_or((pixel, pixel), |(low, high)| (low.min(pixel), high.max(pixel))))
        });
    match inside {
        None => ModelSight::Outside,
        Some((low, high)) if (high - low).truncate().max_element() < 1.0 => ModelSight::Speck,
        Some(_) => ModelSight::Hidden,
    }
}
