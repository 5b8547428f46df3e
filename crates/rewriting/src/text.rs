//! Chains and modules as text.

use std::io::{self, Write};

use super::chain::{CLOSE, Chain, END, OPEN, Symbol};
use super::symbols::Symbols;
use burgeon_base::error::shortened;

/// Text of parameters, which may stand for values that are not numbers.
pub trait ShowParameters {
    /// Returns a stored parameter as text; `nil` for an optional one that was left out.
    fn show(&self, stored: f64) -> String;
}

impl<T: ShowParameters + ?Sized> ShowParameters for std::sync::Arc<T> {
    fn show(&self, stored: f64) -> String {
        (**self).show(stored)
    }
}

/// Parameters that are numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct PlainNumbers;

impl ShowParameters for PlainNumbers {
    fn show(&self, stored: f64) -> String {
        stored.to_string()
    }
}

/// Characters of a parameter that people are shown.
const SHOWN: usize = 200;

/// A module as `Name(p1,p2)`, or `Name` without parameters; optional ones left out at the end are not shown.
pub fn module_text(symbols: &Symbols, values: &dyn ShowParameters, symbol: Symbol, params: &[f64]) -> String {
    write_module(symbols, values, symbol, params, |text| text)
}

/// The same for people: of a long parameter the middle is left out.
pub fn module_brief(
    symbols: &Symbols,
    values: &dyn ShowParameters,
    symbol: Symbol,
    params: &[f64],
) -> String {
    write_module(symbols, values, symbol, params, |text| shortened(&text, SHOWN).into_owned())
}

fn write_module(
    symbols: &Symbols,
    values: &dyn ShowParameters,
    symbol: Symbol,
    params: &[f64],
    write: impl Fn(String) -> String,
) -> String {
    match symbol {
        OPEN => return "[".to_owned(),
        CLOSE => return "]".to_owned(),
        END => return String::new(),
        _ => {}
    }
    let signature = symbols.signature(symbol);
    let mut shown: Vec<String> = params.iter().map(|stored| write(values.show(*stored))).collect();
    while shown.len() > signature.required && shown.last().is_some_and(|last| last == "nil") {
        shown.pop();
    }
    let name = symbols.shown(symbol);
    if shown.is_empty() { name.to_owned() } else { format!("{name}({})", shown.join(",")) }
}

/// Writes one line for each chain: modules separated by one space, branches as `[ ... ]`.
pub fn write_chains(
    out: &mut impl Write,
    chain: &Chain,
    symbols: &Symbols,
    values: &dyn ShowParameters,
) -> io::Result<()> {
    let arities = symbols.arities();
    let mut param = 0;
    let mut first = true;
    for symbol in &chain.symbols {
        if *symbol == END {
            out.write_all(b"\n")?;
            first = true;
            continue;
        }
        let arity = usize::from(arities[usize::from(*symbol)]);
        if !first {
            out.write_all(b" ")?;
        }
        first = false;
        out.write_all(module_text(symbols, values, *symbol, &chain.params[param..param + arity]).as_bytes())?;
        param += arity;
    }
    Ok(())
}

/// The chains as one string; see [`write_chains`].
pub fn chain_text(chain: &Chain, symbols: &Symbols, values: &dyn ShowParameters) -> String {
    let mut bytes = Vec::new();
    // Writing into memory cannot fail.
    let _ = write_chains(&mut bytes, chain, symbols, values);
    String::from_utf8_lossy(&bytes).into_owned()
}
