//! Random numbers of common distributions: moments, frequencies, limits, and the same numbers everywhere.

use super::scripts::{all_chains, chain, divided, run_with, words};
use burgeon::script::RunOptions;

/// Returns `count` values of an expression, 200 for each module.
fn draws(expression: &str, count: usize) -> Vec<f64> {
    let script = format!(
        "local A, B = module('A'), module('B', 'x')
         local list = {{}}
         for i = 1, {modules} do list[i] = A() end
         local s = lsystem {{}}
         s:axiom(table.unpack(list))
         s:rule('A', function()
           local drawn = {{}}
           for i = 1, 200 do drawn[i] = B({expression}) end
           return table.unpack(drawn)
         end)
         s:derive(1)",
        modules = count / 200
    );
    let text = all_chains(&run_with(&script, RunOptions { seed: 11, ..burgeon::options() }));
    let numbers = text.split_whitespace().filter_map(|word| word.strip_prefix("B(")?.strip_suffix(')'));
    let numbers: Vec<f64> = numbers.map(|number| number.parse().expect("a number")).collect();
    assert_eq!(numbers.len(), count, "{expression}");
    numbers
}

/// Checks mean and variance, each within 4.5 standard errors. `kurtosis` is the fourth central moment by the squared
/// variance.
fn check_moments(expression: &str, values: &[f64], mean: f64, variance: f64, kurtosis: f64) {
    let count = values.len() as f64;
    let found = values.iter().sum::<f64>() / count;
    let spread = values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count;
    let error = (variance / count).sqrt();
    assert!((found - mean).abs() < 4.5 * error, "{expression}: mean {found}, not {mean}");
    let error = variance * ((kurtosis - 1.0) / count).sqrt();
    assert!((spread - variance).abs() < 4.5 * error, "{expression}: variance {spread}, not {variance}");
}

/// Checks observed counts against probabilities, by a chi-square test whose statistic is at most 4.5 standard deviations
/// above its mean. Classes with few expected values are joined.
fn check_frequencies(expression: &str, observed: &[f64], probabilities: &[f64]) {
    let count: f64 = observed.iter().sum();
    let (mut chi, mut classes, mut seen, mut expected) = (0.0, 0.0, 0.0, 0.0);
    for (observed, probability) in observed.iter().zip(probabilities) {
        seen += observed;
        expected += probability * count;
        if expected >= 10.0 {
            chi += (seen - expected).powi(2) / expected;
            classes += 1.0;
            (seen, expected) = (0.0, 0.0);
        }
    }
    let freedom: f64 = classes - 1.0;
    assert!(freedom >= 1.0, "{expression}");
    let bound = freedom + 4.5 * (2.0 * freedom).sqrt() + 3.0;
    assert!(chi < bound, "{expression}: chi-square {chi} with {freedom} degrees of freedom");
}

/// Returns the number of values in each class of whole numbers from 0 on.
fn counts(values: &[f64], classes: usize) -> Vec<f64> {
    let mut counts = vec![0.0; classes];
    for value in values {
        assert!(*value >= 0.0 && value.fract() == 0.0, "{value}");
        counts[(*value as usize).min(classes - 1)] += 1.0;
    }
    counts
}

#[test]
fn normal_numbers_have_the_shares_of_the_bell_curve() {
    let values = draws("normal(3, 2)", 40_000);
    check_moments("normal(3, 2)", &values, 3.0, 4.0, 3.0);
    // Deciles of the standard normal distribution, and 0.1 % in each tail.
    let bounds = [
        -3.090_232, -1.281_552, -0.841_621, -0.524_401, -0.253_347, 0.0, 0.253_347, 0.524_401, 0.841_621,
        1.281_552, 3.090_232,
    ];
    let class = |value: f64| bounds.iter().filter(|bound| (value - 3.0) / 2.0 >= **bound).count() as f64;
    let classes: Vec<f64> = values.iter().map(|value| class(*value)).collect();
    let mut shares = [0.1; 12];
    (shares[0], shares[1], shares[10], shares[11]) = (0.001, 0.099, 0.099, 0.001);
    check_frequencies("normal(3, 2)", &counts(&classes, 12), &shares);
}

#[test]
fn poisson_counts_have_their_probabilities_with_both_methods() {
    for mean in [0.3, 4.0, 9.99, 10.0, 37.3, 400.0] {
        let expression = format!("poisson({mean})");
        let values = draws(&expression, 20_000);
        check_moments(&expression, &values, mean, mean, 3.0 + 1.0 / mean);
        let classes = (mean + 10.0 * mean.sqrt()) as usize + 12;
        let mut shares = vec![0.0; classes];
        let mut logarithm = -mean;
        for (count, share) in shares.iter_mut().enumerate() {
            if count > 0 {
                logarithm += (mean / count as f64).ln();
            }
            *share = logarithm.exp();
        }
        check_frequencies(&expression, &counts(&values, classes), &shares);
    }
}

#[test]
fn binomial_counts_have_their_probabilities_with_both_methods() {
    for (n, p) in
        [(10, 0.3), (10, 0.85), (40, 0.25), (40, 0.8), (1000, 0.5), (20_000, 0.0004), (20_000, 0.03)]
    {
        let expression = format!("binomial({n}, {p})");
        let values = draws(&expression, 20_000);
        let (trials, q) = (f64::from(n), 1.0 - p);
        let variance = trials * p * q;
        check_moments(&expression, &values, trials * p, variance, 3.0 + (1.0 - 6.0 * p * q) / variance);
        let mut shares = Vec::new();
        let mut logarithm = trials * q.ln();
        for count in 0..=n {
            shares.push(logarithm.exp());
            logarithm += (f64::from(n - count) / f64::from(count + 1) * p / q).ln();
        }
        check_frequencies(&expression, &counts(&values, shares.len()), &shares);
    }
}

/// Returns the probabilities of 20 equal classes of a beta distribution, by the trapezoid rule in a variable in which the
/// density has no poles.
fn beta_shares(a: f64, b: f64) -> Vec<f64> {
    const STEPS: usize = 400_000;
    let mut shares = [0.0; 20];
    for step in 1..STEPS {
        // x = 1 / (1 + e^-t), so that dx = x (1 - x) dt.
        let t = (step as f64 / STEPS as f64 - 0.5) * 400.0;
        let x = 1.0 / (1.0 + (-t).exp());
        let weight = (-a * (-t).exp().ln_1p() - b * t.exp().ln_1p()).exp();
        shares[((x * 20.0) as usize).min(19)] += weight;
    }
    let sum: f64 = shares.iter().sum();
    shares.iter().map(|share| share / sum).collect()
}

#[test]
fn beta_numbers_have_their_shares_with_all_three_methods() {
    let shapes: [(f64, f64); 8] =
        [(1.0, 1.0), (0.5, 0.5), (0.2, 0.9), (0.5, 3.0), (4.0, 0.3), (1.0, 5.0), (2.0, 3.0), (20.0, 30.0)];
    for (a, b) in shapes {
        let expression = format!("beta({a}, {b})");
        let values = draws(&expression, 20_000);
        assert!(values.iter().all(|value| (0.0..=1.0).contains(value)), "{expression}");
        let sum = a + b;
        let variance = a * b / (sum * sum * (sum + 1.0));
        let excess =
            6.0 * ((a - b).powi(2) * (sum + 1.0) - a * b * (sum + 2.0)) / (a * b * (sum + 2.0) * (sum + 3.0));
        check_moments(&expression, &values, a / sum, variance, 3.0 + excess);
        let classes: Vec<f64> = values.iter().map(|value| (value * 20.0).floor().min(19.0)).collect();
        check_frequencies(&expression, &counts(&classes, 20), &beta_shares(a, b));
    }
}

#[test]
fn values_are_chosen_in_proportion_to_their_weights() {
    let values = draws("choose({ 0, 1, 2, 3, 4 })", 20_000);
    check_frequencies("equal", &counts(&values, 5), &[0.2; 5]);
    let values = draws("choose({ 0, 1, 2, 3, 4 }, { 1, 0, 2.5, 6.5, 0 })", 20_000);
    let found = counts(&values, 5);
    check_frequencies("weighted", &found, &[0.1, 0.0, 0.25, 0.65, 0.0]);
    assert_eq!((found[1], found[4]), (0.0, 0.0));
    let text = chain(
        "local A = module('A', 'x', 'y', 'z')
         local s = lsystem {}
         s:axiom(A(choose({ 'only' }), choose({ true }, { 3 }), choose({ vec(1, 2, 3) }, { 1 }).y))
         s:derive(0)",
    );
    assert_eq!(text, "A(\"only\",true,2)");
    let text = chain(
        "local s = lsystem {}
         s:axiom(string.rep('F', 60))
         s:rule('F', function() return choose({ F(1), G(2) }), choose({ Left, Right })(3) end)
         s:derive(1)",
    );
    let drawn = words(&text);
    let share = |name: &str| drawn.iter().filter(|word| *word == name).count();
    assert_eq!((share("F(1)") + share("G(2)"), share("Left(3)") + share("Right(3)")), (60, 60));
    assert!(share("F(1)") > 15 && share("G(2)") > 15 && share("Left(3)") > 15 && share("Right(3)") > 15);
}

/// Returns the values of a list of expressions, as modules `B`.
fn values(expressions: &str) -> String {
    chain(&format!(
        "local A, B = module('A'), module('B', 'x')
         local s = lsystem {{}}
         s:axiom(A())
         s:rule('A', function()
           local made = {{}}
           for i, x in {{ {expressions} }} do made[i] = B(x) end
           return table.unpack(made)
         end)
         s:derive(1)"
    ))
}

#[test]
fn arguments_at_their_limits_are_accepted() {
    let certain = "normal(5, 0), poisson(0), binomial(0, 0.5), binomial(9, 0), binomial(9, 1)";
    assert_eq!(values(certain), "B(5) B(0) B(0) B(0) B(9)");
    let sizes = [
        ("poisson(1e15) / 1e15", 1.0, 1e-6),
        ("binomial(1e15, 0.5) / 1e15", 0.5, 1e-6),
        ("binomial(1e15, 1e-300)", 0.0, 0.0),
        ("beta(1e9, 1e9)", 0.5, 1e-3),
        ("beta(1e-9, 1e9)", 0.0, 1e-6),
        ("beta(1e9, 1e-9)", 1.0, 1e-6),
        ("(2 * beta(1e-9, 1e-9) - 1) ^ 2", 1.0, 1e-9),
        ("normal(1e300, 1) / 1e300", 1.0, 1e-9),
    ];
    for (expression, expected, tolerance) in sizes {
        let value: f64 =
            values(expression).trim_matches(|c: char| "B()".contains(c)).parse().expect("a number");
        assert!((value - expected).abs() <= tolerance, "{expression}: {value}");
    }
}

#[test]
fn a_distribution_draws_from_a_named_stream_and_leaves_the_others_alone() {
    let drawn =
        "normal(0, 1, r()), poisson(40, r()), binomial(90, 0.4, r()), beta(2, 3, r()), beta(0.3, 2, r()),
        beta(0.3, 0.2, r()), choose({ 1, 2, 3, 4 }, r()), choose({ 1, 2 }, { 1, 3 }, r())";
    // The first calls run as bytecode, the later ones as native code where there is any.
    let named = |key: &str| drawn.replace("r()", &format!("stream('{key}')"));
    let text = values(&format!("random(), {}, random(), {}", named("x"), named("x")));
    let words: Vec<&str> = text.split(' ').collect();
    assert_eq!(words.len(), 18);
    assert_eq!(words[1..9], words[10..18]);
    assert_eq!(format!("{} {}", words[0], words[9]), values("random(), random()"));
    assert_ne!(values(&named("x")), values(&named("y")));
    // Each takes the next numbers of the stream that it draws from.
    assert_eq!(values("random(), normal(0, 1)"), values("random(), normal(0, 1, random)"));
    let once = values("(function() local r = stream('x') normal(0, 1, r) return r() end)()");
    assert_eq!(once, values("(function() local r = stream('x') r() return r() end)()"));
}

#[test]
fn the_numbers_are_the_same_on_every_platform() {
    let found = values(
        "normal(0, 1), normal(10, 0.5), poisson(3), poisson(50), poisson(1e6), binomial(20, 0.2), binomial(500, 0.3),
         beta(2, 3), beta(0.4, 2.5), beta(0.3, 0.6), choose({ 1, 2, 3, 4, 5 })",
    );
    insta::assert_snapshot!(found, @"B(1.1407630659167387) B(10.207554241227932) B(0) B(47) B(999614) B(7) B(137) B(0.6358951496761236) B(0.01121267496852193) B(0.8740824093048603) B(4)");
}

#[test]
fn the_numbers_are_the_same_for_any_number_of_threads() {
    let script = "local A, B = module('A', 'n'), module('B', 'x', 'y')
        local list = {}
        for i = 1, 400 do list[i] = A(i) end
        local s = lsystem { object = extruder { sides = 4 } }
        s:axiom(table.unpack(list))
        s:rule('A(n)', function(this, n)
          if n % 3 == 0 then return A(n + 1), A(n + 2) end
          return B(normal(0, n), poisson(n)), B(beta(n, 2), binomial(n, 0.3, stream('b')))
        end)
        s:interpret('B(x, y)', function(this, x, y) this:extrude(1 + beta(2, 2) + poisson(y)) end)
        s:derive(3)";
    let outcome = |threads, batch| {
        let run = run_with(script, divided(threads, batch));
        (all_chains(&run), burgeon::export::gltf::glb(&run.scene).expect("a model"))
    };
    let expected = outcome(1, 4096);
    for (threads, batch) in [(1, 1), (3, 10), (4, 100)] {
        assert!(outcome(threads, batch) == expected, "{threads} threads, {batch} modules");
    }
}
