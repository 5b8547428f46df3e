//! Simple and slow implementation of rewriting on a tree, for comparison.
//!
//! It follows the laws of rewriting directly: each module looks at the tree around it, and each chain is scanned from
//! left to right. Only the keys of random numbers are shared with the crate.

use std::collections::HashMap;

use crate::rewriting::{ModuleKey, Signature, Symbols};

/// Value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PlainValue {
    Nil,
    Boolean(bool),
    Number(f64),
    Text(&'static str),
}

/// Module with its parameters and the key of its random numbers.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct PlainModule {
    pub name: &'static str,
    pub values: Vec<PlainValue>,
    pub key: ModuleKey,
}

/// Element of a chain.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Part {
    Module(PlainModule),
    Branch(Vec<Part>),
}

/// Parameter of a module in a pattern.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Parameter {
    Formal,
    Value(PlainValue),
}

/// Module in a pattern.
#[derive(Debug, Clone)]
pub(crate) struct Wanted {
    /// Names that match; all if there is none.
    pub names: Vec<&'static str>,
    /// Parameters, if the module is written with them.
    pub parameters: Option<Vec<Parameter>>,
}

/// Element of a right context.
#[derive(Debug, Clone)]
pub(crate) enum PlainContext {
    Module(Wanted),
    Branch(Vec<PlainContext>),
    End,
}

/// Pattern of a rule.
#[derive(Debug, Clone)]
pub(crate) struct PlainPattern {
    pub new_left: PlainLeft,
    pub left: PlainLeft,
    pub predecessors: Vec<Wanted>,
    pub right: Vec<PlainContext>,
    pub new_right: Vec<PlainContext>,
}

/// Left context.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlainLeft {
    pub from_beginning: bool,
    pub modules: Vec<Wanted>,
}

/// Settings of a system.
#[derive(Debug, Clone, Default)]
pub(crate) struct PlainSettings {
    /// Names of modules that contexts skip.
    pub ignored: Vec<&'static str>,
    /// Set if the first and the last module of a chain are neighbours.
    pub ring: bool,
}

/// Application of a rule.
pub(crate) struct Application<'a> {
    pub arguments: &'a [PlainValue],
    pub key: ModuleKey,
    /// Set if the choice has used the first random number.
    pub weighted: bool,
}

/// Rule of a system.
pub(crate) trait PlainRule {
    fn pattern(&self) -> &PlainPattern;
    fn weight(&self) -> Option<f64>;
    /// Returns the names of modules that the contexts of this rule skip, if they are not those of the system.
    fn ignored(&self) -> Option<&[&'static str]>;
    fn holds(&self, arguments: &[PlainValue]) -> bool;
    /// Returns the successor without keys; `None` keeps the modules.
    fn successor(&self, application: &Application<'_>) -> Option<Vec<Part>>;
}

impl PlainValue {
    fn equals(self, other: Self) -> bool {
        self == other
    }

    /// Returns the value as a script writes it.
    pub(crate) fn text(self) -> String {
        match self {
            Self::Nil => "nil".to_owned(),
            Self::Boolean(value) => value.to_string(),
            Self::Number(value) => value.to_string(),
            Self::Text(text) => format!("\"{text}\""),
        }
    }
}

impl Wanted {
    /// Returns the arguments of `module` if it matches.
    fn bind(&self, module: &PlainModule) -> Option<Vec<PlainValue>> {
        if !self.names.is_empty() && !self.names.contains(&module.name) {
            return None;
        }
        let mut arguments = Vec::new();
        for (parameter, value) in self.parameters.iter().flatten().zip(&module.values) {
            match parameter {
                Parameter::Formal => arguments.push(*value),
                Parameter::Value(wanted) if !wanted.equals(*value) => return None,
                Parameter::Value(_) => {}
            }
        }
        Some(arguments)
    }

    /// Returns the text of the item, with names for its formal parameters.
    fn text(&self, formals: &mut usize) -> String {
        let names = match self.names.as_slice() {
            [] => "*".to_owned(),
            [one] => (*one).to_owned(),
            several => format!("({})", several.join("|")),
        };
        let Some(parameters) = &self.parameters else { return names };
        let parameters = parameters.iter().map(|parameter| match parameter {
            Parameter::Formal => {
                *formals += 1;
                format!("p{formals}")
            }
            Parameter::Value(value) => value.text(),
        });
        format!("{names}({})", parameters.collect::<Vec<_>>().join(", "))
    }
}

impl PlainPattern {
    /// Returns the pattern as scripts write it, and the number of its formal parameters.
    pub(crate) fn text(&self) -> (String, usize) {
        fn right(contexts: &[PlainContext], formals: &mut usize) -> String {
            let texts = contexts.iter().map(|context| match context {
                PlainContext::Module(wanted) => wanted.text(formals),
                PlainContext::Branch(inner) => format!("[{}]", right(inner, formals)),
                PlainContext::End => "$".to_owned(),
            });
            texts.collect::<Vec<_>>().join(" ")
        }
        fn left(context: &PlainLeft, separator: &str, formals: &mut usize) -> String {
            let mut text = String::new();
            if context.from_beginning {
                text += "^ ";
            }
            context.modules.iter().for_each(|wanted| text += &format!("{} ", wanted.text(formals)));
            if text.is_empty() { text } else { text + separator + " " }
        }
        let mut formals = 0;
        let mut text = left(&self.new_left, "<<", &mut formals);
        text += &left(&self.left, "<", &mut formals);
        let run: Vec<String> = self.predecessors.iter().map(|wanted| wanted.text(&mut formals)).collect();
        text += &run.join(" ");
        for (separator, contexts) in [(">", &self.right), (">>", &self.new_right)] {
            if !contexts.is_empty() {
                text += &format!(" {separator} {}", right(contexts, &mut formals));
            }
        }
        (text, formals)
    }

    /// Returns the arguments of the rule at `place`, if it matches.
    pub(crate) fn bind(&self, place: &Place<'_>, ignored: &[&str]) -> Option<Vec<PlainValue>> {
        let mut own = Vec::new();
        for (distance, wanted) in self.predecessors.iter().enumerate() {
            match place.parts.get(place.position + distance)? {
                Part::Module(module) => own.extend(wanted.bind(module)?),
                Part::Branch(_) => return None,
            }
        }
        let mut arguments = self.new_left.bind(place.written.iter().rev(), ignored)?;
        // A context is shorter than so many rounds.
        let round = place.ring.iter().rev().filter_map(|part| match part {
            Part::Module(module) => Some(module),
            Part::Branch(_) => None,
        });
        let rounds = (0..ROUNDS).flat_map(|_| round.clone());
        arguments.extend(self.left.bind(place.path.iter().rev().copied().chain(rounds), ignored)?);
        arguments.extend(own);
        let mut following: Vec<&Part> =
            place.parts[place.position + self.predecessors.len()..].iter().collect();
        if place.is_main {
            following.extend((0..ROUNDS).flat_map(|_| place.ring));
        }
        arguments.extend(ahead(&self.right, &following, ignored)?);
        arguments.extend(ahead(&self.new_right, &place.after.iter().collect::<Vec<_>>(), ignored)?);
        Some(arguments)
    }
}

/// Number of times that a context may go around a ring.
const ROUNDS: usize = 8;

impl PlainLeft {
    /// Returns the arguments of the context if it matches `path`, the nearest module first.
    fn bind<'a>(
        &self,
        path: impl Iterator<Item = &'a PlainModule>,
        ignored: &[&str],
    ) -> Option<Vec<PlainValue>> {
        let mut path = path.filter(|module| !ignored.contains(&module.name));
        let mut found = Vec::new();
        for wanted in self.modules.iter().rev() {
            found.push(wanted.bind(path.next()?)?);
        }
        if self.from_beginning && path.next().is_some() {
            return None;
        }
        Some(found.into_iter().rev().flatten().collect())
    }
}

/// Module at which rules are chosen, with the chain around it.
pub(crate) struct Place<'a> {
    /// Modules from the axiom to the module.
    pub path: &'a [&'a PlainModule],
    /// Branch or chain with the module.
    pub parts: &'a [Part],
    pub position: usize,
    /// Set if the module is on the main axis.
    pub is_main: bool,
    /// The chain if it is a ring, otherwise nothing.
    pub ring: &'a [Part],
    /// Modules on the path to the module that this step has written.
    pub written: &'a [PlainModule],
    /// Parts after the module in its branch that this step has written.
    pub after: &'a [Part],
}

/// Returns the arguments of `contexts` if `parts` begin with them.
fn ahead(contexts: &[PlainContext], parts: &[&Part], ignored: &[&str]) -> Option<Vec<PlainValue>> {
    let Some((first, others)) = contexts.split_first() else { return Some(Vec::new()) };
    let is_ignored = |part: &Part| matches!(part, Part::Module(module) if ignored.contains(&module.name));
    for (position, part) in parts.iter().enumerate().filter(|(_, part)| !is_ignored(part)) {
        let found = match (first, part) {
            (PlainContext::Module(_) | PlainContext::End, Part::Branch(_)) => continue,
            (PlainContext::Module(wanted), Part::Module(module)) => wanted.bind(module)?,
            (PlainContext::Branch(_) | PlainContext::End, Part::Module(_)) => return None,
            (PlainContext::Branch(wanted), Part::Branch(inner)) => {
                match ahead(wanted, &inner.iter().collect::<Vec<_>>(), ignored) {
                    Some(found) => found,
                    None => continue,
                }
            }
        };
        return Some([found, ahead(others, &parts[position + 1..], ignored)?].concat());
    }
    matches!(first, PlainContext::End).then(Vec::new)
}

/// Returns the chain after one step.
pub(crate) fn step<R: PlainRule>(chain: &[Part], rules: &[R], settings: &PlainSettings) -> Vec<Part> {
    let walk = Walk { rules, settings, ring: if settings.ring { chain } else { &[] } };
    match rules.iter().any(|rule| !rule.pattern().new_right.is_empty()) {
        true => walk.rewrite_backwards(chain, &mut Vec::new(), true),
        false => walk.rewrite(chain, &mut Vec::new(), &mut Vec::new(), true),
    }
}

/// Step of a system.
pub(crate) struct Walk<'r, R> {
    pub rules: &'r [R],
    pub settings: &'r PlainSettings,
    pub ring: &'r [Part],
}

impl<R: PlainRule> Walk<'_, R> {
    /// Rewrites `parts` from left to right.
    fn rewrite<'a>(
        &self,
        parts: &'a [Part],
        path: &mut Vec<&'a PlainModule>,
        written: &mut Vec<PlainModule>,
        is_main: bool,
    ) -> Vec<Part> {
        let (depth, written_depth) = (path.len(), written.len());
        let mut made = Vec::new();
        let mut position = 0;
        while let Some(part) = parts.get(position) {
            let (count, new) = match part {
                Part::Branch(inner) => {
                    made.push(Part::Branch(self.rewrite(inner, path, written, false)));
                    position += 1;
                    continue;
                }
                Part::Module(module) => {
                    let ring = self.ring;
                    self.replace(&Place { path, parts, position, is_main, ring, written, after: &[] }, module)
                }
            };
            written.extend(new.iter().filter_map(|part| match part {
                Part::Module(module) => Some(module.clone()),
                Part::Branch(_) => None,
            }));
            made.extend(new);
            for part in &parts[position..position + count] {
                if let Part::Module(module) = part {
                    path.push(module);
                }
            }
            position += count;
        }
        path.truncate(depth);
        written.truncate(written_depth);
        made
    }

    /// Rewrites `parts` from right to left. Rules have one predecessor.
    fn rewrite_backwards<'a>(
        &self,
        parts: &'a [Part],
        path: &mut Vec<&'a PlainModule>,
        is_main: bool,
    ) -> Vec<Part> {
        let depth = path.len();
        let mut after = Vec::new();
        for (position, part) in parts.iter().enumerate().rev() {
            path.truncate(depth);
            path.extend(parts[..position].iter().filter_map(|part| match part {
                Part::Module(module) => Some(module),
                Part::Branch(_) => None,
            }));
            let new = match part {
                Part::Branch(inner) => vec![Part::Branch(self.rewrite_backwards(inner, path, false))],
                Part::Module(module) => {
                    let (ring, written, after) = (self.ring, &[][..], after.as_slice());
                    self.replace(&Place { path, parts, position, is_main, ring, written, after }, module).1
                }
            };
            after = [new, after].concat();
        }
        path.truncate(depth);
        after
    }

    /// Returns the number of modules at `place` that are replaced together, and the parts that replace them.
    fn replace(&self, place: &Place<'_>, module: &PlainModule) -> (usize, Vec<Part>) {
        let Some((rule, arguments)) = self.choose(place, module) else {
            return (1, vec![Part::Module(module.clone())]);
        };
        let count = rule.pattern().predecessors.len();
        let weighted = rule.weight().is_some();
        let made = match rule.successor(&Application { arguments: &arguments, key: module.key, weighted }) {
            Some(successor) => keyed(successor, module.key, &mut HashMap::new()),
            None => {
                let first = Part::Module(PlainModule { key: module.key.advance(), ..module.clone() });
                let others = &place.parts[place.position + 1..place.position + count];
                [&[first], others].concat()
            }
        };
        (count, made)
    }

    /// Returns the rule that applies at `place`, with its arguments.
    fn choose(&self, place: &Place<'_>, module: &PlainModule) -> Option<(&R, Vec<PlainValue>)> {
        let matching = self.rules.iter().filter_map(|rule| {
            let ignored = rule.ignored().unwrap_or(&self.settings.ignored);
            let arguments = rule.pattern().bind(place, ignored)?;
            (rule.weight() != Some(0.0) && rule.holds(&arguments)).then_some((rule, arguments))
        });
        let mut matching: Vec<(&R, Vec<PlainValue>)> = matching.collect();
        let (first, _) = matching.first()?;
        if first.weight().is_none() {
            return Some(matching.swap_remove(0));
        }
        matching.retain(|(rule, _)| rule.weight().is_some());
        let total: f64 = matching.iter().filter_map(|(rule, _)| rule.weight()).sum();
        let mut left = module.key.stream().uniform() * total;
        let last = matching.len() - 1;
        let chosen = matching.iter().position(|(rule, _)| {
            left -= rule.weight().unwrap_or_default();
            left < 0.0
        });
        Some(matching.swap_remove(chosen.unwrap_or(last)))
    }
}

/// Returns the hash of the name of a module of the script.
fn name_hash(name: &str) -> u64 {
    let mut symbols = Symbols::default();
    let symbol = symbols.declare(Signature::new(name, &[]).expect("a name")).expect("a module");
    symbols.name_hash(symbol)
}

/// Returns a successor with the keys of its modules; `made` counts the modules so far by name.
pub(crate) fn keyed(parts: Vec<Part>, parent: ModuleKey, made: &mut HashMap<String, usize>) -> Vec<Part> {
    let with_key = |part| match part {
        Part::Module(module) => {
            let ordinal = made.entry(module.name.to_string()).or_default();
            *ordinal += 1;
            Part::Module(PlainModule {
                key: parent.successor(name_hash(module.name), *ordinal - 1),
                ..module
            })
        }
        Part::Branch(inner) => Part::Branch(keyed(inner, parent, made)),
    };
    parts.into_iter().map(with_key).collect()
}

/// Returns the chain `parts` as the axiom of a system with this seed.
pub(crate) fn axiom(parts: Vec<Part>, seed: u64) -> Vec<Part> {
    keyed(parts, ModuleKey::seed(seed), &mut HashMap::new())
}

/// Returns the chain without the modules named `cut` and what follows them in their branches.
pub(crate) fn cut_branches(parts: &[Part], cut: &str) -> Vec<Part> {
    let kept = parts.iter().take_while(|part| !matches!(part, Part::Module(module) if module.name == cut));
    let cut_within = kept.map(|part| match part {
        Part::Module(_) => part.clone(),
        Part::Branch(inner) => Part::Branch(cut_branches(inner, cut)),
    });
    cut_within.collect()
}

/// Returns the number of modules.
pub(crate) fn modules(parts: &[Part]) -> usize {
    let count = |part: &Part| match part {
        Part::Module(_) => 1,
        Part::Branch(inner) => modules(inner),
    };
    parts.iter().map(count).sum()
}
