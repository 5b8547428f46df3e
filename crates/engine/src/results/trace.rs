//! Lineage of modules, recorded only for the chains of a trace request.
//!
//! Script, parameters and seed determine a run, so a chain can be derived again when it is traced. Other runs
//! record no lineage.

use std::sync::Arc;

use crate::placeholders::QUERY;
use burgeon_base::error::{SourcePlace, shorten};
use burgeon_kit::Makers;
use burgeon_kit::Values;
use burgeon_rewriting::{Chain, END, NO_RULE, Symbol, Symbols, module_brief};

/// Maximum number of characters of a parameter's text.
const SHOWN: usize = 2000;

/// Rule number for a placeholder module that was resolved.
pub(crate) const RESOLVED: u16 = NO_RULE - 1;

/// Description of the modules that replaced a placeholder module.
pub(crate) struct PendingAnswer {
    /// Index of the placeholder in the chain.
    pub symbol: usize,
    pub text: String,
    /// Line that made the placeholder.
    pub place: Option<SourcePlace>,
}

/// Step from a chain to the next.
#[derive(Default)]
pub(crate) struct Step {
    /// Number of the derivation step; 0 for the axiom.
    pub number: usize,
    /// Chain before the step; empty if all chains are traced, because then no module is inspected.
    pub chain: Chain,
    /// For each symbol of the chain before the step: the rule that ran or [`NO_RULE`], and the number of its
    /// successors.
    pub applied: Vec<(u16, u32)>,
    /// Replacements of placeholder modules, in the order of the chain.
    pub answers: Vec<PendingAnswer>,
    /// Queries of guards and successors with their row counts, by the index of the symbol.
    pub asked: Vec<(usize, String)>,
}

/// Display name of a rule.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleName {
    /// Pattern of the rule.
    pub text: String,
    /// Location of the declaration.
    pub place: Option<SourcePlace>,
}

impl RuleName {
    /// Creates the name of a rule with this pattern.
    pub(crate) fn new(text: &str, place: Option<&SourcePlace>) -> Self {
        Self { text: text.to_owned(), place: place.cloned() }
    }
}

/// Display form of a module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Module {
    /// Name and parameters, such as `Floor(3,6)`.
    pub text: String,
    /// Name of the symbol.
    pub symbol: String,
    /// Names and values of the parameters.
    pub params: Vec<(String, String)>,
}

/// Module between the axiom and the traced module.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Ancestor {
    /// Derivation step that made it; 0 for the axiom.
    pub step: usize,
    /// Name and parameters.
    pub module: Module,
    /// Rule that made or requested it; `None` for the axiom, and for a part of another module.
    pub rule: Option<RuleName>,
    /// Origin of a module that replaced a placeholder, such as a query with its values and row count, and the
    /// line that made the placeholder.
    pub answer: Option<RuleName>,
    /// Queries of the rules that made it, with values and row counts: first the guards, then the successor.
    pub asked: Vec<String>,
    /// Index among the modules of the same application, from 0.
    pub ordinal: usize,
}

/// Symbols made by a rule, an interpretation rule or the axiom.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleProducts<'a> {
    /// Pattern of the rule, or "axiom".
    pub name: &'a str,
    /// First line of the declaration.
    pub line: usize,
    /// For each symbol of the final chain: true if this rule made it or one of its ancestors.
    pub made: Vec<bool>,
}

/// Derived chains with their complete lineage.
pub struct Trace {
    pub(crate) steps: Vec<Step>,
    pub(crate) chain: Chain,
    pub(crate) makers: Vec<Option<Makers>>,
    symbols: Arc<Symbols>,
    values: Arc<Values>,
    rules: Vec<RuleName>,
    interpretations: Vec<RuleName>,
    /// Number of the interpretation rule of each symbol of the chain, or [`NO_RULE`].
    interpreted: Vec<u16>,
    axiom: Option<SourcePlace>,
}

impl Trace {
    /// Creates a trace without steps, for chains with these rules and interpretation rules.
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

    /// Returns the location where the axiom was set.
    pub fn axiom(&self) -> Option<&SourcePlace> {
        self.axiom.as_ref()
    }

    /// Returns the number of symbols in the final chain, including brackets and ends.
    pub fn len(&self) -> usize {
        self.chain.symbols.len()
    }

    /// Returns true if the final chain is empty.
    pub fn is_empty(&self) -> bool {
        self.chain.symbols.is_empty()
    }

    /// Returns true if symbol `index` of the final chain is a module.
    pub fn is_module(&self, index: usize) -> bool {
        self.chain.symbols.get(index).is_some_and(|symbol| *symbol > END)
    }

    /// Returns the module at `index` of the final chain; `None` for a bracket and past the end.
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
            symbol: self.symbols.display_name(symbol).to_owned(),
            params: signature
                .parameters
                .iter()
                .zip(params)
                .map(|(name, value)| {
                    (name.clone(), shorten(&self.values.unpack(*value).to_string(), SHOWN).into_owned())
                })
                .collect(),
        })
    }

    /// Returns the interpretation rule of the module at `index` of the final chain.
    pub fn interpretation(&self, index: usize) -> Option<&RuleName> {
        self.interpretations.get(usize::from(*self.interpreted.get(index)?))
    }

    /// Returns the ancestors of the symbol at `index` of the final chain, from the axiom on, one per applied
    /// rule.
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
                    // The query's rows are already in the path; they also name the rule that made the query.
                    path.last_mut().into_iter().for_each(|rows: &mut Ancestor| rows.rule.clone_from(&rule));
                } else if let Some(module) = self.module_of(after, here) {
                    let answer = step.answers.iter().find(|answer| answer.symbol == parent);
                    let answer = answer.map(|answer| RuleName::new(&answer.text, answer.place.as_ref()));
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

    /// Returns the text of the final chain around `index`: up to `radius` symbols before it, the symbol, and
    /// as many after it.
    pub fn around(&self, index: usize, radius: usize) -> [String; 3] {
        around(&self.chain, &self.symbols, &self.values, index, radius)
    }

    /// Returns the rule, interpretation rule or axiom that begins at `line` of `file`, or the last one above,
    /// with its line.
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

    /// Returns the symbols made by the rule, interpretation rule or axiom at a line, or by the last one above
    /// it. `None` if there is none.
    pub fn made_by(&self, file: &str, line: usize) -> Option<RuleProducts<'_>> {
        let (what, line) = self.line(file, line)?;
        let (name, made) = match what {
            LineSubject::Axiom => ("axiom", vec![true; self.chain.symbols.len()]),
            LineSubject::Interpretation(wanted) => {
                let name = self.interpretations[usize::from(wanted)].text.as_str();
                (name, self.interpreted.iter().map(|number| *number == wanted).collect())
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
                (self.rules[usize::from(wanted)].text.as_str(), made)
            }
        };
        Some(RuleProducts { name, line, made })
    }

    /// Returns for each symbol of the final chain if it is a module with this name.
    pub fn named(&self, name: &str) -> Vec<bool> {
        let is_named = |symbol: &Symbol| *symbol > END && self.symbols.display_name(*symbol) == name;
        self.chain.symbols.iter().map(is_named).collect()
    }

    /// Returns the index of the first symbol of each traced chain in the final chain.
    pub fn starts(&self) -> Vec<usize> {
        self.chain.starts(&self.symbols.arities()).iter().map(|mark| mark.module).collect()
    }

    /// Returns the makers of the drawing of each traced chain; `None` if the object does not draw with a
    /// [`Drawing`](burgeon_kit::Drawing).
    pub(crate) fn makers(&self) -> &[Option<Makers>] {
        &self.makers
    }
}

/// Declaration at a line of a script.
enum LineSubject {
    Axiom,
    Rule(u16),
    Interpretation(u16),
}

/// Returns true if the module at `index` of a chain is a query placeholder.
fn stands_for_rows(chain: &Chain, index: usize) -> bool {
    chain.symbols.get(index) == Some(&QUERY)
}

/// Returns the parent of the symbol at `index` after a step, and the index of that parent's first successor.
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

/// Returns the text of `chain` around `index`: up to `radius` symbols before it, the symbol, and as many
/// after it.
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
