//! Tests with words of all types: each street in a word is built, or a warning reports why not.

use std::path::PathBuf;
use std::sync::Arc;

use burgeon::objects::Network;
use burgeon::script::RunOptions;

/// Random number generator (xorshift).
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, limit: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 33) % limit
    }

    fn pick<T: Copy>(&mut self, choices: &[T]) -> T {
        choices[self.below(choices.len() as u64) as usize]
    }
}

/// Returns a word of F, X, turns, branches, and occasionally a symbol without meaning.
fn word(random: &mut Numbers, depth: u32) -> String {
    let mut word = String::new();
    for _ in 0..2 + random.below(4) {
        match random.below(9) {
            0..=2 => word.push('F'),
            3 | 4 => word.push('X'),
            5 => word.push(random.pick(&['+', '-'])),
            6 => word.push(random.pick(&['A', 'ß', '7', '.'])),
            _ if depth < 2 => {
                word += &format!("[{}{}]", random.pick(&["+", "-", ""]), self::word(random, depth + 1))
            }
            _ => word.push('F'),
        }
    }
    word
}

/// Returns the number of F after X has been replaced by `word` in each iteration.
fn streets(axiom: &str, word: &str, iterations: u32) -> u64 {
    let count = |text: &str, symbol: char| text.chars().filter(|other| *other == symbol).count() as u64;
    let (mut built, mut open) = (count(axiom, 'F'), count(axiom, 'X'));
    for _ in 0..iterations {
        built += open * count(word, 'F');
        open *= count(word, 'X');
    }
    built
}

/// Returns the numbers in a warning: streets added, all streets, refused, beyond a refused street, and repeated.
fn told(text: &str) -> [u64; 5] {
    let number = |before: &str, after: &str| -> u64 {
        let Some(end) = text.find(after) else { return 0 };
        let begin = text[..end].rfind(before).map_or(0, |at| at + before.len());
        text[begin..end].trim().parse().unwrap_or_else(|_| panic!("no number before {after:?}: {text}"))
    };
    let refused = if text.contains(" was refused") {
        number(" ", " was refused")
    } else {
        number(" ", " were refused")
    };
    let all = [
        number(" ", " of "),
        number(" of ", " streets were added"),
        refused,
        number(" ", " are after"),
        number(" ", " repeat an existing street"),
    ];
    // Each reason has a count and a position.
    let reasons = text.split("): ").next().unwrap_or(text);
    let reasons: u64 = reasons
        .match_indices(" (")
        .filter_map(|(at, _)| reasons[at + 2..].split([',', ')']).next()?.parse::<u64>().ok())
        .sum();
    assert_eq!(reasons, refused, "{text}");
    all
}

fn run(set: &[(&str, String)], seed: u64) -> (Arc<Network>, Vec<burgeon::Warning>) {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("scripts/charroads.lua");
    let params: Vec<_> = set.iter().map(|(name, value)| ((*name).to_owned(), value.clone())).collect();
    let options = RunOptions { seed, params: params.into(), lod: 0, ..burgeon::options() };
    let run = burgeon::run(&path, options).unwrap_or_else(|error| panic!("{set:?}: {error}"));
    let object: Arc<dyn std::any::Any + Send + Sync> = run.systems[0].objects[0].clone();
    (object.downcast::<Network>().expect("a network"), run.warnings)
}

#[test]
fn streets_of_a_word_are_there_or_the_reasons_add_up_to_those_that_are_not() {
    let (mut whole, mut partial) = (0, 0);
    for seed in 1..=300 {
        let mut random = Numbers(seed * 0x9E37_79B9);
        let (mut production, mut iterations) = (word(&mut random, 0), 1 + random.below(5) as u32);
        if !production.contains('F') {
            production.push('F');
        }
        while streets("[X]--[X]", &production, iterations) > 1500 {
            iterations -= 1;
        }
        let iterations = iterations.max(1);
        let set = [
            ("word", production.clone()),
            ("iterations", iterations.to_string()),
            ("bend", random.pick(&[5, 12, 20, 30, 45, 60, 85]).to_string()),
            ("branch", random.pick(&[10, 20, 60, 90, 150]).to_string()),
            ("split", random.pick(&["plain", "alternate", "symmetric"]).to_owned()),
        ];
        let asked = streets("[X]--[X]", &production, iterations);
        let (network, warnings) = run(&set, seed);
        let walked: Vec<_> = warnings.iter().filter(|it| it.message().starts_with("network:walk")).collect();
        match walked[..] {
            [] => whole += 1,
            [warning] => {
                let [added, all, refused, beyond, repeated] = told(warning.message());
                assert_eq!(all, asked, "{set:?}: {warning}");
                assert_eq!(added + refused + beyond + repeated, asked, "{set:?}: {warning}");
                assert!(refused > 0 && warning.remedy().is_some(), "{warning}");
                partial += 1;
            }
            _ => panic!("{set:?}: {warnings:?}"),
        }
        let has_blocks = !network.network().faces().is_empty();
        let says_so = warnings.iter().any(|it| it.message().contains("enclose no block"));
        assert_ne!(has_blocks, says_so, "{set:?}: {warnings:?}");
        if walked.is_empty() {
            assert!(network.network().size() > 0, "{set:?}");
        }
    }
    assert!(whole > 30 && partial > 100, "{whole} whole, {partial} in part");
}
