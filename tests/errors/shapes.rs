//! Errors and warnings of shapes: text, sweeps, trim planes, materials and repairs.

use std::fmt::Write as _;

use crate::support::{Folder, refused, without_columns};

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
        let _ = writeln!(script, "print({expression})");
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
    ]), @"");
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
    ]), @"");
}

#[test]
fn shapes_that_differ_from_the_request_are_warnings() {
    insta::assert_snapshot!(warnings(&[
        "text(\"a漢b\"):face_count()",
        "text(\"ע\"):face_count()",
        "square:sweep({ vec(0, 0, 0), vec(3, 0, 0), vec(3, 0.1, 0), vec(0, 0.1, 0) }):volume()",
        "cuboid(1, 1, 1):trim_to(square):volume()",
        "shape({ { 0, 0 }, { 9, 0.5 }, { 9, 1 } }):align():rectify(20):area()",
    ]), @"");
}
