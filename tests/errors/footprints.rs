//! Tests of footprints, walls and roofs that cannot be built.

use crate::support::refused;

/// Returns the error message for a house over `rings`, drawn by `draw`.
fn house(rings: &str, draw: &str) -> String {
    refused(&format!(
        "local H = module(\"H\")\nlocal s = lsystem({{ object = footprint({rings}) }}) s:axiom(H())\n\
         s:interpret(\"H()\", function(this) {draw} end)\ns:derive()\n"
    ))
}

const SQUARE: &str = "{ { 0, 0 }, { 8, 0 }, { 8, 8 }, { 0, 8 } }";

#[test]
fn a_plan_that_is_none_is_refused_with_the_place() {
    let mut count = 0;
    for (rings, words) in [
        ("{ { 0, 0 }, { 8, 0 } }", "the outer ring of the footprint has 2 distinct points"),
        ("{ { 0, 0 }, { 4, 0 }, { 8, 0 } }", "the outer ring of the footprint has no area"),
        ("{ { 0, 0 }, { 8, 0/0 }, { 8, 8 } }", "must be"),
        ("{ { 0, 0 }, { 8, 0 }, { 8, 1e12 } }", "point 3 of the outer ring of the footprint"),
        (
            "{ { { 1, 1 }, { 2, 1 }, { 1, 2 } }, { { 0, 0 }, { 8, 0 }, { 8, 8 }, { 0, 8 } } }",
            "hole 1 of the footprint is outside",
        ),
        ("{ kind = \"line\", points = {} }", "a geometry of kind \"line\""),
        ("5", "geometry must be a polygon"),
        ("{ { 0, 0 }, { 8, 0 }, { 0, 8 } }, { hieght = 3 }", "did you mean height?"),
        ("{ { 0, 0 }, { 8, 0 }, { 0, 8 } }, { height = -3 }", "footprint: height is -3 m"),
    ] {
        let said = house(rings, "this:walls({ height = 3 })");
        assert!(said.contains(words), "{words}: {said}");
        count += 1;
    }
    assert_eq!(count, 9);
}

#[test]
fn walls_and_roofs_that_cannot_be_are_refused_with_a_remedy() {
    let mut count = 0;
    for (draw, words) in [
        ("this:walls()", "missing height of the walls or the footprint"),
        ("this:walls({ height = 0 })", "height is 0 m"),
        ("this:walls({ height = -2 })", "height is -2 m"),
        ("this:walls({ height = 1e6 })", "up to 2000"),
        ("this:walls({ height = 0/0 })", "height must be a finite number, not NaN"),
        ("this:roof({ kind = \"mansrad\" })", "did you mean mansard?"),
        ("this:roof({ kind = \"hip\", slope = 90 })", "slope is 90 degrees"),
        ("this:roof({ kind = \"hip\" }) this:walls({ height = 3 })", "already has a roof"),
        ("this:groundwork(\"zmin\")", "did you mean z_min?"),
        ("this:walls({ height = 3 }) this:groundwork(\"z_min\")", "call groundwork first"),
        ("this:roof({ overhang = -1 })", "overhang is -1 m"),
        ("this:roof({ levels = 0 })", "levels is 0"),
        ("this:roof({ ridges = { { 0, 4 }, { 8, 4 } } })", "ridges must be a list of lines"),
        ("this:roof({ apexes = { { 4, 4, 1e5 } } })", "the height of a point is 100000 m"),
    ] {
        let said = house(SQUARE, draw);
        assert!(said.contains(words) && said.contains("s.lua:3"), "{words}: {said}");
        count += 1;
    }
    assert_eq!(count, 14);
}
