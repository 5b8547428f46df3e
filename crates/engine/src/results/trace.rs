//! Which rules made which modules: kept only for the chains that someone asks about.
//!
//! A run is determined by its script, parameters and seed, so a chain can be derived again whenever it is asked
//! about. Nothing of this is remembered otherwise.

use std::sync::Arc;

use crate::placeholders::QUERY;
use burgeon_base::error::{SourcePlace, shortened};
use burgeon_kit::Makers;
use burgeon_kit::Values;
use burgeon_rewriting::{Chain, END, NO_RULE, Symbol, Symbols, module_brief};

/// Characters of a parameter that people are shown.
const SHOWN: usize = 2000;

/// In place of a rule's number: what a module stood for took its place.
pub(crate) const RESOLVED: u16 = NO_RULE - 1;

/// What took the place of a module that stood for others, in words.
pub(crate) struct PendingAnswer {
    /// Its place in the chain.
    pub symbol: usize,
    pub text: String,
    /// The line that made the module.
    pub place: Option<SourcePlace>,
}

/// How the symbols of a chain became those of the next.
#[derive(Default)]
pub(crate) struct Step {
    /// The number of the derivation step, 0 for the axiom.
    pub number: usize,
    /// The chain before the step; left empty where all chains are traced, whose modules nobody looks at.
    pub chain: Chain,
    /// For each symbol of that chain: the rule that ran, or none, and how many symbols came of it.
    pub applied: Vec<(u16, u32)>,
    /// What took the places of modules that stood for others, in the order of the chain.
    pub answers: Vec<PendingAnswer>,
    /// What guards and successors have asked of data for the symbol at a place, and how many rows they got; by place.
    pub asked: Vec<(usize, String)>,
}

/// A rule as people see it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleName {
    /// Its pattern.
    pub text: String,
    /// Where it was declared.
    pub place: Option<SourcePlace>,
}

/// A module as people see it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Module {
    /// Its name and parameters, such as `Floor(3,6)`.
    pub text: String,
    /// Its symbol's name.
    pub symbol: String,
    /// The names and values of its parameters.
    pub params: Vec<(String, String)>,
}

/// A module on the way from the axiom to the one that is asked about.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ancestor {
    /// The derivation step that made it; 0 for the axiom's.
    pub step: usize,
    /// The module.
    pub module: Module,
    /// The rule that made it, or that asked for it; `None` for the axiom's, and for a part of another module.
    pub rule: Option<RuleName>,
    /// What it came of where it took the place of a module that stood for others, such as a query with its values and
    /// the number of its rows, and the line that made that module.
    pub answer: Option<RuleName>,
    /// What its rules asked of data as it was made, with values and the number of rows: first the guards, and then the
    /// successor.
    pub asked: Vec<String>,
    /// Its number among the modules that came of the same application, from 0.
    pub ordinal: usize,
}

/// What a rule, an interpretation rule or the axiom has made.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleProducts {
    /// Its pattern, or "axiom".
    pub name: String,
    /// The line where it begins.
    pub line: usize,
    /// For each symbol of the final chain, whether it came of it.
    pub made: Vec<bool>,
}

/// Derived chains with all that led to them.
pub struct Trace {
    pub(crate) steps: Vec<Step>,
    pub(crate) chain: Chain,
    pub(crate) makers: Vec<Option<Makers>>,
    symbols: Arc<Symbols>,
    values: Arc<Values>,
    rules: Vec<RuleName>,
    interpretations: Vec<RuleName>,
    /// By symbol: the number of its interpretation rule, or [`NO_RULE`].
    interpreted: Vec<u16>,
    axiom: Option<SourcePlace>,
}

impl Trace {
    /// A trace without steps, of chains with these rules and interpretations.
    pub(crate) fn new(
        (symbols, values): (&Arc<Symbols>, &Arc<Values>),
        rules: Vec<RuleName>,
        interpretations: Vec<RuleName>,
        interpreted: Vec<u16>,
        axiom: Option<SourcePlace>,
    ) -> Self {
        Self {
            steps: Vec::new(),
            chain: Chain::default(),
            makers: Vec::new(),
            symbols: Arc::clone(symbols),
            values: Arc::clone(values),
            rules,
            interpretations,
            interpreted,
            axiom,
        }
    }

    /// Where the axiom was set.
    pub fn axiom(&self) -> Option<&SourcePlace> {
        self.axiom.as_ref()
    }

    /// The number of symbols in the final chain, brackets and ends included.
    pub fn len(&self) -> usize {
        self.chain.symbols.len()
    }

    /// Whether there is nothing in the final chain.
    pub fn is_empty(&self) -> bool {
        self.chain.symbols.is_empty()
    }

    /// Whether there is a module at place `index` of the final chain.
    pub fn is_module(&self, index: usize) -> bool {
        self.chain.symbols.get(index).is_some_and(|symbol| *symbol > END)
    }

    /// The module at place `index` of the final chain; `None` for a bracket and past the end.
    pub fn module(&self, index: usize) -> Option<Module> {
        self.module_of(&self.chain, index)
    }

    fn module_of(&self, chain: &Chain, index: usize) -> Option<Module> {
        let symbol = *chain.symbols.get(index)?;
        if symbol <= END {
            return None;
        }
        let arities = self.symbols.arities();
        let arity = |symbol: &Symbol| usize::from(arities[usize::from(*symbol)]);
        let begin: usize = chain.symbols[..index].iter().map(arity).sum();
        let params = &chain.params[begin..begin + arity(&symbol)];
        let signature = self.symbols.signature(symbol);
        Some(Module {
            text: module_brief(&self.symbols, &self.values, symbol, params),
            symbol: self.symbols.shown(symbol).to_owned(),
            params: signature
                .parameters
                .iter()
                .zip(params)
                .map(|(name, value)| {
                    (name.clone(), shortened(&self.values.unpack(*value).to_string(), SHOWN).into_owned())
                })
                .collect(),
        })
    }

    /// The rule that interprets the module at place `index` of the final chain.
    pub fn interpretation(&self, index: usize) -> Option<&RuleName> {
        let symbol = *self.chain.symbols.get(index)?;
        self.interpretations.get(usize::from(self.interpreted[usize::from(symbol)]))
    }

    /// The modules from the axiom to place `index` of the final chain, where a rule made something new.
    pub fn path(&self, index: usize) -> Vec<Ancestor> {
        let mut path = Vec::new();
        let mut here = index;
        for (place, step) in self.steps.iter().enumerate().rev() {
            let Some((parent, begin)) = parent(&step.applied, here) else { return path };
            let rule = step.applied[parent].0;
            if rule != NO_RULE {
                let after = self.steps.get(place + 1).map_or(&self.chain, |next| &next.chain);
                let before = after.symbols[begin..here].iter().filter(|symbol| **symbol > END);
                let rule = self.rules.get(usize::from(rule)).cloned();
                if stands_for_rows(after, here) {
                    // What took its place is told of, and that this rule asked for it.
                    path.last_mut().into_iter().for_each(|rows: &mut Ancestor| rows.rule.clone_from(&rule));
                } else if let Some(module) = self.module_of(after, here) {
                    let answer = step.answers.iter().find(|answer| answer.symbol == parent);
                    let answer = answer
                        .map(|answer| RuleName { text: answer.text.clone(), place: answer.place.clone() });
                    let asked = step.asked.iter().filter(|(symbol, _)| *symbol == parent);
                    let asked = asked.map(|(_, text)| text.clone()).collect();
                    let ordinal = before.count();
                    path.push(Ancestor { step: step.number, module, rule, answer, asked, ordinal });
                }
            }
            here = parent;
        }
        let first = self.steps.first().map_or(&self.chain, |step| &step.chain);
        if let Some(module) = self.module_of(first, here).filter(|_| !stands_for_rows(first, here)) {
            let before = first.symbols[..here].iter().filter(|symbol| **symbol > END).count();
            let (rule, answer, asked) = (None, None, Vec::new());
            path.push(Ancestor { step: 0, module, rule, answer, asked, ordinal: before });
        }
        path.reverse();
        path
    }

    /// The text of the final chain around place `index`: up to `radius` symbols before it, itself, and as many after.
    pub fn around(&self, index: usize, radius: usize) -> [String; 3] {
        around(&self.chain, &self.symbols, &self.values, index, radius)
    }

    /// What line `line` of `file` says, if it is a rule, an interpretation rule or the axiom: the last of them that
    /// begins there or above.
    fn line(&self, file: &str, line: usize) -> Option<(LineSubject, usize)> {
        let rules =
            (0u16..).zip(&self.rules).map(|(index, rule)| (LineSubject::Rule(index), rule.place.as_ref()));
        let interpretations = (0u16..)
            .zip(&self.interpretations)
            .map(|(index, rule)| (LineSubject::Interpretation(index), rule.place.as_ref()));
        let axiom = std::iter::once((LineSubject::Axiom, self.axiom.as_ref()));
        axiom
            .chain(rules)
            .chain(interpretations)
            .filter_map(|(what, place)| Some((what, place?)))
            .filter(|(_, place)| place.file == file && place.line <= line)
            .max_by_key(|(_, place)| place.line)
            .map(|(what, place)| (what, place.line))
    }

    /// What the rule, interpretation rule or axiom at a line, or the last one above it, has made in the end. `None` if
    /// there is none.
    pub fn made_by(&self, file: &str, line: usize) -> Option<RuleProducts> {
        let (what, line) = self.line(file, line)?;
        let (name, made) = match what {
            LineSubject::Axiom => ("axiom".to_owned(), vec![true; self.chain.symbols.len()]),
            LineSubject::Interpretation(wanted) => {
                let made = |symbol: &Symbol| self.interpreted[usize::from(*symbol)] == wanted;
                let name = self.interpretations[usize::from(wanted)].text.clone();
                (name, self.chain.symbols.iter().map(made).collect())
            }
            LineSubject::Rule(wanted) => {
                let first = self.steps.first().map_or(0, |step| step.applied.len());
                let mut made = vec![false; first];
                for step in &self.steps {
                    let applied = step.applied.iter().zip(&made);
                    made = applied
                        .flat_map(|((rule, count), made)| {
                            std::iter::repeat_n(*made || *rule == wanted, *count as usize)
                        })
                        .collect();
                }
                made.resize(self.chain.symbols.len(), false);
                (self.rules[usize::from(wanted)].text.clone(), made)
            }
        };
        Some(RuleProducts { name, line, made })
    }

    /// For each traced chain, where its symbols begin in the final chain.
    pub fn starts(&self) -> Vec<usize> {
        self.chain.starts(&self.symbols.arities()).iter().map(|mark| mark.module).collect()
    }

    /// Who made what is drawn of each traced chain; `None` where the object does not draw with a
    /// [`Drawing`](burgeon_kit::Drawing).
    pub(crate) fn makers(&self) -> &[Option<Makers>] {
        &self.makers
    }
}

/// What a line of a script says.
enum LineSubject {
    Axiom,
    Rule(u16),
    Interpretation(u16),
}

/// Whether the module at place `index` of a chain is a query.
fn stands_for_rows(chain: &Chain, index: usize) -> bool {
    chain.symbols.get(index) == Some(&QUERY)
}

/// The symbol that became the one at `index` after a step, and where the symbols that came of it begin.
fn parent(applied: &[(u16, u32)], index: usize) -> Option<(usize, usize)> {
    let mut begin = 0;
    for (parent, (_, count)) in applied.iter().enumerate() {
        let end = begin + *count as usize;
        if index < end {
            return Some((parent, begin));
        }
        begin = end;
    }
    None
}

/// The text of `chain` around place `index`: up to `radius` symbols before it, itself, and as many after it.
pub(crate) fn around(
    chain: &Chain,
    symbols: &Symbols,
    values: &Values,
    index: usize,
    radius: usize,
) -> [String; 3] {
    let arities = symbols.arities();
    let (from, to) = (index.saturating_sub(radius), (index + 1 + radius).min(chain.symbols.len()));
    let mut texts = [const { String::new() }; 3];
    let arity = |symbol: Symbol| usize::from(arities[usize::from(symbol)]);
    let mut param: usize = chain.symbols[..from.min(to)].iter().map(|symbol| arity(*symbol)).sum();
    for at in from..to {
        let symbol = chain.symbols[at];
        let text = module_brief(symbols, values, symbol, &chain.params[param..param + arity(symbol)]);
        param += arity(symbol);
        let side = &mut texts[(at >= index) as usize + (at > index) as usize];
        if !side.is_empty() && !text.is_empty() {
            side.push(' ');
        }
        side.push_str(&text);
    }
    texts
}
