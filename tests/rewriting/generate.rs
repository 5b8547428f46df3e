//! Random chains, patterns and rules that are hard for an engine, for tests and benches.

use burgeon_rewriting::{Bindings, CLOSE, ContextMatcher};
use burgeon_rewriting::{
    Chain, END, FIRST_SYMBOL, Grammar, Links, ModuleKey, OPEN, Pattern, Rule, Signature, Symbols,
};

use super::naive;

/// All module names; most of them are rare.
pub(crate) const NAMES: [&str; 8] = ["A", "B", "C", "X", "Y", "Z", "P", "Q"];

/// Random numbers with a seed.
pub(crate) struct Dice(Box<dyn FnMut() -> f64>);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        let mut stream = ModuleKey::seed(seed).stream();
        Self(Box::new(move || stream.uniform()))
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        (self.0)() < share
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.0)() * count as f64) as usize
    }

    pub(crate) fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }
}

/// Type of a chain and its patterns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Kind {
    /// Long runs of ignored modules before named ones.
    Runs,
    /// Many branches in a row, of which few match.
    Branches,
    /// Deeply nested brackets.
    Nests,
    /// Few symbols are considered at all.
    Rare,
    /// Contexts of several modules on both sides.
    Several,
    /// Mixture of all types.
    Mixed,
}

pub(crate) const KINDS: [Kind; 6] =
    [Kind::Runs, Kind::Branches, Kind::Nests, Kind::Rare, Kind::Several, Kind::Mixed];

/// Chain as words, with patterns for it.
#[derive(Debug)]
pub(crate) struct Made {
    pub words: Vec<&'static str>,
    pub patterns: Vec<String>,
    pub ignored: Vec<&'static str>,
}

impl Kind {
    /// Creates a chain of about `size` words with `patterns` patterns.
    pub(crate) fn make(self, dice: &mut Dice, size: usize, patterns: usize) -> Made {
        let ignored: Vec<&str> = match self {
            Self::Runs | Self::Branches => vec!["X"],
            Self::Nests => dice.pick(&[&[][..], &["X"]]).to_vec(),
            Self::Rare => NAMES.iter().copied().filter(|name| !["B", "Z"].contains(name)).collect(),
            Self::Several => dice.pick(&[&[][..], &["X"], &["X", "Y"]]).to_vec(),
            Self::Mixed => NAMES.iter().copied().filter(|_| dice.chance(0.3)).collect(),
        };
        let mut words = Vec::with_capacity(size + size / 8);
        let mut depth = 0;
        while words.len() < size {
            self.extend(dice, &mut words, &mut depth, size);
        }
        words.extend(std::iter::repeat_n("]", depth));
        let patterns = (0..patterns).map(|_| self.pattern(dice)).collect();
        Made { words, patterns, ignored }
    }

    fn extend(self, dice: &mut Dice, words: &mut Vec<&'static str>, depth: &mut usize, size: usize) {
        match self {
            Self::Runs => {
                let length = dice.below(size / 2 + 2);
                words.extend(std::iter::repeat_n("X", length));
                words.extend_from_slice(dice.pick(&[
                    &["A"][..],
                    &["[", "Z", "]"],
                    &["[", "X", "X", "A", "B", "]", "X", "B"],
                    &["[", "C", "]", "X", "[", "Z", "]"],
                ]));
            }
            Self::Branches => {
                words.push(dice.pick(&["A", "X", "X", "X"]));
                for _ in 0..dice.below(size / 4 + 2) {
                    words.extend_from_slice(dice.pick(&[
                        &["[", "C", "]"][..],
                        &["[", "X", "]"],
                        &["[", "]", "X"],
                        &["[", "[", "Z", "]", "C", "]"],
                        &["[", "A", "[", "C", "]", "]"],
                        &["[", "[", "C", "]", "[", "A", "]", "]", "X"],
                    ]));
                }
                words.extend_from_slice(dice.pick(&[
                    &["[", "Z", "]", "B"][..],
                    &["B"],
                    &["[", "A", "B", "]"],
                ]));
            }
            Self::Nests => {
                for _ in 0..dice.below(size / 6 + 2) {
                    if dice.chance(0.5) {
                        words.push(dice.pick(&["A", "B", "X"]));
                    }
                    words.push("[");
                    *depth += 1;
                }
                words.extend_from_slice(&["C", "Z"][..dice.below(3)]);
                for _ in 0..dice.below(*depth + 1) {
                    words.push("]");
                    *depth -= 1;
                    if dice.chance(0.3) {
                        words.push(dice.pick(&["A", "B", "X"]));
                    }
                }
            }
            _ => match dice.below(8) {
                0 | 1 => {
                    words.push("[");
                    *depth += 1;
                }
                2 if *depth > 0 => {
                    words.push("]");
                    *depth -= 1;
                }
                _ => {
                    let known = 4 + dice.below(5);
                    words.push(dice.pick(&NAMES[..known]));
                }
            },
        }
    }

    /// Returns a pattern that sometimes matches in such chains.
    pub(crate) fn pattern(self, dice: &mut Dice) -> String {
        let typical: &[&str] = match self {
            Self::Runs => {
                &["X > [ Z ]", "X > [ Z ] A", "A < X", "X > A", "X > [ A B ] B", "A < X > [ C ] [ Z ]"]
            }
            Self::Branches => &[
                "A > [ Z ]",
                "X > [ Z ] B",
                "X > [ [ Z ] ]",
                "X > [ C ] B",
                "A > [ [ A ] ]",
                "X > [ A [ C ] ]",
            ],
            Self::Nests => {
                &["A > [ [ C ] ]", "A > [ [ [ Z ] ] ]", "B < C", "A A < B", "X > [ B [ A ] ]", "A B < Z"]
            }
            Self::Rare => &["B < A", "A > [ Z ]", "X > B Z", "B < Z > B", "P > [ B ] Z", "B B < Q"],
            _ => &[],
        };
        if dice.chance(0.4) && !typical.is_empty() {
            return dice.pick(typical).to_owned();
        }
        let most = if self == Self::Several { 5 } else { 3 };
        let mut text = String::new();
        let left = dice.below(most);
        for _ in 0..left {
            text += &format!("{} ", common(dice));
        }
        if left > 0 {
            text += "< ";
        }
        text += dice.pick(&NAMES[..6]);
        let right = dice.below(most + 1);
        if right > 0 {
            text += " >";
            for _ in 0..right {
                context(dice, &mut text, 0);
            }
        }
        text
    }
}

fn common(dice: &mut Dice) -> &'static str {
    dice.pick(&["A", "A", "A", "B", "B", "C", "X", "Z"])
}

fn context(dice: &mut Dice, text: &mut String, depth: usize) {
    if depth < 4 && dice.chance(0.4) {
        text.push_str(" [");
        for _ in 0..=dice.below(2) {
            context(dice, text, depth + 1);
        }
        text.push_str(" ]");
    } else {
        *text += &format!(" {}", common(dice));
    }
}

/// Chain in the engine.
pub(crate) struct Engine {
    pub chain: Chain,
    pub grammar: Grammar,
    pub links: Links,
}

impl Engine {
    /// Creates the chain of `made`, with its patterns as rules.
    pub(crate) fn new(made: &Made) -> Self {
        let mut symbols = Symbols::default();
        for name in NAMES {
            let signature = Signature::new(name, &[]).expect("a name");
            symbols.declare(signature).expect("a new name");
        }
        let find = |name: &str| symbols.find(name).expect("a known name");
        let mut chain = Chain::default();
        for word in &made.words {
            chain.symbols.push(match *word {
                "[" => OPEN,
                "]" => CLOSE,
                name => find(name),
            });
        }
        chain.symbols.push(END);
        let rule =
            |text: &String| Rule::new(Pattern::parse(text, &symbols).expect("a pattern"), None, false, None);
        let rules = made.patterns.iter().map(rule).collect();
        let ignored: Vec<_> = made.ignored.iter().map(|name| find(name)).collect();
        let grammar = Grammar::new(std::sync::Arc::new(symbols.clone()), rules, &ignored, false);
        let mut links = Links::default();
        links.build(&chain, &grammar);
        Self { chain, grammar, links }
    }

    /// Returns the numbers of the modules that a pattern matches, each with the numbers of its context.
    pub(crate) fn bound(&self, rule: usize) -> Vec<(usize, Vec<usize>)> {
        let number = u16::try_from(rule).expect("few rules");
        let mut modules = 0;
        let numbers: Vec<usize> = self
            .chain
            .symbols
            .iter()
            .map(|symbol| {
                modules += usize::from(*symbol >= FIRST_SYMBOL);
                modules.wrapping_sub(1)
            })
            .collect();
        let mut bindings = Bindings::default();
        let mut found = Vec::new();
        for index in self.matching(rule) {
            self.around().of_rule(number).bind(index, &mut bindings);
            found.push((numbers[index], bindings.iter().map(|at| numbers[*at as usize]).collect()));
        }
        found
    }

    /// Returns the indices of the modules that a pattern matches.
    pub(crate) fn matching(&self, rule: usize) -> impl Iterator<Item = usize> {
        let number = u16::try_from(rule).expect("few rules");
        let symbol = self.grammar.rules()[rule].pattern.symbol;
        let symbols = self.chain.symbols.iter().enumerate();
        let around = self.around();
        symbols
            .filter(move |(_, known)| **known == symbol)
            .map(|(index, _)| index)
            .filter(move |index| around.matches(number, *index))
    }

    fn around(&self) -> ContextMatcher<'_> {
        ContextMatcher { chain: &self.chain, links: &self.links, grammar: &self.grammar }
    }
}

/// Compares the engine with the naive matcher on one random chain; returns the number of modules that
/// matched.
pub(crate) fn compare(kind: Kind, seed: u64, size: usize) -> usize {
    let made = kind.make(&mut Dice::new(seed), size, 6);
    let engine = Engine::new(&made);
    let items = naive::parse(&made.words.join(" "));
    let ignored: Vec<String> = made.ignored.iter().map(|name| (*name).to_owned()).collect();
    let mut matched = 0;
    for (rule, text) in made.patterns.iter().enumerate() {
        let found = engine.bound(rule);
        matched += found.len();
        let expected = naive::bound(&items, &naive::Pattern::parse(text), &ignored);
        assert_eq!(
            found,
            expected,
            "{kind:?} {seed}: {text} with {ignored:?} ignored in {}",
            made.words.join(" ")
        );
    }
    matched
}
