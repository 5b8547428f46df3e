//! Rewriting by the book and without haste: what the engine is compared with.
//!
//! Contexts are found by walking the tree of items from each module anew, straight from the design's law of
//! context. Nothing here is shared with the engine.

/// An item of a chain or of a context.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Item {
    Module(String),
    Branch(Vec<Item>),
}

/// A predecessor with contexts.
#[derive(Debug, Clone)]
pub(crate) struct Pattern {
    pub left: Vec<String>,
    pub predecessor: String,
    pub right: Vec<Item>,
}

/// Reads `A [ B C ] D`.
pub(crate) fn parse(text: &str) -> Vec<Item> {
    let words = super::scripts::words(text);
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

/// Writes what [`parse`] reads.
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
    /// Reads `A B < C > D [ E ]`.
    pub(crate) fn parse(text: &str) -> Self {
        let (left, rest) = text.split_once('<').unwrap_or(("", text));
        let (predecessor, right) = rest.split_once('>').unwrap_or((rest, ""));
        let left = super::scripts::words(left);
        Self { left, predecessor: predecessor.trim().to_owned(), right: parse(right) }
    }

    /// As the engine reads it.
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

    /// Whether it matches the module at `position` of `items`; `path` is what leads there from the axiom.
    fn matches(&self, path: &[&str], items: &[Item], position: usize, ignored: &[String]) -> bool {
        let Item::Module(name) = &items[position] else { return false };
        let skipped = |name: &str| ignored.iter().any(|known| known == name);
        let mut path = path.iter().rev().filter(|name| !skipped(name));
        *name == self.predecessor
            && self.left.iter().rev().all(|wanted| path.next() == Some(&wanted.as_str()))
            && ahead(&self.right, &items[position + 1..], &skipped)
    }
}

/// Whether `items` begin with `contexts`.
fn ahead(contexts: &[Item], items: &[Item], skipped: &dyn Fn(&str) -> bool) -> bool {
    let Some((first, others)) = contexts.split_first() else { return true };
    match first {
        Item::Module(wanted) => {
            for (position, item) in items.iter().enumerate() {
                if let Item::Module(name) = item
                    && !skipped(name)
                {
                    return name == wanted && ahead(others, &items[position + 1..], skipped);
                }
            }
            false
        }
        Item::Branch(wanted) => {
            for (position, item) in items.iter().enumerate() {
                match item {
                    Item::Branch(inner) if ahead(wanted, inner, skipped) => {
                        return ahead(others, &items[position + 1..], skipped);
                    }
                    Item::Module(name) if !skipped(name) => return false,
                    _ => {}
                }
            }
            false
        }
    }
}

/// The numbers of the modules, counted from 0 along the chain, that `pattern` matches.
pub(crate) fn matches(items: &[Item], pattern: &Pattern, ignored: &[String]) -> Vec<usize> {
    let mut found = Vec::new();
    let mut number = 0;
    visit(items, &mut Vec::new(), &mut |path, items, position| {
        if pattern.matches(path, items, position, ignored) {
            found.push(number);
        }
        number += 1;
    });
    found
}

/// Sees the path to an item, the items around it and its place among them.
type See<'a> = dyn FnMut(&[&'a str], &[Item], usize) + 'a;

fn visit<'a>(items: &'a [Item], path: &mut Vec<&'a str>, see: &mut See<'a>) {
    let depth = path.len();
    for (position, item) in items.iter().enumerate() {
        match item {
            Item::Module(name) => {
                see(path, items, position);
                path.push(name);
            }
            Item::Branch(inner) => visit(inner, path, see),
        }
    }
    path.truncate(depth);
}

/// One step: each module becomes the successor of the first rule that matches it.
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
        chosen.push(rules.iter().position(|(pattern, _)| pattern.matches(path, items, position, ignored)));
    });
    rewrite(items, &mut chosen.into_iter(), rules)
}

/// The chain after `steps` steps; `rules` are lines as in [`super::scripts::Plain`].
pub(crate) fn derive(axiom: &str, rules: &str, ignored: &str, steps: usize) -> String {
    let rules: Vec<(Pattern, Vec<Item>)> = rules
        .lines()
        .filter_map(|line| line.split_once("->"))
        .map(|(pattern, successor)| (Pattern::parse(pattern.trim()), parse(successor)))
        .collect();
    let ignored = super::scripts::words(ignored);
    let mut items = parse(axiom);
    for _ in 0..steps {
        items = step(&items, &rules, &ignored);
    }
    write(&items)
}
