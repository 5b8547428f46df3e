//! Stochastic rules: frequencies, and the streams of the modules' random numbers (law 9).

use burgeon::script::RunOptions;

use super::scripts::{chain_of_each, error, lines, run_with, words};

const BUDS: usize = 2000;

/// Returns a script whose axiom is many buds, to which `rules` apply in one step.
fn buds(rules: &str) -> String {
    format!(
        r#"
        local Bud = module("Bud", "n"); local P = module("P"); local Q = module("Q"); local R = module("R")
        local s = lsystem {{}}
        local buds = {{}}
        for i = 1, {BUDS} do buds[i] = Bud(i) end
        s:axiom(table.unpack(buds))
        {rules}
        s:derive(1)
        "#
    )
}

/// Returns the sum of chi-square over 5 seeds, and its degrees of freedom.
fn chi_square(rules: &str, shares: &[(&str, f64)]) -> (f64, usize) {
    let script = buds(rules);
    let total: f64 = shares.iter().map(|(_, share)| share).sum();
    let mut sum = 0.0;
    for seed in 1..=5 {
        let run = run_with(&script, RunOptions { seed, ..burgeon::options() });
        let text = lines(&run).concat();
        let words = words(&text);
        assert_eq!(words.len(), BUDS);
        for (name, share) in shares {
            let expected = share / total * BUDS as f64;
            let count = words.iter().filter(|word| word == name).count() as f64;
            sum += (count - expected).powi(2) / expected;
        }
    }
    (sum, 5 * (shares.len() - 1))
}

/// Checks that the sum is within bounds that a correct generator exceeds, or stays below, once in a thousand
/// cases each.
fn check_frequencies(rules: &str, shares: &[(&str, f64)]) {
    let (sum, freedom) = chi_square(rules, shares);
    let (low, high) = match freedom {
        5 => (0.21, 20.52),
        10 => (1.48, 29.59),
        other => panic!("no bounds for {other} degrees of freedom"),
    };
    assert!(sum < high, "chi-square {sum} with {freedom} degrees of freedom is too large for {rules}");
    assert!(sum > low, "chi-square {sum} with {freedom} degrees of freedom is too small for {rules}");
}

#[test]
fn a_weight_of_three_to_one_is_drawn_three_times_in_four() {
    let rules =
        "s:rule(\"Bud\", { weight = 3 }, [[ return P() ]]) s:rule(\"Bud\", { weight = 1 }, [[ return Q() ]])";
    check_frequencies(rules, &[("P", 3.0), ("Q", 1.0)]);
}

#[test]
fn a_rule_of_weight_0_is_never_chosen_and_changes_nothing_for_the_others() {
    let others =
        "s:rule(\"Bud\", { weight = 3 }, [[ return P() ]]) s:rule(\"Bud\", { weight = 1 }, [[ return Q() ]])";
    let never = "s:rule(\"Bud\", { weight = 0 }, [[ return R() ]])";
    let text = |rules: &str| lines(&run_with(&buds(rules), burgeon::options())).concat();
    assert_eq!(text(&format!("{never} {others}")), text(others));
    assert_eq!(text(&format!("{others} {never}")), text(others));
    assert_eq!(words(&text(&format!("{never} s:rule(\"Bud\", [[ return Q() ]])")))[0], "Q");
    assert_eq!(words(&text(&format!("{never} {never}")))[0], "Bud(1)");
    for weight in ["-1", "0 / 0", "1 / 0", "true"] {
        let said = error(&buds(&format!("s:rule(\"Bud\", {{ weight = {weight} }}, [[ return R() ]])")));
        assert!(said.contains("weight must be a number of at least 0"), "{weight}: {said}");
    }
}

#[test]
fn equal_weights_are_drawn_equally() {
    let rules =
        "for _, make in { P, Q, R } do s:rule(\"Bud\", { weight = 0.2 }, function() return make() end) end";
    check_frequencies(rules, &[("P", 1.0), ("Q", 1.0), ("R", 1.0)]);
}

#[test]
fn weights_need_not_sum_to_one_and_keep_their_proportion_among_the_candidates() {
    // The guard of the rule with the largest weight never holds, so the other rules share the probability.
    let rules = "s:rule(\"Bud\", { weight = 50, when = function() return false end }, [[ return R() ]])
                 s:rule(\"Bud\", { weight = 0.3 }, [[ return P() ]])
                 s:rule(\"Bud\", { weight = 0.1, when = function() return true end }, [[ return Q() ]])";
    check_frequencies(rules, &[("P", 3.0), ("Q", 1.0)]);
}

#[test]
fn guards_choose_between_weights_module_by_module() {
    let rules = "s:rule(\"Bud(n)\", { weight = 1, when = function(_, n) return n % 2 == 0 end }, [[ return P() ]])
                 s:rule(\"Bud(n)\", { weight = 1, when = function(_, n) return n % 2 == 1 end }, [[ return Q() ]])
                 s:rule(\"Bud\", { weight = 2 }, [[ return R() ]])";
    // Half of the buds choose between P and R, half between Q and R.
    check_frequencies(rules, &[("P", 1.0), ("Q", 1.0), ("R", 4.0)]);
}

#[test]
fn contexts_limit_which_weights_are_drawn_from() {
    // The first bud has no left neighbour, so it always becomes Q; one bud does not matter for the sum.
    let rules = "s:rule(\"Bud < Bud\", { weight = 1 }, [[ return P() ]])
                 s:rule(\"Bud\", { weight = 1 }, [[ return Q() ]])
                 s:rule(\"Bud > P\", { weight = 1000 }, [[ return R() ]])";
    check_frequencies(rules, &[("P", 1.0), ("Q", 1.0)]);
    let first = lines(&run_with(&buds(rules), burgeon::options())).concat();
    assert!(first.starts_with("Q "), "{}", &first[..20]);
}

#[test]
fn random_is_uniform_in_a_rule_and_within_its_bounds() {
    let script =
        buds("s:rule(\"Bud\", function() local u = random() return Bud(random(-2, 3)), Bud(u * 10) end)");
    let text = lines(&run_with(&script, burgeon::options())).concat();
    let values: Vec<f64> = words(&text)
        .iter()
        .filter_map(|word| word.strip_prefix("Bud(")?.strip_suffix(')')?.parse().ok())
        .collect();
    assert_eq!(values.len(), 2 * BUDS);
    let (mut bounded, mut unit) = ([0.0; 10], [0.0; 10]);
    for pair in values.chunks(2) {
        assert!((-2.0..3.0).contains(&pair[0]) && (0.0..10.0).contains(&pair[1]));
        bounded[((pair[0] + 2.0) * 2.0) as usize] += 1.0;
        unit[pair[1] as usize] += 1.0;
    }
    let expected = BUDS as f64 / 10.0;
    for counts in [bounded, unit] {
        let chi: f64 = counts.iter().map(|count: &f64| (count - expected).powi(2) / expected).sum();
        assert!((1.15..27.88).contains(&chi), "chi-square {chi} with 9 degrees of freedom");
    }
}

#[test]
fn the_choice_and_what_the_rule_draws_are_independent() {
    // If the rule drew the same number that chose it, P would only see the lower half.
    let script = buds(
        "s:rule(\"Bud\", { weight = 1 }, function() return Bud(random()) end)
         s:rule(\"Bud\", { weight = 1 }, [[ return Q() ]])",
    );
    let text = lines(&run_with(&script, burgeon::options())).concat();
    let values: Vec<f64> = words(&text)
        .iter()
        .filter_map(|word| word.strip_prefix("Bud(")?.strip_suffix(')')?.parse().ok())
        .collect();
    let upper = values.iter().filter(|value| **value > 0.5).count() as f64 / values.len() as f64;
    assert!((0.44..0.56).contains(&upper), "{upper} of {} numbers lie in the upper half", values.len());
}

#[test]
fn siblings_and_generations_draw_independently() {
    let script = r#"
        local A = module("A", "n", "u"); local s = lsystem {}
        s:axiom(A(10, 0))
        s:rule("A(n, u)", { when = function(_, n) return n > 0 end }, function(this, n)
          return A(n - 1, random()), { A(n - 1, random()) }
        end)
        s:rule("A(n, u)", function(this, n, u) return A(-1, random()) end)
        s:derive(11)
    "#;
    let text = lines(&run_with(script, burgeon::options())).concat();
    let mut values: Vec<&str> = text.split(' ').filter(|word| word.starts_with("A(")).collect();
    assert_eq!(values.len(), 1024);
    values.sort_unstable();
    values.dedup();
    assert_eq!(values.len(), 1024, "all draws differ");
}

#[test]
fn guards_draw_no_random_numbers() {
    let told =
        error(&buds("s:rule(\"Bud\", { when = function() return random() < 0.5 end }, [[ return P() ]])"));
    assert!(told.contains("a guard cannot use random numbers") && told.contains("rule Bud"), "{told}");
}

/// Returns the random numbers of modules in a system with these rules, after `steps` steps.
fn draws(rules: &str, axiom: &str, steps: usize, seed: u64) -> Vec<String> {
    let script = format!(
        r#"
        local W = module("W", "n"); local U = module("U", "u"); local T = module("T")
        local s = lsystem {{}}
        s:axiom({axiom})
        {rules}
        s:derive({steps})
        "#
    );
    words(&lines(&run_with(&script, RunOptions { seed, ..burgeon::options() })).concat())
}

const WAITING: &str =
    "s:rule(\"W(n)\", { when = function(_, n) return n == 0 end }, function() return U(random()) end)
                       s:rule(\"W(n)\", function(_, n) return W(n - 1) end)";

#[test]
fn a_module_at_the_end_of_the_axiom_changes_no_draw_before_it() {
    let before = draws(WAITING, "W(0), { W(1), T() }, W(2)", 4, 0);
    for tail in ["W(0)", "T()", "{ W(0), W(0) }", "W(3), W(3)"] {
        let with = draws(WAITING, &format!("W(0), {{ W(1), T() }}, W(2), {tail}"), 4, 0);
        assert_eq!(with[..before.len()], before[..], "{tail}");
    }
}

#[test]
fn a_module_draws_the_same_whatever_its_neighbours_became() {
    let calm = "s:rule(\"T\", function() return T() end)";
    let busy = "s:rule(\"T\", function() return T(), { W(0), T(), U(random()) }, T(), T() end)";
    let draw = |others: &str| {
        let rules = format!(
            "{others} s:rule(\"W(n)\", {{ when = function(_, n) return n > 0 end }}, function(_, n)
               if n == 1 then return U(random()) end return W(n - 1) end)"
        );
        draws(&rules, "T(), W(4), T()", 4, 9)
    };
    let alone: Vec<String> = draw(calm).into_iter().filter(|word| word.starts_with("U(")).collect();
    assert_eq!(alone.len(), 1);
    assert!(draw(busy).contains(&alone[0]));
}

#[test]
fn a_rule_that_ran_and_returned_no_value_advances_the_stream_of_its_module() {
    // The rule draws in every step and keeps the module until it draws a number below 0.1.
    let rules = "s:rule(\"W(n)\", function(_, n) local u = random() if u < 0.1 then return U(u) end end)";
    let axiom = vec!["W(0)"; 50].join(", ");
    let ended = |steps| draws(rules, &axiom, steps, 3).iter().filter(|word| word.starts_with("U(")).count();
    let counts: Vec<usize> = [1, 2, 4, 8, 16].into_iter().map(ended).collect();
    assert!(
        counts.windows(2).all(|pair| pair[0] < pair[1]),
        "ever more have drawn below a tenth: {counts:?}"
    );
}

#[test]
fn a_rule_that_did_not_match_leaves_the_stream() {
    // T grows for some steps; only then does the guard or the context of W hold.
    let draw = |waits: usize, rule: &str| {
        let rules = format!("{rule} s:rule(\"T\", function() return U(0) end)");
        let mut axiom = String::from("W(0)");
        for _ in 0..waits {
            axiom = format!("{axiom}, T()");
        }
        draws(&rules, &axiom, 3, 5)[0].clone()
    };
    let matching = "s:rule(\"W\", function() return U(random()) end)";
    let at_once = draw(1, matching);
    assert!(at_once.starts_with("U(0."), "{at_once}");
    let late = "s:rule(\"W > U(x)\", { when = function(_, x) return x == 0 end }, function() return U(random()) end)";
    assert_eq!(draw(1, late), at_once, "the first step did not match");
    let guarded = "s:rule(\"W > T\", { when = function() return false end }, function() return U(7) end)
                   s:rule(\"W > U\", { weight = 2 }, function() return U(8) end)
                   s:rule(\"W > U\", { weight = 2 }, function() return U(8) end)";
    assert_eq!(draw(1, guarded), "U(8)");
    let waiting = "s:rule(\"W > T\", function() end) s:rule(\"W > U\", function() return U(random()) end)";
    let waited = draw(1, waiting);
    assert!(
        waited.starts_with("U(0.") && waited != at_once,
        "a rule that ran advances: {waited} and {at_once}"
    );
}

#[test]
fn seeds_differ_and_a_system_may_have_its_own() {
    let of = |seed| draws(WAITING, "W(0), W(0)", 1, seed);
    assert_eq!(of(1), of(1));
    assert_ne!(of(1), of(2));
    let own = |seed: u64, own: &str| {
        let script = format!(
            "local U = module(\"U\", \"u\") local s = lsystem {{ {own} }} s:axiom(U(0))
             s:rule(\"U\", function() return U(random()) end) s:derive(1)"
        );
        lines(&run_with(&script, RunOptions { seed, ..burgeon::options() }))
    };
    assert_eq!(own(1, "seed = 5"), own(2, "seed = 5"));
    assert_ne!(own(1, "seed = 5"), own(1, "seed = 6"));
    assert_eq!(own(5, ""), own(1, "seed = 5"));
}

#[test]
fn the_number_of_draws_before_changes_nothing_after_in_another_module() {
    // A batch draws for each of its modules in advance as many numbers as the rule with the most draws needed
    // before.
    let rules = "s:rule(\"W(n)\", function(_, n) local u for i = 0, n do u = random() end return U(u) end)";
    let hungry = draws(rules, "W(40), W(0), W(3)", 1, 0);
    let modest = draws(rules, "W(0), W(0), W(3)", 1, 0);
    assert_eq!(hungry[1..], modest[1..]);
    // Systems of one script have the same seed, so the first module of each has the same stream.
    let mut seen = chain_of_each(
        "local U = module(\"U\", \"u\")
         for n = 0, 39 do
           local s = lsystem {}
           s:axiom(U(0))
           s:rule(\"U\", function() local u for i = 0, n do u = random() end return U(u) end)
           s:derive(1)
         end",
    );
    assert_eq!(seen.len(), 40);
    seen.sort();
    seen.dedup();
    assert_eq!(seen.len(), 40, "each draw is another number");
}

#[test]
fn a_rule_that_draws_many_numbers_draws_those_of_a_rule_that_draws_few() {
    // In the second and third step, numbers are drawn in advance, as far as they fit in the buffer.
    let numbers = |count: usize| {
        let rule = format!(
            "s:rule(\"W(n)\", function()
               local drawn = {{}}
               for index = 1, {count} do drawn[index] = random() end
               return W(drawn[1]), U(drawn[30] + drawn[2])
             end)"
        );
        draws(&rule, "W(0), W(1), W(2)", 3, 5)
    };
    let few = numbers(30);
    assert_eq!(few.len(), 3 + 3 * 3);
    assert_eq!(few, numbers(60));
    assert_eq!(few, numbers(60_000));
}
