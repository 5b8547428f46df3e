//! Places that rules read in long series of steps, between which only a part of the chain is interpreted: the output equals
//! that of rules which could use `this` in any way, for which each chain is interpreted whole.

use burgeon::Run;
use burgeon::export::gltf;

use super::scripts::{all_chains, run};

/// Objects, and interpretations of `F` and `B`.
const OBJECTS: [&str; 3] = [
    "local s = lsystem({ object = turtle({ sides = 3 }) })
     s:interpret('F(l)', function(this, l) this:forward(0.1 + l):turn(7):roll(20) end)
     s:interpret('B(x)', function(this, x) this:turn(x):sphere(0.1) end)",
    "local s = lsystem({ object = turtle({ sides = 3, joints = 'smooth', width = 0.01 }) })
     s:interpret('F(l)', function(this, l) this:forward(0.1 + l):turn(7):roll(20) end)
     s:interpret('B(x)', function(this, x) this:turn(x):sphere(0.1) end)",
    "local s = lsystem({ object = extruder({ sides = 3 }) })
     s:interpret('F(l)', function(this, l) this:scale(0.9 + l):extrude(0.2):turn(7) end)
     s:interpret('B(x)', function(this, x) this:turn(x):extrude(0.1) end)",
];

/// Objects of a system and of its sub-system after `In`, with their interpretations.
const WITH_SUBSYSTEM: &str =
    "local In, s, inner = module('In', 'scale'), lsystem({ object = turtle({ sides = 3 }) }), lsystem({ object = turtle() })
     s:subsystem('In', inner)
     s:interpret('F(l)', function(this, l) this:forward(0.2 + l):turn(3):roll(20) end)
     s:interpret('B(x)', function(this, x) this:turn(-x):sphere(0.2) end)
     inner:interpret('F(l)', function(this, l) this:forward(0.1 + l):turn(7):roll(20) end)
     inner:interpret('B(x)', function(this, x) this:turn(x):sphere(0.1) end)";

/// Rules; `PLACE` stands for the position of the module.
const RULES: [&str; 7] = [
    "s:rule('A', { when = function(this) return PLACE.z > -1e9 end }, function() return F(0), { A() } end)",
    "s:rule('A', function(this) return F(PLACE.z % 0.1), { B(PLACE.x % 3) }, A(), B(1) end)",
    "s:rule('A', function(this) if PLACE.x > 0.5 then return F(0.3), A() end return { F(0.1) }, F(0), A() end)",
    "s:rule('F(l) < A', function(this, l) return F((l + PLACE.y) % 0.2), { F(l) }, A() end)",
    "s:rule('A', function(this) return F(random() * 0.1), { A(), B(PLACE.z % 2) } end)
     s:rule('B(x)', { when = function(this, x) return x < 0 end }, function() return nil end)",
    "s:rule('A > B(x)', function(this, x) return F(x / 1000), { B(PLACE.z % 1) }, A() end)",
    "s:rule('A', { weight = 3 }, function(this) return F(PLACE.z % 0.1), { F(0.1) }, A() end)
     s:rule('A', { weight = 1 }, function() return { A() }, F(0.2) end)",
];

fn script((object, apex): (&str, &str), rules: &str, place: &str, steps: usize) -> Run {
    let rules = rules.replace("PLACE", place);
    run(&format!(
        "local F, A, B = module('F', 'l'), module('A'), module('B', 'x')
         {object}
         local list = table.create(2100, B(1))
         s:axiom(sequence(list), F(0.1), {apex}, B(2), F(0.1))
         {rules}
         s:derive({steps})"
    ))
}

/// Returns the number of applications of interpretation rules.
fn interpreted(run: &Run) -> usize {
    run.systems[0].rules.iter().filter(|rule| rule.interprets).map(|rule| rule.done.applied).sum()
}

#[test]
fn places_in_series_are_those_of_whole_passes() {
    let objects = OBJECTS.iter().map(|object| (*object, "A()"));
    for object in
        objects.chain([(WITH_SUBSYSTEM, "{ B(1), In(0.5), F(0.1), { A() } }, In(0.8), F(0.1), A()")])
    {
        for rules in RULES {
            let of_inner = rules.replace("s:rule", "inner:rule");
            let rules = if object.0 == WITH_SUBSYSTEM { &of_inner } else { rules };
            let partial = script(object, rules, "this:position()", 40);
            let whole = script(object, rules, "(function() local it = this return it:position() end)()", 40);
            assert_eq!(all_chains(&partial), all_chains(&whole), "{object:?} {rules}");
            let glb = |run: &Run| gltf::glb(&run.scene).expect("a model");
            assert!(glb(&partial) == glb(&whole), "{object:?} {rules}");
            assert_eq!(partial.systems[0].steps, whole.systems[0].steps);
            assert!(partial.systems[0].rules[0].done.applied > 0, "{object:?} {rules}");
        }
    }
}

#[test]
fn a_step_that_asks_for_a_place_interprets_what_has_changed_before_the_place() {
    let nested = "s:rule('A', { when = function(this) return this:position().z > -1e9 end },
                    function() return F(0), { A() }, B(1) end)";
    let [short, long] = [500, 1000].map(|steps| interpreted(&script((OBJECTS[0], "A()"), nested, "", steps)));
    // Each step interprets a constant number of modules, although the number of modules after the place grows.
    assert!(long < short * 5 / 2, "{short} {long}");
    assert!(long - short < 500 * 400, "{short} {long}");
}
