//! Steps in series derive the same chains as steps on whole chains.

use std::sync::Arc;

use burgeon_base::Stop;
use burgeon_base::random::Stream;
use burgeon_rewriting::{
    Applications, CLOSE, Chain, END, FIRST_SYMBOL, Grammar, ModuleKey, NoHelpers, OPEN, Pattern, Rule,
    RuleFailure, Rules, Signature, StepPlan, StepSeries, Stepper, Successors, Symbol, Symbols,
};

const NAMES: [&str; 5] = ["A", "B", "C", "D", "E"];

/// Random numbers with a seed.
struct Dice(Stream);

impl Dice {
    fn below(&mut self, count: usize) -> usize {
        (self.0.uniform() * count as f64) as usize
    }

    fn pick<'a>(&mut self, list: &[&'a str]) -> &'a str {
        list[self.below(list.len())]
    }
}

/// Successor of a rule: symbols, each with a number that is added to the sum of the arguments.
type Template = Vec<(Symbol, f64)>;

/// System with random rules for modules of one parameter.
struct RandomRules {
    grammar: Grammar,
    /// For each rule, its successor, or `None` to keep the module.
    successors: Vec<Option<Template>>,
    /// For each rule, the maximum sum of the arguments for which its guard holds.
    most: Vec<f64>,
    counts: Vec<usize>,
    draws: bool,
}

impl RandomRules {
    /// Returns rules of which some apply only in the regions of `others` other systems.
    fn new(dice: &mut Dice, others: usize) -> Self {
        let mut symbols = Symbols::default();
        for name in NAMES {
            let signature = Signature::new(name, &["x".to_owned()]).expect("a name");
            symbols.declare(signature).expect("a new name");
        }
        let find = |name: &str| symbols.find(name).expect("a declared module");
        let ignored: Vec<Symbol> = match dice.below(3) {
            0 => vec![find("E")],
            1 => vec![find("D"), find("E")],
            _ => Vec::new(),
        };
        let draws = dice.below(2) == 0;
        let longest = dice.below(4);
        let (mut rules, mut successors, mut most) = (Vec::new(), Vec::new(), Vec::new());
        let count = (2 + dice.below(4)) * (others + 1);
        for number in 0..count {
            let mut names = 0;
            let mut module = |dice: &mut Dice, of: &[&str]| {
                names += 1;
                format!("{}(v{names})", dice.pick(of))
            };
            let mut left: Vec<String> = (0..dice.below(longest + 1)).map(|_| module(dice, &NAMES)).collect();
            let own = module(dice, &NAMES[..3]);
            let mut right: Vec<String> = (0..dice.below(longest + 1)).map(|_| module(dice, &NAMES)).collect();
            match dice.below(8) {
                _ if longest == 0 => {}
                0 => left.insert(0, "^".to_owned()),
                1 => right.push("$".to_owned()),
                _ => {}
            }
            let mut text = own;
            if !left.is_empty() {
                text = format!("{} < {text}", left.join(" "));
            }
            if !right.is_empty() {
                text += &format!(" > {}", right.join(" "));
            }
            let weight = (draws && dice.below(3) == 0).then(|| 1.0 + dice.below(3) as f64);
            let guarded = dice.below(2) == 0;
            let rule = Rule::new(Pattern::parse(&text, &symbols).expect("a pattern"), weight, guarded, None);
            let rule = match dice.below(6) {
                0 => rule.ignoring(vec![find(dice.pick(&NAMES))]),
                1 => rule.ignoring(Vec::new()),
                _ => rule,
            };
            rules.push(rule.in_region((number % (others + 1)) as u16));
            most.push(dice.below(6) as f64);
            successors.push((dice.below(6) > 0).then(|| {
                let mut template = Vec::new();
                let mut open = 0;
                for _ in 0..dice.below(4) {
                    if dice.below(3) == 0 {
                        template.push((OPEN, 0.0));
                        open += 1;
                    }
                    let symbol = FIRST_SYMBOL + dice.below(NAMES.len()) as Symbol;
                    template.push((symbol, dice.below(3) as f64 + 0.5));
                    if open > 0 && dice.below(2) == 0 {
                        template.push((CLOSE, 0.0));
                        open -= 1;
                    }
                }
                template.extend(std::iter::repeat_n((CLOSE, 0.0), open));
                template
            }));
        }
        let counts = rules.iter().map(Rule::arguments).collect();
        let openers: Vec<(Symbol, u16)> =
            (1..=others).map(|_| (find(dice.pick(&NAMES)), dice.below(others + 1) as u16)).collect();
        let grammar = Grammar::new(Arc::new(symbols), rules, &ignored, draws).with_regions(&openers);
        Self { grammar, successors, most, counts, draws }
    }

    /// Returns random chains that end in the same number of brackets as they begin.
    fn axiom(&self, dice: &mut Dice, chains: usize) -> Chain {
        let mut chain = Chain::default();
        for _ in 0..chains {
            let mut open = 0;
            for _ in 0..20 + dice.below(60) {
                match dice.below(6) {
                    0 => {
                        chain.symbols.push(OPEN);
                        open += 1;
                    }
                    1 if open > 0 => {
                        chain.symbols.push(CLOSE);
                        open -= 1;
                    }
                    _ => {
                        // Most modules have no rules.
                        let name = if dice.below(6) == 0 { dice.below(3) } else { 3 + dice.below(2) };
                        chain.symbols.push(FIRST_SYMBOL + name as Symbol);
                        chain.params.push(dice.below(4) as f64);
                    }
                }
            }
            chain.symbols.extend(std::iter::repeat_n(CLOSE, open));
            chain.symbols.push(END);
        }
        if self.draws {
            chain.keys = (0..chain.symbols.len()).map(|index| ModuleKey::seed(index as u64)).collect();
        }
        chain
    }

    fn sum(&self, applications: &Applications<'_>, index: usize) -> f64 {
        let count = self.counts[usize::from(applications.rule)];
        applications.arguments[index * count..][..count].iter().sum()
    }
}

impl Rules for RandomRules {
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure> {
        successors.clear();
        for index in 0..applications.count {
            let Some(template) = &self.successors[usize::from(applications.rule)] else {
                successors.keep();
                continue;
            };
            let drawn = applications.keys.get(index).map_or(0.0, |key| key.stream().uniform());
            let sum = self.sum(applications, index) + drawn;
            for (symbol, added) in template {
                match *symbol {
                    OPEN => successors.open(),
                    CLOSE => successors.close(),
                    symbol => successors.push(symbol, &[sum / 2.0 + added]),
                }
            }
            successors.end();
        }
        Ok(())
    }

    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure> {
        let most = self.most[usize::from(applications.rule)];
        holds.extend((0..applications.count).map(|index| u32::from(self.sum(applications, index) <= most)));
        Ok(())
    }
}

fn plan(rules: &RandomRules, chains: usize, batch: usize) -> Arc<StepPlan> {
    Arc::new(StepPlan {
        grammar: rules.grammar.clone(),
        failed: None,
        chains,
        batch,
        limit: 4000,
        traced: false,
        notes_places: false,
    })
}

fn without_marks(mut chain: Chain) -> Chain {
    chain.marks.clear();
    chain
}

#[test]
fn random_systems_derive_the_same_chains_in_series_and_in_steps() {
    let compared = compare(0);
    assert!((3000..5500).contains(&compared.contexts), "{compared:?}");
    compared.check();
}

#[test]
fn random_systems_with_regions_derive_the_same_chains_in_series_and_in_steps() {
    for others in 1..=2 {
        let compared = compare(others);
        assert!(compared.contexts > 3000, "{compared:?}");
        compared.check();
    }
}

/// Work of compared systems.
#[derive(Debug, Default)]
struct Compared {
    /// Symbols that series examined.
    read: usize,
    /// Symbols of all steps.
    symbols: usize,
    /// Systems with contexts.
    contexts: usize,
    /// Series of at least three steps.
    series_of_steps: usize,
    /// Systems whose chains grow too long.
    failed: usize,
}

impl Compared {
    /// Checks that the comparison is meaningful.
    fn check(&self) {
        assert!(2 * self.read < self.symbols && self.series_of_steps > 1500 && self.failed > 20, "{self:?}");
    }
}

/// Compares the chains of systems with the regions of `others` other systems.
fn compare(others: usize) -> Compared {
    const STEPS: usize = 12;
    let mut compared = Compared::default();
    for seed in 0..6000 {
        let mut dice = Dice(ModuleKey::seed(seed).stream());
        let rules = RandomRules::new(&mut dice, others);
        let chains = 1 + dice.below(3);
        let axiom = rules.axiom(&mut dice, chains);
        let batch = 1 + dice.below(6);
        let arities = rules.grammar.arities();
        let texts: Vec<_> = rules.grammar.rules().iter().map(|rule| rule.pattern.text.clone()).collect();

        let mut whole = Stepper::new(&plan(&rules, chains, 4096));
        let mut expected = Vec::new();
        let mut chain = axiom.clone();
        let mut error = None;
        for number in 1..=STEPS {
            chain.mark(4096, arities);
            match whole.step(&rules, &NoHelpers, &Stop::new(), &Arc::new(chain.clone()), number) {
                Ok(outcome) if outcome.ran => chain = outcome.chain,
                Ok(_) => break,
                Err(refusal) => {
                    error = Some(refusal.to_string());
                    break;
                }
            }
            expected.push(without_marks(chain.clone()));
        }

        let total = expected.len();
        let mut stepper = Stepper::new(&plan(&rules, chains, batch));
        let mut chain = axiom.clone();
        let mut done = 0;
        while done < STEPS {
            let most = 1 + dice.below(STEPS);
            let mut watched = Vec::new();
            let outcome = stepper.perform(
                &rules,
                &Stop::new(),
                &chain,
                &mut StepSeries {
                    first: done + 1,
                    last: (done + most).min(STEPS),
                    ends_unchanged: false,
                    ends_at: &[],
                    watch: &mut |number, symbols| {
                        watched.push((number, symbols));
                        true
                    },
                    places: None,
                },
            );
            let outcome = match outcome {
                Ok(outcome) => outcome,
                Err(refusal) => {
                    assert_eq!(Some(refusal.to_string()), error, "seed {seed}: {texts:#?}");
                    compared.failed += 1;
                    break;
                }
            };
            assert_eq!(watched.len(), outcome.steps);
            compared.read += outcome.read;
            compared.symbols += watched.iter().map(|(_, symbols)| symbols).sum::<usize>();
            compared.series_of_steps += usize::from(outcome.steps > 2);
            done += outcome.steps;
            let counted = if outcome.settled { done - 1 } else { done };
            chain = without_marks(outcome.chain);
            let expected = if counted == 0 { &axiom } else { &expected[counted - 1] };
            assert_eq!(&chain, expected, "seed {seed}, step {counted}, batch {batch}: {texts:#?}");
            if outcome.settled {
                assert_eq!(counted, total, "seed {seed}: {texts:#?}");
                break;
            }
        }
        if error.is_none() {
            let counts = |stepper: &Stepper| -> Vec<_> {
                stepper.uses().iter().map(|uses| (uses.applied, uses.made)).collect()
            };
            assert_eq!(counts(&stepper), counts(&whole), "seed {seed}: {texts:#?}");
        }
        compared.contexts += usize::from(rules.grammar.has_contexts());
    }
    compared
}
