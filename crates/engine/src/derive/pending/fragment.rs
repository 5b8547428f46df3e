//! Modules for the parts of a geometry.

use std::rc::Rc;

use rustc_hash::{FxHashMap, FxHashSet};

use crate::queries::{fit, listed};
use burgeon_base::error::{Error, Result};
use burgeon_kit::Values;
use burgeon_kit::{ObjectContent, Value};
use burgeon_rewriting::{Chain, ColumnValue, Mark, Symbol, Symbols, module_brief};

/// For each parameter of a new module, the index of the parameter that it is copied from.
type ParameterPlaces = Rc<[Option<usize>]>;

/// Splits modules into modules of their geometry's parts, and caches the results.
#[derive(Default)]
pub(super) struct Fragmentation {
    /// Parameter sources, by symbol of the split module, index of its geometry parameter, and symbol of the
    /// parts.
    fits: FxHashMap<(Symbol, usize, Symbol), ParameterPlaces>,
    /// Parts by the bits of a packed geometry. The flag marks a geometry without parts, which is its own only
    /// part.
    parts: FxHashMap<u64, (Rc<[f64]>, bool)>,
    /// Fragment modules that met a geometry without parts.
    whole: Vec<Mark>,
}

impl Fragmentation {
    /// Replaces each module of `group` by one module with `symbol` per part of its geometry.
    ///
    /// The new modules copy the parameters by name, and keep the feature in `owners`. `at` is the position of
    /// the fragment module.
    pub(super) fn apply(
        &mut self,
        (group, owners): (&Chain, &[u32]),
        symbol: Symbol,
        symbols: &Symbols,
        (at, values): (Mark, &Values),
    ) -> Result<(Chain, Vec<u32>)> {
        let (mut made, mut made_owners) = (Chain::default(), Vec::new());
        let mut param = 0;
        for (index, left) in group.symbols.iter().enumerate() {
            let params = &group.params[param..param + symbols.signature(*left).arity()];
            param += params.len();
            let (geometry, parts) = self.parts(params, at, values).ok_or_else(|| {
                let left = module_brief(symbols, values, *left, params);
                Error::argument(format!("{left} to its left has no geometry to divide")).help(
                    "pass a geometry to the module to its left, such as Outline(lot:exterior_ring(), id)",
                )
            })?;
            let fit = self.fit((*left, geometry, symbol), symbols)?;
            for (ordinal, part) in parts.iter().enumerate() {
                made.symbols.push(symbol);
                made.params.extend(fit.iter().map(|from| match from {
                    Some(from) if *from == geometry => *part,
                    Some(from) => params[*from],
                    None => ColumnValue::Nil.pack(),
                }));
                made.keys.extend(group.keys.get(index).map(|key| key.child(ordinal)));
                made_owners.extend(owners.get(index));
            }
        }
        Ok((made, made_owners))
    }

    /// Returns the index of the first geometry among `params`, and its parts.
    fn parts(&mut self, params: &[f64], at: Mark, values: &Values) -> Option<(usize, Rc<[f64]>)> {
        for (place, stored) in params.iter().enumerate() {
            if !matches!(ColumnValue::unpack(*stored), ColumnValue::Handle(_)) {
                continue;
            }
            let known = match self.parts.get(&stored.to_bits()) {
                Some(known) => known,
                None => {
                    let Some(parts) = parts_of(&values.unpack(*stored)) else { continue };
                    let is_whole = parts.is_none();
                    let parts = match parts {
                        Some(parts) => parts.into_iter().map(|part| values.pack(part)).collect(),
                        None => [*stored].into_iter().collect(),
                    };
                    self.parts.entry(stored.to_bits()).or_insert((parts, is_whole))
                }
            };
            if known.1 {
                self.whole.push(at);
            }
            return Some((place, Rc::clone(&known.0)));
        }
        None
    }

    /// Returns the parameter sources of the parts.
    fn fit(&mut self, key: (Symbol, usize, Symbol), symbols: &Symbols) -> Result<ParameterPlaces> {
        if let Some(known) = self.fits.get(&key) {
            return Ok(Rc::clone(known));
        }
        let (left, target) = (symbols.signature(key.0), symbols.signature(key.2));
        let names: Vec<&str> = left.parameters.iter().map(String::as_str).collect();
        let is_geometry: Vec<bool> = (0..names.len()).map(|place| place == key.1).collect();
        let found = fit(&names, &is_geometry, target).map_err(|missing| {
            Error::argument(format!(
                "{} to its left has no parameter {} of {}",
                left.usage(),
                listed(&missing),
                target.usage()
            ))
            .help("parameters are copied by name: use the same names in both modules, or make them optional: \"name?\"")
        })?;
        let found: ParameterPlaces = found.into();
        self.fits.insert(key, Rc::clone(&found));
        Ok(found)
    }

    /// Returns the warnings, one per fragment module, each with its position.
    pub(super) fn warnings(&self) -> impl Iterator<Item = (Mark, &'static str)> + '_ {
        let mut told = FxHashSet::default();
        let first = self.whole.iter().filter(move |at| told.insert(at.module));
        first.map(|at| (*at, "a point has no parts, so it stays unchanged"))
    }
}

/// Returns the parts of an object with content, `None` within for one that has none; `None` for other values.
fn parts_of(value: &Value) -> Option<Option<Vec<Value>>> {
    let Value::Object(object) = value else { return None };
    Some(object.capability::<dyn ObjectContent>()?.fragments())
}
