//! Edits of scripts: the random numbers of the modules that an edit does not touch stay the same.

use proptest::prelude::*;
use proptest::test_runner::{Config, TestRunner};

use super::scripts::{chain_of_each, words};

/// Modules that grow; each draws a number for a module `U`.
const GROWING: [&str; 3] = ["A", "B", "C"];

/// Item of a successor: a growing module, a module with a random number, or a branch.
#[derive(Debug, Clone, PartialEq)]
enum Item {
    Growing(usize),
    Random,
    /// Module that only an edit adds.
    Added,
    Branch(Vec<Item>),
}

fn lua(items: &[Item]) -> String {
    let item = |item: &Item| match item {
        Item::Growing(index) => format!("{}()", GROWING[*index]),
        Item::Random => "U(random())".to_owned(),
        Item::Added => "X()".to_owned(),
        Item::Branch(inner) => format!("{{ {} }}", lua(inner)),
    };
    items.iter().map(item).collect::<Vec<_>>().join(", ")
}

/// Axiom and the successor of each growing module.
type Successors = [Vec<Item>; 4];

fn system(successors: &Successors, declared: &str) -> String {
    let rules = GROWING
        .iter()
        .zip(&successors[1..])
        .map(|(name, items)| format!("s:rule('{name}', function() return {} end)\n", lua(items)));
    format!(
        "do
           {declared} local X, A, B, C, U = module('X'), module('A'), module('B'), module('C'), module('U', 'u')
           local s = lsystem {{}}
           s:axiom({})
           {}
           s:derive(4)
         end\n",
        lua(&successors[0]),
        rules.collect::<String>()
    )
}

fn item() -> impl Strategy<Value = Item> {
    prop_oneof![3 => Just(Item::Random), 4 => (0..3_usize).prop_map(Item::Growing)]
}

fn items() -> impl Strategy<Value = Vec<Item>> {
    let branch = prop::collection::vec(item(), 1..3).prop_map(Item::Branch);
    prop::collection::vec(prop_oneof![5 => item(), 1 => branch], 1..4)
}

/// Edit of one successor.
#[derive(Debug, Clone)]
enum Edit {
    /// Adds a module with another name at a place.
    Add(usize),
    /// Adds a branch with a module with another name at a place.
    AddBranch(usize),
    /// Puts one module into a branch of its own.
    Enclose(usize),
    /// Declares more modules before the others.
    Declare,
    /// Exchanges two modules with different names; their order changes, and nothing else.
    Exchange(usize),
}

fn edit() -> impl Strategy<Value = Edit> {
    let place = || 0..5_usize;
    prop_oneof![
        place().prop_map(Edit::Add),
        place().prop_map(Edit::AddBranch),
        place().prop_map(Edit::Enclose),
        Just(Edit::Declare),
        place().prop_map(Edit::Exchange),
    ]
}

impl Edit {
    /// Returns the edited successor.
    fn apply(&self, items: &[Item]) -> Vec<Item> {
        let mut items = items.to_vec();
        match self {
            Self::Add(place) => items.insert((*place).min(items.len()), Item::Added),
            Self::AddBranch(place) => {
                items.insert((*place).min(items.len()), Item::Branch(vec![Item::Added]))
            }
            Self::Enclose(place) => {
                let place = place % items.len();
                items[place] = Item::Branch(vec![items[place].clone()]);
            }
            Self::Declare => {}
            Self::Exchange(place) => {
                let plain = |item: &Item| matches!(item, Item::Growing(_) | Item::Random);
                let second = place + 1;
                if second < items.len()
                    && items[*place] != items[second]
                    && plain(&items[*place])
                    && plain(&items[second])
                {
                    items.swap(*place, second);
                }
            }
        }
        items
    }
}

/// Returns the modules of a chain that an edit has not added, without brackets, in alphabetical order.
fn numbers(chain: &str) -> Vec<String> {
    let mut found: Vec<String> =
        words(chain).into_iter().filter(|word| !["X", "[", "]"].contains(&word.as_str())).collect();
    found.sort();
    found
}

#[test]
fn an_edit_keeps_the_random_numbers_of_the_modules_that_it_does_not_touch() {
    let mut runner = TestRunner::new(Config { failure_persistence: None, ..Config::with_cases(60) });
    // Random numbers at the top level belong to the script, not to a module.
    let axiom = prop::collection::vec((0..3_usize).prop_map(Item::Growing), 1..4);
    let successors = [axiom.boxed(), items().boxed(), items().boxed(), items().boxed()];
    let strategy = (successors, prop::collection::vec((0..4_usize, edit()), 50));
    let checked = std::cell::Cell::new(0);
    runner
        .run(&strategy, |(successors, edits)| {
            let mut script = system(&successors, "");
            for (which, edit) in &edits {
                let mut edited = successors.clone();
                edited[*which] = edit.apply(&successors[*which]);
                let declared = if matches!(edit, Edit::Declare) {
                    "local V, W = module('V'), module('W', 'w')"
                } else {
                    ""
                };
                script += &system(&edited, declared);
            }
            let chains = chain_of_each(&script);
            let expected = numbers(&chains[0]);
            for ((which, edit), chain) in edits.iter().zip(&chains[1..]) {
                prop_assert_eq!(&numbers(chain), &expected, "{:?} of successor {}", edit, which);
                checked.set(checked.get() + 1);
            }
            Ok(())
        })
        .expect("the numbers stay");
    assert_eq!(checked.get(), 60 * 50);
}

#[test]
fn a_module_that_an_edit_adds_behind_others_of_its_name_changes_only_what_follows() {
    let system = |successor: &str| {
        format!(
            "local A, U = module('A'), module('U', 'u')
             local s = lsystem {{}}
             s:axiom(A())
             s:rule('A', function() return {successor} end)
             s:derive(1)"
        )
    };
    let numbers = |successor: &str| {
        let drawn = format!("U(stream('a')()), {successor}");
        words(&super::scripts::chain(&system(&drawn)))
    };
    assert_eq!(numbers("A()")[0], numbers("A(), A()")[0]);
}

#[test]
fn the_numbers_of_a_module_depend_on_its_own_name_and_package_only() {
    let first = |names: [&str; 2]| {
        let [one, two] = names;
        let script = format!(
            "local One, Two, U = module('{one}'), module('{two}'), module('U', 'u')
             local s = lsystem {{}}
             s:axiom(One(), Two())
             s:rule('{one}', function() return U(random()) end)
             s:rule('{two}', function() return U(random()) end)
             s:derive(1)"
        );
        words(&super::scripts::chain(&script))
    };
    let plain = first(["Bud", "Leaf"]);
    assert_eq!(first(["Bud", "Flower"])[0], plain[0]);
    assert_eq!(first(["Flower", "Leaf"])[1], plain[1]);
    assert_ne!(first(["Flower", "Leaf"])[0], plain[0]);
    let mut turned = first(["Leaf", "Bud"]);
    turned.reverse();
    assert_eq!(turned, plain);
}
