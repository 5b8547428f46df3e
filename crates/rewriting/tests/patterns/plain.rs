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
    pub from_beginning: bool,
    pub left: Vec<Wanted>,
    pub predecessors: Vec<Wanted>,
    pub right: Vec<PlainContext>,
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
        let mut formals = 0;
        let mut text = String::new();
        if self.from_beginning {
            text += "^ ";
        }
        self.left.iter().for_each(|wanted| text += &format!("{} ", wanted.text(&mut formals)));
        if !text.is_empty() {
            text += "< ";
        }
        let run: Vec<String> = self.predecessors.iter().map(|wanted| wanted.text(&mut formals)).collect();
        text += &run.join(" ");
        if !self.right.is_empty() {
            text += &format!(" > {}", right(&self.right, &mut formals));
        }
        (text, formals)
    }

    /// Returns the arguments of the rule at `position` of `parts`, if it matches. `path` are the modules from the axiom
    /// to that position.
    fn bind(
        &self,
        path: &[&PlainModule],
        parts: &[Part],
        position: usize,
        ignored: &[&str],
    ) -> Option<Vec<PlainValue>> {
        let mut own = Vec::new();
        for (distance, wanted) in self.predecessors.iter().enumerate() {
            match parts.get(position + distance)? {
                Part::Module(module) => own.extend(wanted.bind(module)?),
                Part::Branch(_) => return None,
            }
        }
        let mut path = path.iter().rev().filter(|module| !ignored.contains(&module.name));
        let mut left = Vec::new();
        for wanted in self.left.iter().rev() {
            left.push(wanted.bind(path.next()?)?);
        }
        if self.from_beginning && path.next().is_some() {
            return None;
        }
        let mut arguments: Vec<PlainValue> = left.into_iter().rev().flatten().collect();
        arguments.extend(own);
        arguments.extend(ahead(&self.right, &parts[position + self.predecessors.len()..], ignored)?);
        Some(arguments)
    }
}

/// Returns the arguments of `contexts` if `parts` begin with them.
fn ahead(contexts: &[PlainContext], parts: &[Part], ignored: &[&str]) -> Option<Vec<PlainValue>> {
    let Some((first, others)) = contexts.split_first() else { return Some(Vec::new()) };
    let is_ignored = |part: &Part| matches!(part, Part::Module(module) if ignored.contains(&module.name));
    for (position, part) in parts.iter().enumerate().filter(|(_, part)| !is_ignored(part)) {
        let found = match (first, part) {
            (PlainContext::Module(_) | PlainContext::End, Part::Branch(_)) => continue,
            (PlainContext::Module(wanted), Part::Module(module)) => wanted.bind(module)?,
            (PlainContext::Branch(_) | PlainContext::End, Part::Module(_)) => return None,
            (PlainContext::Branch(wanted), Part::Branch(inner)) => match ahead(wanted, inner, ignored) {
                Some(found) => found,
                None => continue,
            },
        };
        return Some([found, ahead(others, &parts[position + 1..], ignored)?].concat());
    }
    matches!(first, PlainContext::End).then(Vec::new)
}

/// Returns the chain after one step.
pub(crate) fn step<R: PlainRule>(chain: &[Part], rules: &[R], ignored: &[&str]) -> Vec<Part> {
    rewrite(chain, &mut Vec::new(), rules, ignored)
}

fn rewrite<'a, R: PlainRule>(
    parts: &'a [Part],
    path: &mut Vec<&'a PlainModule>,
    rules: &[R],
    ignored: &[&str],
) -> Vec<Part> {
    let depth = path.len();
    let mut made = Vec::new();
    let mut position = 0;
    while let Some(part) = parts.get(position) {
        let module = match part {
            Part::Branch(inner) => {
                made.push(Part::Branch(rewrite(inner, path, rules, ignored)));
                position += 1;
                continue;
            }
            Part::Module(module) => module,
        };
        let mut count = 1;
        match choose(path, parts, position, (rules, ignored), module) {
            Some((rule, arguments)) => {
                count = rule.pattern().predecessors.len();
                let weighted = rule.weight().is_some();
                let application = Application { arguments: &arguments, key: module.key, weighted };
                match rule.successor(&application) {
                    Some(successor) => made.extend(keyed(successor, module.key, &mut HashMap::new())),
                    None => {
                        made.push(Part::Module(PlainModule { key: module.key.advance(), ..module.clone() }));
                        made.extend_from_slice(&parts[position + 1..position + count]);
                    }
                }
            }
            None => made.push(part.clone()),
        }
        for part in &parts[position..position + count] {
            if let Part::Module(module) = part {
                path.push(module);
            }
        }
        position += count;
    }
    path.truncate(depth);
    made
}

/// Returns the rule that applies at `position`, with its arguments.
fn choose<'r, R: PlainRule>(
    path: &[&PlainModule],
    parts: &[Part],
    position: usize,
    (rules, ignored): (&'r [R], &[&str]),
    module: &PlainModule,
) -> Option<(&'r R, Vec<PlainValue>)> {
    let matching = rules.iter().filter_map(|rule| {
        let arguments = rule.pattern().bind(path, parts, position, ignored)?;
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

/// Returns the hash of the name of a module of the script.
fn name_hash(name: &str) -> u64 {
    let mut symbols = Symbols::default();
    let symbol = symbols.declare(Signature::new(name, &[]).expect("a name")).expect("a module");
    symbols.name_hash(symbol)
}

/// Returns a successor with the keys of its modules; `made` counts the modules so far by name.
fn keyed(parts: Vec<Part>, parent: ModuleKey, made: &mut HashMap<String, usize>) -> Vec<Part> {
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
