//! Systems with closures, compared with the same systems in Lua: the chains are equal, including random
//! numbers.

use std::fmt::Write as _;

use burgeon_rewriting::ClosureSystem;

use super::generate::Dice;
use super::scripts::{all_chains, divided, try_run};

const NAMES: [&str; 3] = ["A", "B", "C"];

/// Rule for both systems.
struct RulePlan {
    pattern: String,
    arguments: usize,
    weight: Option<f64>,
    /// Minimum of the first argument for which the rule applies.
    least: Option<f64>,
    /// Modules of the successor: index, factor, whether a random number is added, and whether the module is
    /// on a branch.
    successor: Vec<(usize, f64, bool, bool)>,
}

fn plan(dice: &mut Dice) -> RulePlan {
    let own = dice.below(NAMES.len());
    let (left, right) = (dice.chance(0.3), dice.chance(0.3));
    let mut pattern = format!("{}(x)", NAMES[own]);
    let mut arguments = 1;
    if left {
        pattern = format!("{}(l) < {pattern}", NAMES[dice.below(NAMES.len())]);
        arguments += 1;
    }
    if right {
        pattern = format!("{pattern} > {}(r)", NAMES[dice.below(NAMES.len())]);
        arguments += 1;
    }
    RulePlan {
        pattern,
        arguments,
        weight: dice.chance(0.4).then(|| 0.5 + dice.below(4) as f64),
        least: dice.chance(0.3).then(|| dice.below(5) as f64 * 0.25),
        successor: (0..dice.below(4))
            .map(|_| {
                let factor = 0.25 + 0.25 * dice.below(4) as f64;
                (dice.below(NAMES.len()), factor, dice.chance(0.3), dice.chance(0.25))
            })
            .collect(),
    }
}

/// Returns the chain after `steps` steps, derived with closures.
fn with_closures(seed: u64, rules: &[RulePlan], steps: usize) -> String {
    let mut system = ClosureSystem::new(seed);
    let symbols = NAMES.map(|name| system.module(name, &["x"]).expect("a module"));
    for rule in rules {
        let made = rule.successor.clone();
        let successor = move |module: &burgeon_rewriting::AppliedModule<'_>,
                              out: &mut burgeon_rewriting::Successors| {
            let sum: f64 = module.arguments.iter().sum();
            for (name, factor, draws, branch) in &made {
                let drawn = if *draws { module.random() } else { 0.0 };
                if *branch {
                    out.open();
                }
                out.push(symbols[*name], &[sum * factor + drawn]);
                if *branch {
                    out.close();
                }
            }
        };
        let added = match (rule.weight, rule.least) {
            (Some(weight), _) => system.rule_weighted(&rule.pattern, weight, successor),
            (None, Some(least)) => {
                system.rule_when(&rule.pattern, move |module| module.arguments[0] >= least, successor)
            }
            (None, None) => system.rule(&rule.pattern, successor),
        };
        added.expect("a rule");
    }
    let first = system.chain(|out| symbols.iter().for_each(|symbol| out.push(*symbol, &[1.0])));
    system.text(&system.derive(first.expect("a chain"), steps).expect("it derives"))
}

/// Returns the same system in Lua.
fn script(rules: &[RulePlan], steps: usize) -> String {
    let mut text = String::new();
    for name in NAMES {
        let _ = writeln!(text, "local {name} = module(\"{name}\", \"x\")");
    }
    text += "local s = lsystem({})\ns:axiom(A(1), B(1), C(1))\n";
    for rule in rules {
        let names = ["a", "b", "c"][..rule.arguments].join(", ");
        let sum = names.replace(", ", " + ");
        let mut options = Vec::new();
        match (rule.weight, rule.least) {
            (Some(weight), _) => options.push(format!("weight = {weight}")),
            (None, Some(least)) => {
                options.push(format!("when = function(this, {names}) return a >= {least} end"));
            }
            (None, None) => {}
        }
        let options =
            if options.is_empty() { String::new() } else { format!("{{ {} }}, ", options.join(", ")) };
        let made: Vec<String> = rule
            .successor
            .iter()
            .map(|(name, factor, draws, branch)| {
                let drawn = if *draws { "random()" } else { "0" };
                let module = format!("{}(({sum}) * {factor} + {drawn})", NAMES[*name]);
                if *branch { format!("{{ {module} }}") } else { module }
            })
            .collect();
        let made = if made.is_empty() { "nil".to_owned() } else { made.join(", ") };
        let _ = writeln!(
            text,
            "s:rule(\"{}\", {options}function(this, {names}) return {made} end)",
            rule.pattern
        );
    }
    let _ = writeln!(text, "s:derive({steps})");
    text
}

#[test]
fn closures_and_lua_derive_the_same_chains() {
    let (mut grown, mut drawn) = (0, 0);
    for case in 0..200 {
        let mut dice = Dice::new(case);
        let rules: Vec<RulePlan> = (0..1 + dice.below(6)).map(|_| plan(&mut dice)).collect();
        let text = script(&rules, 5);
        let run = try_run(&text, divided(1 + dice.below(3), 1 + dice.below(50))).expect("it runs");
        let expected = all_chains(&run);
        // Both sides format numbers as short as possible, but differently, so they are compared as numbers.
        assert_eq!(numbers(&with_closures(0, &rules, 5)), numbers(&expected), "{text}");
        grown += usize::from(expected.len() > 40);
        drawn += usize::from(rules.iter().any(|rule| rule.successor.iter().any(|made| made.2)));
    }
    assert!(grown > 100 && drawn > 60, "{grown} grow, {drawn} draw");
}

/// Returns the words of a chain, with its numbers parsed.
fn numbers(text: &str) -> Vec<(String, Option<u64>)> {
    let words = text.split(['(', ')', ' ', '\n']).filter(|word| !word.is_empty());
    words.map(|word| (word.chars().take(1).collect(), word.parse::<f64>().ok().map(f64::to_bits))).collect()
}
