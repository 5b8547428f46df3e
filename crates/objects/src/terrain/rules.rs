//! The rules of a terrain in scripts: rule tables, systems, and lists of them by level.

use std::sync::Arc;

use burgeon_base::error::{did_you_mean, nearest};
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::{Expectation, Parameter, System, Table, TableKey, Value};
use burgeon_terrain::{CellSymbol, DivisionRules, LevelRules, NumberRange, Quadrants, RuleTable};

/// The rules of a terrain, by level; the first layer starts at level 0.
#[derive(Debug, Clone, Default)]
pub struct RuleLayers(pub Vec<RuleLayer>);

/// The rules from a level on, as a script specifies them.
#[derive(Debug, Clone)]
pub struct RuleLayer {
    /// Level of the first cells that the rules divide.
    pub from: u32,
    /// Rules that divide the cells.
    pub rules: LayerRules,
    /// Initial symbol, if given.
    pub start: Option<String>,
    /// Height (m) added to the cells.
    pub height: f64,
    /// Decay (m), if given.
    pub decay: Option<f64>,
}

/// The rules that divide cells.
#[derive(Debug, Clone)]
pub enum LayerRules {
    /// Rule table.
    Table(Arc<RuleTable>),
    /// System of the script.
    System(Arc<System>),
}

const WHAT: &str = "a table of rules, such as { A = { \"A\", \"B\", \"B\", \"A\", change = { 1, -1, 0, 0.5 }, decay = 0.5 }, ... }, \
                    a system whose rules divide cells, or a list of { from = level, rules = ... }";

impl Parameter for RuleLayers {
    fn luau() -> String {
        "any".into()
    }

    fn from_value(value: Value) -> Result<Self, Expectation> {
        let list = match &value {
            Value::Table(table) if !table.list().is_empty() => table.list(),
            _ => {
                let rules = LayerRules::from_value(value)?;
                return Ok(Self(vec![RuleLayer { from: 0, rules, start: None, height: 0.0, decay: None }]));
            }
        };
        let layers = list.into_iter().map(layer).collect::<Result<Vec<_>, _>>()?;
        if layers[0].from != 0 || layers.windows(2).any(|pair| pair[0].from >= pair[1].from) {
            return Err(Expectation::new(
                "a list of rules that starts at level 0, in ascending order of levels",
            ));
        }
        Ok(Self(layers))
    }

    fn into_value(self) -> Value {
        Value::Table(Arc::new(Table::default()))
    }
}

fn layer(value: &Value) -> Result<RuleLayer, Expectation> {
    let Value::Table(table) = value else { return Err(Expectation::new(WHAT)) };
    let known = ["from", "rules", "start", "height", "decay"];
    for (key, _) in &table.entries {
        if !matches!(key, TableKey::Name(name) if known.contains(&&**name)) {
            return Err(Expectation::new("a list of tables with from, rules, start, height and decay"));
        }
    }
    let number = |name: &str| match table.get(name) {
        None => Ok(None),
        Some(value) => f64::read_value(value)
            .map(Some)
            .map_err(|_| Expectation::new(format!("a list with a number for each {name}"))),
    };
    let from = table.get("from").map_or(Ok(0), u32::read_value);
    let start = table.get("start").map(String::read_value).transpose();
    Ok(RuleLayer {
        from: from
            .map_err(|_| Expectation::new("a list with a level, an integer of at least 0, for each from"))?,
        rules: LayerRules::from_value(table.get("rules").cloned().unwrap_or(Value::Nil))?,
        start: start.map_err(|_| Expectation::new("a list with the name of a symbol for each start"))?,
        height: number("height")?.unwrap_or(0.0),
        decay: number("decay")?,
    })
}

impl LayerRules {
    fn from_value(value: Value) -> Result<Self, Expectation> {
        match value {
            Value::Object(object) => {
                let any: Arc<dyn std::any::Any + Send + Sync> = object;
                any.downcast().map(Self::System).map_err(|_| Expectation::new(WHAT))
            }
            Value::Table(table) => Ok(Self::Table(Arc::new(rule_table(&table)?))),
            _ => Err(Expectation::new(WHAT)),
        }
    }
}

/// Reads a rule table.
fn rule_table(table: &Table) -> Result<RuleTable, Expectation> {
    let mut names = Vec::new();
    for (key, _) in &table.entries {
        let TableKey::Name(name) = key else { return Err(Expectation::new(WHAT)) };
        names.push(name.to_string());
    }
    if names.is_empty() || names.len() > usize::from(CellSymbol::MAX) {
        return Err(Expectation::new(WHAT));
    }
    let mut rules = Vec::new();
    for ((_, value), name) in table.entries.iter().zip(&names) {
        let Value::Table(rule) = value else {
            return Err(Expectation::new(format!(
                "a table whose rule for {name} is a table of four symbols"
            )));
        };
        // A list of tables is a choice of rules.
        let choice = rule.list();
        let alternatives: Vec<&Table> = match choice.first() {
            Some(Value::Table(_)) => choice
                .iter()
                .filter_map(|item| match item {
                    Value::Table(table) => Some(&**table),
                    _ => None,
                })
                .collect(),
            _ => vec![&**rule],
        };
        rules.push(
            alternatives.into_iter().map(|rule| quadrants(rule, name, &names)).collect::<Result<_, _>>()?,
        );
    }
    Ok(RuleTable { names, rules })
}

/// Reads one rule of the symbol `name`.
fn quadrants(rule: &Table, name: &str, names: &[String]) -> Result<Quadrants, Expectation> {
    let list = rule.list();
    let count = list.len();
    let four: [&Value; 4] = list.try_into().map_err(|_| {
        Expectation::new(format!(
            "a table whose rule for {name} has four symbols, one for each quadrant; it has {count}"
        ))
    })?;
    let mut symbols = [0; 4];
    for (into, value) in symbols.iter_mut().zip(four) {
        let Value::Text(text) = value else {
            return Err(Expectation::new(format!(
                "a table whose rule for {name} has names of symbols, not {value}"
            )));
        };
        let found =
            names.iter().position(|known| *known == **text).and_then(|at| CellSymbol::try_from(at).ok());
        *into = found.ok_or_else(|| {
            let near = nearest(text, names.iter().map(String::as_str));
            let near = near.map(|near| format!(" ({})", did_you_mean(near))).unwrap_or_default();
            Expectation::new(format!(
                "a table with a rule for each symbol: the rule for {name} has the unknown symbol {text}{near}"
            ))
        })?;
    }
    for (key, _) in &rule.entries {
        if let TableKey::Name(field) = key
            && !["change", "decay", "weight"].contains(&&**field)
        {
            return Err(Expectation::new(format!(
                "a table whose rules have change, decay and weight; the rule for {name} has {field}"
            )));
        }
    }
    let draws = |field: &str, default: f64| -> Result<[NumberRange; 4], Expectation> {
        let wrong = || {
            Expectation::new(format!(
                "a table whose rule for {name} has {field} as a number, or a number or a range {{ min, max }} for each quadrant"
            ))
        };
        match rule.get(field) {
            None => Ok([NumberRange::exactly(default); 4]),
            Some(Value::Number(number)) if number.is_finite() => Ok([NumberRange::exactly(*number); 4]),
            Some(Value::Table(table)) => {
                let draws =
                    table.list().into_iter().map(draw).collect::<Option<Vec<_>>>().ok_or_else(wrong)?;
                draws.try_into().map_err(|_| wrong())
            }
            Some(_) => Err(wrong()),
        }
    };
    let weight = rule.get("weight").map_or(Ok(1.0), f64::read_value);
    let weight = weight.ok().filter(|weight| *weight > 0.0);
    Ok(Quadrants {
        weight: weight.ok_or_else(|| {
            Expectation::new(format!("a table whose rules for {name} have weights above 0"))
        })?,
        symbols,
        change: draws("change", 0.0)?,
        decay: draws("decay", 0.5)?,
    })
}

/// Reads a finite number, or a range of numbers.
fn draw(value: &Value) -> Option<NumberRange> {
    match value {
        Value::Number(number) => number.is_finite().then(|| NumberRange::exactly(*number)),
        Value::Table(_) => match Vec::<f64>::read_value(value).ok()?.as_slice() {
            [low, high] if low <= high => Some(NumberRange { low: *low, high: *high }),
            _ => None,
        },
        _ => None,
    }
}

/// The rules of a world.
pub(crate) struct WorldRules {
    pub layers: Vec<LevelRules>,
    /// Set if the rules use random numbers.
    pub drawn: bool,
}

impl RuleLayers {
    /// Builds the rules of the world of an object of type `kind`, with the initial symbol `start`, the height `height`
    /// (m) and the decay `decay` (m). Moves all rules down by `finer` levels.
    pub(crate) fn build(
        &self,
        kind: &str,
        start: Option<&String>,
        (height, mut decay): (f64, f64),
        finer: u32,
    ) -> Result<WorldRules, burgeon_base::error::Error> {
        let mut given = self.0.clone();
        if let Some(first) = given.first_mut() {
            first.start = first.start.take().or_else(|| start.cloned());
            first.height += height;
        }
        let mut built = WorldRules { layers: Vec::new(), drawn: false };
        for mut layer in given {
            decay = layer.decay.unwrap_or(decay);
            layer.from += finer;
            built.layers.push(layer.build(kind, decay)?);
            built.drawn |= match &layer.rules {
                LayerRules::Table(table) => table.is_random(),
                LayerRules::System(_) => true,
            };
        }
        Ok(built)
    }

    /// Returns the warnings about decays that do not converge.
    pub(crate) fn warnings(&self, kind: &str) -> Vec<Warning> {
        let grown = self.0.iter().find_map(RuleLayer::grows);
        let warning = |decay| {
            let text = format!("{kind}: a decay of {decay} does not converge: heights grow with every level");
            Warning::new(WarningKind::Doubtful, text).help("use a decay below 1, such as decay = 0.5")
        };
        grown.map(warning).into_iter().collect()
    }
}

/// Creates the error for an object of type `kind` without rules.
pub(crate) fn none(kind: &str) -> burgeon_base::error::Error {
    burgeon_base::error::Error::argument(format!("{kind}: missing rules")).help(
        "write rules = { A = { \"A\", \"A\", \"A\", \"A\", change = { 1, -1, 0.5, -0.5 }, decay = 0.5 } }",
    )
}

impl RuleLayer {
    /// Builds the rules of a layer. Cells get the decay `decay` (m) unless the layer specifies its own.
    fn build(&self, kind: &str, decay: f64) -> Result<LevelRules, burgeon_base::error::Error> {
        let rest = vec![self.decay.unwrap_or(decay)];
        let (rules, start, rest) = match &self.rules {
            LayerRules::Table(table) => {
                let start = match &self.start {
                    None => 0,
                    Some(start) => table.names.iter().position(|name| name == start).ok_or_else(|| {
                        let message = format!("{kind}: no rule for the start symbol {start}");
                        let names = table.names.iter().map(String::as_str);
                        burgeon_base::error::Error::not_found("rule", start, names, message)
                            .help(format!("use {}", table.names.join(", ")))
                    })?,
                };
                (DivisionRules::Table(Arc::clone(table)), start, rest)
            }
            LayerRules::System(system) => (DivisionRules::System(system.index), 0, Vec::new()),
        };
        let start = CellSymbol::try_from(start).unwrap_or(0);
        let names = match &self.rules {
            LayerRules::Table(table) => Arc::new(table.names.clone()),
            LayerRules::System(_) => Arc::default(),
        };
        Ok(LevelRules { from: self.from, rules, start, height: self.height, rest, names })
    }

    /// Returns the maximum decay factor, if it is 1 or more.
    fn grows(&self) -> Option<f64> {
        match &self.rules {
            LayerRules::Table(table) => Some(table.greatest_decay()).filter(|decay| *decay >= 1.0),
            LayerRules::System(_) => None,
        }
    }
}
