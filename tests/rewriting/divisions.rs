//! Rules that only divide a shape, which are applied without Lua, against the same rules with a condition, which Lua applies.

use super::scripts::{chain, error, run};

/// Rules with the body of the last one, once as it is and once with a condition.
fn both(axiom: &str, body: &str) -> [String; 2] {
    ["", "if s then end "].map(|condition| {
        format!(
            r##"
            local Mass, Part, Row = module("Mass", "s", "a?", "b?"), module("Part", "s", "a?", "b?"), module("Row", "s")
            local height, sizes = param("height", {{ default = 2.5 }}), {{ low = 1, list = {{ 3 }} }}
            local town = lsystem({{ object = extruder() }})
            town:axiom({axiom})
            town:rule("Mass(s, a, b)", function(this, s, a, b) {condition}{body} end)
            town:rule("Row(s)", function(this, s) return split(s, "x", {{ {{ "~1*", Part, 5 }} }}) end)
            town:derive(3)"##
        )
    })
}

#[test]
fn a_rule_makes_the_same_modules_without_lua() {
    for (axiom, body) in [
        ("Mass(cuboid(6, 4, 10))", r#"return split(s, "z", { { 4, Part }, { 1, false }, { "~2*", Row } })"#),
        (
            "Mass(cuboid(6, 4, 10), \"red\", 3), Mass(cuboid(5, 5, 5), 7, false)",
            r#"local h = height / 2 return split(s, "z", { { h, Part, a }, { sizes.low, Part, b, a }, { `~{h}*`, Part, "x", true } })"#,
        ),
        (
            "Mass(cuboid(6, 4, 10)), Mass(cylinder(3, 4, 7))",
            r#"return components(s, "faces", { { "top", Part, sizes.list[1] }, { "side", Row }, { "bottom", false } })"#,
        ),
        (
            "Mass(rectangle(6, 4):tag(\"wall\"))",
            r##"return components(s:recess(0.2):color("#ff0000"), "faces", { { "tag:recess.back", Part }, { "tag:recess.side", Row } })"##,
        ),
        (
            "Mass(cuboid(1, 2, 3))",
            r#"return components(s, "edges", { { "corner", Part }, { "border", Part } })"#,
        ),
        ("Mass(cuboid(6, 4, 10))", r#"return split(s, "z", { { { "~1", Part }, { 1, Row } } })"#),
        (
            "Mass(cuboid(6, 4, 10), 1, \"low\")",
            r#"return split(s, "z", { { "~4", Part, sizes.list[a], sizes[b] } })"#,
        ),
        (
            "Mass(cuboid(6, 4, 10), 3, \"x\")",
            r#"return split(s, "z", { { "~4", Part, `{a} m`, b .. "y" } })"#,
        ),
        ("Mass(rectangle(6, 4), 2)", r#"return split(s:extrude(a, nil), "z", { { "~1", Part, -a, s } })"#),
        ("Mass(rectangle(6, 4))", r#"return split(s:extrude(2, vec(0, 0, 1)), "z", { { "~1", Part } })"#),
    ] {
        let [quick, by_lua] = both(axiom, body).map(|script| chain(&script));
        assert_eq!(quick, by_lua, "{body}");
        assert!(quick.contains("Part(") && !quick.contains("Mass("), "{body}: {quick}");
    }
}

#[test]
fn a_rule_warns_and_fails_at_its_line_without_lua_too() {
    for (axiom, body) in [
        ("Mass(cuboid(6, 4, 10))", r#"return split(s, "z", { { 4, Part }, { 1, Row } })"#),
        ("Mass(cuboid(6, 4, 10))", r#"return split(s, "z", { { 14, Part } })"#),
    ] {
        let [quick, by_lua] = both(axiom, body).map(|script| {
            let warnings = run(&script).warnings;
            let texts = warnings.iter().map(ToString::to_string).map(without_folder);
            texts.filter(|text| text.contains("shape:split")).collect::<Vec<_>>()
        });
        assert_eq!((quick.len(), &quick), (1, &by_lua), "{body}");
    }
    for (axiom, body) in [
        ("Mass(rectangle(6, 4))", r#"return split(s, "z", { { 4, Part } })"#),
        ("Mass(cuboid(6, 4, 2)), Mass(3)", r#"return split(s, "z", { { 1, Part } })"#),
        ("Mass(cuboid(6, 4, 2))", r#"return split(s:extrude(2), "z", { { 1, Part } })"#),
        ("Mass(cuboid(6, 4, 2))", r#"return split(s, "w", { { 1, Part } })"#),
        ("Mass(cuboid(6, 4, 2))", r#"return components(s, "faces", { { "tpo", Part } })"#),
        ("Mass(cuboid(6, 4, 2), 3)", r#"return split(s, "z", { { 1, Part, 1, 2, 3 } })"#),
    ] {
        let [quick, by_lua] = both(axiom, body).map(|script| without_folder(error(&script)));
        assert_eq!(quick, by_lua, "{body}");
    }
}

#[test]
fn a_variable_that_a_hook_changes_is_read_in_each_step() {
    let script = r#"
        local Mass, Part, size = module("Mass", "s"), module("Part", "s"), variables({ of = 1 })
        local town = lsystem({ object = extruder(), variables = size })
        town:axiom(Mass(cuboid(1, 1, 8)))
        town:before_step(function() size.of += 1 end)
        town:rule("Mass(s)", function(this, s) return split(s, "z", { { size.of, Part }, { "~1", Mass } }) end)
        town:derive(2)"#;
    assert_eq!(chain(script), "Part(box of 1 x 1 x 2 m) Part(box of 1 x 1 x 3 m) Mass(box of 1 x 1 x 3 m)");
}

/// Returns a message without the folder of its file.
fn without_folder(message: String) -> String {
    message.split_once("main.lua").map(|(_, rest)| rest.to_owned()).unwrap_or(message)
}
