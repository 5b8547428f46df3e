//! Random systems of guarded, weighted and contextual rules: the engine applies only rules that the choice
//! law of the design allows.

use burgeon::script::RunOptions;

use super::generate::{Dice, Kind, NAMES};
use super::naive::{self, Pattern};
use super::scripts::{as_lua, declare_with, run_with, words};

struct Law {
    pattern: Pattern,
    weight: Option<f64>,
    /// Guard, if any: it holds for modules whose number has this remainder for this divisor.
    guard: Option<(usize, usize)>,
}

struct System {
    words: Vec<&'static str>,
    ignored: Vec<&'static str>,
    laws: Vec<Law>,
}

/// Numbers of compared modules, to ensure that the test is meaningful.
#[derive(Debug, Default)]
pub(crate) struct Compared {
    /// Modules to which a rule was applied.
    pub applied: usize,
    /// Modules with a random choice among several rules.
    pub drawn: usize,
    /// Modules to which a rule of weight 0 would have been applied.
    pub weightless: usize,
}

impl System {
    fn new(dice: &mut Dice) -> Self {
        let kind = dice.pick(&[Kind::Several, Kind::Mixed, Kind::Mixed]);
        let size = 5 + dice.below(30);
        let made = kind.make(dice, size, 0);
        let laws = (0..=dice.below(7)).map(|_| {
            let mut pattern = Pattern::parse(&kind.pattern(dice));
            if dice.chance(0.5) {
                (pattern.left, pattern.right) = (Vec::new(), Vec::new());
            }
            pattern.predecessor = dice.pick(&["A", "A", "B"]).to_owned();
            let weight = dice.pick(&[
                None,
                None,
                Some(0.0),
                Some(0.0),
                Some(1.0),
                Some(3.0),
                Some(0.1),
                Some(1e308),
                Some(1.7e308),
                Some(5e-324),
            ]);
            let divisor = 1 + dice.below(3);
            let guard = dice.chance(0.5).then(|| (divisor, dice.below(divisor)));
            Law { pattern, weight, guard }
        });
        Self { laws: laws.collect(), words: made.words, ignored: made.ignored }
    }

    /// Returns a script with one step, in which rule number I replaces its module by `RI`, with the module's
    /// number.
    fn script(&self) -> String {
        let mut number = 0;
        let numbered = self.words.iter().map(|word| match *word {
            "[" | "]" => (*word).to_owned(),
            name => {
                number += 1;
                format!("{name}({})", number - 1)
            }
        });
        let axiom = as_lua(&numbered.collect::<Vec<_>>().join(" "));
        let mut script = format!("do local s = lsystem() s:axiom({axiom})\n");
        if !self.ignored.is_empty() {
            script += &format!("s:ignore(\"{}\")\n", self.ignored.join(" "));
        }
        for (index, law) in self.laws.iter().enumerate() {
            let predecessor = format!("{}(n)", law.pattern.predecessor);
            let pattern = Pattern { predecessor, ..law.pattern.clone() }.text();
            let weight = law.weight.map_or_else(String::new, |weight| format!("weight = {weight:e},"));
            let guard = law.guard.map_or_else(String::new, |(divisor, rest)| {
                format!("when = function(this, n) return n % {divisor} == {rest} end")
            });
            script += &format!(
                "s:rule(\"{pattern}\", {{ {weight} {guard} }}, function(this, n) return R{index}(n) end)\n"
            );
        }
        script + "s:derive(1) end\n"
    }

    fn check(&self, chain: &str, compared: &mut Compared) {
        let items = naive::parse(&self.words.join(" "));
        let ignored: Vec<String> = self.ignored.iter().map(|name| (*name).to_owned()).collect();
        let matching: Vec<Vec<usize>> =
            self.laws.iter().map(|law| naive::matches(&items, &law.pattern, &ignored)).collect();
        let modules: Vec<&str> =
            self.words.iter().copied().filter(|word| *word != "[" && *word != "]").collect();
        let found: Vec<String> = words(chain).into_iter().filter(|word| word != "[" && word != "]").collect();
        assert_eq!(found.len(), modules.len());
        for (number, (name, found)) in modules.iter().zip(&found).enumerate() {
            let holds = |index: &usize| {
                let law = &self.laws[*index];
                matching[*index].contains(&number)
                    && law.guard.is_none_or(|(divisor, rest)| number % divisor == rest)
            };
            let all: Vec<usize> = (0..self.laws.len()).filter(holds).collect();
            let weighs = |index: &usize| self.laws[*index].weight != Some(0.0);
            let mut candidates: Vec<usize> = all.iter().copied().filter(weighs).collect();
            compared.weightless += usize::from(candidates.len() < all.len());
            match candidates.first() {
                Some(first) if self.laws[*first].weight.is_none() => candidates.truncate(1),
                _ => candidates.retain(|index| self.laws[*index].weight.is_some()),
            }
            let allowed: Vec<String> = match candidates.as_slice() {
                [] => vec![format!("{name}({number})")],
                some => some.iter().map(|index| format!("R{index}({number})")).collect(),
            };
            compared.applied += usize::from(!candidates.is_empty());
            compared.drawn += usize::from(candidates.len() > 1);
            assert!(
                allowed.contains(found),
                "{found} is none of {allowed:?} in {chain}\nof {}",
                self.script()
            );
        }
    }
}

/// Derives `count` random systems by one step, and checks the result of each module.
pub(crate) fn compare(seed: u64, count: usize, options: RunOptions) -> Compared {
    let mut dice = Dice::new(seed);
    let systems: Vec<System> = (0..count).map(|_| System::new(&mut dice)).collect();
    let results: Vec<String> = (0..8).map(|index| format!("R{index}")).collect();
    let mut script = declare_with(NAMES.iter().copied().chain(results.iter().map(String::as_str)), "n");
    systems.iter().for_each(|system| script += &system.script());
    let run = run_with(&script, options);
    assert_eq!(run.systems.len(), count);
    let mut compared = Compared::default();
    for (system, derived) in systems.iter().zip(&run.systems) {
        system.check(&derived.chain_text(), &mut compared);
    }
    compared
}
