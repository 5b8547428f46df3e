//! Named random streams: they depend on their keys and the module, and on nothing else.

use burgeon::script::{FeaturePart, RunOptions};

use super::scripts::{all_chains, chain, chain_of_each, divided, error, run_with, words};

/// Returns the modules of a system whose modules `A` become `successor`, derived by two steps.
fn successors(successor: &str, axiom: &str) -> Vec<String> {
    let script = format!(
        "local A, B, U = module('A'), module('B', 'u'), module('U', 'u')
         local s = lsystem {{}}
         s:axiom({axiom})
         s:rule('A', function() {successor} end)
         s:derive(1)"
    );
    words(&chain(&script))
}

#[test]
fn a_stream_gives_the_same_numbers_whatever_else_is_drawn() {
    let plain = successors("return B(stream('x', 1)()), U(random())", "A()");
    for successor in [
        "local r, s = stream('y'), stream('x', 1) r() return B(s()), U(random())",
        "for i = 1, 100 do stream('x', 2)() end return B(stream('x', 1)()), U(random())",
        "local u = random() return B(stream('x', 1)()), U(u)",
        "stream('x', 1)() return B(stream('x', 1)()), U(random())",
        "return B(stream('x', 1.0)(0, 1)), U(random(0, 1))",
    ] {
        assert_eq!(successors(successor, "A()"), plain, "{successor}");
    }
    let later = successors("random() return B(stream('x', 1)()), U(random())", "A()");
    assert_eq!(later[0], plain[0]);
    assert_ne!(later[1], plain[1]);
}

#[test]
fn streams_with_other_keys_have_other_numbers() {
    let keys = [
        "'x'",
        "'y'",
        "'x', 1",
        "'x', 2",
        "'x', '1'",
        "'x', true",
        "'x', false",
        "'x', 1, 2",
        "'x', 2, 1",
        "'x1'",
        "'x', ''",
        "'x', 0.1",
        "'x', -1",
    ];
    let items: Vec<String> = keys.iter().map(|keys| format!("B(stream({keys})())")).collect();
    let mut drawn = successors(&format!("return {}", items.join(", ")), "A()");
    drawn.extend(successors("return B(random())", "A()"));
    assert_eq!(drawn.len(), keys.len() + 1);
    drawn.sort();
    drawn.dedup();
    assert_eq!(drawn.len(), keys.len() + 1);
    let zeros = successors("return B(stream('x', 0)()), B(stream('x', -0)())", "A()");
    assert_eq!(zeros[0], zeros[1]);
}

#[test]
fn each_module_has_its_own_streams_which_other_modules_do_not_change() {
    let three = successors("return B(stream('x')())", "A(), A(), { A() }");
    let drawn: Vec<&String> = three.iter().filter(|word| word.starts_with("B(")).collect();
    assert_eq!(drawn.len(), 3);
    assert!(drawn[0] != drawn[1] && drawn[1] != drawn[2] && drawn[0] != drawn[2], "{drawn:?}");
    let more = successors("return B(stream('x')())", "A(), A(), { A(), A() }, A()");
    assert_eq!(&more[..4], &three[..4]);
}

#[test]
fn a_stream_of_the_top_level_depends_on_the_seed_and_the_keys() {
    let script = "local A = module('A', 'u', 'v')
        local before = random()
        local first, second = lsystem {}, lsystem { seed = 9 }
        first:axiom(A(stream('x', 1)(), stream('y', 1)()))
        first:derive(0)
        random()
        second:axiom(A(stream('x', 1)(), stream('y', 1)()))
        second:derive(0)";
    let run = |seed| {
        let run = run_with(script, RunOptions { seed, ..burgeon::options() });
        run.systems.iter().map(|system| system.chain_text()).collect::<Vec<_>>()
    };
    assert_eq!(run(1)[0], run(1)[1]);
    assert_ne!(run(1)[0], run(2)[0]);
    // In a rule, the seed of the system counts.
    let in_rule = |options: &str, seed| {
        let script = format!(
            "local A, B = module('A'), module('B', 'u')
             local s = lsystem {{ {options} }}
             s:axiom(A())
             s:rule('A', function() return B(stream('x')()) end)
             s:derive(1)"
        );
        all_chains(&run_with(&script, RunOptions { seed, ..burgeon::options() }))
    };
    assert_eq!(in_rule("seed = 5", 1), in_rule("", 5));
    assert_eq!(in_rule("seed = 5", 1), in_rule("seed = 5", 2));
    assert_ne!(in_rule("", 1), in_rule("", 2));
}

#[test]
fn a_long_stream_is_uniform_and_scales_as_random_does() {
    let chains = chain_of_each(
        "local A = module('A', 'chi', 'equal', 'far')
         local counts, equal = table.create(10, 0), true
         local r, scaled, far = stream('long'), stream('long'), stream('long')
         local finite = true
         for i = 1, 20000 do
           local u = r()
           assert(u >= 0 and u < 1)
           counts[1 + math.floor(u * 10)] += 1
           equal = equal and scaled(3, -5) == 3 - 8 * u
           finite = finite and math.abs(far(-1e308, 1e308)) <= 1e308
         end
         local chi = 0
         for _, count in counts do chi += (count - 2000) ^ 2 / 2000 end
         local s = lsystem {}
         s:axiom(A(chi, equal, finite))
         s:derive(0)",
    );
    let values = chains[0].trim_start_matches("A(").trim_end_matches(')');
    let values: Vec<&str> = values.split(',').collect();
    assert!(values[0].parse::<f64>().expect("a number") < 27.9, "chi-square {}", values[0]);
    assert_eq!(&values[1..], ["true", "true"]);
}

/// Script that draws from streams in rules, interpretations and functions of an axiom.
const ROWS: &str = "local A, B = module('A', 'n', 'u'), module('B', 'n', 'u')
    local plots = {}
    for i = 1, 60 do plots[i] = { id = `plot {i}`, x = i * 9 } end
    local function drawn(name, ...)
      local r = stream(name, ...)
      local sum = 0
      for i = 1, 20 do sum += r(-1, 1) end
      return sum + r()
    end
    local s = lsystem { object = extruder { sides = 4 } }
    s:axiom(source(plots), function(plot)
      local r = stream('axiom', plot.id)
      return extruder { position = { plot.x, r(0, 9), 0 } }, A(3, r()), { A(2, drawn('helper', plot.id)) }
    end)
    s:rule('A(n, u)', { when = function(this, n) return n > 0 end }, function(this, n, u)
      return B(n, drawn('b', n, u > 0.5)), { A(n - 1, random()) }, A(n - 1, drawn('a'))
    end)
    s:rule('B(n, u)', { weight = 2 }, [[ return B(n, stream('kept')() + stream('string')()) ]])
    s:rule('B(n, u)', { weight = 1 }, function() end)
    s:interpret('B(n, u)', function(this, n, u)
      local r = stream('draws', n)
      this:scale(1 + r()):extrude(math.abs(u) + r(1, 2))
    end)
    s:derive(6)";

#[test]
fn streams_are_the_same_for_any_number_of_threads_and_any_batch() {
    let outcome = |options: RunOptions| {
        let run = run_with(ROWS, RunOptions { seed: 3, ..options });
        (all_chains(&run), burgeon::export::gltf::glb(&run.scene).expect("a model"))
    };
    let expected = outcome(divided(1, 4096));
    assert!(expected.0.len() > 10_000, "{}", expected.0.len());
    for (threads, batch) in [(1, 1), (2, 7), (3, 4096), (5, 100)] {
        assert!(outcome(divided(threads, batch)) == expected, "{threads} threads, {batch} modules");
    }
}

#[test]
fn a_part_has_the_streams_of_the_whole_run() {
    let whole = all_chains(&run_with(ROWS, burgeon::options()));
    let parts: String = (1..=4)
        .map(|number| {
            let part = Some(FeaturePart { number, count: 4, reach: 0.0, cell: None });
            all_chains(&run_with(ROWS, RunOptions { part, ..burgeon::options() }))
        })
        .collect();
    assert_eq!(parts, whole);
}

#[test]
fn a_stream_belongs_to_the_module_for_which_it_was_created() {
    let refuses = |body: &str, what: &str| {
        let script = format!(
            "local A, B = module('A'), module('B', 'u')
             local r = stream('outside')
             local kept = {{ draw = function() return r() end }}
             local s = lsystem {{ object = extruder() }}
             s:axiom(A())
             {body}
             s:derive(1)"
        );
        let told = error(&script);
        let expected = format!("{what} uses a random stream that was created outside it");
        assert!(told.contains(&expected) && told.contains("A"), "{body}: {told}");
    };
    refuses("s:rule('A', function() return B(r()) end)", "a rule");
    refuses("s:rule('A', function() return B(kept.draw()) end)", "a rule");
    refuses("s:interpret('A', function(this) this:extrude(r(1, 2)) end)", "an interpretation rule");
}

#[test]
fn a_stream_of_the_top_level_continues_after_a_derivation_and_in_functions_of_axioms() {
    let chains = chain_of_each(
        "local A = module('A', 'u', 'v')
         local r, other = stream('shared'), stream('shared')
         local s = lsystem {}
         s:axiom(source({ { id = 'a' } }), function() return A(r(), r()) end)
         s:derive(0)
         local t = lsystem {}
         t:axiom(A(r(), r()))
         t:derive(0)
         local u = lsystem {}
         u:axiom(A(other(), other()), A(other(), other()))
         u:derive(0)",
    );
    assert_eq!(chains[2], format!("{} {}", chains[0], chains[1]));
}

#[test]
fn helper_threads_have_the_streams_that_functions_of_axioms_have_advanced() {
    let script = "local A, B = module('A', 'n'), module('B', 'u')
        local r = stream('shared')
        local list = {}
        for i = 1, 400 do list[i] = { id = tostring(i) } end
        local first = lsystem {}
        first:axiom(source(list), function() return B(r()) end)
        first:derive(0)
        local u = r()
        local second = lsystem {}
        second:axiom(source(list), function() return A(1) end)
        second:rule('A(n)', function(this, n) return B(u) end)
        second:derive(1)";
    let text = |threads| all_chains(&run_with(script, divided(threads, 10)));
    assert_eq!(text(1), text(4));
}
