//! Simple and slow reference implementation of rewriting, for comparison with the engine.
//!
//! Contexts are found by walking the tree of items from each module, directly as the context law of the
//! design says. Nothing here is shared with the engine.

use std::collections::HashMap;

/// Item of a chain or of a context.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Item {
    Module(String),
    Branch(Vec<Item>),
}

/// Predecessor with contexts.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    pub left: Vec<String>,
    pub predecessor: String,
    pub right: Vec<Item>,
}

/// Returns the words of a chain: names of modules, and brackets.
pub(crate) fn words(chain: &str) -> Vec<String> {
    chain.replace('[', " [ ").replace(']', " ] ").split_whitespace().map(str::to_owned).collect()
}

/// Parses `A [ B C ] D`.
pub(crate) fn parse(text: &str) -> Vec<Item> {
    let words = words(text);
    let mut open: Vec<Vec<Item>> = vec![Vec::new()];
    for word in words {
        match word.as_str() {
            "[" => open.push(Vec::new()),
            "]" => {
                let inner = open.pop().expect("an open branch");
                open.last_mut().expect("an outer branch").push(Item::Branch(inner));
            }
            name => open.last_mut().expect("a branch").push(Item::Module(name.to_owned())),
        }
    }
    assert_eq!(open.len(), 1, "the brackets of {text} balance");
    open.remove(0)
}

/// Writes items in the format that [`parse`] reads.
pub(crate) fn write(items: &[Item]) -> String {
    let text: Vec<String> = items
        .iter()
        .map(|item| match item {
            Item::Module(name) => name.clone(),
            Item::Branch(inner) if inner.is_empty() => "[ ]".to_owned(),
            Item::Branch(inner) => format!("[ {} ]", write(inner)),
        })
        .collect();
    text.join(" ")
}

impl Pattern {
    /// Parses `A B < C > D [ E ]`.
    pub(crate) fn parse(text: &str) -> Self {
        let (left, rest) = text.split_once('<').unwrap_or(("", text));
        let (predecessor, right) = rest.split_once('>').unwrap_or((rest, ""));
        let left = words(left);
        Self { left, predecessor: predecessor.trim().to_owned(), right: parse(right) }
    }

    /// Returns the pattern in the syntax of the engine.
    pub(crate) fn text(&self) -> String {
        let mut text = self.predecessor.clone();
        if !self.left.is_empty() {
            text = format!("{} < {text}", self.left.join(" "));
        }
        if !self.right.is_empty() {
            text = format!("{text} > {}", write(&self.right));
        }
        text
    }

    /// Returns the context modules of the module at `position` of `items`, in the order of the pattern, if it
    /// matches; `path` has the items from the axiom to that position.
    fn bind<'a>(
        &self,
        path: &[&'a Item],
        items: &'a [Item],
        position: usize,
        ignored: &[String],
    ) -> Option<Vec<&'a Item>> {
        let skipped = |name: &str| ignored.iter().any(|known| known == name);
        if items[position].name() != Some(&self.predecessor) {
            return None;
        }
        let mut path = path.iter().rev().filter(|item| item.name().is_some_and(|name| !skipped(name)));
        let mut bound = Vec::new();
        for wanted in self.left.iter().rev() {
            bound.push(*path.next().filter(|item| item.name() == Some(wanted))?);
        }
        bound.reverse();
        bound.extend(ahead(&self.right, &items[position + 1..], &skipped)?);
        Some(bound)
    }
}

impl Item {
    fn name(&self) -> Option<&String> {
        match self {
            Self::Module(name) => Some(name),
            Self::Branch(_) => None,
        }
    }
}

/// Returns the modules of `items` that `contexts` name, if `items` begin with them.
fn ahead<'a>(contexts: &[Item], items: &'a [Item], skipped: &dyn Fn(&str) -> bool) -> Option<Vec<&'a Item>> {
    let Some((first, others)) = contexts.split_first() else { return Some(Vec::new()) };
    for (position, item) in items.iter().enumerate() {
        let behind = &items[position + 1..];
        let found = match (first, item) {
            (Item::Module(_), Item::Branch(_)) => continue,
            (_, Item::Module(name)) if skipped(name) => continue,
            (Item::Module(wanted), Item::Module(name)) => (wanted == name).then(|| vec![item])?,
            (Item::Branch(_), Item::Module(_)) => return None,
            (Item::Branch(wanted), Item::Branch(inner)) => match ahead(wanted, inner, skipped) {
                Some(found) => found,
                None => continue,
            },
        };
        return Some([found, ahead(others, behind, skipped)?].concat());
    }
    None
}

/// Returns the numbers of the modules that `pattern` matches, counted from 0 along the chain, each with the
/// numbers of its context.
pub(crate) fn bound(items: &[Item], pattern: &Pattern, ignored: &[String]) -> Vec<(usize, Vec<usize>)> {
    let mut found: Vec<(usize, Vec<&Item>)> = Vec::new();
    let mut numbers: HashMap<*const Item, usize> = HashMap::new();
    visit(items, &mut Vec::new(), &mut |path, items, position| {
        let number = numbers.len();
        numbers.insert(&items[position], number);
        found.extend(pattern.bind(path, items, position, ignored).map(|bound| (number, bound)));
    });
    let number = |item: &Item| numbers[&std::ptr::from_ref(item)];
    found.into_iter().map(|(module, bound)| (module, bound.into_iter().map(number).collect())).collect()
}

/// Returns the numbers of the modules that `pattern` matches, counted from 0 along the chain.
pub(crate) fn matches(items: &[Item], pattern: &Pattern, ignored: &[String]) -> Vec<usize> {
    bound(items, pattern, ignored).into_iter().map(|(module, _)| module).collect()
}

/// Visitor of an item: its path, the items around it, and its index among them.
type See<'a, 'b> = dyn FnMut(&[&'a Item], &'a [Item], usize) + 'b;

fn visit<'a>(items: &'a [Item], path: &mut Vec<&'a Item>, see: &mut See<'a, '_>) {
    let depth = path.len();
    for (position, item) in items.iter().enumerate() {
        match item {
            Item::Module(_) => {
                see(path, items, position);
                path.push(item);
            }
            Item::Branch(inner) => visit(inner, path, see),
        }
    }
    path.truncate(depth);
}

/// Makes one step: each module becomes the successor of the first rule that matches it.
pub(crate) fn step(items: &[Item], rules: &[(Pattern, Vec<Item>)], ignored: &[String]) -> Vec<Item> {
    fn rewrite(
        items: &[Item],
        successors: &mut dyn Iterator<Item = Option<usize>>,
        rules: &[(Pattern, Vec<Item>)],
    ) -> Vec<Item> {
        let mut out = Vec::new();
        for item in items {
            match item {
                Item::Branch(inner) => out.push(Item::Branch(rewrite(inner, successors, rules))),
                Item::Module(_) => match successors.next().flatten() {
                    Some(rule) => out.extend_from_slice(&rules[rule].1),
                    None => out.push(item.clone()),
                },
            }
        }
        out
    }
    let mut chosen = Vec::new();
    visit(items, &mut Vec::new(), &mut |path, items, position| {
        chosen.push(
            rules.iter().position(|(pattern, _)| pattern.bind(path, items, position, ignored).is_some()),
        );
    });
    rewrite(items, &mut chosen.into_iter(), rules)
}

/// Maximum depth of decompositions, as in the engine.
const MAX_DEPTH: usize = 100;

/// Returns the chain after `steps` steps; `rules` are lines as in [`super::scripts::Plain`].
pub(crate) fn derive(axiom: &str, rules: &str, ignored: &str, steps: usize) -> String {
    let lines = |arrow: &str| -> Vec<(Pattern, Vec<Item>)> {
        let divided = rules.lines().filter_map(|line| line.split_once(arrow));
        divided.map(|(pattern, successor)| (Pattern::parse(pattern.trim()), parse(successor))).collect()
    };
    let (rewriting, decomposition, ignored) = (lines("->"), lines("=>"), words(ignored));
    let decompose = |mut items: Vec<Item>| {
        for _ in 0..MAX_DEPTH {
            let next = step(&items, &decomposition, &ignored);
            if next == items {
                break;
            }
            items = next;
        }
        items
    };
    let mut items = decompose(parse(axiom));
    for _ in 0..steps {
        items = decompose(step(&items, &rewriting, &ignored));
    }
    write(&items)
}
