//! Facades that can never fit or are not what they seem are refused where they are made.

use crate::support::*;

/// What a script says that ends with `expression`, without the line itself.
fn told(expression: &str) -> String {
    let script = format!(
        "local wall = panel({{ width = {{ 1, 2 }}, height = {{ 3, 3 }} }})\nlocal made = {expression}\n"
    );
    let told = refused(&script);
    told.lines().filter(|line| !line.starts_with("  |")).collect::<Vec<_>>().join("\n")
}

#[test]
fn walls_and_templates_are_checked_when_they_are_made() {
    let cases = [
        "panel({ widht = 2 })",
        "panel({ width = { 3, 2 } })",
        "panel({ model = wall })",
        "panel({ at = \"middle\" })",
        "bordered(wall, { left = { 0.5, \"most\" } })",
        "bordered(wall, { left = 2, width = { 1, 2 } })",
        "bordered({ left = 0.5 })",
        "extruded(wall, { depth = 1000 })",
        "extruded(wall, { depth = 0 / 0 })",
        "list({ wall, panel({ height = { 4, 5 } }) })",
        "list({ wall, 7 })",
        "list({ wall }, { direction = \"upwards\" })",
        "grid(wall, { columns = { 0, 4 } })",
        "grid(wall, { rows = 2.5 })",
        "template({ wall = wall, keywords = \"blind\" })",
        "template({ wall = wall, weight = -1 })",
        "facade({})",
        "facade({ wall })",
    ];
    let all: Vec<String> = cases.iter().map(|case| format!("{case}\n{}", told(case))).collect();
    insta::assert_snapshot!(all.join("\n\n"), @"");
}

#[test]
fn walls_take_templates_or_a_photo() {
    let told = |walls: &str| {
        let script = format!(
            "local House = module(\"House\")\nlocal s = lsystem({{ object = footprint({{ {{ 0, 0 }}, {{ 8, 0 }}, {{ 8, 8 }} }}) }})\n\
             s:axiom(House())\ns:interpret(\"House\", function(this)\n  this:walls({walls})\nend)\ns:derive()\n"
        );
        refused(&script)
    };
    insta::assert_snapshot!(told("{ height = 3, templates = { 7 } }"), @"");
    insta::assert_snapshot!(
        told("{ height = 3, templates = template({ wall = panel({}) }), photo = { texture = \"front.jpg\" } }"), @""
    );
    insta::assert_snapshot!(told("{ height = 3, photo = { texture = \"front.jpg\" } }"), @"");
}
