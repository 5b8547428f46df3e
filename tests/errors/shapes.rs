//! Errors and warnings of shapes: text, sweeps, trim planes, materials and repairs.

use std::fmt::Write as _;

use crate::support::{Folder, refused, stopped, without_columns};

/// Returns the error messages for these expressions.
fn refusals(expressions: &[&str]) -> String {
    let mut text = String::new();
    for expression in expressions {
        let error =
            refused(&format!("local square = rectangle(1, 1)\nlocal made = {expression}\nprint(made)\n"));
        let lines: Vec<&str> = error.lines().filter(|line| !line.trim_start().starts_with('|')).collect();
        let _ = writeln!(text, "{expression}\n{}", lines.join("\n"));
    }
    text
}

/// Returns the warnings of these expressions.
fn warnings(expressions: &[&str]) -> String {
    let mut script =
        String::from("local A = module('A')\nlocal s = lsystem({ object = extruder() })\ns:axiom(A())\n");
    script.push_str("local square = rectangle(1, 1)\n");
    for expression in expressions {
        let _ = writeln!(script, "local _ = {expression}");
    }
    script.push_str("s:interpret('A', function(this) this:shape(square) end)\ns:derive()\n");
    let folder = Folder::new().with("s.lua", script);
    without_columns(&folder.warned(&["run", "s.lua", "-o", "s.glb"]))
}

#[test]
fn texts_that_cannot_be_made_are_refused() {
    insta::assert_snapshot!(refusals(&[
        "text()",
        "text(4)",
        "text(\"\")",
        "text(\"a\", { sise = 2 })",
        "text(\"a\", { size = 0 })",
        "text(\"a\", { align = \"middle\" })",
        "text(\"a\", { font = \"serif.ttf\" })",
        "font(\"s.lua\")",
        "font(\"missing.ttf\")",
    ]), @r#"
    text()
    error: s.lua:2:14: text takes 1 or 2 arguments, not 0
      help: write text("Bakery", { size = 0.4 })
    text(4)
    error: s.lua:2:14: text: letters must be a string, not 4
    text("")
    error: s.lua:2:14: the text has no letters
      help: give a text with a letter, and ask before: if name ~= "" then
    text("a", { sise = 2 })
    error: s.lua:2:26: unknown field `sise` in text
      help: did you mean size?
    text("a", { size = 0 })
    error: s.lua:2:14: text: size is 0 m
      help: use a length above 0 and below 1e7 m
    text("a", { align = "middle" })
    error: s.lua:2:35: text: unknown alignment "middle"
      help: use "left", "center" or "right"
    text("a", { font = "serif.ttf" })
    error: s.lua:2:34: text: font must be a font, loaded once before: font("sign.ttf"), not "serif.ttf"
    font("s.lua")
    error: s.lua:2:14: cannot read s.lua: the content is not a font: unknown magic
      help: use a .ttf or .otf file
    font("missing.ttf")
    error: s.lua:2:14: font not found: missing.ttf
      help: it is looked for from the script's folder; other folders are given with --data FOLDER
    "#);
}

#[test]
fn sweeps_and_images_that_cannot_be_made_are_refused() {
    insta::assert_snapshot!(refusals(&[
        "square:sweep({ vec(0, 0, 0) })",
        "square:sweep({ vec(0, 0, 0), vec(1, 0, 0), vec(0, 0, 0) })",
        "square:sweep({ vec(0, 0, 0), vec(1, 0, 0) }, { joint = \"round\" })",
        "square:sweep({ vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0) }, { closed = true, twist = 90 })",
        "square:sweep(square)",
        "square:rotate(90, vec(1, 0, 0)):sweep({ vec(0, 0, 0), vec(1, 0, 0) })",
        "square:project(0, 1)",
        "square:project(1, \"2*\")",
        "square:project(1, 1, { axes = \"zx\" })",
        "square:material({ roughness = 2 })",
        "square:smooth(-1)",
        "square:scatter(4, { within = \"volume\" })",
        "square:scatter(4, { within = \"inside\" })",
    ]), @r#"
    square:sweep({ vec(0, 0, 0) })
    error: s.lua:2:21: shape:sweep: the path of a sweep has 1 different points
      help: give at least 2
    square:sweep({ vec(0, 0, 0), vec(1, 0, 0), vec(0, 0, 0) })
    error: s.lua:2:21: shape:sweep: the path of a sweep turns back at point 2
      help: add points around the turn, or divide the path
    square:sweep({ vec(0, 0, 0), vec(1, 0, 0) }, { joint = "round" })
    error: s.lua:2:70: shape:sweep: unknown joint "round"
      help: use "mitre" or "smooth"
    square:sweep({ vec(0, 0, 0), vec(1, 0, 0), vec(1, 1, 0) }, { closed = true, twist = 90 })
    error: s.lua:2:21: shape:sweep: a closed path begins and ends with the same section
      help: use a twist of 0, 360 or -360 degrees and so on
    square:sweep(square)
    error: s.lua:2:21: shape:sweep: path must be a list of positions, such as { vec(0, 0, 1), vec(4, 0, 1) }, a curve or an edge, not a shape
      help: write shape:sweep(path: { Vector } | Curve | Shape, options: { [string]: any }?)
    square:rotate(90, vec(1, 0, 0)):sweep({ vec(0, 0, 0), vec(1, 0, 0) })
    error: s.lua:2:46: shape:sweep: the profile of a sweep is not horizontal
      help: draw it around the origin: disk(0.1), or shape({ { 0, 0 }, { 0.2, 0 }, { 0, 0.1 } })
    square:project(0, 1)
    error: s.lua:2:21: shape:project: width must be a length above 0 (m), or "~2" for whole tiles of about 2 m, not 0
      help: write shape:project(width: number | string, height: number | string, options: { [string]: any }?)
    square:project(1, "2*")
    error: s.lua:2:33: shape:project: height must be a length above 0 (m), or "~2" for whole tiles of about 2 m, not "2*"
      help: write shape:project(width: number | string, height: number | string, options: { [string]: any }?)
    square:project(1, 1, { axes = "zx" })
    error: s.lua:2:45: shape:project: unknown axes "zx"
      help: use "xy", "xz" or "yz"
    square:material({ roughness = 2 })
    error: s.lua:2:21: material: roughness must be from 0 to 1, not 2
    square:smooth(-1)
    error: s.lua:2:21: shape:smooth: the angle is -1 degrees
      help: use an angle from 0 to 180 degrees
    square:scatter(4, { within = "volume" })
    error: s.lua:2:21: shape:scatter: the shape is open, so it has no inside
      help: extrude faces first
    square:scatter(4, { within = "inside" })
    error: s.lua:2:44: shape:scatter: unknown place "inside"
      help: use within = "faces", "volume" or "scope"
    "#);
}

#[test]
fn shapes_that_differ_from_the_request_are_warnings() {
    insta::assert_snapshot!(warnings(&[
        "text(\"a漢b\"):face_count()",
        "text(\"ע\"):face_count()",
        "square:sweep({ vec(0, 0, 0), vec(3, 0, 0), vec(3, -0.1, 0), vec(0, -0.1, 0) }):volume()",
        "cuboid(1, 1, 1):trim_to(square):volume()",
        "square:reduce(0.1)",
    ]), @r#"
    warning: s.lua:5: text: the font lacks '漢', so boxes stand for them
      | local _ = text("a漢b"):face_count()
      help: use a font that has these letters: font("file.ttf")
    warning: s.lua:6: text: letters are placed from left to right without joining or reordering them
      | local _ = text("ע"):face_count()
      help: use letters of a script that needs neither, or import the text as a model
    warning: s.lua:6: text: the font lacks 'ע', so boxes stand for them
      | local _ = text("ע"):face_count()
      help: use a font that has these letters: font("file.ttf")
    warning: s.lua:7: shape:sweep: segment 2 of the path is too short for its joints, so the solid crosses itself; its tightest turn, at point 2, has a radius of 0.050 m
      | local _ = square:sweep({ vec(0, 0, 0), vec(3, 0, 0), vec(3, -0.1, 0), vec(0, -0.1, 0) }):volume()
      help: use a narrower profile, or a path that turns less sharply
    warning: s.lua:8: shape:trim_to: the face has no neighbours, so nothing is cut
      | local _ = cuboid(1, 1, 1):trim_to(square):volume()
      help: use a face that shape:faces or components took from a solid, or a part of it
    warning: s.lua:9: shape:reduce: 0.500 of the triangles remain, not 0.1, since no other can be removed
      | local _ = square:reduce(0.1)
      help: use a larger share, or a simpler shape
    "#);
}

#[test]
fn a_sweep_with_turns_tighter_than_the_profile_names_its_tightest_turn_once() {
    insta::assert_snapshot!(warnings(&[
        "square:sweep({ vec(0, 0, 0), vec(3, 0, 0), vec(3, -1, 0), vec(0, -1, 0) }, { joint = \"smooth\" }):volume()",
        "square:sweep({ vec(0, 0, 0), vec(3, 0, 0) }, { twist = 720 }):volume()",
    ]), @r#"
    warning: s.lua:5: shape:sweep: 14 segments of the path, first 8, 9, 10, 11, 12, are too short for their joints, so the solid crosses itself; its tightest turn, at point 10, has a radius of 0.276 m
      | local _ = square:sweep({ vec(0, 0, 0), vec(3, 0, 0), vec(3, -1, 0), vec(0, -1, 0) }, { joint = "smooth" }):volume()
      help: use a narrower profile, or a path that turns less sharply
    warning: s.lua:6: shape:sweep: the profile twists by about 720 degrees from one point of the path to the next
      | local _ = square:sweep({ vec(0, 0, 0), vec(3, 0, 0) }, { twist = 720 }):volume()
      help: add points to the path, so that it twists by at most 90 degrees between them
    "#);
}

#[test]
fn text_that_is_not_utf_8_and_methods_of_other_names_are_refused_with_their_own_name() {
    insta::assert_snapshot!(refusals(&[
        "text(\"Caf\\xe9\")",
        "square:roof({ kind = \"gabled\", slope = 95 })",
        "square:roof({ kind = \"onion\", overhang = 1 })",
    ]), @r#"
    text("Caf\xe9")
    error: s.lua:2:14: text: character 4 of the text is no letter: its bytes are not UTF-8
      help: save the script or the data as UTF-8, and take parts of a text with utf8.offset
    square:roof({ kind = "gabled", slope = 95 })
    error: s.lua:2:21: shape:roof: slope is 95 degrees
      help: give degrees above 0, up to 85
    square:roof({ kind = "onion", overhang = 1 })
    error: s.lua:2:21: shape:roof: an onion roof has no overhang
      help: omit overhang
    "#);
}

#[test]
fn holes_turns_and_mapped_roofs_that_cannot_be_made_are_refused() {
    insta::assert_snapshot!(refusals(&[
        "revolve()",
        "revolve({ { -1, 0 }, { 2, 0 }, { 2, 3 } })",
        "revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { sides = 2 })",
        "revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { angle = 400 })",
        "revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { turn = 90 })",
        "cuboid(1, 1, 1):cut_hole({ { 0, 0 }, { 1, 0 }, { 1, 1 } })",
        "square:cut_hole({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } })",
        "square:cut_hole(4)",
        "square:roof({ ridges = { { 0, 0.5 }, { 1, 0.5 } } })",
        "square:roof({ apexes = 3 })",
        "square:roof({ apexes = { { 0.5, 0.5, 5000 } } })",
        "square:roof({ levels = 0 })",
    ]), @r#"
    revolve()
    error: s.lua:2:14: revolve takes 1 or 2 arguments, not 0
      help: write revolve({ { 0, 0 }, { 2, 0 }, { 1, 3 }, { 0, 3 } }, { sides = 24 })
    revolve({ { -1, 0 }, { 2, 0 }, { 2, 3 } })
    error: s.lua:2:14: revolve: the outline crosses the axis at (-1, 0)
      help: give points with x from 0, the distance from the axis
    revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { sides = 2 })
    error: s.lua:2:14: revolve: the number of sides is 2
      help: use 3 to 1024
    revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { angle = 400 })
    error: s.lua:2:14: revolve: the angle is 400 degrees
      help: use degrees above 0, up to 360
    revolve({ { 0, 0 }, { 2, 0 }, { 2, 3 } }, { turn = 90 })
    error: s.lua:2:58: unknown field `turn` in revolve
      help: it has axis, angle, sides, tile
    cuboid(1, 1, 1):cut_hole({ { 0, 0 }, { 1, 0 }, { 1, 1 } })
    error: s.lua:2:30: shape:cut_hole: cut_hole takes one face, and the shape has 6
      help: use its faces: shape:faces("top")
    square:cut_hole({ { 0, 0 }, { 1, 1 }, { 1, 0 }, { 0, 1 } })
    error: s.lua:2:21: shape:cut_hole: the outer ring of the polygon has no area
      help: move a point off the line of the others
    square:cut_hole(4)
    error: s.lua:2:21: shape:cut_hole: hole must be an outline, such as { { 1, 1 }, { 2, 1 }, { 2, 2.5 } }, a polygon or a shape, not 4
      help: write shape:cut_hole(hole: { Vector } | Geometry | Shape)
    square:roof({ ridges = { { 0, 0.5 }, { 1, 0.5 } } })
    error: s.lua:2:21: shape:roof: ridges must be a list of lines, such as { { { 0, 4 }, { 12, 4 } } }, not a list whose item 1 is not a line
      help: write shape:roof(options: { [string]: any }?)
    square:roof({ apexes = 3 })
    error: s.lua:2:21: shape:roof: apexes must be a list of points, such as { { 6, 4 }, { 9, 4, 3.5 } }, not 3
      help: write shape:roof(options: { [string]: any }?)
    square:roof({ apexes = { { 0.5, 0.5, 5000 } } })
    error: s.lua:2:21: shape:roof: the height of a point is 5000 m
      help: give metres above 0, up to 2000
    square:roof({ levels = 0 })
    error: s.lua:2:21: shape:roof: levels is 0
      help: give a number of storeys above 0, up to 20
    "#);
}

#[test]
fn holes_beside_a_face_and_lines_that_a_roof_cannot_use_are_warned_of() {
    insta::assert_snapshot!(warnings(&[
        "square:cut_hole({ { 3, 0 }, { 4, 0 }, { 4, 1 } })",
        "square:roof({ ridges = { { { 0.2, 0.5 }, { 4, 0.5 } } } })",
        "square:roof({ ridges = { { { 0.2, 0.5 }, { 0.8, 0.5 } }, { { 0.5, 0.2 }, { 0.5, 0.8 } } } })",
        "square:roof({ edges = { {}, { { 0.3, 0.4 }, { 0.6, 0.4 } } }, apexes = { { 0.2, 0.5 }, { 9, 9 } } })",
    ]), @r#"
    warning: s.lua:5: shape:cut_hole: the hole is beside the face, so nothing is cut
      | local _ = square:cut_hole({ { 3, 0 }, { 4, 0 }, { 4, 1 } })
      help: give the outline in the scope of the face: x to the right and y upwards from its corner (m)
    warning: s.lua:6: shape:roof: ridge 1 leaves the plan at (4.00, 0.50) and is left out
      | local _ = square:roof({ ridges = { { { 0.2, 0.5 }, { 4, 0.5 } } } })
      help: end the line at the outline of the plan
    warning: s.lua:7: shape:roof: ridge 2 crosses another line at (0.50, 0.50) and is left out
      | local _ = square:roof({ ridges = { { { 0.2, 0.5 }, { 0.8, 0.5 } }, { { 0.5, 0.2 }, { 0.5, 0.8 } } } })
      help: give both lines a point where they cross
    warning: s.lua:8: shape:roof: apex 2 leaves the plan at (9.00, 9.00) and is left out
      | local _ = square:roof({ edges = { {}, { { 0.3, 0.4 }, { 0.6, 0.4 } } }, apexes = { { 0.2, 0.5 }, { 9, 9 } } })
      help: end the line at the outline of the plan
    warning: s.lua:8: shape:roof: edge 1 has fewer than two different points and is left out
      | local _ = square:roof({ edges = { {}, { { 0.3, 0.4 }, { 0.6, 0.4 } } }, apexes = { { 0.2, 0.5 }, { 9, 9 } } })
      help: give at least two points
    warning: s.lua:8: shape:roof: edge 2 at (0.30, 0.40) has no height, as it meets no other line, and is left out
      | local _ = square:roof({ edges = { {}, { { 0.3, 0.4 }, { 0.6, 0.4 } } }, apexes = { { 0.2, 0.5 }, { 9, 9 } } })
      help: join the edge to a ridge or to the outline, or give its points a height
    "#);
}

#[test]
fn sizes_heights_and_distances_that_cannot_be_used_are_warnings() {
    insta::assert_snapshot!(warnings(&[
        "cuboid(4, 3, 2):split(\"x\", { -1, \"~1\" })",
        "shape({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 1 }, { 0, 1, 0 } }):area()",
        "cuboid(1, 1, 1):fillet(0.7):volume()",
        "cuboid(4, 3, 1):chamfer(0.3, \"corner\"):volume()",
        "rectangle(4, 4):molding({ vec(0, 0, 0), vec(-3, 0, 0), vec(-3, 1, 0), vec(0, 1, 0) }):volume()",
    ]), @r#"
    warning: s.lua:5: shape:split: 1 size is below 0, so no parts are made for them
      | local _ = cuboid(4, 3, 2):split("x", { -1, "~1" })
      help: give sizes from 0, such as math.max(0, size)
    warning: s.lua:6: shape: the points of an outline that is not upright are moved to the height 0 m
      | local _ = shape({ { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 1 }, { 0, 1, 0 } }):area()
      help: give the height after the points: shape({ { 0, 0 }, { 8, 0 }, { 8, 5 } }, height)
    warning: s.lua:7: shape:fillet: 12 edges are on faces that are too narrow, so that cuts meet there
      | local _ = cuboid(1, 1, 1):fillet(0.7):volume()
      help: use a smaller distance, or cut off edges of one kind
    warning: s.lua:9: shape:molding: the profile is too wide for edge 1 and 3 more, so the solid crosses itself
      | local _ = rectangle(4, 4):molding({ vec(0, 0, 0), vec(-3, 0, 0), vec(-3, 1, 0), vec(0, 1, 0) }):volume()
      help: use a profile that is narrower on the inside of the corners
    "#);
}

#[test]
fn faces_that_touch_themselves_are_drawn_but_have_no_skeleton() {
    let touching = "rectangle(4, 4):cut_hole({ { 0, 2 }, { 1, 1 }, { 2, 2 }, { 1, 3 } })";
    insta::assert_snapshot!(refusals(&[
        &format!("{touching}:roof({{ height = 1 }})"),
        &format!("{touching}:setback(0.1)"),
    ]), @r#"
    rectangle(4, 4):cut_hole({ { 0, 2 }, { 1, 1 }, { 2, 2 }, { 1, 3 } }):roof({ height = 1 })
    error: s.lua:2:83: shape:roof: the outline of the face touches itself or a hole at (0.00, 2.00, 0.00)
      help: move the hole by a centimetre: inwards, or over the edge of the face
    rectangle(4, 4):cut_hole({ { 0, 2 }, { 1, 1 }, { 2, 2 }, { 1, 3 } }):setback(0.1)
    error: s.lua:2:83: shape:setback: the outline of the face touches itself or a hole at (0.00, 2.00, 0.00)
      help: move the hole by a centimetre: inwards, or over the edge of the face
    "#);
    let script = format!(
        "local A = module('A')\nlocal s = lsystem({{ object = extruder() }})\ns:axiom(A())\n\
         s:interpret('A', function(this) this:shape({touching}:extrude(1)) end)\ns:derive()\n"
    );
    let folder = Folder::new().with("s.lua", script);
    let done = folder.burgeon(&["run", "s.lua", "-o", "s.glb"]).done();
    assert!(!done.stderr.contains("warning"), "{}", done.stderr);
}

#[test]
fn shapes_beyond_the_range_of_coordinates_are_refused_with_their_rule() {
    let script = "local A = module('A')\nlocal s = lsystem({ object = extruder() })\ns:axiom(A())\n\
        s:interpret('A', function(this) this:shape(cuboid(1, 1, 1):translate({ 1e300, 0, 0 })) end)\ns:derive()\n";
    insta::assert_snapshot!(refused(script), @r#"
    error: s.lua:4:38: rule A (interpretation): the shape is more than 1e12 m away or large, beyond the range of coordinates
      | s:interpret('A', function(this) this:shape(cuboid(1, 1, 1):translate({ 1e300, 0, 0 })) end)
      |                                      ^^^^^
      module: A, step 0
      help: draw it near the origin: look for an offset or a size that grows
    "#);
}

#[test]
fn a_set_operation_of_large_solids_ends_with_the_time_limit() {
    let script = "local ball = ball(4, 900)\nprint(ball:subtract(ball:translate({ 0.5, 0.3, 0.2 })))\n";
    let text = stopped(script, &["--time-limit", "1"]);
    assert!(text.contains("the run exceeded the time limit of 1 s"), "{text}");
}
