//! Random chains and patterns: the engine and the naive matcher find the same modules.

use burgeon::script::RunOptions;
use proptest::collection::vec;
use proptest::prelude::*;

use super::generate::{Engine, KINDS, Made, compare};
use super::naive::{self, Item, Pattern};
use super::scripts::{Case, Passing, divided, matched, words};

const NAMES: [&str; 4] = ["A", "B", "C", "X"];

fn name() -> impl Strategy<Value = String> {
    // A few frequent names, so that patterns match often.
    prop_oneof![6 => Just(0), 3 => Just(1), 1 => Just(2), 2 => Just(3)]
        .prop_map(|index: usize| NAMES[index].to_owned())
}

fn items(depth: u32, length: usize) -> impl Strategy<Value = Vec<Item>> {
    let item = name().prop_map(Item::Module).prop_recursive(
        depth,
        40,
        5,
        |inner| prop_oneof![1 => name().prop_map(Item::Module), 1 => vec(inner, 0..5).prop_map(Item::Branch)],
    );
    vec(item, 0..length)
}

/// Right context without empty branches.
fn context() -> impl Strategy<Value = Vec<Item>> {
    let item = name().prop_map(Item::Module).prop_recursive(
        2,
        6,
        2,
        |inner| prop_oneof![2 => name().prop_map(Item::Module), 2 => vec(inner, 1..2).prop_map(Item::Branch)],
    );
    vec(item, 0..3)
}

fn pattern() -> impl Strategy<Value = Pattern> {
    (vec(name(), 0..3), name(), context()).prop_map(|(left, predecessor, right)| Pattern {
        left,
        predecessor,
        right,
    })
}

fn division() -> impl Strategy<Value = RunOptions> {
    (1usize..3, prop_oneof![Just(1usize), Just(2), Just(3), Just(4096)])
        .prop_map(|(threads, batch)| divided(threads, batch))
}

fn ignored() -> impl Strategy<Value = &'static str> {
    prop_oneof![Just(""), Just("X"), Just("X C"), Just("A")]
}

/// Returns the matches of the naive matcher in several chains.
fn expected(chains: &[Vec<Item>], pattern: &Pattern, ignored: &str) -> Vec<usize> {
    let mut found = Vec::new();
    let mut before = 0;
    for chain in chains {
        found.extend(
            naive::matches(chain, pattern, &words(ignored)).into_iter().map(|number| number + before),
        );
        before += words(&naive::write(chain)).iter().filter(|word| *word != "[" && *word != "]").count();
    }
    found
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn the_engine_matches_what_the_naive_matcher_matches(
        chains in vec(items(4, 16), 1..4),
        patterns in vec((pattern(), ignored()), 20),
        options in division(),
    ) {
        let texts: Vec<String> = chains.iter().map(|chain| naive::write(chain)).collect();
        let cases: Vec<Case> = patterns
            .iter()
            .map(|(pattern, ignored)| Case {
                passing: if ignored.is_empty() { Passing::Nothing } else { Passing::Ignore(ignored) },
                chains: texts.clone(),
                pattern: pattern.clone(),
            })
            .collect();
        for (case, found) in cases.iter().zip(matched(&cases, options)) {
            let ignored = match case.passing { Passing::Ignore(names) => names, _ => "" };
            prop_assert_eq!(&found, &expected(&chains, &case.pattern, ignored), "{:?}", case);
        }
    }
}

#[test]
fn random_patterns_match_often_enough_to_tell_something() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let (mut with_contexts, mut with_branches) = (0, 0);
    for _ in 0..960 {
        let chain = items(4, 16).new_tree(&mut runner).expect("a chain").current();
        let pattern = pattern().new_tree(&mut runner).expect("a pattern").current();
        let found = naive::matches(&chain, &pattern, &[]).len();
        if !pattern.left.is_empty() || !pattern.right.is_empty() {
            with_contexts += found;
        }
        if pattern.right.iter().any(|item| matches!(item, Item::Branch(_))) {
            with_branches += found;
        }
    }
    assert!(
        with_contexts > 200 && with_branches > 20,
        "{with_contexts} matches, {with_branches} of named branches"
    );
}

#[test]
fn contexts_of_every_hard_kind_match_and_bind_as_the_naive_matcher_says() {
    for kind in KINDS {
        let mut matched = 0;
        for seed in 0..300 {
            matched += compare(kind, seed, 10 + (seed as usize % 10) * 20);
        }
        assert!(matched > 500, "{kind:?} tells something: {matched} matches");
    }
}

#[test]
fn a_search_that_passes_many_branches_is_not_made_again() {
    // 20,000 modules with 20,000 branches behind each take 200 million trials without a cache.
    for (unit, pattern) in [
        (&["X", "[", "C", "]"][..], "X > [ Z ]"),
        (&["X", "[", "C", "]"], "X > [ [ Z ] ]"),
        (&["X"], "X > [ Z ]"),
        (&["X", "[", "]", "[", "X", "]"], "X > [ C ] B"),
    ] {
        let words = unit.repeat(20_000);
        let made = Made { words, patterns: vec![pattern.to_owned()], ignored: vec!["X"] };
        let engine = Engine::new(&made);
        let begin = std::time::Instant::now();
        assert_eq!(engine.matching(0).count(), 0);
        assert!(begin.elapsed().as_millis() < 1000, "{pattern}: {:?}", begin.elapsed());
    }
}
