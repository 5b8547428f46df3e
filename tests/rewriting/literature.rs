//! Known answers from *The Algorithmic Beauty of Plants* (ABOP) and the works that it cites.

use super::naive;
use super::scripts::{Plain, chain, chain_of_each, words};

const ALGAE: Plain = Plain { ignore: "", axiom: "B", rules: "A -> A B\nB -> A" };

fn count(chain: &str, name: &str) -> usize {
    words(chain).iter().filter(|word| *word == name).count()
}

#[test]
fn algae_grow_as_in_the_first_example() {
    let told = ["B", "A", "A B", "A B A", "A B A A B", "A B A A B A B A"];
    assert_eq!(ALGAE.first(6), told);
}

#[test]
fn the_lengths_of_algae_are_fibonacci_numbers() {
    let (mut length, mut next) = (1, 1);
    for (steps, chain) in ALGAE.first(20).iter().enumerate() {
        assert_eq!(words(chain).len(), length, "after {steps} steps");
        (length, next) = (next, length + next);
    }
}

#[test]
fn anabaena_catenula_divides_in_both_directions() {
    let anabaena = Plain {
        ignore: "",
        axiom: "AR",
        rules: "AR -> AL BR
                AL -> BL AR
                BR -> AR
                BL -> AL",
    };
    let told = ["AR", "AL BR", "BL AR AR", "AL AL BR AL BR", "BL AR BL AR AR BL AR AR"];
    assert_eq!(anabaena.first(5), told);
}

#[test]
fn the_parametric_example_of_section_1_10_runs_as_printed() {
    let found = chain_of_each(
        r#"
            local A = module("A", "x", "y"); local B = module("B", "x"); local C = module("C")
            for steps = 0, 5 do
            local s = lsystem {}
            s:axiom(B(2), A(4, 4))
            s:rule("A(x, y)", { when = function(this, x, y) return y <= 3 end }, function(this, x, y)
              return A(x * 2, x + y)
            end)
            s:rule("A(x, y)", { when = function(this, x, y) return y > 3 end }, function(this, x, y)
              return B(x), A(x / y, 0)
            end)
            s:rule("B(x)", { when = function(this, x) return x < 1 end }, function() return C() end)
            s:rule("B(x)", { when = function(this, x) return x >= 1 end }, function(this, x) return B(x - 1) end)
            s:derive(steps)
            end
        "#,
    );
    let told = [
        "B(2) A(4,4)",
        "B(1) B(4) A(1,0)",
        "B(0) B(3) A(2,1)",
        "C B(2) A(4,3)",
        "C B(1) A(8,7)",
        "C B(0) B(8) A(1.1428571428571428,0)",
    ];
    assert_eq!(found, told);
}

#[test]
fn the_row_of_trees_keeps_its_length_along_the_ground() {
    // ABOP, section 1.10.2: of the four parts of a line, the first and the last lie on it.
    let text = chain(
        r#"
        local F = module("F", "x"); local Plus = module("Plus"); local Minus = module("Minus")
        local p = 0.3; local q = 1 - p; local h = (p * q) ^ 0.5
        local s = lsystem {}
        s:axiom(F(1))
        s:rule("F(x)", function(this, x)
          return F(x * p), Plus(), F(x * h), Minus(), Minus(), F(x * h), Plus(), F(x * q)
        end)
        s:derive(4)
        "#,
    );
    let mut lengths: Vec<f64> = vec![1.0];
    let h = (0.3_f64 * 0.7).sqrt();
    for _ in 0..4 {
        lengths = lengths.iter().flat_map(|x| [x * 0.3, x * h, x * h, x * 0.7]).collect();
    }
    let shown: Vec<f64> =
        text.split(' ').filter_map(|word| word.strip_prefix("F(")?.strip_suffix(')')?.parse().ok()).collect();
    assert_eq!(shown.len(), 256);
    for (shown, expected) in shown.iter().zip(&lengths) {
        assert!((shown - expected).abs() < 1e-15, "{shown} and {expected}");
    }
}

/// Checks the numbers of `F` after each step of a system with this axiom and these rules.
fn check_fractal(axiom: &str, rules: &str, counts: &[usize]) {
    let system = Plain { ignore: "", axiom, rules };
    for (steps, (chain, expected)) in system.first(counts.len()).iter().zip(counts).enumerate() {
        assert_eq!(*chain, naive::derive(axiom, rules, "", steps), "after {steps} steps");
        assert_eq!(count(chain, "F") + count(chain, "FL") + count(chain, "FR"), *expected);
    }
}

#[test]
fn the_quadratic_koch_island_has_eight_times_as_many_edges_each_step() {
    let rules = "F -> F Minus F Plus F Plus F F Minus F Minus F Plus F";
    check_fractal("F Minus F Minus F Minus F", rules, &[4, 32, 256, 2048]);
}

#[test]
fn the_koch_curve_has_length_as_its_closed_form_says() {
    let curve = Plain { ignore: "", axiom: "F", rules: "F -> F Plus F Minus Minus F Plus F" };
    for (chain, edges) in curve.first(5).iter().zip([1usize, 4, 16, 64, 256]) {
        // Each edge becomes four edges and four turns, so the number of turns is (4^n - 1) / 3 times 4.
        assert_eq!(words(chain).len(), edges + (edges - 1) / 3 * 4);
    }
}

#[test]
fn the_dragon_curve_doubles_its_edges() {
    check_fractal(
        "FL",
        "FL -> FL Plus FR Plus\nFR -> Minus FL Minus FR",
        &[1, 2, 4, 8, 16, 32, 64, 128, 256],
    );
    let dragon = Plain { ignore: "", axiom: "FL", rules: "FL -> FL Plus FR Plus\nFR -> Minus FL Minus FR" };
    assert_eq!(dragon.derive([2]), ["FL Plus FR Plus Plus Minus FL Minus FR Plus"]);
}

#[test]
fn the_hilbert_curve_visits_every_cell_but_the_first() {
    let rules = "X -> Plus Y F Minus X F X Minus F Y Plus\nY -> Minus X F Plus Y F Y Plus F X Minus";
    check_fractal("X", rules, &[0, 3, 15, 63, 255]);
}

#[test]
fn penrose_tiles_rewrite_inside_branches_and_erase_old_edges() {
    let rules = "M -> O F Plus Plus P F Minus Minus Minus Minus N F [ Minus O F Minus Minus Minus Minus M F ] Plus Plus
                 N -> Plus O F Minus Minus P F [ Minus Minus Minus M F Minus Minus N F ] Plus
                 O -> Minus M F Plus Plus N F [ Plus Plus Plus O F Plus Plus P F ] Minus
                 P -> Minus Minus O F Plus Plus Plus Plus M F [ Plus P F Plus Plus Plus Plus N F ] Minus Minus N F
                 F ->";
    let axiom = "[ N ] Plus Plus [ N ] Plus Plus [ N ] Plus Plus [ N ] Plus Plus [ N ]";
    // M makes M N O O P, N makes M N O P, O makes M N O P, P makes M N N O P: the matrix of the five letters.
    let mut letters = [0usize, 5, 0, 0];
    let system = Plain { ignore: "", axiom, rules };
    for (steps, chain) in system.first(5).iter().enumerate().skip(1) {
        let edges = letters[0] * 5 + letters[1] * 4 + letters[2] * 4 + letters[3] * 5;
        let [m, n, o, p] = letters;
        let all = m + n + o + p;
        letters = [all, all + p, all + m, all];
        assert_eq!(*chain, naive::derive(axiom, rules, "", steps));
        assert_eq!(count(chain, "F"), edges, "edges after {steps} steps");
    }
}

#[test]
fn a_signal_runs_along_a_chain() {
    let signal = Plain { ignore: "", axiom: "B A A A A A A A A", rules: "B < A -> B\nB -> A" };
    let told = ["A B A A A A A A A", "A A B A A A A A A", "A A A A A A A A B", "A A A A A A A A A"];
    assert_eq!(signal.derive([1, 2, 8, 9]), told);
}

#[test]
fn an_acropetal_signal_enters_every_branch() {
    // ABOP, figure 1.30 a.
    let signal = Plain {
        ignore: "Plus Minus",
        axiom: "FB [ Plus FA ] FA [ Minus FA ] FA [ Plus FA ] FA",
        rules: "FB < FA -> FB",
    };
    let told = [
        "FB [ Plus FB ] FB [ Minus FA ] FA [ Plus FA ] FA",
        "FB [ Plus FB ] FB [ Minus FB ] FB [ Plus FA ] FA",
        "FB [ Plus FB ] FB [ Minus FB ] FB [ Plus FB ] FB",
    ];
    assert_eq!(signal.derive([1, 2, 3]), told);
}

#[test]
fn a_basipetal_signal_stays_on_the_main_axis() {
    // ABOP, figure 1.30 b.
    let signal = Plain {
        ignore: "Plus Minus",
        axiom: "FA [ Plus FA ] FA [ Minus FA ] FA [ Plus FA ] FB",
        rules: "FA > FB -> FB",
    };
    let told = [
        "FA [ Plus FA ] FA [ Minus FA ] FB [ Plus FA ] FB",
        "FA [ Plus FA ] FB [ Minus FA ] FB [ Plus FA ] FB",
        "FB [ Plus FA ] FB [ Minus FA ] FB [ Plus FA ] FB",
    ];
    assert_eq!(signal.derive([1, 2, 3]), told);
    assert_eq!(signal.derive([4]), [told[2]]);
}

/// Returns the rules of Hogeweg and Hesper for the successors of 000, 001, 010, 011, 100, 101, 110 and 111.
fn hogeweg_hesper(successors: [&str; 8]) -> String {
    let mut rules = String::new();
    for (number, successor) in successors.iter().enumerate() {
        let bit = |place: usize| if number >> place & 1 == 1 { "I" } else { "O" };
        rules.push_str(&format!("{} < {} > {} -> {successor}\n", bit(2), bit(1), bit(0)));
    }
    rules + "Plus -> Minus\nMinus -> Plus"
}

const IGNORED: &str = "Plus Minus F";
/// Systems of ABOP, figure 1.31 a to e.
const PATTERNS: [(&str, [&str; 8]); 5] = [
    ("F I F I F I", ["O", "I [ Plus F I F I ]", "I", "I", "O", "I F I", "O", "O"]),
    ("F I F I F I", ["I", "I [ Minus F I F I ]", "I", "I", "O", "I F I", "I", "O"]),
    ("F I F I F I", ["O", "I", "O", "I [ Plus F I F I ]", "O", "I F I", "O", "O"]),
    ("F O F I F I", ["I", "O", "O", "I F I", "I", "I [ Plus F I F I ]", "I", "O"]),
    ("F I F I F I", ["O", "I [ Minus F I F I ]", "I", "I", "O", "I F I", "I", "O"]),
];

#[test]
fn the_first_steps_of_hogeweg_and_hesper_are_as_by_hand() {
    let (axiom, successors) = PATTERNS[0];
    let rules = hogeweg_hesper(successors);
    let system = Plain { ignore: IGNORED, axiom, rules: &rules };
    let by_hand = [
        "F I F I F I",
        "F I F O F I",
        "F I F I F I F I",
        "F I F O F O F I",
        "F I F O F I [ Plus F I F I ] F I",
        // The second module of the branch has no right neighbour; the left neighbour of the first is the I
        // before the branch.
        "F I F I F I F I [ Minus F O F I ] F I",
    ];
    assert_eq!(system.first(6), by_hand);
}

#[test]
fn hogeweg_and_hespers_patterns_grow_as_an_independent_rewriter_says() {
    let mut compared = 0;
    for (axiom, successors) in PATTERNS {
        let rules = hogeweg_hesper(successors);
        let system = Plain { ignore: IGNORED, axiom, rules: &rules };
        let all = [1, 2, 3, 5, 8, 13, 20];
        let found = system.derive(all);
        for (steps, chain) in all.iter().zip(&found) {
            assert_eq!(*chain, naive::derive(axiom, &rules, IGNORED, *steps), "{rules} at {steps}");
            compared += 1;
        }
        assert!(found[6].contains('['), "the pattern branches");
    }
    assert_eq!(compared, 35);
}

#[test]
fn a_parametric_system_repeats_a_context_free_one() {
    let found = chain_of_each(
        r#"
        local Cell = module("Cell", "age")
        for steps = 0, 11 do
          local s = lsystem {}
          s:axiom(Cell(0))
          s:rule("Cell(age)", function(this, age)
            if age == 0 then return Cell(1) end
            return Cell(1), Cell(0)
          end)
          s:derive(steps)
        end
        "#,
    );
    let renamed: Vec<String> =
        found.iter().map(|chain| chain.replace("Cell(1)", "A").replace("Cell(0)", "B")).collect();
    assert_eq!(renamed, ALGAE.first(12));
}

#[test]
fn delays_in_a_parameter_are_cells_that_wait() {
    // ABOP, section 1.10.2: an apex that branches every third step, with a counter and with three symbols.
    let counted = chain_of_each(
        r#"
        local A = module("A", "t"); local F = module("F")
        for steps = 0, 9 do
          local s = lsystem {}
          s:axiom(A(0))
          s:rule("A(t)", { when = function(this, t) return t == 2 end }, [[ return F(), { A(0) }, A(0) ]])
          s:rule("A(t)", [[ return A(t + 1) ]])
          s:derive(steps)
        end
        "#,
    );
    let waiting = Plain { ignore: "", axiom: "A", rules: "A -> B\nB -> C\nC -> F [ A ] A" };
    let renamed: Vec<String> = counted
        .iter()
        .map(|chain| chain.replace("A(0)", "A").replace("A(1)", "B").replace("A(2)", "C"))
        .collect();
    assert_eq!(renamed, waiting.first(10));
}
