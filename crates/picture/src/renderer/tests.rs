//! Tests of small renders.

use super::samples::{boxes, instance, prism, quad, ring, scene_of, twisted_tower};
use super::{render, render_within};
use crate::{Background, CameraChoice, Picture, Quality, SunPosition};
use burgeon_base::stop::Stop;
use burgeon_scene::image::Image;
use burgeon_scene::{CameraView, DirtMap, Material, NormalMap, Part, Scene, Texture, Upright};
use glam::{DAffine3, DVec3, Vec2, Vec3};

/// Returns the settings of a small render from the south-east with a transparent background and without a ground.
pub(super) fn small() -> Picture {
    Picture {
        width: 96,
        height: 96,
        azimuth: Some(135.0),
        elevation: Some(20.0),
        background: Background::Clear,
        ground: false,
        quality: Quality::Draft,
        ..Picture::default()
    }
}

/// Returns the mean brightness, 0 to 255, of the opaque pixels in columns `xs` and rows `ys`.
pub(super) fn brightness(image: &Image, xs: std::ops::Range<u32>, ys: std::ops::Range<u32>) -> f64 {
    let pixels = ys.flat_map(|y| xs.clone().map(move |x| image.pixel(x, y)));
    let opaque: Vec<[u8; 4]> = pixels.filter(|pixel| pixel[3] == 255).collect();
    assert!(!opaque.is_empty(), "nothing is seen there");
    let sum: f64 = opaque.iter().map(|pixel| pixel[..3].iter().map(|c| f64::from(*c)).sum::<f64>()).sum();
    sum / (3.0 * opaque.len() as f64)
}

/// Returns each pixel with its column and row.
pub(super) fn places(image: &Image) -> impl Iterator<Item = (u32, u32, [u8; 4])> {
    let rows = 0..image.height();
    rows.flat_map(move |y| (0..image.width()).map(move |x| (x, y, image.pixel(x, y))))
}

pub(super) fn count_covered(image: &Image) -> usize {
    image.pixels().iter().filter(|pixel| pixel[3] > 0).count()
}

/// Returns a vertical square of 4 m on the x axis whose front faces south.
pub(super) fn wall(material: Material) -> Scene {
    let mut part = Part::default();
    let corners = [[-2.0, 0.0], [2.0, 0.0], [2.0, 4.0], [-2.0, 4.0]];
    quad(&mut part, corners.map(|[x, z]| Vec3::new(x, 0.0, z)));
    scene_of(part, material)
}

#[test]
fn the_model_fills_the_picture_up_to_the_margin() {
    let image = render(&twisted_tower(12), &Picture { height: 200, ..small() }).unwrap();
    let seen: Vec<(u32, u32)> =
        places(&image).filter(|(_, _, pixel)| pixel[3] > 0).map(|(x, y, _)| (x, y)).collect();
    let (top, bottom) = (seen.iter().map(|p| p.1).min().unwrap(), seen.iter().map(|p| p.1).max().unwrap());
    assert!((7..=9).contains(&top) && (190..=192).contains(&bottom), "rows {top} to {bottom} of 200");
    assert!(seen.iter().all(|(x, _)| (3..93).contains(x)));
}

#[test]
fn the_side_away_from_the_sun_is_darker() {
    let image = render(&boxes(&[DVec3::ZERO]), &small()).unwrap();
    let (lit, dark) = (brightness(&image, 15..40, 45..70), brightness(&image, 56..81, 45..70));
    assert!(lit > 1.4 * dark, "lit {lit}, dark {dark}");
    assert!(dark > 30.0, "the dark side still gets light from the sky: {dark}");
}

#[test]
fn a_crease_is_darker_than_the_open_floor() {
    let mut part = Part::default();
    quad(&mut part, [[-2.0, -4.0], [2.0, -4.0], [2.0, 0.0], [-2.0, 0.0]].map(|[x, y]| Vec3::new(x, y, 0.0)));
    quad(&mut part, [[-2.0, 0.0], [2.0, 0.0], [2.0, 2.0], [-2.0, 2.0]].map(|[x, z]| Vec3::new(x, 0.0, z)));
    // For a view from the south, the sun is in the south-west and lights the whole floor.
    let picture = Picture { azimuth: Some(180.0), elevation: Some(60.0), ..small() };
    let image = render(&scene_of(part, Material::default()), &picture).unwrap();
    let floor = |y: u32| brightness(&image, 40..56, y..y + 2);
    let crease = (20..60).map(floor).fold(f64::MAX, f64::min);
    assert!(crease < 0.93 * floor(78), "crease {crease}, open floor {}", floor(78));
}

#[test]
fn the_number_of_threads_does_not_change_a_byte() {
    let mut scene = twisted_tower(6);
    let glass = Material { base_color: [0.3, 0.5, 0.6, 0.4], double_sided: true, ..Material::default() };
    let material = scene.material(&glass);
    let mut part = Part { material, ..Part::default() };
    prism(&mut part, &ring(5, 11.0, 0.0, 0.0), &ring(5, 11.0, 0.5, 14.0));
    // Duplicate the part: of two coincident surfaces, the same one must always be visible.
    scene.meshes[0].parts.extend([part.clone(), part]);
    scene
        .instances
        .extend((1..9).map(|i| instance(DVec3::new(f64::from(i) * 9.0, f64::from(i % 3) * 8.0, 0.0))));
    for quality in [Quality::Draft, Quality::Fine] {
        let picture = Picture { background: Background::Light, ground: true, quality, ..small() };
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| render(&scene, &picture)).unwrap()
        };
        assert!(with(1) == with(3));
    }
}

#[test]
fn an_edge_is_smooth() {
    for (quality, steps) in [(Quality::Draft, 5), (Quality::Fine, 9), (Quality::Best, 13)] {
        let image = render(&boxes(&[DVec3::ZERO]), &Picture { quality, ..small() }).unwrap();
        let mut values: Vec<u8> = image.pixels().iter().map(|pixel| pixel[3]).collect();
        values.sort_unstable();
        values.dedup();
        assert!(values.len() >= steps, "{} steps between nothing and the model", values.len());
    }
}

#[test]
fn a_texture_repeats_at_its_size_in_metres() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("stripes.png");
    image::RgbImage::from_fn(64, 4, |x, _| image::Rgb([if x < 32 { 20 } else { 235 }; 3]))
        .save(&path)
        .unwrap();
    let stripes = |width: f64| {
        let texture = Some(Texture { path: path.clone(), size: [width, 1.0], content: None });
        let scene = wall(Material { base_color: [1.0; 4], texture, ..Material::default() });
        let picture = Picture { width: 200, azimuth: Some(180.0), elevation: Some(0.0), ..small() };
        let image = render(&scene, &picture).unwrap();
        let row: Vec<u8> =
            (0..200).map(|x| image.pixel(x, 50)).filter(|p| p[3] == 255).map(|p| p[0]).collect();
        row.windows(2).filter(|pair| (pair[0] > 128) != (pair[1] > 128)).count()
    };
    assert_eq!((stripes(1.0), stripes(2.0), stripes(8.0)), (7, 3, 0));
}

#[test]
fn a_normal_map_is_lighter_where_it_leans_to_the_sun() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slope.png");
    // Leaning to the right, which is east on a wall seen from the south.
    image::RgbImage::from_pixel(4, 4, image::Rgb([218, 128, 218])).save(&path).unwrap();
    let light = |scale: Option<f32>, turned: bool, azimuth: f64| {
        let image = Texture { path: path.clone(), size: [1.0, 1.0], content: None };
        let normal_map = scale.map(|scale| NormalMap { image, scale });
        let mut scene = wall(Material { double_sided: true, normal_map, ..Material::default() });
        if turned {
            for uv in &mut scene.meshes[0].parts[0].uvs {
                *uv = -*uv;
            }
        }
        let sun = SunPosition { azimuth, elevation: 20.0 };
        let image = render(&scene, &Picture { sun: Some(sun), ..front() }).unwrap();
        i32::from(image.pixel(image.width() / 2, image.height() / 2)[0])
    };
    for sun in [130.0, 230.0] {
        let to_sun = if sun < 180.0 { 1 } else { -1 };
        let (flat, leaning) = (light(None, false, sun), light(Some(1.0), false, sun));
        assert!((leaning - flat) * to_sun > 12, "{leaning} and {flat} with the sun at {sun}");
        assert!((light(Some(1.0), true, sun) - flat) * to_sun < -12, "the map is turned around");
        assert!((light(Some(0.0), false, sun) - flat).abs() <= 1, "the map is flat");
    }
}

#[test]
fn a_dirt_map_lies_by_its_own_set_and_multiplies_the_texture() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("halves.png");
    image::RgbImage::from_fn(64, 4, |x, _| image::Rgb([if x < 32 { 20 } else { 255 }; 3]))
        .save(&path)
        .unwrap();
    let image = |size: [f64; 2]| Texture { path: path.clone(), size, content: None };
    let dirt_map = Some(DirtMap { image: image([4.0, 1.0]), set: "dirt".into() });
    let stripes = |texture: Option<Texture>, second: Option<fn(Vec2) -> Vec2>| {
        let mut scene = wall(Material {
            base_color: [1.0; 4],
            texture,
            dirt_map: dirt_map.clone(),
            ..Material::default()
        });
        if let Some(second) = second {
            let part = &mut scene.meshes[0].parts[0];
            part.second_uvs = part.uvs.iter().map(|uv| second(*uv)).collect();
        }
        let picture = Picture { width: 200, azimuth: Some(180.0), elevation: Some(0.0), ..small() };
        let image = render(&scene, &picture).unwrap();
        let row: Vec<u8> =
            (0..200).map(|x| image.pixel(x, 50)).filter(|p| p[3] == 255).map(|p| p[0]).collect();
        row.windows(2).filter(|pair| (pair[0] > 128) != (pair[1] > 128)).count()
    };
    // The wall is 4 m wide, with coordinates of the texture where the second set is missing.
    assert_eq!((stripes(None, None), stripes(None, Some(|uv| uv * 4.0))), (1, 7));
    // Dark halves of the texture, 2 m wide, and the dark half of the dirt.
    assert_eq!(stripes(Some(image([2.0, 1.0])), None), 1);
    assert_eq!(stripes(Some(image([2.0, 1.0])), Some(|_| Vec2::new(1.0, 0.5))), 0);
}

#[test]
fn a_missing_normal_map_is_an_error_that_names_the_file() {
    let image = Texture { path: "no/such/relief.png".into(), size: [1.0, 1.0], content: None };
    let normal_map = Some(NormalMap { image, scale: 1.0 });
    let error = render(&wall(Material { normal_map, ..Material::default() }), &small()).unwrap_err();
    assert!(error.to_string().contains("the normal map no/such/relief.png cannot be read"), "{error}");
}

#[test]
fn the_back_of_a_face_is_seen_only_if_the_material_has_two_sides() {
    let from = |scene: &Scene, azimuth: f64| {
        count_covered(&render(scene, &Picture { azimuth: Some(azimuth), ..small() }).unwrap())
    };
    let mut scene = wall(Material::default());
    assert!(from(&scene, 180.0) > 1000);
    assert_eq!(from(&scene, 0.0), 0);
    scene.materials[0].double_sided = true;
    assert!(from(&scene, 0.0) > 1000);
    scene.materials[0].double_sided = false;
    scene.instances[0].transform = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
    assert!(from(&scene, 180.0) > 1000, "a mirrored face still looks the same way");
    assert_eq!(from(&scene, 0.0), 0);
}

#[test]
fn half_opacity_lets_half_of_the_background_through() {
    let scene = wall(Material { base_color: [0.5, 0.5, 0.5, 0.5], ..Material::default() });
    let image = render(&scene, &Picture { azimuth: Some(180.0), quality: Quality::Fine, ..small() }).unwrap();
    let mean = (30..66).flat_map(|y| (30..66).map(move |x| (x, y)));
    let mean = mean.map(|(x, y)| f64::from(image.pixel(x, y)[3])).sum::<f64>() / 1296.0;
    assert!((mean - 127.5).abs() < 3.0, "{mean}");
}

#[test]
fn the_ground_shows_a_shadow_and_fades_out() {
    let scene = boxes(&[DVec3::ZERO]);
    let picture = Picture { width: 192, elevation: Some(35.0), ..small() };
    let without = count_covered(&render(&scene, &picture).unwrap());
    let image = render(&scene, &Picture { ground: true, ..picture }).unwrap();
    assert!(count_covered(&image) > without + 500);
    let darkest = (150..192).map(|x| image.pixel(x, 60)[3]).max().unwrap();
    assert!((60..255).contains(&darkest), "shadow of {darkest}");
    assert!(image.pixel(1, 1)[3] < 6);
}

#[test]
fn what_has_no_size_or_is_not_finite_gives_a_picture_all_the_same() {
    let picture = Picture { width: 32, height: 24, quality: Quality::Draft, ..Picture::default() };
    let plain = render(&Scene::default(), &picture).unwrap();
    assert_eq!((plain.width(), plain.height()), (32, 24));
    let mut part = Part::default();
    quad(&mut part, [Vec3::ONE; 4]);
    let point = render(&scene_of(part, Material::default()), &picture).unwrap();
    assert!(point.bytes().iter().zip(plain.bytes()).all(|(a, b)| a.abs_diff(*b) <= 1));

    let mut scene = wall(Material::default());
    let expected = render(&scene, &picture).unwrap();
    let part = &mut scene.meshes[0].parts[0];
    let first = part.positions.len() as u32;
    part.positions.push(Vec3::new(f32::NAN, 1.0, f32::INFINITY));
    part.triangles.push([0, 1, first]);
    scene.instances.push(instance(DVec3::new(f64::NAN, 0.0, 0.0)));
    assert!(render(&scene, &picture).unwrap() == expected);
}

#[test]
fn a_line_and_a_view_straight_down_or_up_are_no_trouble() {
    let mut part = Part::default();
    let corners = [[-50.0, 0.0], [50.0, 0.0], [50.0, 1e-3], [-50.0, 1e-3]];
    quad(&mut part, corners.map(|[x, y]| Vec3::new(x, y, 0.0)));
    let scene = scene_of(part, Material { double_sided: true, ..Material::default() });
    for elevation in [90.0, 0.0, -90.0] {
        let picture = Picture { height: 7, elevation: Some(elevation), ground: true, ..small() };
        let image = render(&scene, &picture).unwrap();
        assert_eq!((image.width(), image.height()), (96, 7));
    }
}

#[test]
fn a_missing_texture_is_an_error_that_names_the_file() {
    let texture = Some(Texture { path: "no/such/brick.png".into(), size: [1.0, 1.0], content: None });
    let error = render(&wall(Material { texture, ..Material::default() }), &small()).unwrap_err();
    assert!(error.to_string().contains("no/such/brick.png"), "{error}");
}

/// Returns the settings of a render from the south.
fn front() -> Picture {
    Picture { azimuth: Some(180.0), elevation: Some(0.0), ..small() }
}

/// Renders the wall with a texture that is repeated once over its area.
fn render_papered(pixel: impl Fn(u32, u32) -> [u8; 4], base_color: [f32; 4], picture: &Picture) -> Image {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("leaf.png");
    image::RgbaImage::from_fn(64, 64, |x, y| image::Rgba(pixel(x, y))).save(&path).unwrap();
    let texture = Some(Texture { path, size: [4.0, 2.0], content: None });
    let scene = wall(Material { base_color, texture, ..Material::default() });
    render(&scene, picture).unwrap()
}

#[test]
fn what_a_texture_leaves_out_is_not_there() {
    // The left half is opaque. The invisible pixels are black, as image editors write them.
    let half = |x: u32, _| if x < 32 { [230, 230, 230, 255] } else { [0; 4] };
    let image = render_papered(half, [1.0; 4], &front());
    let whole = render_papered(|_, _| [230, 230, 230, 255], [1.0; 4], &front());
    let (some, all) = (count_covered(&image), count_covered(&whole));
    assert!((some * 2).abs_diff(all) < all / 20, "{some} of {all}");
    // The edge has no dark seam.
    let row = |image: &Image| {
        let middle = image.height() / 2;
        let row = (0..image.width()).map(|x| image.pixel(x, middle));
        row.filter(|pixel| pixel[3] > 250).map(|pixel| pixel[0]).collect::<Vec<_>>()
    };
    let (least, lit) = (*row(&image).iter().min().unwrap(), *row(&whole).iter().min().unwrap());
    assert!(least + 12 > lit, "{least} where a whole wall has {lit}");
}

#[test]
fn fine_holes_let_through_as_much_as_they_are() {
    let dots = |x: u32, y: u32| if (x / 2 + y / 2).is_multiple_of(4) { [90, 140, 60, 255] } else { [0; 4] };
    let picture = front();
    let (image, whole) = (
        render_papered(dots, [1.0; 4], &picture),
        render_papered(|_, _| [90, 140, 60, 255], [1.0; 4], &picture),
    );
    let opacity = |image: &Image| image.pixels().iter().map(|pixel| f64::from(pixel[3])).sum::<f64>();
    let part = opacity(&image) / opacity(&whole);
    assert!((0.2..0.3).contains(&part), "{part}");
    // A translucent material with holes is more transparent.
    let part = opacity(&render_papered(dots, [1.0, 1.0, 1.0, 0.5], &picture)) / opacity(&whole);
    assert!((0.09..0.16).contains(&part), "{part}");
}

#[test]
fn the_shadow_of_what_is_cut_out_has_its_holes() {
    let picture = Picture { ground: true, elevation: Some(30.0), ..front() };
    let bars = |x: u32, _| if (x / 8).is_multiple_of(2) { [200, 200, 200, 255] } else { [0; 4] };
    let (barred, whole) = (
        render_papered(bars, [1.0; 4], &picture),
        render_papered(|_, _| [200, 200, 200, 255], [1.0; 4], &picture),
    );
    // The sun is on the left, so the shadow continues to the right of the wall.
    let edge = places(&whole).filter(|(_, _, pixel)| pixel[3] == 255).map(|(x, ..)| x).max().unwrap();
    let shadow = |image: &Image| {
        let beside = places(image).filter(|(x, ..)| *x > edge + 2);
        beside.map(|(_, _, pixel)| f64::from(pixel[3])).sum::<f64>()
    };
    let part = shadow(&barred) / shadow(&whole);
    assert!((0.3..0.75).contains(&part), "{part}");
}

#[test]
fn a_picture_that_nobody_waits_for_is_given_up() {
    let stop = Stop::default();
    stop.stop(burgeon_base::error::Error::cancellation("the page has gone"));
    let error = render_within(&boxes(&[DVec3::ZERO]), None, &small(), &stop).unwrap_err();
    assert_eq!(error.message(), "the page has gone");
}

/// Returns the cap of a sphere with a radius of 100 m around `up`, with its triangles facing outwards.
fn cap(up: DVec3) -> Scene {
    let (right, ahead) = up.any_orthonormal_pair();
    let mut part = Part::default();
    let point = |i: usize, j: usize| {
        let (x, y) = (i as f64 / 8.0 - 1.0, j as f64 / 8.0 - 1.0);
        ((up + (right * x + ahead * y) * 0.4).normalize() * 100.0).as_vec3()
    };
    for i in 0..16 {
        for j in 0..16 {
            quad(&mut part, [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
        }
    }
    scene_of(part, Material::default())
}

#[test]
fn a_part_of_a_planet_is_seen_from_above_it_wherever_it_lies() {
    let picture = Picture { azimuth: None, elevation: None, ..small() };
    let mut ways = directions();
    let from_the_top = count_covered(&render(&cap(DVec3::Z), &picture).unwrap());
    for up in ways.by_ref().take(12) {
        let mut scene = cap(up);
        scene.upright = Upright::new(up, DVec3::Z);
        let image = render(&scene, &picture).unwrap();
        // The cap is square, and may be rotated relative to north.
        let part = count_covered(&image) as f64 / from_the_top as f64;
        assert!((0.5..2.0).contains(&part), "up is {up}: {part}");
        // The light must also come from above.
        assert!(brightness(&image, 40..56, 40..56) > 60.0, "up is {up}");
    }
}

/// Returns directions all over the sphere, including straight down.
fn directions() -> impl Iterator<Item = DVec3> {
    let golden = 2.399_963_229_728_653_f64;
    std::iter::once(DVec3::NEG_Z).chain((0..).map(move |i| {
        let z = 0.95 - 0.19 * f64::from(i % 11);
        let (sin, cos) = (golden * f64::from(i)).sin_cos();
        DVec3::new(cos * (1.0 - z * z).sqrt(), sin * (1.0 - z * z).sqrt(), z)
    }))
}

#[test]
fn a_plain_that_reaches_behind_the_camera_is_clipped_and_not_dropped() {
    // A plane of two triangles and a plane of 20,000 triangles must look the same from eye height.
    let plain = |cells: i32| {
        let mut part = Part::default();
        let side = 4000.0 / cells as f32;
        for x in 0..cells {
            for y in 0..cells {
                let corner = Vec3::new(x as f32 * side - 2000.0, y as f32 * side - 2000.0, 0.0);
                let [a, b] = [Vec3::X * side, Vec3::Y * side];
                quad(&mut part, [corner, corner + a, corner + a + b, corner + b]);
            }
        }
        scene_of(part, Material::default())
    };
    for (azimuth, elevation) in [(0.0, 2.0), (37.0, 4.0), (180.0, 12.0), (291.0, 30.0)] {
        let look = Some(crate::ViewBall { at: [30.0, -20.0, 4.0], radius: 40.0 });
        let picture = Picture { azimuth: Some(azimuth), elevation: Some(elevation), look, ..small() };
        let [few, many] = [1, 100].map(|cells| render(&plain(cells), &picture).unwrap());
        assert!(count_covered(&many) > 4000, "{} pixels", count_covered(&many));
        let differ = few.pixels().iter().zip(many.pixels()).filter(|(a, b)| (a[3] > 0) != (b[3] > 0)).count();
        assert!(
            differ * 100 < count_covered(&many),
            "azimuth {azimuth}: {differ} of {}",
            count_covered(&many)
        );
    }
}

#[test]
fn a_sky_is_blue_above_the_horizon_and_red_at_dusk() {
    let view = CameraView::Perspective { from: DVec3::new(0.0, -9.0, 0.0), to: DVec3::ZERO, fov: 50.0 };
    let picture = Picture {
        background: Background::Sky,
        ground: true,
        camera: CameraChoice::View(view),
        sun: Some(SunPosition { azimuth: 180.0, elevation: 50.0 }),
        ..small()
    };
    let scene = boxes(&[DVec3::ZERO]);
    let noon = render(&scene, &picture).unwrap();
    let [red, _, blue, _] = noon.pixel(4, 2);
    assert!(blue > red + 20, "{red} {blue}");
    let [red, _, blue, _] = noon.pixel(4, 94);
    assert!(red >= blue, "the ground is not blue: {red} {blue}");
    let low = Some(SunPosition { azimuth: 180.0, elevation: 3.0 });
    let dusk = render(&scene, &Picture { sun: low, ..picture.clone() }).unwrap();
    let warmth = |image: &Image| f64::from(image.pixel(48, 40)[0]) / f64::from(image.pixel(48, 40)[2]);
    assert!(warmth(&dusk) > 1.3 * warmth(&noon), "{} {}", warmth(&dusk), warmth(&noon));
    let night = Picture { sun: Some(SunPosition { azimuth: 0.0, elevation: -2.0 }), ..picture };
    assert_eq!(render(&scene, &night).unwrap_err().message(), "the sun is not above the horizon");
}

#[test]
fn haze_lets_a_model_fade_into_the_background() {
    let picture = Picture { background: Background::Light, ..small() };
    let scene = boxes(&[DVec3::ZERO]);
    let empty = render(&Scene::default(), &picture).unwrap().pixel(48, 48);
    let gap = |haze: Option<f64>| {
        let pixel = render(&scene, &Picture { haze, ..picture.clone() }).unwrap().pixel(48, 48);
        (0..3).map(|i| pixel[i].abs_diff(empty[i])).max().unwrap()
    };
    let (clear, hazy, thick) = (gap(None), gap(Some(6.0)), gap(Some(0.1)));
    assert!(hazy < clear && thick < 3, "{clear} {hazy} {thick}");
}
