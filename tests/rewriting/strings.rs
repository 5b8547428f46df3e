//! L-systems written as strings: figures of *The Algorithmic Beauty of Plants*, and the same rules written in Lua.

use std::collections::BTreeMap;

use super::naive;
use super::scripts::{all_chains, chain, chain_of_each, divided, run, run_with, words};

/// Returns the number of each letter after `steps` steps, by the recurrence of the letters.
fn letters(axiom: &str, rules: &[(char, &str)], steps: usize) -> BTreeMap<char, usize> {
    let mut counts: BTreeMap<char, usize> = BTreeMap::new();
    axiom.chars().for_each(|letter| *counts.entry(letter).or_default() += 1);
    for _ in 0..steps {
        let mut next: BTreeMap<char, usize> = BTreeMap::new();
        for (letter, count) in counts {
            let kept = letter.to_string();
            let successor = rules.iter().find(|(known, _)| *known == letter).map_or(&*kept, |rule| rule.1);
            successor.chars().for_each(|made| *next.entry(made).or_default() += count);
        }
        counts = next;
    }
    counts
}

/// Returns the letter of a word of a chain.
fn letter_of(word: &str) -> char {
    match word {
        "Left" => '+',
        "Right" => '-',
        word => word.chars().next().expect("a word"),
    }
}

/// Checks the counts of all letters in a system of `abop` against the recurrence, after each step.
fn check_counts(name: &str, axiom: &str, rules: &[(char, &str)], steps: usize) {
    let keys: String = rules.iter().map(|(letter, text)| format!("{letter} = \"{text}\", ")).collect();
    let script = format!(
        "for steps = 0, {steps} do abop({{ axiom = \"{axiom}\", {keys} angle = 25 }}):derive(steps) end"
    );
    let chains = chain_of_each(&script);
    assert_eq!(chains.len(), steps + 1);
    for (step, chain) in chains.iter().enumerate() {
        let mut found: BTreeMap<char, usize> = BTreeMap::new();
        words(chain).iter().for_each(|word| *found.entry(letter_of(word)).or_default() += 1);
        assert_eq!(found, letters(axiom, rules, step), "{name}, step {step}");
    }
}

#[test]
fn koch_curves_of_figure_1_9_have_the_counts_of_their_recurrences() {
    let curves = [
        ("a", 4, "FF-F-F-F-F-F+F"),
        ("b", 4, "FF-F-F-F-FF"),
        ("c", 3, "FF-F+F-F-FF"),
        ("d", 4, "FF-F--F-F"),
        ("e", 5, "F-FF--F-F"),
        ("f", 4, "F-F+F-F-F"),
    ];
    for (name, steps, successor) in curves {
        check_counts(&format!("1.9 {name}"), "F-F-F-F", &[('F', successor)], steps);
    }
}

#[test]
fn edge_rewriting_of_figure_1_10_uses_the_longest_declared_names() {
    let script = |axiom: &str, left: &str, right: &str, steps: usize| {
        format!(
            "local Fl, Fr = module('Fl'), module('Fr')
             local s = lsystem {{}}
             s:axiom('{axiom}')
             s:rule('Fl', '{left}')
             s:rule('Fr', '{right}')
             s:derive({steps})"
        )
    };
    let dragon = "Fl -> Fl Left Fr Left\nFr -> Right Fl Right Fr";
    for steps in [1, 4, 10] {
        let found = chain(&script("Fl", "Fl+Fr+", "-Fl-Fr", steps));
        assert_eq!(found, naive::derive("Fl", dragon, "", steps));
        assert_eq!(words(&found).iter().filter(|word| word.starts_with('F')).count(), 1 << steps);
    }
    let gasket = "Fl -> Fr Left Fl Left Fr\nFr -> Fl Right Fr Right Fl";
    let found = chain(&script("Fr", "Fr+Fl+Fr", "Fl-Fr-Fl", 6));
    assert_eq!(found, naive::derive("Fr", gasket, "", 6));
    assert_eq!(words(&found).iter().filter(|word| word.starts_with('F')).count(), 729);
}

#[test]
fn plants_of_figure_1_24_have_the_counts_of_their_recurrences() {
    let edges = [("a", 5, "F[+F]F[-F]F"), ("b", 5, "F[+F]F[-F][F]"), ("c", 4, "FF-[-F+F+F]+[+F-F-F]")];
    for (name, steps, successor) in edges {
        check_counts(&format!("1.24 {name}"), "F", &[('F', successor)], steps);
    }
    let apices = [("d", 6, "F[+X]F[-X]+X"), ("e", 6, "F[+X][-X]FX"), ("f", 5, "F-[[X]+X]+F[+FX]-X")];
    for (name, steps, successor) in apices {
        check_counts(&format!("1.24 {name}"), "X", &[('X', successor), ('F', "FF")], steps);
    }
    // Closed form of figure 1.24 d: each apex becomes three, so F(n + 1) = 2 F(n) + 2 * 3^n.
    let counts = letters("X", &[('X', "F[+X]F[-X]+X"), ('F', "FF")], 7);
    assert_eq!((counts[&'X'], counts[&'F']), (2187, 2 * (2187 - 128)));
}

#[test]
fn the_pattern_of_figure_1_31_b_grows_as_an_independent_rewriter_says() {
    let script = |steps: usize| {
        format!(
            "abop({{ axiom = 'F1F1F1', angle = 22.5, ignore = '+-F',
               ['0 < 0 > 0'] = '1', ['0 < 0 > 1'] = '1[-F1F1]', ['0 < 1 > 0'] = '1', ['0 < 1 > 1'] = '1',
               ['1 < 0 > 0'] = '0', ['1 < 0 > 1'] = '1F1', ['1 < 1 > 0'] = '1', ['1 < 1 > 1'] = '0',
               ['+'] = '-', ['-'] = '+' }}):derive({steps})"
        )
    };
    let successors = ["I", "I [ Right F I F I ]", "I", "I", "O", "I F I", "I", "O"];
    let mut rules = String::from("Left -> Right\nRight -> Left\n");
    for (number, successor) in successors.iter().enumerate() {
        let bit = |place: usize| if number >> place & 1 == 1 { "I" } else { "O" };
        rules.push_str(&format!("{} < {} > {} -> {successor}\n", bit(2), bit(1), bit(0)));
    }
    for steps in [1, 2, 5, 8, 13, 20] {
        let found = chain(&script(steps)).replace("_0", "O").replace("_1", "I");
        assert_eq!(found, naive::derive("F I F I F I", &rules, "Left Right F", steps), "{steps} steps");
    }
}

/// Checks that a successor as a string gives the chains of the successor in Lua, for several divisions of the work.
fn check_equal(declarations: &str, axiom: &str, pattern: &str, string: &str, lua: &str) {
    let script = |successor: &str| {
        format!(
            "{declarations}
             local s = lsystem {{ object = turtle {{ palette = {{ 'red', 'tan' }} }} }}
             s:axiom({axiom})
             s:rule(\"{pattern}\", {successor})
             s:derive(5)"
        )
    };
    let outcome = |successor: &str, threads, batch| {
        let run = run_with(&script(successor), divided(threads, batch));
        (all_chains(&run), burgeon::export::gltf::glb(&run.scene).expect("a model"))
    };
    let expected = outcome(&format!("[[ {lua} ]]"), 1, 4096);
    assert!(expected.0.len() > 40, "{}", expected.0);
    for (threads, batch) in [(1, 4096), (3, 10)] {
        assert!(outcome(&format!("[==[{string}]==]"), threads, batch) == expected, "{string}");
    }
}

#[test]
fn a_string_is_the_same_rule_as_its_lua() {
    let declared = "local A, B, Stem = module('A', 'x', 'n'), module('B'), module('Stem', 'x')";
    for (string, lua) in [
        (
            "F(x*0.5)[+A(x*0.7,n-1)]-A(x,n-1)",
            "return F(x*0.5), { Left(), A(x*0.7, n-1) }, Right(), A(x, n-1)",
        ),
        (
            "Stem(x) [ +(30 * random()) A(x, n) ]\n  [ -(normal(20, 5)) B ]",
            "return Stem(x), { Left(30 * random()), A(x, n) }, { Right(normal(20, 5)), B() }",
        ),
        ("[[A(math.max(x, 1), (n)) B]B]F", "return { { A(math.max(x, 1), n), B() }, B() }, F()"),
        (
            "A(x, #\"a)(\")&(10)^/\\|$F(1)",
            "return A(x, 3), Down(10), Up(), RollRight(), RollLeft(), TurnAround(), Level(), F(1)",
        ),
        (
            "#(0.2)!(x/9){.f.+f(2).}@O(x);(2)F\u{2212}F A(x, n)",
            "return Width(0.2), Width(x / 9), BeginPolygon(), Point(), G(), Point(), Left(), G(2), Point(), EndPolygon(), Sphere(x), Paint(2), F(), Right(), F(), A(x, n)",
        ),
    ] {
        check_equal(declared, "A(2, 4), A(1, 3)", "A(x, n)", string, lua);
    }
}

#[test]
fn a_string_as_an_axiom_is_the_chain_of_its_modules() {
    let declared = "local A, F1 = module('A', 'x', 'y?'), module('F1')\nlocal s = lsystem {}\n";
    let axiom = |axiom: &str| chain(&format!("{declared}s:axiom({axiom})\ns:derive(0)"));
    for (string, modules) in [
        ("'F-F-F-F'", "F(), Right(), F(), Right(), F(), Right(), F()"),
        ("'A(2 ^ 3)[F1 F]FF1A(1, math.sqrt(4))'", "A(8), { F1(), F() }, F(), F1(), A(1, 2)"),
        ("'+(90)A(vec(1, 2, 3).y, true)'", "Left(90), A(2, true)"),
    ] {
        assert_eq!(axiom(string), axiom(modules), "{string}");
    }
    for empty in ["''", "' '", "'*'", "'\u{3b5}'"] {
        assert_eq!(axiom(empty), "", "{empty}");
    }
    let long = axiom("string.rep('F+', 1500)");
    assert_eq!(words(&long).len(), 3000);
    let seeded = axiom("'A(random())A(random())'");
    assert_eq!(seeded, axiom("A(random()), A(random())"));
}

#[test]
fn empty_strings_erase_and_long_ones_are_kept_whole() {
    let script = |successor: &str| {
        format!(
            "local A = module('A')
             local s = lsystem {{}}
             s:axiom('FAF')
             s:rule('A', {successor})
             s:derive(1)"
        )
    };
    for empty in ["''", "'*'", "' \u{3b5} '", "[[ return nil ]]"] {
        assert_eq!(chain(&script(empty)), "F F", "{empty}");
    }
    let long = chain(&script("string.rep('+F[-A]', 400)"));
    assert_eq!(words(&long).len(), 2 + 400 * 6);
    // A string with the word return is still Lua, and a name that contains it is not that word.
    assert_eq!(chain(&script("[[ if false then return F() end ]]")), "F A F");
    let named = script("'returnF'").replace("'A')", "'A')\nlocal returnF = module('returnF')");
    assert_eq!(chain(&named), "F returnF F");
}

#[test]
fn a_script_s_own_module_wins_over_a_symbol_of_the_turtle() {
    let script = |declared: &str| {
        format!("{declared}\nlocal s = lsystem {{}}\ns:axiom('fF+')\ns:rule('f', 'Ff')\ns:derive(1)")
    };
    assert_eq!(chain(&script("")), "F G F Left");
    assert_eq!(chain(&script("local f = module('f')")), "F f F Left");
    assert_eq!(chain(&script("local Left = module('Left', 'a?', 'b?')")), "F G F Left");
}

#[test]
fn patterns_take_symbols_digits_and_joined_letters() {
    let script = |rule: &str| {
        format!(
            "local A, B, Hit = module('A'), module('B'), module('Hit')
             local _1 = module('_1')
             local s = lsystem {{}}
             s:ignore('fG')
             s:axiom('A+B[-A1]fB')
             s:rule({rule}, 'Hit')
             s:derive(1)"
        )
    };
    for (rule, expected) in [
        ("'+ < B'", "A Left Hit [ Right A _1 ] G B"),
        ("'A+ < B'", "A Left Hit [ Right A _1 ] G B"),
        ("'A Left < B'", "A Left Hit [ Right A _1 ] G B"),
        ("'A > +B'", "Hit Left B [ Right A _1 ] G B"),
        ("'- < A > 1'", "A Left B [ Right Hit _1 ] G B"),
        ("'1'", "A Left B [ Right A Hit ] G B"),
        ("'+'", "A Hit B [ Right A _1 ] G B"),
        ("'B > [-A] B'", "A Left Hit [ Right A _1 ] G B"),
        ("'f'", "A Left B [ Right A _1 ] Hit B"),
    ] {
        assert_eq!(chain(&script(rule)), expected, "{rule}");
    }
}

#[test]
fn abop_declares_letters_and_keeps_those_of_the_script() {
    let found = chain("abop({ axiom = 'A(3)', ['A(n)'] = 'F(n)[+A(n - 1)]B(n, 2)B' }):derive(2)");
    assert_eq!(found, "F(3) [ Left F(2) [ Left A(1) ] B(2,2) B ] B(3,2) B");
    // A letter with parameters takes part with them.
    let found = chain(
        "local A = module('A', 'age')
         local s = abop({ axiom = 'A(1)X', ['A(n)'] = 'A(n + 1)X', X = '', object = extruder() })
         s:rule('X', 'X')
         s:interpret('A(n)', function(this, n) this:extrude(n) end)
         s:derive(3)",
    );
    assert_eq!(found, "A(4) X");
    let drawn = run("abop({ axiom = 'X', X = 'F[+X]F', angle = 30, step = 2, width = 0.5 }):derive(3)");
    assert!(!drawn.scene.meshes.is_empty(), "the turtle draws");
}

/// Returns the heading of the last module of `axiom`, for a turtle along x whose simple tropism points to (0, -0.6, 0.8).
fn heading_after(axiom: &str) -> [f64; 3] {
    let found = chain(&format!(
        "local H = module('H', 'x', 'y', 'z')
         local pen = turtle({{ heading = {{ 1, 0, 0 }}, simple_tropism = {{ 0, -3, 4 }}, simple_increment = 0.25 }})
         abop({{ axiom = '{axiom}', X = 'local h = this:heading() return H(h.x, h.y, h.z)', object = pen }}):derive(1)"
    ));
    let (_, values) = found.rsplit_once("H(").expect("the heading");
    let values: Vec<f64> =
        values.trim_end_matches(')').split(',').map(|value| value.parse().expect("a number")).collect();
    values.try_into().expect("three numbers")
}

#[test]
fn an_underscore_sets_or_increases_the_elasticity_of_the_simple_tropism_as_in_cpfg() {
    // With an elasticity of 0.5, the sines of the two angles are 0.3 towards the up vector, and 0.4 towards the left.
    let bent = [(0.91_f64 * 0.84).sqrt(), -0.3 * 0.84_f64.sqrt(), 0.4];
    for (axiom, expected) in [
        ("_(0.5)X", [1.0, 0.0, 0.0]),
        ("_(0.5)FX", bent),
        ("_(0.5)fX", bent),
        ("__fX", bent),
        ("_(9)_(0.25)_fX", bent),
        ("[_(0.5)]fX", [1.0, 0.0, 0.0]),
    ] {
        let found = heading_after(axiom);
        let near = found.iter().zip(expected).all(|(found, expected)| (found - expected).abs() < 1e-9);
        assert!(near, "{axiom}: {found:?} instead of {expected:?}");
    }
    assert_eq!(chain("abop({ axiom = 'AF_F', ['_ < F'] = 'A' }):derive(1)"), "A F SimpleElasticity A");
    // A name that contains an underscore stays a name.
    assert_eq!(
        chain("local A_b = module('A_b') abop({ axiom = 'A_bA_b', A_b = 'F_F' }):derive(1)")
            .matches('F')
            .count(),
        4
    );
}

#[test]
fn abop_tries_longer_contexts_first() {
    let keys = ["B = 'D'", "['A < B'] = 'E'", "['A < B > C'] = 'K'"];
    for order in [[0, 1, 2], [2, 1, 0], [1, 2, 0]] {
        let rules: Vec<&str> = order.iter().map(|index| keys[*index]).collect();
        let script = format!("abop({{ axiom = 'ABCABB', {} }}):derive(1)", rules.join(", "));
        assert_eq!(chain(&script), "A K C A E D");
    }
    let ignoring = "abop({ axiom = 'A+B', ['A < B'] = 'E', ignore = { '+', 'Right' } }):derive(1)";
    assert_eq!(chain(ignoring), "A Left E");
    let considering = "abop({ axiom = 'AXB', ['A < B'] = 'E', X = 'X', consider = 'AB' }):derive(1)";
    assert_eq!(chain(considering), "A X E");
}

#[test]
fn lists_of_successors_are_random_choices() {
    let shares = |rule: &str| {
        let text = chain(&format!("abop({{ axiom = string.rep('A', 3000), A = {rule} }}):derive(1)"));
        ["B", "C", "D"].map(|name| words(&text).iter().filter(|word| *word == name).count() as f64)
    };
    let expect = |found: [f64; 3], expected: [f64; 3]| {
        let terms = found.iter().zip(expected).filter(|(_, expected)| *expected > 0.0);
        let chi: f64 = terms.map(|(found, expected)| (found - expected).powi(2) / expected).sum();
        assert!(chi < 16.0 && found.iter().sum::<f64>() == 3000.0, "{found:?}, not {expected:?}");
    };
    expect(shares("{ 'B', 'C', 'D' }"), [1000.0; 3]);
    expect(shares("{ { 2, 'B' }, { 1, 'C' }, { 0, 'D' } }"), [2000.0, 1000.0, 0.0]);
    expect(shares("{ 'B', { 4, 'D' } }"), [600.0, 0.0, 2400.0]);
}

#[test]
fn strings_work_in_decompositions_and_with_guards() {
    let found = chain(
        "local A, B = module('A', 'n'), module('B', 'n')
         local s = lsystem {}
         s:axiom('A(3)')
         s:rule('A(n)', { when = function(this, n) return n > 1 end }, 'B(n)A(n - 1)')
         s:rule('A(n)', 'F')
         s:decompose('B(n)', '+(n)F')
         s:derive(3)",
    );
    assert_eq!(found, "Left(3) F Left(2) F F");
}
