//! Errors of random distributions.

use std::fmt::Write as _;

use insta::assert_snapshot;

use crate::support::{assert_decent, refused_rules, without_columns};

/// Returns the first line of the error of each call in a rule, with its remedy.
fn told(calls: &[&str]) -> String {
    let mut text = String::new();
    for call in calls {
        let said = refused_rules(&format!("s:rule(\"A(x)\", function(this, x)\n  return A({call})\nend)"));
        assert_decent(&said);
        let said = without_columns(&said);
        let kept = said.lines().filter(|line| line.contains("error: ") || line.contains("help: "));
        let kept: Vec<&str> =
            kept.map(|line| line.trim().trim_start_matches("error: s.lua:4: rule A(x): ")).collect();
        let _ = writeln!(text, "{call}\n  {}", kept.join("\n  "));
    }
    text
}

#[test]
fn the_arguments_of_distributions_have_limits() {
    assert_snapshot!(told(&[
        "normal()",
        "normal(0)",
        "normal(0, -1)",
        "normal(0 / 0, 1)",
        "normal(0, 1, 2)",
        "normal(0, 1, function() return 0.5 end)",
        "normal(0, 1, nil, 4)",
        "poisson(-1)",
        "poisson(2e15)",
        "poisson(\"3\")",
        "binomial(2.5, 0.5)",
        "binomial(-1, 0.5)",
        "binomial(4, 1.5)",
        "binomial(4)",
        "beta(0, 1)",
        "beta(1, 1 / 0)",
        "beta(1)",
    ]), @r#"
    normal()
      normal takes a finite number as the mean, not nothing
      help: write normal(mean, deviation)
    normal(0)
      normal takes a finite number of at least 0 as the deviation, not nothing
      help: write normal(mean, deviation)
    normal(0, -1)
      normal takes a finite number of at least 0 as the deviation, not -1
      help: write normal(mean, deviation)
    normal(0 / 0, 1)
      normal takes a finite number as the mean, not NaN
      help: write normal(mean, deviation)
    normal(0, 1, 2)
      normal takes a random stream as its last argument, not 2
      help: write normal(mean, deviation) or normal(mean, deviation, r)
    normal(0, 1, function() return 0.5 end)
      normal takes a random stream as its last argument, not a function
      help: write normal(mean, deviation) or normal(mean, deviation, r)
    normal(0, 1, nil, 4)
      normal takes a random stream as its last argument, and nothing after it
      help: write normal(mean, deviation) or normal(mean, deviation, r)
    poisson(-1)
      poisson takes a mean from 0 to 1e15, not -1
      help: write poisson(mean)
    poisson(2e15)
      poisson takes a mean from 0 to 1e15, not 2000000000000000
      help: write poisson(mean)
    poisson("3")
      poisson takes a mean from 0 to 1e15, not the string "3"
      help: write poisson(mean)
    binomial(2.5, 0.5)
      binomial takes a whole number from 0 to 1e15 of trials, not 2.5
      help: write binomial(n, p)
    binomial(-1, 0.5)
      binomial takes a whole number from 0 to 1e15 of trials, not -1
      help: write binomial(n, p)
    binomial(4, 1.5)
      binomial takes a probability from 0 to 1, not 1.5
      help: write binomial(n, p)
    binomial(4)
      binomial takes a probability from 0 to 1, not nothing
      help: write binomial(n, p)
    beta(0, 1)
      beta takes a number from 1e-9 to 1e9 as a, not 0
      help: write beta(a, b)
    beta(1, 1 / 0)
      beta takes a number from 1e-9 to 1e9 as b, not inf
      help: write beta(a, b)
    beta(1)
      beta takes a number from 1e-9 to 1e9 as b, not nothing
      help: write beta(a, b)
    "#);
}

#[test]
fn a_choice_needs_values_and_weights() {
    assert_snapshot!(told(&[
        "choose()",
        "choose(3)",
        "choose({})",
        "choose({ 1, 2 }, 3)",
        "choose({ 1, 2 }, { 3 })",
        "choose({ 1, 2 }, { 3, -1 })",
        "choose({ 1, 2 }, { 3, 0 / 0 })",
        "choose({ 1, 2 }, { 3, \"4\" })",
        "choose({ 1, 2 }, { 0, 0 })",
        "choose({ 1, 2 }, print)",
        "choose({ 1, 2 }, nil, print)",
    ]), @r#"
    choose()
      choose takes a list, not nothing
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    choose(3)
      choose takes a list, not 3
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    choose({})
      choose takes a list with at least one value, but this table has none
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    choose({ 1, 2 }, 3)
      choose takes a list of weights, or a random stream, not 3
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    choose({ 1, 2 }, { 3 })
      choose has 2 values but 1 weights
      help: give each value one weight, in the same order
    choose({ 1, 2 }, { 3, -1 })
      weight 2 of choose is -1
      help: weights are finite numbers of at least 0
    choose({ 1, 2 }, { 3, 0 / 0 })
      weight 2 of choose is NaN
      help: weights are finite numbers of at least 0
    choose({ 1, 2 }, { 3, "4" })
      weight 2 of choose is the string "4"
      help: weights are finite numbers of at least 0
    choose({ 1, 2 }, { 0, 0 })
      no weight of choose is greater than 0, or their sum is not finite
      help: give at least one value a weight greater than 0
    choose({ 1, 2 }, print)
      choose takes a random stream as its last argument, not a function
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    choose({ 1, 2 }, nil, print)
      choose takes a random stream as its last argument, not a function
      help: write choose(list), choose(list, weights) or choose(list, weights, r)
    "#);
}

#[test]
fn a_guard_draws_from_no_distribution() {
    let calls = ["normal(0, 1)", "poisson(0)", "binomial(2, 0.5)", "beta(1, 1)", "choose({ 1 })"];
    for call in calls {
        let said = refused_rules(&format!(
            "s:rule(\"A(x)\", {{ when = function(this, x)\n  return {call} == 1\nend }}, function() return B() end)"
        ));
        assert!(
            without_columns(&said).contains("s.lua:4: rule A(x): a guard cannot use random numbers"),
            "{call}: {said}"
        );
        assert!(said.contains("call random in the successor"), "{call}: {said}");
    }
}

#[test]
fn a_stream_of_the_top_level_is_refused_in_a_rule() {
    let said = refused_rules(
        "local r = stream(\"a\")\ns:rule(\"A(x)\", function(this, x)\n  return A(normal(0, 1, r))\nend)",
    );
    assert!(
        without_columns(&said)
            .contains("s.lua:5: rule A(x): a rule uses a random stream that was created outside it"),
        "{said}"
    );
}
