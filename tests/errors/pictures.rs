//! Tests of pictures: cameras, quality, sky and ground.

use insta::assert_snapshot;

use crate::support::{Folder, assert_decent};

const SCRIPT: &str = r#"local Slab = module("Slab")
camera({ name = "street", from = { 12, -9, 1.7 }, to = { 0, 0, 3 }, fov = 60 })
camera({ name = "map", view = "plan" })
camera({ name = "low", azimuth = 30, elevation = 15, fov = 20 })
camera({ name = "edge", azimuth = 30, elevation = 15, to = { 0, 0, 8 }, radius = 2 })
camera({ name = "isometric", view = "orthographic", azimuth = 135, elevation = 35.26 })
local tower = lsystem({ object = extruder({ sides = 4 }) })
tower:axiom(Slab())
tower:interpret("Slab", function(this) this:scale(3):extrude(8) end)
tower:derive()
"#;

fn folder() -> Folder {
    Folder::new().with("s.lua", SCRIPT)
}

/// Returns the pixels of a picture of the script with these options.
fn picture(flags: &[&str]) -> Vec<u8> {
    let folder = folder();
    folder.burgeon(&[&["run", "s.lua", "--size", "64x48", "-o", "a.png"], flags].concat()).done();
    image::open(folder.path().join("a.png")).unwrap().into_rgba8().into_raw()
}

/// Returns the error of a script that declares this camera.
fn refused(camera: &str) -> String {
    Folder::new().with("s.lua", format!("\n{camera}\n{SCRIPT}")).refuses(&["run", "s.lua"])
}

/// Returns the error message for a wrong command line.
fn wrong(flags: &[&str]) -> String {
    let said = folder().burgeon(&[&["run", "s.lua", "-o", "a.png"], flags].concat());
    assert_eq!((said.status, said.stdout.as_str()), (2, ""), "{}", said.stderr);
    assert_decent(&said.stderr);
    said.stderr
}

#[test]
fn a_picture_has_the_first_camera_of_the_script_or_the_chosen_one() {
    let first = picture(&[]);
    assert!(first == picture(&["--camera", "street"]));
    assert!(first == picture(&["--from", "12,-9,1.7", "--to", "0,0,3", "--fov", "60"]));
    let map = picture(&["--camera", "map"]);
    assert!(map != first && map == picture(&["--camera", "plan"]));
    let others = [
        picture(&["--camera", "eye"]),
        picture(&["--camera", "low"]),
        picture(&["--camera", "edge"]),
        picture(&["--camera", "isometric"]),
        picture(&["--azimuth", "150"]),
        picture(&["--from", "12,-9,1.7", "--to", "0,0,3", "--orthographic"]),
        picture(&["--from", "12,-9,1.7", "--to", "0,0,3", "--orthographic=4"]),
        picture(&["--quality", "fine"]),
        picture(&["--background", "sky"]),
        picture(&["--sun", "90,20"]),
        picture(&["--sun", "17:30"]),
        picture(&["--haze", "20"]),
        picture(&["--no-floor"]),
    ];
    for (number, other) in others.iter().enumerate() {
        assert!(*other != first, "picture {number} is the first");
        assert!(others[..number].iter().all(|before| before != other), "picture {number} repeats another");
    }
}

#[test]
fn a_camera_without_a_direction_or_with_a_wrong_field_is_refused_with_its_line() {
    assert_snapshot!(refused(r#"camera({ from = { 1, 2, 3 }, to = { 1, 2, 3 } })"#), @r"
    error: s.lua:2:1: the camera has no direction
      | camera({ from = { 1, 2, 3 }, to = { 1, 2, 3 } })
      | ^^^^^^
      help: give two different points: from, its position, and to, the point that it shows
    ");
    assert_snapshot!(refused(r#"camera({ name = "a", to = { 1, 2, 3 } })"#), @r#"
    error: s.lua:2:1: camera a has no `from`
      | camera({ name = "a", to = { 1, 2, 3 } })
      | ^^^^^^
      help: write camera({ name = "a", from = { 20, -30, 2 }, to = { 0, 0, 5 } }), or camera({ name = "a", azimuth = 30, elevation = 15 }), which shows the whole model
    "#);
    assert_snapshot!(refused(r#"camera({ form = { 1, 2, 3 } })"#), @r"
    error: s.lua:2:10: unknown field `form` in camera
      | camera({ form = { 1, 2, 3 } })
      |          ^^^^
      help: did you mean from?
    ");
    assert_snapshot!(refused(r#"camera({ name = "a", view = "plan", fov = 20 })"#), @r#"
    error: s.lua:2:37: camera a has no `fov`: its view is "plan"
      | camera({ name = "a", view = "plan", fov = 20 })
      |                                     ^^^
      help: remove it: the view "plan" is fitted to the model
    "#);
    assert_snapshot!(refused(r#"camera({ name = "a", view = "above" })"#), @r#"
    error: s.lua:2:30: unknown view "above" of camera a
      | camera({ name = "a", view = "above" })
      |                              ^^^^^
      help: write "perspective", "orthographic", "plan" or "eye"
    "#);
    assert_snapshot!(refused(r#"camera({ from = { 1, 2, 3 }, to = { 0, 0, 0 }, fov = 200 })"#), @r"
    error: s.lua:2:1: the field of view is 200 degrees
      | camera({ from = { 1, 2, 3 }, to = { 0, 0, 0 }, fov = 200 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: give 1 to 120 degrees
    ");
    assert_snapshot!(refused(r#"camera({ name = "map", view = "eye" })"#), @r#"
    error: s.lua:5:1: the camera map is already declared in s.lua:2
      | camera({ name = "map", view = "plan" })
      | ^^^^^^
      help: give each camera a name: camera({ name = "street", ... })
    "#);
}

#[test]
fn a_camera_by_angles_with_a_wrong_or_foreign_field_is_refused_with_its_line() {
    assert_snapshot!(refused(r#"camera({ azimuth = 30, elevation = 91 })"#), @r"
    error: s.lua:2:24: the elevation of the camera is 91 degrees
      | camera({ azimuth = 30, elevation = 91 })
      |                        ^^^^^^^^^
      help: give -90 to 90 degrees above the horizon
    ");
    assert_snapshot!(refused(r#"camera({ azimuth = 30, to = { 0, 0, 4 } })"#), @r"
    error: s.lua:2:24: camera camera has `to` and no `radius`
      | camera({ azimuth = 30, to = { 0, 0, 4 } })
      |                        ^^
      help: give both, the sphere that the picture shows: to = { 0, 0, 5 }, radius = 8; or none, for the whole model
    ");
    assert_snapshot!(refused(r#"camera({ elevation = 30, to = { 0, 0, 4 }, radius = 0 })"#), @r"
    error: s.lua:2:44: the radius that the camera shows is 0 m
      | camera({ elevation = 30, to = { 0, 0, 4 }, radius = 0 })
      |                                            ^^^^^^
      help: give metres above 0
    ");
    assert_snapshot!(refused(r#"camera({ azimuth = 30, from = { 9, 0, 4 }, to = { 0, 0, 4 } })"#), @r"
    error: s.lua:2:24: camera camera has no `from`: its direction is given by angles
      | camera({ azimuth = 30, from = { 9, 0, 4 }, to = { 0, 0, 4 } })
      |                        ^^^^
      help: a camera by angles has azimuth, elevation, to, radius, fov; with `from` and `to` it has no angles
    ");
    assert_snapshot!(refused(r#"camera({ from = { 9, 0, 4 }, to = { 0, 0, 4 }, radius = 4 })"#), @r"
    error: s.lua:2:48: camera camera has no `radius`: it has a position
      | camera({ from = { 9, 0, 4 }, to = { 0, 0, 4 }, radius = 4 })
      |                                                ^^^^^^
      help: give its direction by angles instead of `from`: azimuth = 30, elevation = 15
    ");
    assert_snapshot!(refused(r#"camera({ view = "eye", elevation = 4 })"#), @r#"
    error: s.lua:2:24: camera camera has no `elevation`: its view is "eye"
      | camera({ view = "eye", elevation = 4 })
      |                        ^^^^^^^^^
      help: the view "eye" has azimuth
    "#);
    assert_snapshot!(refused(r#"camera({ azimuth = 30, fov = 0 })"#), @r"
    error: s.lua:2:1: the field of view is 0 degrees
      | camera({ azimuth = 30, fov = 0 })
      | ^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^^
      help: give 1 to 120 degrees
    ");
}

#[test]
fn a_picture_that_shows_nothing_of_the_model_is_a_warning_with_the_reason_and_the_line() {
    let warning = |camera: &str| {
        let folder = Folder::new().with("s.lua", format!("{camera}\n{SCRIPT}"));
        let run = ["run", "s.lua", "--size", "64x48", "-o", "a.png"];
        folder.refuses(&[&run[..], &["--strict"]].concat());
        let said = folder.burgeon(&run).done().stderr;
        said.lines().skip_while(|line| !line.starts_with("warning")).collect::<Vec<_>>().join("\n")
    };
    assert_snapshot!(warning(r#"camera({ name = "away", from = { 20, 0, 4 }, to = { 40, 0, 4 } })"#), @r#"
    warning: s.lua:1:1: the picture a.png by camera away shows nothing of the model: the model is outside of it
      | camera({ name = "away", from = { 20, 0, 4 }, to = { 40, 0, 4 } })
      | ^^^^^^
      help: direct the camera at the model, whose middle is at { 0, 0, 4 }, or give angles, which fit the distance to it: azimuth = 30, elevation = 15
    "#);
    assert_snapshot!(warning(r#"camera({ name = "far", from = { 1e12, 0, 4 }, to = { 0, 0, 4 } })"#), @r#"
    warning: s.lua:1:1: the picture a.png by camera far shows nothing of the model: the model is smaller than a pixel
      | camera({ name = "far", from = { 1e12, 0, 4 }, to = { 0, 0, 4 } })
      | ^^^^^^
      help: move the camera nearer to the model, whose middle is at { 0, 0, 4 }, or give angles, which fit the distance to it: azimuth = 30, elevation = 15
    "#);
    let leaf = r#"local P = module("P")
local leaf = lsystem({ object = turtle() })
leaf:axiom(P())
leaf:interpret("P", function(this) this:mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 } }, { { 1, 2, 3 } }) end)
leaf:derive()
"#;
    let folder = Folder::new().with("leaf.lua", leaf);
    let said = folder.burgeon(&["run", "leaf.lua", "-o", "a.png", "--elevation", "-40"]).done().stderr;
    assert!(said.contains("its faces are seen from behind") && said.contains("double_sided"), "{said}");
    let said = folder.burgeon(&["run", "leaf.lua", "-o", "a.png"]).done().stderr;
    assert!(!said.contains("warning"), "{said}");
}

#[test]
fn a_picture_that_takes_longer_than_the_time_limit_is_cancelled() {
    let large =
        ["run", "s.lua", "-o", "a.png", "--size", "9000x9000", "--quality", "best", "--time-limit", "1"];
    let error = folder().refuses(&large);
    assert!(error.contains("writing the files exceeded the time limit of 1 s"), "{error}");
}

#[test]
fn a_camera_inside_a_solid_is_a_warning_with_its_line() {
    let inside = "camera({ name = \"cellar\", from = { 0.5, 0.3, 4 }, to = { 9, 0, 4 } })\n";
    let folder = Folder::new().with("s.lua", format!("{inside}{SCRIPT}"));
    let said = folder.burgeon(&["run", "s.lua", "-o", "a.glb"]).done();
    assert!(said.stderr.contains("s.lua:1:1: camera cellar is inside a solid"), "{}", said.stderr);
    assert!(!said.stderr.contains("street"), "{}", said.stderr);
    folder.refuses(&["run", "s.lua", "--strict", "-o", "a.glb"]);
}

#[test]
fn an_unknown_camera_and_a_sun_at_night_are_refused() {
    let error = folder().refuses(&["run", "s.lua", "-o", "a.png", "--camera", "stret"]);
    assert!(error.contains("did you mean street?"), "{error}");
    for sun in ["0:30", "90,-3", "noon", "12:00,95"] {
        assert!(wrong(&["--sun", sun]).contains("--sun"), "{sun}");
    }
    assert!(wrong(&["--from", "1,2"]).contains("write a position"));
    assert!(wrong(&["--from", "1,2,3"]).contains("--to"));
    assert!(wrong(&["--haze", "0"]).contains("write a distance above 0"));
    assert!(wrong(&["--frames", "0:3", "--quality", "fine"]).contains("cannot be used with"));
}
