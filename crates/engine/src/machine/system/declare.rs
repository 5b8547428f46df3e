//! Declarations of `axiom`, `rule` and `interpret`, with their checks.

use std::sync::Arc;

use mlua::{Function, Lua, Table, Value as LuaValue};

use crate::declare::Session;
use crate::machine::Machine;
use crate::machine::convert::{to_value, type_of};
use crate::machine::library::Library;
use crate::machine::types::DerivedHandle;
use burgeon_base::error::{Error, Limit, Result, SourcePlace};
use burgeon_base::text::grouped;
use burgeon_base::warning::{Warning, WarningKind};
use burgeon_kit::Value;
use burgeon_language::RULE;
use burgeon_language::analysis::QueryCall;
use burgeon_rewriting::{MOST_PROPENSITY, MOST_RULES, Pattern, Propensity, Rule, Symbols};

use super::ignored::{IgnoredModules, named_in_option};
use super::strings::{compile_successor, parse_pattern, string_axiom};
use super::{
    DeclaredAxiom, DeclaredInterpretation, DeclaredRule, ReceiverUse, RulePhase, SourceHandle,
    SystemDeclaration, is_unconditional,
};

impl SystemDeclaration {
    pub(super) fn set_axiom(
        &mut self,
        library: &Library,
        lua: &Lua,
        mut arguments: Vec<LuaValue>,
    ) -> Result<()> {
        let is_source =
            matches!(arguments.first(), Some(LuaValue::UserData(data)) if data.is::<SourceHandle>());
        if is_source {
            let (Some(LuaValue::Function(function)), 1) = (arguments.pop(), arguments.len()) else {
                return Err(Error::argument(
                    "axiom(source, function) needs a function that returns each feature's chain",
                ));
            };
            self.axiom = Some(DeclaredAxiom::Source(arguments.swap_remove(0), function));
        } else if let [LuaValue::UserData(data), rest @ ..] = arguments.as_slice()
            && let Ok(derived) = data.borrow::<DerivedHandle>()
        {
            if !rest.is_empty() {
                return Err(Error::argument("an axiom of a derived system takes nothing else")
                    .help("write system:axiom(derived), and add modules with a rule"));
            }
            self.axiom = Some(DeclaredAxiom::Derived(Arc::clone(&derived.0)));
        } else if let [LuaValue::String(text)] = arguments.as_slice() {
            let modules = string_axiom(library, lua, &text.to_string_lossy())?;
            self.axiom = Some(DeclaredAxiom::Modules(modules));
        } else {
            if let [LuaValue::Table(only)] = arguments.as_slice()
                && is_branch(library, only)?
            {
                let text = "a table is one branch, so this axiom is a single branch";
                let help = "write the modules of a list as system:axiom(sequence(list))";
                library.machine()?.warn(Warning::new(WarningKind::ReturnedList, text).help(help));
            }
            self.axiom = Some(DeclaredAxiom::Modules(arguments));
        }
        Ok(())
    }

    pub(super) fn add_rule(
        &mut self,
        library: &Library,
        lua: &Lua,
        phase: RulePhase,
        mut arguments: Vec<LuaValue>,
    ) -> Result<()> {
        let method = phase.method();
        let usage = format!("write system:{method}(\"A(x)\", function(this, x) return ... end)");
        let Some(LuaValue::String(text)) = arguments.first() else {
            return Err(Error::argument("the first argument of a rule must be a pattern").help(usage));
        };
        let text = text.to_string_lossy();
        if let ([_], Some((pattern, successor))) = (&*arguments, split_rule(&text)) {
            return Err(Error::argument(format!(
                "{method} takes the pattern and the successor, not one string"
            ))
            .help(format!("write system:{method}({pattern:?}, {successor:?})")));
        }
        if self.rules.len() == MOST_RULES {
            return Err(Error::limit(
                Limit::Size,
                format!("a system can have at most {} rules", grouped(MOST_RULES)),
            )
            .help("join rules into one, and distinguish the cases by a parameter"));
        }
        let scope = library.scope_at(lua);
        let pattern = parse_pattern(&text, &library.symbols.borrow(), &scope)?;
        let name = pattern.text.clone();
        let named = |error: Error| error.rule(&name);
        let options = match (arguments.len(), arguments.get(1)) {
            (3, Some(LuaValue::Table(options))) => Some(options.clone()),
            (3, _) => {
                return Err(named(
                    Error::argument("the options of a rule must be a table").help("write { weight = 2 }"),
                ));
            }
            (2, _) => None,
            (count, _) => {
                return Err(named(
                    Error::argument(format!("{method} takes 2 or 3 arguments, not {count}")).help(usage),
                ));
            }
        };
        let RuleOptions { weight, guard, propensity, group, ignored } = match options {
            Some(options) => rule_options(library, lua, &options).map_err(named)?,
            None => RuleOptions::default(),
        };
        if phase == RulePhase::Decomposition && propensity.is_some() {
            let error =
                Error::argument("a decomposition has no propensity, because it applies in every step");
            return Err(named(error.help("declare the rule with system:rule")));
        }
        if weight.is_some() && propensity.is_some() {
            let error = Error::argument("a rule has a weight or a propensity, not both");
            return Err(named(error.help("multiply the propensity by the weight")));
        }
        let has_new_contexts = pattern.has_new_left() || pattern.has_new_right();
        if has_new_contexts && phase == RulePhase::Decomposition {
            let error = Error::script("a decomposition has no contexts in the new chain");
            return Err(named(
                error.help("write < and > instead of << and >>, or declare it with system:rule"),
            ));
        }
        let place = Machine::place(lua);
        let machine = library.machine()?;
        let session = &machine.session;
        let mut divides = false;
        let (successor, mut receiver_use, successor_reads) = match arguments.pop() {
            Some(LuaValue::Function(function)) => {
                check_parameters(&function, &pattern, "the successor").map_err(named)?;
                check_queries(library, &function, &pattern).map_err(named)?;
                let receiver_use = receiver_use_of(session, &function);
                if let Some((file, line)) = begin_of(&function)
                    && let Some(line) = session.returns_filled(&file, line)
                {
                    machine.warn(returns_branch().at(Some(SourcePlace { file, line })).rule(&name));
                }
                let reads = parameters_read(session, &function);
                divides = begin_of(&function).is_some_and(|(file, line)| session.only_divides(&file, line));
                (function, receiver_use, reads)
            }
            Some(LuaValue::String(body)) => {
                compile_successor(library, &scope, &pattern, &body.to_string_lossy(), place.as_ref())
                    .map_err(named)?
            }
            other => {
                let what = other.map_or("nothing", |value| type_of(&value));
                return Err(named(
                    Error::argument(format!("the successor must be a function or a string, not {what}"))
                        .help(usage),
                ));
            }
        };
        if let Some(guard) = &guard {
            check_parameters(guard, &pattern, "the guard").map_err(named)?;
            check_queries(library, guard, &pattern).map_err(named)?;
            receiver_use = receiver_use.max(receiver_use_of(session, guard));
        }
        let (propensity, rate_function) = match propensity {
            Some(DeclaredPropensity::Function(function)) => {
                check_parameters(&function, &pattern, "the propensity").map_err(named)?;
                check_queries(library, &function, &pattern).map_err(named)?;
                receiver_use = receiver_use.max(receiver_use_of(session, &function));
                (Some(Propensity::Computed), Some(function))
            }
            Some(DeclaredPropensity::Number(number)) => (Some(Propensity::Constant(number)), None),
            None => (None, None),
        };
        let guard_reads = guard.as_ref().and_then(|guard| parameters_read(session, guard));
        let reads = [successor_reads, guard_reads];
        let begin = guard.as_ref().and_then(begin_of);
        let guard_text = begin.and_then(|(file, line)| session.guard_text(&file, line));
        let mut rule = Rule::new(pattern, weight, guard.is_some(), place);
        if let Some(propensity) = propensity {
            rule = rule.with_propensity(propensity);
        }
        let propensity = rate_function;
        self.rules.push(DeclaredRule {
            rule,
            phase,
            group,
            guard,
            propensity,
            ignored,
            guard_text,
            successor,
            receiver_use,
            divides,
            reads,
        });
        Ok(())
    }

    pub(super) fn add_interpretation(
        &mut self,
        library: &Library,
        lua: &Lua,
        mut arguments: Vec<LuaValue>,
    ) -> Result<()> {
        let usage = "write system:interpret(\"A(x)\", function(this, x) ... end)";
        let Some(LuaValue::String(text)) = arguments.first() else {
            return Err(
                Error::argument("the first argument of an interpretation must be a pattern").help(usage)
            );
        };
        let symbols = library.symbols.borrow();
        let pattern = parse_pattern(&text.to_string_lossy(), &symbols, &library.scope_at(lua))?;
        drop(symbols);
        let name = pattern.text.clone();
        let named = |error: Error| error.rule(&name);
        if pattern.has_run() {
            let error = Error::script("an interpretation is of one module, but the pattern has several");
            return Err(named(
                error.help("interpret each module, and write the others as contexts: A < B > C"),
            ));
        }
        if pattern.has_new_left() || pattern.has_new_right() {
            let error = Error::script("an interpretation has no contexts in the new chain");
            return Err(named(error.help("write < and > instead of << and >>: a pass changes no modules")));
        }
        let RuleOptions { weight, guard, propensity, group, ignored } =
            match (arguments.len(), arguments.get(1)) {
                (3, Some(LuaValue::Table(options))) => rule_options(library, lua, options).map_err(named)?,
                (3, _) => {
                    let error = Error::argument("the options of an interpretation must be a table");
                    return Err(named(error.help("write { weight = 2 }")));
                }
                (1 | 2, _) => RuleOptions::default(),
                (count, _) => {
                    let error = Error::argument(format!("interpret takes 2 or 3 arguments, not {count}"));
                    return Err(named(error.help(usage)));
                }
            };
        if propensity.is_some() {
            return Err(named(Error::argument(
                "an interpretation has no propensity, because it rewrites nothing",
            ))
            .help("give the propensity to rules; interpretations can have weights"));
        }
        if group.is_some() {
            return Err(named(Error::argument("an interpretation has no group"))
                .help("groups are for rules; use a guard that reads a variable"));
        }
        let (1.., Some(LuaValue::Function(function))) = (arguments.len() - 1, arguments.pop()) else {
            return Err(named(Error::argument("an interpretation needs a function").help(usage)));
        };
        for (function, what) in std::iter::once((&function, "the interpretation"))
            .chain(guard.as_ref().map(|guard| (guard, "the guard")))
        {
            check_parameters(function, &pattern, what).map_err(named)?;
            check_queries(library, function, &pattern).map_err(named)?;
        }
        let rule = Rule::new(pattern, weight, guard.is_some(), Machine::place(lua));
        let symbol = rule.pattern.symbol;
        let earlier = self.interpretations.iter().map(|known| &known.rule);
        let mut earlier = earlier.filter(|known| known.pattern.symbol == symbol);
        if let Some(known) = earlier.find(|known| is_unconditional(known)) {
            let line = known.place.as_ref().map_or(String::new(), |place| format!(" in line {}", place.line));
            return Err(named(Error::script(format!("{name} is already interpreted{line}"))).help(
                "join the two functions, or declare an interpretation with contexts, a guard or a weight first",
            ));
        }
        if self.interpretations.len() >= MOST_RULES / 2 {
            let limit = grouped(MOST_RULES / 2);
            return Err(Error::limit(Limit::Size, format!("a system has at most {limit} interpretations"))
                .help("use parameters of modules instead of many interpretations"));
        }
        self.interpretations.push(DeclaredInterpretation { rule, guard, ignored, function });
        Ok(())
    }
}

/// Returns true if a table is a branch, not a module or a sequence.
fn is_branch(library: &Library, table: &Table) -> Result<bool> {
    let machine = library.machine()?;
    let prelude = machine.prelude();
    let elements = prelude.elements.call::<Option<Table>>(table);
    if elements.map_err(|error| machine.translate(error))?.is_some() {
        return Ok(false);
    }
    Ok(!prelude.is_module.call::<bool>(table).map_err(|error| machine.translate(error))?)
}

/// Splits a rule as books print it, `F -> FF` or `F = FF`.
fn split_rule(text: &str) -> Option<(&str, &str)> {
    let arrow = ["-->", "->", "\u{2192}", "=>", ":=", "="].into_iter().find(|arrow| text.contains(arrow))?;
    let (pattern, successor) = text.split_once(arrow)?;
    Some((pattern.trim(), successor.trim())).filter(|(pattern, _)| !pattern.is_empty())
}

/// Returns the warning for a rule that returns a table that it has filled, instead of the modules in it.
fn returns_branch() -> Warning {
    Warning::new(WarningKind::ReturnedList, "a table is one branch, so this rule returns a single branch")
        .help("return the modules of a list: return sequence(list); for a branch, write return { sequence(list) }")
}

/// Returns the warning for a phase that stops at its maximum depth, although its rule goes on as `rest` says.
pub(crate) fn stops_at_depth(phase: &str, max_depth: usize, rest: &str) -> Warning {
    let text = format!("{phase} stopped at the maximum depth {max_depth}, but the rule {rest}");
    Warning::new(WarningKind::Depth, text)
        .help("end it with a guard or a counter, or raise the limit: lsystem({ max_depth = 1000 })")
}

/// Returns the warning for an interpretation that returns a `value`, given as text, other than a module.
pub(crate) fn returns_value(value: &str) -> Warning {
    let text = format!("{value} returned by an interpretation is ignored");
    Warning::new(WarningKind::NoEffect, text).help("an interpretation returns modules or nothing")
}

/// Returns the file and the first line of a script function.
fn begin_of(function: &Function) -> Option<(String, usize)> {
    let info = function.info();
    Some((info.source?.strip_prefix('@')?.to_owned(), info.line_defined?))
}

/// Returns the use that a function may make of its first parameter, `this`.
fn receiver_use_of(session: &Session, function: &Function) -> ReceiverUse {
    let info = function.info();
    if info.num_params == 0 && !info.is_vararg {
        return ReceiverUse::Unused;
    }
    match begin_of(function) {
        Some((file, line)) if session.is_blind(&file, line) => ReceiverUse::Unused,
        Some((file, line)) if session.asks_place(&file, line) => ReceiverUse::Place,
        _ => ReceiverUse::Any,
    }
}

/// Returns the numbers of the parameters, after `this`, that a function reads; `None` if it may read all.
fn parameters_read(session: &Session, function: &Function) -> Option<Vec<usize>> {
    let (file, line) = begin_of(function)?;
    session.parameters_read(&file, line)
}

/// Options of a rule.
#[derive(Default)]
struct RuleOptions {
    weight: Option<f64>,
    guard: Option<Function>,
    propensity: Option<DeclaredPropensity>,
    group: Option<Arc<str>>,
    ignored: Option<IgnoredModules>,
}

/// Rate of a rule, as a script gives it.
enum DeclaredPropensity {
    Number(f64),
    Function(Function),
}

fn rule_options(library: &Library, lua: &Lua, options: &Table) -> Result<RuleOptions> {
    let RuleOptions { mut weight, mut guard, mut propensity, mut group, mut ignored } =
        RuleOptions::default();
    for pair in options.pairs::<LuaValue, LuaValue>() {
        let (key, value) = pair.map_err(|error| Error::internal(error.to_string()))?;
        let key = key.to_string().unwrap_or_default();
        match (key.as_str(), value) {
            ("weight", LuaValue::Function(_)) => {
                return Err(Error::argument("weight must be a number of at least 0, not a function")
                    .help("write { when = function(this, x) return x > 0 end } for a condition, or { propensity = ... } for a rate"));
            }
            ("weight", value) => match to_value(&value, false)? {
                Value::Number(number) if number >= 0.0 && number.is_finite() => weight = Some(number),
                other => {
                    return Err(Error::argument(format!(
                        "weight must be a number of at least 0, not {other}"
                    ))
                    .help("a rule with weight 0 is never chosen"));
                }
            },
            ("propensity", LuaValue::Function(function)) => {
                propensity = Some(DeclaredPropensity::Function(function));
            }
            ("propensity", value) => {
                match to_value(&value, false)? {
                    Value::Number(number) if (0.0..=MOST_PROPENSITY).contains(&number) => {
                        propensity = Some(DeclaredPropensity::Number(number));
                    }
                    other => {
                        return Err(Error::argument(format!(
                        "propensity must be a number from 0 to {MOST_PROPENSITY:e} or a function, not {other}"
                    ))
                    .help("write { propensity = 0.3 } or { propensity = function(this, x) return 0.1 * x end }"));
                    }
                }
            }
            ("group", LuaValue::String(name)) if !name.as_bytes().is_empty() => {
                group = Some(name.to_string_lossy().into());
            }
            ("group", other) => {
                return Err(Error::argument(format!("group must be a name, not a {}", type_of(&other)))
                    .help("write { group = \"grow\" }, and derive(5, \"grow\")"));
            }
            ("ignore", value) => {
                ignored.get_or_insert_with(IgnoredModules::default).ignored =
                    named_in_option(library, lua, &value)?;
            }
            ("consider", value) => {
                ignored.get_or_insert_with(IgnoredModules::default).considered =
                    Some(named_in_option(library, lua, &value)?);
            }
            ("when", LuaValue::Function(function)) => guard = Some(function),
            ("when", other) => {
                return Err(Error::argument(format!("when must be a function, not a {}", type_of(&other)))
                    .help("write { when = function(this, x) return x > 0 end }"));
            }
            (other, _) => {
                let message = format!("unknown option `{other}` of a rule");
                return Err(Error::not_found("option", other, RULE.part_names(), message)
                    .help(format!("it has {}", RULE.part_names().join(", "))));
            }
        }
    }
    if let Some(warning) = ignored.as_ref().and_then(|it| it.conflict("rule", Machine::place(lua))) {
        library.machine()?.warn(warning);
    }
    Ok(RuleOptions { weight, guard, propensity, group, ignored })
}

/// Refuses a function with more parameters than the pattern provides.
fn check_parameters(function: &Function, pattern: &Pattern, what: &str) -> Result<()> {
    let info = function.info();
    let given = pattern.formals.len() + 1;
    let taken = usize::from(info.num_params);
    if taken > given {
        let formals = std::iter::once("this").chain(pattern.formals.iter().map(String::as_str));
        let formals: Vec<&str> = formals.collect();
        return Err(Error::argument(format!("{what} has {taken} parameters, but the pattern has {given}"))
            .help(format!("write function({})", formals.join(", "))));
    }
    Ok(())
}

/// Refuses SQL queries of a function with parameters that have no value.
fn check_queries(library: &Library, function: &Function, pattern: &Pattern) -> Result<()> {
    let Some((file, line)) = begin_of(function) else { return Ok(()) };
    let queries = library.machine()?.session.queries(&file, line);
    check_open(&queries, &file, pattern, &library.symbols.borrow())
}

/// Refuses the first SQL parameter of `queries`, in the file `file`, that is not an argument of `pattern`.
pub(super) fn check_open(
    queries: &[QueryCall],
    file: &str,
    pattern: &Pattern,
    symbols: &Symbols,
) -> Result<()> {
    let arguments = pattern.arguments(symbols);
    let mut open = queries.iter().flat_map(|query| query.open.iter().map(move |name| (query.line, name)));
    let is_unknown = |name: &str| !arguments.iter().any(|(_, argument)| *argument == name);
    let Some((line, name)) = open.find(|(_, name)| is_unknown(name)) else { return Ok(()) };
    let names = arguments.iter().map(|(_, argument)| *argument);
    let error = Error::not_found("parameter", name, names, format!("${name} of the query has no value"));
    Err(error.at_line(file, line).help(format!(
        "the rule's pattern has no parameter of this name; add it there, or pass a value: query(sql, {{ {name} = ... }})"
    )))
}
