//! Errors of geometry functions: texts, arguments and types.

use std::fmt::Write as _;

use crate::support::{printed, refused};

/// Returns the error messages for these expressions.
fn told(expressions: &[&str]) -> String {
    let mut text = String::new();
    for expression in expressions {
        let script = format!(
            "local lawn = geometry(\"POLYGON ((0 0, 4 0, 4 3, 0 0))\")\nlocal function ask(lawn: any)\n  return {expression}\nend\nask(lawn)\n"
        );
        let error = refused(&script);
        let lines: Vec<&str> = error.lines().filter(|line| !line.trim_start().starts_with('|')).collect();
        let _ = writeln!(text, "{expression}\n{}", lines.join("\n"));
    }
    text
}

#[test]
fn what_cannot_be_asked_of_a_geometry_is_told_with_what_to_do() {
    insta::assert_snapshot!(told(&[
        "geometry(\"POLYGON (0 0, 1 1)\")",
        "geometry(\"CIRCLE (1 2)\")",
        "geometry({ kind = \"blob\" })",
        "point(1)",
        "point(1, 0 / 0)",
        "line({ { 0, 0 } })",
        "line({ { 0, 0 }, { \"x\", 1 } })",
        "polygon({ { 0, 0 }, { 1, 1 } })",
        "lawn:buffr(1)",
        "lawn:buffer(1 / 0)",
        "lawn:buffer(1, { join = \"mitred\" })",
        "lawn:buffer(1, { joint = \"mitre\" })",
        "lawn:distance(\"far\")",
        "lawn:relate(lawn, \"TTT\")",
        "lawn:line_interpolate(0.5)",
        "line({ { 0, 0 }, { 1, 1 } }):line_substring(0.7, 0.2)",
        "lawn:random_point(2, 0)",
        "point(1, 2):inset(1)",
            ]), @r#"
    geometry("POLYGON (0 0, 1 1)")
    error: s.lua:3:18: geometry: invalid well-known text: expected "(" or EMPTY at character 10, found "0"
      help: write POINT (1 2), LINESTRING (0 0, 5 0) or POLYGON ((0 0, 4 0, 4 3, 0 0))
    geometry("CIRCLE (1 2)")
    error: s.lua:3:20: invalid well-known text: expected a geometry type at character 1, found "CIRCLE"
      help: write POINT (1 2), LINESTRING (0 0, 5 0) or POLYGON ((0 0, 4 0, 4 3, 0 0))
    geometry({ kind = "blob" })
    error: s.lua:3:29: geometry: what it is given must be a string such as "POINT (1 2)", a feature, or a table with rings or points, not {kind="blob"}
    point(1)
    error: s.lua:3:10: point takes 2 or 3 numbers, not 1
      help: write point(x, y), or point(x, y, height)
    point(1, 0 / 0)
    error: s.lua:3:10: point: y must be a finite number, not NaN
    line({ { 0, 0 } })
    error: s.lua:3:10: line needs at least 2 points, not 1
      help: write line({ { 0, 0 }, { 5, 0 } })
    line({ { 0, 0 }, { "x", 1 } })
    error: s.lua:3:30: line: point 2 must be a vector: { x, y, z } or vec(x, y, z), not {"x",1}
    polygon({ { 0, 0 }, { 1, 1 } })
    error: s.lua:3:10: polygon: its outer ring has fewer than 3 points
      help: write polygon({ { 0, 0 }, { 4, 0 }, { 4, 3 } })
    lawn:buffr(1)
    error: s.lua:3:15: unknown method or field `buffr` of geometry
      help: did you mean buffer?
    lawn:buffer(1 / 0)
    error: s.lua:3:15: geometry:buffer: distance must be a finite number, not infinity
      help: write geometry:buffer(distance: number, options: { [string]: any }?)
    lawn:buffer(1, { join = "mitred" })
    error: s.lua:3:35: geometry:buffer: unknown join "mitred"
      help: did you mean mitre?
    lawn:buffer(1, { joint = "mitre" })
    error: s.lua:3:27: unknown field `joint` in geometry:buffer
      help: did you mean join?
    lawn:distance("far")
    error: s.lua:3:25: geometry:distance: other must be a geometry: feature.geometry, point(x, y), line({ ... }), polygon({ ... }) or geometry("POINT (1 2)"), not "far"
      help: write geometry:distance(other: Geometry | { any })
    lawn:relate(lawn, "TTT")
    error: s.lua:3:29: geometry:relate: "TTT" is not a pattern of nine characters
      help: write one of *, T, F, 0, 1 and 2 for each cell: "F***1****"
    lawn:line_interpolate(0.5)
    error: s.lua:3:15: line_interpolate takes a line, not a polygon
      help: use one line of it: geometry_n, exterior_ring or segments
    line({ { 0, 0 }, { 1, 1 } }):line_substring(0.7, 0.2)
    error: s.lua:3:39: line_substring: 0.2 is before 0.7
      help: pass the smaller fraction first
    lawn:random_point(2, 0)
    error: s.lua:3:15: random_point takes two numbers from 0 to 1, not 2
      help: write geometry:random_point(random(), random())
    point(1, 2):inset(1)
    error: s.lua:3:22: inset takes areas, not a point
      help: buffer converts lines and points to an area
    "#);
}

#[test]
fn equal_geometries_are_equal_and_shown_as_text() {
    let lines = printed(
        "local a, b = geometry(\"LINESTRING (0 0, 5 0)\"), line({ { 0, 0 }, { 5, 0 } })\n\
         print(a == b, a ~= point(1, 2), a, a:equals(line({ { 5, 0 }, { 0, 0 } })))\n\
         local Post = module(\"Post\", \"at\")\n\
         local posts = lsystem({ object = extruder({}) })\n\
         posts:axiom(Post(a), Post(b))\n\
         posts:rule(\"Post(at)\", { when = function(this, at) return at == b and at.kind == \"line\" end }, function(this, at)\n\
           return Post(at:line_interpolate(0.5))\n\
         end)\n\
         print(posts:derive(1).chains[1])",
    );
    assert_eq!(lines, ["true\ttrue\tLINESTRING (0 0, 5 0)\ttrue", "Post(POINT (2.5 0)) Post(POINT (2.5 0))"]);
}
