//! Tests of light that surfaces mirror or let through.

use super::render;
use super::samples::{instance, prism, quad, ring, scene_of};
use super::tests::{brightness, count_covered, small, wall};
use crate::{Background, CameraChoice, Picture, Quality, SunPosition};
use burgeon_scene::{CameraView, Material, Part, Scene};
use glam::{DVec3, Vec3};

#[test]
fn glass_mirrors_the_sky_and_a_lamp_shines_in_the_dark() {
    let view = CameraView::Perspective {
        from: DVec3::new(0.0, -9.0, 1.0),
        to: DVec3::new(0.0, 0.0, 2.0),
        fov: 30.0,
    };
    let picture = Picture {
        background: Background::Sky,
        camera: CameraChoice::View(view),
        sun: Some(SunPosition { azimuth: 0.0, elevation: 40.0 }),
        ..small()
    };
    let blueness = |roughness: f32| {
        let dark =
            Material { base_color: [0.01, 0.01, 0.01, 1.0], metallic: 0.0, roughness, ..Material::default() };
        let tilted = Material { base_color: [0.8, 0.8, 0.8, 1.0], metallic: 1.0, ..dark };
        // A mirror that leans back shows the sky above the viewer.
        let mut part = Part::default();
        let corners = [[-2.0, 0.0, 0.0], [2.0, 0.0, 0.0], [2.0, 2.0, 4.0], [-2.0, 2.0, 4.0]];
        quad(&mut part, corners.map(Vec3::from_array));
        let [red, _, blue, _] = render(&scene_of(part, tilted), &picture).unwrap().pixel(48, 48);
        i32::from(blue) - i32::from(red)
    };
    assert!(blueness(0.05) > blueness(0.9) + 20, "{} {}", blueness(0.05), blueness(0.9));
    let glow = |emissive: [f32; 3]| {
        let lamp = Material { emissive, base_color: [0.0, 0.0, 0.0, 1.0], ..Material::default() };
        brightness(&render(&wall(lamp), &picture).unwrap(), 44..52, 44..52)
    };
    assert!(glow([0.9, 0.7, 0.3]) > glow([0.0; 3]) + 60.0);
}

/// Returns an open tube with smooth normals and this number of sides, seen from both sides.
fn tube(sides: u32) -> Scene {
    let mut part = Part::default();
    for i in 0..=sides {
        let (sin, cos) = (std::f32::consts::TAU * i as f32 / sides as f32).sin_cos();
        for z in [0.0, 2.0] {
            // Wider at the top, so that the sun from above shines on the inside.
            let radius = 0.7 + 0.3 * z;
            part.positions.push(Vec3::new(radius * cos, radius * sin, z));
            part.normals.push(Vec3::new(cos, sin, -0.3).normalize().into());
            part.uvs.push(glam::Vec2::ZERO);
        }
    }
    for i in 0..sides {
        let [a, b, c, d] = [2 * i, 2 * i + 2, 2 * i + 3, 2 * i + 1];
        part.triangles.extend([[a, b, c], [a, c, d]]);
    }
    scene_of(part, Material { double_sided: true, ..Material::default() })
}

#[test]
fn light_shines_through_a_coarse_smooth_surface_as_through_a_fine_one() {
    let sun = Some(SunPosition { azimuth: 0.0, elevation: 40.0 });
    let picture = Picture { azimuth: Some(170.0), quality: Quality::Fine, sun, ..small() };
    let [coarse, fine] = [20, 320].map(|sides| render(&tube(sides), &picture).unwrap());
    let differ = coarse
        .pixels()
        .iter()
        .zip(fine.pixels())
        .filter(|(a, b)| a[3] == 255 && b[3] == 255 && a[0].abs_diff(b[0]) > 14)
        .count();
    let all = count_covered(&fine);
    assert!(all > 3000 && differ * 50 < all, "{differ} of {all} pixels differ");
}

/// Returns a metal wall, and a red box in front of it that only the wall shows to the viewer.
fn mirror_and_box(roughness: f32) -> Scene {
    let mut scene =
        wall(Material { base_color: [0.9, 0.9, 0.9, 1.0], metallic: 1.0, roughness, ..Material::default() });
    let red = scene.material(&Material { base_color: [0.8, 0.05, 0.05, 1.0], ..Material::default() });
    let mut part = Part { material: red, ..Part::default() };
    prism(&mut part, &ring(4, 2.0, 0.8, -1.5), &ring(4, 2.0, 0.8, 0.5));
    scene.meshes.push(burgeon_scene::Mesh { parts: vec![part], ..Default::default() });
    scene.instances.push(burgeon_scene::Instance { mesh: 1, ..instance(DVec3::new(0.0, -6.0, 0.0)) });
    scene
}

#[test]
fn smooth_metal_mirrors_the_model_in_a_fine_render_and_rough_metal_does_not() {
    // The line of sight is mirrored down to the box.
    let view = CameraView::Perspective {
        from: DVec3::new(0.0, -7.0, 5.0),
        to: DVec3::new(0.0, 0.0, 2.4),
        fov: 20.0,
    };
    let redness = |quality: Quality, roughness: f32| {
        let picture = Picture { camera: CameraChoice::View(view), quality, ..small() };
        let [red, green, ..] = render(&mirror_and_box(roughness), &picture).unwrap().pixel(48, 48);
        i32::from(red) - i32::from(green)
    };
    let (fine, rough) = (redness(Quality::Fine, 0.05), redness(Quality::Fine, 0.9));
    assert!(fine > 50 && rough < 20, "{fine} {rough}");
    assert!(redness(Quality::Draft, 0.05) < 20, "a draft estimates what metal mirrors");
}
