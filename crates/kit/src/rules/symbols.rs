//! The declared modules: their names and parameters.

use rustc_hash::FxHashMap;

use super::chain::{END, Symbol};
use burgeon_base::error::{Error, Limit, Result};

/// A module that stands for those that the rows of a query give: the text of SQL, the name of the modules, the values
/// of the text's parameters, and the line of the script.
pub const QUERY: Symbol = END + 1;
/// A module that stands for the parts of what is to its left: the name of the modules, and the line of the script.
pub const FRAGMENT: Symbol = END + 2;

/// The first number that a declared symbol may have; those below are the brackets, the end of a chain, and the modules
/// that stand for others. No rule ever sees these, so no pattern can name them.
pub const FIRST_SYMBOL: Symbol = FRAGMENT + 1;

/// The largest number of modules that a script may declare, those of the standard library among them.
const MOST_MODULES: usize = 65_000;

/// The largest number of parameters that a module may have.
const MOST_PARAMETERS: usize = 32;

/// What `module(name, parameters...)` declares.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// The symbol's name.
    pub name: String,
    /// The parameters' names, in order.
    pub parameters: Vec<String>,
    /// How many of them must be given; the rest may be left out.
    pub required: usize,
}

impl Signature {
    /// Checks the names. A parameter whose name ends in `?` may be left out, as may those after it.
    pub fn new(name: &str, parameters: &[String]) -> Result<Self> {
        if !is_name(name) {
            return Err(Error::argument(format!("{name:?} cannot be a module's name"))
                .help("a name is a letter followed by letters, digits and underscores"));
        }
        if parameters.len() > MOST_PARAMETERS {
            return Err(Error::limit(
                Limit::Size,
                format!("module {name} has {} parameters, of at most {MOST_PARAMETERS}", parameters.len()),
            )
            .help("put what belongs together into one table parameter"));
        }
        let required =
            parameters.iter().position(|parameter| parameter.ends_with('?')).unwrap_or(parameters.len());
        let mut names: Vec<String> = Vec::new();
        for (index, parameter) in parameters.iter().enumerate() {
            let bare = parameter.strip_suffix('?').unwrap_or(parameter);
            if !is_name(bare) {
                return Err(Error::argument(format!(
                    "{parameter:?} cannot be the name of a parameter of {name}"
                ))
                .help("a name is a letter followed by letters, digits and underscores"));
            }
            if names.iter().any(|known| known == bare) {
                return Err(Error::argument(format!("module {name} has two parameters called {bare}")));
            }
            if index >= required && !parameter.ends_with('?') {
                return Err(Error::argument(format!(
                    "module {name}: {bare} follows an optional parameter, so it must be optional too"
                ))
                .help(format!("write \"{bare}?\"")));
            }
            names.push(bare.to_owned());
        }
        Ok(Self { name: name.to_owned(), parameters: names, required })
    }

    /// The number of parameters.
    pub fn arity(&self) -> usize {
        self.parameters.len()
    }

    /// The module as one would write it, such as `Floor(n, radius)`.
    pub fn usage(&self) -> String {
        if self.parameters.is_empty() {
            return self.name.clone();
        }
        let shown: Vec<String> = self
            .parameters
            .iter()
            .enumerate()
            .map(|(index, name)| if index < self.required { name.clone() } else { format!("{name}?") })
            .collect();
        format!("{}({})", self.name, shown.join(", "))
    }

    /// How many parameters may be given, in words.
    pub fn count(&self) -> String {
        match (self.required, self.arity()) {
            (_, 0) => "no parameters".to_owned(),
            (1, 1) => "1 parameter".to_owned(),
            (least, most) if least == most => format!("{most} parameters"),
            (least, most) => format!("{least} to {most} parameters"),
        }
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// All declared modules. A symbol is a place in this list.
#[derive(Debug, Clone)]
pub struct Symbols {
    /// Those of [`QUERY`] and [`FRAGMENT`], then the declared ones.
    signatures: Vec<Signature>,
    by_name: FxHashMap<String, Symbol>,
    /// How many of the declared ones are the standard library's.
    standard: usize,
}

impl Default for Symbols {
    fn default() -> Self {
        let signature = |name: &str, parameters: &[&str], required| Signature {
            name: name.to_owned(),
            parameters: parameters.iter().map(|&parameter| parameter.to_owned()).collect(),
            required,
        };
        let query = signature("query", &["sql", "module", "values", "line"], 2);
        let fragment = signature("fragment", &["module", "line"], 1);
        Self { signatures: vec![query, fragment], by_name: FxHashMap::default(), standard: 0 }
    }
}

impl Symbols {
    /// Declares a module and gives its symbol; the same declaration again gives the same symbol.
    ///
    /// A script may declare a module of the standard library anew, with other parameters; then the name means
    /// the script's.
    pub fn declare(&mut self, signature: Signature) -> Result<Symbol> {
        if let Some(&symbol) = self.by_name.get(&signature.name) {
            let known = self.signature(symbol);
            if *known == signature {
                return Ok(symbol);
            }
            if usize::from(symbol - FIRST_SYMBOL) >= self.standard {
                return Err(Error::script(format!("module {} is declared already", known.usage()))
                    .help("declare it once, or give the other module another name"));
            }
        }
        let symbol = u16::try_from(self.signatures.len() + usize::from(QUERY)).ok();
        let symbol = symbol.filter(|_| self.signatures.len() < MOST_MODULES).ok_or_else(|| {
            Error::limit(Limit::Size, "more than 65,000 modules are declared")
                .help("declare fewer, and tell them apart by a parameter")
        })?;
        self.by_name.insert(signature.name.clone(), symbol);
        self.signatures.push(signature);
        Ok(symbol)
    }

    /// Marks what is declared so far as the standard library's.
    pub fn end_of_standard(&mut self) {
        self.standard = self.declared().len();
    }

    /// Whether `symbol` is one of the standard library's.
    pub fn is_standard(&self, symbol: Symbol) -> bool {
        usize::from(symbol) < usize::from(FIRST_SYMBOL) + self.standard
    }

    /// The symbol called `name`; unknown ones are an error with the nearest known one.
    pub fn find(&self, name: &str) -> Result<Symbol> {
        self.by_name.get(name).copied().ok_or_else(|| {
            Error::not_found("symbol", name, self.names(), format!("unknown symbol {name}"))
                .help(format!("declare it: local {name} = module(\"{name}\")"))
        })
    }

    /// The declared names, in the order of their declaration.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.declared().iter().map(|signature| signature.name.as_str())
    }

    fn declared(&self) -> &[Signature] {
        self.signatures.get(usize::from(FIRST_SYMBOL - QUERY)..).unwrap_or_default()
    }

    /// How `symbol` was declared; `symbol` is one that [`Symbols::declare`] gave, or one that stands for others.
    pub fn signature(&self, symbol: Symbol) -> &Signature {
        &self.signatures[usize::from(symbol - QUERY)]
    }

    /// The number of parameters by symbol, brackets included.
    pub fn arities(&self) -> Vec<u8> {
        let declared =
            self.signatures.iter().map(|signature| u8::try_from(signature.arity()).unwrap_or(u8::MAX));
        [0; QUERY as usize].into_iter().chain(declared).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signature(name: &str, parameters: &[&str]) -> Result<Signature> {
        Signature::new(name, &parameters.iter().map(|p| (*p).to_owned()).collect::<Vec<_>>())
    }

    #[test]
    fn a_module_may_be_declared_twice_if_it_is_the_same() {
        let mut symbols = Symbols::default();
        let first = symbols.declare(signature("A", &["x"]).unwrap()).unwrap();
        assert_eq!(symbols.declare(signature("A", &["x"]).unwrap()).unwrap(), first);
        assert!(symbols.declare(signature("A", &["y"]).unwrap()).is_err());
    }

    #[test]
    fn a_script_may_declare_a_standard_module_anew() {
        let mut symbols = Symbols::default();
        let standard = symbols.declare(signature("F", &["length?"]).unwrap()).unwrap();
        symbols.end_of_standard();
        let own = symbols.declare(signature("F", &["l", "w"]).unwrap()).unwrap();
        assert_ne!(standard, own);
        assert_eq!(symbols.find("F").unwrap(), own);
    }

    #[test]
    fn an_optional_parameter_is_not_followed_by_a_required_one() {
        assert_eq!(signature("F", &["length?"]).unwrap().required, 0);
        assert!(signature("F", &["length?", "width"]).is_err());
    }
}
