//! Symbols of modules that stand for others until they are resolved.

use burgeon_rewriting::{Signature, Symbol, Symbols, placeholder};

/// Module that stands for those of the rows of a query: the SQL text, the name of the modules, the values of the text's
/// parameters, and the line of the script.
pub(crate) const QUERY: Symbol = placeholder(0);

/// Module that stands for the parts of the module to its left: the name of the modules, and the line of the script.
pub(crate) const FRAGMENT: Symbol = placeholder(1);

/// Returns symbols of which only these are declared.
pub(crate) fn symbols() -> Symbols {
    let signature = |name: &str, parameters: &[&str], required| Signature {
        name: name.to_owned(),
        parameters: parameters.iter().map(|&parameter| parameter.to_owned()).collect(),
        required,
    };
    Symbols::with_placeholders(vec![
        signature("query", &["sql", "module", "values", "line"], 2),
        signature("fragment", &["module", "line"], 1),
    ])
}
