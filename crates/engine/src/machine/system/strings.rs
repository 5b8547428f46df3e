//! Successors and axioms given as strings, compiled to functions of Lua.

use std::collections::BTreeSet;

use mlua::{Function, Lua, MultiValue, Value as LuaValue};

use super::ReceiverUse;
use super::declare::check_open;
use super::module_string::{
    has_pattern_symbols, has_symbols, is_lua, lua_body, mentions, pattern_names, string_names,
};
use crate::declare::bytecode::compile;
use crate::machine::Machine;
use crate::machine::library::Library;
use burgeon_base::error::{Error, ErrorKind, Result, SourcePlace};
use burgeon_base::warning::Warning;
use burgeon_language::analysis::{QueryCall, analyse, split_line};
use burgeon_rewriting::{NameScope, Pattern, Symbol, Symbols};

/// Parses a pattern, in which turtle symbols and digits can stand for modules, and letters can be joined.
pub(super) fn parse_pattern(text: &str, symbols: &Symbols, scope: &NameScope) -> Result<Pattern> {
    Pattern::parse_in(text, symbols, scope).or_else(|error| {
        let names = match pattern_names(text, symbols, scope) {
            Err(unknown) if has_pattern_symbols(text) => return Err(unknown),
            Err(_) => return Err(error),
            Ok(names) => names,
        };
        let pattern = match Pattern::parse_in(&names, symbols, scope) {
            Err(_) if !has_pattern_symbols(text) => return Err(error),
            pattern => pattern?,
        };
        Ok(pattern.with_text(text))
    })
}

/// Returns the modules that a word of `ignore` or `consider` names: one module, or a string such as `+-F`.
pub(super) fn word_symbols(word: &str, symbols: &Symbols, scope: &NameScope) -> Result<Vec<Symbol>> {
    let error = match symbols.find_in(word, scope) {
        Ok(symbol) => return Ok(vec![symbol]),
        Err(error) => error,
    };
    let names =
        string_names(word, symbols, scope).map_err(|told| if has_symbols(word) { told } else { error })?;
    names.iter().map(|name| symbols.find_in(name, scope)).collect()
}

/// Compiles a successor given as a string of Lua or of modules, with the formal parameters, `this` and all modules in
/// scope. Also returns the use of `this`, and the numbers of the parameters that the successor reads.
pub(super) fn compile_successor(
    library: &Library,
    scope: &NameScope,
    pattern: &Pattern,
    body: &str,
    place: Option<&SourcePlace>,
) -> Result<(Function, ReceiverUse, Option<Vec<usize>>)> {
    let machine = library.machine()?;
    let (marked, body) = split_line(body);
    let (file, line) = place.map_or(("rule", 1), |place| (place.file.as_str(), place.line));
    let line = marked.unwrap_or(line);
    let symbols = library.symbols.borrow();
    let translated;
    let is_string = !is_lua(body);
    let body = if !is_string {
        body
    } else {
        let place = Some(SourcePlace::new(file, line));
        translated = lua_body(body, &symbols, scope, Some(&pattern.formals), place)
            .map_err(|error| error.at_line(file, line))?;
        &translated
    };
    let mut text = "\n".repeat(line.saturating_sub(1));
    text.push_str(&declarations(body, &symbols, scope)?);
    let formals: String = pattern.formals.iter().map(|formal| format!(", {formal}")).collect();
    text.push_str(&format!("lsystem:rule(\"\", function(this{formals}) {body}\nend)"));
    drop(symbols);
    let analysis = analyse(file, &text, compile, &library.globals());
    machine.session.note(&analysis);
    if !analysis.problems.is_empty() {
        // Behind the string is the end of the function that it becomes.
        let last = line + body.matches('\n').count();
        let problems = analysis.problems.into_iter().map(|error| match error.place() {
            Some(place) if place.line > last => {
                let message = error.message().replace("'end'", "the end of the string");
                error.rather_at(Some(SourcePlace::new(file, last))).saying(message)
            }
            _ => error,
        });
        return Err(Error::several(match is_string {
            true => problems.map(without_locals).collect(),
            false => problems.collect(),
        }));
    }
    if machine.driver.leads() {
        for warning in &analysis.doubtful {
            // The columns are those of the compiled text.
            let shown = Warning::new(warning.kind(), warning.message());
            let shown = warning.remedy().into_iter().fold(shown, Warning::help);
            machine.session.warn(shown.at(warning.place().cloned()));
        }
    }
    let queries: Vec<QueryCall> = analysis.queries.into_values().flatten().collect();
    check_open(&queries, file, pattern, &library.symbols.borrow())?;
    let text = analysis.text.replacen("lsystem:rule(\"\", ", "return (", 1);
    let chunk = machine.load(file, &text)?;
    let successor: Function = chunk.call(()).map_err(|error| machine.translate(error))?;
    let begin = successor.info().line_defined;
    let receiver_use = match begin {
        Some(line) if analysis.blind.contains(&line) => ReceiverUse::Unused,
        Some(line) if analysis.asks_place.contains(&line) => ReceiverUse::Place,
        _ => ReceiverUse::Any,
    };
    let reads = begin.and_then(|line| analysis.reads.get(&line));
    let reads = reads.map(|reads| reads.iter().copied().filter(|number| *number > 0).collect());
    Ok((successor, receiver_use, reads))
}

/// Returns the modules of an axiom given as a string. Their arguments are expressions of Lua with the names that all
/// scripts have.
pub(super) fn string_axiom(library: &Library, lua: &Lua, text: &str) -> Result<Vec<LuaValue>> {
    let machine = library.machine()?;
    let place = Machine::place(lua);
    let (file, line) = place.as_ref().map_or(("axiom", 1), |place| (place.file.as_str(), place.line));
    let scope = library.scope_at(lua);
    let symbols = library.symbols.borrow();
    let body = lua_body(text, &symbols, &scope, None, None)?;
    if body == "return nil" {
        return Ok(Vec::new());
    }
    let mut script = "\n".repeat(line.saturating_sub(1));
    script.push_str(&declarations(&body, &symbols, &scope)?);
    script.push_str(&body);
    drop(symbols);
    let analysis = analyse(file, &script, compile, &library.globals());
    machine.session.note(&analysis);
    if !analysis.problems.is_empty() {
        return Err(Error::several(analysis.problems.into_iter().map(without_locals).collect()));
    }
    let chunk = machine.load(file, &analysis.text)?;
    let modules: MultiValue = chunk.call(()).map_err(|error| machine.translate(error))?;
    Ok(modules.into_iter().collect())
}

/// Names what the arguments of a string can use, in an error for an unknown name.
fn without_locals(error: Error) -> Error {
    match error.kind() {
        ErrorKind::NotFound { what: "name", suggestion: None, .. } => {
            error.rather_help(
                "a string knows the parameters of the pattern and the names of all scripts; write a function to use others",
            )
        }
        _ => error,
    }
}

/// Returns Lua text that declares the modules in `body` as locals.
fn declarations(body: &str, symbols: &Symbols, scope: &NameScope) -> Result<String> {
    let names: BTreeSet<&str> = symbols.names().filter(|name| mentions(body, name)).collect();
    let mut text = String::new();
    for name in names {
        let symbol = symbols.find_in(name, scope).map_err(|error| {
            let help = "return it from a function, with a constructor of the package: function(this) return stone(1) end";
            error.rather_help(help)
        })?;
        if symbols.is_reserved(symbol) {
            // A declaration would make another module; the name is a global.
            continue;
        }
        let owner = symbols.owner(symbol).filter(|owner| scope.package.as_deref() != Some(*owner));
        let owner = owner.map_or_else(String::new, |owner| format!("{owner}."));
        let signature = symbols.signature(symbol);
        let parameters: String = signature
            .parameters
            .iter()
            .enumerate()
            .map(|(index, name)| format!(", \"{name}{}\"", if index < signature.required { "" } else { "?" }))
            .collect();
        // The analysis reads the signature from this call, which declares the same module again.
        text.push_str(&format!("local {name} = module(\"{owner}{name}\"{parameters}) "));
    }
    Ok(text)
}
