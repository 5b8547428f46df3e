//! Tests of the cameras of renders, and of what they see.

use super::samples::{boxes, twisted_tower};
use super::tests::{count_covered, places, small, wall};
use super::{render, render_with_sight};
use crate::ModelSight;
use crate::{CameraChoice, Picture};
use burgeon_base::stop::Stop;
use burgeon_scene::{CameraView, FittedView, Material, Scene, SceneCamera};
use glam::DVec3;

#[test]
fn the_first_camera_of_a_scene_is_that_of_its_picture_unless_another_is_chosen() {
    let mut scene = boxes(&[DVec3::ZERO]);
    let free = Picture { azimuth: None, elevation: None, ..small() };
    let fitted = render(&scene, &free).unwrap();
    let view = CameraView::Perspective { from: DVec3::new(0.0, -30.0, 0.0), to: DVec3::ZERO, fov: 40.0 };
    for (name, view) in [("far", view), ("above", CameraView::Plan)] {
        scene.cameras.push(SceneCamera { name: name.to_owned(), view, place: None });
    }
    let far = render(&scene, &free).unwrap();
    assert!(count_covered(&far) * 8 < count_covered(&fitted));
    let named = |name: &str| Picture { camera: CameraChoice::Named(name.to_owned()), ..free.clone() };
    assert!(render(&scene, &named("far")).unwrap() == far);
    let above = render(&scene, &named("above")).unwrap();
    // A square from above fills 92 % of the width and of the height.
    assert!(count_covered(&above).abs_diff(88 * 88) < 400, "{}", count_covered(&above));
    assert!(render(&scene, &named("plan")).unwrap() == above);
    assert!(render(&scene, &Picture { azimuth: Some(150.0), ..free.clone() }).unwrap() != far);
    let error = render(&scene, &named("fra")).unwrap_err();
    assert!(error.message().contains("no camera named `fra`"), "{error}");
}

#[test]
fn a_render_knows_why_it_shows_nothing_of_the_model() {
    let sight = |scene: &Scene, from: [f64; 3], to: [f64; 3]| {
        let (from, to) = (DVec3::from_array(from), DVec3::from_array(to));
        let view = CameraView::Perspective { from, to, fov: 40.0 };
        let picture = Picture { camera: CameraChoice::View(view), ground: true, ..small() };
        render_with_sight(scene, &picture, &Stop::new()).unwrap().1
    };
    let wall = wall(Material::default());
    for (from, to, expected) in [
        ([0.0, -9.0, 2.0], [0.0, 0.0, 2.0], ModelSight::Seen),
        ([0.0, -9.0, 2.0], [0.0, -20.0, 2.0], ModelSight::Outside),
        ([0.0, 9.0, 2.0], [0.0, 0.0, 2.0], ModelSight::Hidden),
        ([0.0, -1e12, 2.0], [0.0, 0.0, 2.0], ModelSight::Speck),
    ] {
        assert_eq!(sight(&wall, from, to), expected, "from {from:?} to {to:?}");
    }
    assert_eq!(sight(&Scene::default(), [0.0, -9.0, 2.0], [0.0; 3]), ModelSight::Seen);
}

#[test]
fn a_camera_by_angles_shows_the_whole_model_or_fills_the_picture_with_its_sphere() {
    let scene = twisted_tower(12);
    let covered = |view: FittedView| {
        let camera = CameraChoice::View(CameraView::Fitted(view));
        let image = render(&scene, &Picture { camera, ..small() }).unwrap();
        let rows: Vec<u32> = places(&image).filter(|(_, _, pixel)| pixel[3] > 0).map(|(_, y, _)| y).collect();
        (image, *rows.iter().min().unwrap(), *rows.iter().max().unwrap())
    };
    let angles = FittedView { azimuth: Some(135.0), elevation: Some(20.0), ..FittedView::default() };
    let plain = render(&scene, &small()).unwrap();
    assert!(covered(angles).0 == plain, "the angles of a picture and of a camera are the same");
    for fov in [5.0, 30.0, 90.0] {
        for is_parallel in [false, true] {
            let (_, top, bottom) = covered(FittedView { fov: Some(fov), is_parallel, ..angles });
            assert!((2..=6).contains(&top) && (89..=93).contains(&bottom), "{fov}: rows {top} to {bottom}");
        }
    }
    let alone = boxes(&[DVec3::ZERO]);
    for (sphere, is_parallel) in [(0.5, false), (1e-3, false), (0.5, true)] {
        let sphere = Some((DVec3::new(0.0, -1.0, 0.0), sphere));
        let view = FittedView { azimuth: Some(180.0), elevation: Some(0.0), sphere, is_parallel, fov: None };
        let picture = Picture { camera: CameraChoice::View(CameraView::Fitted(view)), ..small() };
        assert_eq!(count_covered(&render(&alone, &picture).unwrap()), 96 * 96, "{view:?}");
    }
}
