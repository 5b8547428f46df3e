//! Random systems with patterns of every kind.

use super::plain::{
    Application, Parameter, Part, PlainContext, PlainLeft, PlainModule, PlainPattern, PlainRule,
    PlainSettings, PlainValue, Wanted,
};
use crate::rewriting::ModuleKey;

/// Names of modules with the numbers of their parameters. The last one cuts branches.
pub(crate) const MODULES: [(&str, usize); 5] = [("A", 1), ("B", 2), ("C", 0), ("D", 1), ("Cut", 0)];

/// Texts of parameters. Modules never have the last one.
pub(crate) const TEXTS: [&str; 3] = ["left", "a  b", "nowhere"];

/// Random numbers with a seed.
pub(crate) struct Dice(Box<dyn FnMut() -> f64>);

impl Dice {
    pub(crate) fn new(seed: u64) -> Self {
        let mut stream = ModuleKey::seed(seed).stream();
        Self(Box::new(move || stream.uniform()))
    }

    pub(crate) fn chance(&mut self, share: f64) -> bool {
        (self.0)() < share
    }

    pub(crate) fn below(&mut self, count: usize) -> usize {
        ((self.0)() * count as f64) as usize
    }

    fn pick<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// Returns a value that modules have.
    fn value(&mut self) -> PlainValue {
        match self.below(12) {
            0 => PlainValue::Nil,
            1 => PlainValue::Boolean(true),
            2 => PlainValue::Boolean(false),
            3 => PlainValue::Text(TEXTS[0]),
            4 => PlainValue::Text(TEXTS[1]),
            5 => PlainValue::Number(-1.5),
            _ => PlainValue::Number(self.below(3) as f64),
        }
    }

    fn module(&mut self) -> &'static str {
        self.pick(&["A", "A", "A", "B", "B", "C", "D", "D", "D"])
    }
}

/// Origin of a parameter of a successor.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Origin {
    Value(PlainValue),
    Argument(usize),
    /// Half the sum of the arguments that are numbers.
    Half,
    Random,
}

/// Module of a successor.
#[derive(Debug, Clone)]
pub(crate) struct Template {
    pub name: &'static str,
    pub origins: Vec<Origin>,
    /// Number of brackets around the module.
    pub depth: usize,
}

/// Rule of a random system.
#[derive(Debug, Clone)]
pub(crate) struct SystemRule {
    pub pattern: PlainPattern,
    pub weight: Option<f64>,
    /// Number of the regions in which the rule applies.
    pub region: u16,
    /// Minimum of the sum of the arguments for which the rule applies.
    pub least: Option<f64>,
    /// Sum of the arguments up to which the rule keeps its modules.
    pub keeps: Option<f64>,
    /// Names of modules that its contexts skip, if they are not those of the system.
    pub ignored: Option<Vec<&'static str>>,
    pub successor: Vec<Template>,
}

/// Random system.
#[derive(Debug, Clone)]
pub(crate) struct RandomSystem {
    pub settings: PlainSettings,
    pub axiom: Vec<Part>,
    pub rules: Vec<SystemRule>,
}

/// Returns the sum of the values that are numbers.
pub(crate) fn sum(values: &[PlainValue]) -> f64 {
    let numbers = values.iter().filter_map(|value| match value {
        PlainValue::Number(number) => Some(*number),
        _ => None,
    });
    numbers.fold(0.0, |sum, number| sum + number)
}

impl PlainRule for SystemRule {
    fn pattern(&self) -> &PlainPattern {
        &self.pattern
    }

    fn weight(&self) -> Option<f64> {
        self.weight
    }

    fn region(&self) -> u16 {
        self.region
    }

    fn ignored(&self) -> Option<&[&'static str]> {
        self.ignored.as_deref()
    }

    fn holds(&self, arguments: &[PlainValue]) -> bool {
        self.least.is_none_or(|least| sum(arguments) >= least)
    }

    fn successor(&self, application: &Application<'_>) -> Option<Vec<Part>> {
        let sum = sum(application.arguments);
        if self.keeps.is_some_and(|most| sum <= most) {
            return None;
        }
        let mut stream = application.key.stream();
        if application.weighted {
            stream.uniform();
        }
        let parts = self.successor.iter().map(|template| {
            let values = template.origins.iter().map(|origin| match origin {
                Origin::Value(value) => *value,
                Origin::Argument(index) => application.arguments[*index],
                Origin::Half => PlainValue::Number(sum / 2.0),
                Origin::Random => PlainValue::Number(stream.uniform()),
            });
            let module =
                PlainModule { name: template.name, values: values.collect(), key: ModuleKey::default() };
            (0..template.depth).fold(Part::Module(module), |part, _| Part::Branch(vec![part]))
        });
        Some(parts.collect())
    }
}

impl RandomSystem {
    pub(crate) fn new(dice: &mut Dice) -> Self {
        let ignored = match dice.below(4) {
            0 => vec!["D"],
            1 => vec!["C"],
            _ => Vec::new(),
        };
        let size = 1 + dice.below(24);
        let axiom = parts(dice, size, 0);
        let ring = dice.chance(0.25);
        // Rules that see the new chain go in one direction, and rewrite single modules.
        let kind = dice.pick(&[RuleKind::Runs, RuleKind::Runs, RuleKind::NewLeft, RuleKind::NewRight]);
        let rules = (0..1 + dice.below(6)).map(|_| rule(dice, kind)).collect();
        Self { settings: PlainSettings { ignored, ring, ..PlainSettings::default() }, axiom, rules }
    }

    /// Returns a system with one to three other systems, whose rules apply in regions of the chain.
    pub(crate) fn with_regions(dice: &mut Dice) -> Self {
        let mut system = Self::new(dice);
        let others = 1 + dice.below(3);
        for region in 1..=others {
            let more = Self::new_like(dice, &system);
            let with_region = |rule| SystemRule { region: region as u16, ..rule };
            system.rules.extend(more.into_iter().map(with_region));
            system.settings.ignored_in.push(dice.pick(&[&["D"][..], &["A", "C"], &[], &[]]).to_vec());
            let opener = dice.pick(&["A", "B", "C", "C", "D", "Cut"]);
            if system.settings.openers.iter().all(|(name, _)| *name != opener) {
                system.settings.openers.push((opener, dice.below(others + 1) as u16));
            }
        }
        system
    }

    /// Returns rules that can be applied in the same step as those of `system`, with their own ignored modules.
    fn new_like(dice: &mut Dice, system: &Self) -> Vec<SystemRule> {
        let has_new = |of: fn(&PlainPattern) -> bool| system.rules.iter().any(|rule| of(&rule.pattern));
        let kind = match () {
            () if has_new(|pattern| {
                !pattern.new_left.modules.is_empty() || pattern.new_left.from_beginning
            }) =>
            {
                RuleKind::NewLeft
            }
            () if has_new(|pattern| !pattern.new_right.is_empty()) => RuleKind::NewRight,
            () => RuleKind::Runs,
        };
        (0..1 + dice.below(4)).map(|_| rule(dice, kind)).collect()
    }

    /// Returns a system whose rules have single modules as contexts in the new chain, or none, so that one call can rewrite
    /// modules that depend on one another.
    pub(crate) fn of_dependents(dice: &mut Dice) -> Self {
        let mut system = Self::new(dice);
        let size = 10 + dice.below(40);
        system.axiom = parts(dice, size, 0);
        let is_left = dice.chance(0.5);
        let kind = if is_left { RuleKind::NewLeft } else { RuleKind::NewRight };
        system.rules = (0..1 + dice.below(5)).map(|_| rule(dice, kind)).collect();
        let has_own = dice.chance(0.3);
        for rule in &mut system.rules {
            let mut item = wanted(dice, false, false);
            for parameter in item.parameters.iter_mut().flatten() {
                *parameter = Parameter::Formal;
            }
            let has_new = dice.chance(0.8);
            let [left, right] = [has_new && is_left, has_new && !is_left];
            let modules = if left { vec![item.clone()] } else { Vec::new() };
            rule.pattern.new_left = PlainLeft { from_beginning: false, modules };
            rule.pattern.new_right = if right { vec![PlainContext::Module(item)] } else { Vec::new() };
            rule.weight = None;
            if has_new && !has_own {
                rule.ignored = None;
            } else if has_new {
                rule.ignored = Some(vec!["C", "A"]);
            }
            let (_, arguments) = rule.pattern.text();
            let count = dice.below(4);
            rule.successor = (0..count).map(|_| template(dice, arguments)).collect();
        }
        system
    }
}

impl RandomSystem {
    /// Returns a system whose rules are single events. The contexts of some systems reach only modules on the path.
    pub(crate) fn of_events(dice: &mut Dice) -> Self {
        let mut system = Self::new(dice);
        let is_near = dice.chance(0.6);
        system.settings.ring &= !is_near;
        let size = 20 + dice.below(60);
        system.axiom = parts(dice, size, 0);
        for rule in &mut system.rules {
            rule.weight = None;
            (rule.pattern.new_left, rule.pattern.new_right) = (PlainLeft::default(), Vec::new());
            if is_near {
                rule.pattern.predecessors.truncate(1);
                rule.pattern.right.retain(|context| matches!(context, PlainContext::Module(_)));
            }
            let (_, arguments) = rule.pattern.text();
            let count = dice.below(4);
            rule.successor = (0..count).map(|_| template(dice, arguments)).collect();
        }
        system
    }
}

fn parts(dice: &mut Dice, size: usize, depth: usize) -> Vec<Part> {
    let part = |dice: &mut Dice| {
        if depth < 4 && dice.chance(0.25) {
            let size = dice.below(6);
            return Part::Branch(parts(dice, size, depth + 1));
        }
        let name = if dice.chance(0.03) { "Cut" } else { dice.module() };
        let values = (0..arity(name)).map(|_| dice.value()).collect();
        Part::Module(PlainModule { name, values, key: ModuleKey::default() })
    };
    (0..size).map(|_| part(dice)).collect()
}

fn arity(name: &str) -> usize {
    MODULES.iter().find(|(known, _)| *known == name).map_or(0, |(_, arity)| *arity)
}

fn wanted(dice: &mut Dice, is_first: bool, in_run: bool) -> Wanted {
    if !is_first && dice.chance(0.15) {
        return Wanted { names: Vec::new(), parameters: None };
    }
    let mut names = vec![dice.module()];
    if !is_first && dice.chance(0.15) {
        let other = if dice.chance(0.5) { "A" } else { "D" };
        names = match dice.chance(0.5) {
            true => vec![other, if other == "A" { "D" } else { "A" }],
            false => vec![names[0], other],
        };
        names.dedup();
    }
    let count = arity(names[0]);
    let may_have = count > 0 && names.iter().all(|name| arity(name) == count);
    let share = if in_run { 0.8 } else { 0.6 };
    let parameters = (may_have && dice.chance(share)).then(|| {
        let parameter = |dice: &mut Dice| match dice.chance(0.3) {
            true if dice.chance(0.05) => Parameter::Value(PlainValue::Text(TEXTS[2])),
            true => Parameter::Value(dice.value()),
            false => Parameter::Formal,
        };
        (0..count).map(|_| parameter(dice)).collect()
    });
    Wanted { names, parameters }
}

fn right(dice: &mut Dice, depth: usize) -> Vec<PlainContext> {
    let mut contexts = Vec::new();
    for _ in 0..dice.below(3) {
        contexts.push(match depth < 2 && dice.chance(0.35) {
            true => {
                let inner = right(dice, depth + 1);
                match inner.is_empty() {
                    true => PlainContext::Branch(vec![PlainContext::Module(wanted(dice, false, false))]),
                    false => PlainContext::Branch(inner),
                }
            }
            false => PlainContext::Module(wanted(dice, false, false)),
        });
    }
    if dice.chance(0.15) {
        contexts.push(PlainContext::End);
    }
    contexts
}

/// Kind of rules that a system has.
#[derive(Debug, Clone, Copy, PartialEq)]
enum RuleKind {
    Runs,
    NewLeft,
    NewRight,
}

fn left(dice: &mut Dice, share: f64) -> PlainLeft {
    let has_left = dice.chance(share);
    let modules = match has_left {
        true => (0..dice.below(3)).map(|_| wanted(dice, false, false)).collect(),
        false => Vec::new(),
    };
    PlainLeft { from_beginning: has_left && dice.chance(0.3), modules }
}

fn rule(dice: &mut Dice, kind: RuleKind) -> SystemRule {
    let new_left = left(dice, if kind == RuleKind::NewLeft { 0.6 } else { 0.0 });
    let left = left(dice, 0.35);
    let length = if kind == RuleKind::Runs { dice.pick(&[1, 1, 1, 2, 2, 3]) } else { 1 };
    let predecessors = (0..length).map(|place| wanted(dice, place == 0, true)).collect();
    let mut following = |share: f64| if dice.chance(share) { right(dice, 0) } else { Vec::new() };
    let (right, new_right) = (following(0.35), following(if kind == RuleKind::NewRight { 0.6 } else { 0.0 }));
    let pattern = PlainPattern { new_left, left, predecessors, right, new_right };
    let (_, arguments) = pattern.text();
    let successor = (0..dice.below(4)).map(|_| template(dice, arguments)).collect();
    SystemRule {
        pattern,
        region: 0,
        weight: dice.chance(0.4).then(|| dice.pick(&[0.0, 0.5, 1.0, 3.0])),
        least: dice.chance(0.35).then(|| dice.below(4) as f64 - 1.0),
        keeps: dice.chance(0.25).then(|| dice.below(3) as f64),
        ignored: match dice.below(8) {
            0 => Some(Vec::new()),
            1 => Some(vec!["A"]),
            2 => Some(vec!["B", "D"]),
            _ => None,
        },
        successor,
    }
}

fn template(dice: &mut Dice, arguments: usize) -> Template {
    let name = if dice.chance(0.05) { "Cut" } else { dice.module() };
    let origins = (0..arity(name)).map(|_| match dice.below(8) {
        0 => Origin::Random,
        1 | 2 => Origin::Half,
        3..=5 if arguments > 0 => Origin::Argument(dice.below(arguments)),
        _ => Origin::Value(dice.value()),
    });
    let origins = origins.collect();
    Template { name, origins, depth: dice.pick(&[0, 0, 0, 1, 2]) }
}
