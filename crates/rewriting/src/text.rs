//! Chains and modules as text.

use std::borrow::Cow;
use std::io::{self, Write};

use super::chain::{CLOSE, Chain, END, OPEN, Symbol};
use super::symbols::Symbols;
use burgeon_base::error::shorten;

/// Access to parameters that represent values other than numbers: their texts, and the texts that patterns name.
pub trait ShowParameters {
    /// Formats a stored parameter; `nil` for an omitted optional one.
    fn show(&self, stored: f64) -> String;

    /// Returns the number that columns store for a text; `None` if no module has this text.
    fn find_text(&self, _text: &str) -> Option<f64> {
        None
    }
}

impl<T: ShowParameters + ?Sized> ShowParameters for std::sync::Arc<T> {
    fn show(&self, stored: f64) -> String {
        (**self).show(stored)
    }

    fn find_text(&self, text: &str) -> Option<f64> {
        (**self).find_text(text)
    }
}

/// Formatter of parameters that are all numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct PlainNumbers;

impl ShowParameters for PlainNumbers {
    fn show(&self, stored: f64) -> String {
        stored.to_string()
    }
}

/// Maximum number of characters of a parameter in a short text.
const SHOWN: usize = 200;

/// Formats a module as `Name(p1,p2)`, or `Name` without parameters. Omitted optional parameters at the end are not
/// shown.
pub fn module_text<'s>(
    symbols: &'s Symbols,
    values: &dyn ShowParameters,
    symbol: Symbol,
    params: &[f64],
) -> Cow<'s, str> {
    write_module(symbols, values, symbol, params, |text| text)
}

/// Formats a module like [`module_text`], but shortens long parameters in the middle.
pub fn module_brief(
    symbols: &Symbols,
    values: &dyn ShowParameters,
    symbol: Symbol,
    params: &[f64],
) -> String {
    write_module(symbols, values, symbol, params, |text| shorten(&text, SHOWN).into_owned()).into_owned()
}

fn write_module<'s>(
    symbols: &'s Symbols,
    values: &dyn ShowParameters,
    symbol: Symbol,
    params: &[f64],
    write: impl Fn(String) -> String,
) -> Cow<'s, str> {
    match symbol {
        OPEN => return Cow::Borrowed("["),
        CLOSE => return Cow::Borrowed("]"),
        END => return Cow::Borrowed(""),
        _ => {}
    }
    let signature = symbols.signature(symbol);
    let mut shown: Vec<String> = params.iter().map(|stored| write(values.show(*stored))).collect();
    while shown.len() > signature.required && shown.last().is_some_and(|last| last == "nil") {
        shown.pop();
    }
    let name = symbols.display_name(symbol);
    match shown.is_empty() {
        true => Cow::Borrowed(name),
        false => Cow::Owned(format!("{name}({})", shown.join(","))),
    }
}

/// Writes one line per chain: modules separated by one space, branches as `[ ... ]`.
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

/// Returns the chains as one string; see [`write_chains`].
pub fn chain_text(chain: &Chain, symbols: &Symbols, values: &dyn ShowParameters) -> String {
    let mut bytes = Vec::new();
    // Writing to memory cannot fail.
    let _ = write_chains(&mut bytes, chain, symbols, values);
    String::from_utf8_lossy(&bytes).into_owned()
}
