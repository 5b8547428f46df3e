//! Random systems in the crate: functions of their rules, and derivation by several threads.

use std::sync::Arc;

use burgeon_base::Stop;
use burgeon_base::error::Result;
use burgeon_rewriting::{
    Applications, CLOSE, Chain, ColumnValue, END, Grammar, Helpers, OPEN, Pattern, Rule, RuleFailure, Rules,
    Scratch, ShowParameters, Signature, StepPlan, StepWork, Stepper, Successors, Symbol, Symbols, cut,
};

use crate::plain::{Application, Part, PlainModule, PlainRule, PlainSettings, PlainValue};
use crate::plain_events::propensity;
use crate::systems::{MODULES, RandomSystem, TEXTS};

/// Texts of a system, by their handles.
struct Texts;

impl ShowParameters for Texts {
    fn show(&self, stored: f64) -> String {
        unpack(stored).text()
    }

    fn find_text(&self, text: &str) -> Option<f64> {
        let place = TEXTS[..2].iter().position(|known| *known == text)?;
        Some(pack(PlainValue::Text(TEXTS[place])))
    }
}

fn pack(value: PlainValue) -> f64 {
    let stored = match value {
        PlainValue::Nil => ColumnValue::Nil,
        PlainValue::Boolean(value) => ColumnValue::Boolean(value),
        PlainValue::Number(value) => ColumnValue::Number(value),
        PlainValue::Text(text) => {
            let place = TEXTS.iter().position(|known| *known == text).expect("a known text");
            ColumnValue::Handle(u32::try_from(place).expect("few texts"))
        }
    };
    stored.pack()
}

fn unpack(stored: f64) -> PlainValue {
    match ColumnValue::unpack(stored) {
        ColumnValue::Nil => PlainValue::Nil,
        ColumnValue::Boolean(value) => PlainValue::Boolean(value),
        ColumnValue::Number(value) => PlainValue::Number(value),
        ColumnValue::Handle(handle) => PlainValue::Text(TEXTS[handle as usize]),
    }
}

/// Functions of the rules of a system.
pub(crate) struct Functions {
    system: RandomSystem,
    symbols: Symbols,
    /// Number of arguments of each rule.
    counts: Vec<usize>,
}

impl Functions {
    /// Returns the number of parameters by symbol.
    pub(crate) fn arities(&self) -> Vec<u8> {
        self.symbols.arities()
    }

    fn arguments(&self, applications: &Applications<'_>, index: usize) -> Vec<PlainValue> {
        let count = self.counts[usize::from(applications.rule)];
        applications.arguments[index * count..][..count].iter().map(|stored| unpack(*stored)).collect()
    }
}

impl Rules for Functions {
    fn apply(&self, applications: &Applications<'_>, successors: &mut Successors) -> Result<(), RuleFailure> {
        successors.clear();
        let rule = &self.system.rules[usize::from(applications.rule)];
        for index in 0..applications.count {
            let arguments = self.arguments(applications, index);
            let key = applications.keys[index];
            let weighted = applications.weighted;
            match rule.successor(&Application { arguments: &arguments, key, weighted }) {
                Some(parts) => {
                    write(&parts, &self.symbols, &mut |symbol, params| successors.push(symbol, params));
                    successors.end();
                }
                None => successors.keep(),
            }
        }
        Ok(())
    }

    fn guard(&self, applications: &Applications<'_>, holds: &mut Vec<u32>) -> Result<(), RuleFailure> {
        let rule = &self.system.rules[usize::from(applications.rule)];
        holds.extend(
            (0..applications.count).map(|index| u32::from(rule.holds(&self.arguments(applications, index)))),
        );
        Ok(())
    }

    fn propensity(
        &self,
        applications: &Applications<'_>,
        propensities: &mut Vec<f64>,
    ) -> Result<(), RuleFailure> {
        let each = (0..applications.count).map(|index| self.arguments(applications, index));
        propensities.extend(each.map(|arguments| propensity(&arguments)));
        Ok(())
    }

    fn parameters(&self) -> &dyn ShowParameters {
        &Texts
    }
}

fn write(parts: &[Part], symbols: &Symbols, push: &mut dyn FnMut(Symbol, &[f64])) {
    for part in parts {
        match part {
            Part::Module(module) => {
                let params: Vec<f64> = module.values.iter().map(|value| pack(*value)).collect();
                push(symbols.find(module.name).expect("a declared module"), &params);
            }
            Part::Branch(inner) => {
                push(OPEN, &[]);
                write(inner, symbols, push);
                push(CLOSE, &[]);
            }
        }
    }
}

/// Returns the parts of a chain.
fn read(chain: &Chain, symbols: &Symbols) -> Vec<Part> {
    let arities = symbols.arities();
    let mut open: Vec<Vec<Part>> = vec![Vec::new()];
    let mut param = 0;
    for (symbol, key) in chain.symbols.iter().zip(&chain.keys) {
        match *symbol {
            OPEN => open.push(Vec::new()),
            CLOSE => {
                let inner = open.pop().expect("an open branch");
                open.last_mut().expect("a chain").push(Part::Branch(inner));
            }
            END => {}
            symbol => {
                let count = usize::from(arities[usize::from(symbol)]);
                let values = chain.params[param..param + count].iter().map(|stored| unpack(*stored));
                let name = MODULES.iter().find(|(name, _)| *name == symbols.display_name(symbol));
                let name = name.expect("a known module").0;
                let module = PlainModule { name, values: values.collect(), key: *key };
                open.last_mut().expect("a chain").push(Part::Module(module));
                param += count;
            }
        }
    }
    assert_eq!(open.len(), 1, "the brackets match");
    open.remove(0)
}

/// Threads that work on the pieces of a step.
struct TestThreads<'a> {
    functions: &'a Arc<Functions>,
    threads: usize,
}

impl Helpers for TestThreads<'_> {
    fn offer(&self, step: &Arc<StepWork>, _: usize) -> Result<()> {
        for _ in 1..self.threads {
            let (step, functions) = (Arc::clone(step), Arc::clone(self.functions));
            std::thread::spawn(move || {
                let mut scratch = Scratch::default();
                while step.work(&*functions, &Stop::new(), &mut scratch) {}
            });
        }
        Ok(())
    }
}

/// A system as the crate has it.
pub(crate) struct Prepared {
    pub functions: Arc<Functions>,
    pub rules: Vec<Rule>,
    pub ignored: Vec<Symbol>,
    /// Axiom; the key of its end is the default.
    pub chain: Chain,
}

impl Prepared {
    pub(crate) fn new(system: &RandomSystem, axiom: &[Part]) -> Self {
        let mut symbols = Symbols::default();
        for (name, count) in MODULES {
            let parameters: Vec<String> = (0..count).map(|index| format!("v{index}")).collect();
            symbols.declare(Signature::new(name, &parameters).expect("a name")).expect("a new name");
        }
        let find = |names: &[&str]| -> Vec<Symbol> {
            names.iter().map(|name| symbols.find(name).expect("a declared module")).collect()
        };
        let rules = system.rules.iter().map(|rule| {
            let (text, _) = rule.pattern.text();
            let pattern = Pattern::parse(&text, &symbols).unwrap_or_else(|error| panic!("{error}: {text}"));
            let declared = Rule::new(pattern, rule.weight, rule.least.is_some(), None).in_region(rule.region);
            match &rule.ignored {
                Some(names) => declared.ignoring(find(names)),
                None if rule.region > 0 => declared.ignoring(find(system.settings.ignored_in(rule.region))),
                None => declared,
            }
        });
        let rules = rules.collect();
        let ignored = find(&system.settings.ignored);
        let mut chain = Chain::default();
        write(axiom, &symbols, &mut |symbol, params| {
            chain.symbols.push(symbol);
            chain.params.extend_from_slice(params);
        });
        chain.symbols.push(END);
        let mut keys = Vec::new();
        gather_keys(axiom, &mut keys);
        let mut keys = keys.into_iter();
        let mut of_symbol = |symbol: &Symbol| if *symbol > END { keys.next() } else { None };
        chain.keys = chain.symbols.iter().map(|symbol| of_symbol(symbol).unwrap_or_default()).collect();
        let counts = system.rules.iter().map(|rule| rule.pattern.text().1).collect();
        let functions = Arc::new(Functions { system: system.clone(), symbols, counts });
        Self { functions, rules, ignored, chain }
    }

    /// Returns the plan of steps by `rules`, with pieces of `batch` symbols.
    pub(crate) fn plan(&self, rules: Vec<Rule>, batch: usize, traced: bool) -> Arc<StepPlan> {
        let symbols = Arc::new(self.functions.symbols.clone());
        let PlainSettings { ring, openers, .. } = &self.functions.system.settings;
        let find = |name| self.functions.symbols.find(name).expect("a declared module");
        let openers: Vec<_> = openers.iter().map(|(name, region)| (find(name), *region)).collect();
        Arc::new(StepPlan {
            grammar: Grammar::new(symbols, rules, &self.ignored, true)
                .with_ring(*ring)
                .with_regions(&openers),
            failed: None,
            chains: 1,
            batch,
            limit: 1_000_000,
            traced,
            notes_places: false,
        })
    }

    /// Returns true if one call can rewrite modules that depend on one another.
    pub(crate) fn rewrites_dependents(&self) -> bool {
        self.plan(self.rules.clone(), 1, false).grammar.dependent_rules().is_some()
    }

    /// Returns the parts of a chain.
    pub(crate) fn read(&self, chain: &Chain) -> Vec<Part> {
        read(chain, &self.functions.symbols)
    }
}

/// Derives a system in the crate, and returns its chain after each step.
pub(crate) fn derive(
    system: &RandomSystem,
    axiom: &[Part],
    steps: usize,
    (threads, batch): (usize, usize),
) -> Vec<Vec<Part>> {
    let prepared = Prepared::new(system, axiom);
    let Prepared { functions, chain, .. } = &prepared;
    let mut chain = chain.clone();
    let arities = functions.symbols.arities();
    let mut stepper = Stepper::new(&prepared.plan(prepared.rules.clone(), batch, true));
    let cut_symbol = functions.symbols.find("Cut").expect("a declared module");
    let mut chains = Vec::new();
    for number in 1..=steps {
        if let Some(made) = cut(&chain, cut_symbol, &arities) {
            chain = made.chain;
        }
        chain.mark(batch, &arities);
        let before = Arc::new(chain);
        let helpers = TestThreads { functions, threads };
        let outcome = stepper.step(&**functions, &helpers, &Stop::new(), &before, number).expect("a step");
        let counted: usize = outcome.applied.iter().map(|(_, count)| *count as usize).sum();
        assert_eq!(outcome.applied.len(), before.symbols.len());
        assert_eq!(counted, outcome.chain.symbols.len(), "each symbol has an origin");
        chain = outcome.chain;
        chains.push(prepared.read(&chain));
        stepper.reuse(before);
    }
    chains
}

fn gather_keys(parts: &[Part], keys: &mut Vec<burgeon_rewriting::ModuleKey>) {
    for part in parts {
        match part {
            Part::Module(module) => keys.push(module.key),
            Part::Branch(inner) => gather_keys(inner, keys),
        }
    }
}
