//! Errors of planets and of the universe.

use insta::assert_snapshot;

use crate::support::Folder;

/// Returns the error message for a script whose third line is `line`.
fn told(line: &str) -> String {
    let rules = r#"local rules = { A = { "A", "A", "A", "A", change = 0, decay = 0.5 } }"#;
    let script = format!("{rules}\nlocal A = module(\"A\")\n{line}\n");
    Folder::new().with("s.lua", script).refuses(&["run", "s.lua"])
}

#[test]
fn a_planet_that_cannot_be_is_refused() {
    assert_snapshot!(told("planet({ radius = 0, rules = rules })"), @r"
    error: s.lua:3:1: planet: radius is 0 m
      | planet({ radius = 0, rules = rules })
      | ^^^^^^
      help: use a length above 0 and up to 1e9 m
    ");
    assert_snapshot!(told("planet({ radius = 1000 })"), @r#"
    error: s.lua:3:1: planet: missing rules
      | planet({ radius = 1000 })
      | ^^^^^^
      help: write rules = { A = { "A", "A", "A", "A", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }
    "#);
    assert_snapshot!(told("planet({ levels = 40, rules = rules })"), @r"
    error: s.lua:3:1: planet: levels is 40
      | planet({ levels = 40, rules = rules })
      | ^^^^^^
      help: use 6 to 28 levels
    ");
    assert_snapshot!(told("planet({ start = \"B\", rules = rules })"), @r#"
    error: s.lua:3:1: planet: no rule for the start symbol B
      | planet({ start = "B", rules = rules })
      | ^^^^^^
      help: use A
    "#);
    assert_snapshot!(told("planet({ axis = { 0, 0, 0 }, rules = rules })"), @r"
    error: s.lua:3:1: planet: axis has no direction
      | planet({ axis = { 0, 0, 0 }, rules = rules })
      | ^^^^^^
      help: write axis = { 0, 0, 1 }
    ");
    assert_snapshot!(told("planet({ seed = 1.5, rules = rules })"), @r"
    error: s.lua:3:1: planet: seed must be an integer below 2^53, or a string, not 1.5
      | planet({ seed = 1.5, rules = rules })
      | ^^^^^^
      help: seed takes number | string: Seed of the random numbers: a number or a string
    ");
}

#[test]
fn a_focus_inside_a_planet_is_refused() {
    let focus = "local s = lsystem({ object = planet({ radius = 1000, rules = rules }) }) s:axiom(A()) \
                 s:interpret(\"A\", function(this) this:focus(0, 10, 0) end) s:derive(0)";
    assert_snapshot!(told(focus), @r#"
    error: s.lua:3:30: rule A (interpretation): planet: the focus (0, 10, 0) is inside the planet, 10 m from its centre
      | local s = lsystem({ object = planet({ radius = 1000, rules = rules }) }) s:axiom(A()) s:interpret("A", function(this) this:focus(0, 10, 0) end) s:derive(0)
      |                              ^^^^^^
      module: A, step 0
      help: its ground is about 1000 m from its centre: use a focus farther out
    "#);
}

#[test]
fn a_focus_below_the_ground_or_the_water_is_refused() {
    let focus = |options: &str, z: f64| {
        format!(
            "local s = lsystem({{ object = planet({{ radius = 100000, levels = 8, {options} rules = rules }}) }}) \
             s:axiom(A()) s:interpret(\"A\", function(this) this:focus(0, 0, {z}) end) s:derive(0)"
        )
    };
    let below = told(&focus("", 99_500.0));
    assert!(below.contains("planet: the focus (0, 0, 99500) is 500 m below the ground"), "{below}");
    assert!(below.contains("the surface there is 100000.0 m from the centre"), "{below}");
    let below = told(&focus("water = 2000,", 101_900.0));
    assert!(below.contains("is 100 m below the water"), "{below}");
}

#[test]
fn a_planet_that_would_be_too_much_is_refused() {
    let near = "lsystem({ object = planet({ closeness = 100, levels = 20, rules = rules }) }):derive(0)";
    assert_snapshot!(told(near), @r"
    error: s.lua:3:20: planet: more than 67108864 heights
      | lsystem({ object = planet({ closeness = 100, levels = 20, rules = rules }) }):derive(0)
      |                    ^^^^^^
      help: use a lower closeness or fewer levels: most of the planet is far away
    ");
}

#[test]
fn flat_ground_has_no_latitude() {
    let cover = "terrain({ levels = 3, rules = rules, covers = { { on = { latitude = { 0, 1 } } } } })";
    assert_snapshot!(told(cover), @r"
    error: s.lua:3:1: terrain: flat ground has no latitude
      | terrain({ levels = 3, rules = rules, covers = { { on = { latitude = { 0, 1 } } } } })
      | ^^^^^^^
      help: use height or slope instead, or a planet
    ");
}

#[test]
fn what_the_universe_has_not_is_told() {
    let begin = "local all = universe({ seed = 3 }) local one = all:galaxy(0, 0, 0)";
    assert_snapshot!(told("universe({ seed = 3 }):galaxy(0.5, 0, 0)"), @r"
    error: s.lua:3:1: universe: 0.5 is not an integer below 2^53
      | universe({ seed = 3 }):galaxy(0.5, 0, 0)
      | ^^^^^^^^
      help: galaxies, stars and planets are numbered
    ");
    assert_snapshot!(told(&format!("{begin} all:star(one, 0)")), @r"
    error: s.lua:3:72: universe:star: unknown star number 0
      | local all = universe({ seed = 3 }) local one = all:galaxy(0, 0, 0) all:star(one, 0)
      |                                                                        ^^^^
      help: use a number from 1 to 2083416648
    ");
    assert_snapshot!(told(&format!("{begin} all:planet(one, 1)")), @r"
    error: s.lua:3:72: universe:planet: star must be a star, as returned by universe:star, not a table
      | local all = universe({ seed = 3 }) local one = all:galaxy(0, 0, 0) all:planet(one, 1)
      |                                                                        ^^^^^^
      help: write universe:planet(star: { kind: string, seed: string, radius: number, planets: number }, index: number)
    ");
}
