//! Choice of the camera of a render, and the places of a scene's cameras for other programs.

use super::camera::Camera;
use super::stage::Stage;
use super::{extent::Extent, view};
use crate::settings::{CameraChoice, Picture, ViewBall};
use burgeon_base::error::{Error, Result};
use burgeon_scene::{CameraView, FittedView, Scene};
use glam::{DVec3, Vec3A};

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

/// Returns the place of a camera of `scene` for a picture with this ratio of width to height. Fails if the camera has no
/// direction, and as [`render`](super::render) does.
pub fn pose(scene: &Scene, view: &CameraView, aspect: f64) -> Result<CameraPose> {
    view.check()?;
    let stage = Stage::new(scene)?;
    let height = 1000_u32;
    #[allow(clippy::cast_sign_loss, reason = "the ratio is positive")]
    let width = (f64::from(height) * aspect.clamp(0.01, 100.0)) as u32;
    let camera = view_camera(&stage, view, [width, height]);
    let back = stage.shrink.inverse();
    let (forward, up, shown, is_parallel) = camera.axes();
    let turn = |direction: Vec3A| back.transform_vector3(direction.as_dvec3()).normalize();
    let metres = back.matrix3.x_axis.length();
    let shown = f64::from(shown);
    // A placed camera keeps its position exactly.
    let eye = match *view {
        CameraView::Perspective { from, .. } => from,
        _ => back.transform_point3(camera.eye.as_dvec3()),
    };
    let shown = if is_parallel { shown * metres } else { shown.to_degrees() };
    Ok(CameraPose { eye, forward: turn(forward), up: turn(up), shown, is_parallel })
}

/// Returns true if `point` (m) is inside a solid of `scene`: in most directions, the nearest surface is seen from behind.
pub fn is_inside(scene: &Scene, point: DVec3) -> Result<bool> {
    let stage = Stage::new(scene)?;
    let eye = stage.shrink.transform_point3(point).as_vec3a();
    let (low, high) = stage.bounds;
    if eye.clamp(low, high) != eye {
        return Ok(false);
    }
    // Directions that are not along the axes, so that rays rarely pass along walls.
    let directions = [
        Vec3A::new(0.36, 0.48, 0.8),
        Vec3A::new(-0.6, 0.33, 0.729),
        Vec3A::new(0.81, -0.41, 0.419),
        Vec3A::new(-0.74, -0.58, 0.341),
        Vec3A::new(0.29, 0.91, -0.296),
        Vec3A::new(-0.17, -0.87, -0.463),
    ];
    let mut nearest = [(f32::INFINITY, false); 6];
    stage.each_triangle(
        0..stage.triangles() as u32,
        &glam::Affine3A::IDENTITY,
        |point| point,
        None,
        |draw, triangle| {
            let [a, b, c] = triangle.corners;
            let (ab, ac) = (b - a, c - a);
            let cross = if draw.mirrored { -ab.cross(ac) } else { ab.cross(ac) };
            for (direction, nearest) in directions.iter().zip(&mut nearest) {
                if let Some(distance) = hit(eye, *direction, [a, ab, ac])
                    && distance < nearest.0
                {
                    *nearest = (distance, cross.dot(*direction) > 0.0 && !draw.double_sided);
                }
            }
        },
    );
    Ok(nearest.iter().filter(|(_, behind)| *behind).count() >= 5)
}

/// Returns the distance of a triangle, given as a corner and two sides, along a ray.
///
/// Method: Moller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
fn hit(eye: Vec3A, direction: Vec3A, [a, ab, ac]: [Vec3A; 3]) -> Option<f32> {
    let across = direction.cross(ac);
    let size = ab.dot(across);
    if size == 0.0 {
        return None;
    }
    let from = eye - a;
    let u = from.dot(across) / size;
    let other = from.cross(ab);
    let v = direction.dot(other) / size;
    let distance = ac.dot(other) / size;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0).then_some(distance)
}

/// Returns the camera of `picture`, which sees all of `extent` if one is given. Fails if the scene has no camera of the
/// name that the picture asks for.
pub(super) fn picture_camera(
    scene: &Scene,
    stage: &Stage,
    extent: Option<&Extent>,
    picture: &Picture,
    is_film: bool,
) -> Result<Camera> {
    let size = [picture.width, picture.height];
    let points = extent.map(|extent| extent.points(&stage.shrink));
    let view = match &picture.camera {
        CameraChoice::View(view) => Some(*view),
        CameraChoice::Named(name) => Some(find_camera(scene, name)?),
        CameraChoice::Automatic => {
            scene.cameras.first().filter(|_| picture.is_free()).map(|camera| camera.view)
        }
    };
    if let Some(view) = view {
        return Ok(view_camera(stage, &view, size));
    }
    let eye = view::viewpoint(points.as_ref().unwrap_or(&stage.hull), picture);
    Ok(match (points, picture.look) {
        (_, Some(look)) => {
            let axes = if is_film { eye.axes() } else { [DVec3::X, DVec3::Y, DVec3::Z] };
            ball_camera(stage, look, axes, eye, None, size)
        }
        (None, None) => Camera::fit(stage.points(), eye, size),
        (Some(points), None) => Camera::fit(points.into_iter(), eye, size),
    })
}

/// Returns the camera of `scene` called `name`, or one of those that every scene has.
fn find_camera(scene: &Scene, name: &str) -> Result<CameraView> {
    if let Some(camera) = scene.cameras.iter().find(|camera| camera.name == name) {
        return Ok(camera.view);
    }
    match name {
        "plan" => Ok(CameraView::Plan),
        "eye" => Ok(CameraView::EyeLevel { azimuth: None }),
        _ => {
            let known = scene.cameras.iter().map(|camera| camera.name.as_str()).chain(["plan", "eye"]);
            let known: Vec<&str> = known.collect();
            Err(Error::not_found("camera", name, known, format!("the model has no camera named `{name}`"))
                .help("declare it in the script: camera({ name = \"street\", from = { 20, -30, 2 }, to = { 0, 0, 5 } })"))
        }
    }
}

fn view_camera(stage: &Stage, view: &CameraView, size: [u32; 2]) -> Camera {
    let place = |point: DVec3| stage.shrink.transform_point3(point);
    let metre = stage.shrink.matrix3.x_axis.length();
    match *view {
        CameraView::Perspective { from, to, fov } => {
            Camera::between(place(from), place(to), fov.to_radians(), stage.bounds, size)
        }
        CameraView::Orthographic { from, to, height } => {
            let (from, to) = (place(from), place(to));
            let middle = height.map(|height| (to, height * metre));
            Camera::parallel(&stage.hull, to - from, middle, size)
        }
        CameraView::Plan => Camera::parallel(&stage.hull, DVec3::NEG_Z, None, size),
        CameraView::EyeLevel { azimuth } => {
            let picture = Picture { azimuth, elevation: Some(0.0), ..Picture::default() };
            let eye = view::viewpoint(&stage.hull, &picture);
            Camera::at_eye_level(&stage.hull, eye.azimuth, metre, size)
        }
        CameraView::Fitted(fitted) => fitted_camera(stage, &fitted, size),
    }
}

/// Returns the camera by angles that shows its target.
fn fitted_camera(stage: &Stage, fitted: &FittedView, size: [u32; 2]) -> Camera {
    let FittedView { azimuth, elevation, fov, sphere, is_parallel } = *fitted;
    let [width, height] = size;
    let eye =
        view::viewpoint(&stage.hull, &Picture { azimuth, elevation, width, height, ..Picture::default() });
    let ball = sphere.map(|(at, radius)| ViewBall { at: at.to_array(), radius });
    match (ball, is_parallel) {
        (Some(ball), true) => {
            let metre = stage.shrink.matrix3.x_axis.length();
            let center = stage.shrink.transform_point3(DVec3::from(ball.at));
            let tall = (f64::from(height) / f64::from(width)).max(1.0);
            let shown = Camera::PADDED * 2.0 * ball.radius * metre * tall;
            Camera::parallel(&stage.hull, -eye.direction(), Some((center, shown)), size)
        }
        (None, true) => Camera::parallel(&stage.hull, -eye.direction(), None, size),
        (Some(ball), false) => ball_camera(stage, ball, eye.axes(), eye, fov, size),
        (None, false) => {
            let apart = fov.map_or(0.5, |_| 0.05);
            Camera::fit_field(stage.points(), eye, fov.map(f64::to_radians), apart, size)
        }
    }
}

/// Returns the camera that shows the sphere `look`, whose points along `axes` fill the picture.
fn ball_camera(
    stage: &Stage,
    look: ViewBall,
    axes: [DVec3; 3],
    eye: view::Viewpoint,
    fov: Option<f64>,
    size: [u32; 2],
) -> Camera {
    let points = ball(look, axes).map(|point| stage.shrink.transform_point3(point).as_vec3a());
    let radius = (look.radius * stage.shrink.matrix3.x_axis.length()) as f32;
    let apart = 0.05 * radius.min(10.0);
    Camera::fit_field(points, eye, fov.map(f64::to_radians), apart, size).with_nearer_plane()
}

/// Returns the points of a sphere along `axes`.
fn ball(look: ViewBall, axes: [DVec3; 3]) -> impl Iterator<Item = DVec3> {
    let directions = axes.into_iter().flat_map(|axis| [axis, -axis]);
    directions.map(move |axis| DVec3::from(look.at) + axis * look.radius)
}

#[cfg(test)]
mod tests {
    use super::super::samples;
    use super::*;

    #[test]
    fn a_point_is_inside_a_solid_but_not_beside_or_between_solids() {
        let scene = samples::boxes(&[DVec3::ZERO, DVec3::new(6.0, 0.0, 0.0)]);
        for (x, inside) in [(0.0, true), (0.9, true), (3.0, false), (6.3, true), (40.0, false)] {
            assert_eq!(is_inside(&scene, DVec3::new(x, 0.1, 0.2)).unwrap(), inside, "at {x}");
        }
        assert!(!is_inside(&Scene::default(), DVec3::ZERO).unwrap());
    }

    #[test]
    fn the_pose_of_a_camera_is_in_metres_and_degrees() {
        let scene = samples::boxes(&[DVec3::ZERO]);
        let (from, to) = (DVec3::new(10.0, 0.0, 0.0), DVec3::ZERO);
        let posed = pose(&scene, &CameraView::Perspective { from, to, fov: 35.0 }, 1.5).unwrap();
        assert!(posed.eye == from && (posed.shown - 35.0).abs() < 1e-3 && !posed.is_parallel);
        assert!((posed.forward - DVec3::NEG_X).length() < 1e-6 && (posed.up - DVec3::Z).length() < 1e-6);
        let plan = pose(&scene, &CameraView::Plan, 1.0).unwrap();
        // The box of 2 m fills 92 % of the height.
        assert!(plan.is_parallel && (plan.shown - 2.0 / 0.92).abs() < 0.01, "{plan:?}");
        assert!(plan.eye.z > 1.0 && (plan.up - DVec3::Y).length() < 1e-6);
        assert!(pose(&scene, &CameraView::Perspective { from, to: from, fov: 35.0 }, 1.0).is_err());
    }
}
