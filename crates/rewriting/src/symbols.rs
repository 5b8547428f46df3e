//! Declared modules with their names and parameters.

use std::borrow::Cow;
use std::collections::BTreeSet;
use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::chain::{Chain, END, Symbol};
use burgeon_base::ModuleKey;
use burgeon_base::error::{Error, Limit, Result};

/// Number of symbols that are reserved for placeholders: modules that a phase replaces by other modules.
pub const PLACEHOLDERS: Symbol = 8;

/// First number of a declared symbol. Lower numbers are the brackets, the end of a chain, and placeholders. Patterns
/// cannot name them, so no rule sees them.
pub const FIRST_SYMBOL: Symbol = END + 1 + PLACEHOLDERS;

/// Returns the symbol of placeholder number `number`, which must be below [`PLACEHOLDERS`].
pub const fn placeholder(number: Symbol) -> Symbol {
    assert!(number < PLACEHOLDERS, "there are fewer placeholders");
    END + 1 + number
}

/// Symbol of the first placeholder.
const FIRST_PLACEHOLDER: Symbol = END + 1;

/// Maximum number of modules that a script can declare, including the standard library.
const MOST_MODULES: usize = 65_000;

/// Maximum number of parameters of a module.
const MOST_PARAMETERS: usize = 32;

/// Declaration of a module by `module(name, parameters...)`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Signature {
    /// Name of the symbol.
    pub name: String,
    /// Names of the parameters, in order.
    pub parameters: Vec<String>,
    /// Number of required parameters; the others are optional.
    pub required: usize,
}

impl Signature {
    /// Creates a signature. A parameter whose name ends with `?` is optional, and so are all parameters after it. Fails
    /// if a name is invalid or repeated, or if there are too many parameters.
    ///
    /// ```
    /// use burgeon_rewriting::Signature;
    ///
    /// let floor = Signature::new("Floor", &["width".into(), "color?".into()])?;
    /// assert_eq!((floor.arity(), floor.required), (2, 1));
    /// assert!(Signature::new("Floor", &["width".into(), "width".into()]).is_err());
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn new(name: &str, parameters: &[String]) -> Result<Self> {
        if !is_name(name) {
            return Err(Error::argument(format!("invalid module name {name:?}"))
                .help("a name is a letter followed by letters, digits and underscores"));
        }
        if parameters.len() > MOST_PARAMETERS {
            return Err(Error::limit(
                Limit::Size,
                format!("module {name} has {} parameters, of at most {MOST_PARAMETERS}", parameters.len()),
            )
            .help("combine parameters in one table"));
        }
        let required =
            parameters.iter().position(|parameter| parameter.ends_with('?')).unwrap_or(parameters.len());
        let mut names: Vec<String> = Vec::new();
        for (index, parameter) in parameters.iter().enumerate() {
            let bare = parameter.strip_suffix('?').unwrap_or(parameter);
            if !is_name(bare) {
                return Err(Error::argument(format!("invalid parameter name {parameter:?} of {name}"))
                    .help("a name is a letter followed by letters, digits and underscores"));
            }
            if names.iter().any(|known| known == bare) {
                return Err(Error::argument(format!("module {name} has two parameters named `{bare}`")));
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

    /// Returns the number of parameters.
    pub fn arity(&self) -> usize {
        self.parameters.len()
    }

    /// Formats the module as written in a script, such as `Floor(n, radius)`.
    pub fn usage(&self) -> Cow<'_, str> {
        if self.parameters.is_empty() {
            return self.name.as_str().into();
        }
        let optional = |index: usize| if index < self.required { "" } else { "?" };
        let shown: Vec<String> =
            (0..).zip(&self.parameters).map(|(index, name)| format!("{name}{}", optional(index))).collect();
        format!("{}({})", self.name, shown.join(", ")).into()
    }

    /// Formats the number of parameters.
    pub fn count(&self) -> Cow<'static, str> {
        match (self.required, self.arity()) {
            (least, most) if least < most => format!("{least} to {most} parameters").into(),
            (_, arity) => count_text(arity),
        }
    }
}

/// Formats a number of parameters.
pub(crate) fn count_text(count: usize) -> Cow<'static, str> {
    match count {
        0 => "no parameters".into(),
        1 => "1 parameter".into(),
        count => format!("{count} parameters").into(),
    }
}

fn is_name(text: &str) -> bool {
    text.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
        && text.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

/// Scope in which a module name is resolved: the script or a package.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct NameScope {
    /// Package of the file; `None` for the script's own files.
    pub package: Option<Arc<str>>,
    /// Packages that the file has required so far.
    pub required: BTreeSet<Arc<str>>,
}

/// All declared modules. A symbol is an index into this list.
///
/// Declarations of packages are separate: modules of two packages, or of a package and the script, can have the same
/// name.
///
/// ```
/// use burgeon_rewriting::{Signature, Symbols};
///
/// let mut symbols = Symbols::default();
/// let own = symbols.declare(Signature::new("Stone", &[])?)?;
/// let castle = symbols.declare_in(Signature::new("Stone", &["size".into()])?, Some("castle"))?;
/// assert_eq!((symbols.display_name(own), symbols.display_name(castle)), ("Stone", "castle.Stone"));
/// assert_eq!((symbols.find("Stone")?, symbols.find("castle.Stone")?), (own, castle));
/// # Ok::<(), burgeon_base::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Symbols {
    /// Signatures of placeholders, then of declared modules.
    signatures: Vec<Signature>,
    /// Package that declares each symbol.
    owners: Vec<Option<Arc<str>>>,
    /// Display name of each symbol, with its package if several modules have the same name.
    shown: Vec<String>,
    /// Symbols of each name, in the order of declaration.
    by_name: FxHashMap<String, Vec<Symbol>>,
    /// Number of declared modules that belong to the standard library.
    standard: usize,
    /// Module of the standard library that has a meaning of its own, so that no declaration of a script is the same module.
    reserved: Option<Symbol>,
}

impl Default for Symbols {
    fn default() -> Self {
        Self::with_placeholders(Vec::new())
    }
}

impl Symbols {
    /// Creates symbols with only placeholders, which have these `signatures`, in order, at most [`PLACEHOLDERS`].
    pub fn with_placeholders(mut signatures: Vec<Signature>) -> Self {
        let unused = Signature { name: String::new(), parameters: Vec::new(), required: 0 };
        signatures.resize(usize::from(PLACEHOLDERS), unused);
        Self {
            shown: signatures.iter().map(|signature| signature.name.clone()).collect(),
            owners: vec![None; signatures.len()],
            signatures,
            by_name: FxHashMap::default(),
            standard: 0,
            reserved: None,
        }
    }

    /// Declares a module of the script and returns its symbol; a repeated declaration returns the same symbol.
    ///
    /// A script can redeclare a module of the standard library with other parameters. The name then refers to the
    /// script's module. Fails if the script has already declared the module with other parameters.
    pub fn declare(&mut self, signature: Signature) -> Result<Symbol> {
        self.declare_in(signature, None)
    }

    /// Declares a module of the package `owner`, or of the script; see [`declare`](Self::declare).
    pub fn declare_in(&mut self, signature: Signature, owner: Option<&str>) -> Result<Symbol> {
        let named = self.by_name.get(&signature.name).map(Vec::as_slice).unwrap_or_default();
        let known =
            || named.iter().filter(|symbol| !self.is_standard(**symbol) || self.reserved != Some(**symbol));
        let own = known().rev().find(|symbol| self.owner(**symbol) == owner);
        let standard = known().find(|symbol| self.is_standard(**symbol));
        for symbol in own.into_iter().chain(standard).copied() {
            if *self.signature(symbol) == signature {
                return Ok(symbol);
            }
            if !self.is_standard(symbol) {
                let usage = self.signature(symbol).usage();
                return Err(Error::script(format!("module {usage} is already declared"))
                    .help("declare it once, or rename the other module"));
            }
        }
        let symbol = u16::try_from(self.signatures.len() + usize::from(FIRST_PLACEHOLDER)).ok();
        let symbol = symbol.filter(|_| self.signatures.len() < MOST_MODULES).ok_or_else(|| {
            Error::limit(Limit::Size, "more than 65,000 modules are declared")
                .help("declare fewer modules, and distinguish them by a parameter")
        })?;
        self.shown.push(signature.name.clone());
        self.owners.push(owner.map(Into::into));
        let of_name = self.by_name.entry(signature.name.clone()).or_default();
        of_name.push(symbol);
        // A module of the script hides a module of the standard library, so these two need no qualified names.
        let same: Vec<Symbol> = if of_name.len() > 1 { of_name.clone() } else { Vec::new() };
        self.signatures.push(signature);
        for other in same {
            if let Some(owner) = &self.owners[usize::from(other - FIRST_PLACEHOLDER)] {
                self.shown[usize::from(other - FIRST_PLACEHOLDER)] =
                    format!("{owner}.{}", self.signature(other).name);
            }
        }
        Ok(symbol)
    }

    /// Returns the hash of the name of `symbol`, with the name of its package. Unlike the symbol, it does not depend on the
    /// other declarations.
    pub fn name_hash(&self, symbol: Symbol) -> u64 {
        match symbol.checked_sub(FIRST_PLACEHOLDER).map(usize::from) {
            Some(index) => ModuleKey::name_hash(self.owners[index].as_deref(), &self.signatures[index].name),
            None => 0,
        }
    }

    /// Returns the name of each declared module, in the order of declaration, and the number of its modules in `chain`.
    ///
    /// ```
    /// use burgeon_rewriting::{Chain, END, Signature, Symbols};
    ///
    /// let mut symbols = Symbols::default();
    /// let a = symbols.declare(Signature::new("A", &[])?)?;
    /// let b = symbols.declare(Signature::new("B", &[])?)?;
    /// let chain = Chain { symbols: vec![a, b, a, END], ..Chain::default() };
    /// assert_eq!(symbols.counts(&chain), [("A", 2), ("B", 1)]);
    /// # Ok::<(), burgeon_base::Error>(())
    /// ```
    pub fn counts(&self, chain: &Chain) -> Vec<(&str, usize)> {
        self.counts_of(std::iter::once(&*chain.symbols))
    }

    /// Returns the names of the declared modules and their numbers among `symbols`, which are parts of a chain.
    pub fn counts_of<'a>(&self, symbols: impl Iterator<Item = &'a [Symbol]>) -> Vec<(&str, usize)> {
        let mut counts = vec![0; self.arities().len()];
        symbols.flatten().for_each(|symbol| counts[usize::from(*symbol)] += 1);
        let declared = (FIRST_SYMBOL..).zip(counts.into_iter().skip(usize::from(FIRST_SYMBOL)));
        declared.map(|(symbol, count)| (self.display_name(symbol), count)).collect()
    }

    /// Returns true if `symbol` is the reserved module.
    pub fn is_reserved(&self, symbol: Symbol) -> bool {
        self.reserved == Some(symbol)
    }

    /// Marks a module of the standard library that has a meaning of its own. A script that declares a module with its name
    /// has another module.
    pub fn reserve(&mut self, symbol: Symbol) {
        self.reserved = Some(symbol);
    }

    /// Marks all current declarations as part of the standard library.
    pub fn end_of_standard(&mut self) {
        self.standard = self.signatures().len();
    }

    /// Returns true if `symbol` belongs to the standard library.
    pub fn is_standard(&self, symbol: Symbol) -> bool {
        usize::from(symbol) < usize::from(FIRST_SYMBOL) + self.standard
    }

    /// Returns the package that declares `symbol`; `None` for the script and the standard library.
    pub fn owner(&self, symbol: Symbol) -> Option<&str> {
        self.owners[usize::from(symbol - FIRST_PLACEHOLDER)].as_deref()
    }

    /// Returns the display name of `symbol`: with its package, `castle.Stone`, if several modules have the same name.
    pub fn display_name(&self, symbol: Symbol) -> &str {
        &self.shown[usize::from(symbol - FIRST_PLACEHOLDER)]
    }

    /// Returns the name that refers to `symbol` everywhere in the script: with its package if a package declares it.
    pub fn qualified_name(&self, symbol: Symbol) -> Cow<'_, str> {
        let name = self.signature(symbol).name.as_str();
        match self.owner(symbol) {
            Some(owner) => format!("{owner}.{name}").into(),
            None => name.into(),
        }
    }

    /// Returns the symbol that `name` refers to in the script; see [`find_in`](Self::find_in).
    pub fn find(&self, name: &str) -> Result<Symbol> {
        self.find_in(name, &NameScope::default())
    }

    /// Returns the symbol that `name` refers to in `scope`. The scope's own module of that name takes precedence, then
    /// the standard library. Otherwise it is the only module of that name, or the only one in the packages that the
    /// scope has required.
    ///
    /// `castle.Stone` is the module of the package castle. Fails if there is none, with the nearest known name, or if
    /// there are several, with all of them.
    pub fn find_in(&self, name: &str, scope: &NameScope) -> Result<Symbol> {
        if let Some((package, inner)) = name.split_once('.') {
            return self.find_of_package(name, package, inner);
        }
        let known = self.by_name.get(name).map(Vec::as_slice).unwrap_or_default();
        let own = known.iter().rev().find(|symbol| self.owner(**symbol) == scope.package.as_deref());
        let standard = known.iter().find(|symbol| self.is_standard(**symbol));
        if let Some(symbol) = own.or(standard) {
            return Ok(*symbol);
        }
        let is_required =
            |symbol: &&Symbol| self.owner(**symbol).is_some_and(|owner| scope.required.contains(owner));
        let required: Vec<&Symbol> = known.iter().filter(is_required).collect();
        match (known, required.as_slice()) {
            ([symbol], _) => Ok(*symbol),
            (_, [symbol]) => Ok(**symbol),
            ([], _) => Err(Error::not_found("symbol", name, self.names(), format!("unknown symbol {name}"))
                .help(format!("declare it: local {name} = module(\"{name}\")"))),
            _ => {
                let owners: Vec<&str> =
                    known.iter().map(|symbol| self.owner(*symbol).unwrap_or("the script")).collect();
                let named =
                    known.iter().filter_map(|symbol| Some(format!("{}.{name}", self.owner(*symbol)?)));
                let message = format!("{name} is a module of {}", owners.join(" and of "));
                Err(Error::script(message)
                    .help(format!("specify one: {}", named.collect::<Vec<_>>().join(" or "))))
            }
        }
    }

    /// Returns true if `name` may refer to a module: if one has this name, or if it names a package.
    pub fn has(&self, name: &str) -> bool {
        name.contains('.') || self.by_name.contains_key(name)
    }

    fn find_of_package(&self, name: &str, package: &str, inner: &str) -> Result<Symbol> {
        let of_package =
            || (FIRST_PLACEHOLDER..).zip(&self.owners).filter(|(_, owner)| owner.as_deref() == Some(package));
        let mut named = of_package().map(|(symbol, _)| symbol);
        named.find(|symbol| self.signature(*symbol).name == inner).ok_or_else(|| {
            let known: Vec<String> =
                of_package().map(|(it, _)| format!("{package}.{}", self.signature(it).name)).collect();
            let message = format!("unknown symbol {name}");
            let error = Error::not_found("symbol", name, known.iter().map(String::as_str), message);
            error.help(match known.is_empty() {
                true => format!("no required file of a package {package} declares a module"),
                false => format!("{package} declares {}", known.join(", ")),
            })
        })
    }

    /// Returns the declared names, in the order of declaration.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.signatures().iter().map(|signature| signature.name.as_str())
    }

    fn signatures(&self) -> &[Signature] {
        self.signatures.get(usize::from(FIRST_SYMBOL - FIRST_PLACEHOLDER)..).unwrap_or_default()
    }

    /// Returns the signature of `symbol`, which must be a result of [`Symbols::declare`] or a placeholder.
    pub fn signature(&self, symbol: Symbol) -> &Signature {
        &self.signatures[usize::from(symbol - FIRST_PLACEHOLDER)]
    }

    /// Returns the number of parameters by symbol, including brackets.
    pub fn arities(&self) -> Vec<u8> {
        let declared =
            self.signatures.iter().map(|signature| u8::try_from(signature.arity()).unwrap_or(u8::MAX));
        [0; FIRST_PLACEHOLDER as usize].into_iter().chain(declared).collect()
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
    fn a_script_that_declares_the_name_of_a_reserved_module_has_another_module() {
        let mut symbols = Symbols::default();
        let cut = symbols.declare(Signature::new("Cut", &[]).unwrap()).unwrap();
        symbols.reserve(cut);
        symbols.end_of_standard();
        assert_eq!(symbols.find("Cut").unwrap(), cut);
        let own = symbols.declare(Signature::new("Cut", &[]).unwrap()).unwrap();
        assert_ne!(own, cut);
        assert_eq!(symbols.find("Cut").unwrap(), own);
        assert_eq!(symbols.declare(Signature::new("Cut", &[]).unwrap()).unwrap(), own);
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
    fn modules_of_packages_may_have_one_name() {
        let mut symbols = Symbols::default();
        let standard = symbols.declare(signature("F", &["length?"]).unwrap()).unwrap();
        symbols.end_of_standard();
        let stone = |parameters: &[&str]| signature("Stone", parameters).unwrap();
        let castle = symbols.declare_in(stone(&["w"]), Some("castle")).unwrap();
        assert_eq!((symbols.display_name(castle), symbols.find("Stone").unwrap()), ("Stone", castle));
        let tower = symbols.declare_in(stone(&["w", "h"]), Some("tower")).unwrap();
        assert_eq!(symbols.declare_in(stone(&["w"]), Some("castle")).unwrap(), castle);
        assert!(symbols.declare_in(stone(&["x"]), Some("castle")).is_err());
        assert_eq!(
            (symbols.display_name(castle), symbols.display_name(tower)),
            ("castle.Stone", "tower.Stone")
        );
        let of = |package: Option<&str>, required: &[&str]| NameScope {
            package: package.map(Into::into),
            required: required.iter().map(|&name| name.into()).collect(),
        };
        let find = |name: &str, scope: &NameScope| symbols.find_in(name, scope);
        assert_eq!(find("Stone", &of(Some("castle"), &["tower"])).unwrap(), castle);
        assert_eq!(find("Stone", &of(None, &["tower"])).unwrap(), tower);
        assert_eq!(find("tower.Stone", &of(Some("castle"), &[])).unwrap(), tower);
        for scope in [of(None, &[]), of(None, &["castle", "tower"]), of(Some("gate"), &[])] {
            let error = find("Stone", &scope).unwrap_err();
            assert_eq!(error.message(), "Stone is a module of castle and of tower");
            assert_eq!(error.remedy(), Some("specify one: castle.Stone or tower.Stone"));
        }
        assert!(
            find("tower.Stole", &of(None, &[]))
                .unwrap_err()
                .to_string()
                .contains("did you mean tower.Stone?")
        );
        // A module that a package redeclares belongs to the package, and hides the standard library's module only
        // there.
        let own = symbols.declare_in(signature("F", &["l", "w"]).unwrap(), Some("castle")).unwrap();
        assert_eq!(symbols.find_in("F", &of(Some("castle"), &[])).unwrap(), own);
        assert_eq!(symbols.find_in("F", &of(None, &["castle"])).unwrap(), standard);
        assert_eq!((symbols.display_name(standard), symbols.display_name(own)), ("F", "castle.F"));
    }

    #[test]
    fn an_optional_parameter_is_not_followed_by_a_required_one() {
        assert_eq!(signature("F", &["length?"]).unwrap().required, 0);
        assert!(signature("F", &["length?", "width"]).is_err());
    }
}
