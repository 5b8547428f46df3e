//! Interpretation passes: law 6 of the design, and values that rules read from objects.

use burgeon::script::{FileLimit, Print};

use super::scripts::{chain, divided, error, lines, run, run_with, try_run};

const HEAD: &str = r#"
    local F = module("F", "l"); local T = module("T", "a"); local Ask = module("Ask"); local Say = module("Say", "x", "y", "z")
    local Wait = module("Wait", "n")
    local s = lsystem { object = turtle { angle = 90, width = 0.01 } }
    s:interpret("F(l)", function(this, l) this:forward(l) end)
    s:interpret("T(a)", function(this, a) this:turn(a) end)
    local function place(this)
      local p = this:position()
      local function round(x) return math.round(x * 1000) / 1000 + 0 end
      return Say(round(p.x), round(p.y), round(p.z))
    end
"#;

#[test]
fn a_rule_reads_the_place_of_its_module() {
    let text = chain(&format!(
        "{HEAD}
        s:axiom(F(1), Ask(), F(2), Ask())
        s:rule(\"Ask\", function(this) return place(this) end)
        s:rule(\"F(l)\", function(this, l) return F(l * 10) end)
        s:derive(1)"
    ));
    // The places are those in the axiom, before the first step.
    assert_eq!(text, "F(10) Say(0,0,1) F(20) Say(0,0,3)");
}

#[test]
fn each_step_sees_the_pass_over_the_chain_of_the_step_before() {
    let text = chain(&format!(
        "{HEAD}
        s:axiom(F(1), Wait(3))
        s:rule(\"Wait(n)\", function(this, n) if n > 0 then return place(this), Wait(n - 1) end end)
        s:rule(\"F(l)\", function(this, l) return F(l * 2) end)
        s:derive(3)"
    ));
    assert_eq!(text, "F(8) Say(0,0,1) Say(0,0,2) Say(0,0,4) Wait(0)");
}

#[test]
fn guards_read_the_object_too() {
    let text = chain(&format!(
        "{HEAD}
        s:axiom(F(1), Ask(), F(1))
        s:rule(\"Ask\", {{ when = function(this) return this:position().z >= 4 end }}, function(this) return place(this) end)
        s:rule(\"F(l)\", {{ when = function(this, l) return this:position().z < 6 end }}, function(this, l) return F(l * 2) end)
        s:derive(10)"
    ));
    // The first F is always at 0, the last one ends when it begins above 6.
    assert_eq!(text, "F(1024) Say(0,0,4) F(8)");
}

#[test]
fn however_a_rule_gets_at_its_object_it_reads_the_place() {
    let mut wrong = Vec::new();
    for rule in [
        "s:rule(\"Ask\", function(this) return place(this) end)",
        "s:rule(\"Ask\", function(...) return place(...) end)",
        "s:rule(\"Ask\", function(...) local object = select(1, ...) return place(object) end)",
        "local function f(this) return place(this) end s:rule(\"Ask\", f)",
        "s:rule(\"Ask\", place)",
        "s:rule(\"Ask\", function(o) local p = o:position() return Say(0, 0, p.z) end)",
        "s:rule(\"Ask\", [[ return Say(0, 0, this:position().z) ]])",
        "s:rule(\"Ask\", function(this) local function inner() return this:position().z end return Say(0, 0, inner()) end)",
        "s:rule(\"Ask\", { when = place }, function(this) return place(this) end)",
        "s:rule(\"Ask\", { when = function(...) return (...):position().z == 3 end }, function() return Say(0, 0, 3) end)",
    ] {
        let text = chain(&format!("{HEAD} s:axiom(F(3), Ask()) {rule} s:derive(1)"));
        if text != "F(3) Say(0,0,3)" {
            wrong.push(format!("{rule}: {text}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn modules_are_interpreted_in_the_order_of_the_chain() {
    for (axiom, expected) in [
        ("F(1), T(90), F(2)", "Say(2,0,1)"),
        ("T(90), F(1), F(2)", "Say(3,0,0)"),
        ("F(1), F(2), T(90)", "Say(0,0,3)"),
        ("F(1), T(180), F(3)", "Say(0,0,-2)"),
    ] {
        let text = chain(&format!(
            "{HEAD} s:axiom({axiom}, Ask()) s:rule(\"Ask\", function(this)
               local p = this:position() return Say(math.abs(math.round(p.x)), math.round(p.y), math.round(p.z))
             end) s:derive(1)"
        ));
        let last = text.rsplit_once("Say").map(|(_, last)| format!("Say{last}")).unwrap_or_default();
        assert_eq!(last.replace("-0", "0"), expected, "{axiom}");
    }
}

#[test]
fn a_branch_pushes_and_pops_the_frame() {
    for (axiom, expected) in [
        ("F(1), { F(5) }, F(2)", 3),
        ("{ F(5) }, F(1)", 1),
        ("F(1), { F(1), { F(1), { F(1) } }, F(9) }, { T(90), F(4) }, F(1)", 2),
        ("F(2), {}, { {} }", 2),
        ("{ T(180) }, F(3)", 3),
    ] {
        let text = chain(&format!(
            "{HEAD} s:axiom({axiom}, Ask()) s:rule(\"Ask\", function(this) return place(this) end) s:derive(1)"
        ));
        assert!(text.ends_with(&format!(" Say(0,0,{expected})")), "{axiom}: {text}");
    }
}

#[test]
fn a_drawing_object_begins_each_pass_empty() {
    let draw = |steps: usize| {
        let run = run(&format!(
            "{HEAD}
            s:axiom(F(1), Ask())
            s:rule(\"Ask\", function(this) return F(this:position().z - this:position().z + 1), Ask() end)
            s:derive({steps})"
        ));
        run.scene.triangles()
    };
    let cold = |count: usize| {
        let list = vec!["F(1)"; count].join(", ");
        run(&format!("{HEAD} s:axiom({list}) s:derive(0)")).scene.triangles()
    };
    assert!(cold(3) > 0);
    assert_eq!(draw(2), cold(3));
    assert_eq!(draw(6), cold(7));
}

#[test]
fn the_scene_is_the_interpretation_of_the_last_chain() {
    let run = run(&format!(
        "{HEAD}
        s:axiom(F(100), {{ F(50) }})
        s:rule(\"F(l)\", function(this, l) return F(l / 10) end)
        s:derive(2)"
    ));
    let (low, high) = run.scene.bounds().expect("something is drawn");
    assert!((high.z - low.z - 1.5).abs() < 1e-6, "{low} {high}");
}

#[test]
fn interpret_last_runs_only_the_last_pass() {
    let text = chain(
        r#"
        local F = module("F", "l"); local Ask = module("Ask", "z")
        local s = lsystem { object = turtle {}, interpret = "last" }
        s:axiom(F(1), Ask(0))
        s:rule("F(l)", function(_, l) return F(l + 1) end)
        s:interpret("F(l)", function(this, l) this:forward(l) end)
        local derived = s:derive(2)
        local p = derived.objects[1]:position().z
        local t = lsystem {}
        t:axiom(Ask(p))
        t:derive(0)
        "#,
    );
    assert_eq!(text, "Ask(3)");
    let told = error(
        r#"
        local F = module("F", "l"); local Ask = module("Ask", "z")
        local s = lsystem { object = turtle {}, interpret = "last" }
        s:axiom(F(3), Ask(7))
        s:rule("Ask", function(this) return Ask(this:position().z) end)
        s:interpret("F(l)", function(this, l) this:forward(l) end)
        s:derive(2)
        "#,
    );
    assert!(
        told.contains("position is unknown in a rule, because only the last chain is interpreted"),
        "{told}"
    );
}

#[test]
fn the_axiom_is_interpreted_even_without_a_step() {
    let run = run(&format!("{HEAD} s:axiom(F(2)) s:derive(0)"));
    let (_, high) = run.scene.bounds().expect("something is drawn");
    assert!((high.z - 2.0).abs() < 1e-9);
}

#[test]
fn an_interpretation_that_fails_in_an_early_pass_fails_where_that_pass_is_made() {
    for steps in [1, 2] {
        let script = |returned: &str| {
            format!(
                "{HEAD}
                s:axiom(Wait(1))
                s:rule(\"Wait(n)\", function(this, n) return {returned} end)
                s:interpret(\"Wait(n)\", function(this, n) error(\"too early\") end)
                s:derive({steps})"
            )
        };
        let told = error(&script("F(this:position().z)"));
        assert!(told.contains("too early") && told.contains("Wait(1), step 0"), "{told}");
        assert_eq!(chain(&script("F(n)")), "F(1)");
    }
}

#[test]
fn interpretation_leaves_the_chain_as_it_is() {
    let text = chain(&format!("{HEAD} s:axiom(F(1), {{ T(30), F(2) }}, Ask()) s:derive(3)"));
    assert_eq!(text, "F(1) [ T(30) F(2) ] Ask");
}

#[test]
fn every_chain_has_an_object_of_its_own() {
    let script = format!(
        "{HEAD}
        s:axiom(source {{ {{ z = 10 }}, {{ z = 20 }}, {{ z = 30 }} }}, function(feature)
          return turtle {{ position = {{ 0, 0, feature.z }}, width = 0.01 }}, F(feature.z / 10), {{ F(100) }}, Ask()
        end)
        s:rule(\"Ask\", function(this) return place(this) end)
        s:derive(1)"
    );
    let expected =
        ["F(1) [ F(100) ] Say(0,0,11)", "F(2) [ F(100) ] Say(0,0,22)", "F(3) [ F(100) ] Say(0,0,33)"];
    for (threads, batch) in [(1, 4096), (1, 1), (2, 1), (7, 2)] {
        let run = run_with(&script, divided(threads, batch));
        assert_eq!(lines(&run), expected, "{threads} threads and batches of {batch}");
        assert_eq!(run.systems[0].objects.len(), 3);
    }
}

#[test]
fn a_chain_without_its_own_object_gets_a_copy_of_the_systems() {
    let text = lines(&run(&format!(
        "{HEAD}
        s:axiom(source {{ {{ n = 1 }}, {{ n = 2 }} }}, function(feature) return F(feature.n), Ask() end)
        s:rule(\"Ask\", function(this) return place(this) end)
        s:derive(1)"
    )));
    assert_eq!(text, ["F(1) Say(0,0,1)", "F(2) Say(0,0,2)"]);
}

#[test]
fn an_interpretation_reads_its_object_in_the_middle_of_the_pass() {
    // Calls are recorded and applied later; a read method must observe all earlier calls.
    let script = r#"
        local F = module("F", "l"); local Mirror = module("Mirror"); local Ask = module("Ask", "z")
        local s = lsystem { object = turtle {} }
        s:axiom(F(1), Mirror(), F(0.5), { F(2), Mirror() }, Mirror(), Ask(0))
        s:interpret("F(l)", function(this, l) this:forward(l) end)
        s:interpret("Mirror", function(this) local z = this:position().z this:advance(z) this:advance(this:position().z) end)
        s:rule("Ask", function(this) return Ask(this:position().z) end)
        s:derive(1)
    "#;
    // The length is 1, doubled twice 4, then 4.5, then a branch, then doubled twice 18.
    assert!(chain(script).ends_with("Ask(18)"), "{}", chain(script));
}

#[test]
fn parameters_of_every_kind_reach_interpretations() {
    let run = run(r##"
        local P = module("P", "x", "y?", "z?"); local s = lsystem { object = turtle {} }
        s:axiom(P({ 1, 2, 3 }), P(true, "text"), P("#ff0000"), P(2))
        s:interpret("P(x, y, z)", function(this, x, y, z)
          assert(z == nil)
          if type(x) == "table" then assert(table.isfrozen(x)) this:jump(x)
          elseif x == true then assert(y == "text") this:face({ 1, 0, 0 })
          elseif type(x) == "string" then assert(y == nil) this:color(x)
          else this:forward(x) end
        end)
        local derived = s:derive()
        local p = derived.objects[1]:position()
        assert(math.abs(p.x - 3) + math.abs(p.y - 2) + math.abs(p.z - 3) < 1e-9)
        "##);
    assert_eq!(run.scene.materials.len(), 1);
}

#[test]
fn interpretations_that_call_a_changing_method_from_a_rule_are_refused() {
    let told = error(&format!(
        "{HEAD} s:axiom(F(1)) s:rule(\"F(l)\", function(this, l) this:forward(l) return F(l) end) s:derive(1)"
    ));
    assert!(
        told.contains("interpretation rule") && told.contains("rule F(l)") && told.contains("main.lua:"),
        "{told}"
    );
}

#[test]
fn two_tips_read_their_own_places() {
    let text = chain(&format!(
        "{HEAD}
        s:axiom({{ F(1), Ask() }}, {{ T(90), F(2), {{ F(3), Ask() }}, Ask() }}, Ask())
        s:rule(\"Ask\", function(this) return place(this) end)
        s:derive(1)"
    ));
    assert_eq!(text, "[ F(1) Say(0,0,1) ] [ T(90) F(2) [ F(3) Say(-5,0,0) ] Say(-2,0,0) ] Say(0,0,0)");
}

#[test]
fn branches_are_pruned_by_their_places() {
    let script = format!(
        "{HEAD}
        local Tip = module(\"Tip\")
        s:axiom(Tip())
        s:rule(\"Tip\", {{ when = function(this) return this:position().z > 2.5 end }}, function() return nil end)
        s:rule(\"Tip\", function() return {{ T(20), F(1), Tip() }}, {{ T(-20), F(1), Tip() }} end)
        s:derive(9)"
    );
    let expected = chain(&script);
    /// Returns the number of segments that a tip at this height and angle (degrees) makes in `steps` steps.
    fn segments(height: f64, angle: f64, steps: usize) -> usize {
        if steps == 0 || height > 2.5 {
            return 0;
        }
        let side = |angle: f64| 1 + segments(height + angle.to_radians().cos(), angle, steps - 1);
        side(angle + 20.0) + side(angle - 20.0)
    }
    assert_eq!(expected.matches('F').count(), segments(0.0, 0.0, 9), "{expected}");
    assert!(expected.matches("Tip").count() < 300);
    for (threads, batch) in [(1, 1), (2, 1), (3, 5)] {
        assert_eq!(lines(&run_with(&script, divided(threads, batch))), std::slice::from_ref(&expected));
    }
}

#[test]
fn decompositions_and_types_of_scripts_read_places_too() {
    let text = chain(
        "local walker = object(\"walker\", {
            extends = turtle,
            reads = { height = function(self) return self:position().z end },
        })
        local Ask, Say = module(\"Ask\", \"n\"), module(\"Say\", \"z\", \"n\")
        local s = lsystem { object = walker { step = 1 } }
        s:axiom(F(2), Ask(1), F(3), Ask(2))
        s:decompose(\"Ask(n)\", { when = function(this, n) return n > 1 end }, function(this, n) return Say(this:height(), n), F(1), Ask(n - 1) end)
        s:rule(\"Ask(n)\", function(this, n) return Say(this:position().z, n) end)
        s:derive(1)",
    );
    assert_eq!(text, "F(2) Say(2,1) F(3) Say(5,2) F(1) Say(6,1)");
}

#[test]
fn an_extruder_has_a_place_too() {
    let text = chain(
        "local Box, Ask, Say = module(\"Box\", \"h\"), module(\"Ask\"), module(\"Say\", \"z\")
        local s = lsystem { object = extruder }
        s:axiom(Ask(), Box(2), Ask(), Box(3), Ask())
        s:interpret(\"Box(h)\", function(this, h) this:extrude(h) end)
        s:rule(\"Ask\", function(this) return Say(this:position().z) end)
        s:derive(1)",
    );
    assert_eq!(text, "Say(0) Box(2) Say(2) Box(3) Say(5)");
}

#[test]
fn a_decomposition_that_reads_an_object_without_a_place_adds_no_pass() {
    let passes = |guard: &str| {
        let script = format!(
            "local House, Walls = module('House'), module('Walls', 'height')
            local houses = lsystem {{ object = footprint }}
            houses:axiom(source {{ {{ geometry = polygon({{ 0, 0 }}, {{ 8, 0 }}, {{ 8, 6 }}, {{ 0, 6 }}) }} }}, function(feature)
                return footprint(feature.geometry), House(), Walls(1)
            end)
            houses:decompose('House', {{ when = function(this) return {guard} end }}, function() return Walls(3) end)
            houses:interpret('Walls(height)', function(this, height) print(height) this:walls {{ height = height }} end)
            houses:derive(0)"
        );
        let (sender, lines) = std::sync::mpsc::channel();
        let mut options = burgeon::options();
        options.reports.print =
            Some(Print::new(move |line| sender.send(line.to_owned()).expect("a receiver")));
        run_with(&script, options);
        lines.try_iter().collect::<Vec<String>>()
    };
    assert_eq!(passes("true"), ["3", "1"]);
    assert_eq!(passes("this:area() > 1"), ["3", "1"]);
}

#[test]
fn a_run_ends_while_it_draws_at_the_limit_of_its_file() {
    let script = format!("{HEAD} s:axiom(sequence(table.create(400, F(1)))) s:derive(0)");
    let limited = |triangles: usize| {
        let mut options = divided(2, 16);
        let limit = FileLimit { triangles, message: "the page is full".into(), help: "draw less".into() };
        options.limits.file = Some(std::sync::Arc::new(limit));
        try_run(&script, options)
    };
    let triangles = run(&script).scene.triangles();
    assert!(triangles > 1000, "{triangles}");
    let error = limited(triangles - 1).err().expect("a limit").to_string();
    assert!(error.contains("the page is full") && error.contains("draw less"), "{error}");
    assert_eq!(limited(triangles).expect("a model").scene.triangles(), triangles);
}
