//! Sub-systems: what follows a module in its branch is rewritten and drawn by the rules of another system. Random systems are
//! compared with a plain implementation in `patterns.rs`.

use burgeon::Run;
use burgeon::export::gltf;

use super::scripts::{all_chains, chain, chain_of_each, divided, run, run_with};

/// Two systems with the modules of which the second is a sub-system after `In`.
const HEAD: &str = "
    local A, B, C, In, At = module('A'), module('B'), module('C'), module('In', 'scale?'), module('At')
    local N = module('N', 'n')
    local inner, s = lsystem(), lsystem()
    s:subsystem('In', inner)
";

/// Returns the chain of the system `s` after one step.
fn after(axiom: &str, rules: &str) -> String {
    chain(&format!("{HEAD} s:axiom({axiom}) {rules} s:derive(1)"))
}

const SWAP: &str = "s:rule('A', 'B') inner:rule('A', 'C')";

#[test]
fn a_region_reaches_from_its_module_to_the_end_of_the_branch() {
    assert_eq!(after("A(), { A(), In(), A(), { A() }, A() }, A()", SWAP), "B [ B In C [ C ] C ] B");
    assert_eq!(after("A(), In(0.5), A(), { A() }, A()", SWAP), "B In(0.5) C [ C ] C");
    assert_eq!(after("{ In() }, A(), { { In() }, A() }", SWAP), "[ In ] B [ [ In ] B ]");
}

#[test]
fn the_module_that_begins_a_region_is_rewritten_by_the_rules_around_it() {
    let rules = "s:rule('In(x)', function(this, x) return In(2) end) inner:rule('In(x)', [[ return In(3) ]])";
    assert_eq!(after("In(1), In(1)", rules), "In(2) In(3)");
    let erased = "s:rule('In', '*') inner:rule('A', 'C') s:rule('A', 'B')";
    assert_eq!(after("In(), A()", erased), "C", "matched against the chain as the step began");
}

#[test]
fn the_innermost_region_takes_precedence_and_ends_with_its_branch() {
    let rules = "local deep = lsystem() deep:rule('A', 'N(1)') inner:subsystem('At', deep)";
    let axiom = "A(), In(), A(), { At(), A(), { In(), A() }, A() }, A(), At(), A()";
    let expected = "B In C [ At N(1) [ In C ] N(1) ] C At N(1)";
    assert_eq!(after(axiom, &format!("{rules} {SWAP}")), expected);
}

#[test]
fn systems_contain_themselves_and_each_other() {
    let rules = "inner:subsystem('At', s) inner:subsystem('In', inner) s:subsystem('At', s)";
    assert_eq!(after("A(), In(), A(), { At(), A() }, A()", &format!("{rules} {SWAP}")), "B In C [ At B ] C");
    let fern = chain(
        "local X, Of = module('X'), module('Of') local s = lsystem() s:subsystem('Of', s) s:axiom(X())
         s:rule('X', '[ Of X ] X') s:derive(2)",
    );
    assert_eq!(fern, "[ Of [ Of X ] X ] [ Of X ] X");
}

#[test]
fn contexts_see_the_modules_of_all_regions() {
    let left = "s:rule('A', 'B') inner:rule('A In < A', 'C') inner:rule('B < A', 'N(2)')";
    assert_eq!(after("A(), In(), A()", left), "B In C");
    let skipped = "inner:ignore('In') inner:rule('A < A', 'C') s:rule('A < A', 'N(2)')";
    assert_eq!(after("A(), In(), A(), { A() }", skipped), "A In C [ C ]", "a system ignores its own modules");
    let right = "s:rule('A > In(x) A', 'B') inner:rule('A > [C] B', 'N(3)')";
    assert_eq!(after("A(), In(), A(), { C() }, B()", right), "B In N(3) [ C ] B");
    let new = "s:rule('A', 'B') inner:rule('B In(_) << A', 'C')";
    assert_eq!(after("A(), In(), A()", new), "B In C");
    let run_of_two = "s:rule('A In(x) A', 'B') inner:rule('A', 'C')";
    assert_eq!(after("A(), In(), A(), A()", run_of_two), "B C");
}

#[test]
fn decompositions_groups_guards_and_weights_of_a_subsystem_hold_in_its_regions() {
    let rules = "inner:decompose('N(n)', { when = function(this, n) return n > 1 end }, 'N(n / 2) N(n / 2)')
                 s:decompose('N(n)', { when = function(this, n) return n > 3 end }, 'N(n - 1)')";
    assert_eq!(after("N(5), In(), N(4)", rules), "N(3) In N(1) N(1) N(1) N(1)");
    let groups =
        "inner:rule('A', { group = 'up' }, 'B') inner:rule('A', 'C') s:rule('A', { group = 'up' }, 'C')
                  s:rule('A', { group = 'down' }, 'N(9)') s:axiom(A(), In(), A())";
    let each = chain_of_each(&format!(
        "{HEAD} {groups} s:derive(1, 'up') s:axiom(A(), In(), A()) s:derive(1, 'down')
         s:axiom(A(), In(), A()) s:derive(1)"
    ));
    assert_eq!(each, ["C In B", "N(9) In C", "A In C"]);
    let weights = "inner:rule('A', { weight = 1 }, 'B') inner:rule('A', { weight = 1 }, 'C')
                   local list = table.create(1000, A())";
    let made = after("In(), sequence(table.create(1000, A()))", weights);
    let share = made.matches('B').count();
    assert!((430..570).contains(&share), "{share}");
}

#[test]
fn random_numbers_do_not_depend_on_regions() {
    let script = |declared: &str| {
        chain(&format!(
            "local A, N, In = module('A'), module('N', 'n'), module('In') local inner, s = lsystem(), lsystem()
             s:axiom(A(), {{ In(), A(), {{ A() }} }}, A()) {declared}
             s:rule('A', function() return N(random()), A() end) s:derive(3)"
        ))
    };
    let alone = script("");
    let same = "inner:rule('A', function() return N(random()), A() end)";
    assert_eq!(script(&format!("s:subsystem('In', inner) {same}")), alone);
    let other = script("s:subsystem('In', inner) inner:rule('A', function() return N(2) end)");
    let outside = |text: &str| {
        let (before, rest) = text.split_once('[').expect("a branch");
        (before.to_owned(), rest.rsplit_once(']').expect("its end").1.to_owned())
    };
    assert_eq!(outside(&other), outside(&alone));
    assert_ne!(other, alone);
}

#[test]
fn rules_that_are_declared_later_hold_in_the_next_derivation() {
    let each = chain_of_each(&format!(
        "{HEAD} s:axiom(In(), A()) s:derive(1) inner:rule('A', 'C')
         s:axiom(In(), A()) s:derive(1) inner:axiom(A(), In(), A()) inner:derive(1)
         s:axiom(A(), In(), A()) s:rule('A', 'B') s:derive(1)"
    ));
    assert_eq!(each, ["In A", "In C", "C In C", "B In C"]);
}

/// Returns the extent of the model along each axis (m).
fn extent(script: &str) -> [f64; 3] {
    let run = run(script);
    assert!(run.warnings.is_empty(), "{:?}", run.warnings);
    let (low, high) = run.scene.bounds().expect("a model");
    (high - low).to_array()
}

/// Two systems with turtles, of which the second is a sub-system after `In`.
const TURTLES: &str = "
    local A, B, D = module('A', 'n?'), module('B'), module('D')
    local In, Plain = module('In', 'scale?'), module('Plain')
    local inner = lsystem({ object = turtle({ width = 0.2, heading = { 0, 0, 1 } }) })
    local s = lsystem({ object = turtle({ width = 0.2, heading = { 0, 0, 1 } }) })
    s:subsystem('In', inner) s:subsystem('Plain', inner)
";

#[test]
fn a_scale_multiplies_lengths_and_widths_until_its_branch_ends() {
    let close = |axiom: &str, rules: &str, expected: [f64; 2]| {
        let [x, _, z] = extent(&format!("{TURTLES} {rules} s:axiom({axiom}) s:derive(0)"));
        assert!((x - expected[0]).abs() < 1e-6 && (z - expected[1]).abs() < 1e-6, "{axiom}: {x} {z}");
    };
    close("In(0.5), F(4)", "", [0.1, 2.0]);
    close("In(0.5), In(0.5), F(4)", "", [0.05, 1.0]);
    close("Plain(), F(4)", "", [0.2, 4.0]);
    close("In(), F(4)", "", [0.2, 4.0]);
    close("F(1), { In(0.25), F(4), Width(0.4), F(4) }, F(1)", "", [0.2, 3.0]);
    close("{ In(3), F(1) }, F(2)", "", [0.6, 3.0]);
    close("In(2), F()", "", [0.4, 2.0]);
    close("In(0.5), G(2), Sphere(1)", "", [1.0, 1.0]);
    close(
        "In(2), Width(0.5), F(1)",
        "inner:interpret('F', function(this) this:width(0.3):forward(3) end)",
        [0.6, 6.0],
    );
}

#[test]
fn surfaces_meshes_models_and_polygons_are_scaled_too() {
    let cube = "
        local cube = lsystem({ object = extruder({ sides = 4, smooth = false }) })
        cube:axiom(A()) cube:interpret('A', function(this) this:scale(1):extrude(1) end)
        local model = cube:derive(0)";
    let leaf = "
        local rows = {}
        for k = 0, 2 do rows[k + 1] = { vec(k / 2, 0, 0), vec(k / 2, 0.5, 0.5), vec(k / 2, 0, 1) } end
        local leaf = surface({ points = rows, kind = 'b-spline', degree = 2 })";
    for (declared, draw) in [
        (cube, "this:place(model)"),
        (leaf, "this:surface(leaf)"),
        ("", "this:mesh({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 0, 1 } }, { { 1, 2, 3 } })"),
        ("", "this:begin_polygon():point():advance(1):point():turn(90):advance(1):point():end_polygon()"),
        ("", "this:begin_cylinder():forward(1):turn(40):forward(1):end_cylinder()"),
        ("", "this:sphere(1)"),
    ] {
        let of = |before: &str| {
            extent(&format!(
                "{TURTLES} {declared} inner:interpret('D', function(this) {draw} end)
                 s:axiom(G(1), {before} D()) s:derive(0)"
            ))
        };
        let (whole, half) = (of("Plain(),"), of("In(0.5),"));
        for (whole, half) in whole.iter().zip(half) {
            assert!((whole - 2.0 * half).abs() < 1e-6, "{draw}: {whole} {half}");
        }
    }
}

#[test]
fn a_region_is_drawn_by_the_interpretations_of_its_system() {
    let rules = "
        s:interpret('A(n)', function(this, n) this:forward(1) end)
        inner:interpret('A(n)', function(this, n) return B(), { D(), B() }, B() end)
        s:interpret('B', function(this) this:forward(100) end)
        inner:interpret('B', function(this) this:forward(2) end)
        inner:interpret('D', { when = function(this) return true end }, function(this) this:turn(90) end)";
    let [x, _, z] = extent(&format!("{TURTLES} {rules} s:axiom(A(), {{ Plain(), A() }}, A()) s:derive(0)"));
    assert!((z - 5.0).abs() < 1e-6, "1 + 2 + 2, not {z}");
    assert!((2.0..2.3).contains(&x), "{x}");
}

#[test]
fn interpretations_of_regions_have_contexts_and_choices() {
    let rules = "
        s:interpret('A', function(this) this:forward(1) end)
        inner:interpret('A > B', function(this) this:forward(10) end)
        inner:interpret('Plain < A', function(this) this:forward(100) end)
        inner:interpret('B', function(this) end)
        s:interpret('B', function(this) this:forward(1000) end)";
    let of =
        |axiom: &str| extent(&format!("{TURTLES} {rules} s:axiom({axiom}) s:derive(0)"))[2].round() as i64;
    assert_eq!(of("A(), Plain(), A(), A(), B()"), 111);
    assert_eq!(of("A(), B(), { Plain(), A() }"), 1101);
}

#[test]
fn rules_in_a_region_read_places_that_are_scaled() {
    let text = chain(&format!(
        "{TURTLES} s:axiom(F(1), In(0.5), F(1), D()) inner:rule('D', function(this) return F(this:position().z), D() end)
         s:derive(3)"
    ));
    assert_eq!(text, "F(1) In(0.5) F(1) F(1.5) F(2.25) F(3.375) D");
}

#[test]
fn chains_of_features_have_regions_of_their_own_for_any_division() {
    let script = "
        local A, B, N, In = module('A'), module('B'), module('N', 'n'), module('In', 'scale')
        local leaf, s = lsystem({ object = turtle() }), lsystem({ object = turtle() })
        s:axiom(source({ { id = 'a', n = 1 }, { id = 'b', n = 4 }, { id = 'c', n = 0 } }), function(feature)
          local list: { any } = { A() }
          for k = 1, feature.n do table.insert(list, { In(1 / k), A(), N(k) }) end
          table.insert(list, if feature.n > 2 then In(0.5) else B())
          return sequence(list), A()
        end)
        s:subsystem('In', leaf)
        s:rule('A', function(this) return F(1), { A() }, N(random()) end)
        leaf:rule('A < N(n)', function(this, n) return F(n), N(n + 1), { A() } end)
        leaf:rule('A', function(this) return { Turn(random(10, 80)), F(2) }, A() end)
        for _, system in { s, leaf } do system:interpret('N(n)', function(this, n) this:turn(n) end) end
        leaf:interpret('F(x)', function(this, x) this:color('green'):forward(x / 2) end)
        for _, name in { 'A', 'B' } do s:ignore(name) end
        s:derive(5)";
    let glb = |run: &Run| gltf::glb(&run.scene).expect("a model");
    let first = run(script);
    for (threads, batch) in [(1, 1), (2, 1), (1, 2), (2, 2), (2, 7), (3, 4096)] {
        let other = run_with(script, divided(threads, batch));
        assert_eq!(all_chains(&other), all_chains(&first), "{threads} {batch}");
        assert!(glb(&other) == glb(&first), "{threads} {batch}");
    }
}

#[test]
fn a_picked_triangle_names_the_interpretation_of_its_region() {
    let file = tempfile::Builder::new().suffix(".lua").tempfile().expect("a file").into_temp_path();
    let script = format!(
        "{TURTLES} s:axiom(In(0.5), A(1))
         s:interpret('A(x)', function(this) this:forward(1) end)
         inner:interpret('A(y)', function(this) this:forward(2) end) s:derive(0)"
    );
    std::fs::write(&file, script).expect("a script");
    let run = burgeon::run(&file, burgeon::options()).expect("it runs");
    let asked = burgeon::trace::Pick { instance: 0, part: 0, triangle: 0 };
    let picked = burgeon::trace::pick(&file, &burgeon::options(), &run.scene, asked).expect("it is known");
    let drawn = picked.drawn.expect("a module made it");
    assert_eq!(drawn.interpretation.expect("an interpretation").text, "A(y)");
}
