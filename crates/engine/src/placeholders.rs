//! Symbols of placeholder modules, which are replaced by other modules when they are resolved.

use burgeon_rewriting::{Signature, Symbol, Symbols, placeholder};

/// Placeholder for the rows of a query. Parameters: SQL text, name of the modules, values of the SQL
/// parameters, line of the script.
pub(crate) const QUERY: Symbol = placeholder(0);

/// Placeholder for the parts of the module to its left. Parameters: name of the modules, line of the script.
pub(crate) const FRAGMENT: Symbol = placeholder(1);

/// Returns a symbol table that declares only the placeholders.
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
