//! Interpretations that return modules, which are interpreted in their place.

use burgeon::script::{Print, RunOptions};
use burgeon::{Run, WarningKind};
use std::fmt::Write as _;
use std::sync::{Arc, Mutex};

use super::generate::Dice;
use super::scripts::{divided, error, run, run_with};

/// Declarations of a system whose object notes words and brackets.
const HEAD: &str = "
    local pen = object('pen', {
        state = { text = '' },
        push = function(self) self.text ..= '[ ' end,
        pop = function(self) self.text ..= '] ' end,
        reads = { words = function(self) return self.text end },
        changes = { write = function(self, text) self.text ..= text .. ' ' end },
    })
    local A, B, C, D, X = module('A', 'n?'), module('B', 'n?'), module('C'), module('D'), module('X', 'n')
    local s = lsystem { object = pen(), max_depth = 5 }
    for _, name in { 'C', 'D' } do
        s:interpret(name, function(this) this:write(name) end)
    end
    s:interpret('X(n)', function(this, n) this:write(`{n}`) end)
";

/// Returns the warnings of a run, except those of an empty model.
fn told(made: &Run) -> Vec<String> {
    let warnings = made.warnings.iter().filter(|it| it.kind() != WarningKind::EmptyModel);
    warnings.map(ToString::to_string).collect()
}

/// Checks the words and brackets that the object of a system with these declarations notes.
fn draws(declarations: &str, words: &str) {
    let script = format!("{HEAD}{declarations}\nexpect(s:derive(0).objects[1]:words(), '{words} ')");
    assert!(told(&run(&script)).is_empty(), "{:?}", told(&run(&script)));
}

fn warning(declarations: &str) -> String {
    let told = told(&run(&format!("{HEAD}{declarations}\ns:derive(0)")));
    assert_eq!(told.len(), 1, "{told:?}");
    told.concat()
}

fn refused(declarations: &str) -> String {
    error(&format!("{HEAD}{declarations}\ns:derive(0)"))
}

#[test]
fn returned_modules_are_drawn_in_place_of_the_module() {
    let a = "s:interpret('A', function(this) return D(), { C(), { D() } }, D() end)";
    draws(&format!("s:axiom(C(), A(), {{ A() }}, C()) {a}"), "C D [ C [ D ] ] D [ D [ C [ D ] ] D ] C");
}

#[test]
fn calls_of_an_interpretation_come_before_the_modules_that_it_returns() {
    let a = "s:interpret('A', function(this) this:write('a') return B(), this:write('b'), D() end)";
    let b = "s:interpret('B', function(this) this:write(`<{#this:words()}>`) return C() end)";
    draws(&format!("s:axiom(A(), D()) {a} {b}"), "a b <4> C D D");
}

#[test]
fn modules_made_outside_are_returned_as_often_as_needed_and_others_are_dropped() {
    draws(
        "local kept = C() s:axiom(A()) s:interpret('A', function() local d = D() return kept, d, { d, kept }, d end)",
        "C D [ D C ] D",
    );
    draws("s:axiom(A()) s:interpret('A', function() local _ = D() return C() end)", "C");
    draws("s:axiom(A(), C()) s:interpret('A', function(this) local _ = D() end)", "C");
}

#[test]
fn parameters_of_all_kinds_reach_the_rules_of_returned_modules() {
    draws(
        "s:axiom(A('a'))
        s:interpret('A(n)', function(_, n) return B({ n, 2, nil }), B(true), B() end)
        s:interpret('B(n)', function(this, n) this:write(if type(n) == 'table' then `{n[1]}{n[2]}` else `{n}`) end)",
        "a2 true nil",
    );
}

#[test]
fn interpretations_recur_to_the_maximum_depth_and_warn_there() {
    let count = "s:interpret('A(n)', function(_, n) return X(n), if n > 1 then A(n - 1) else nil end)";
    draws(&format!("s:axiom(A(5)) {count}"), "5 4 3 2 1");
    let told = warning(&format!("s:axiom(A(6)) {count}"));
    assert!(
        told.contains("rule A(n) (interpretation): interpretation stopped at the maximum depth 5, but"),
        "{told}"
    );
    assert!(told.contains("module: A(1), step 0") && told.contains("max_depth = 1000"), "{told}");
}

#[test]
fn a_thousand_levels_need_no_deep_stack() {
    let script = format!(
        "{}
        s:axiom(A(30000))
        s:interpret('A(n)', function(this, n) if n > 0 then return {{ A(n - 1) }} end this:write('end') end)
        expect(#string.gsub(s:derive(0).objects[1]:words(), '[%[%] ]', ''), 3)",
        HEAD.replace("max_depth = 5", "max_depth = 40000")
    );
    assert!(told(&run(&script)).is_empty());
}

#[test]
fn contexts_of_interpretations_are_those_of_the_module_in_the_chain_at_every_depth() {
    let rules = "
        s:interpret('C < A(n) > X(m)', function(this, n, m) return B(n), X(m) end)
        s:interpret('A', function(this) this:write('alone') end)
        s:interpret('C < B(n) > X(m)', function(this, n, m) this:write(`b{n}{m}`) end)
        s:interpret('B', function(this) this:write('none') end)";
    draws(&format!("s:axiom(C(), A(1), {{ D() }}, X(7), A(2)) {rules}"), "C b17 7 [ D ] 7 alone");
    // A returned X is no neighbour.
    draws(&format!("s:axiom(C(), B(1), D()) {rules}"), "C none D");
}

#[test]
fn guards_see_the_object_at_the_module() {
    let rules = "
        s:interpret('A', { when = function(this) return #this:words() > 4 end }, function(this) this:write('late') end)
        s:interpret('A', function() return C(), B(), A() end)
        s:interpret('B', { when = function(this) return #this:words() == 2 end }, function(this) this:write('two') end)";
    draws(&format!("s:axiom(A(), A()) {rules}"), "C two late late");
}

#[test]
fn a_module_without_a_candidate_is_drawn_by_the_standard_library_or_not_at_all() {
    let script = "local s = lsystem { object = turtle() }
        local A = module('A')
        s:axiom(A())
        s:interpret('A', function() return F(1), F(3) end)
        s:interpret('F(l)', { when = function(_, l) return l < 2 end }, function(this, l) this:forward(10 * l) end)
        expect(s:derive(0).objects[1]:position().z, 13, 1e-9)";
    assert!(told(&run(script)).is_empty());
}

#[test]
fn weights_of_interpretations_are_proportions() {
    let script = "
        local s = lsystem { object = turtle() }
        local A, B = module('A'), module('B')
        s:axiom(table.unpack(table.create(4000, A())))
        s:interpret('A', function() return B() end)
        s:interpret('B', { weight = 3 }, function(this) this:forward(1) end)
        s:interpret('B', { weight = 1 }, function(this) this:forward(0) end)
        s:interpret('B', { weight = 0 }, function(this) this:forward(1000) end)
        expect(s:derive(0).objects[1]:position().z, 3000, 90)";
    assert!(told(&run(script)).is_empty());
}

#[test]
fn each_returned_module_has_a_random_stream_of_its_own() {
    let script = |before: &str, within: &str| {
        format!(
            "{HEAD}
            s:axiom(A(), A())
            s:interpret('A', function(this) {before} return {within} B(), {{ B() }} end)
            s:interpret('B', function(this) this:write(`{{random()}} {{stream('s')()}}`) end)
            print(s:derive(0).objects[1]:words())"
        )
    };
    let numbers = |before: &str, within: &str| -> Vec<String> {
        let printed: Arc<Mutex<String>> = Arc::default();
        let hook = Arc::clone(&printed);
        let mut options = burgeon::options();
        options.reports.print =
            Some(Print::new(move |line| hook.lock().expect("a text").push_str(&format!("{line} "))));
        run_with(&script(before, within), options);
        let text = printed.lock().expect("a text");
        text.split_whitespace().filter(|word| word.starts_with("0.")).map(str::to_owned).collect()
    };
    let plain = numbers("", "");
    let mut distinct = plain.clone();
    distinct.sort();
    distinct.dedup();
    assert_eq!((plain.len(), distinct.len()), (8, 8));
    assert_eq!(numbers("random() random()", ""), plain);
}

#[test]
fn returned_modules_draw_as_the_same_modules_in_the_chain() {
    let mut dice = Dice::new(17);
    for case in 0..200 {
        // Each rule returns modules with greater letters, so that every expansion ends.
        let letters = ["A", "B", "C", "D", "E"];
        let mut rules: Vec<String> = Vec::new();
        for index in 0..letters.len() {
            let mut text = String::new();
            let mut open = 0;
            for _ in 0..dice.below(6) {
                match dice.below(8) {
                    0 => {
                        text.push_str("[ ");
                        open += 1;
                    }
                    1 if open > 0 => {
                        text.push_str("] ");
                        open -= 1;
                    }
                    2 => text.push_str("+ "),
                    3 => text.push_str("/ "),
                    4 | 5 => text.push_str("F "),
                    _ if index + 1 < letters.len() => {
                        let _ =
                            write!(text, "{} ", letters[index + 1 + dice.below(letters.len() - index - 1)]);
                    }
                    _ => text.push_str("F "),
                }
            }
            text.push_str(&"] ".repeat(open));
            rules.push(text);
        }
        let lua = |text: &str| {
            let words: Vec<String> = text
                .split_whitespace()
                .map(|word| match word {
                    "[" => "{".to_owned(),
                    "]" => "},".to_owned(),
                    "+" => "Turn(35),".to_owned(),
                    "/" => "Roll(50),".to_owned(),
                    "F" => "F(1),".to_owned(),
                    letter => format!("{letter}(),"),
                })
                .collect();
            words.join(" ").replace(", }", " }").trim_end_matches(',').to_owned()
        };
        let declare = "local A, B, C, D, E = module('A'), module('B'), module('C'), module('D'), module('E')";
        let system = |call: &str, steps: &str| {
            let mut script = format!(
                "{declare} local s = lsystem {{ object = turtle {{ width = 0.1 }} }} s:axiom(A(), {{ B() }}, A()) "
            );
            for (letter, rule) in letters.iter().zip(&rules) {
                let list = lua(rule);
                let list = if list.is_empty() && call == "rule" { "nil".to_owned() } else { list };
                let _ = write!(script, "s:{call}('{letter}', function() return {list} end) ");
            }
            let _ = write!(script, "s:derive({steps})");
            script
        };
        let glb = |script: &str, options: RunOptions| {
            let made = run_with(script, options);
            assert!(told(&made).is_empty(), "{:?}\n{script}", told(&made));
            let scene = &made.scene;
            let vertices: Vec<_> = scene.meshes.iter().map(|mesh| &mesh.parts).collect();
            format!("{vertices:?}")
        };
        let interpreted = system("interpret", "0");
        let rewritten = system("rule", "6");
        let expected = glb(&rewritten, burgeon::options());
        assert_eq!(glb(&interpreted, burgeon::options()), expected, "case {case}\n{interpreted}");
        assert_eq!(glb(&interpreted, divided(2, 1)), expected, "case {case}");
    }
}

#[test]
fn errors_of_returned_modules_name_their_rule_and_line() {
    let told = refused(
        "s:axiom(A(3))
s:interpret('A(n)', function(_, n) return B(n + 1) end)
s:interpret('B(n)', function(this, n)
    error('four: ' .. n)
end)",
    );
    assert!(told.contains("rule B(n) (interpretation): four: 4"), "{told}");
    assert!(told.contains("module: A(3), step 0"), "{told}");
    let told = refused("s:axiom(A()) s:interpret('A', function() return C(), 3 end)");
    assert!(told.contains("one item is the number 3"), "{told}");
    let told = refused("s:axiom(A()) s:interpret('A', function() return { C(), x = 1 } end)");
    assert!(told.contains("this one has the field x"), "{told}");
    let told = refused("s:axiom(A()) s:interpret('A', function() return B(1, 2) end)");
    assert!(told.contains("B has 0 to 1 parameters, not 2"), "{told}");
    let told = refused(
        "s:axiom(A()) s:interpret('A', { when = function(this) this:write('x') return true end }, function() return C() end)",
    );
    assert!(told.contains("pen:write is a write method"), "{told}");
}

#[test]
fn declarations_of_interpretations_are_checked() {
    let told = refused(
        "s:axiom(A()) s:interpret('A', function() end) s:interpret('A', { weight = 1 }, function() end)",
    );
    assert!(told.contains("A is already interpreted in line"), "{told}");
    let told = refused("s:interpret('A', { weight = -1 }, function() end)");
    assert!(told.contains("weight must be a number of at least 0"), "{told}");
    let told = refused("s:interpret('A', 3, function() end)");
    assert!(told.contains("the options of an interpretation must be a table"), "{told}");
    let told = refused("s:interpret('A')");
    assert!(told.contains("an interpretation needs a function"), "{told}");
    let told = refused("s:interpret('C < A > D', function(this, a) end)");
    assert!(told.contains("has 2 parameters, but the pattern has 1"), "{told}");
}

#[test]
fn returned_modules_that_nothing_draws_are_reported() {
    let told = warning("s:axiom(A()) s:interpret('A', function() return B(), C() end)");
    assert!(told.contains("B has neither a rule nor an interpretation"), "{told}");
    let told = warning("s:axiom(A()) s:interpret('A', function() return 'C' end)");
    assert!(told.contains("the string \"C\" returned by an interpretation is ignored"), "{told}");
}

#[test]
fn endless_interpretations_end_at_the_limits() {
    let mut options = burgeon::options();
    options.limits.modules = 1000;
    let script = format!(
        "{}\ns:axiom(A()) s:interpret('A', function() return A(), A() end) s:derive(0)",
        HEAD.replace("max_depth = 5", "max_depth = 900000")
    );
    let told = match super::scripts::try_run(&script, options) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("the run should end at its limit"),
    };
    assert!(told.contains("returned more than 1000 modules"), "{told}");
}
